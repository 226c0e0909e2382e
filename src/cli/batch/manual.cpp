// SPDX-License-Identifier: MIT
#include "cli/batch/plan.h"
#include "cli/manuals.h"

namespace plumb {

namespace {

// clang-format off
constexpr std::string_view about_suites =
"Renders every picture that a suite lists, and compares it with its reference if it has one.\n"
"\n"
"    <suite size=\"160x120\">\n"
"        <render scene=\"cbox.xml\" spp=\"16, 64\" reference=\"ref/cbox.exr\" reference-spp=\"1024\"/>\n"
"        <group name=\"hw4\" max=\"rmse=0.01\" seed=\"7\">\n"
"            <render scene=\"box.xml\" name=\"explicit\" reference=\"ref/*.exr\">\n"
"                <define name=\"explicit\" value=\"true\"/>\n"
"            </render>\n"
"        </group>\n"
"    </suite>\n"
"\n"
"Pictures are called after scene (or name) and sample count: cbox_16.exr, cbox_64.exr, with a .png\n"
"beside each, hw4/explicit_32.exr. An attribute of <suite> or <group> holds for all that is in it;\n"
"an empty value takes it away. Files lie beside the suite; scene=\"box/*.xml\" takes all that match.\n"
"In a reference, * is the name of the picture. The first entry that names a reference makes it with\n"
"--update, with reference-spp and reference-seed where they are given. <default>, <include> and\n"
"$name are the scene language's; <define> is a -D for the scene. All other attributes are options\n"
"of `renderer` and `renderer compare`, where A is the picture and B the reference; those without a\n"
"value take true or false:\n";

constexpr std::string_view about_results =
"\n"
"The directory also gets report.html, report.json, junit.xml and summary.md. What is up to date (the\n"
"hashes of scene, options, program and picture are what they were) is compared, but not rendered.\n"
"Exit code: 1 if a picture could not be rendered or compared, else 3 if one differs, else 4 if one\n"
"is undecided, else 0; 2 is wrong usage.\n";
// clang-format on

std::string settings_text()
{
    constexpr std::size_t columns = 99;
    std::string text, line;
    for (const std::string_view name : suite_settings()) {
        if (line.size() + 1 + name.size() > columns) {
            text += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "    " : " ") + std::string(name);
    }
    return text + line + "\n";
}

} // namespace

std::string_view batch_manual()
{
    static const std::string text = std::string(about_suites) + settings_text() + std::string(about_results);
    return text;
}

} // namespace plumb
