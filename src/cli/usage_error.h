// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace plumb {

// The command line makes no sense: main() prints the message and exits with 2.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace plumb
