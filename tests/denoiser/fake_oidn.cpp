// SPDX-License-Identifier: MIT

// Stands in for Open Image Denoise 2 where tests need what it is told, and not what it makes of it: a library with the functions
// that Plumb calls. It multiplies what it filters: a guide that is filtered alone by 1 (and says so below), colours by 0.5,
// by 0.25 if there is a clean albedo, and by 0.125 if there is a clean normal as well. Its version is 2.99.7.

#include <cmath>
#include <cstddef>
#include <map>
#include <string>

namespace {

struct Picture {
    float* values = nullptr;
    std::size_t count = 0; // floats
};

struct Device {
    bool committed = false;
};

struct Filter {
    Device* device = nullptr;
    std::map<std::string, Picture> pictures;
    std::map<std::string, bool> switches;
    bool committed = false;
};

const char* problem = nullptr;

void fail(const char* message)
{
    if (!problem) problem = message;
}

} // namespace

extern "C" {

Device* oidnNewDevice(int type)
{
    return type == 1 ? new Device() : nullptr;
}

void oidnSetDeviceInt(Device*, const char*, int) {}
void oidnSetDeviceBool(Device*, const char*, bool) {}

int oidnGetDeviceInt(Device*, const char* name)
{
    return std::string(name) == "version" ? 29907 : 0;
}

int oidnGetDeviceError(Device*, const char** message)
{
    if (message) *message = problem;
    const int code = problem ? 2 : 0;
    problem = nullptr;
    return code;
}

void oidnCommitDevice(Device* device)
{
    device->committed = true;
}

void oidnReleaseDevice(Device* device)
{
    delete device;
}

Filter* oidnNewFilter(Device* device, const char* type)
{
    if (!device->committed || std::string(type) != "RT") fail("no such filter");
    return new Filter{device, {}, {}, false};
}

void oidnSetSharedFilterImage(Filter* filter, const char* name, void* pixels, int format, std::size_t width,
                              std::size_t height, std::size_t offset, std::size_t pixel_stride,
                              std::size_t row_stride)
{
    if (format != 3 || offset != 0 || pixel_stride != 0 || row_stride != 0)
        fail("a format that nobody expects");
    filter->pictures[name] = {static_cast<float*>(pixels), 3 * width * height};
}

void oidnSetFilterBool(Filter* filter, const char* name, bool value)
{
    filter->switches[name] = value;
}

void oidnCommitFilter(Filter* filter)
{
    filter->committed = true;
}

void oidnExecuteFilter(Filter* filter)
{
    auto& pictures = filter->pictures;
    if (!filter->committed || !pictures.contains("output")) return fail("not ready");
    const char* input = pictures.contains("color")    ? "color"
                        : pictures.contains("albedo") ? "albedo"
                                                      : "normal";
    float factor = 1.f;
    if (pictures.contains("color")) {
        factor = 0.5f;
        if (!filter->switches["hdr"]) return fail("the colours are those of light");
        const bool has_guide = pictures.contains("albedo") || pictures.contains("normal");
        if (has_guide != filter->switches["cleanAux"]) return fail("guides must be filtered first");
        if (pictures.contains("albedo")) factor *= 0.5f;
        if (pictures.contains("normal")) factor *= 0.5f;
    }
    const Picture from = pictures.at(input), to = pictures.at("output");
    for (std::size_t i = 0; i < from.count; ++i) {
        if (from.values[i] == 666.f) return fail("the devil is in it"); // so that tests see an error
        to.values[i] = from.values[i] * factor;
    }
}

void oidnReleaseFilter(Filter* filter)
{
    delete filter;
}

} // extern "C"
