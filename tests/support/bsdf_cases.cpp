// SPDX-License-Identifier: MIT

#include "support/bsdf_cases.h"

#include <cmath>
#include <set>

namespace plumb::test {

namespace {

ParamsBuilder bsdf(const std::string& type)
{
    return ParamsBuilder("bsdf", type);
}

ParamsBuilder glass(const std::string& type, double interior, double exterior)
{
    return bsdf(type).number("intIOR", interior).number("extIOR", exterior);
}

std::vector<BsdfCase> make_cases()
{
    std::vector<BsdfCase> cases = {
        {bsdf("diffuse"), 1},
        {bsdf("diffuse").color("albedo", Color(0.9f, 0.4f, 0.f)), 1},
        {bsdf("mirror"), 1},
        {bsdf("dielectric"), 1},
        {glass("dielectric", 1.0, 1.33), 1},
        {bsdf("microfacet"), 0.1},
        {bsdf("microfacet").number("alpha", 0.5).color("kd", Color(0.1f, 0.7f, 0.2f)), 0.5},
        {bsdf("microfacet").number("alpha", 0.02).color("kd", Color(0.f)), 0.02},
        {glass("microfacet", 1.2, 1.6).number("alpha", 1.0).color("kd", Color(1.f, 0.f, 0.5f)), 1},
        {bsdf("roughconductor"), 0.1},
        {bsdf("roughconductor").number("alpha", 0.005).color("R0", Color(1.f, 0.71f, 0.29f)), 0.005},
        {bsdf("roughconductor").number("alpha", 1.0).color("R0", Color(1.f)), 1},
        {bsdf("roughsubstrate"), 0.1},
        {bsdf("roughsubstrate").number("alpha", 0.6).color("kd", Color(1.f, 0.2f, 0.f)), 0.6},
        {bsdf("roughsubstrate").number("alpha", 0.02).color("kd", Color(0.f)), 0.02},
        {glass("roughsubstrate", 1.0, 1.5).number("alpha", 0.3).color("kd", Color(0.5f)), 0.3, true},
        {glass("roughsubstrate", 1.5, 1.5).color("kd", Color(0.5f)), 1},
        {bsdf("roughdielectric"), 0.1},
        {bsdf("roughdielectric").number("alpha", 0.02), 0.02},
        {glass("roughdielectric", 1.33, 1.0).number("alpha", 0.5).color("ka", Color(1.f, 0.5f, 0.2f)), 0.5},
        {glass("roughdielectric", 1.0, 1.8).number("alpha", 0.3), 0.3},
        {glass("roughdielectric", 1.3, 1.3).color("ka", Color(0.8f, 0.9f, 1.f)), 1},
        {bsdf("conductor").string("material", "Au"), 1},
        {bsdf("conductor").color("eta", Color(0.f)).color("k", Color(0.f)), 1},
        {bsdf("thindielectric"), 1},
        {glass("thindielectric", 1.0, 1.5), 1},
        {bsdf("roughconductor").string("material", "Cu").number("alpha", 0.3).string("distribution", "ggx"),
         0.3},
        {bsdf("roughconductor").string("distribution", "ggx").number("alphaU", 0.3).number("alphaV", 0.6),
         0.3},
        {bsdf("roughconductor").number("alphaU", 0.6).number("alphaV", 0.2), 0.2},
        {glass("roughdielectric", 1.5, 1.0).number("alpha", 0.3).string("distribution", "ggx"), 0.3},
        {glass("roughdielectric", 1.5, 1.0)
             .string("distribution", "ggx")
             .number("alphaU", 0.2)
             .number("alphaV", 0.5)
             .color("specularReflectance", Color(0.9f, 0.5f, 0.3f))
             .color("specularTransmittance", Color(0.1f, 0.5f, 0.9f)),
         0.2},
        {bsdf("microfacet").string("distribution", "ggx").number("alphaV", 0.4), 0.1},
        {bsdf("roughsubstrate").string("distribution", "ggx").number("alpha", 0.4), 0.4},
        {bsdf("plastic"), 1},
        {glass("plastic", 1.9, 1.0).color("diffuseReflectance", Color(1.f, 0.3f, 0.f)), 1},
        {glass("plastic", 1.0, 1.3).color("diffuseReflectance", Color(1.f)).boolean("nonlinear", true), 1},
        {bsdf("roughplastic"), 0.1},
        {bsdf("roughplastic").number("alpha", 0.5).color("diffuseReflectance", Color(1.f, 0.5f, 0.f)), 0.5},
        {glass("roughplastic", 1.9, 1.0)
             .string("distribution", "ggx")
             .number("alpha", 0.3)
             .color("diffuseReflectance", Color(1.f))
             .boolean("nonlinear", true),
         0.3},
        {bsdf("principled"), 0.25},
        {bsdf("principled").number("roughness", 0.4).number("metallic", 0.7).number("anisotropic", 0.6), 0.1},
        {bsdf("principled").number("roughness", 0.7).number("specTrans", 0.8).number("eta", 1.4), 0.3},
        {bsdf("principled").number("clearcoat", 1.0).number("sheen", 1.0).number("flatness", 0.5), 0.1},
        {bsdf("principled").number("specTrans", 1.0).number("roughness", 0.6).number("specTint", 0.5), 0.3},
        {bsdf("principledthin").number("specTrans", 0.6).number("diffTrans", 0.7).number("roughness", 0.6),
         0.2},
        {bsdf("principledthin").number("diffTrans", 1.3).number("sheen", 1.0).number("flatness", 1.0), 1},
        {bsdf("phong"), 1},
        {bsdf("phong")
             .color("specular-coefficients", Color(0.3f))
             .color("diffuse-coefficients", Color(0.6f, 0.f, 0.1f))
             .integer("exponent", 40),
         0.2},
        {bsdf("phong")
             .color("specular-coefficients", Color(0.7f, 0.6f, 0.f))
             .color("diffuse-coefficients", Color(0.5f))
             .integer("exponent", 3),
         1},
        {bsdf("phong").color("specular-coefficients", Color(0.5f)).integer("exponent", 0), 1},
        {bsdf("phong").color("specular-coefficients", Color(1.f)).integer("exponent", 2000), 0.03},
        {bsdf("ward"), 0.1},
        {bsdf("ward")
             .number("alphaU", 0.3)
             .number("alphaV", 0.6)
             .color("diffuseReflectance", Color(0.f))
             .color("specularReflectance", Color(1.f, 0.5f, 0.f)),
         0.3},
    };
    std::set<std::string> covered;
    for (const auto& one : cases) covered.insert(one.params.type());
    for (auto& sample : samples_of(bsdf_types())) {
        const std::string type = sample->element().value("type");
        if (!covered.contains(type)) cases.push_back({bsdf(type), 1, false, std::move(sample)});
    }
    return cases;
}

} // namespace

std::string BsdfCase::name() const
{
    return sample ? sample->text() : params.text();
}

std::unique_ptr<Bsdf> BsdfCase::build() const
{
    return sample ? sample->build(bsdf_types()) : params.build_type(bsdf_types());
}

const std::vector<BsdfCase>& bsdf_cases()
{
    static const std::vector<BsdfCase> cases = make_cases();
    return cases;
}

Vec3f direction_at(double degrees, double azimuth)
{
    const double theta = degrees * pi_d / 180.0;
    return Vec3f(
        Vec3d(std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)));
}

std::vector<LobeGrid> lobe_grids(const BsdfCase& test, const Bsdf& bsdf, const Vec3f& wi)
{
    if (test.narrowness >= 0.3) return {LobeGrid{}};

    // Half of the cells go to angles below twice the roughness, about the mirror direction and, for BSDFs that
    // transmit, about the mean of the transmitted samples.
    const double concentration = std::max(1.0, 2.0 * std::log2(1.0 / test.narrowness));
    const SphereGrid mirrored{Vec3f(-wi.x, -wi.y, wi.z), concentration, 20, 20};
    if (!bsdf.lobes().has_any(Lobe::glossy_transmission)) return {{mirrored, true, true}};
    Vec3d mean(0.0);
    TestRandom random(17);
    for (int i = 0; i < 4000; ++i) {
        const float u_lobe = random.next_1d();
        const auto sample = bsdf.sample({}, wi, u_lobe, random.next_2d());
        if (sample && sample->is_transmission()) mean += Vec3d(sample->wo);
    }
    if (length(mean) == 0.0) mean = -Vec3d(wi);
    const SphereGrid refracted{Vec3f(normalize(mean)), concentration, 20, 20};
    return {{mirrored, wi.z > 0.f, wi.z < 0.f}, {refracted, wi.z<0.f, wi.z> 0.f}};
}

} // namespace plumb::test
