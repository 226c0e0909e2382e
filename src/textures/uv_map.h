// SPDX-License-Identifier: MIT
#pragma once

// The parameter toUv of textures: an affine map of uv.

#include "plumb/model/params.h"

namespace plumb {

// The transform acts on (u, v, 0); what it does to the third coordinate is left out.
class UvMap {
public:
    explicit UvMap(const Params& params)
    {
        const Transform::Rows rows = params.transform("toUv").rows();
        u_ = Vec3f(Vec3d(rows[0][0], rows[0][1], rows[0][3]));
        v_ = Vec3f(Vec3d(rows[1][0], rows[1][1], rows[1][3]));
    }

    Vec2f operator()(const Vec2f& uv) const
    {
        return {u_.x * uv.x + u_.y * uv.y + u_.z, v_.x * uv.x + v_.y * uv.y + v_.z};
    }

    // The slope by uv of what has this slope by the mapped uv.
    Vec2f slope(const Vec2f& mapped) const
    {
        return {u_.x * mapped.x + v_.x * mapped.y, u_.y * mapped.x + v_.y * mapped.y};
    }

private:
    Vec3f u_; // (factor of u, factor of v, offset)
    Vec3f v_;
};

} // namespace plumb
