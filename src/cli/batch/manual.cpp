// SPDX-License-Identifier: MIT
#include "cli/batch/plan.h"
#include "cli/manuals.h"

namespace plumb {

namespace {

constexpr std::string_view about_suites =
    R"(Renders every image that a suite lists, and compares it with its reference if
it has one.

    <suite size="160x120">
        <render scene="cbox.xml" spp="16, 64" reference="ref/cbox.exr"
                reference-spp="1024"/>
        <group name="hw4" max="rmse=0.01" seed="7">
            <render scene="box.xml" name="explicit" reference="ref/*.exr">
                <define name="explicit" value="true"/>
            </render>
        </group>
    </suite>

Images are named after scene (or name) and sample count: cbox_16.exr,
cbox_64.exr, with a .png beside each, hw4/explicit_32.exr. An attribute of
<suite> or <group> applies to everything inside it; an empty value removes it.
File names are relative to the suite; scene="box/*.xml" takes all matching
files. In a reference, * stands for the name of the image. The first entry that
names a reference makes it with --update, with reference-spp and reference-seed
if they are given. <default>, <include> and $name are those of the scene
language; <define> is -D for the scene. All other attributes are options of
`renderer` and `renderer compare`, where A is the image and B the reference;
those without a value take true or false:
)";

constexpr std::string_view about_results = R"(
The output directory also gets report.html, report.json, junit.xml and
summary.md. An image that is up to date (the hashes of scene, options, program
and image have not changed) is compared, but not rendered.
Exit code: 1 if an image could not be rendered or compared, else 3 if one
differs, else 4 if one is undecided, else 0; 2 for wrong usage.
)";

std::string settings_text()
{
    constexpr std::size_t columns = 80;
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
