// SPDX-License-Identifier: MIT
#pragma once

// Writing JSON (RFC 8259), indented by two spaces.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace plumb {

std::string json_string(std::string_view text); // with its quotes; what is not UTF-8 becomes U+FFFD
std::string json_number(double value);          // shortest that reads back the same; null if not finite

// Members in the order of the calls. key: empty inside an array.
class JsonWriter {
public:
    void begin_object(std::string_view key = {}) { begin(key, '{'); }
    void end_object() { end('}'); }
    void begin_array(std::string_view key = {}) { begin(key, '['); }
    void end_array() { end(']'); }
    void text(std::string_view key, std::string_view value) { member(key, json_string(value)); }
    void number(std::string_view key, double value) { member(key, json_number(value)); }
    void integer(std::string_view key, std::uint64_t value) { member(key, std::to_string(value)); }
    void boolean(std::string_view key, bool value) { member(key, value ? "true" : "false"); }
    void null(std::string_view key) { member(key, "null"); }

    std::string finish() && { return std::move(text_) + "\n"; }

private:
    void begin(std::string_view key, char bracket);
    void end(char bracket);
    void member(std::string_view key, std::string_view value);

    std::string text_;
    int depth_ = 0;
    bool first_ = true; // of its object or array
};

} // namespace plumb
