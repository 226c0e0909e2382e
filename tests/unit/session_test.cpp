// SPDX-License-Identifier: MIT
#include "plumb/compare/compare.h"
#include "plumb/rendering/session.h"
#include "support/catch.h"
#include "support/scene_text.h"

using namespace plumb;

namespace {

RenderSettings few_samples()
{
    RenderSettings settings;
    settings.samples.per_pixel = 48;
    settings.method.integrator = "path_mis";
    return settings;
}

struct Said {
    std::vector<Diagnostic> messages;
    SessionCallbacks callbacks()
    {
        SessionCallbacks all;
        all.message = [this](const Diagnostic& message) { messages.push_back(message); };
        return all;
    }
};

} // namespace

TEST_CASE("a session says what it has to say to callbacks, and goes on to the same image", "[unit][session]")
{
    const TempDirectory directory;
    SceneFile file(directory.write(
        "scene.xml", test::start + "<shape type='sphere'/><emitter type='environment'/></scene>"));
    const RenderTask task = make_task(file, few_samples());
    SessionOptions options;
    options.checkpoint.file = directory / "a.exr";
    options.threads = 1;

    Said said;
    std::atomic<bool> stop = false;
    SessionCallbacks callbacks = said.callbacks();
    callbacks.progress = [&](const Progress&) { stop = true; };
    callbacks.stop = &stop;
    RenderSession first(task, options, callbacks);
    CHECK_FALSE(first.resume());
    REQUIRE(said.messages.size() == 1);
    CHECK(said.messages[0].severity == Severity::note);
    CHECK_THAT(said.messages[0].message, ContainsSubstring("does not exist yet"));
    CHECK(first.run() == StopReason::interrupted);
    CHECK(first.evidence().stop == interruption);
    first.save();
    first.save(); // now there are two generations
    directory.write("a.exr", "damaged");

    RenderSession second(task, options, said.callbacks());
    CHECK(second.resume());
    REQUIRE(said.messages.size() == 3);
    CHECK(said.messages[1].severity == Severity::warning);
    CHECK_THAT(said.messages[1].message, ContainsSubstring("resuming from") && ContainsSubstring("previous"));
    CHECK(second.run() == StopReason::all_samples);
    CHECK(second.evidence().stop.empty());

    RenderSession whole(task);
    CHECK(whole.run() == StopReason::all_samples);
    CHECK(compare(whole.image(), second.image()).identical);

    RenderSettings others = few_samples();
    others.view.aovs = {"normal"};
    RenderSession with_layers(make_task(file, others), options);
    CHECK_THROWS_WITH(with_layers.resume(), ContainsSubstring("and --aov and --split ask for normal"));
}

TEST_CASE("what is known of an estimate decides as a header does", "[unit][session]")
{
    const auto grey = [] {
        Image image({0, 0, 8, 8}, 8, 8, {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) std::fill_n(image.pixel(x, y), 6, 0.25f);
        return image;
    };
    Image a = grey();
    Image b = grey();
    a.pixel(3, 3)[0] = 0.5f;
    for (Image* image : {&a, &b}) image->metadata.emplace_back("plumb:samplesPerPixel", 16);
    const Comparison by_header = compare(a, b);
    const Estimate known_a{"a", std::move(a), 16.0, {}, {}};
    const Estimate known_b{"b", std::move(b), 16.0, {}, {}};
    const Comparison by_facts = compare(known_a, known_b);
    CHECK(by_header.significance.p == by_facts.significance.p);
    CHECK(by_header.verdict == by_facts.verdict);
    CHECK(compare({"a", grey(), 2.0, {}, {}}, {"b", grey(), 2.0, {}, {}}).identical);
}
