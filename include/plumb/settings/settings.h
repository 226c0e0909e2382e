// SPDX-License-Identifier: MIT
#pragma once

// Settings are values of a struct; as text they exist at the edges only: on the command line, in suites, in headers of
// images and in messages. One table for each struct says how. A setting has the same name everywhere.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// What is different if a setting is.
enum class Effect {
    samples,  // the value of a sample
    coverage, // which pixels and layers, and how many samples of each pixel
    stop,     // when a rendering ends before all samples are taken
    file,     // how the image becomes a file
    verdict   // what a comparison says
};

template <class Settings>
struct SettingRow {
    std::string_view name;   // "seed"
    std::string_view value;  // what --help calls its value: "N"; empty: a switch, which is true or false
    std::string_view help;   // one line or more
    std::string_view phrase; // in messages: "the seed"
    Effect effect;
    // What set() makes the same value of, each text at most once; empty: the default.
    std::vector<std::string> (*get)(const Settings& settings);
    // called: what a message calls the setting. Throws Error: "--seed must be ..., not 'x'".
    void (*set)(Settings& settings, std::string_view called, std::string_view text);
    std::string_view short_name = {}; // "D", of an option
    bool repeatable = false;          // set() adds to what there is

    bool is_switch() const { return value.empty(); }
};

// The table of a struct, in the order of --help.
template <class Settings>
std::span<const SettingRow<Settings>> setting_rows();

// Null: there is none of that name.
template <class Settings>
const SettingRow<Settings>* find_setting(std::string_view name)
{
    for (const SettingRow<Settings>& row : setting_rows<Settings>())
        if (row.name == name) return &row;
    return nullptr;
}

// "the seed was the default and is 7", for each setting with that effect.
template <class Settings>
std::vector<std::string> differences(const Settings& was, const Settings& is, Effect effect)
{
    const auto text = [](const std::vector<std::string>& values) {
        std::string all;
        for (const std::string& value : values) all += (all.empty() ? "" : " ") + value;
        return values.empty() ? std::string("the default") : all;
    };
    std::vector<std::string> changes;
    for (const SettingRow<Settings>& row : setting_rows<Settings>()) {
        if (row.effect != effect) continue;
        if (const auto a = row.get(was), b = row.get(is); a != b)
            changes.push_back(std::string(row.phrase) + " was " + text(a) + " and is " + text(b));
    }
    return changes;
}

} // namespace plumb
