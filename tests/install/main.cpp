// SPDX-License-Identifier: MIT

// What the program does, with the library alone: consumer SCENE SUITE DIRECTORY

#include <plumb/experiments/race.h>
#include <plumb/experiments/suite_run.h>
#include <plumb/rendering/recipe.h>
#include <plumb/rendering/work.h>
#include <plumb/reports/suite_report.h>

#include <cstdio>
#include <exception>

using namespace plumb;

namespace {

void check(bool good, const char* what)
{
    if (!good) throw Error(what);
}

bool identical(const Image& a, const Image& b)
{
    return compare(a, b).identical;
}

void do_all(const std::filesystem::path& scene, const std::filesystem::path& suite,
            const std::filesystem::path& out)
{
    RenderSettings settings;
    settings.view.size = Vec2i(16, 12);
    settings.view.aovs = {"albedo", "object"};
    settings.samples.per_pixel = 32;
    SceneFile file(scene);
    const RenderTask task = make_task(file, settings);

    RenderSession whole(task);
    check(whole.run() == StopReason::all_samples, "render");
    const Image image = whole.image();
    write_image(out / "whole.exr", image);

    // Stopped in the middle, and resumed.
    SessionOptions saved;
    saved.checkpoint.file = out / "work.exr";
    std::atomic<bool> stop = false;
    RenderSession first(task, saved, {.progress = [&](const Progress&) { stop = true; }, .stop = &stop});
    check(first.run() == StopReason::interrupted, "interrupt");
    first.save();
    RenderSession second(task, saved);
    check(second.resume() && second.run() == StopReason::all_samples, "resume");
    check(identical(second.image(), image), "resumed image");

    std::vector<std::filesystem::path> parts;
    for (std::uint64_t i = 0; i < 2; ++i) {
        SessionOptions part;
        part.part = PartSettings{i, 2, PartBy::samples};
        part.checkpoint.file = parts.emplace_back(out / ("part" + std::to_string(i) + ".exr"));
        RenderSession session(task, part);
        session.run();
        session.save();
    }
    const Work work = merge_parts(parts);
    check(work.missing().empty() && identical(image_of(work), image), "merge");

    const Recipe recipe = read_recipe(out / "whole.exr");
    check(recipe.settings == settings, "settings of a header");
    check(identical(rerun(recipe, scene), image), "rerun");

    // Of a scene that is loaded once.
    RaceSettings methods;
    methods.base = settings;
    methods.methods = {{.integrator = "path_mis"}, {.integrator = "path_nee"}};
    methods.rounds = 3;
    check(agree(file, methods).verdict != Verdict::differs, "agree");
    check(race(file, methods).ranking.size() == 2, "race");

    SuiteOptions how;
    how.directory = out / "suite";
    ShownImages shown(2);
    const SuiteRun run =
        run_suite(suite, plan_suite(suite), how, {},
                  [&](const SuiteResult& result, const SuiteImages& images) { shown.add(result, images); });
    write_suite_reports(run, shown, how.directory);
    check(run.count(Verdict::passes) == 1 && exit_code_of(run) == 0, "suite");
}

} // namespace

int main(int count, char** words)
{
    if (count != 4) return 2;
    try {
        do_all(words[1], words[2], words[3]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
