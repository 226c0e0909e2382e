// SPDX-License-Identifier: MIT

#include "image/image_words.h"

#include "base/regular_file.h"
#include "image/image_module.h"
#include "image/image_text.h"
#include "plumb/base/error.h"

#include <new>

namespace plumb {

std::vector<unsigned char> encode_words(const WordImage& image, const FillRows& fill)
{
    const ImageModule& module = image_module();
    try {
        return module.encode_words(image, fill);
    } catch (const std::bad_alloc&) {
        throw Error("not enough memory");
    } catch (const std::exception& error) { // ours, and whatever OpenImageIO lets through
        throw Error(reason_text(error.what()));
    }
}

void read_words(const std::filesystem::path& path, const ChooseChannels& choose, const UseRow& use)
{
    if (const std::string problem = problem_of_file(path); !problem.empty()) throw Error(problem);
    const ImageModule& module = image_module();
    try {
        module.read_words(path.string(), choose, use);
    } catch (const std::bad_alloc&) {
        throw Error("not enough memory");
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) { // whatever OpenImageIO lets through
        throw Error(reason_text(error.what()));
    }
}

} // namespace plumb
