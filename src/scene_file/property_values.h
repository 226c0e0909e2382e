// SPDX-License-Identifier: MIT
#pragma once

// The syntax of values. Every function reads one attribute's value. What is wrong goes to `diagnostics`, unless the
// value is known to be broken, and nothing is returned.

#include "plumb/model/params.h"
#include "scene_file/document.h"

#include <span>

namespace plumb {

// A decimal number and nothing else but blanks around it: finite, also as a 32-bit float. A leading + is fine.
std::optional<double> read_number(const Element& element, const Attribute& attribute,
                                  Diagnostics& diagnostics);
// `count` numbers between commas, blanks or both.
std::optional<std::vector<double>> read_numbers(const Element& element, const Attribute& attribute,
                                                std::initializer_list<std::size_t> counts,
                                                Diagnostics& diagnostics);
// Any number of them, at least one.
std::optional<std::vector<double>> read_number_list(const Element& element, const Attribute& attribute,
                                                    Diagnostics& diagnostics);
// true or false, in upper or lower case.
std::optional<bool> read_boolean(const Element& element, const Attribute& attribute,
                                 Diagnostics& diagnostics);
std::optional<std::int64_t> read_integer(const Element& element, const Attribute& attribute,
                                         Diagnostics& diagnostics);

// Errors for attributes of `element` that are not among `known`, and for missing `required` ones.
// Returns whether the required ones are there.
bool check_attributes(const Element& element, std::initializer_list<std::string_view> required,
                      std::initializer_list<std::string_view> optional, Diagnostics& diagnostics);

// boolean, integer and so on.
std::span<const std::string_view> property_tags();
bool is_property_tag(std::string_view tag);
// The parameter that a property element (boolean, integer, float, string, point, vector, color, transform) gives;
// nothing where it has no name.
std::optional<Property> read_property(const Element& element, Diagnostics& diagnostics);

// The product of a <transform>'s operations; the first one is applied first.
std::optional<Transform> read_transform(const Element& element, Diagnostics& diagnostics);

} // namespace plumb
