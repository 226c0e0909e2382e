// SPDX-License-Identifier: MIT
#include "scene_file/marks.h"

#include "scene_file/property_values.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr unsigned epfl = course_bit(DialectName::epfl), eth = course_bit(DialectName::eth),
                   zaragoza = course_bit(DialectName::zaragoza), mcgill = course_bit(DialectName::mcgill);

// An object type, or one with a certain child.
struct Row {
    std::string_view tag;   // "shape" stands for mesh, too
    std::string_view type;  // empty: <scene> has none
    std::string_view child; // the name attribute of a property; empty: the type is enough
    unsigned courses;
    MarkWeight weight;
};

// Counted in 1,191 public scene files of 46 repositories. What Plumb reads over without using it (`warp`, `sampling`,
// `shininess`) is a sign: no manual teaches it.
constexpr Row marked_rows[] = {
    {"emitter", "pointlight", "", zaragoza, MarkWeight::sign},
    {"texture", "textmap", "", zaragoza, MarkWeight::sign},
    {"integrator", "path_nee", "", zaragoza, MarkWeight::sign},
    {"emitter", "environment", "rotate", zaragoza, MarkWeight::parameter},
    {"bsdf", "roughconductor", "", zaragoza, MarkWeight::name},
    {"bsdf", "roughsubstrate", "", zaragoza, MarkWeight::name},
    {"bsdf", "roughdielectric", "", zaragoza, MarkWeight::name},
    {"texture", "checker", "", zaragoza, MarkWeight::name},
    {"integrator", "direct_whitted", "", zaragoza, MarkWeight::name},

    {"integrator", "path", "isExplicit", mcgill, MarkWeight::sign},
    {"integrator", "ao", "sampling", mcgill, MarkWeight::sign},
    {"integrator", "direct", "warp", mcgill, MarkWeight::sign},
    {"integrator", "direct-mis", "warp", mcgill, MarkWeight::sign},
    {"bsdf", "phong", "shininess", mcgill, MarkWeight::sign},
    {"bsdf", "phong", "specularCoef", mcgill, MarkWeight::sign},
    {"bsdf", "phong", "diffuseCoef", mcgill, MarkWeight::sign},
    {"scene", "", "accelerator", mcgill, MarkWeight::sign},
    {"integrator", "path", "termination", mcgill, MarkWeight::parameter},
    {"integrator", "direct", "measure", mcgill, MarkWeight::parameter},
    {"bsdf", "phong", "", mcgill, MarkWeight::name},
    {"integrator", "direct-mis", "", mcgill, MarkWeight::name},
    {"shape", "rectangle", "", mcgill, MarkWeight::name},

    {"emitter", "point", "power", eth, MarkWeight::parameter},
    {"test", "ttest", "distances", eth, MarkWeight::parameter},
    {"shape", "sphere", "", eth | mcgill, MarkWeight::name},
    {"texture", "checkerboard_color", "", eth, MarkWeight::name},
    {"texture", "checkerboard_float", "", eth, MarkWeight::name},

    {"test", "ttest", "", epfl | eth, MarkWeight::sign},
    {"integrator", "path_ems", "", epfl, MarkWeight::hint},
    {"integrator", "path_mats", "", epfl | eth, MarkWeight::hint},

    {"sampler", "sobol", "", plumb_files, MarkWeight::sign},
    {"sampler", "stratified", "", plumb_files, MarkWeight::sign},
    {"include", "", "", plumb_files, MarkWeight::sign},
    {"default", "", "", plumb_files, MarkWeight::sign},
};

// A factor of an environment's image that is there to undo a division by 255.
constexpr double undoing_factor = 100.0;

constexpr const char* sphere_with_path_mis = "'sphere' with 'path_mis'";

// A sphere is no second mark beside a sphere with path_mis.
void drop_dependent(std::vector<Mark>& marks)
{
    if (std::any_of(marks.begin(), marks.end(),
                    [](const Mark& mark) { return mark.name == sphere_with_path_mis; }))
        std::erase_if(marks, [](const Mark& mark) { return mark.name == "'sphere'"; });
}

class LightStrategy {
public:
    LightStrategy(const Element& root, bool beside) : root_(root), beside_(beside) {}

    std::vector<Mark> find()
    {
        visit(root_);
        // Frequent together, in ETH's files only; but our own manual teaches both.
        if (sphere_ && path_mis_) add(*sphere_, sphere_with_path_mis, eth, MarkWeight::hint);
        drop_dependent(marks_);
        return std::move(marks_);
    }

private:
    void visit(const Element& element)
    {
        const std::string type = element.value("type");
        const std::string_view tag = element.tag == "mesh" ? std::string_view("shape") : element.tag;
        for (const Row& row : marked_rows) {
            if (row.tag != tag || row.type != type) continue;
            const Element* at = row.child.empty() ? &element : element.child_named(row.child);
            if (!at) continue;
            const std::string_view owner = row.type.empty() ? row.tag : row.type;
            add(*at,
                row.child.empty() ? fmt::format("'{}'", owner)
                                  : fmt::format("'{}' of '{}'", row.child, owner),
                row.courses, row.weight);
        }
        if (tag == "shape" && type == "sphere" && !sphere_) sphere_ = &element;
        if (tag == "integrator" && type == "path_mis") path_mis_ = true;
        if (tag == "emitter" && type == "environment") visit_environment(element);
        for (const Element& child : element.children) visit(child);
    }

    void visit_environment(const Element& element)
    {
        const Element* factor = element.child_named("radiance");
        if (!factor || !element.child_named("filename")) return;
        if (std::strtod(factor->value("value").c_str(), nullptr) >= undoing_factor)
            add(*factor, fmt::format("a factor of {} on an environment image", undoing_factor), zaragoza,
                MarkWeight::parameter);
    }

    void add(const Element& at, std::string name, unsigned courses, MarkWeight weight)
    {
        if (std::any_of(marks_.begin(), marks_.end(), [&](const Mark& mark) { return mark.name == name; }))
            return;
        const SourceLocation place = at.place();
        const bool elsewhere = beside_ || at.file != root_.file;
        std::string text =
            elsewhere ? fmt::format("{} ({}:{})", name, std::filesystem::path(place.file).filename().string(),
                                    place.line)
                      : fmt::format("{} (line {})", name, place.line);
        marks_.push_back({courses, weight, std::move(name), std::move(text)});
    }

    const Element& root_;
    bool beside_;
    std::vector<Mark> marks_;
    const Element* sphere_ = nullptr; // the first one
    bool path_mis_ = false;
};

} // namespace

std::vector<Mark> find_marks(const Element& root, bool beside)
{
    return LightStrategy(root, beside).find();
}

void add_marks(std::vector<Mark>& marks, const std::vector<Mark>& more)
{
    for (const Mark& mark : more) {
        const auto is_known = [&](const Mark& known) { return known.name == mark.name; };
        if (std::none_of(marks.begin(), marks.end(), is_known)) marks.push_back(mark);
    }
    drop_dependent(marks);
}

} // namespace plumb
