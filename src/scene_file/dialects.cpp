// SPDX-License-Identifier: MIT
#include "scene_file/dialects.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

// Sets of courses.
constexpr unsigned epfl = 1, eth = 2, zaragoza = 4, mcgill = 8;
constexpr struct {
    unsigned bit;
    DialectName name;
} courses[] = {
    {zaragoza, DialectName::zaragoza},
    {mcgill, DialectName::mcgill},
    {epfl, DialectName::epfl},
    {eth, DialectName::eth}}; // where several are possible the first one is taken: ETH's mirror last

// What only some courses' files have: an object type, or one with a certain child.
struct Clue {
    std::string_view tag;
    std::string_view type;
    std::string_view child; // the name attribute of a property or texture; empty: the type is enough
    unsigned courses;
};
constexpr Clue clues[] = {
    {"emitter", "point", "power", eth},
    {"emitter", "point", "radiance", mcgill},
    {"emitter", "pointlight", "", zaragoza},
    {"emitter", "directional", "", mcgill},
    {"emitter", "environment", "", zaragoza},
    {"emitter", "area", "scale", zaragoza},
    {"texture", "checkerboard_color", "", eth},
    {"texture", "checkerboard_float", "", eth},
    {"texture", "constant_color", "", eth},
    {"texture", "constant_float", "", eth},
    {"texture", "imagetexture_color3f", "", eth},
    {"texture", "checker", "", zaragoza},
    {"texture", "textmap", "", zaragoza},
    {"bsdf", "roughconductor", "", zaragoza},
    {"bsdf", "roughsubstrate", "", zaragoza},
    {"bsdf", "roughdielectric", "", zaragoza},
    {"bsdf", "phong", "", mcgill},
    {"bsdf", "microfacet", "", epfl | eth},
    {"shape", "rectangle", "", mcgill},
    {"integrator", "path", "isExplicit", mcgill},
    {"integrator", "path", "termination", mcgill},
    {"integrator", "path", "termination-param", mcgill},
    {"integrator", "path", "direct-measure", mcgill},
    {"integrator", "path", "indirect-measure", mcgill},
    {"integrator", "path", "direct-warp", mcgill},
    {"integrator", "path", "indirect-warp", mcgill},
    {"integrator", "direct", "measure", mcgill},
    {"integrator", "direct", "nSamples", mcgill},
    {"integrator", "direct-mis", "", mcgill},
    {"integrator", "ao", "nSamples", mcgill},
    {"integrator", "path_nee", "", zaragoza},
    {"integrator", "direct_whitted", "", zaragoza},
    {"integrator", "path_ems", "", epfl},
    {"integrator", "whitted", "", epfl},
    {"integrator", "path_mats", "", epfl | eth},
    {"integrator", "av", "", eth},
    {"test", "ttest", "", epfl | eth},
};

// Integrators whose pictures do not depend on what emitters do to light.
constexpr std::string_view blind_integrators[] = {"normals", "depth", "ao", "av", "simple"};

const Element* child_named(const Element& element, std::string_view name)
{
    const auto found = std::find_if(element.children.begin(), element.children.end(),
                                    [&](const Element& child) { return child.value("name") == name; });
    return found == element.children.end() ? nullptr : &*found;
}

bool is_black(const Element& bsdf)
{
    const Element* albedo = child_named(bsdf, "albedo");
    return bsdf.value("type") == "diffuse" && albedo && albedo->tag == "color" &&
           albedo->value("value").find_first_of("123456789") == std::string::npos;
}

class Search {
public:
    explicit Search(const Element& scene) : scene_(scene)
    {
        if (scene.tag == "test")
            visit(scene);
        else
            for (const Element& child : scene.children) visit(child);
    }

    DialectEvidence result() const
    {
        DialectEvidence evidence;
        const unsigned possible = common_ != 0 ? common_ : zaragoza | mcgill | epfl | eth;
        // Conflicting clues leave open the courses that they stand for.
        const unsigned open = conflict() ? claimed_ : possible;
        const auto* chosen = std::find_if(std::begin(courses), std::end(courses),
                                          [&](const auto& course) { return (open & course.bit) != 0; });
        evidence.name = chosen->name;
        evidence.reason = reason(open);
        const bool absorbs = Dialect::standard(chosen->name).emitters_absorb;
        const unsigned differing = absorbs ? epfl | eth : zaragoza | mcgill;
        evidence.emitters_open = (open & differing) != 0 && sees_emitters_ && lamp_reflects_;
        // Without any clue a mirrored picture is only one of many possibilities; for a mean it makes no difference.
        evidence.mirror_open = scene_.tag != "test" && (open & eth) != 0 && chosen->bit != eth &&
                               (!found_.empty() || mesh_sphere_ || evidence.emitters_open);
        return evidence;
    }

private:
    struct Found {
        unsigned courses;
        std::string text;
    };

    bool conflict() const { return !found_.empty() && common_ == 0; }

    void visit(const Element& element)
    {
        const std::string type = element.value("type");
        const std::string_view tag = element.tag == "mesh" ? std::string_view("shape") : element.tag;
        bool clue_in_child = false;
        for (const Clue& clue : clues) {
            if (clue.tag != tag || clue.type != type) continue;
            const Element* child = clue.child.empty() ? &element : child_named(element, clue.child);
            if (!child) continue;
            clue_in_child = clue_in_child || child != &element;
            note(*child, clue.courses,
                 clue.child.empty() ? fmt::format("'{}'", clue.type)
                                    : fmt::format("'{}' of '{}'", clue.child, clue.type));
        }
        if (tag == "integrator" && type == "path" && !clue_in_child) note(element, zaragoza, "'path'");
        if (element.tag == "mesh" && type == "sphere") mesh_sphere_ = true;
        if (tag == "integrator" && std::find(std::begin(blind_integrators), std::end(blind_integrators),
                                             type) != std::end(blind_integrators))
            sees_emitters_ = false;
        if (tag == "shape") visit_lamp(element);
        for (const Element& child : element.children) visit(child);
    }

    void visit_lamp(const Element& shape)
    {
        bool emits = false, black = false;
        for (const Element& child : shape.children) {
            emits = emits || child.tag == "emitter";
            black = black || (child.tag == "bsdf" && is_black(child));
        }
        lamp_reflects_ = lamp_reflects_ || (emits && !black);
    }

    void note(const Element& element, unsigned who, const std::string& what)
    {
        common_ = found_.empty() ? who : common_ & who;
        claimed_ |= who;
        const bool known = std::any_of(found_.begin(), found_.end(),
                                       [&](const Found& earlier) { return earlier.courses == who; });
        if (known) return; // the first of each kind is enough for the reason
        const SourceLocation at = element.place();
        const bool elsewhere = element.file != scene_.file;
        found_.push_back({who, elsewhere ? fmt::format("{} ({}:{})", what, at.file, at.line)
                                         : fmt::format("{} (line {})", what, at.line)});
    }

    static std::string names(unsigned who)
    {
        std::string list;
        for (const auto& course : courses)
            if ((who & course.bit) != 0)
                list.append(list.empty() ? "" : " and ").append(to_string(course.name));
        return list;
    }

    std::string reason(unsigned open) const
    {
        if (found_.empty()) return "nothing in the file is peculiar to one course";
        if (conflict()) {
            std::string list;
            for (const Found& clue : found_)
                list += fmt::format("{}{} of {} files", list.empty() ? "" : " with ", clue.text,
                                    names(clue.courses));
            return "the file mixes " + list;
        }
        const auto decisive = std::find_if(found_.begin(), found_.end(),
                                           [&](const Found& clue) { return clue.courses == open; });
        return fmt::format("only {} files have {}", names(open), decisive->text);
    }

    const Element& scene_;
    std::vector<Found> found_;
    unsigned common_ = 0;  // courses that every clue allows
    unsigned claimed_ = 0; // courses that some clue allows
    bool mesh_sphere_ = false;
    bool sees_emitters_ = true;
    bool lamp_reflects_ = false;
};

void warn_of_open_readings(const Element& scene, const DialectEvidence& evidence, bool emitters_open,
                           bool mirror_open, Diagnostics& diagnostics)
{
    if (!emitters_open && !mirror_open) return;
    std::string text = fmt::format("{}; it is read as {}", evidence.reason, to_string(evidence.name));
    const bool absorbs = Dialect::standard(evidence.name).emitters_absorb;
    if (emitters_open)
        text += absorbs ? ", where light ends at emitters; for epfl and eth they scatter it too, which "
                          "brightens lamps "
                          "and their surroundings (--emitters scatter)"
                        : ", where emitters scatter light too; for zaragoza and mcgill light ends at them "
                          "(--emitters absorb)";
    if (mirror_open) text += "; eth's pictures are mirrored (--mirror on)";
    diagnostics.warning(scene.place(), text + "; --dialect, or a dialect attribute here, settles it");
}

DialectName decide_name(const Element& scene, const DialectWishes& wishes, std::string& reason,
                        Diagnostics& diagnostics)
{
    if (wishes.name) {
        reason = "--dialect says so";
        return *wishes.name;
    }
    const Attribute* attribute = scene.attribute("dialect");
    if (attribute && attribute->value != "auto" && !attribute->broken) {
        reason = "the scene file says so";
        if (const auto name = dialect_from_string(attribute->value)) return *name;
        std::vector<std::string_view> known = {"auto"};
        for (const DialectName name : all_dialects) known.push_back(to_string(name));
        diagnostics.error(
            scene.value_place(*attribute),
            fmt::format("unknown dialect '{}'{}", attribute->value, way_out(attribute->value, known)));
        return DialectName::plumb;
    }
    const DialectEvidence evidence = find_dialect(scene);
    warn_of_open_readings(scene, evidence, evidence.emitters_open && !wishes.emitters_absorb,
                          evidence.mirror_open && !wishes.mirrored_view, diagnostics);
    reason = evidence.reason;
    return evidence.name;
}

} // namespace

DialectEvidence find_dialect(const Element& scene)
{
    return Search(scene).result();
}

Dialect decide_dialect(const Element& scene, const DialectWishes& wishes, Diagnostics& diagnostics)
{
    std::string reason;
    Dialect dialect = Dialect::standard(decide_name(scene, wishes, reason, diagnostics));
    if (wishes.emitters_absorb) {
        dialect.emitters_absorb = *wishes.emitters_absorb;
        reason += dialect.emitters_absorb ? "; --emitters absorb" : "; --emitters scatter";
    }
    if (wishes.mirrored_view) {
        dialect.mirrored_view = *wishes.mirrored_view;
        reason += dialect.mirrored_view ? "; --mirror on" : "; --mirror off";
    }
    if (wishes.environment_scale) {
        dialect.environment_scale = *wishes.environment_scale;
        reason += fmt::format("; --envmap-scale {}", dialect.environment_scale);
    }
    dialect.reason = std::move(reason);
    return dialect;
}

} // namespace plumb
