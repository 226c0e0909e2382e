// SPDX-License-Identifier: MIT

#include "plumb/render/light_split.h"

#include "plumb/base/error.h"
#include "plumb/scene/scene.h"

#include <algorithm>
#include <charconv>
#include <numeric>

#include <fmt/format.h>

namespace plumb {
namespace {

using By = LightSplit::By;

struct KindOfSplit {
    By by;
    std::string_view name;
    int own; // the default; 0: it takes no number
};
constexpr KindOfSplit kinds_of_split[] = {
    {By::depth, "depth", 8}, {By::technique, "technique", 0}, {By::light, "light", 16}};
constexpr int most_own = static_cast<int>(max_layers) - 1;

constexpr std::string_view technique_names[] = {"view", "emitter_sampling", "direction_sampling"};

const KindOfSplit& kind_of(By by)
{
    return *std::find_if(std::begin(kinds_of_split), std::end(kinds_of_split),
                         [by](const KindOfSplit& kind) { return kind.by == by; });
}

LightSplit split_from_text(std::string_view text)
{
    const std::size_t colon = std::min(text.find(':'), text.size());
    const auto* const kind =
        std::find_if(std::begin(kinds_of_split), std::end(kinds_of_split),
                     [&](const KindOfSplit& one) { return one.name == text.substr(0, colon); });
    if (kind == std::end(kinds_of_split))
        throw Error(
            fmt::format("unknown split '{}'; known are depth, technique and light", text.substr(0, colon)));
    LightSplit split{kind->by, kind->own};
    if (colon == text.size()) return split;
    if (kind->own == 0) throw Error(fmt::format("'{}' takes no number, but is '{}'", kind->name, text));
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data() + colon + 1, end, split.own);
    if (problem != std::errc() || stop != end || split.own < 1 || split.own > most_own)
        throw Error(fmt::format("the number of layers must be from 1 to {}, not '{}'", most_own,
                                text.substr(colon + 1)));
    return split;
}

// A light that can be told from others: an emitter, or all that infinite emitters send together.
struct OwnLight {
    std::size_t number; // from 1, of its first emitter
    std::vector<std::size_t> emitters;
    double power = 0.0;
};

bool is_of_environment(const Emitter& emitter)
{
    return emitter.is_infinite() && !emitter.is_delta();
}

std::vector<OwnLight> all_lights(const Scene& scene)
{
    std::vector<OwnLight> lights;
    std::optional<std::size_t> environment;
    for (std::size_t i = 0; i < scene.emitters().size(); ++i) {
        const Emitter& emitter = *scene.emitters()[i];
        std::size_t place = lights.size();
        if (is_of_environment(emitter)) {
            if (!environment) environment = place;
            place = *environment;
        }
        if (place == lights.size()) lights.push_back({i + 1, {}, 0.0});
        lights[place].emitters.push_back(i);
        lights[place].power += static_cast<double>(emitter.power());
    }
    return lights;
}

// In document order.
std::vector<OwnLight> own_lights(const Scene& scene, int most)
{
    std::vector<OwnLight> lights = all_lights(scene);
    std::ranges::stable_sort(lights, std::greater(), &OwnLight::power);
    lights.resize(std::min(lights.size(), static_cast<std::size_t>(most)));
    std::ranges::sort(lights, {}, &OwnLight::number);
    return lights;
}

std::vector<std::string> names_of(const LightSplit& split, const Scene& scene)
{
    std::vector<std::string> names;
    switch (split.by) {
    case By::depth:
        for (int depth = 0; depth < split.own; ++depth) names.push_back(std::to_string(depth));
        break;
    case By::technique: return {std::begin(technique_names), std::end(technique_names)};
    case By::light:
        for (const OwnLight& light : own_lights(scene, split.own))
            names.push_back(std::to_string(light.number));
        break;
    }
    names.emplace_back("more");
    return names;
}

} // namespace

std::vector<LightSplit> light_splits_from_text(std::span<const std::string> texts)
{
    std::vector<LightSplit> splits;
    for (const std::string& text : texts) {
        const LightSplit split = split_from_text(text);
        if (std::ranges::find(splits, split.by, &LightSplit::by) != splits.end())
            throw Error(fmt::format("'{}' is there twice", kind_of(split.by).name));
        splits.push_back(split);
    }
    return splits;
}

std::vector<std::string> to_texts(std::span<const LightSplit> splits)
{
    std::vector<std::string> texts;
    for (const LightSplit& split : splits) {
        const KindOfSplit& kind = kind_of(split.by);
        texts.push_back(split.own == kind.own ? std::string(kind.name)
                                              : fmt::format("{}:{}", kind.name, split.own));
    }
    return texts;
}

ChannelSet layers_of(std::span<const LightSplit> splits, const Scene& scene)
{
    ChannelSet layers;
    for (const LightSplit& split : splits)
        for (const std::string& name : names_of(split, scene))
            layers.push_back(
                {fmt::format("by_{}.{}", kind_of(split.by).name, name), {"R", "G", "B"}, LayerKind::share});
    return layers;
}

std::vector<std::string> light_table(std::span<const LightSplit> splits, const Scene& scene)
{
    const auto split = std::ranges::find(splits, By::light, &LightSplit::by);
    if (split == splits.end()) return {};
    std::vector<std::string> lines;
    for (const OwnLight& light : own_lights(scene, split->own)) {
        std::string line = std::to_string(light.number);
        for (const std::size_t emitter : light.emitters)
            line += (emitter == light.emitters.front() ? " " : " and ") + scene.emitter_names()[emitter];
        lines.push_back(std::move(line));
    }
    return lines;
}

LightSplitter::LightSplitter(std::span<const LightSplit> splits, const Scene& scene, std::size_t first_layer)
{
    auto first = static_cast<std::uint32_t>(first_layer);
    for (const LightSplit& split : splits) {
        splits_.push_back({split, first});
        first += static_cast<std::uint32_t>(names_of(split, scene).size());
        if (split.by != By::light) continue;
        const std::vector<OwnLight> own = own_lights(scene, split.own);
        layer_of_emitter_.assign(scene.emitters().size() + 1, static_cast<std::uint32_t>(own.size()));
        for (std::size_t layer = 0; layer < own.size(); ++layer) {
            for (const std::size_t emitter : own[layer].emitters) {
                layer_of_emitter_[emitter] = static_cast<std::uint32_t>(layer);
                if (is_of_environment(*scene.emitters()[emitter]))
                    layer_of_emitter_.back() = static_cast<std::uint32_t>(layer);
            }
        }
    }
}

std::uint32_t LightSplitter::layer_of(const Placed& placed, const LightNote& note) const
{
    switch (placed.split.by) {
    case By::depth: return placed.first + static_cast<std::uint32_t>(std::min(note.depth, placed.split.own));
    case By::technique: return placed.first + static_cast<std::uint32_t>(note.by);
    case By::light: break;
    }
    return placed.first +
           (note.emitter == environment_index ? layer_of_emitter_.back() : layer_of_emitter_[note.emitter]);
}

std::span<const LightShare> LightSplitter::shares(const LightNotes& notes, const Color& radiance,
                                                  std::vector<LightShare>& room) const
{
    room.clear();
    for (const LightNote& note : notes.all()) {
        LightShare share{note.sum, {}};
        for (std::size_t i = 0; i < splits_.size(); ++i) share.layers[i] = layer_of(splits_[i], note);
        room.push_back(share);
    }
    if (!room.empty())
        room.back().sum = radiance; // it is; the sum of the layers never hangs on an integrator's diligence
    return room;
}

} // namespace plumb
