// SPDX-License-Identifier: MIT
#include "plumb/model/dialect.h"

namespace plumb {

std::string_view to_string(DialectName name)
{
    switch (name) {
    case DialectName::plumb: return "plumb";
    case DialectName::epfl: return "epfl";
    case DialectName::eth: return "eth";
    case DialectName::zaragoza: return "zaragoza";
    case DialectName::mcgill: return "mcgill";
    case DialectName::mitsuba3: return "mitsuba3";
    }
    return {};
}

std::optional<DialectName> dialect_from_string(std::string_view name)
{
    for (const DialectName dialect : all_dialects)
        if (to_string(dialect) == name) return dialect;
    return {};
}

Dialect Dialect::standard(DialectName name)
{
    Dialect dialect;
    dialect.name = name;
    switch (name) {
    case DialectName::plumb:
    case DialectName::epfl:
    case DialectName::mitsuba3: break;
    case DialectName::eth:
        dialect.mirrored_view = true;
        dialect.point_takes_power = true;
        break;
    case DialectName::zaragoza:
        dialect.emitters_absorb = true;
        dialect.environment_flipped = true;
        dialect.environment_scale = 1.f / 255.f; // pixels are divided by 255, whatever their format
        break;
    case DialectName::mcgill:
        dialect.emitters_absorb = true;
        dialect.sun_points_to_light = true;
        break;
    }
    return dialect;
}

} // namespace plumb
