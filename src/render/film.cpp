// SPDX-License-Identifier: MIT

#include "plumb/render/film.h"

#include "base/parallel.h"
#include "plumb/base/error.h"
#include "render/fixed_sum.h"
#include "render/layer_sums.h"
#include "render/share_rounding.h"

#include <array>
#include <mutex>
#include <new>
#include <unordered_map>

#include <fmt/format.h>

namespace plumb {
namespace {

constexpr double unit = fixed_unit;
constexpr double units_per_one = fixed_units_per_one;

} // namespace

// Threads share it; integer sums make their order irrelevant.
struct Film::LargeSquares {
    std::mutex mutex;
    std::unordered_map<std::size_t, std::array<FixedSum, 3>> of_pixel;

    void add(std::size_t pixel, int channel, double square)
    {
        const std::lock_guard lock(mutex);
        of_pixel[pixel][static_cast<std::size_t>(channel)] += to_fixed(square / fixed_large_unit);
    }

    FixedSum sum(std::size_t pixel, int channel) const
    {
        const auto found = of_pixel.find(pixel);
        return found == of_pixel.end() ? 0 : found->second[static_cast<std::size_t>(channel)];
    }
};

Film::Film(PixelRect window, int full_width, int full_height, ChannelSet layers, Plans plans)
    : window_(window),
      full_width_(full_width),
      full_height_(full_height),
      large_squares_(std::make_unique<LargeSquares>())
{
    if (layers.size() > max_layers)
        throw Error(fmt::format("a film has at most {} layers, not {}", max_layers, layers.size()));
    const std::size_t bytes = bytes_per_pixel(layers, plans);
    const std::size_t pixels =
        static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
    try {
        pixels_.resize(pixels);
        if (!layers.empty()) layers_ = std::make_unique<LayerSums>(std::move(layers), pixels);
        if (plans == Plans::kept) plans_.resize(pixels);
    } catch (const std::bad_alloc&) {
        throw Error(fmt::format("not enough memory for a film of {}x{} pixels ({} bytes each)", window.width,
                                window.height, bytes));
    }
    static_assert(sizeof(Pixel) == 112);
}

std::size_t Film::bytes_per_pixel(const ChannelSet& layers, Plans plans)
{
    return sizeof(Pixel) + LayerSums::bytes_per_pixel(layers) +
           (plans == Plans::kept ? sizeof(std::uint32_t) : 0);
}

Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;
Film::~Film() = default;

const ChannelSet& Film::layers() const
{
    static const ChannelSet none;
    return layers_ ? layers_->layers() : none;
}

std::size_t Film::index(Vec2i pixel) const
{
    const auto column = static_cast<std::size_t>(pixel.x - window_.x);
    const auto row = static_cast<std::size_t>(pixel.y - window_.y);
    return row * static_cast<std::size_t>(window_.width) + column;
}

SampleStatus Film::add(Vec2i pixel, const Color& radiance, float weight)
{
    if (!is_finite(radiance)) return SampleStatus::not_finite;
    if (min_component(radiance) < 0.f) return SampleStatus::negative;
    const Color value = radiance * weight;
    if (!(max_component(value) < film_max_value && min_component(value) > -film_max_value))
        return SampleStatus::out_of_range;
    const std::size_t at = index(pixel);
    ++pixels_[at].count;
    if (value.is_black()) return SampleStatus::accepted;
    ++pixels_[at].contributing;
    add_channel(at, 0, value.r);
    add_channel(at, 1, value.g);
    add_channel(at, 2, value.b);
    return SampleStatus::accepted;
}

SampleStatus Film::add(Vec2i pixel, const Color& radiance, float weight, const LayerSample& layers,
                       std::uint64_t number)
{
    const SampleStatus status = add(pixel, radiance, weight);
    if (layers_ && status == SampleStatus::accepted) layers_->add(index(pixel), weight, layers, number);
    return status;
}

void Film::add_channel(std::size_t pixel, int channel, float value)
{
    Pixel& p = pixels_[pixel];
    const double x = value; // its square is exact
    p.sum[channel] += to_fixed(x * units_per_one);
    if (std::abs(value) < fixed_large_value) [[likely]]
        p.squares[channel] += to_fixed(x * x * units_per_one);
    else
        large_squares_->add(pixel, channel, x * x);
}

std::uint64_t Film::sample_count(Vec2i pixel) const
{
    return pixels_[index(pixel)].count;
}

std::uint64_t Film::contributing_count(Vec2i pixel) const
{
    return pixels_[index(pixel)].contributing;
}

double Film::mean(std::size_t pixel, int channel) const
{
    const Pixel& p = pixels_[pixel];
    return p.count == 0 ? 0.0 : static_cast<double>(p.sum[channel]) * unit / static_cast<double>(p.count);
}

double Film::variance_of_mean(std::size_t pixel, int channel) const
{
    const Pixel& p = pixels_[pixel];
    if (p.count < 2) return std::numeric_limits<double>::quiet_NaN();
    return plumb::variance_of_mean(p.sum[channel], p.squares[channel], large_squares_->sum(pixel, channel),
                                   p.count);
}

Color Film::variance_of_mean(Vec2i pixel) const
{
    const std::size_t at = index(pixel);
    return {static_cast<float>(variance_of_mean(at, 0)), static_cast<float>(variance_of_mean(at, 1)),
            static_cast<float>(variance_of_mean(at, 2))};
}

std::vector<std::string> Film::channel_names() const
{
    std::vector<std::string> names = {"R", "G", "B"};
    for (const Layer& layer : layers())
        for (std::size_t c = 0; c < layer.components.size(); ++c) names.push_back(layer.channel(c));
    return names;
}

std::vector<float> Film::develop(const PixelRect& part) const
{
    const std::size_t channels = channel_names().size();
    std::vector<float> values(channels * static_cast<std::size_t>(part.width) *
                              static_cast<std::size_t>(part.height));
    float* out = values.data();
    for (int y = part.y; y < part.y + part.height; ++y) {
        for (int x = part.x; x < part.x + part.width; ++x, out += channels) {
            const std::size_t at = index({x, y});
            for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(mean(at, c));
            if (layers_) layers_->develop(at, pixels_[at].count, out + 3);
        }
    }
    return values;
}

Image Film::develop(Channels channels) const
{
    const bool evidence = channels == Channels::color_and_evidence;
    std::vector<std::string> names = channel_names();
    const bool counts = evidence && plans() == Plans::kept;
    const std::size_t beauty = counts ? 8 : evidence ? 7 : 3;
    if (evidence) names.insert(names.begin() + 3, {"variance.R", "variance.G", "variance.B", "contributing"});
    if (counts) names.insert(names.begin() + 7, "samples");
    Image image(window_, full_width_, full_height_, std::move(names));
    const std::vector<ShareFamily> families = share_families(layers());
    parallel_for(static_cast<std::size_t>(window_.height), 0, [&](std::size_t row) {
        const int y = window_.y + static_cast<int>(row);
        for (int x = window_.x; x < window_.x + window_.width; ++x) {
            const std::size_t at = index({x, y});
            float* out = image.pixel(x, y);
            for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(mean(at, c));
            if (layers_) layers_->develop(at, pixels_[at].count, out + beauty);
            for (const ShareFamily& family : families) make_shares_add_up(family, out + beauty, out);
            if (!evidence) continue;
            for (int c = 0; c < 3; ++c) out[3 + c] = static_cast<float>(variance_of_mean(at, c));
            out[6] = static_cast<float>(pixels_[at].contributing);
            if (counts) out[7] = static_cast<float>(pixels_[at].count);
        }
    });
    return image;
}

Film& Film::operator+=(const Film& other)
{
    if (layers() != other.layers())
        throw Error(fmt::format("films with different layers cannot be added: one has {}, the other {}",
                                layer_names(layers()), layer_names(other.layers())));
    if (plans() != other.plans())
        throw Error("films of which one keeps plans and the other does not cannot be added");
    // A plan is a function of the pixel: whoever has one has the same.
    for (std::size_t i = 0; i < plans_.size(); ++i) plans_[i] = std::max(plans_[i], other.plans_[i]);
    if (layers_) *layers_ += *other.layers_;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        Pixel& mine = pixels_[i];
        const Pixel& theirs = other.pixels_[i];
        for (int c = 0; c < 3; ++c) {
            mine.sum[c] += theirs.sum[c];
            mine.squares[c] += theirs.squares[c];
        }
        mine.count += theirs.count;
        mine.contributing += theirs.contributing;
    }
    for (const auto& [pixel, squares] : other.large_squares_->of_pixel)
        for (std::size_t c = 0; c < 3; ++c) large_squares_->of_pixel[pixel][c] += squares[c];
    return *this;
}

Film::Words Film::words(Vec2i pixel) const
{
    const Pixel& p = pixels_[index(pixel)];
    Words words{};
    for (std::size_t c = 0; c < 3; ++c) {
        put_sum(&words[4 * c], p.sum[c]);
        put_sum(&words[12 + 4 * c], p.squares[c]);
    }
    words[24] = p.count;
    words[25] = p.contributing;
    return words;
}

void Film::set_words(Vec2i pixel, const Words& words)
{
    Pixel& p = pixels_[index(pixel)];
    for (std::size_t c = 0; c < 3; ++c) {
        p.sum[c] = get_sum(&words[4 * c]);
        p.squares[c] = get_sum(&words[12 + 4 * c]);
    }
    p.count = words[24];
    p.contributing = words[25];
}

bool Film::has_large_squares() const
{
    return !large_squares_->of_pixel.empty();
}

Film::LargeWords Film::large_words(Vec2i pixel) const
{
    LargeWords words{};
    const auto found = large_squares_->of_pixel.find(index(pixel));
    if (found != large_squares_->of_pixel.end())
        for (std::size_t c = 0; c < 3; ++c) put_sum(&words[4 * c], found->second[c]);
    return words;
}

void Film::set_large_words(Vec2i pixel, const LargeWords& words)
{
    large_squares_->of_pixel.erase(index(pixel));
    if (words == LargeWords{}) return;
    for (std::size_t c = 0; c < 3; ++c) large_squares_->of_pixel[index(pixel)][c] = get_sum(&words[4 * c]);
}

std::vector<std::string> Film::layer_word_names() const
{
    return layers_ ? layers_->word_names() : std::vector<std::string>();
}

void Film::layer_words(Vec2i pixel, std::span<std::uint32_t> words) const
{
    if (layers_) layers_->words(index(pixel), words);
}

void Film::set_layer_words(Vec2i pixel, std::span<const std::uint32_t> words)
{
    if (layers_) layers_->set_words(index(pixel), words);
}

bool Film::can_have_layer_words(std::span<const std::uint32_t> words, std::uint64_t samples) const
{
    return !layers_ || layers_->is_possible(words, samples);
}

} // namespace plumb
