// SPDX-License-Identifier: MIT

#include "plumb/base/error.h"
#include "plumb/model/camera.h"
#include "plumb/model/shape.h"
#include "plumb/render/aovs.h"
#include "plumb/scene/tracer.h"

#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumb {
namespace {

constexpr const char* behind_suffix = "_behind";
constexpr const char* variance_prefix = "variance_of_";

struct NamedRow {
    const AovRow* row;
    bool behind;
    bool variance;
    std::string as = {}; // the layer's name, if it is another one

    std::string name() const
    {
        return (variance ? variance_prefix : "") + row->layer.name + (behind ? behind_suffix : "");
    }
    Layer layer() const
    {
        Layer layer = row->layer;
        layer.name = as.empty() ? name() : as;
        if (variance) layer.kind = is_of_hits(layer.kind) ? LayerKind::variance_of_hits : LayerKind::variance;
        return layer;
    }
};

std::vector<NamedRow> all_rows()
{
    std::vector<NamedRow> rows;
    for (const bool variance : {false, true})
        for (const AovRow& row : aov_rows()) {
            if (variance && row.layer.kind == LayerKind::id) continue;
            rows.push_back({&row, false, variance});
            if (row.behind) rows.push_back({&row, true, variance});
        }
    return rows;
}

NamedRow row_named(const std::vector<NamedRow>& rows, std::string_view name)
{
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const NamedRow& row) { return row.name() == name; });
    if (found != rows.end()) return *found;
    std::vector<std::string> known;
    for (const NamedRow& row : rows)
        if (!row.variance) known.push_back(row.name());
    throw Error(fmt::format("unknown AOV '{}'; known are {}, and {}NAME of those that are no ids", name,
                            fmt::join(known, ", "), variance_prefix));
}

// Of LAYER:NAME.
NamedRow row_called(const std::vector<NamedRow>& rows, std::string_view layer, std::string_view name)
{
    if (!is_layer_name(layer) || layer == "variance")
        throw Error(fmt::format("'{}' cannot be the name of a layer; it takes letters, digits, '_', '-' and "
                                "dots inside",
                                layer));
    NamedRow row = row_named(rows, name);
    row.as = layer;
    return row;
}

std::vector<NamedRow> rows_of(std::span<const std::string> names)
{
    if (names.empty()) return {};
    const std::vector<NamedRow> rows = all_rows();
    std::vector<NamedRow> called;
    std::unordered_set<std::string> plain;
    for (const std::string_view name : names) {
        const std::size_t colon = name.find(':');
        if (colon == name.npos)
            plain.insert(row_named(rows, name).name());
        else
            called.push_back(row_called(rows, name.substr(0, colon), name.substr(colon + 1)));
    }
    std::vector<NamedRow> wanted;
    for (const NamedRow& row : rows)
        if (plain.contains(row.name())) wanted.push_back(row);
    wanted.insert(wanted.end(), called.begin(), called.end());
    if (wanted.size() > max_layers)
        throw Error(fmt::format("there can be {} layers, not {}", max_layers, wanted.size()));
    std::unordered_set<std::string> layers;
    for (const NamedRow& row : wanted)
        if (const Layer layer = row.layer(); !layers.insert(layer.name).second)
            throw Error(fmt::format("two layers are called '{}'", layer.name));
    return wanted;
}

void put(double* out, const Vec3d& v)
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

} // namespace

ChannelSet layers_of(std::span<const std::string> names)
{
    ChannelSet layers;
    for (const NamedRow& named : rows_of(names)) layers.push_back(named.layer());
    return layers;
}

std::vector<std::string> aov_names()
{
    std::vector<std::string> names;
    for (const NamedRow& named : all_rows()) names.push_back(named.name());
    return names;
}

std::vector<std::string> material_names(const Scene& scene)
{
    std::vector<std::string> names;
    std::unordered_set<std::string_view> known; // of the objects
    scene.for_each_object([&](const SceneObject& object) {
        if (known.insert(object.material).second) names.push_back(object.material);
    });
    return names;
}

std::vector<std::pair<std::string, std::vector<std::string>>> id_tables(std::span<const std::string> names,
                                                                        const Scene& scene)
{
    std::vector<std::pair<std::string, std::vector<std::string>>> tables;
    for (const NamedRow& named : rows_of(names)) {
        if (!named.row->table) continue;
        const std::string& name = named.row->layer.name; // of both of its layers
        if (std::none_of(tables.begin(), tables.end(),
                         [&](const auto& table) { return table.first == name; }))
            tables.emplace_back(name, named.row->table(scene));
    }
    return tables;
}

AovView::AovView(const Scene& scene, const Camera& camera) : scene_(scene)
{
    put(eye_, camera.to_world().point(Vec3d(0.0, 0.0, 0.0)));
    put(forward_, normalize(camera.to_world().vector(Vec3d(0.0, 0.0, 1.0))));
    for (const SceneObject& object : scene.objects())
        objects_.emplace(object.shape.get(), static_cast<std::uint32_t>(objects_.size() + 1));
    std::unordered_map<std::string_view, std::uint32_t> ids; // of names that the objects have
    scene.for_each_object([&](const SceneObject& object) {
        const auto named = ids.emplace(object.material, static_cast<std::uint32_t>(ids.size() + 1)).first;
        materials_.emplace(object.bsdf.get(), named->second);
    });
}

double AovView::depth_along_view(const float* position) const
{
    double depth = 0.0;
    for (int i = 0; i < 3; ++i) depth += (static_cast<double>(position[i]) - eye_[i]) * forward_[i];
    return depth;
}

std::uint32_t AovView::object_of(const SurfacePoint& at) const
{
    if (const auto instance = scene_.instance_of(at))
        return static_cast<std::uint32_t>(objects_.size()) + *instance + 1;
    const auto found = objects_.find(at.shape);
    return found == objects_.end() ? 0 : found->second;
}

std::uint32_t AovView::material_of(const Bsdf* bsdf) const
{
    const auto found = materials_.find(bsdf);
    return found == materials_.end() ? 0 : found->second;
}

AovMeter::AovMeter(std::span<const std::string> names, const Scene& scene, const Camera& camera)
{
    for (const NamedRow& named : rows_of(names)) wanted_.push_back({named.row, named.behind});
    if (!wanted_.empty()) view_.emplace(scene, camera);
}

LayerSample AovMeter::measure(const SampleFacts& sample, Values& room) const
{
    room.values.clear();
    room.ids.clear();
    std::uint64_t hits = 0;
    std::uint64_t bit = 1;
    for (const auto& [row, behind] : wanted_) {
        const std::optional<SeenSurface>& seen = behind ? sample.first.not_delta : sample.first.surface;
        if (seen || row->of_sample) hits |= bit;
        bit <<= 1;
        if (row->identify) {
            room.ids.push_back(seen ? row->identify(*seen, *view_) : 0);
            continue;
        }
        const std::size_t at = room.values.size();
        room.values.resize(at + row->layer.components.size(), 0.f);
        if (row->of_sample)
            row->of_sample(sample, &room.values[at]);
        else if (seen)
            row->measure(*seen, *view_, &room.values[at]);
    }
    return {room.values, room.ids, hits};
}

} // namespace plumb
