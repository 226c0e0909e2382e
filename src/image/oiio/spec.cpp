// SPDX-License-Identifier: MIT

#include "image/oiio/spec.h"

#include "image/image_limits.h"
#include "image/image_text.h"
#include "image/oiio/quiet.h"
#include "plumb/base/error.h"

#include <OpenImageIO/filesystem.h>

namespace plumb {

std::unique_ptr<OIIO::ImageInput> open_image(const std::string& name)
{
    OIIO::attribute("debug", 0); // never print
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1); // colours as they are in the file, not multiplied by alpha
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(name, &hints);
    if (!input) throw Error(one_line(OIIO::geterror()));
    return input;
}

PixelRect data_window_of(const OIIO::ImageSpec& spec)
{
    return seen_from_corner({spec.x, spec.y, spec.width, spec.height},
                            {spec.full_x, spec.full_y, spec.full_width, spec.full_height});
}

Metadata metadata_of(const OIIO::ImageSpec& spec)
{
    Metadata metadata;
    for (const OIIO::ParamValue& value : spec.extra_attribs) {
        const std::string name = value.name().string();
        const OIIO::TypeDesc type = value.type();
        const auto* const floats = static_cast<const float*>(value.data());
        if (type == OIIO::TypeInt)
            metadata.emplace_back(name, value.get_int());
        else if (type == OIIO::TypeFloat)
            metadata.emplace_back(name, value.get_float());
        else if (type == OIIO::TypeString)
            metadata.emplace_back(name, value.get_string());
        else if (type.basetype == OIIO::TypeDesc::FLOAT && type.numelements() > 0)
            metadata.emplace_back(name, std::vector<float>(floats, floats + type.basevalues()));
    }
    return metadata;
}

void put_metadata(OIIO::ImageSpec& spec, const Metadata& metadata)
{
    for (const auto& [name, value] : metadata) {
        if (const int* const integer = std::get_if<int>(&value)) {
            spec.attribute(name, *integer);
        } else if (const float* const number = std::get_if<float>(&value)) {
            spec.attribute(name, *number);
        } else if (const std::string* const text = std::get_if<std::string>(&value)) {
            spec.attribute(name, *text);
        } else {
            const auto& floats = std::get<std::vector<float>>(value);
            OIIO::TypeDesc type(OIIO::TypeDesc::FLOAT, static_cast<int>(floats.size()));
            if (floats.size() == 16) type = OIIO::TypeMatrix;
            if (!floats.empty()) spec.attribute(name, type, floats.data());
        }
    }
    // OpenImageIO adds the time of day unless there is a DateTime, and leaves out one that is no text.
    spec.attribute("DateTime", 0);
}

// Encoded in memory and written by us, because libjpeg ends the process if it cannot write.
std::vector<unsigned char> encode_image(const std::string& name, const OIIO::ImageSpec& spec,
                                        const std::function<bool(OIIO::ImageOutput&)>& write)
{
    OIIO::attribute("debug", 0); // never print
    const QuietStandardError quiet;
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
    if (!output) throw Error(OIIO::geterror());
    std::vector<unsigned char> file;
    file.reserve(spec.image_bytes(true)); // growing would copy it again and again
    OIIO::Filesystem::IOVecOutput memory(file);
    bool good = output->set_ioproxy(&memory) && output->open(name, spec) && write(*output);
    std::string reason = output->geterror();
    good = output->close() && good;
    reason += output->geterror(); // fetched in any case: what is not would be printed
    if (!good) throw Error(reason.empty() ? "this format cannot hold the image" : reason);
    return file;
}

} // namespace plumb
