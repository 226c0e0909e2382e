// SPDX-License-Identifier: MIT
#pragma once

// Reading and writing the rows of OpenEXR's files, with as many threads as there are processors.

#include "base/regular_file.h"
#include "image/image_text.h"
#include "image/lean/exr_header.h"
#include "plumb/base/error.h"

#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>

#include <memory>
#include <new>
#include <string>
#include <vector>

namespace plumb::lean {

// Rows of pixels, which have so many bytes, the first channel first, whose values have 4 bytes.
class ExrInput {
public:
    explicit ExrInput(const std::string& name);

    // From that row, counted from the top of the data window. The file's values are converted to these types.
    void read_rows(int top, int count, const std::vector<Imf::PixelType>& types, void* rows);

    Metadata metadata() const;

private:
    class Stream final : public Imf::IStream {
    public:
        explicit Stream(const std::string& name) : Imf::IStream(name.c_str()), file_(name) {}
        bool read(char bytes[], int count) override;
        std::uint64_t tellg() override { return position_; }
        void seekg(std::uint64_t position) override { position_ = position; }

    private:
        RegularFile file_;
        std::uint64_t position_ = 0;
    };

    Stream stream_;
    Imf::MultiPartInputFile file_;
    std::unique_ptr<Imf::InputPart> part_;

public:
    Windows windows;
    std::vector<Channel> channels;
};

class ExrOutput {
public:
    ExrOutput(Imf::Header header, const std::vector<Channel>& channels);

    // The next rows. Pixels are so many bytes apart.
    void write_rows(const PixelRect& window, std::size_t apart, const void* rows);

    std::vector<unsigned char> take(); // what the file will hold; ends it

private:
    class Stream final : public Imf::OStream {
    public:
        Stream() : Imf::OStream("memory") {}
        void write(const char bytes[], int count) override;
        std::uint64_t tellp() override { return position_; }
        void seekp(std::uint64_t position) override { position_ = position; }
        std::vector<unsigned char> bytes;

    private:
        std::size_t position_ = 0;
    };

    std::vector<Channel> channels_;
    Stream stream_;
    std::unique_ptr<Imf::OutputFile> file_;
};

// The action's result; OpenEXR's exceptions become Error.
template <class Action>
auto attempt_exr(const char* what, const Action& action)
{
    try {
        return action();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(std::string(what) + ": " + one_line(error.what()));
    }
}

} // namespace plumb::lean
