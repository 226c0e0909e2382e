// SPDX-License-Identifier: MIT
#pragma once

// A dialect as data, and the step that rewrites a tree of that dialect into our own words and our own order. What is
// built of the tree never sees the dialect: what dialects mean differently is a parameter of our own language, which a
// dialect presets.
//
// kind is ours ("shape" for mesh and shape); type is the file's; an empty type is every type of the kind.

#include "scene_file/document.h"

#include <span>
#include <string_view>

namespace plumb {

// Rewrites a parameter in place. false: it has reported what is wrong, and the parameter is left out.
using Convert = bool (*)(Element& parameter, Diagnostics& diagnostics);

struct TagName {
    std::string_view theirs, ours;
};
struct TypeName {
    std::string_view kind, theirs, ours;
    std::string_view warning = {}; // what is approximated
    std::string_view like = {};    // the type whose other rows it has; empty: its own name
};
// The first row that fits wins.
struct ParamName {
    std::string_view kind, type, theirs, ours;
    Convert convert = nullptr; // of values; textures and references are renamed only
};
struct Preset {
    std::string_view kind, type, tag, name, value; // our parameter, unless the file gives it
    std::string_view unless = {};                  // nor this one, in our words
    bool replaces = false;                         // also where the file gives it
};
struct Refusal {
    std::string_view kind, type, instead;
    bool once = false;           // one message for all elements of a file that have the same advice
    std::string_view first = {}; // of a tag: --lenient puts its first child of this tag in its place
};
// A parameter that is left out.
struct Ignored {
    std::string_view kind, type, name; // name "*": whatever our type has no parameter for
    std::string_view warning = {};     // of "*": {0} is the name, {1} the kind, {2} the type
    // Only in files whose dialect nobody has set; "*" is then no name that is near one of our parameters, and no texture.
    bool only_unset = false;
};

struct Vocabulary {
    std::string_view name;
    std::span<const TagName> tags = {};
    std::span<const TypeName> types = {};
    std::span<const ParamName> params = {};
    std::span<const Preset> presets = {};
    std::span<const Refusal> refusals = {};
    std::span<const Ignored> ignored = {};
    // Whether the tables are all that there is: a tag, type or parameter without a row is an error, also where our own
    // language has the word. Otherwise what has no row stays as it is.
    bool complete = false;
    // Whether upper and lower case, blanks, - and _ make no difference in names of types. Names of our own types, written
    // exactly, always mean those.
    bool folds = false;
    // The syntax of parameters and of the operations of a transform, in the file's words, before anything else is done.
    Convert syntax = nullptr;
    // What is somewhere else, or nowhere, in files of this family; after all else.
    void (*order)(Element& root, Diagnostics& diagnostics) = nullptr;
    // The row for a type that no table has and that our own language does not have either, by the words in its name; or
    // null.
    const TypeName* (*guess)(std::string_view kind, std::string_view theirs) = nullptr;
    const Vocabulary* base = nullptr; // where to look next
};

struct ArrangeOptions {
    std::span<const Preset> overrides =
        {};               // win over those of the vocabulary; of them, the first one that fits
    bool lenient = false; // unknown parameters are warnings
    bool unset = false;   // neither the file nor the command line names a dialect
};

// The same tree in our own words. Places still point to the file; Element::written has the words of the file.
Element arrange(Element root, const Vocabulary& words, const ArrangeOptions& options,
                Diagnostics& diagnostics);

// The row of a type; null: no row has it.
const TypeName* find_type(const Vocabulary& words, std::string_view kind, std::string_view theirs);
// The file's name of one of our parameters, where the vocabulary is complete: else it may have any of several, and ours.
std::string_view written_parameter(const Vocabulary& words, std::string_view kind, std::string_view type,
                                   std::string_view ours);
// Our name of a type; the same name where no row has it.
std::string_view our_type(const Vocabulary& words, std::string_view kind, std::string_view theirs);

// For converters and for order().
Attribute* find_attribute(Element& element, std::string_view name);
// Gives the attribute a value that does not stand in the file.
void set_attribute(Element& element, std::string_view name, std::string value);
// A parameter that no file contains, with the place of the element `at`.
Element made_parameter(const Element& at, std::string_view tag, std::string_view name,
                       std::string_view value);
Element made_object(const Element& at, std::string_view tag, std::string_view type);
// Keeps what the file says, before it is replaced.
void rename_tag(Element& element, std::string_view ours);
void rename_attribute_value(Element& element, std::string_view attribute, std::string_view ours);

} // namespace plumb
