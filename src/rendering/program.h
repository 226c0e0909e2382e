// SPDX-License-Identifier: MIT
#pragma once

// Which program this is: two with the same version number may not take the same samples.

#include <string>

namespace plumb {

// A hash of the file that this process was started from and of Plumb's image library, as they were then, whatever lies in
// their places now; the same on all machines that have the same files. "unknown" if they cannot be read. Loads the library.
const std::string& hash_of_program();

} // namespace plumb
