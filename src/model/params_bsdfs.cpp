// SPDX-License-Identifier: MIT
// BSDFs inside BSDFs.

#include "plumb/model/bsdf.h"
#include "plumb/model/params.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

class BlackBsdf final : public Bsdf {
public:
    Lobes lobes() const override { return Lobe::diffuse_reflection; }
    BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f&) const override { return {}; }
    std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3f&, float, const Vec2f&) const override
    {
        return std::nullopt;
    }
};

} // namespace

std::shared_ptr<const Bsdf> Params::bsdf(std::size_t i) const
{
    if (i < bsdfs_.size()) {
        bsdfs_[i].asked = true;
        if (bsdfs_[i].bsdf) return bsdfs_[i].bsdf;
    } else {
        diagnostics_.error(element_at_,
                           fmt::format("{} '{}' needs {} inside it: <bsdf type=\"diffuse\"/>", written_kind(),
                                       written_type(), i == 0 ? "a <bsdf>" : "one more <bsdf>"));
    }
    return std::make_shared<BlackBsdf>();
}

void Params::fail_bsdf(std::size_t i, std::string message) const
{
    diagnostics_.error(bsdfs_[i].at, std::move(message));
}

void Params::reject_unused_bsdfs() const
{
    const auto asked =
        std::count_if(bsdfs_.begin(), bsdfs_.end(), [](const BsdfChild& child) { return child.asked; });
    const std::string takes = asked == 0   ? std::string("no <bsdf> inside it")
                              : asked == 1 ? std::string("one <bsdf> inside it")
                                           : fmt::format("{} <bsdf> inside it", asked);
    for (const BsdfChild& child : bsdfs_)
        if (!child.asked)
            diagnostics_.add(lenient_ ? Severity::warning : Severity::error, child.at,
                             fmt::format("{} '{}' takes {}", written_kind(), written_type(), takes));
}

} // namespace plumb
