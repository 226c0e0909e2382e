// SPDX-License-Identifier: MIT
#include "image/bytes.h"

#include "base/regular_file.h"

namespace plumb {

ImageFileBytes::ImageFileBytes(const std::string& name)
{
    const RegularFile file(name);
    size_ = static_cast<std::size_t>(file.size());
    bytes_ = std::make_unique_for_overwrite<unsigned char[]>(size_);
    file.read(0, std::span(reinterpret_cast<char*>(bytes_.get()), size_));
}

} // namespace plumb
