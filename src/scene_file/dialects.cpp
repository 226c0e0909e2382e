// SPDX-License-Identifier: MIT
#include "scene_file/dialects.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr DialectName all_courses[] = {DialectName::zaragoza, DialectName::mcgill, DialectName::eth,
                                       DialectName::epfl};

bool only(const Mark& mark, DialectName course)
{
    return mark.courses == course_bit(course);
}

bool allows(const Mark& mark, DialectName course)
{
    return (mark.courses & course_bit(course)) != 0;
}

std::string names(unsigned who)
{
    std::string list;
    for (const DialectName course : all_dialects)
        if ((who & course_bit(course)) != 0)
            list.append(list.empty() ? "" : " and ").append(to_string(course));
    return list;
}

// The marks that decide for one course, its own and weightiest first; empty: they do not.
std::vector<const Mark*> deciding_marks(const std::vector<Mark>& marks, DialectName course)
{
    std::vector<const Mark*> found;
    for (const Mark& mark : marks)
        if (allows(mark, course)) found.push_back(&mark);
    std::stable_sort(found.begin(), found.end(), [course](const Mark* a, const Mark* b) {
        return std::pair(only(*a, course), a->weight) > std::pair(only(*b, course), b->weight);
    });
    if (found.empty()) return {};
    const Mark& first = *found.front();
    const auto seconds = [&](const Mark* mark) {
        return mark != &first && (first.weight == MarkWeight::parameter || mark->weight != MarkWeight::name);
    };
    const auto second = std::find_if(found.begin(), found.end(), seconds);
    // What EPFL shares with ETH is read as EPFL's, where ETH has nothing of its own.
    if (first.weight == MarkWeight::sign && (only(first, course) || course == DialectName::epfl))
        return {&first};
    if (first.weight == MarkWeight::name || !only(first, course) || second == found.end()) return {};
    return {&first, *second};
}

// Whether marks speak against a course that others decide for. by_name: type names count, too.
bool is_contradicted(const std::vector<Mark>& marks, DialectName course, MarkWeight weight, bool by_name)
{
    return std::any_of(marks.begin(), marks.end(), [&](const Mark& mark) {
        if (mark.courses == plumb_files) return weight != MarkWeight::sign;
        return !allows(mark, course) && (by_name || mark.weight >= MarkWeight::parameter);
    });
}

bool decides_for_plumb(const std::vector<Mark>& marks)
{
    return std::any_of(marks.begin(), marks.end(),
                       [](const Mark& mark) { return mark.courses == plumb_files; });
}

std::optional<DialectEvidence> decide(const std::vector<Mark>& marks, bool by_name)
{
    for (const DialectName course : all_courses) {
        const std::vector<const Mark*> deciding = deciding_marks(marks, course);
        if (deciding.empty() || is_contradicted(marks, course, deciding[0]->weight, by_name)) continue;
        DialectEvidence evidence;
        evidence.name = course;
        const auto is_more_than_a_name = [course](const Mark& mark) {
            return mark.weight >= MarkWeight::parameter && only(mark, course);
        };
        evidence.has_second_mark = course == DialectName::eth || // which never has less
                                   std::count_if(marks.begin(), marks.end(), is_more_than_a_name) > 1;
        if (deciding.size() == 1)
            evidence.reason =
                fmt::format("only {} files have {}", names(deciding[0]->courses), deciding[0]->text);
        else
            evidence.reason = fmt::format("only {} files have both {} and {}", to_string(course),
                                          deciding[0]->text, deciding[1]->text);
        return evidence;
    }
    return std::nullopt;
}

// Where nothing decides.
DialectEvidence undecided(const std::vector<Mark>& marks)
{
    DialectEvidence evidence;
    evidence.reason = "no mark in the file indicates a course";
    // The first mark of each course that has its own reading.
    std::map<unsigned, std::string> text_of;
    for (const Mark& mark : marks)
        for (const DialectName course : {DialectName::zaragoza, DialectName::mcgill, DialectName::eth})
            if (mark.weight != MarkWeight::name && only(mark, course))
                text_of.emplace(mark.courses, mark.text);
    if (text_of.empty()) return evidence;
    if (text_of.size() == 1) {
        const auto& [who, text] = *text_of.begin();
        if (decides_for_plumb(marks)) return evidence;
        evidence.reason = fmt::format("{} alone, as {} files have it, is not enough", text, names(who));
    } else {
        evidence.reason = "the file mixes ";
        for (const auto& [who, text] : text_of)
            evidence.reason += fmt::format("{}{} of {} files", who == text_of.begin()->first ? "" : " with ",
                                           text, names(who));
    }
    for (const DialectName course : all_courses)
        if (std::any_of(text_of.begin(), text_of.end(),
                        [&](const auto& entry) { return (entry.first & course_bit(course)) != 0; }))
            evidence.suspects.push_back(course);
    return evidence;
}

// The readings of a course that evidence decides for.
Dialect reading_of(const DialectEvidence& evidence)
{
    Dialect dialect = Dialect::standard(evidence.name);
    if (!evidence.has_second_mark) {
        dialect.mirrored_view = false;
        dialect.environment_flipped = false;
        dialect.environment_scale = 1.f;
    }
    dialect.reason = evidence.reason;
    return dialect;
}

} // namespace

DialectEvidence find_dialect(const Element& root, const std::vector<Element>& beside)
{
    std::vector<Mark> marks = find_marks(root, false);
    if (auto evidence = decide(marks, false)) return *std::move(evidence);
    const DialectEvidence alone = undecided(marks);
    if (alone.suspects.size() > 1 || decides_for_plumb(marks)) return alone;
    for (const Element& other : beside) add_marks(marks, find_marks(other, true));
    auto together = decide(marks, true);
    if (!together) return alone;
    together->reason += ", counting the files beside it";
    return *std::move(together);
}

DialectChoice choose_dialect(const Element& root, const DialectWishes& wishes, Diagnostics& diagnostics)
{
    DialectChoice choice;
    Dialect& dialect = choice.dialect;
    const Attribute* attribute = root.attribute("dialect");
    if (wishes.name) {
        dialect = Dialect::standard(*wishes.name);
        dialect.reason = "set by --dialect";
    } else if (attribute && attribute->value != "auto" && !attribute->broken) {
        const auto name = dialect_from_string(attribute->value);
        dialect = Dialect::standard(name.value_or(DialectName::plumb));
        dialect.reason = "set by the scene file";
        std::vector<std::string_view> known = {"auto"};
        for (const DialectName each : all_dialects) known.push_back(to_string(each));
        if (!name)
            diagnostics.error(
                root.value_place(*attribute),
                fmt::format("unknown dialect '{}'{}", attribute->value, way_out(attribute->value, known)));
    } else {
        const bool has_directory = root.tag == "scene" && root.file;
        choice.evidence = find_dialect(root, has_directory ? scene_files_beside(root.file->path())
                                                           : std::vector<Element>());
        dialect = reading_of(*choice.evidence);
    }

    if (wishes.emitters_absorb) {
        dialect.emitters_absorb = *wishes.emitters_absorb;
        dialect.reason += dialect.emitters_absorb ? "; --emitters absorb" : "; --emitters scatter";
    }
    if (wishes.mirrored_view) {
        dialect.mirrored_view = *wishes.mirrored_view;
        dialect.reason += dialect.mirrored_view ? "; --mirror on" : "; --mirror off";
    }
    if (wishes.environment_scale) {
        dialect.environment_scale = *wishes.environment_scale;
        dialect.reason += fmt::format("; --envmap-scale {}", dialect.environment_scale);
    }
    return choice;
}

} // namespace plumb
