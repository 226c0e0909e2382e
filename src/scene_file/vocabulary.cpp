// SPDX-License-Identifier: MIT
#include "scene_file/vocabulary.h"

#include "plumb/scene_file/scene_file.h"
#include "scene_file/catalog.h"
#include "scene_file/folded_name.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace plumb {

namespace {

template <class Row>
bool fits(const Row& row, std::string_view kind, std::string_view type)
{
    return (row.kind.empty() || row.kind == kind) && (row.type.empty() || row.type == type);
}

// The first row of a table of the vocabulary, then of its base, for which `is_it` holds; or null.
template <class Row, class Test>
const Row* find_row(const Vocabulary& words, std::span<const Row> Vocabulary::*table, const Test& is_it)
{
    for (const Vocabulary* from = &words; from; from = from->base)
        for (const Row& row : from->*table)
            if (is_it(row)) return &row;
    return nullptr;
}

bool is_our_type(std::string_view kind, std::string_view name)
{
    const auto& types = known_types();
    return std::any_of(types.begin(), types.end(),
                       [&](const TypeInfo& type) { return type.kind == kind && type.name == name; });
}

std::vector<std::string_view> our_parameters(std::string_view kind, std::string_view type)
{
    for (const TypeInfo& info : known_types())
        if (info.kind == kind && info.name == type) return parameters_in(info.manual);
    return {};
}

// The type whose rows one has.
std::string_view type_in_tables(const Vocabulary& words, std::string_view kind, std::string_view theirs)
{
    const TypeName* row = find_type(words, kind, theirs);
    return !row ? theirs : row->like.empty() ? row->theirs : row->like;
}

std::string kind_in_tables(const Element& element)
{
    const std::string_view kind = kind_of_tag(element.tag);
    return kind.empty() ? element.tag : std::string(kind);
}

bool is_transform_operation(std::string_view tag)
{
    return parents_of(tag) == std::vector<std::string_view>{"transform"};
}

Written& written_of(Element& element)
{
    auto copy = element.written ? std::make_shared<Written>(*element.written) : std::make_shared<Written>();
    Written& written = *copy;
    element.written = std::move(copy);
    return written;
}

class Arranger {
public:
    Arranger(const Vocabulary& words, const ArrangeOptions& options, Diagnostics& diagnostics)
        : words_(words), options_(options), diagnostics_(diagnostics)
    {}

    // Recursion ends: parse_document().
    void collect_bsdfs(const Element& element)
    {
        if (element.tag == "bsdf" && !element.value("id").empty()) bsdfs_.insert(element.value("id"));
        for (const Element& child : element.children) collect_bsdfs(child);
    }

    // Recursion ends: parse_document(). false: left out.
    bool object(Element& element)
    {
        const std::string kind = kind_in_tables(element), written = element.value("type");
        const std::string type(type_in_tables(words_, kind, written));
        const Outcome outcome = rename_type(element, kind, written);
        if (outcome != Outcome::fine) return outcome == Outcome::stands_in;
        std::vector<Element> kept;
        kept.reserve(element.children.size());
        for (Element& child : element.children)
            if (arrange_child(child, kind, type)) kept.push_back(std::move(child));
        element.children = std::move(kept);
        preset(element, kind, type);
        return true;
    }

private:
    bool arrange_child(Element& child, const std::string& kind, const std::string& type)
    {
        if (words_.syntax && !words_.syntax(child, diagnostics_)) return false;
        if (!rename_tag_of(child)) return false;
        if (is_property_tag(child.tag)) return operations(child) && rename_parameter(child, kind, type);
        // The name of what is no texture says nothing: <ref name="bsdf" id="wood"/>.
        if (child.tag == "ref" && bsdfs_.contains(child.value("id")))
            std::erase_if(child.attributes, [](const Attribute& a) { return a.name == "name"; });
        if ((child.tag == "texture" || child.tag == "ref") && child.attribute("name") &&
            !rename_parameter(child, kind, type))
            return false;
        return child.tag == "ref" || object(child);
    }

    bool rename_tag_of(Element& child)
    {
        if (const auto* tag = find_row(words_, &Vocabulary::tags,
                                       [&](const TagName& name) { return name.theirs == child.tag; })) {
            if (tag->ours != child.tag) rename_tag(child, tag->ours);
            return true;
        }
        if (const auto* refusal = find_row(words_, &Vocabulary::refusals, [&](const Refusal& row) {
                return row.kind == child.tag && row.type.empty();
            })) {
            const std::optional<Element> first = first_of(child, *refusal);
            refuse_tag(child, *refusal, first.has_value());
            if (!first) return false;
            child = *first;
            return true;
        }
        if (!words_.complete) return true;
        std::vector<std::string_view> known;
        for (const Vocabulary* from = &words_; from; from = from->base)
            for (const TagName& name : from->tags) known.push_back(name.theirs);
        diagnostics_.error(child.place(),
                           fmt::format("unknown tag <{}>{}", child.tag, way_out(child.tag, known)));
        return false;
    }

    std::optional<Element> first_of(const Element& element, const Refusal& refusal) const
    {
        if (!options_.lenient || refusal.first.empty()) return {};
        for (Element first : element.children) {
            if (first.tag != refusal.first) continue;
            first.attributes = element.attributes; // its name
            return first;
        }
        return {};
    }

    void refuse_tag(const Element& child, const Refusal& refusal, bool first_stands_in)
    {
        if (refusal.once && !refused_.insert({child.file.get(), refusal.instead}).second) return;
        const std::string_view rest = first_stands_in    ? "; the first stands for all"
                                      : !refusal.once    ? options_.lenient ? "; it is left out" : ""
                                      : options_.lenient ? "; it and all others are left out"
                                                         : "; --lenient leaves it and all others out";
        diagnostics_.unsupported(child.place(),
                                 fmt::format("<{}> is not supported; {}{}", child.tag, refusal.instead, rest),
                                 options_.lenient);
    }

    enum class Outcome { fine, stands_in, left_out };

    // What is refused stays as something that cannot be built, and of which nothing more is said; --lenient leaves it out.
    Outcome refuse(Element& element, const SourceLocation& at, const std::string& message,
                   bool is_misspelled = false)
    {
        if (options_.lenient) {
            diagnostics_.warning(at, message + "; it is left out");
            return Outcome::left_out;
        }
        if (is_misspelled)
            diagnostics_.error(at, message);
        else
            diagnostics_.unsupported(at, message, false);
        element.children.clear();
        find_attribute(element, "type")->broken = true;
        return Outcome::stands_in;
    }

    Outcome rename_type(Element& element, const std::string& kind, const std::string& type)
    {
        const Attribute* attribute = element.attribute("type");
        if (!attribute || attribute->broken) return Outcome::fine;
        const SourceLocation at = element.value_place(*attribute);
        const auto is_it = [&](const auto& row) { return row.kind == kind && row.type == type; };
        if (const Refusal* refusal = find_row(words_, &Vocabulary::refusals, is_it))
            return refuse(
                element, at,
                fmt::format("{} '{}' is not supported; {}", element.written_tag(), type, refusal->instead));
        if (const TypeName* row = find_type(words_, kind, type)) {
            if (!row->warning.empty()) diagnostics_.warning(at, std::string(row->warning));
            if (row->ours != type) rename_attribute_value(element, "type", row->ours);
            return Outcome::fine;
        }
        if (!words_.complete) return options_.lenient ? leave_out(kind, type, at) : Outcome::fine;
        std::vector<std::string_view> known;
        for (const Vocabulary* from = &words_; from; from = from->base)
            for (const TypeName& name : from->types)
                if (name.kind == kind) known.push_back(name.theirs);
        return refuse(element, at,
                      fmt::format("unknown {} '{}'{}", element.written_tag(), type, way_out(type, known)),
                      !closest_name(type, known).empty());
    }

    // A type that is not our own either, of a kind that a scene can do without.
    Outcome leave_out(const std::string& kind, const std::string& type, const SourceLocation& at)
    {
        constexpr std::string_view kinds[] = {"shape", "bsdf", "texture", "emitter"};
        if (std::find(std::begin(kinds), std::end(kinds), kind) == std::end(kinds) || is_our_type(kind, type))
            return Outcome::fine;
        diagnostics_.warning(at, fmt::format("unknown {} '{}'; it is left out", kind, type));
        return Outcome::left_out;
    }

    bool rename_parameter(Element& child, const std::string& kind, const std::string& type)
    {
        const Attribute* attribute = child.attribute("name");
        if (!attribute) return true; // whoever reads it reports it
        const std::string name = attribute->value;
        if (const Ignored* ignored = find_row(words_, &Vocabulary::ignored, [&](const Ignored& row) {
                return fits(row, kind, type) && row.name == name;
            })) {
            if (!ignored->warning.empty())
                diagnostics_.warning(child.value_place(*attribute), std::string(ignored->warning));
            return false;
        }
        if (const ParamName* row = find_row(words_, &Vocabulary::params, [&](const ParamName& param) {
                return fits(param, kind, type) && param.theirs == name;
            })) {
            if (row->ours != name) rename_attribute_value(child, "name", row->ours);
            return child.tag == "texture" || child.tag == "ref" || !row->convert ||
                   row->convert(child, diagnostics_);
        }
        if (is_left_out_as_unknown(child, kind, type)) return false;
        if (!words_.complete || attribute->broken || has_any_name(kind, type)) return true;
        const std::vector<std::string_view> known = known_parameters(kind, type);
        const std::string message =
            fmt::format("unknown {} '{}' for {}{}{}", child.tag == "texture" ? "texture" : "parameter", name,
                        kind, type.empty() ? "" : fmt::format(" '{}'", type),
                        known.empty() ? "; it takes none" : way_out(name, known));
        if (closest_name(name, known).empty())
            diagnostics_.unsupported(child.value_place(*attribute), message, options_.lenient);
        else // a misspelling
            diagnostics_.add(options_.lenient ? Severity::warning : Severity::error,
                             child.value_place(*attribute), message);
        return false;
    }

    bool is_left_out_as_unknown(const Element& child, const std::string& kind, const std::string& type)
    {
        const auto* row = find_row(words_, &Vocabulary::ignored, [&](const Ignored& ignored) {
            return fits(ignored, kind, type) && ignored.name == "*" &&
                   (!ignored.only_unset || (options_.unset && is_property_tag(child.tag)));
        });
        if (!row) return false;
        const std::string name = child.value("name");
        const std::vector<std::string_view> ours = our_parameters(kind, our_type(words_, kind, type));
        if (std::find(ours.begin(), ours.end(), name) != ours.end()) return false;
        if (row->only_unset && (is_ignored_anyway(kind, type, name) || !closest_name(name, ours).empty()))
            return false;
        if (!row->warning.empty())
            diagnostics_.warning(child.value_place(*child.attribute("name")),
                                 fmt::format(fmt::runtime(row->warning), name, kind, type));
        return true;
    }

    // By whoever builds it, with words of its own.
    static bool is_ignored_anyway(const std::string& kind, const std::string& type, const std::string& name)
    {
        return find_ignored(kind, type, name) != nullptr;
    }

    // The file's names of what the type has; rows for all types name more.
    std::vector<std::string_view> known_parameters(const std::string& kind, const std::string& type) const
    {
        const std::vector<std::string_view> ours = our_parameters(kind, our_type(words_, kind, type));
        std::vector<std::string_view> known;
        for (const Vocabulary* from = &words_; from; from = from->base)
            for (const ParamName& row : from->params)
                if (fits(row, kind, type) && (!row.type.empty() || kind_of_tag(kind).empty() ||
                                              std::find(ours.begin(), ours.end(), row.ours) != ours.end()))
                    known.push_back(row.theirs);
        std::sort(known.begin(), known.end());
        known.erase(std::unique(known.begin(), known.end()), known.end());
        return known;
    }

    // Whether parameters of it may have any name.
    bool has_any_name(const std::string& kind, const std::string& type) const
    {
        return find_row(words_, &Vocabulary::params, [&](const ParamName& param) {
                   return fits(param, kind, type) && param.theirs == "*";
               }) != nullptr;
    }

    bool operations(Element& transform)
    {
        if (transform.tag != "transform") return true;
        bool good = true;
        for (Element& operation : transform.children)
            if (is_transform_operation(operation.tag) && words_.syntax)
                good = words_.syntax(operation, diagnostics_) && good;
        return good;
    }

    void preset(Element& element, const std::string& kind, const std::string& type)
    {
        std::vector<std::string_view> done;
        const auto apply = [&](const Preset& row) {
            if (!fits(row, kind, type) || std::find(done.begin(), done.end(), row.name) != done.end()) return;
            done.push_back(row.name);
            if (!row.unless.empty() && gives(element, row.unless)) return;
            if (row.replaces)
                std::erase_if(element.children, [&](const Element& child) {
                    return is_property_tag(child.tag) && child.value("name") == row.name;
                });
            else if (gives(element, row.name))
                return;
            element.children.push_back(made_parameter(element, row.tag, row.name, row.value));
        };
        for (const Preset& row : options_.overrides) apply(row);
        for (const Vocabulary* from = &words_; from; from = from->base)
            for (const Preset& row : from->presets) apply(row);
    }

    // Whether the element has the parameter; a texture without a name is for the one that takes textures.
    static bool gives(const Element& element, std::string_view name)
    {
        for (const Element& child : element.children) {
            if (child.value("name") == name) return true;
            if ((child.tag != "texture" && child.tag != "ref") || child.attribute("name")) continue;
            const auto takes = texture_parameters_of(kind_of_tag(element.tag), element.value("type"));
            if (takes.size() == 1 && takes.front() == name) return true;
        }
        return false;
    }

    const Vocabulary& words_;
    const ArrangeOptions& options_;
    Diagnostics& diagnostics_;
    std::set<std::pair<const TextFile*, std::string_view>> refused_; // once is enough
    std::set<std::string, std::less<>> bsdfs_;                       // their ids
};

} // namespace

Element arrange(Element root, const Vocabulary& words, const ArrangeOptions& options,
                Diagnostics& diagnostics)
{
    Arranger arranger(words, options, diagnostics);
    arranger.collect_bsdfs(root);
    arranger.object(root);
    for (const Vocabulary* from = &words; from; from = from->base)
        if (from->order) {
            from->order(root, diagnostics);
            break;
        }
    return root;
}

std::string_view written_parameter(const Vocabulary& words, std::string_view kind, std::string_view type,
                                   std::string_view ours)
{
    if (!words.complete) return ours;
    const auto* row = find_row(words, &Vocabulary::params, [&](const ParamName& param) {
        return fits(param, kind, type) && param.ours == ours;
    });
    return row ? row->theirs : ours;
}

const TypeName* find_type(const Vocabulary& words, std::string_view kind, std::string_view theirs)
{
    for (const Vocabulary* from = &words; from; from = from->base)
        for (const TypeName& row : from->types)
            if (row.kind == kind && row.theirs == theirs) return &row;
    if (theirs.empty() || is_our_type(kind, theirs)) return nullptr;
    const std::string name = folded(theirs);
    for (const Vocabulary* from = &words; from; from = from->base)
        if (from->folds)
            for (const TypeName& row : from->types)
                if (row.kind == kind && folded(row.theirs) == name) return &row;
    for (const Vocabulary* from = &words; from; from = from->base)
        if (const TypeName* row = from->guess ? from->guess(kind, theirs) : nullptr) return row;
    return nullptr;
}

std::string_view our_type(const Vocabulary& words, std::string_view kind, std::string_view theirs)
{
    const TypeName* row = find_type(words, kind, theirs);
    return row ? row->ours : theirs;
}

Attribute* find_attribute(Element& element, std::string_view name)
{
    const auto found = std::find_if(element.attributes.begin(), element.attributes.end(),
                                    [&](const Attribute& attribute) { return attribute.name == name; });
    return found == element.attributes.end() ? nullptr : &*found;
}

void set_attribute(Element& element, std::string_view name, std::string value)
{
    if (Attribute* attribute = find_attribute(element, name)) {
        attribute->verbatim = attribute->verbatim && attribute->value == value;
        attribute->value = std::move(value);
        return;
    }
    Attribute made;
    made.name = name;
    made.value = std::move(value);
    made.name_offset = made.value_offset = element.tag_offset;
    made.value_length = element.written_tag().size() + 1;
    made.verbatim = false;
    element.attributes.push_back(std::move(made));
}

Element made_parameter(const Element& at, std::string_view tag, std::string_view name, std::string_view value)
{
    Element element;
    element.tag = tag;
    element.file = at.file;
    element.tag_offset = at.tag_offset;
    auto written = std::make_shared<Written>();
    written->tag = at.written_tag(); // so that its place is that of the whole element
    element.written = std::move(written);
    set_attribute(element, "name", std::string(name));
    set_attribute(element, "value", std::string(value));
    return element;
}

Element made_object(const Element& at, std::string_view tag, std::string_view type)
{
    Element element;
    element.tag = tag;
    element.file = at.file;
    element.tag_offset = at.tag_offset;
    if (!type.empty()) set_attribute(element, "type", std::string(type));
    return element;
}

void rename_tag(Element& element, std::string_view ours)
{
    Written& written = written_of(element);
    if (written.tag.empty()) written.tag = element.tag;
    element.tag = ours;
}

void rename_attribute_value(Element& element, std::string_view attribute, std::string_view ours)
{
    Written& written = written_of(element);
    std::string& kept = attribute == "type" ? written.type : written.name;
    if (kept.empty()) kept = element.value(attribute);
    set_attribute(element, attribute, std::string(ours));
}

} // namespace plumb
