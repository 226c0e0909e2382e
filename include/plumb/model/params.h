// SPDX-License-Identifier: MIT
#pragma once

// What a plugin's constructor reads from the scene file: the constructor is the plugin's schema.
//
// A getter that fails records an error at the parameter's place and returns a harmless value, so that one run finds
// every mistake of a file. A parameter that was given and never asked for is an error too: the loader calls
// reject_unused() after the constructor. Asking records the name, and the names asked for are the suggestions.

#include "plumb/base/error.h"
#include "plumb/math/color.h"
#include "plumb/math/transform.h"
#include "plumb/model/texture.h"

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace plumb {

class Bsdf;
class Filter;
class Shape;

// One parameter of an element, as the file gave it.
struct Property {
    // A list of numbers serves point, vector (2 or 3 of them) and color (3); `tag` tells them apart.
    using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, Transform>;
    std::string tag;  // boolean, integer, float, string, point, vector, color, transform
    std::string text; // as written, for messages
    Value value;
    SourceLocation name_at;  // of the value of the name attribute
    SourceLocation value_at; // of the value attribute (transform: of the element)
    bool broken =
        false; // its value could not be read, which has been reported: getters return their fallback
    mutable bool asked = false;
};

// A closed interval of legal values; `open_min` leaves the lower end out.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool open_min = false;
    bool open_max = false;

    static Range any() { return {}; }
    static Range at_least(double x) { return {x, std::numeric_limits<double>::infinity(), false, false}; }
    static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
    static Range closed(double a, double b) { return {a, b, false, false}; }
    static Range open(double a, double b) { return {a, b, true, true}; }
    static Range positive_to(double b) { return {0.0, b, true, false}; }
    bool contains(double x) const; // and x rounded to float, too, does not reach an open end
    std::string text() const;      // "in (0, 1]", "at least 1", "greater than 0"
};

// A child object that is a texture, under the name that its element gave.
struct TextureChild {
    std::string name;
    std::shared_ptr<const Texture> texture; // null: it could not be made, which has been reported
    SourceLocation at;
    mutable bool asked = false;
};

// A child object that is a BSDF. Known by its place among the others: the order of the file decides.
struct BsdfChild {
    std::shared_ptr<const Bsdf> bsdf; // null: it could not be made, which has been reported
    SourceLocation at;
    mutable bool asked = false;
};

// What messages call an object and its parameters, where the file has other words for them than the plugin.
struct Wording {
    std::string kind;
    std::string type;
    std::function<std::string_view(std::string_view)> parameter; // the file's name of one of ours
};

class Params {
public:
    Params(std::string kind, std::string type, SourceLocation element_at, Diagnostics& diagnostics,
           std::filesystem::path directory);

    // Filled by the loader (and by tests).
    void add(std::string name, Property property);
    void add_texture(TextureChild child) { textures_.push_back(std::move(child)); }
    void add_bsdf(BsdfChild child) { bsdfs_.push_back(std::move(child)); }
    void set_parent_shape(const Shape* shape) { parent_shape_ = shape; }
    void set_lenient(bool lenient) { lenient_ = lenient; }
    void set_wording(Wording wording);

    // What the constructor asks. Those without a default are required.
    bool has(std::string_view name) const; // asks
    bool boolean(std::string_view name, bool fallback) const;
    std::int64_t integer(std::string_view name, std::int64_t fallback, Range range = Range::any()) const;
    float number(std::string_view name, float fallback,
                 Range range = Range::any()) const; // takes an integer too
    std::string string(std::string_view name) const;
    std::string string(std::string_view name, std::string fallback) const;
    // One of the given words; anything else is an error that lists them.
    std::string choice(std::string_view name, std::string fallback,
                       const std::vector<std::string_view>& words) const;
    Vec3f point(std::string_view name, const Vec3f& fallback) const;
    Vec3f vector(std::string_view name, const Vec3f& fallback) const;
    Vec2f vector2(std::string_view name, const Vec2f& fallback) const; // <vector> or <point> with two numbers
    Color color(std::string_view name, const Color& fallback, Range range = Range::at_least(0.0)) const;
    Color color(std::string_view name) const; // required, at least 0
    // A vector or colour of any finite values, or a number, which stands for three.
    Color raw_values(std::string_view name, const Color& fallback) const;
    Transform transform(std::string_view name) const; // the identity if absent
    // Required; relative to the directory of the scene file. Where there is no such file it records the error and gives
    // the path all the same: reading it throws, and the loader knows that this has been reported.
    std::filesystem::path file(std::string_view name) const;
    // A colour or float parameter that a texture child of that name may replace; all its values must be in range.
    std::shared_ptr<const ColorTexture> color_texture(std::string_view name, const Color& fallback,
                                                      Range range = Range::at_least(0.0)) const;
    std::shared_ptr<const NumberTexture> number_texture(std::string_view name, float fallback,
                                                        Range range) const;
    // For objects that take one texture, whatever its name, unless that has been asked for before: the name of the one that
    // is there, else `name`.
    std::string only_texture(std::string_view name) const;

    // The i-th child BSDF in the order of the file. Never null: where there is none, which is an error, or where it could not
    // be made, a black one. Whoever asks for more than one asks for their count first.
    std::shared_ptr<const Bsdf> bsdf(std::size_t i) const;
    std::size_t bsdf_count() const { return bsdfs_.size(); }

    const Shape* parent_shape() const { return parent_shape_; }
    const std::string& type() const { return type_; }
    std::string_view as_written(std::string_view name) const; // a parameter's name, as the file has it

    // Errors and warnings at the value of parameter `name`, or at the element where it is absent. The message of an
    // error follows the parameter's name: fail("alpha", "must be ...") says "alpha must be ...".
    void fail(std::string_view name, std::string message) const;
    void fail_bsdf(std::size_t i, std::string message) const;    // at the i-th child BSDF, which is there
    void warn(std::string_view name, std::string message) const; // the message stands alone
    // A parameter that files carry and we do not read: accepted; with a warning unless the message is empty.
    void ignore(std::string_view name, std::string message = {}) const;

    bool is_unused(std::string_view name) const; // given, and neither asked for nor ignored
    void reject_unused() const;
    const std::vector<std::string>& asked_names() const { return asked_; }
    const std::vector<std::filesystem::path>& files() const { return files_; } // that file() found
    bool missing_file() const { return missing_file_; }                        // file() did not find one

private:
    const Property* find(std::string_view name) const;
    const Property* find_tagged(std::string_view name, std::initializer_list<std::string_view> tags) const;
    const TextureChild* find_texture(std::string_view name) const;
    std::shared_ptr<const Texture> texture_child(std::string_view name) const;
    bool reject_outside(std::string_view name, const Range& range, float smallest, float largest) const;
    Vec3f three_numbers(const Property* property, std::string_view name, const Vec3f& fallback) const;
    const SourceLocation& value_place(std::string_view name) const;
    void reject_unused_bsdfs() const;
    void fail_missing(std::string_view name, std::string_view tag) const;
    const std::string& written_kind() const { return wording_ ? wording_->kind : kind_; }
    const std::string& written_type() const { return wording_ ? wording_->type : type_; }

    std::string kind_;
    std::string type_;
    SourceLocation element_at_;
    Diagnostics& diagnostics_;
    std::optional<Wording> wording_;
    std::filesystem::path directory_;
    std::map<std::string, Property, std::less<>> properties_;
    std::vector<TextureChild> textures_;
    std::vector<BsdfChild> bsdfs_;
    const Shape* parent_shape_ = nullptr;
    bool lenient_ = false;
    mutable std::vector<std::string> asked_;
    mutable std::vector<std::filesystem::path> files_;
    mutable bool missing_file_ = false;
};

// Builds plugin T behind its interface Kind. The body is in src/model/plugin.h and is instantiated once, at the
// end of the plugin's own file; catalog.cpp lists the instances.
template <class T, class Kind>
std::unique_ptr<Kind> build(const Params& params);

} // namespace plumb
