// SPDX-License-Identifier: MIT
#pragma once

// libplumb_images.so without OpenImageIO: the formats that scenes and renderings use, each by its own library or by code of
// our own.

#include "image/image_module.h"

namespace plumb {

class LeanModule final : public ImageModule {
public:
    std::unique_ptr<PixelBuffer> make_buffer(const PixelRect& data, int full_width, int full_height,
                                             const std::vector<std::string>& channels,
                                             bool clear) const override;
    DecodedImage read(const std::string& name) const override;
    std::optional<ByteImage> read_bytes(const std::string& name) const override;
    void check_written_format(const std::string& name) const override;
    std::vector<unsigned char> encode(const ImageFile& image) const override;
    std::vector<unsigned char> encode_words(const WordImage& image, const FillRows& fill) const override;
    void read_words(const std::string& name, const ChooseChannels& choose, const UseRow& use) const override;
    std::string jpeg_decoder() const override;
};

} // namespace plumb
