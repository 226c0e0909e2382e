// SPDX-License-Identifier: MIT
#include "bsdfs/by_face.h"

#include <algorithm>
#include <utility>

namespace plumb {

namespace {

class ByFace final : public Bsdf {
public:
    ByFace(std::vector<std::shared_ptr<const Bsdf>> bsdfs, std::vector<std::uint32_t> of_primitive)
        : bsdfs_(std::move(bsdfs)), of_primitive_(std::move(of_primitive))
    {
        for (const auto& bsdf : bsdfs_) lobes_ = lobes_ | bsdf->lobes();
    }

    Lobes lobes() const override { return lobes_; }
    bool is_oriented() const override { return any(&Bsdf::is_oriented); }
    bool has_back() const override { return any(&Bsdf::has_back); }
    bool is_reciprocal() const override { return all(&Bsdf::is_reciprocal); }
    bool conserves_energy() const override { return all(&Bsdf::conserves_energy); }
    float opacity(const SurfacePoint& at) const override { return of(at).opacity(at); }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        return of(at).evaluate(at, wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        return of(at).sample(at, wi, u_lobe, u);
    }

    Color albedo(const SurfacePoint& at, const Vec3f& wi) const override { return of(at).albedo(at, wi); }

private:
    const Bsdf& of(const SurfacePoint& at) const { return *bsdfs_[of_primitive_[at.primitive]]; }

    bool any(bool (Bsdf::*is_so)() const) const
    {
        return std::any_of(bsdfs_.begin(), bsdfs_.end(),
                           [&](const auto& bsdf) { return (bsdf.get()->*is_so)(); });
    }
    bool all(bool (Bsdf::*is_so)() const) const
    {
        return std::all_of(bsdfs_.begin(), bsdfs_.end(),
                           [&](const auto& bsdf) { return (bsdf.get()->*is_so)(); });
    }

    std::vector<std::shared_ptr<const Bsdf>> bsdfs_;
    std::vector<std::uint32_t> of_primitive_;
    Lobes lobes_;
};

} // namespace

std::shared_ptr<const Bsdf> bsdf_by_face(std::vector<std::shared_ptr<const Bsdf>> bsdfs,
                                         std::vector<std::uint32_t> of_primitive)
{
    return std::make_shared<const ByFace>(std::move(bsdfs), std::move(of_primitive));
}

} // namespace plumb
