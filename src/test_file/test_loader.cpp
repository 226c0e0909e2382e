// SPDX-License-Identifier: MIT
#include "plumb/test_file/test_file.h"

#include "scene_file/build.h"
#include "scene_file/dialects.h"
#include "scene_file/expand.h"
#include "scene_file/file_order.h"
#include "scene_file/nori_words.h"
#include "scene_file/property_values.h"
#include "scene_file/shared_objects.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr double most_samples = static_cast<double>(max_samples_per_pixel);
constexpr std::uint64_t samples_per_cell = 5000; // where a chi2test does not say how many

const Element* first_child(const Element& element, std::string_view tag)
{
    const auto found = std::find_if(element.children.begin(), element.children.end(),
                                    [&](const Element& child) { return child.tag == tag; });
    return found == element.children.end() ? nullptr : &*found;
}

// What an element was written as: "bsdf 'diffuse' (line 4)", with the file where it is another one.
std::string element_name(const Element& element, const Element& root)
{
    const SourceLocation at = element.place();
    const std::string type = element.written_type();
    return fmt::format("{}{} ({} {})", element.written_tag(), type.empty() ? "" : fmt::format(" '{}'", type),
                       element.file == root.file ? "line"
                                                 : std::filesystem::path(at.file).filename().string() + ":",
                       at.line);
}

class TestBuilder {
public:
    TestBuilder(const Element& root, const RenderSettings& settings, Diagnostics& diagnostics)
        : root_(root), settings_(settings), diagnostics_(diagnostics)
    {}

    TestFile build()
    {
        const Dialect neutral = Dialect::standard(DialectName::plumb); // no parameter of a BSDF depends on it
        LoadContext context{diagnostics_, neutral, settings_.scene.lenient, {}};
        if (!read_type()) return std::move(test_);
        SharedObjects shared(root_, context);
        read_parameters(context);
        build_bsdfs(context);
        build_emitters();
        build_scenes();
        if (!diagnostics_.has_errors()) check_counts();
        make_sampler();
        return std::move(test_);
    }

private:
    bool is_ttest() const { return test_.type == TestType::ttest; }

    bool read_type()
    {
        const Attribute* type = root_.attribute("type");
        if (type && (type->value == "ttest" || type->value == "chi2test")) {
            test_.type = type->value == "ttest" ? TestType::ttest : TestType::chi2test;
            return true;
        }
        if (!type)
            diagnostics_.error(root_.place(), "<test> needs an attribute 'type': ttest or chi2test");
        else if (!type->broken)
            diagnostics_.error(
                root_.value_place(*type),
                fmt::format("unknown test '{}'{}", type->value, way_out(type->value, {"ttest", "chi2test"})));
        return false;
    }

    // --- Parameters ---

    void read_parameters(LoadContext& context)
    {
        ObjectReader reader(root_, context, {"bsdf", "emitter", "scene"});
        const Params& params = reader.params();
        test_.significance_level =
            static_cast<double>(params.number("significanceLevel", 0.01f, Range::open(0.0, 1.0)));
        if (is_ttest())
            read_ttest(params);
        else
            read_chi2test(params);
        for (const char* name : {"name", "id"}) params.ignore(name);
        params.reject_unused();
    }

    void read_ttest(const Params& params)
    {
        test_.sample_count = static_cast<std::uint64_t>(
            params.integer("sampleCount", 100000, Range::closed(2.0, most_samples)));
        params.string("references");
        test_.references = read_list("references");
        test_.angles = read_arguments(params, "angles", "bsdf");
        for (const double angle : test_.angles)
            if (!(angle >= 0.0 && angle <= 180.0))
                params.fail("angles", fmt::format("must be from 0 to 180 degrees, not {}", angle));
        test_.distances = read_arguments(params, "distances", "emitter");
    }

    // The places at which each child with that tag is tested.
    std::vector<double> read_arguments(const Params& params, const char* name, std::string_view tag)
    {
        if (first_child(root_, tag)) {
            params.string(name);
            return read_list(name);
        }
        if (params.has(name))
            params.warn(name, fmt::format("{} are for tests of {}s; these are not read", name, tag));
        return {};
    }

    void read_chi2test(const Params& params)
    {
        test_.resolution =
            static_cast<std::size_t>(params.integer("resolution", 10, Range::closed(1.0, 1000.0)));
        test_.min_expected =
            static_cast<double>(params.integer("minExpFrequency", 5, Range::closed(0.0, 1e6)));
        test_.directions =
            static_cast<std::size_t>(params.integer("testCount", 5, Range::closed(1.0, 1000.0)));
        const std::int64_t samples = params.integer("sampleCount", -1, Range::closed(-1.0, most_samples));
        if (samples == 0) params.fail("sampleCount", "must be at least 1, or -1 for 5000 a cell, not 0");
        const std::uint64_t cells = 2 * static_cast<std::uint64_t>(test_.resolution * test_.resolution);
        test_.sample_count = samples < 0 ? cells * samples_per_cell : static_cast<std::uint64_t>(samples);
    }

    // Of the <string> parameter of that name; Params has complained where there is none.
    std::vector<double> read_list(std::string_view name)
    {
        for (const Element& child : root_.children) {
            const Attribute* value = child.attribute("value");
            if (child.tag == "string" && child.value("name") == name && value)
                return read_number_list(child, *value, diagnostics_).value_or(std::vector<double>());
        }
        return {};
    }

    // --- Children ---

    void build_bsdfs(LoadContext& context)
    {
        for (const Element& child : root_.children) {
            if (child.tag != "bsdf") continue;
            auto bsdf = build_bsdf(child, context);
            if (bsdf && !is_ttest() && bsdf->lobes().has_any(delta_lobes))
                diagnostics_.error(
                    child.place(),
                    fmt::format("bsdf '{}' scatters into single directions, which have no density; "
                                "a chi2test cannot test it, a ttest can",
                                child.value("type")));
            test_.bsdfs.push_back({std::move(bsdf), element_name(child, root_)});
        }
    }

    // Each stands alone: a light at a point or infinitely far away.
    void build_emitters()
    {
        if (!first_child(root_, "emitter")) return;
        const Dialect dialect = choose_dialect(root_, wishes(), diagnostics_).dialect;
        const Element root = arrange(root_, dialect, wishes(), diagnostics_);
        LoadContext context{diagnostics_, dialect, settings_.scene.lenient, {}};
        context.vocabulary = &nori_vocabulary(dialect.name);
        SharedObjects shared(root, context);
        for (const Element& child : root.children) {
            if (child.tag != "emitter") continue;
            if (child.value("type") == "area")
                diagnostics_.error(child.value_place(*child.attribute("type")),
                                   "a test has no shape for an 'area' emitter; test a <scene> with it");
            else if (auto emitter = ObjectReader(child, context).build(emitter_types())) {
                emitter->prepare({Vec3f(0.f), 1.f});
                test_.emitters.push_back({std::move(emitter), element_name(child, root_)});
            }
        }
    }

    DialectWishes wishes() const
    {
        const SceneSettings& scene = settings_.scene;
        return {scene.dialect, scene.emitters_absorb, scene.mirrored_view, scene.environment_scale};
    }

    // One kind in a file, and of a chi2test bsdfs.
    void check_kinds()
    {
        const Element* others[] = {first_child(root_, "bsdf"), first_child(root_, "emitter"),
                                   first_child(root_, "scene")};
        if (!is_ttest()) {
            for (const Element* other : {others[1], others[2]})
                if (other)
                    diagnostics_.error(
                        other->place(),
                        fmt::format("a chi2test cannot contain a <{}>; it tests bsdfs", other->tag));
            return;
        }
        if (std::count(std::begin(others), std::end(others), nullptr) < 2)
            diagnostics_.error(
                (*std::max_element(std::begin(others), std::end(others), std::less<>()))->place(),
                "a ttest can contain bsdfs, emitters or scenes, not several of them; make files of each");
    }

    void build_scenes()
    {
        check_kinds();
        if (!first_child(root_, "scene")) return;

        // All scenes are of one course: one that does not say which is read as the evidence in the file suggests.
        const auto undecided =
            std::find_if(root_.children.begin(), root_.children.end(), [](const Element& child) {
                return child.tag == "scene" && !child.attribute("dialect");
            });
        DialectChoice common;
        if (undecided != root_.children.end()) {
            common = choose_dialect(root_, wishes(), diagnostics_);
            warn_of_open_readings(root_, common, wishes(), nullptr, diagnostics_);
        }
        for (const Element& child : root_.children)
            if (child.tag == "scene")
                build_scene_of_test(child, child.attribute("dialect")
                                               ? choose_dialect(child, wishes(), diagnostics_).dialect
                                               : common.dialect);
    }

    void build_scene_of_test(const Element& element, const Dialect& dialect)
    {
        const Element root = arrange(element, dialect, wishes(), diagnostics_);
        LoadContext context{diagnostics_, dialect, settings_.scene.lenient, {}};
        context.vocabulary = &nori_vocabulary(dialect.name);
        SceneBuilder builder(root, context);
        SceneContents contents = builder.build_contents();
        MethodAndView parts = builder.build_method_and_view(settings_.method, settings_.view);
        if (diagnostics_.has_errors()) return;
        const std::string name = fmt::format("{}, {}", element_name(element, root_), parts.integrator_type);
        auto scene = make_scene(std::move(contents), settings_.method.instruction_set, dialect);
        if (auto job = assemble(std::move(scene), std::move(parts), context))
            test_.scenes.push_back({*std::move(job), dialect, name});
    }

    // --- The whole ---

    void check_counts()
    {
        if (test_.bsdfs.empty() && test_.emitters.empty() && test_.scenes.empty()) {
            diagnostics_.error(root_.place(),
                               is_ttest() ? "the test has neither a <bsdf>, an <emitter> nor a <scene>"
                                          : "the test has no <bsdf>");
            return;
        }
        if (is_ttest()) check_references();
        if (test_.test_count() > max_tests)
            diagnostics_.error(root_.place(), fmt::format("the file holds {} tests; it can hold {}",
                                                          test_.test_count(), max_tests));
    }

    void check_references()
    {
        const bool of_emitters = !test_.emitters.empty();
        const std::size_t objects = of_emitters ? test_.emitters.size() : test_.bsdfs.size();
        const std::size_t places = of_emitters ? test_.distances.size() : test_.angles.size();
        const char* const place = of_emitters ? "distance" : "angle";
        const std::size_t expected = objects > 0 ? objects * places : test_.scenes.size();
        if (test_.references.size() == expected) return;
        const std::string wanted =
            objects > 1 ? fmt::format("{} numbers, one for each of {} {}s of each of {} {}", expected, places,
                                      place, objects, of_emitters ? "emitters" : "bsdfs")
            : objects > 0 ? fmt::format("one number for each {}, {} in all", place, places)
                          : fmt::format("one number for each scene, {} in all", expected);
        for (const Element& child : root_.children)
            if (child.value("name") == "references" && child.attribute("value"))
                diagnostics_.error(
                    child.value_place(*child.attribute("value")),
                    fmt::format("references must hold {}, not {}", wanted, test_.references.size()));
    }

    void make_sampler()
    {
        const Params params("sampler", "independent", root_.place(), diagnostics_, root_.file->directory());
        for (const Entry<Sampler>& entry : sampler_types())
            if (entry.name == "independent") test_.sampler = entry.build(params);
    }

    const Element& root_;
    const RenderSettings& settings_;
    Diagnostics& diagnostics_;
    TestFile test_;
};

bool check_root(const Element& root, Diagnostics& diagnostics)
{
    if (root.tag == "test") return true;
    diagnostics.error(root.place(),
                      root.tag == "scene"
                          ? std::string("a <scene> file is not a test; 'renderer FILE' renders it")
                          : fmt::format("the root of a test file must be <test>, not <{}>", root.tag));
    return false;
}

} // namespace

TestFile load_test(const std::filesystem::path& path, const RenderSettings& settings)
{
    Diagnostics diagnostics;
    auto document = parse_document(path, read_text(path), diagnostics);
    if (!document || !check_root(*document, diagnostics)) throw SceneError(diagnostics.all());
    const Expansion expansion =
        expand(*std::move(document), {settings.scene.definitions.begin(), settings.scene.definitions.end()},
               diagnostics);
    TestFile test = TestBuilder(expansion.root, settings, diagnostics).build();
    auto found = in_file_order(diagnostics.all(), expansion.files);
    if (diagnostics.has_errors()) throw SceneError(std::move(found));
    test.warnings = std::move(found);
    return test;
}

} // namespace plumb
