// SPDX-License-Identifier: MIT

// Values of BSDFs beside those of Mitsuba 3.9.1 (scalar_rgb): f times the cosine for a view from (0.6, 0, 0.8).

#include "support/catch.h"
#include "support/params.h"
#include "support/statistics.h"

using namespace plumb;
using namespace plumb::test;

namespace {

ParamsBuilder bsdf(const std::string& type)
{
    return ParamsBuilder("bsdf", type);
}

// The basis of most principled cases.
ParamsBuilder orange(const std::string& type)
{
    return bsdf(type).color("baseColor", Color(0.8f, 0.4f, 0.1f)).number("roughness", 0.3);
}

ParamsBuilder ggx(const std::string& type)
{
    return bsdf(type).string("distribution", "ggx").number("alpha", 0.3);
}

// In direction a, b (the mirror direction), c and d (along the normal); perhaps also e and f, below the surface.
struct MitsubaCase {
    ParamsBuilder params;
    std::vector<Color> values;
    double tolerance = 1e-4;
};

const Vec3f directions[] = {
    {0.3f, 0.4f, 0.8660254f}, {-0.6f, 0.f, 0.8f},         {-0.7f, 0.2f, 0.68556546f},
    {0.f, 0.f, 1.f},          {0.3f, 0.2f, -0.93273791f}, {-0.4f, 0.f, -0.91651514f},
};

Color grey(float value)
{
    return Color(value);
}

std::vector<MitsubaCase> cases()
{
    return {
        {bsdf("diffuse"), {grey(.137832f), grey(.127324f), grey(.109111f), grey(.159155f)}},
        // They take F_in from a fit, 0.590479 at the default index, where the integral is 0.589992.
        {bsdf("plastic"), {grey(.139402f), grey(.12846f), grey(.109118f), grey(.161219f)}, 2e-3},
        {bsdf("plastic").color("specularReflectance", Color(0.5f)),
         {grey(.139402f), grey(.12846f), grey(.109118f), grey(.161219f)},
         2e-3},
        {bsdf("plastic").number("intIOR", 1.9).color("diffuseReflectance", Color(0.1f, 0.27f, 0.36f)),
         {{.026203f, .070748f, .09433f},
          {.02413f, .065151f, .086869f},
          {.02046f, .055241f, .073655f},
          {.030319f, .081862f, .109149f}},
         2e-3},
        {bsdf("plastic").color("diffuseReflectance", Color(0.8f, 0.4f, 0.1f)).boolean("nonlinear", true),
         {{.173119f, .059793f, .012134f},
          {.159531f, .0551f, .011182f},
          {.135511f, .046803f, .009498f},
          {.200213f, .069151f, .014033f}},
         2e-3},
        {bsdf("roughconductor").string("material", "none"),
         {grey(0.f), grey(9.947185f), grey(1.07948f), grey(.000184f)}},
        {bsdf("roughconductor").string("material", "none").number("alpha", 0.3),
         {grey(.04144f), grey(1.105243f), grey(.898648f), grey(.397015f)}},
        {ggx("roughconductor").string("material", "none"),
         {grey(.082755f), grey(1.078121f), grey(.711009f), grey(.269892f)}},
        {bsdf("roughconductor")
             .string("material", "none")
             .string("distribution", "ggx")
             .number("alphaU", 0.1)
             .number("alphaV", 0.4),
         {grey(.004806f), grey(2.479826f), grey(1.052192f), grey(.020902f)}},
        {bsdf("roughconductor").string("material", "Au").number("alpha", 0.3),
         {{.040059f, .033235f, .013436f},
          {1.067741f, .885605f, .363675f},
          {.86783f, .719852f, .298527f},
          {.383771f, .318385f, .128791f}}},
        {bsdf("roughconductor")
             .color("eta", Color(0.2f, 0.9f, 1.1f))
             .color("k", Color(3.9f, 2.4f, 2.1f))
             .number("alpha", 0.3),
         {{.039448f, .025518f, .020769f},
          {1.051206f, .680431f, .555882f},
          {.854263f, .553348f, .453141f},
          {.377919f, .244469f, .198994f}}},
        {bsdf("roughconductor")
             .string("material", "none")
             .color("specularReflectance", Color(0.2f, 0.4f, 0.8f))
             .number("alpha", 0.3),
         {{.008288f, .016576f, .033152f},
          {.221049f, .442097f, .884194f},
          {.17973f, .359459f, .718919f},
          {.079403f, .158806f, .317612f}}},
        {bsdf("roughdielectric"), {grey(0.f), grey(.442173f), grey(.051029f), grey(7e-06f)}},
        {ggx("roughdielectric"),
         {grey(.003361f), grey(.047925f), grey(.033611f), grey(.010992f), grey(0.f), grey(9.129216f)}},
        // The transmittances are integrals by other nodes.
        {bsdf("roughplastic"), {grey(.134121f), grey(.546464f), grey(.153802f), grey(.155159f)}, 6e-4},
        {ggx("roughplastic").color("diffuseReflectance", Color(0.8f, 0.4f, 0.1f)),
         {{.152897f, .078052f, .021918f},
          {.183231f, .114533f, .06301f},
          {.148127f, .090163f, .046691f},
          {.184773f, .09763f, .032273f}},
         6e-4},
        {ggx("roughplastic").color("diffuseReflectance", Color(0.8f, 0.4f, 0.1f)).boolean("nonlinear", true),
         {{.134713f, .056107f, .014741f},
          {.166541f, .094391f, .056422f},
          {.134045f, .073169f, .041132f},
          {.163601f, .07208f, .023917f}},
         6e-4},
        {bsdf("principled"), {grey(.14049f), grey(.195994f), grey(.14994f), grey(.169321f)}},
        {orange("principled"),
         {{.220996f, .110727f, .028026f},
          {.741527f, .639675f, .563287f},
          {.215942f, .128701f, .06327f},
          {.257461f, .130135f, .034641f}}},
        {orange("principled").number("anisotropic", 0.8),
         {{.221206f, .110937f, .028236f},
          {.73841f, .636558f, .560169f},
          {.181567f, .094326f, .028895f},
          {.280547f, .153222f, .057728f}}},
        {orange("principled").number("clearcoat", 1.0).number("clearcoatGloss", 0.9),
         {{.222157f, .111888f, .029187f},
          {3.090169f, 2.988318f, 2.911929f},
          {.226748f, .139507f, .074076f},
          {.260948f, .133623f, .038129f}},
         2e-4}, // the peak of their coat is rounded
        {orange("principled").number("eta", 1.5),
         {{.220996f, .110727f, .028026f},
          {.741527f, .639675f, .563287f},
          {.215942f, .128701f, .06327f},
          {.257461f, .130135f, .034641f}}},
        {orange("principled").number("flatness", 1.0),
         {{.165914f, .083187f, .021141f},
          {.696962f, .617393f, .557716f},
          {.188249f, .114854f, .059809f},
          {.179645f, .091227f, .024914f}}},
        {orange("principled").number("metallic", 0.5),
         {{.11508f, .057655f, .014586f},
          {5.272187f, 2.77153f, .896037f},
          {.463162f, .242158f, .076405f},
          {.156697f, .079051f, .020816f}}},
        {orange("principled").number("metallic", 1.0),
         {{.009164f, .004582f, .001146f},
          {9.802848f, 4.903384f, 1.228787f},
          {.710381f, .355614f, .089539f},
          {.055932f, .027966f, .006992f}}},
        {orange("principled").number("sheen", 1.0).number("sheenTint", 0.5),
         {{.220996f, .110727f, .028026f},
          {.741876f, .639914f, .563442f},
          {.216834f, .129311f, .063668f},
          {.257462f, .130136f, .034641f}}},
        {orange("principled").number("specTint", 1.0),
         {{.221328f, .110664f, .027666f},
          {1.05342f, .528671f, .135108f},
          {.236573f, .11871f, .030313f},
          {.259479f, .12974f, .032435f}}},
        {orange("principled").number("specTrans", 0.7).number("eta", 1.5),
         {{.06662f, .03354f, .008729f},
          {.598935f, .568379f, .545463f},
          {.093805f, .067632f, .048003f},
          {.079205f, .041008f, .012359f},
          grey(0.f),
          {65.162849f, 46.077095f, 23.038548f}}},
        {orange("principled").number("specular", 0.0),
         {{.220536f, .110268f, .027567f},
          {.203703f, .101852f, .025463f},
          {.174482f, .087241f, .02181f},
          {.254651f, .127326f, .031831f}},
         3e-4},
        {orange("principled").number("specular", 1.0),
         {{.221454f, .111186f, .028485f},
          {1.240989f, 1.139138f, 1.062749f},
          {.252509f, .165268f, .099837f},
          {.260261f, .132935f, .037441f}}},
        {orange("principledthin").number("diffTrans", 0.6).number("specTrans", 0.3),
         {{.108201f, .054169f, .013646f},
          {.261162f, .211254f, .173824f},
          {.097934f, .055186f, .023125f},
          {.125622f, .063232f, .01644f},
          {.050456f, .025228f, .006307f},
          {.181408f, .090704f, .022676f}}},
    };
}

} // namespace

TEST_CASE("BSDFs have the values that Mitsuba 3 has", "[unit][bsdf][mitsuba]")
{
    const Vec3f wi(0.6f, 0.f, 0.8f);
    for (const MitsubaCase& one : cases()) {
        CAPTURE(one.params.text());
        const auto built = one.params.build_type(bsdf_types());
        for (std::size_t i = 0; i < one.values.size(); ++i) {
            CAPTURE(i);
            const Color value = built->evaluate(SurfacePoint(), wi, directions[i]).f_cos;
            for (int channel = 0; channel < 3; ++channel) {
                const double expected = one.values[i][channel];
                CHECK(value[channel] == Approx(expected).epsilon(one.tolerance).margin(1e-6));
            }
        }
    }
}

TEST_CASE("BSDFs reflect as much of a white sky as in Mitsuba 3", "[statistical][bsdf][mitsuba]")
{
    struct Plane {
        ParamsBuilder params;
        double radiance;
        double error; // five standard errors of theirs; of plastic, also what its fit is off
    };
    const Plane planes[] = {
        {bsdf("plastic"), .520031, 1.2e-3},
        {bsdf("roughplastic").color("diffuseReflectance", Color(1.f)), .968409, 1.3e-3},
        {bsdf("roughconductor").string("material", "none").number("alpha", 0.5), .943727, 1.5e-3},
        {bsdf("principled").color("baseColor", Color(1.f)), 1.04319, 2.7e-3},
        {bsdf("thindielectric"), 1.0, 1e-5},
    };
    for (const Plane& plane : planes) {
        const auto built = plane.params.build_type(bsdf_types());
        check_mean(
            plane.params.text(), plane.radiance,
            [&](std::uint64_t n, std::uint64_t seed) {
                TestRandom random(seed);
                MeanAndVariance mean;
                for (std::uint64_t i = 0; i < n; ++i) {
                    const float u_lobe = random.next_1d();
                    const Vec2f u = random.next_2d();
                    const auto sample = built->sample(SurfacePoint(), Vec3f(0.f, 0.f, 1.f), u_lobe, u);
                    mean.add(sample ? static_cast<double>(sample->weight.g) : 0.0);
                }
                return mean;
            },
            200'000, sidak_level(significance, std::size(planes)), 1, plane.error);
    }
}

TEST_CASE("a white plastic reflects all light", "[unit][bsdf]")
{
    for (const double interior : {1.1, 1.49, 2.4}) {
        const auto plastic = bsdf("plastic")
                                 .number("intIOR", interior)
                                 .number("extIOR", 1.0)
                                 .color("diffuseReflectance", Color(1.f))
                                 .build_type(bsdf_types());
        for (const float cosine : {1.f, 0.6f, 0.1f}) {
            CAPTURE(interior, cosine);
            const Vec3f wi(std::sqrt(1.f - cosine * cosine), 0.f, cosine);
            const auto of_base = [&](const Vec3f& wo) {
                return static_cast<double>(plastic->evaluate(SurfacePoint(), wi, wo).f_cos.g);
            };
            const auto coat = plastic->sample(SurfacePoint(), wi, 0.f, Vec2f(0.5f));
            REQUIRE((coat && coat->is_delta()));
            const double reflected = static_cast<double>(coat->weight.g) * coat->pdf;
            CHECK(reflected + integrate_sphere(SphereGrid{Vec3f(0, 0, 1), 1, 40, 8}, of_base) ==
                  Approx(1.0).epsilon(1e-4));
        }
    }
}

TEST_CASE("smooth conductors reflect after Fresnel's equations", "[unit][bsdf][mitsuba]")
{
    const auto along_normal = [](const ParamsBuilder& params) {
        const auto sample =
            params.build_type(bsdf_types())->sample(SurfacePoint(), Vec3f(0.f, 0.f, 1.f), 0.5f, Vec2f(0.5f));
        REQUIRE(sample);
        CHECK(sample->lobe == Lobe::delta_reflection);
        return sample->weight;
    };
    const Color gold = along_normal(bsdf("conductor").string("material", "Au"));
    CHECK(gold.r == Approx(.966679).epsilon(1e-5));
    CHECK(gold.g == Approx(.80201).epsilon(1e-5));
    CHECK(gold.b == Approx(.324121).epsilon(1e-5));
    CHECK(along_normal(bsdf("conductor")) == Color(1.f));

    // Without absorption it is a dielectric, and twice both indices are the same boundary.
    for (const float cosine : {1.f, 0.7f, 0.2f, 0.01f, 0.f}) {
        CAPTURE(cosine);
        const Vec3f wi(std::sqrt(1.f - cosine * cosine), 0.f, cosine);
        const auto plain = bsdf("conductor").color("eta", Color(1.5f)).color("k", Color(0.f));
        if (cosine == 0.f) continue;
        const auto metal = plain.build_type(bsdf_types())->sample(SurfacePoint(), wi, 0.f, Vec2f(0.f));
        const auto glass = bsdf("dielectric")
                               .number("intIOR", 1.5)
                               .number("extIOR", 1.0)
                               .build_type(bsdf_types())
                               ->sample(SurfacePoint(), wi, 0.f, Vec2f(0.f));
        REQUIRE((metal && glass));
        CHECK(metal->weight.g == Approx(glass->pdf).epsilon(1e-5));
    }
    CHECK(along_normal(bsdf("conductor").color("eta", Color(3.f)).color("k", Color(5.f)).number("extIOR", 2))
              .r ==
          Approx(along_normal(bsdf("conductor").color("eta", Color(1.5f)).color("k", Color(2.5f))).r));
}

TEST_CASE("thin glass lets 1 - 2 R / (1 + R) straight through", "[unit][bsdf][mitsuba]")
{
    const auto pane =
        bsdf("thindielectric").number("intIOR", 1.5).number("extIOR", 1.0).build_type(bsdf_types());
    const Vec3f wi(0.f, 0.f, 1.f);
    const auto through = pane->sample(SurfacePoint(), wi, 0.9f, Vec2f(0.f));
    REQUIRE(through);
    CHECK(through->pdf == Approx(1.0 - 0.08 / 1.04).epsilon(1e-5));
    CHECK(through->wo == -wi);
    CHECK(through->eta == 1.f);
    CHECK(through->weight == Color(1.f));
}

TEST_CASE("conductors name what is wrong", "[unit][bsdf]")
{
    const auto message = [](const ParamsBuilder& params) {
        std::vector<Diagnostic> found;
        for (const auto& entry : bsdf_types())
            if (entry.name == params.type()) params.build_with(entry.build, found);
        return found.size() == 1 ? found.front().message : "not one message";
    };
    CHECK(
        message(bsdf("conductor").string("material", "Gold")).starts_with("material 'Gold' is not known; "));
    CHECK(message(bsdf("conductor").string("material", "au")) ==
          "material 'au' is not known; did you mean 'Au'?");
    CHECK(message(bsdf("conductor").string("material", "Au").color("eta", Color(1.f))) ==
          "material cannot be given together with eta or k");
    CHECK(message(bsdf("roughconductor").string("material", "Au").color("R0", Color(1.f))) ==
          "R0 cannot be given together with material, eta, k or extIOR");
    CHECK(message(bsdf("principled").number("eta", 1.5).number("specular", 0.5)) ==
          "specular cannot be given together with eta");
    CHECK(message(bsdf("roughdielectric").number("alpha", 0.1).number("alphaU", 0.2).number("alphaV", 0.2)) ==
          "alpha has no effect where both alphaU and alphaV are given; remove it");
    CHECK(message(bsdf("roughplastic").string("distribution", "phong")) ==
          "distribution must be 'beckmann' or 'ggx', not 'phong'");
}
