// SPDX-License-Identifier: MIT
#pragma once

// What the program ends with.

namespace plumb::exit_code {

inline constexpr int done = 0;
inline constexpr int error = 1;     // the scene, a file or the machine
inline constexpr int usage = 2;     // the command line
inline constexpr int differs = 3;   // what was to agree does not, or there are doubts
inline constexpr int undecided = 4; // that cannot be told
inline constexpr int signal = 128;  // and the number of the signal that ended it

} // namespace plumb::exit_code
