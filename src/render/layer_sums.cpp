// SPDX-License-Identifier: MIT

#include "render/layer_sums.h"

#include "plumb/render/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace plumb {
namespace {

// A component of a variance has these sums.
enum VarianceSum : std::size_t { values, squares, large_squares, variance_sums };

constexpr const char* sum_names[variance_sums] = {"layer", "squares", "largeSquares"};
// The largest that one sample adds to each, in units of 2^96.
constexpr double high_word_per_sample[variance_sums] = {0x1p5, 0x1p4, 0x1p-2};
constexpr double high_word_of_share = 0x1p6; // a difference of two values

std::size_t sums_per_component(LayerKind kind)
{
    if (is_variance(kind)) return variance_sums;
    return kind == LayerKind::id ? 0 : 1;
}

// Of a pixel.
struct Sizes {
    std::size_t sums = 0;
    std::size_t hits = 0;
    std::size_t ids = 0;
};

Sizes sizes_of(const ChannelSet& layers)
{
    Sizes sizes;
    for (const Layer& layer : layers) {
        sizes.sums += layer.components.size() * sums_per_component(layer.kind);
        if (is_of_hits(layer.kind)) ++sizes.hits;
        if (layer.kind == LayerKind::id) ++sizes.ids;
    }
    return sizes;
}

bool is_in_range(float value)
{
    return std::abs(value) < film_max_value; // not if it is not a number
}

double developed(LayerKind kind, const FixedSum* sums, std::uint32_t count)
{
    if (is_variance(kind) && (count == 1 || (count == 0 && kind == LayerKind::variance)))
        return std::numeric_limits<double>::quiet_NaN();
    if (count == 0) return 0.0;
    return is_variance(kind) ? variance_of_mean(sums[values], sums[squares], sums[large_squares], count)
                             : static_cast<double>(sums[values]) * fixed_unit / static_cast<double>(count);
}

// The id of the smaller sample index; 0 has no sample.
std::uint64_t first_of(std::uint64_t a, std::uint64_t b)
{
    return a == 0 || b == 0 ? a | b : std::min(a, b);
}

void add_value(FixedSum* sums, LayerKind kind, float value)
{
    const double x = value; // its square is exact
    sums[values] += to_fixed(x * fixed_units_per_one);
    if (!is_variance(kind)) return;
    if (std::abs(value) < fixed_large_value)
        sums[squares] += to_fixed(x * x * fixed_units_per_one);
    else
        sums[large_squares] += to_fixed(x * x / fixed_large_unit);
}

} // namespace

LayerSums::LayerSums(ChannelSet layers, std::size_t pixels) : layers_(std::move(layers))
{
    const Sizes sizes = sizes_of(layers_);
    sums_per_pixel_ = sizes.sums;
    hits_per_pixel_ = sizes.hits;
    ids_per_pixel_ = sizes.ids;
    sums_.resize(pixels * sizes.sums);
    hits_.resize(pixels * sizes.hits);
    first_ids_.resize(pixels * sizes.ids);
    std::size_t sum = 0;
    for (const Layer& layer : layers_) {
        first_sums_.push_back(sum);
        sum += layer.components.size() * sums_per_component(layer.kind);
    }
}

std::size_t LayerSums::bytes_per_pixel(const ChannelSet& layers)
{
    const Sizes sizes = sizes_of(layers);
    return sizes.sums * sizeof(FixedSum) + sizes.hits * sizeof(std::uint32_t) +
           sizes.ids * sizeof(std::uint64_t);
}

void LayerSums::add(std::size_t pixel, float weight, const LayerSample& sample, std::uint64_t index)
{
    FixedSum* sum = sums_.data() + pixel * sums_per_pixel_;
    std::uint32_t* hits = hits_.data() + pixel * hits_per_pixel_;
    std::uint64_t* id = first_ids_.data() + pixel * ids_per_pixel_;
    const float* value = sample.values.data();
    const std::uint32_t* sample_id = sample.ids.data();
    add_shares(sum, weight, sample);
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const Layer& layer = layers_[i];
        if (layer.kind == LayerKind::share) {
            sum += layer.components.size();
            continue;
        }
        const bool hit = (sample.hits >> i & 1) != 0;
        if (layer.kind == LayerKind::id) {
            *id = first_of(*id, (index + 1) << 32 | (hit ? *sample_id : 0));
            ++id;
            ++sample_id;
            continue;
        }
        const std::size_t size = layer.components.size();
        const bool of_hits = is_of_hits(layer.kind);
        const std::size_t sums = sums_per_component(layer.kind);
        const float scale = of_hits ? 1.f : weight;
        if (hit && std::all_of(value, value + size, [&](float v) { return is_in_range(v * scale); })) {
            for (std::size_t c = 0; c < size; ++c) add_value(sum + c * sums, layer.kind, value[c] * scale);
            if (of_hits) ++*hits;
        }
        sum += size * sums;
        value += size;
        if (of_hits) ++hits;
    }
}

void LayerSums::add_shares(FixedSum* sums, float weight, const LayerSample& sample) const
{
    FixedSum before[3] = {0, 0, 0};
    for (const LightShare& share : sample.shares) {
        const Color value = share.sum * weight; // as Film::add() computes it of the radiance
        if (!(max_component(value) < film_max_value && min_component(value) > -film_max_value)) continue;
        for (int c = 0; c < 3; ++c) {
            const FixedSum now = to_fixed(static_cast<double>(value[c]) * fixed_units_per_one);
            for (std::size_t family = 0; family < sample.families; ++family)
                sums[first_sums_[share.layers[family]] + static_cast<std::size_t>(c)] += now - before[c];
            before[c] = now;
        }
    }
}

LayerSums& LayerSums::operator+=(const LayerSums& other)
{
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
    for (std::size_t i = 0; i < hits_.size(); ++i) hits_[i] += other.hits_[i];
    for (std::size_t i = 0; i < first_ids_.size(); ++i)
        first_ids_[i] = first_of(first_ids_[i], other.first_ids_[i]);
    return *this;
}

void LayerSums::develop(std::size_t pixel, std::uint32_t samples, float* out) const
{
    const FixedSum* sum = sums_.data() + pixel * sums_per_pixel_;
    const std::uint32_t* hits = hits_.data() + pixel * hits_per_pixel_;
    const std::uint64_t* id = first_ids_.data() + pixel * ids_per_pixel_;
    for (const Layer& layer : layers_) {
        if (layer.kind == LayerKind::id) {
            *out++ = static_cast<float>(static_cast<std::uint32_t>(*id++));
            continue;
        }
        const std::uint32_t count = is_of_hits(layer.kind) ? *hits++ : samples;
        for (std::size_t c = 0; c < layer.components.size(); ++c, sum += sums_per_component(layer.kind))
            *out++ = static_cast<float>(developed(layer.kind, sum, count));
    }
}

std::vector<std::string> LayerSums::word_names() const
{
    std::vector<std::string> names;
    for (const Layer& layer : layers_)
        for (std::size_t c = 0; c < layer.components.size(); ++c)
            for (std::size_t sum = 0; sum < sums_per_component(layer.kind); ++sum)
                for (int word = 0; word < 4; ++word)
                    names.push_back(fmt::format("{}.{}.{}", sum_names[sum], layer.channel(c), word));
    for (const Layer& layer : layers_)
        if (is_of_hits(layer.kind)) names.push_back(fmt::format("hits.{}", layer.name));
    for (const Layer& layer : layers_)
        if (layer.kind == LayerKind::id)
            for (const char* word : {"id", "sample"})
                names.push_back(fmt::format("first.{}.{}", layer.name, word));
    return names;
}

void LayerSums::words(std::size_t pixel, std::span<std::uint32_t> words) const
{
    std::uint32_t* out = words.data();
    for (std::size_t i = 0; i < sums_per_pixel_; ++i, out += 4)
        put_sum(out, sums_[pixel * sums_per_pixel_ + i]);
    for (std::size_t i = 0; i < hits_per_pixel_; ++i) *out++ = hits_[pixel * hits_per_pixel_ + i];
    for (std::size_t i = 0; i < ids_per_pixel_; ++i) {
        const std::uint64_t id = first_ids_[pixel * ids_per_pixel_ + i];
        *out++ = static_cast<std::uint32_t>(id);
        *out++ = static_cast<std::uint32_t>(id >> 32);
    }
}

void LayerSums::set_words(std::size_t pixel, std::span<const std::uint32_t> words)
{
    const std::uint32_t* in = words.data();
    for (std::size_t i = 0; i < sums_per_pixel_; ++i, in += 4)
        sums_[pixel * sums_per_pixel_ + i] = get_sum(in);
    for (std::size_t i = 0; i < hits_per_pixel_; ++i) hits_[pixel * hits_per_pixel_ + i] = *in++;
    for (std::size_t i = 0; i < ids_per_pixel_; ++i, in += 2)
        first_ids_[pixel * ids_per_pixel_ + i] = std::uint64_t{in[1]} << 32 | in[0];
}

bool LayerSums::is_possible(std::span<const std::uint32_t> words, std::uint64_t samples) const
{
    const std::uint32_t* in = words.data();
    for (const Layer& layer : layers_)
        for (std::size_t c = 0; c < layer.components.size(); ++c)
            for (std::size_t sum = 0; sum < sums_per_component(layer.kind); ++sum, in += 4) {
                const double high = static_cast<std::int32_t>(in[3]); // the highest word
                const double most =
                    layer.kind == LayerKind::share ? high_word_of_share : high_word_per_sample[sum];
                if (std::abs(high) > static_cast<double>(samples) * most + 1.0 ||
                    (sum != values && high < 0.0))
                    return false;
            }
    for (std::size_t i = 0; i < hits_per_pixel_; ++i)
        if (*in++ > samples) return false;
    for (std::size_t i = 0; i < ids_per_pixel_; ++i, in += 2)
        if (in[1] > film_max_samples || (in[1] == 0 && in[0] != 0) || (in[1] != 0 && samples == 0))
            return false;
    return true;
}

} // namespace plumb
