// SPDX-License-Identifier: MIT
#include "image/lean/exr_file.h"

#include "image/image_limits.h"

#include <Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfThreading.h>

#include <cstring>
#include <span>
#include <system_error>
#include <thread>

namespace plumb::lean {

namespace {

// OpenEXR's threads are the process's. Where the system has none for us it does with the one that calls.
void start_threads()
{
    static const bool started = [] {
        try {
            Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
        } catch (const std::system_error&) {
            return false;
        }
        return true;
    }();
    static_cast<void>(started);
}

constexpr std::size_t value_size = 4;

} // namespace

bool ExrInput::Stream::read(char bytes[], int count)
{
    const auto size = static_cast<std::size_t>(count);
    if (position_ > file_.size() || size > file_.size() - position_)
        throw Iex::InputExc("Unexpected end of file");
    file_.read(position_, std::span(bytes, size));
    position_ += size;
    return position_ < file_.size();
}

ExrInput::ExrInput(const std::string& name) : stream_((start_threads(), name)), file_(stream_)
{
    const Imf::Header& header = file_.header(0);
    if (header.hasType() && Imf::isDeepData(header.type()))
        throw Error("images with deep pixels are not supported");
    windows = windows_of(header);
    channels = channels_of(header);
    check_size(windows.data, channels.size());
    part_ = std::make_unique<Imf::InputPart>(file_, 0);
}

Metadata ExrInput::metadata() const
{
    Metadata metadata = metadata_of(file_.header(0));
    metadata.emplace_back("oiio:subimages", file_.parts());
    return metadata;
}

void ExrInput::read_rows(int top, int count, const std::vector<Imf::PixelType>& types, void* rows)
{
    const Imath::Box2i& window = file_.header(0).dataWindow();
    const Imath::V2i corner(window.min.x, window.min.y + top);
    const std::size_t pixel_size = channels.size() * value_size;
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < channels.size(); ++c)
        frame.insert(channels[c].name, Imf::Slice::Make(types[c], static_cast<char*>(rows) + c * value_size,
                                                        corner, windows.data.width, count, pixel_size));
    part_->setFrameBuffer(frame);
    part_->readPixels(corner.y, corner.y + count - 1);
}

void ExrOutput::Stream::write(const char new_bytes[], int count)
{
    const auto size = static_cast<std::size_t>(count);
    if (bytes.size() < position_ + size) bytes.resize(position_ + size);
    std::memcpy(bytes.data() + position_, new_bytes, size);
    position_ += size;
}

ExrOutput::ExrOutput(Imf::Header header, const std::vector<Channel>& channels) : channels_(channels)
{
    start_threads();
    const Imath::V2i size = header.dataWindow().size() + Imath::V2i(1, 1);
    const std::size_t values =
        static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * channels.size();
    stream_.bytes.reserve(values * value_size); // growing would copy it again and again
    for (const Channel& channel : channels)
        header.channels().insert(channel.name, Imf::Channel(channel.type));
    file_ = std::make_unique<Imf::OutputFile>(stream_, header);
}

void ExrOutput::write_rows(const PixelRect& window, std::size_t apart, const void* rows)
{
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < channels_.size(); ++c)
        frame.insert(channels_[c].name,
                     Imf::Slice::Make(channels_[c].type, static_cast<const char*>(rows) + c * value_size,
                                      Imath::V2i(window.x, window.y), window.width, window.height, apart));
    file_->setFrameBuffer(frame);
    file_->writePixels(window.height);
}

std::vector<unsigned char> ExrOutput::take()
{
    file_.reset();
    return std::move(stream_.bytes);
}

} // namespace plumb::lean
