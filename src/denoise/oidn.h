// SPDX-License-Identifier: MIT
#pragma once

// The door to Open Image Denoise 2: its functions, declared as in its manual
// (https://www.openimagedenoise.org/documentation.html, "Open Image Denoise API"), and found in the library when it is needed.

#include <cstddef>
#include <string>

namespace plumb::oidn {

using Device = struct DeviceImpl*;
using Filter = struct FilterImpl*;

inline constexpr int cpu = 1;    // OIDN_DEVICE_TYPE_CPU
inline constexpr int float3 = 3; // OIDN_FORMAT_FLOAT3

struct Library {
    Device (*new_device)(int type);
    void (*set_device_int)(Device, const char* name, int value);
    void (*set_device_bool)(Device, const char* name, bool value);
    int (*get_device_int)(Device, const char* name);
    int (*get_device_error)(Device, const char** message); // 0: none; forgets it
    void (*commit_device)(Device);
    void (*release_device)(Device);
    Filter (*new_filter)(Device, const char* type);
    void (*set_shared_filter_image)(Filter, const char* name, void* pixels, int format, std::size_t width,
                                    std::size_t height, std::size_t offset, std::size_t pixel_stride,
                                    std::size_t row_stride);
    void (*set_filter_bool)(Filter, const char* name, bool value);
    void (*commit_filter)(Filter);
    void (*execute_filter)(Filter);
    void (*release_filter)(Filter);
};

// Loaded once: the file that the environment variable PLUMB_OIDN names, or the one that tools/install-denoiser has installed for
// this user, or else the system's. Throws Error with where to get it.
const Library& library();

} // namespace plumb::oidn
