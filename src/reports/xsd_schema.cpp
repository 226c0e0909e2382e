// SPDX-License-Identifier: MIT
#include "reports/scene_schema.h"

#include "base/xml_writer.h"
#include "reports/schema_grammar.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace plumb {

namespace {

class Xsd {
public:
    std::string write() &&
    {
        const std::vector<SchemaKind> kinds = schema_kinds();
        xml_.begin("xs:schema", {{"xmlns:xs", "http://www.w3.org/2001/XMLSchema"}});
        for (const ValueSyntax& syntax : value_syntaxes()) write_syntax(syntax);
        const std::vector<std::string_view> dialects = dialect_names();
        write_words("dialect", {dialects.begin(), dialects.end()});
        const std::vector<std::string_view> parameters = scene_parameters();
        write_words("parameter.scene", {parameters.begin(), parameters.end()});
        write_scene();
        write_transform();
        write_reference("ref", {"id"}, {"name"});
        write_reference("include", {"filename"}, {});
        write_reference("default", {"name", "value"}, {});
        for (const SchemaKind& kind : kinds) write_kind(kind);
        xml_.end();
        return std::move(xml_).finish();
    }

private:
    void attribute(std::string_view name, std::string_view type, bool required)
    {
        xml_.empty("xs:attribute",
                   {{"name", name}, {"type", type}, {"use", required ? "required" : "optional"}});
    }

    void begin_content() { xml_.begin("xs:choice", {{"minOccurs", "0"}, {"maxOccurs", "unbounded"}}); }

    void write_syntax(const ValueSyntax& syntax)
    {
        xml_.begin("xs:simpleType", {{"name", syntax.name}});
        xml_.begin("xs:restriction", {{"base", "xs:string"}});
        xml_.empty("xs:pattern", {{"value", with_variables(syntax.pattern)}});
        xml_.end();
        xml_.end();
    }

    void elements(std::span<const std::string_view> tags)
    {
        for (const std::string_view tag : tags)
            xml_.empty("xs:element", {{"name", tag}, {"type", fmt::format("element.{}", tag)}});
    }

    void write_scene()
    {
        xml_.begin("xs:element", {{"name", "scene"}});
        xml_.begin("xs:complexType");
        begin_content();
        elements(scene_children());
        xml_.begin("xs:element", {{"name", "string"}});
        xml_.begin("xs:complexType");
        attribute("name", "parameter.scene", true);
        attribute("value", "xs:string", true);
        xml_.end();
        xml_.end();
        xml_.end();
        attribute("dialect", "dialect", false);
        for (const std::string_view name : {"name", "id"}) attribute(name, "xs:string", false);
        xml_.end();
        xml_.end();
    }

    void write_transform()
    {
        xml_.begin("xs:group", {{"name", "operations"}});
        xml_.begin("xs:choice");
        for (const Operation& operation : transform_operations()) {
            xml_.begin("xs:element", {{"name", operation.tag}});
            xml_.begin("xs:complexType");
            for (const OperationAttribute& one : operation.attributes) attribute(one.name, one.syntax, true);
            xml_.end();
            xml_.end();
        }
        xml_.end();
        xml_.end();
    }

    void write_reference(std::string_view tag, std::initializer_list<std::string_view> required,
                         std::initializer_list<std::string_view> optional)
    {
        xml_.begin("xs:complexType", {{"name", fmt::format("element.{}", tag)}});
        for (const std::string_view name : required) attribute(name, "xs:string", true);
        for (const std::string_view name : optional) attribute(name, "xs:string", false);
        xml_.end();
    }

    // A string that is one of these, or has a $variable.
    void write_words(const std::string& name, std::vector<std::string> words)
    {
        std::sort(words.begin(), words.end());
        words.erase(std::unique(words.begin(), words.end()), words.end());
        xml_.begin("xs:simpleType", {{"name", name}});
        xml_.begin("xs:union");
        xml_.begin("xs:simpleType");
        xml_.begin("xs:restriction", {{"base", "xs:string"}});
        for (const std::string& word : words) xml_.empty("xs:enumeration", {{"value", word}});
        xml_.end();
        xml_.end();
        xml_.begin("xs:simpleType");
        xml_.begin("xs:restriction", {{"base", "xs:string"}});
        xml_.empty("xs:pattern", {{"value", with_variables("[$]")}});
        xml_.end();
        xml_.end();
        xml_.end();
        xml_.end();
    }

    // All parameters of the kind that an element of this tag may be.
    void write_parameter(const SchemaKind& kind, const ValueTag& tag)
    {
        xml_.begin("xs:element", {{"name", tag.tag}});
        xml_.begin("xs:complexType");
        if (tag.syntax.empty())
            xml_.empty("xs:group", {{"ref", "operations"}, {"minOccurs", "0"}, {"maxOccurs", "unbounded"}});
        attribute("name", kind.other_types.empty() ? fmt::format("parameter.{}", kind.kind) : "xs:string",
                  true);
        if (!tag.syntax.empty()) attribute("value", tag.syntax, true);
        xml_.end();
        xml_.end();
    }

    void write_kind(const SchemaKind& kind)
    {
        std::vector<std::string> types = kind.other_types, parameters;
        for (const SchemaType& type : kind.types) {
            types.push_back(type.name);
            for (const TypeParameter& parameter : type.parameters) parameters.push_back(parameter.name);
        }
        write_words(fmt::format("type.{}", kind.kind), types);
        write_words(fmt::format("parameter.{}", kind.kind), parameters);
        for (const std::string_view tag : kind.tags) {
            xml_.begin("xs:complexType", {{"name", fmt::format("element.{}", tag)}});
            begin_content();
            for (const ValueTag& one :
                 value_tags("float, integer, boolean, string, color, point, vector, transform"))
                write_parameter(kind, one);
            elements(kind.children);
            const bool textured = std::any_of(kind.types.begin(), kind.types.end(),
                                              [](const SchemaType& type) { return !type.textures.empty(); });
            if (textured) elements(std::array{std::string_view("texture")});
            xml_.end();
            attribute("type", fmt::format("type.{}", kind.kind), true);
            attribute("name", "xs:string", false);
            attribute("id", "xs:string", false);
            xml_.end();
        }
    }

    XmlWriter xml_;
};

} // namespace

std::string xsd_schema()
{
    return Xsd().write();
}

} // namespace plumb
