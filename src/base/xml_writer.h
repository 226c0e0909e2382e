// SPDX-License-Identifier: MIT
#pragma once

// Writing XML, indented by two spaces.

#include "base/xml_text.h"

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plumb {

class XmlWriter {
public:
    struct Attribute {
        std::string_view name;
        std::string_view value;
    };
    using Attributes = std::initializer_list<Attribute>;

    XmlWriter() : text_("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n") {}

    void begin(std::string_view tag, Attributes attributes = {})
    {
        open(tag, attributes, ">");
        tags_.emplace_back(tag);
    }
    void end()
    {
        const std::string tag = std::move(tags_.back());
        tags_.pop_back();
        indent();
        text_ += "</" + tag + ">\n";
    }
    void empty(std::string_view tag, Attributes attributes = {}) { open(tag, attributes, "/>"); }
    void text(std::string_view tag, std::string_view content, Attributes attributes = {})
    {
        open(tag, attributes, ">");
        text_.pop_back(); // the line end
        text_ += xml_text(content) + "</" + std::string(tag) + ">\n";
    }

    std::string finish() && { return std::move(text_); }

private:
    void indent() { text_.append(2 * tags_.size(), ' '); }
    void open(std::string_view tag, Attributes attributes, std::string_view end)
    {
        indent();
        text_ += "<" + std::string(tag);
        for (const Attribute& attribute : attributes)
            text_ += " " + std::string(attribute.name) + "=\"" + xml_text(attribute.value) + "\"";
        text_ += std::string(end) + "\n";
    }

    std::string text_;
    std::vector<std::string> tags_;
};

} // namespace plumb
