// SPDX-License-Identifier: MIT
#include "scene_file/expand.h"

#include "base/named_file.h"
#include "scene_file/foreign_files.h"
#include "scene_file/placement.h"
#include "scene_file/property_values.h"

#include <algorithm>
#include <set>
#include <system_error>

#include <fmt/format.h>

namespace plumb {

namespace {

bool starts_variable(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// The name at the start of `text`, possibly empty.
std::string_view leading_variable(std::string_view text)
{
    if (text.empty() || !starts_variable(text[0])) return {};
    std::size_t end = 1;
    while (end < text.size() &&
           (starts_variable(text[end]) || (text[end] >= '0' && text[end] <= '9') || text[end] == '-'))
        ++end;
    return text.substr(0, end);
}

// One use of a variable: text.substr(begin, length) is $name, ${name} or $$ (then name is empty).
struct Use {
    std::string_view name;
    std::size_t length = 0; // 0: malformed
};

Use use_at(std::string_view text, std::size_t dollar)
{
    const std::string_view rest = text.substr(dollar + 1);
    if (rest.starts_with('$')) return {{}, 2};
    if (rest.starts_with('{')) {
        const std::string_view name = leading_variable(rest.substr(1));
        const bool closed = !name.empty() && rest.substr(1 + name.size()).starts_with('}');
        return {name, closed ? name.size() + 3 : 0};
    }
    const std::string_view name = leading_variable(rest);
    return {name, name.empty() ? 0 : name.size() + 1};
}

class Expander {
public:
    Expander(const Definitions& definitions, Diagnostics& diagnostics, const ExpansionLimits& limits)
        : definitions_(definitions), values_(definitions), diagnostics_(diagnostics), limits_(limits)
    {}

    Expansion expand(Element root)
    {
        files_.push_back(root.file);
        open_.push_back(identity(root.file->path()));
        if (root.tag == "suite") kind_ = "suite";
        text_size_ = root.file->text().size();
        parts_ = root.count_parts();
        gather_children(root);
        substitute_all(root);
        reject_unused_definitions();
        return {std::move(root), std::move(files_)};
    }

private:
    static std::filesystem::path identity(const std::filesystem::path& path)
    {
        std::error_code status;
        const auto canonical = std::filesystem::weakly_canonical(path, status);
        return status ? path : canonical;
    }

    void gather_children(Element& element)
    {
        std::vector<Element> children;
        for (Element& child : element.children) gather(std::move(child), children);
        element.children = std::move(children);
    }

    void gather(Element child, std::vector<Element>& children)
    {
        if (child.tag == "scene" || child.tag == "group") gather_children(child); // of a <test>, of a <suite>
        if (child.tag == "default")
            define(child);
        else if (child.tag == "include")
            include(child, children);
        else
            children.push_back(std::move(child));
    }

    void reject_children(const Element& element)
    {
        for (const Element& child : element.children)
            diagnostics_.error(child.place(), rejection(element, child));
    }

    void define(Element& element)
    {
        reject_children(element);
        if (!check_attributes(element, {"name", "value"}, {}, diagnostics_)) return;
        const std::string name = element.value("name");
        if (leading_variable(name) != name || name.empty()) {
            diagnostics_.error(
                element.value_place(*element.attribute("name")),
                fmt::format("'{}' cannot name a value; names consist of letters, digits, - and _, and "
                            "start with a letter or _",
                            name));
            return;
        }
        declared_.insert(name);
        substitute_all(element);
        const bool is_new =
            values_.emplace(name, element.value("value")).second; // what is there already wins
        if (is_new && element.attribute("value")->broken) broken_values_.insert(name);
    }

    void include(Element& element, std::vector<Element>& children)
    {
        reject_children(element);
        if (!check_attributes(element, {"filename"}, {}, diagnostics_)) return;
        substitute_all(element);
        if (element.attribute("filename")->broken) return;
        const auto [path, way_out, notice] =
            find_named_file(element.file->directory(), element.value("filename"));
        const SourceLocation at = element.value_place(*element.attribute("filename"));
        const auto fail = [&](std::string message) { diagnostics_.error(at, std::move(message)); };
        if (!notice.empty()) diagnostics_.warning(at, notice);
        if (std::find(open_.begin(), open_.end(), identity(path)) != open_.end())
            return fail(fmt::format("'{}' includes itself, directly or through other files", path.string()));
        if (open_.size() > limits_.depth)
            return fail(fmt::format("files include each other more than {} levels deep", limits_.depth));
        if (files_.size() >= limits_.files)
            return fail(fmt::format("more than {} files are included", limits_.files));

        if (text_size_ > limits_.text_size || parts_ > limits_.parts) return; // has been reported
        std::optional<Element> root;
        try {
            std::string text = read_text(path);
            text_size_ += text.size();
            if (text_size_ > limits_.text_size)
                return fail(fmt::format("with '{}', the files of this {} are larger than {} bytes together",
                                        path.string(), kind_, limits_.text_size));
            root = parse_document(path, std::move(text), diagnostics_);
        } catch (const Error& error) {
            return fail(error.what() + way_out);
        }
        if (!root) return;
        if (const auto foreign = foreign_scene(*root)) {
            diagnostics_.add(foreign->severity, foreign->location, foreign->message);
            return;
        }
        files_.push_back(root->file);
        parts_ += root->count_parts();
        if (parts_ > limits_.parts)
            return fail(fmt::format("with '{}', this {} has more than {} elements and attributes",
                                    path.string(), kind_, limits_.parts));
        if (root->tag != kind_) {
            diagnostics_.error(
                root->place(),
                fmt::format("the root of an included file must be <{}>, not <{}>", kind_, root->tag));
            return;
        }
        if (kind_ == "suite")
            check_attributes(*root, {}, {}, diagnostics_);
        else
            check_attributes(*root, {}, {"dialect"}, diagnostics_);
        if (const Attribute* dialect = root->attribute("dialect"))
            diagnostics_.warning(root->name_place(*dialect),
                                 "the dialect of an included file is ignored; that of the main file holds");
        open_.push_back(identity(path));
        for (Element& child : root->children) gather(std::move(child), children);
        open_.pop_back();
    }

    // Recursion ends: parse_document().
    void substitute_all(Element& element)
    {
        for (Attribute& attribute : element.attributes) substitute(element, attribute);
        for (Element& child : element.children) substitute_all(child);
    }

    void substitute(const Element& element, Attribute& attribute)
    {
        const std::string text = attribute.value;
        std::string result;
        std::size_t done = 0;
        for (std::size_t dollar = text.find('$'); dollar != text.npos; dollar = text.find('$', done)) {
            const Use use = use_at(text, dollar);
            if (use.length == 0) {
                diagnostics_.error(
                    element.part_place(attribute, dollar, 1),
                    "expected a name after '$', as in $name or ${name}; write $$ for the sign itself");
                attribute.broken = true;
                return;
            }
            result.append(text, done, dollar - done);
            done = dollar + use.length;
            if (use.name.empty()) {
                result += '$';
                continue;
            }
            const std::string* const value = find_value(use.name);
            if (!value) fail_undefined(use.name, element.part_place(attribute, dollar, use.length));
            if (!value || broken_values_.contains(use.name)) {
                attribute.broken = true;
                continue;
            }
            if (result.size() + value->size() > limits_.value_size)
                return fail_replaced(element, attribute,
                                     fmt::format("with ${} replaced, this value is longer than {} bytes",
                                                 use.name, limits_.value_size));
            result += *value;
        }
        if (done == 0) return;
        replaced_size_ += result.size();
        if (replaced_size_ > limits_.replaced_size)
            return fail_replaced(
                element, attribute,
                fmt::format("with all $names replaced, the values of this {} are longer than {} bytes "
                            "together",
                            kind_, limits_.replaced_size));
        attribute.value = result.append(text, done);
        attribute.verbatim = false;
    }

    void fail_replaced(const Element& element, Attribute& attribute, std::string message)
    {
        diagnostics_.error(element.value_place(attribute), std::move(message));
        attribute.broken = true;
    }

    const std::string* find_value(std::string_view name)
    {
        used_.emplace(name);
        const auto found = values_.find(name);
        return found == values_.end() ? nullptr : &found->second;
    }

    void fail_undefined(std::string_view name, const SourceLocation& at)
    {
        std::vector<std::string_view> known; // in vain where there are many errors and many names
        if (diagnostics_.keeps(Severity::error, fmt::format("${} has no value", name)))
            for (const auto& [known_name, value] : values_) known.push_back(known_name);
        const std::string_view closest = closest_name(name, known);
        diagnostics_.error(
            at, closest.empty()
                    ? fmt::format("${0} has no value; give it one with -D {0}=... or <default name=\"{0}\" "
                                  "value=\"...\"/>",
                                  name)
                    : fmt::format("${} has no value; did you mean '${}'?", name, closest));
    }

    void reject_unused_definitions()
    {
        std::set<std::string_view> names(used_.begin(), used_.end());
        names.insert(declared_.begin(), declared_.end());
        for (const auto& [name, value] : definitions_) {
            if (names.contains(name)) continue;
            diagnostics_.error({}, fmt::format("-D {}={}: no file of this {} uses ${}{}", name, value, kind_,
                                               name, way_out(name, {names.begin(), names.end()})));
        }
    }

    const Definitions& definitions_;
    Definitions values_;
    Diagnostics& diagnostics_;
    const ExpansionLimits& limits_;
    std::string_view kind_ = "scene"; // of file
    std::vector<std::shared_ptr<const TextFile>> files_;
    std::vector<std::filesystem::path> open_; // the files being read, the main one first
    std::size_t text_size_ = 0;               // of all files
    std::size_t parts_ = 0;                   // elements and attributes of all files
    std::size_t replaced_size_ = 0;           // of all values in which variables were replaced
    std::set<std::string> declared_;          // by <default>
    std::set<std::string, std::less<>>
        broken_values_;          // names of values with an error, which has been reported
    std::set<std::string> used_; // as $name
};

} // namespace

Expansion expand(Element root, const Definitions& definitions, Diagnostics& diagnostics,
                 const ExpansionLimits& limits)
{
    return Expander(definitions, diagnostics, limits).expand(std::move(root));
}

} // namespace plumb
