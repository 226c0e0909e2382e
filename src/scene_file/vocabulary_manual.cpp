// SPDX-License-Identifier: MIT
#include "scene_file/vocabulary_manual.h"

#include "scene_file/folded_name.h"
#include "scene_file/fork_words.h"
#include "scene_file/mitsuba_values.h"
#include "scene_file/mitsuba_words.h"
#include "scene_file/nori_words.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

struct ConvertText {
    Convert convert;
    std::string_view text;
};

constexpr ConvertText convert_texts[] = {
    {depth_minus_one, "minus 1; -1 stays"},
    {only_if_true, "false is as if it were not there"},
    {color_of_emission, "numbers are grey; spectra become linear sRGB"},
    {color_of_reflectance, "numbers are grey; spectra become linear sRGB under D65"},
    {color_of_index, "numbers are grey; spectra become linear sRGB under D65"},
    {to_number, "of a colour the luminance"},
    {index_by_name, "also a name, as bk7"},
    {millimetres, "also with mm"},
    {without_scale, "must not scale"},
    {position_of, "where it moves the origin"},
    {direction_of, "where it turns +z"},
    {angle_of_cosine, "in [-1, 1] a cosine, else degrees"},
    {to_fraction, "limited to [0, 1]"},
    {negated, "negated"},
    {image_of, "also the name of an image's file"},
    {grey_color, "also a number"},
    {data_image_of, "also the name of an image's file, which is not decoded"},
    {uv_scale, "one or two factors"},
    {u_scale, "a factor of u"},
    {v_scale, "a factor of v"},
    {uv_shift, "one or two numbers, added behind scales"},
    {u_shift, "a number added to u"},
    {v_shift, "a number added to v"},
    {only_rgb, "checked; the image is linear RGB"},
};

std::string_view text_of(Convert convert)
{
    for (const ConvertText& row : convert_texts)
        if (row.convert == convert) return row.text;
    return {};
}

// Calls visit(row) for the rows of a table, those of bases last.
template <class Row, class Visit>
void for_rows(const Vocabulary& words, std::span<const Row> Vocabulary::*table, const Visit& visit)
{
    for (const Vocabulary* from = &words; from; from = from->base)
        for (const Row& row : from->*table) visit(row);
}

std::string parameters_text(const Vocabulary& words, const TypeName& type)
{
    std::string text;
    const auto is_of_it = [&](const auto& row) {
        return row.kind == type.kind &&
               (row.type.empty() || row.type == (type.like.empty() ? type.theirs : type.like));
    };
    std::vector<std::string_view> done;
    for_rows(words, &Vocabulary::params, [&](const ParamName& row) {
        if (!is_of_it(row) || row.theirs == "*" ||
            std::find(done.begin(), done.end(), row.theirs) != done.end())
            return;
        done.push_back(row.theirs);
        std::string line = fmt::format("    {:<26}{}", row.theirs, row.ours.empty() ? "ignored" : row.ours);
        if (const std::string_view note = text_of(row.convert); !note.empty())
            line += fmt::format(", {}", note);
        text += line + "\n";
    });
    done.clear();
    for_rows(words, &Vocabulary::presets, [&](const Preset& row) {
        if (!is_of_it(row) || std::find(done.begin(), done.end(), row.name) != done.end()) return;
        done.push_back(row.name);
        text += fmt::format("    {:<26}{} {}\n",
                            row.unless.empty() ? "(unless given)" : fmt::format("(without {})", row.unless),
                            row.name, row.value);
    });
    for_rows(words, &Vocabulary::ignored, [&](const Ignored& row) {
        if (is_of_it(row)) text += fmt::format("    {:<26}ignored\n", row.name);
    });
    return text;
}

} // namespace

std::vector<std::string_view> vocabulary_names()
{
    std::vector<std::string_view> names;
    for (const DialectName dialect : all_dialects) names.push_back(to_string(dialect));
    names.insert(names.end(), {"mitsuba3", "mitsuba06"});
    return names;
}

const Vocabulary* vocabulary_named(std::string_view name)
{
    if (const auto course = dialect_from_string(name)) return &nori_vocabulary(*course);
    return mitsuba_vocabulary_named(name);
}

std::string types_of_vocabulary(const Vocabulary& words)
{
    std::string text;
    std::string_view kind;
    for_rows(words, &Vocabulary::types, [&](const TypeName& row) {
        if (row.kind != kind) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", row.kind);
        kind = row.kind;
        text += fmt::format("  {:<18}{}\n", row.theirs, row.ours);
    });
    std::string refused;
    for_rows(words, &Vocabulary::refusals, [&](const Refusal& row) {
        refused += row.type.empty() ? fmt::format("  <{}>: {}\n", row.kind, row.instead)
                                    : fmt::format("  {} '{}': {}\n", row.kind, row.type, row.instead);
    });
    return refused.empty() ? text : text + "\nnot supported\n" + refused;
}

std::optional<std::string> manual_of_type(const Vocabulary& words, std::string_view type)
{
    std::string text;
    for_rows(words, &Vocabulary::types, [&](const TypeName& row) {
        if (folded(row.theirs) != folded(type)) return;
        text += fmt::format("{}{} '{}' of {}: '{}' here\n\n{}", text.empty() ? "" : "\n", row.kind, type,
                            words.name, row.ours, parameters_text(words, row));
    });
    if (text.empty()) return {};
    return text;
}

} // namespace plumb
