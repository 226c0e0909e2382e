// SPDX-License-Identifier: MIT

#include "bsdfs/conductor_fresnel.h"

#include "bsdfs/conductor_materials.h"
#include "bsdfs/fresnel.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr ConductorMaterial perfect{"none", Color(0.f), Color(1.f)};

ConductorMaterial material_of(const Params& params, const std::string& name)
{
    if (name.empty() || name == perfect.name) return perfect;
    const auto known = conductor_materials();
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const ConductorMaterial& one) { return one.name == name; });
    if (found != known.end()) return *found;
    std::vector<std::string_view> names = {perfect.name};
    for (const ConductorMaterial& one : known) names.push_back(one.name);
    params.fail("material", fmt::format("'{}' is not known{}", name, way_out(name, names)));
    return perfect;
}

} // namespace

ConductorFresnel::ConductorFresnel(const Params& params)
    : scale_(params.color_texture("specularReflectance", Color(1.f), Range::closed(0.0, 1.0)))
{
    const std::string name = params.string("material", {});
    const ConductorMaterial material = material_of(params, name);
    const float exterior = params.number("extIOR", 0.f, Range::closed(0.01, 100.0));
    const bool has_index = params.has("eta") || params.has("k");
    is_asked_for_ = !name.empty() || exterior > 0.f || has_index;
    exterior_ = exterior > 0.f ? exterior : 1.f;
    if (!name.empty() && has_index) params.fail("material", "cannot be given together with eta or k");
    eta_ = params.color_texture("eta", material.eta);
    k_ = params.color_texture("k", material.k);
}

Color ConductorFresnel::reflectance(const SurfacePoint& at, float cos_i) const
{
    const Color eta = eta_->color(at), k = k_->color(at);
    const auto channel = [&](int i) {
        return fresnel_conductor(cos_i, eta[i] / exterior_, k[i] / exterior_);
    };
    return Color(channel(0), channel(1), channel(2)) * scale_->color(at);
}

} // namespace plumb
