// SPDX-License-Identifier: MIT

// [1] CIE 015:2018, Colorimetry, 4th edition: tables of the 1931 standard observer and of the illuminant D65.
// [2] IEC 61966-2-1:1999, the primaries and the white of sRGB, by the matrix of ITU-R BT.709.

#include "scene_file/spectra.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace plumb {

namespace {

constexpr double first_wavelength = 360.0, last_wavelength = 830.0, table_step = 5.0;
constexpr int steps = 1000; // of the integrals, both ends included, as in Mitsuba

// [1]: colour matching functions x, y, z, and the relative power of D65, which is 100 at 560 nm.
constexpr double standard_observer[][4] = {
    {0.0001299, 3.917e-06, 0.0006061, 46.6383},
    {0.0002321, 6.965e-06, 0.001086, 49.3637},
    {0.0004149, 1.239e-05, 0.001946, 52.0891},
    {0.0007416, 2.202e-05, 0.003486, 51.0323},
    {0.001368, 3.9e-05, 0.00645, 49.9755},
    {0.002236, 6.4e-05, 0.01055, 52.3118},
    {0.004243, 0.00012, 0.02005, 54.6482},
    {0.00765, 0.000217, 0.03621, 68.7015},
    {0.01431, 0.000396, 0.06785, 82.7549},
    {0.02319, 0.00064, 0.1102, 87.1204},
    {0.04351, 0.00121, 0.2074, 91.486},
    {0.07763, 0.00218, 0.3713, 92.4589},
    {0.13438, 0.004, 0.6456, 93.4318},
    {0.21477, 0.0073, 1.03905, 90.057},
    {0.2839, 0.0116, 1.3856, 86.6823},
    {0.3285, 0.01684, 1.62296, 95.7736},
    {0.34828, 0.023, 1.74706, 104.865},
    {0.34806, 0.0298, 1.7826, 110.936},
    {0.3362, 0.038, 1.77211, 117.008},
    {0.3187, 0.048, 1.7441, 117.41},
    {0.2908, 0.06, 1.6692, 117.812},
    {0.2511, 0.0739, 1.5281, 116.336},
    {0.19536, 0.09098, 1.28764, 114.861},
    {0.1421, 0.1126, 1.0419, 115.392},
    {0.09564, 0.13902, 0.81295, 115.923},
    {0.05795, 0.1693, 0.6162, 112.367},
    {0.03201, 0.20802, 0.46518, 108.811},
    {0.0147, 0.2586, 0.3533, 109.082},
    {0.0049, 0.323, 0.272, 109.354},
    {0.0024, 0.4073, 0.2123, 108.578},
    {0.0093, 0.503, 0.1582, 107.802},
    {0.0291, 0.6082, 0.1117, 106.296},
    {0.06327, 0.71, 0.07825, 104.79},
    {0.1096, 0.7932, 0.05725, 106.239},
    {0.1655, 0.862, 0.04216, 107.689},
    {0.22575, 0.91485, 0.02984, 106.047},
    {0.2904, 0.954, 0.0203, 104.405},
    {0.3597, 0.9803, 0.0134, 104.225},
    {0.43345, 0.99495, 0.00875, 104.046},
    {0.51205, 1, 0.00575, 102.023},
    {0.5945, 0.995, 0.0039, 100},
    {0.6784, 0.9786, 0.00275, 98.1671},
    {0.7621, 0.952, 0.0021, 96.3342},
    {0.8425, 0.9154, 0.0018, 96.0611},
    {0.9163, 0.87, 0.00165, 95.788},
    {0.9786, 0.8163, 0.0014, 92.2368},
    {1.0263, 0.757, 0.0011, 88.6856},
    {1.0567, 0.6949, 0.001, 89.3459},
    {1.0622, 0.631, 0.0008, 90.0062},
    {1.0456, 0.5668, 0.0006, 89.8026},
    {1.0026, 0.503, 0.00034, 89.5991},
    {0.9384, 0.4412, 0.00024, 88.6489},
    {0.85445, 0.381, 0.00019, 87.6987},
    {0.7514, 0.321, 0.0001, 85.4936},
    {0.6424, 0.265, 5e-05, 83.2886},
    {0.5419, 0.217, 3e-05, 83.4939},
    {0.4479, 0.175, 2e-05, 83.6992},
    {0.3608, 0.1382, 1e-05, 81.863},
    {0.2835, 0.107, 0, 80.0268},
    {0.2187, 0.0816, 0, 80.1207},
    {0.1649, 0.061, 0, 80.2146},
    {0.1212, 0.04458, 0, 81.2462},
    {0.0874, 0.032, 0, 82.2778},
    {0.0636, 0.0232, 0, 80.281},
    {0.04677, 0.017, 0, 78.2842},
    {0.0329, 0.01192, 0, 74.0027},
    {0.0227, 0.00821, 0, 69.7213},
    {0.01584, 0.005723, 0, 70.6652},
    {0.0113592, 0.004102, 0, 71.6091},
    {0.00811092, 0.002929, 0, 72.979},
    {0.00579035, 0.002091, 0, 74.349},
    {0.00410946, 0.001484, 0, 67.9765},
    {0.00289933, 0.001047, 0, 61.604},
    {0.00204919, 0.00074, 0, 65.7448},
    {0.00143997, 0.00052, 0, 69.8856},
    {0.000999949, 0.0003611, 0, 72.4863},
    {0.000690079, 0.0002492, 0, 75.087},
    {0.000476021, 0.0001719, 0, 69.3398},
    {0.000332301, 0.00012, 0, 63.5927},
    {0.000234826, 8.48e-05, 0, 55.0054},
    {0.00016615, 6e-05, 0, 46.4182},
    {0.000117413, 4.24e-05, 0, 56.6118},
    {8.3075e-05, 3e-05, 0, 66.8054},
    {5.8707e-05, 2.12e-05, 0, 65.0941},
    {4.151e-05, 1.499e-05, 0, 63.3828},
    {2.9353e-05, 1.06e-05, 0, 63.8434},
    {2.0674e-05, 7.466e-06, 0, 64.304},
    {1.456e-05, 5.258e-06, 0, 61.8779},
    {1.0254e-05, 3.703e-06, 0, 59.4519},
    {7.221e-06, 2.608e-06, 0, 55.7054},
    {5.086e-06, 1.837e-06, 0, 51.959},
    {3.582e-06, 1.293e-06, 0, 54.6998},
    {2.523e-06, 9.11e-07, 0, 57.4406},
    {1.777e-06, 6.42e-07, 0, 58.8765},
    {1.251e-06, 4.52e-07, 0, 60.3125},
};

// The factor that Mitsuba gives D65, 0.11 % less than what makes its luminance 1.
constexpr double d65_factor = 1.0 / 98.99741751876255;

using Function = std::function<double(double)>; // of the wavelength

double at(double wavelength, int column)
{
    const double place = (wavelength - first_wavelength) / table_step;
    const auto row = std::min(static_cast<std::size_t>(place), std::size(standard_observer) - 2);
    const double t = place - static_cast<double>(row);
    return (1.0 - t) * standard_observer[row][column] + t * standard_observer[row + 1][column];
}

double wavelength_of(int step)
{
    return first_wavelength + step * (last_wavelength - first_wavelength) / (steps - 1);
}

Vec3d xyz(const Function& spectrum)
{
    Vec3d sum(0.0);
    double white = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double wavelength = wavelength_of(i);
        const Vec3d observer(at(wavelength, 0), at(wavelength, 1), at(wavelength, 2));
        sum += observer * spectrum(wavelength);
        white += observer.y;
    }
    return sum / white;
}

Vec3d srgb(const Vec3d& c) // [2]
{
    const Vec3d rgb(3.240479 * c.x - 1.537150 * c.y - 0.498535 * c.z, //
                    -0.969256 * c.x + 1.875991 * c.y + 0.041556 * c.z,
                    0.055648 * c.x - 0.204043 * c.y + 1.057311 * c.z);
    return {std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0)};
}

double value_at(std::span<const SpectrumPoint> spectrum, double wavelength)
{
    const auto after =
        std::lower_bound(spectrum.begin(), spectrum.end(), wavelength,
                         [](const SpectrumPoint& point, double limit) { return point.wavelength < limit; });
    if (after == spectrum.end()) return 0.0;
    if (after->wavelength == wavelength) return after->value;
    if (after == spectrum.begin()) return 0.0;
    const SpectrumPoint &a = *(after - 1), &b = *after;
    const double t = (wavelength - a.wavelength) / (b.wavelength - a.wavelength);
    return (1.0 - t) * a.value + t * b.value;
}

} // namespace

Vec3d color_of_light(std::span<const SpectrumPoint> spectrum)
{
    return srgb(xyz([&](double wavelength) { return value_at(spectrum, wavelength); }));
}

Vec3d color_of_equal_energy()
{
    return srgb(Vec3d(1.0));
}

Vec3d color_under_d65(std::span<const SpectrumPoint> spectrum)
{
    return srgb(xyz(
        [&](double wavelength) { return value_at(spectrum, wavelength) * at(wavelength, 3) * d65_factor; }));
}

Vec3d color_of_black_body(double temperature)
{
    constexpr double h = 6.62607015e-34, c = 299792458.0, k = 1.380649e-23; // SI
    return srgb(xyz([&](double wavelength) {
        const double metres = wavelength * 1e-9;
        const double per_metre =
            2.0 * h * c * c / (std::pow(metres, 5.0) * std::expm1(h * c / (metres * k * temperature)));
        return per_metre * 1e-9;
    }));
}

} // namespace plumb
