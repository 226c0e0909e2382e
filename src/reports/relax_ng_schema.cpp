// SPDX-License-Identifier: MIT
#include "reports/scene_schema.h"

#include "base/xml_writer.h"
#include "reports/schema_grammar.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::string_view annotations = "http://relaxng.org/ns/compatibility/annotations/1.0";

class RelaxNg {
public:
    std::string write() &&
    {
        xml_.begin("grammar", {{"xmlns", "http://relaxng.org/ns/structure/1.0"},
                               {"xmlns:a", annotations},
                               {"datatypeLibrary", "http://www.w3.org/2001/XMLSchema-datatypes"}});
        xml_.begin("start");
        write_scene();
        xml_.end();
        for (const ValueSyntax& syntax : value_syntaxes()) write_syntax(syntax);
        write_transform();
        write_any_parameter();
        write_reference("ref", {"id"}, {"name"});
        write_reference("include", {"filename"}, {});
        write_reference("default", {"name", "value"}, {});
        for (const SchemaKind& kind : schema_kinds()) write_kind(kind);
        xml_.end();
        return std::move(xml_).finish();
    }

private:
    void ref(std::string_view name) { xml_.empty("ref", {{"name", name}}); }

    void optional_attribute(std::string_view name)
    {
        xml_.begin("optional");
        xml_.empty("attribute", {{"name", name}});
        xml_.end();
    }

    void attribute(std::string_view name, std::string_view syntax)
    {
        xml_.begin("attribute", {{"name", name}});
        ref(syntax);
        xml_.end();
    }

    void write_syntax(const ValueSyntax& syntax)
    {
        xml_.begin("define", {{"name", syntax.name}});
        xml_.begin("data", {{"type", "string"}});
        xml_.text("param", with_variables(syntax.pattern), {{"name", "pattern"}});
        xml_.end();
        xml_.end();
    }

    // One of these, or a $variable.
    template <class Words>
    void write_words(const Words& words)
    {
        xml_.begin("choice");
        for (const auto& word : words) xml_.text("value", word);
        xml_.begin("data", {{"type", "string"}});
        xml_.text("param", with_variables("[$]"), {{"name", "pattern"}});
        xml_.end();
        xml_.end();
    }

    // Elements that may stand anywhere in their parent, in any number.
    void begin_content()
    {
        xml_.begin("zeroOrMore");
        xml_.begin("choice");
    }
    void end_content()
    {
        xml_.end();
        xml_.end();
    }

    void write_scene()
    {
        xml_.begin("element", {{"name", "scene"}});
        xml_.begin("optional");
        xml_.begin("attribute", {{"name", "dialect"}});
        write_words(dialect_names());
        xml_.end();
        xml_.end();
        for (const std::string_view name : {"name", "id"}) optional_attribute(name);
        begin_content();
        for (const std::string_view name : scene_parameters())
            write_parameter({std::string(name), "string", {}, {}});
        for (const std::string_view tag : scene_children()) ref(fmt::format("element.{}", tag));
        end_content();
        xml_.end();
    }

    void write_transform()
    {
        xml_.begin("define", {{"name", "operations"}});
        begin_content();
        for (const Operation& operation : transform_operations()) {
            xml_.begin("element", {{"name", operation.tag}});
            for (const OperationAttribute& one : operation.attributes) attribute(one.name, one.syntax);
            xml_.end();
        }
        end_content();
        xml_.end();
    }

    // of a parameter, whose name is written already
    void write_value(const ValueTag& tag)
    {
        if (tag.syntax.empty())
            ref("operations");
        else
            attribute("value", tag.syntax);
    }

    // Of types whose parameters are unknown here.
    void write_any_parameter()
    {
        xml_.begin("define", {{"name", "any_parameter"}});
        xml_.begin("choice");
        for (const ValueTag& tag :
             value_tags("float, integer, boolean, string, color, point, vector, transform")) {
            xml_.begin("element", {{"name", tag.tag}});
            xml_.empty("attribute", {{"name", "name"}});
            write_value(tag);
            xml_.end();
        }
        xml_.end();
        xml_.end();
    }

    void write_reference(std::string_view tag, std::initializer_list<std::string_view> required,
                         std::initializer_list<std::string_view> optional)
    {
        xml_.begin("define", {{"name", fmt::format("element.{}", tag)}});
        xml_.begin("element", {{"name", tag}});
        for (const std::string_view name : required) xml_.empty("attribute", {{"name", name}});
        for (const std::string_view name : optional) optional_attribute(name);
        xml_.end();
        xml_.end();
    }

    void write_parameter(const TypeParameter& parameter)
    {
        for (const ValueTag& tag : value_tags(parameter.type)) {
            xml_.begin("element", {{"name", tag.tag}});
            if (!parameter.description.empty()) xml_.text("a:documentation", parameter.description);
            xml_.begin("attribute", {{"name", "name"}});
            xml_.text("value", parameter.name);
            xml_.end();
            write_value(tag);
            xml_.end();
        }
    }

    void write_textures(const SchemaType& type)
    {
        xml_.begin("element", {{"name", "texture"}});
        if (type.textures.size() == 1) xml_.begin("optional");
        xml_.begin("attribute", {{"name", "name"}});
        write_words(type.textures);
        xml_.end();
        if (type.textures.size() == 1) xml_.end();
        optional_attribute("id");
        ref("kind.texture");
        xml_.end();
    }

    void write_type(const SchemaKind& kind, const SchemaType& type)
    {
        xml_.begin("group");
        xml_.begin("attribute", {{"name", "type"}});
        xml_.text("a:documentation", type.summary);
        xml_.text("value", type.name);
        xml_.end();
        begin_content();
        for (const TypeParameter& parameter : type.parameters) write_parameter(parameter);
        if (!type.textures.empty()) write_textures(type);
        ref(fmt::format("children.{}", kind.kind));
        end_content();
        xml_.end();
    }

    // Other programs' names, and types that a variable names.
    void write_other_types(const SchemaKind& kind)
    {
        xml_.begin("group");
        xml_.begin("attribute", {{"name", "type"}});
        write_words(kind.other_types);
        xml_.end();
        begin_content();
        ref("any_parameter");
        ref("element.texture");
        ref(fmt::format("children.{}", kind.kind));
        end_content();
        xml_.end();
    }

    void write_kind(const SchemaKind& kind)
    {
        for (const std::string_view tag : kind.tags) {
            xml_.begin("define", {{"name", fmt::format("element.{}", tag)}});
            xml_.begin("element", {{"name", tag}});
            optional_attribute("name");
            optional_attribute("id");
            ref(fmt::format("kind.{}", kind.kind));
            xml_.end();
            xml_.end();
        }
        xml_.begin("define", {{"name", fmt::format("kind.{}", kind.kind)}});
        xml_.begin("choice");
        for (const SchemaType& type : kind.types) write_type(kind, type);
        write_other_types(kind);
        xml_.end();
        xml_.end();
        xml_.begin("define", {{"name", fmt::format("children.{}", kind.kind)}});
        xml_.begin("choice");
        xml_.empty("notAllowed"); // where no object may stand in one of this kind
        for (const std::string_view tag : kind.children) ref(fmt::format("element.{}", tag));
        xml_.end();
        xml_.end();
    }

    XmlWriter xml_;
};

} // namespace

std::string relax_ng_schema()
{
    return RelaxNg().write();
}

} // namespace plumb
