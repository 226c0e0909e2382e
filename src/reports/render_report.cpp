// SPDX-License-Identifier: MIT
#include "plumb/reports/render_report.h"
#include "plumb/scene/scene.h"

#include "base/memory.h"
#include "base/shell_words.h"
#include "base/text.h"
#include "render/sample_text.h"
#include "reports/json_document.h"
#include "settings/options_text.h"

#include <ctime>
#include <fmt/format.h>
#include <unistd.h>

namespace plumb {

namespace {

void write_dialect(JsonWriter& json, const Dialect& dialect)
{
    json.begin_object("dialect");
    json.text("name", to_string(dialect.name));
    json.text("reason", dialect.reason);
    json.boolean("mirrored_view", dialect.mirrored_view);
    json.boolean("emitters_absorb", dialect.emitters_absorb);
    json.boolean("point_takes_power", dialect.point_takes_power);
    json.boolean("sun_points_to_light", dialect.sun_points_to_light);
    json.boolean("environment_flipped", dialect.environment_flipped);
    json.number("environment_scale", static_cast<double>(dialect.environment_scale));
    json.end_object();
}

double mean_samples(const Report& report)
{
    const PixelRect window = report.crop.value_or(PixelRect{0, 0, report.resolution.x, report.resolution.y});
    return static_cast<double>(report.evidence.samples) /
           (static_cast<double>(window.width) * static_cast<double>(window.height));
}

void write_adaptive(JsonWriter& json, const Report& report)
{
    json.begin_object("adaptive");
    json.number("target", *report.adaptive);
    json.integer("least_spp", report.evidence.samples_per_pixel);
    json.integer("most_spp", report.evidence.most_samples_per_pixel.value_or(0));
    json.number("mean_spp", mean_samples(report));
    json.end_object();
}

void write_image(JsonWriter& json, const Report& report)
{
    const auto integers = [&](const char* key, const std::vector<int>& values) {
        json.begin_array(key);
        for (const int value : values) json.integer({}, static_cast<std::uint64_t>(value));
        json.end_array();
    };
    integers("resolution", {report.resolution.x, report.resolution.y});
    if (report.crop)
        integers("crop", {report.crop->x, report.crop->y, report.crop->width, report.crop->height});
    else
        json.null("crop");
    json.integer("spp", report.evidence.samples_per_pixel);
    if (report.adaptive) write_adaptive(json, report);
    json.integer("seed", report.seed);
    json.integer("triangles", report.triangles);
}

void write_work(JsonWriter& json, const Report& report)
{
    json.begin_object("seconds");
    json.number("parsing", report.parse_seconds);
    json.number("building", report.build_seconds);
    json.number("rendering", report.render_seconds);
    json.number("training", report.guide ? report.guide->seconds : 0.0);
    json.number("writing", report.write_seconds);
    json.number("total", report.total_seconds);
    json.end_object();
    json.begin_object("rays");
    json.integer("camera", report.rays.camera);
    json.integer("bounce", report.rays.bounce);
    json.integer("shadow", report.rays.shadow);
    json.integer("total", report.rays.total());
    json.end_object();
    json.number("rays_per_second", static_cast<double>(report.rays.total()) / report.render_seconds);
    json.begin_object("memory_bytes");
    json.integer("meshes", report.memory.meshes);
    json.integer("acceleration", report.memory.acceleration);
    json.integer("acceleration_while_built", report.memory.acceleration_peak);
    json.integer("textures", report.memory.images + report.texture_bytes);
    json.integer("film", report.film_bytes);
    json.end_object();
    json.integer("peak_memory_bytes", report.peak_memory);
}

void write_guide(JsonWriter& json, const std::optional<GuideFacts>& guide)
{
    if (!guide) return json.null("guide");
    json.begin_object("guide");
    json.integer("emitted", guide->emitted);
    json.integer("arrived", guide->arrived);
    json.integer("cells", guide->cells);
    json.integer("paths", guide->paths);
    json.integer("windows", guide->windows);
    json.end_object();
}

void write_left_out(JsonWriter& json, const LeftOut& left_out)
{
    json.begin_object("left_out");
    json.integer("count", left_out.count);
    if (left_out.count > 0) {
        const LeftOut::Sample& first = left_out.first;
        json.begin_object("first");
        json.begin_array("pixel");
        json.integer({}, static_cast<std::uint64_t>(first.pixel.x));
        json.integer({}, static_cast<std::uint64_t>(first.pixel.y));
        json.end_array();
        json.integer("sample", first.index);
        json.text("why", status_text(first.status));
        json.text("value", color_text(first.value)); // JSON has no number for what it often is
        json.end_object();
    } else {
        json.null("first");
    }
    json.end_object();
}

void write_evidence(JsonWriter& json, const Report& report)
{
    const auto texts = [&](const char* key, const std::vector<std::string>& values) {
        json.begin_array(key);
        for (const std::string& value : values) json.text({}, value);
        json.end_array();
    };
    json.boolean("biased", !report.evidence.ledger.biases.empty());
    texts("biases", report.evidence.ledger.biases);
    texts("model", report.evidence.ledger.model);
    const std::optional<NoiseEstimate>& noise = report.evidence.noise;
    if (!noise) return json.null("noise");
    json.begin_object("noise");
    json.number("rmse", noise->rmse);
    json.number("low", noise->low);
    json.number("high", noise->high);
    json.boolean("upper_bound", report.noise_is_bound);
    json.end_object();
}

bool is_black(const Film& film)
{
    const PixelRect& window = film.window();
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            if (film.contributing_count({x, y}) > 0) return false;
    return true;
}

std::string point_text(const Vec3f& p)
{
    return fmt::format("({}, {}, {})", p.x, p.y, p.z);
}

} // namespace

std::vector<std::string> facts_of(const RenderTask& task)
{
    std::vector<std::string> lines;
    const LoadedScene& loaded = task.scene;
    const Scene& scene = *loaded.job.scene;
    const Vec2i resolution = loaded.job.camera->resolution();
    const Box3f bounds = scene.bounds();
    const std::string instances =
        scene.instances().empty() ? std::string() : fmt::format(", instances {}", scene.instances().size());
    lines.push_back(fmt::format("scene: objects {}, triangles {}, emitters {}{}", scene.objects().size(),
                                scene.triangle_count(), scene.emitters().size(), instances));
    if (!bounds.isEmpty())
        lines.push_back(fmt::format("bounds: {} to {}", point_text(bounds.min), point_text(bounds.max)));
    lines.push_back(fmt::format("image: {} x {} pixels, {} samples each, seed {}", resolution.x, resolution.y,
                                task.options.samples_per_pixel, task.options.seed));
    lines.push_back(fmt::format("integrator: {}; sampler: {}", loaded.integrator, loaded.sampler));
    lines.push_back(fmt::format(
        "dialect settings: emitters {}, mirror {}, point lights in {}, environment images {}times {}",
        loaded.dialect.emitters_absorb ? "absorb" : "scatter", loaded.dialect.mirrored_view ? "on" : "off",
        loaded.dialect.point_takes_power ? "power" : "radiance",
        loaded.dialect.environment_flipped ? "flipped and " : "", loaded.dialect.environment_scale));
    lines.push_back(fmt::format("embree: {}, {}", scene.embree_version(), scene.options().instruction_set));
    lines.push_back(fmt::format("inputs: read in {}, built in {}, hash {}",
                                duration_text(loaded.parse_seconds), duration_text(loaded.build_seconds),
                                loaded.input_hash));
    return lines;
}

Report make_report(const RenderSession& session, Evidence evidence)
{
    const RenderTask& task = session.task();
    const LoadedScene& scene = task.scene;
    const RenderState& state = session.state();
    Report report;
    report.scene = task.file;
    report.input_hash = scene.input_hash;
    report.dialect = scene.dialect;
    report.integrator = scene.integrator;
    report.sampler = scene.sampler;
    report.noise_is_bound = !scene.job.sampler->is_independent();
    report.adaptive = task.options.adaptive;
    report.seed = task.settings.samples.seed;
    report.resolution = scene.job.camera->resolution();
    report.crop = task.settings.view.crop;
    report.triangles = scene.job.scene->triangle_count();
    report.memory = scene.job.scene->memory();
    report.texture_bytes = scene.texture_bytes;
    const PixelRect& window = state.film.window();
    report.is_black = is_black(state.film);
    report.lights = scene.job.scene->emitters().size();
    report.film_bytes = Film::bytes_per_pixel(state.film.layers(), state.film.plans()) *
                        static_cast<std::uint64_t>(window.width) * static_cast<std::uint64_t>(window.height);
    report.parse_seconds = scene.parse_seconds;
    report.build_seconds = scene.build_seconds;
    report.render_seconds = state.seconds;
    report.guide = guide_of(*scene.job.integrator);
    report.rays = state.rays;
    report.evidence = std::move(evidence);
    report.threads = render_threads(task.options);
    report.instruction_set = scene.job.scene->options().instruction_set;
    report.embree_version = scene.job.scene->embree_version();
    return report;
}

std::vector<std::string> summary_of(const Report& report, const RenderTask& task)
{
    std::vector<std::string> lines;
    const Evidence& evidence = report.evidence;
    lines.push_back(fmt::format("{}: {} samples in {}, {}", list_text(report.outputs),
                                count_text(evidence.samples), duration_text(report.render_seconds),
                                rate_text(report.rays.total(), report.render_seconds)));
    if (report.adaptive)
        lines.push_back(fmt::format("adaptive: {} to {} samples per pixel, {:.1f} on average",
                                    evidence.samples_per_pixel, evidence.most_samples_per_pixel.value_or(0),
                                    mean_samples(report)));
    if (const auto& guide = report.guide; guide && (guide->cells > 0 || guide->windows > 0)) {
        std::vector<std::string> learnt;
        if (guide->cells > 0)
            learnt.push_back(fmt::format("caustics from {} photons in {} cells", count_text(guide->arrived),
                                         count_text(guide->cells)));
        if (guide->windows > 0)
            learnt.push_back(fmt::format("{} windows to the sky", count_text(guide->windows)));
        lines.push_back(
            fmt::format("guide: learnt in {} of that, {}", duration_text(guide->seconds), list_text(learnt)));
    }
    if (const auto& noise = evidence.noise)
        lines.push_back(fmt::format("noise: rmse {}{:.3g} (95 % interval {:.3g} to {:.3g})",
                                    report.noise_is_bound ? "at most " : "", noise->rmse, noise->low,
                                    noise->high));
    if (!evidence.ledger.biases.empty())
        lines.push_back(fmt::format("biased: {}", list_text(evidence.ledger.biases)));
    if (report.is_black && report.lights > 0 && evidence.samples > 0)
        lines.push_back(
            fmt::format("warning: the image is black, although there {}; 'renderer check {}' may say why",
                        report.lights == 1 ? "is a light" : fmt::format("are {} lights", report.lights),
                        shell_quote(task.file)));
    if (evidence.left_out.count == 0) return lines;
    const LeftOut::Sample& first = evidence.left_out.first;
    lines.push_back(fmt::format("warning: {} samples were discarded, the first is {}; to see its path:",
                                evidence.left_out.count, left_out_text(first)));
    lines.push_back(fmt::format("    renderer replay {} --pixel {},{} --sample {}{}", shell_quote(task.file),
                                first.pixel.x, first.pixel.y, first.index,
                                replay_options_text(task.settings)));
    return lines;
}

void note_machine(Report& report)
{
    report.peak_memory = peak_memory();

    char host[256] = "";
    if (gethostname(host, sizeof host - 1) == 0) report.host = host;

    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    char time[32] = "";
    if (gmtime_r(&now, &utc)) std::strftime(time, sizeof time, "%Y-%m-%dT%H:%M:%SZ", &utc);
    report.finished = time;
}

std::string report_json(const Report& report)
{
    JsonWriter json;
    begin_document(json, "render");
    json.text("scene", report.scene);
    json.text("input_hash", report.input_hash);
    write_dialect(json, report.dialect);
    json.text("integrator", report.integrator);
    json.text("sampler", report.sampler);
    write_image(json, report);
    write_work(json, report);
    write_guide(json, report.guide);
    write_left_out(json, report.evidence.left_out);
    write_evidence(json, report);
    json.boolean("black", report.is_black);
    json.integer("threads", static_cast<std::uint64_t>(report.threads));
    json.text("instruction_set", report.instruction_set);
    json.text("embree_version", report.embree_version);
    json.begin_array("outputs");
    for (const std::string& output : report.outputs) json.text({}, output);
    json.end_array();
    json.text("host", report.host);
    json.text("finished", report.finished);
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
