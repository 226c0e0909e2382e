// SPDX-License-Identifier: MIT
#include "rendering/program.h"

#include "plumb/base/hash.h"
#include "plumb/image/image.h"

namespace plumb {

const std::string& hash_of_program()
{
    static const std::string result = [] {
        const std::string program =
            hash_of_files({"/proc/self/exe"}); // the file itself, even if it was removed
        const std::string library = ImageLibrary::hash();
        if (program.empty() || library.empty()) return std::string("unknown");
        Hash128 hash;
        hash.update(program + library);
        return hash.hex();
    }();
    return result;
}

} // namespace plumb
