// SPDX-License-Identifier: MIT
#pragma once

// What both schemas are made from.

#include "reports/type_parameters.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// The syntax of a value, for elements of parameters and for attributes.
struct ValueSyntax {
    std::string_view name;    // "numbers3"
    std::string_view pattern; // a regular expression of XML Schema, for a value without a $variable
};
std::span<const ValueSyntax> value_syntaxes();
// As one regular expression: the pattern, or anything with a $variable.
std::string with_variables(std::string_view pattern);

// An element of a parameter, <float name="..." value="..."/>, and what its value looks like.
struct ValueTag {
    std::string_view tag;
    std::string_view syntax; // of value_syntaxes()
};
// Those that a parameter may be: of "color or float", color, float and integer. A texture is an object.
std::vector<ValueTag> value_tags(std::string_view type);

// An operation of a transform.
struct OperationAttribute {
    std::string_view name;
    std::string_view syntax;
};
struct Operation {
    std::string_view tag;
    std::vector<OperationAttribute> attributes;
};
std::span<const Operation> transform_operations();

struct SchemaType {
    std::string name;
    std::string summary; // a sentence of the manual
    std::vector<TypeParameter> parameters;
    std::vector<std::string_view> textures; // the parameters that a <texture> may be
};

// Objects of one kind.
struct SchemaKind {
    std::string_view kind;
    std::vector<std::string_view> tags;
    std::vector<std::string_view> children; // tags of objects that may stand in it, but for textures
    std::vector<SchemaType> types;
    std::vector<std::string> other_types; // what other programs call them
};
std::vector<SchemaKind> schema_kinds();

// The tags that may stand in <scene>.
std::vector<std::string_view> scene_children();
// Its own parameters, which are strings.
std::vector<std::string_view> scene_parameters();
// The values of its attribute `dialect`.
std::vector<std::string_view> dialect_names();

} // namespace plumb
