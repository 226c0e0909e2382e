// SPDX-License-Identifier: MIT
#pragma once

// Reading a suite: an XML file that lists images to render, and what to compare them with.
//
//     <suite size="160x120">                                     settings of every image in it
//         <render scene="cbox.xml" spp="16, 64" reference="references/cbox.exr" reference-spp="1024"/>
//         <group name="hw4" max="rmse=0.01">                     and of those in a part of it
//             <render scene="box.xml" name="explicit"> <define name="explicit" value="true"/> </render>
//         </group>
//         <render scene="box.xml" name="mine" command="mine {scene} -o {image} --seed {seed}" replicas="4"/>    another
//         <render name="theirs" image="out/theirs.exr" reference="references/cbox.exr"/>                   renderer's
//     </suite>
//
// Settings are options of the command line by their names; an empty one is as if it were not there. <default>, <include> and $name are the scene language's.

#include "plumb/base/error.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plumb {

// An attribute, and where its value stands.
struct SuiteSetting {
    std::string value;
    SourceLocation at;
};

// An image that another program makes, or has made.
struct ForeignImage {
    std::string command;    // with placeholders (command_line.h); empty: the image is there
    std::string image;      // without a command: its file, with placeholders, seen from the suite's directory
    SourceLocation at;      // of the command or the image
    int replicas = 1;       // images that differ in their seeds
    double timeout = 600.0; // of each run, in seconds
    std::vector<std::filesystem::path> inputs; // that the image depends on
    SourceLocation inputs_at;
};

// One image.
struct SuiteEntry {
    std::string name; // of the image in the output directory, without sample count and ending: "hw4/explicit"
    std::filesystem::path scene; // empty: none, of a foreign image only
    SourceLocation scene_at;
    std::string scene_way_out; // if there is no such file: "; did you mean '../a.xml'?", or empty
    std::map<std::string, SuiteSetting> settings; // spp among them, where it is given: one number
    std::map<std::string, std::string> definitions;
    std::filesystem::path reference; // empty: none
    SourceLocation reference_at;
    std::map<std::string, SuiteSetting>
        reference_settings;              // what makes the reference instead: spp, seed, target-error
    std::optional<ForeignImage> foreign; // nothing: Plumb renders the image
    SourceLocation at;

    // "hw4/explicit_64"; without a number where the scene says how many samples.
    std::string title() const;
};

struct Suite {
    std::filesystem::path path;
    std::vector<std::filesystem::path> files; // that it was read from, the main one first
    std::vector<SuiteEntry> entries;          // at least one; no two have one title
};

// known_settings: the names that are allowed. Throws SceneError with everything that is wrong with the file, or Error if
// it cannot be read. Scenes need not exist, but a pattern (* and ? in the name of a scene file) must match some.
Suite load_suite(const std::filesystem::path& path, const std::map<std::string, std::string>& definitions,
                 std::span<const std::string_view> known_settings);

// Whether the whole text is what the pattern says: ? is any character, * any number of them.
bool matches_pattern(std::string_view text, std::string_view pattern);

} // namespace plumb
