// SPDX-License-Identifier: MIT
#pragma once

// Whether two headers (header.h) tell of the same work.

#include "plumb/image/image.h"
#include "plumb/settings/render_settings.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// The value of that name; empty if there is none or if it is no text.
std::string header_text(const Metadata& header, std::string_view name);

// The integer of that name; nothing if there is none.
std::optional<int> header_integer(const Metadata& header, std::string_view name);

// The version of the scene language that it was made with.
int language_of(const Metadata& header);

// Headers come from anybody. The following throw Error, naming the file and the entry.

// A number of samples per pixel; nothing if there is no such entry.
std::optional<std::uint64_t> header_samples(const Metadata& header, std::string_view name,
                                            const std::string& file);

// The settings that made the image: settings_header.h.
RenderSettings header_settings(const Metadata& header, const std::string& file);

// Whether the inputs are told by the hashes that Plumb 0.1 wrote: they are not comparable with SHA-256.
bool has_old_hashes(const Metadata& header);

// Who made the processors, by name; merge_parts() writes several.
inline constexpr const char* processor_entry = "plumb:processor";
// "the processor vendor was GenuineIntel and is AuthenticAMD", as sample_changes() says it.
std::string vendor_change(const Metadata& then, const Metadata& now);

// What is different in the files that were read, by plumb:inputs, and what options and dialect made of them, by
// plumb:inputHash: "'a.obj' has changed". Empty: nothing.
std::vector<std::string> input_changes(const Metadata& then, const Metadata& now);

// That, and whatever else changes a sample: program and its code, seed, integrator, instruction set and so on. Empty: samples of the one
// belong together with those of the other.
std::vector<std::string> sample_changes(const Metadata& then, const Metadata& now);

} // namespace plumb
