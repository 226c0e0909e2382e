// SPDX-License-Identifier: MIT

#include "plumb/model/texture.h"

#include "plumb/model/surface.h"

namespace plumb {

namespace {

SurfacePoint place_at(const Vec2f& uv)
{
    SurfacePoint at;
    at.uv = uv;
    return at;
}

} // namespace

Color ColorTexture::color_at_uv(const Vec2f& uv) const
{
    return color_at(place_at(uv));
}

float NumberTexture::number_at_uv(const Vec2f& uv) const
{
    return number_at(place_at(uv));
}

Vec2f NumberTexture::slope(const SurfacePoint&) const
{
    return Vec2f(0.f);
}

} // namespace plumb
