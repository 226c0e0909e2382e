// SPDX-License-Identifier: MIT
#include "reports/facts_json.h"

#include "render/sample_text.h"
#include "reports/json_document.h"

#include <cstdlib>
#include <fmt/format.h>
#include <set>

namespace plumb {

namespace {

// The shortest decimal number that is this float.
void write_float(JsonWriter& json, std::string_view key, float value)
{
    json.number(key, std::strtod(fmt::format("{}", value).c_str(), nullptr));
}

struct ValueWriter {
    JsonWriter& json;
    std::string_view key;

    void operator()(int value) const { json.number(key, value); }
    void operator()(float value) const { write_float(json, key, value); }
    void operator()(const std::string& value) const { json.text(key, value); }
    void operator()(const std::vector<float>& values) const
    {
        json.begin_array(key);
        for (const float value : values) write_float(json, {}, value);
        json.end_array();
    }
};

void write_color(JsonWriter& json, std::string_view key, const Color& color)
{
    json.begin_array(key);
    for (int i = 0; i < 3; ++i) write_float(json, {}, color[i]);
    json.end_array();
}

} // namespace

std::string info_json(const std::string& file, const Image& image)
{
    JsonWriter json;
    begin_document(json, "info");
    json.text("file", file);
    json.begin_array("resolution");
    json.number({}, image.full_width());
    json.number({}, image.full_height());
    json.end_array();
    const PixelRect& window = image.data_window();
    json.begin_array("window");
    for (const int number : {window.x, window.y, window.width, window.height}) json.number({}, number);
    json.end_array();
    json.begin_array("channels");
    for (const std::string& name : image.channel_names()) json.text({}, name);
    json.end_array();
    json.begin_object("header");
    std::set<std::string> written; // a header of somebody else may have a name twice
    for (const auto& [name, value] : image.metadata)
        if (!name.empty() && written.insert(name).second) std::visit(ValueWriter{json, name}, value);
    json.end_object();
    json.end_object();
    return std::move(json).finish();
}

std::string check_json(const RenderTask& task, const std::vector<Doubt>& doubts, const MemoryNeeds& memory)
{
    JsonWriter json;
    begin_document(json, "check");
    json.text("scene", task.file);
    json.boolean("clean", doubts.empty() && task.scene.warnings.empty());
    write_diagnostics(json, "warnings", task.scene.warnings);
    json.begin_array("likely_mistakes");
    for (const Doubt& doubt : doubts) {
        json.begin_object();
        write_text_or_null(json, "object", doubt.object);
        json.text("message", doubt.text);
        json.end_object();
    }
    json.end_array();
    json.begin_object("memory_bytes");
    json.number("scene", memory.scene);
    json.number("image", memory.image);
    json.end_object();
    json.end_object();
    return std::move(json).finish();
}

std::string_view event_word(PathEvent::Kind kind)
{
    switch (kind) {
    case PathEvent::Kind::ray: return "ray";
    case PathEvent::Kind::hit: return "hit";
    case PathEvent::Kind::escape: return "escape";
    case PathEvent::Kind::emission: return "emission";
    case PathEvent::Kind::direct: return "direct";
    case PathEvent::Kind::scatter: return "scatter";
    case PathEvent::Kind::roulette: return "roulette";
    case PathEvent::Kind::end: return "end";
    }
    return "";
}

std::string replay_json(const RenderTask& task, const ReplayedPlace& place, const ReplayedSample& sample)
{
    JsonWriter json;
    begin_document(json, "replay");
    json.text("scene", task.file);
    json.begin_array("pixel");
    json.number({}, place.pixel.x);
    json.number({}, place.pixel.y);
    json.end_array();
    json.integer("sample", place.sample);
    json.integer("seed", task.settings.samples.seed);
    json.text("integrator", task.scene.integrator);
    json.begin_array("raster");
    write_float(json, {}, sample.raster.x);
    write_float(json, {}, sample.raster.y);
    json.end_array();
    json.begin_array("events");
    for (const PathEvent& event : sample.log) {
        json.begin_object();
        json.text("kind", event_word(event.kind));
        json.text("text", event.text);
        json.end_object();
    }
    json.end_array();
    write_color(json, "value", sample.value);
    write_float(json, "weight", sample.weight);
    json.text("status", status_text(sample.status));
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
