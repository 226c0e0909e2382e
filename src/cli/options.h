// SPDX-License-Identifier: MIT
#pragma once

// What the command line asks for. A pure function of the words: nothing is printed, read or exited here.

#include "cli/requests.h"
#include "cli/usage_error.h"

#include <string>
#include <vector>

namespace plumb {

enum class Verb {
    render,
    types,
    info,
    replay,
    rerun,
    merge,
    test,
    compare,
    agree,
    race,
    check,
    batch,
    new_scene,
    help
};

// What the words of the command line say: the options of all verbs. verbs.cpp makes of it what its verb is asked for.
struct Options : RenderRequest {
    Verb verb = Verb::render;
    bool help = false;
    bool version = false;
    std::vector<std::string>
        subjects;                  // the words that are no options: scenes, images or the name of a plugin
    std::string subject;           // the first of them; empty: none
    std::optional<PartBy> part_by; // as given; settled in part
    ReplayRequest replay;
    RerunRequest rerun;
    MergeRequest merge;
    CompareRequest compare;
    RaceRequest race;
    BatchRequest batch;
};

// words: without the program's name. Throws UsageError.
Options parse_options(std::vector<std::string> words);

// What --help prints.
std::string help_text(Verb verb);

} // namespace plumb
