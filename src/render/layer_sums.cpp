// SPDX-License-Identifier: MIT

#include "render/layer_sums.h"

#include "plumb/film.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {
namespace {

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
        if (layer.kind == LayerKind::id) {
            ++sizes.ids;
            continue;
        }
        sizes.sums += layer.components.size();
        if (layer.kind == LayerKind::mean_of_hits) ++sizes.hits;
    }
    return sizes;
}

bool is_in_range(float value)
{
    return std::abs(value) < film_max_value; // not if it is not a number
}

// The id of the smaller sample index; 0 has no sample.
std::uint64_t first_of(std::uint64_t a, std::uint64_t b)
{
    return a == 0 || b == 0 ? a | b : std::min(a, b);
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
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const Layer& layer = layers_[i];
        const bool hit = (sample.hits >> i & 1) != 0;
        if (layer.kind == LayerKind::id) {
            *id = first_of(*id, (index + 1) << 32 | (hit ? *sample_id : 0));
            ++id;
            ++sample_id;
            continue;
        }
        const std::size_t size = layer.components.size();
        const bool of_hits = layer.kind == LayerKind::mean_of_hits;
        const float scale = of_hits ? 1.f : weight;
        if (hit && std::all_of(value, value + size, [&](float v) { return is_in_range(v * scale); })) {
            for (std::size_t c = 0; c < size; ++c)
                sum[c] += to_fixed(static_cast<double>(value[c] * scale) * fixed_units_per_one);
            if (of_hits) ++*hits;
        }
        sum += size;
        value += size;
        if (of_hits) ++hits;
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
        const std::uint32_t count = layer.kind == LayerKind::mean_of_hits ? *hits++ : samples;
        for (std::size_t c = 0; c < layer.components.size(); ++c, ++sum)
            *out++ =
                count == 0
                    ? 0.f
                    : static_cast<float>(static_cast<double>(*sum) * fixed_unit / static_cast<double>(count));
    }
}

std::vector<std::string> LayerSums::word_names() const
{
    std::vector<std::string> names;
    for (const Layer& layer : layers_)
        for (std::size_t c = 0; layer.kind != LayerKind::id && c < layer.components.size(); ++c)
            for (int word = 0; word < 4; ++word)
                names.push_back(fmt::format("layer.{}.{}", layer.channel(c), word));
    for (const Layer& layer : layers_)
        if (layer.kind == LayerKind::mean_of_hits) names.push_back(fmt::format("hits.{}", layer.name));
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
    for (std::size_t i = 0; i < sums_per_pixel_; ++i, in += 4) {
        // The highest word: |value| < 2^37 in units of 2^-64.
        const auto high = static_cast<std::int64_t>(static_cast<std::int32_t>(in[3]));
        if (std::abs(high) > static_cast<std::int64_t>(samples << 5) + 1) return false;
    }
    for (std::size_t i = 0; i < hits_per_pixel_; ++i)
        if (*in++ > samples) return false;
    for (std::size_t i = 0; i < ids_per_pixel_; ++i, in += 2)
        if (in[1] > film_max_samples || (in[1] == 0 && in[0] != 0) || (in[1] != 0 && samples == 0))
            return false;
    return true;
}

} // namespace plumb
