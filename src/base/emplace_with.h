// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <type_traits>
#include <utility>

namespace plumb {

// Converts to what the function returns: an optional that is made from one builds its value where it stays. A copy
// would have to wait for all that was just written.
template <class Function>
class EmplaceWith {
public:
    explicit EmplaceWith(const Function& function) : function_(function) {}
    operator std::invoke_result_t<const Function&>() const { return function_(); }

private:
    const Function& function_;
};

// An optional of what the function returns, built in place.
template <class Function>
auto emplace_with(const Function& function)
{
    using Value = std::invoke_result_t<const Function&>;
    return std::optional<Value>(std::in_place, EmplaceWith<Function>(function));
}

} // namespace plumb
