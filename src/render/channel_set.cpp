// SPDX-License-Identifier: MIT

#include "plumb/render/channel_set.h"

#include "plumb/base/error.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumb {
namespace {

constexpr std::string_view layer_kinds[] = {"mean", "hits", "id", "variance", "variance_of_hits", "share"};
constexpr std::size_t max_components = 4;

bool is_name(std::string_view text)
{
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
}

// What is before the next separator; all there is if there is none.
std::string_view cut(std::string_view& rest, char separator)
{
    const std::size_t end = std::min(rest.find(separator), rest.size());
    const std::string_view one = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return one;
}

Layer layer_from_text(std::string_view text)
{
    Layer layer;
    layer.name = cut(text, ':');
    std::string_view components = cut(text, ':');
    while (!components.empty()) layer.components.emplace_back(cut(components, ','));
    const auto kind = std::find(std::begin(layer_kinds), std::end(layer_kinds), text);
    layer.kind = static_cast<LayerKind>(kind - std::begin(layer_kinds));
    const std::set<std::string> unique(layer.components.begin(), layer.components.end());
    const std::size_t count = layer.components.size();
    if (!is_layer_name(layer.name) || kind == std::end(layer_kinds) || unique.size() != count || count < 1 ||
        count > max_components || (layer.kind == LayerKind::id && count != 1) ||
        !std::all_of(unique.begin(), unique.end(), is_name))
        throw Error("the text is no set of layers");
    return layer;
}

} // namespace

bool is_layer_name(std::string_view text)
{
    if (text.empty() || text.front() == '.' || text.back() == '.') return false;
    std::string plain(text);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c == '.' || c == '-'; }, '_');
    return is_name(plain);
}

std::string_view family_of(const Layer& share)
{
    return std::string_view(share.name).substr(0, share.name.rfind('.'));
}

std::string to_text(const ChannelSet& layers)
{
    std::string text;
    for (const Layer& layer : layers)
        text +=
            fmt::format("{}{}:{}:{}", text.empty() ? "" : " ", layer.name, fmt::join(layer.components, ","),
                        layer_kinds[static_cast<std::size_t>(layer.kind)]);
    return text.empty() ? "none" : text;
}

ChannelSet channel_set_from_text(std::string_view text)
{
    ChannelSet layers;
    if (text == "none") return layers;
    const std::string_view all = text;
    std::set<std::string> names;
    while (!text.empty()) {
        layers.push_back(layer_from_text(cut(text, ' ')));
        if (!names.insert(layers.back().name).second) throw Error("the text has a layer twice");
        if (layers.size() > max_layers) throw Error("the text has too many layers");
    }
    if (to_text(layers) != all) throw Error("the text is no set of layers");
    return layers;
}

std::string layer_names(const ChannelSet& layers)
{
    std::string text;
    for (const Layer& layer : layers) text += (text.empty() ? "" : ", ") + layer.name;
    return text.empty() ? "none" : text;
}

} // namespace plumb
