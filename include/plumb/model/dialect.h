// SPDX-License-Identifier: MIT
#pragma once

// The readings on which the courses' dialects of the scene language disagree, and which one is in force.

#include <optional>
#include <string>
#include <string_view>

namespace plumb {

// The last one is not a course's: `version` at the root of a file says so, and nothing else does.
enum class DialectName { plumb, epfl, eth, zaragoza, mcgill, mitsuba3 };

// Those that the command line and the dialect attribute can name.
inline constexpr DialectName all_dialects[] = {DialectName::plumb, DialectName::epfl, DialectName::eth,
                                               DialectName::zaragoza, DialectName::mcgill};

std::string_view to_string(DialectName name);
std::optional<DialectName> dialect_from_string(std::string_view name); // nothing for unknown names and "auto"

struct Dialect {
    DialectName name = DialectName::plumb;
    bool mirrored_view = false;       // the image is flopped left to right
    bool emitters_absorb = false;     // a path that meets an emitter ends there
    bool point_takes_power = false;   // the default unit of <emitter type="point">: power, not radiance
    bool environment_flipped = false; // environment lookups run against u and v
    float environment_scale = 1.f;    // multiplies every value read from an environment image
    bool sun_points_to_light = false; // `direction` of directional light is where it comes from
    std::string reason;               // why this dialect is in force, for the log and the EXR header

    static Dialect standard(DialectName name); // that course's readings, with an empty reason
};

} // namespace plumb
