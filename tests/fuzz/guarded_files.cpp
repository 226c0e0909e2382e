// SPDX-License-Identifier: MIT

// Stands in for src/base/temporary_file.cpp: files are written into the target's own directory and nowhere else, whatever an
// input asks for. To ask for it is a finding.

#include "base/temporary_file.h"
#include "fuzz/fuzz.h"
#include "plumb/base/error.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

namespace plumb {

std::filesystem::path end_of_links(const std::filesystem::path& path)
{
    return path;
}

std::filesystem::path unfinished_name(const std::filesystem::path& path, std::string_view suffix)
{
    std::filesystem::path name = path;
    return name += fmt::format(".{}", suffix);
}

TemporaryFile::TemporaryFile(const std::filesystem::path& target)
    : target_(target), final_(target), path_(target)
{
    fuzz::expect(target.parent_path() == fuzz::directory(),
                 "a file is written where the input says: " + target.string());
    path_ += ".part";
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (descriptor_ < 0) throw Error("cannot write '" + target.string() + "'"); // a name too long, say
}

TemporaryFile::~TemporaryFile()
{
    if (descriptor_ >= 0) ::close(descriptor_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

void TemporaryFile::write(std::span<const unsigned char> bytes)
{
    const auto written = ::write(descriptor_, bytes.data(), bytes.size());
    fuzz::expect(written == static_cast<ssize_t>(bytes.size()), "the disk is full");
}

void TemporaryFile::write(std::string_view text)
{
    write(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

void TemporaryFile::flush() {}

void TemporaryFile::take_place()
{
    std::filesystem::rename(path_, final_);
}

void flush_directory_of(const std::filesystem::path&) {}

} // namespace plumb
