// SPDX-License-Identifier: MIT
#include "model/composite.h"
#include "plumb/image/image.h"
#include "plumb/model/bsdf.h"
#include "plumb/model/camera.h"
#include "plumb/model/emitter.h"
#include "plumb/model/filter.h"
#include "plumb/model/integrator.h"
#include "plumb/model/sampler.h"
#include "plumb/model/shape.h"
#include "plumb/scene_file/scene_file.h"
#include "scene_file/catalog.h"
#include "scene_file/manual.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <set>

using namespace plumb;

namespace {

// What each class is asked for and what its manual says, over all type names that the class serves.
struct Described {
    std::set<std::string> asked;
    std::set<std::string> documented;
    std::string manual;
};

class Survey {
public:
    Survey()
    {
        directory_.write("file", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        Image image(1, 1);
        write_image(directory_ / "file.png", image);
        visit(shape_types(), "shape");
        visit(composite_types(), "shape");
        visit(bsdf_types(), "bsdf");
        visit(texture_types(), "texture");
        visit(emitter_types(), "emitter");
        visit(camera_types(), "camera");
        visit(sampler_types(), "sampler");
        visit(filter_types(), "rfilter");
        visit(integrator_types(), "integrator");
    }

    const std::map<std::string, Described>& classes() const { return classes_; }

private:
    template <class Kind>
    void visit(std::span<const Entry<Kind>> entries, const std::string& kind)
    {
        for (const Entry<Kind>& entry : entries) {
            Described& described = classes_[std::string(entry.class_name)];
            described.manual = plugin_source_manual(entry.class_name);
            for (const std::string_view name : parameters_in(described.manual))
                described.documented.emplace(name);
            // Constructors ask for more when they are given something, or find a file to read.
            build(entry, kind, described, false, "");
            build(entry, kind, described, true, "");
            build(entry, kind, described, false, "file");
            build(entry, kind, described, false, "file.png");
        }
    }

    template <class Kind>
    void build(const Entry<Kind>& entry, const std::string& kind, Described& described, bool all_given,
               const std::string& file)
    {
        Diagnostics diagnostics;
        Params params(kind, std::string(entry.name), {}, diagnostics, directory_.path());
        if (all_given) { // with values that cannot be read
            Property property;
            property.broken = true;
            for (const std::string& name : described.documented) params.add(name, property);
        }
        if (!file.empty()) {
            Property property;
            property.tag = "string";
            property.value = file;
            params.add("filename", property);
            params.add("filepath", property);
        }
        try {
            entry.build(params);
        } catch (const Error&) {
        }
        described.asked.insert(params.asked_names().begin(), params.asked_names().end());
        // What is ignored on purpose is no more unused than what was asked for.
        for (const std::string& name : described.documented)
            if (all_given && !params.is_unused(name)) described.asked.insert(name);
    }

    TempDirectory directory_;
    std::map<std::string, Described> classes_;
};

} // namespace

TEST_CASE("manuals list the parameters that constructors ask for", "[unit][catalog]")
{
    const Survey survey;
    for (const auto& [name, described] : survey.classes()) {
        CAPTURE(name);
        for (const std::string& parameter : described.documented) {
            CAPTURE(parameter);
            CHECK(described.asked.count(parameter) == 1);
        }
        for (const std::string& parameter : described.asked) {
            CAPTURE(parameter);
            CHECK(described.documented.count(parameter) == 1);
        }
    }
}

TEST_CASE("every type has a manual with a sample", "[unit][catalog]")
{
    for (const TypeInfo& type : known_types()) {
        CAPTURE(type.kind, type.name);
        const std::string manual(type.manual);
        REQUIRE(!manual.empty());
        const std::string first = manual.substr(0, manual.find('\n'));
        CHECK(first.size() > 10);
        CHECK(first.find("  ") == std::string::npos);
        CHECK_THAT(manual, ContainsSubstring("        <"));
    }
}

TEST_CASE("type names are unique in their kind", "[unit][catalog]")
{
    std::set<std::pair<std::string_view, std::string_view>> seen;
    for (const TypeInfo& type : known_types()) CHECK(seen.emplace(type.kind, type.name).second);
    CHECK(seen.size() >= 49);
}

TEST_CASE("tags and kinds", "[unit][catalog]")
{
    CHECK(kind_of_tag("mesh") == "shape");
    CHECK(kind_of_tag("shape") == "shape");
    CHECK(kind_of_tag("rfilter") == "rfilter");
    CHECK(kind_of_tag("medium").empty());
    CHECK(kind_of_tag("color").empty());
    CHECK(kind_of_type("path_nee") == "integrator");
    CHECK(kind_of_type("photonmapper").empty());
}

TEST_CASE("parameters that files carry and nobody reads", "[unit][catalog]")
{
    CHECK(find_ignored("shape", "obj", "name"));
    CHECK(find_ignored("bsdf", "phong", "shininess"));
    CHECK_FALSE(find_ignored("bsdf", "diffuse", "shininess"));
    CHECK_FALSE(find_ignored("bsdf", "phong", "exponent"));
}

TEST_CASE("the parameters in a manual", "[unit][catalog]")
{
    const auto names =
        parameters_in("First line.\n\n    alpha   float   text\n  two\n     five\n        <xml/>\n"
                      "    termination-param\tx\n    (not)\n    last");
    CHECK(names == std::vector<std::string_view>{"alpha", "termination-param", "last"});
}
