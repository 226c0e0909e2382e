// SPDX-License-Identifier: MIT

#include "shapes/obj/obj_number.h"

#include <charconv>
#include <cmath>

namespace plumb {

namespace {

// Whether a number that from_chars found out of range is too small rather than too large: there is no exponent and
// it begins with 0, or the exponent is negative.
bool is_tiny(std::string_view digits)
{
    const std::size_t exponent = digits.find_first_of("eE");
    if (exponent != std::string_view::npos) return digits.substr(exponent + 1).starts_with('-');
    return digits.starts_with('0') || digits.starts_with('.');
}

} // namespace

ObjNumber parse_obj_number(std::string_view token)
{
    using Status = ObjNumber::Status;
    std::string_view digits = token;
    if (digits.starts_with('+')) {
        digits.remove_prefix(1);
        if (digits.starts_with('-')) return {Status::unreadable, 0.f};
    }
    float value = 0.f;
    const char* const end = digits.data() + digits.size();
    const std::from_chars_result result = std::from_chars(digits.data(), end, value);
    if (result.ec == std::errc::invalid_argument || result.ptr != end) return {Status::unreadable, 0.f};
    if (digits.starts_with('-')) digits.remove_prefix(1);
    if (result.ec == std::errc::result_out_of_range) {
        if (is_tiny(digits)) return {Status::good, 0.f};
        return {Status::too_large, 0.f};
    }
    if (std::isfinite(value)) return {Status::good, value};
    // "inf", or so many digits that the nearest float is infinity
    const bool digit_first = digits.find_first_of("0123456789") != std::string_view::npos;
    return {digit_first ? Status::too_large : Status::not_finite, 0.f};
}

std::string excerpt(std::string_view token)
{
    constexpr std::size_t longest = 40;
    std::string text(token.substr(0, longest));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f) c = '?';
    return token.size() > longest ? text + "..." : text;
}

} // namespace plumb
