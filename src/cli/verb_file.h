// SPDX-License-Identifier: MIT
#pragma once

// For the files below src/cli/verbs: options that several verbs have.

#include "cli/verb.h"

#include "plumb/settings/compare_settings.h"
#include "plumb/settings/render_settings.h"
#include "settings/parse_value.h"

#include <fmt/format.h>

namespace plumb {

template <class Maker>
const Verb& verb()
{
    static const Verb made = Maker::make();
    return made;
}

template <class Options>
OptionTable<Options> join(std::initializer_list<OptionTable<Options>> tables)
{
    OptionTable<Options> all;
    for (const OptionTable<Options>& table : tables) all.insert(all.end(), table.begin(), table.end());
    return all;
}

// Of settings by their names.
template <class Options, class Settings>
OptionTable<Options> setting_options(Topic topic, Settings Options::*member,
                                     std::initializer_list<std::string_view> names)
{
    OptionTable<Options> table;
    for (const std::string_view name : names) {
        const SettingRow<Settings>& row = *find_setting<Settings>(name);
        const std::string short_name = row.short_name.empty() ? "" : fmt::format("-{},", row.short_name);
        table.push_back({{topic, fmt::format("{}--{}", short_name, row.name), std::string(row.value),
                          std::string(row.help), row.repeatable, false},
                         [member, &row](Options& o, std::string_view n, const std::string& t) {
                             row.set(o.*member, n, t);
                         }});
    }
    return table;
}

// Those that change how a scene is read.
template <class Options>
OptionTable<Options> scene_options()
{
    return setting_options<Options>(Topic::scene, &Options::settings,
                                    {"define", "dialect", "emitters", "mirror", "envmap-scale", "lenient"});
}

template <class Options>
OptionTable<Options> text_option(Topic topic, std::string_view names, std::string_view value,
                                 std::string_view help, std::string Options::*member,
                                 std::string_view needs = "file name")
{
    return {{{topic, std::string(names), std::string(value), std::string(help), false, false},
             [member, needs](Options& o, std::string_view n, const std::string& t) {
                 if (t.empty()) throw UsageError(fmt::format("{} needs a {}", n, needs));
                 o.*member = t;
             }}};
}

template <class Options>
OptionTable<Options> switch_option(Topic topic, std::string_view names, std::string_view help,
                                   bool Options::*member)
{
    return {{{topic, std::string(names), "", std::string(help), false, false},
             [member](Options& o, std::string_view, const std::string&) { o.*member = true; }}};
}

template <class Options>
OptionTable<Options> outputs_option()
{
    return {{{Topic::output, "-o,--output", "FILE",
              "write this image: .exr, .hdr, .tif, .png or .jpg;\n"
              "may be repeated (default SCENE_SPP.exr and .png)",
              true, false},
             [](Options& o, std::string_view, const std::string& t) { o.outputs.push_back(t); }}};
}

template <class Options>
OptionTable<Options> json_option()
{
    return {
        {{Topic::output, "--json", "FILE", "write a report of the run; - is standard output", false, false},
         [](Options& o, std::string_view, const std::string& t) { o.json = t; }}};
}

template <class Options>
OptionTable<Options> checkpoint_option()
{
    return text_option<Options>(Topic::state, "--checkpoint", "FILE",
                                "write checkpoints to this .exr file, to resume from", &Options::checkpoint);
}

template <class Options>
OptionTable<Options> threads_option()
{
    return {{{Topic::running, "-t,--threads", "N", "number of threads (default: all)", false, false},
             [](Options& o, std::string_view n, const std::string& t) {
                 o.threads = static_cast<int>(parse_integer(n, t, 1, 1024));
             }}};
}

template <class Options>
OptionTable<Options> quiet_option()
{
    return switch_option<Options>(Topic::running, "--quiet", "print errors only", &Options::quiet);
}

template <class Options>
OptionTable<Options> verbose_option()
{
    return switch_option<Options>(Topic::running, "--verbose", "print facts about the scene",
                                  &Options::verbose);
}

// Every verb's last one.
template <class Options>
OptionTable<Options> help_option()
{
    return switch_option<Options>(Topic::about, "-h,--help", "print this", &Options::help);
}

} // namespace plumb
