// SPDX-License-Identifier: MIT
#include "rendering/output_files.h"

#include "base/parallel.h"
#include "base/temporary_file.h"
#include "base/text.h"

#include "plumb/base/error.h"
#include "plumb/denoise/denoise.h"
#include "plumb/image/image.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// The same for every name of a file; empty if there is none.
std::filesystem::path identity(const std::filesystem::path& file)
{
    std::error_code failed;
    const auto path =
        std::filesystem::weakly_canonical(std::filesystem::absolute(end_of_links(file), failed), failed);
    return failed ? std::filesystem::path() : path;
}

// A name in the directory that no file has: "a.exr", "a-1.exr", "a-2.exr" and so on.
std::filesystem::path free_name(const std::filesystem::path& directory, const std::filesystem::path& file)
{
    std::filesystem::path path = directory / file;
    std::error_code ignored;
    for (int i = 1; std::filesystem::exists(path, ignored); ++i)
        path = directory / fmt::format("{}-{}{}", file.stem().string(), i, file.extension().string());
    return path;
}

// An image may have taken long. If its directory is gone it goes into the refuge, or else the current directory. Where it is
// then, for a message; empty: nowhere.
std::string write_into_refuge(const std::filesystem::path& output, const Image& image,
                              const Development& development, Packing packing,
                              const std::filesystem::path& refuge)
{
    std::error_code ignored;
    if (!output.has_parent_path() || std::filesystem::exists(output.parent_path(), ignored)) return {};
    for (const std::filesystem::path& directory : {refuge, std::filesystem::path()}) {
        const std::filesystem::path path = free_name(directory, output.filename());
        try {
            write_image(path, image, development, packing);
            return fmt::format("; the image was written to '{}' instead", path.string());
        } catch (const Error&) { // the message is that of the file that was asked for
        }
    }
    return {};
}

bool any_for_screens(const std::vector<std::string>& files)
{
    return std::any_of(files.begin(), files.end(),
                       [](const std::string& file) { return is_for_screens(file); });
}

} // namespace

std::optional<std::string> listed_twice(const std::vector<std::string>& files)
{
    std::vector<std::filesystem::path> seen;
    for (const std::string& file : files) {
        const std::filesystem::path path = identity(file);
        if (path.empty()) continue;
        if (std::find(seen.begin(), seen.end(), path) != seen.end()) return file;
        seen.push_back(path);
    }
    return std::nullopt;
}

KeptFiles::KeptFiles(const std::vector<std::filesystem::path>& files)
{
    for (const std::filesystem::path& file : files)
        if (const auto path = identity(file); !path.empty()) identities_.insert(path);
}

bool KeptFiles::contains(const std::filesystem::path& file) const
{
    return identities_.contains(identity(file));
}

void KeptFiles::refuse(const std::vector<std::string>& outputs, std::string_view reason) const
{
    for (const std::string& file : outputs)
        if (contains(file)) throw Error(fmt::format("cannot write '{}': {}", file, reason));
}

Packing packing_of(const Evidence& evidence)
{
    return evidence.stop == interruption ? Packing::fast : Packing::small;
}

void check_denoising(const std::vector<std::string>& outputs, const OutputSettings& output)
{
    if (output.denoise && any_for_screens(outputs)) check_denoiser();
}

void write_images(const std::vector<std::string>& outputs, const Image& image, const OutputSettings& output,
                  Packing packing, const std::filesystem::path& refuge)
{
    std::vector<std::string> problem_of(outputs.size());
    std::optional<Image> clean;
    std::string problem; // of denoising: then files for screens are written as they are
    try {
        if (output.denoise && any_for_screens(outputs)) clean = denoised(image);
    } catch (const Error& error) {
        problem = error.what();
    }
    const auto image_for = [&](const std::string& file) -> const Image& {
        return clean && is_for_screens(file) ? *clean : image;
    };
    parallel_for(outputs.size(), 0, [&](std::size_t i) {
        try {
            write_image(outputs[i], image_for(outputs[i]), output.development, packing);
        } catch (const Error& error) {
            problem_of[i] = error.what();
        }
    });
    std::vector<std::string> problems;
    if (!problem.empty()) problems.push_back(problem);
    for (std::size_t i = 0; i < outputs.size(); ++i)
        if (!problem_of[i].empty())
            problems.push_back(problem_of[i] + write_into_refuge(outputs[i], image_for(outputs[i]),
                                                                 output.development, packing, refuge));
    if (!problems.empty()) throw Error(list_text(problems));
}

} // namespace plumb
