// SPDX-License-Identifier: MIT
#pragma once

// Every type name that the scene language knows.

#include "plumb/model/params.h"

#include <span>

namespace plumb {

class Bsdf;
class Camera;
struct Composite;
class Emitter;
class Integrator;
class Sampler;

// A type name, what builds it, and the class whose doc block is its manual.
template <class Kind>
struct Entry {
    std::string_view name;
    std::unique_ptr<Kind> (*build)(const Params&);
    std::string_view class_name;
};

std::span<const Entry<Shape>> shape_types();
std::span<const Entry<Composite>> composite_types(); // groups and instances
std::span<const Entry<Bsdf>> bsdf_types();
std::span<const Entry<Texture>> texture_types();
std::span<const Entry<Emitter>> emitter_types();
std::span<const Entry<Camera>> camera_types();
std::span<const Entry<Sampler>> sampler_types();
std::span<const Entry<Filter>> filter_types();
std::span<const Entry<Integrator>> integrator_types();

// The kind of object that a tag stands for ("shape" for mesh and shape, else the tag); empty for other tags.
std::string_view kind_of_tag(std::string_view tag);
// The kind that has a type of this name, or "".
std::string_view kind_of_type(std::string_view name);

// A parameter that course files carry and the courses' own code never reads.
struct IgnoredParameter {
    std::string_view kind; // empty: every kind
    std::string_view type; // empty: every type
    std::string_view name;
    std::string_view instead;         // the parameter that is read, if the image could be meant to differ
    std::string_view instead_default; // what it is when it is not given
};
const IgnoredParameter* find_ignored(std::string_view kind, std::string_view type, std::string_view name);

// The parameters that a manual page lists.
std::vector<std::string_view> parameters_in(std::string_view manual);
// Those of a type that may be textures, as its manual page says.
std::vector<std::string_view> texture_parameters_of(std::string_view kind, std::string_view type);

} // namespace plumb
