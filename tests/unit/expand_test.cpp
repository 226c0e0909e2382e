// SPDX-License-Identifier: MIT
#include "scene_file/expand.h"
#include "support/catch.h"
#include "support/temp_folder.h"

#include <fstream>

#include <fmt/format.h>

using namespace plumb;

namespace {

// A folder of scene files.
class Files {
public:
    Files& write(const std::string& name, const std::string& text)
    {
        std::filesystem::create_directories((folder_.path() / name).parent_path());
        std::ofstream(folder_.path() / name, std::ios::binary) << text;
        return *this;
    }

    Expansion expand(const Definitions& definitions = {}, const ExpansionLimits& limits = {})
    {
        diagnostics_ = {};
        const auto path = folder_.path() / "main.xml";
        auto root = parse_document(path, read_text(path), diagnostics_);
        REQUIRE(root);
        return plumb::expand(*root, definitions, diagnostics_, limits);
    }

    // "file:line:column: message" of each error and warning.
    std::string errors(const Definitions& definitions = {}, const ExpansionLimits& limits = {})
    {
        expand(definitions, limits);
        std::string text;
        for (const Diagnostic& found : diagnostics_.all())
            text += std::filesystem::path(found.location.file).filename().string() + ":" +
                    std::to_string(found.location.line) + ":" + std::to_string(found.location.column) + ": " +
                    found.message + "\n";
        return text;
    }

    const Diagnostics& diagnostics() const { return diagnostics_; }

private:
    TempFolder folder_;
    Diagnostics diagnostics_;
};

} // namespace

TEST_CASE("variables in values", "[unit][expand]")
{
    Files files;
    files.write("main.xml",
                "<scene d='$a'><default name='a' value='1'/><x v='$a'/><x v='${a}b-$a,$$a'/><x v='none'/>"
                "<default name='termination-param' value='$a.5'/><m><x v='$termination-param'/></m></scene>");
    const Element root = files.expand().root;
    CHECK(files.diagnostics().all().empty());
    REQUIRE(root.children.size() == 4);
    CHECK(root.value("d") == "1");
    CHECK(root.children[0].value("v") == "1");
    CHECK(root.children[1].value("v") == "1b-1,$a");
    CHECK(root.children[2].value("v") == "none");
    CHECK(root.children[3].children[0].value("v") == "1.5");
    CHECK_FALSE(root.children[0].attributes[0].verbatim);
    CHECK(root.children[2].attributes[0].verbatim);
}

TEST_CASE("definitions win over defaults, and first defaults over later ones", "[unit][expand]")
{
    Files files;
    files.write("main.xml",
                "<scene><x v='$a $b $c'/><default name='a' value='1'/><default name='b' value='2'/>"
                "<include filename='part.xml'/></scene>");
    files.write("part.xml",
                "<scene><default name='a' value='9'/><default name='c' value='3'/><y v='$a$b$c'/></scene>");
    CHECK(files.expand().root.children[0].value("v") == "1 2 3");
    const Element root = files.expand({{"b", "$a"}}).root;
    CHECK(root.children[0].value("v") == "1 $a 3"); // what -D gives is taken as it is
    CHECK(root.children[1].value("v") == "1$a3");
    CHECK(files.diagnostics().all().empty());
}

TEST_CASE("variables that have no value", "[unit][expand]")
{
    Files files;
    files.write("main.xml",
                "<scene><default name='width' value='1'/>\n<x v='1 $widht'/>\n<x v='$q'/>\n<x v='a$ b'/>\n"
                "<x v='${a'/><x v='$1'/>\n<default name='a b' value='1'/>\n<default name='x'/>\n"
                "<default name='late' value='$later'/></scene>");
    const std::string errors = files.errors();
    CHECK_THAT(errors, ContainsSubstring("main.xml:2:9: $widht has no value; did you mean '$width'?"));
    CHECK_THAT(
        errors,
        ContainsSubstring("main.xml:3:7: $q has no value; give it one with -D q=... or <default name=\"q\""));
    CHECK_THAT(errors, ContainsSubstring("main.xml:4:8: expected a name after '$'"));
    CHECK_THAT(errors, ContainsSubstring("main.xml:5:7: expected a name after '$'"));
    CHECK_THAT(errors, ContainsSubstring("main.xml:5:19: expected a name after '$'"));
    CHECK_THAT(errors, ContainsSubstring("main.xml:6:16: 'a b' cannot name a value"));
    CHECK_THAT(errors, ContainsSubstring("main.xml:7:1: <default> needs an attribute 'value'"));
    CHECK_THAT(errors, ContainsSubstring("main.xml:8:29: $later has no value"));
}

TEST_CASE("definitions that no file uses", "[unit][expand]")
{
    Files files;
    files.write("main.xml", "<scene><default name='spp' value='1'/><x v='$width'/></scene>");
    CHECK(files.errors({{"width", "1"}, {"spp", "2"}}).empty());
    CHECK_THAT(files.errors({{"width", "1"}, {"sp", "2"}}),
               ContainsSubstring("-D sp=2: no file of this scene uses $sp; did you mean 'spp'?"));
}

TEST_CASE("included files", "[unit][expand]")
{
    Files files;
    files.write(
        "main.xml",
        "<scene><default name='part' value='one'/><a/><include filename='parts/$part.xml'/><d/></scene>");
    files.write("parts/one.xml", "<!-- c -->\n<scene><b/><include filename='../two.xml'/></scene>");
    files.write("two.xml", "<scene><c/></scene>");
    const Expansion expansion = files.expand();
    CHECK(files.diagnostics().all().empty());
    std::string tags;
    for (const Element& child : expansion.root.children) tags += child.tag;
    CHECK(tags == "abcd");
    REQUIRE(expansion.files.size() == 3);
    CHECK(expansion.files[1]->path().filename() == "one.xml");
    // Paths and places are those of the included file.
    CHECK(expansion.root.children[1].file->folder().filename() == "parts");
    CHECK(expansion.root.children[1].place().line == 2);
    CHECK(expansion.root.children[2].file->folder().filename() != "parts");
}

TEST_CASE("files that cannot be included", "[unit][expand]")
{
    Files files;
    files.write("main.xml",
                "<scene>\n<include filename='none.xml'/>\n<include/>\n<include filename='mesh.xml'/>\n"
                "<include filename='bad.xml'/>\n<include filename='main.xml'/>\n<include filename='a.xml'/>\n"
                "<include filename='dialect.xml'><x/></include></scene>");
    files.write("mesh.xml", "\n<mesh/>")
        .write("bad.xml", "<scene>")
        .write("dialect.xml", "<scene dialect='eth'/>");
    files.write("a.xml", "<scene><include filename='b.xml'/></scene>");
    files.write("b.xml", "<scene>\n <include filename='./a.xml'/></scene>");
    const std::string errors = files.errors();
    CHECK_THAT(errors,
               ContainsSubstring("main.xml:2:20: file '") && ContainsSubstring("none.xml' does not exist\n"));
    CHECK_THAT(errors, ContainsSubstring("main.xml:3:1: <include> needs an attribute 'filename'"));
    CHECK_THAT(errors,
               ContainsSubstring("mesh.xml:2:1: the root of an included file must be <scene>, not <mesh>"));
    CHECK_THAT(errors, ContainsSubstring("bad.xml:1:1: <scene> is never closed"));
    CHECK_THAT(errors, ContainsSubstring("main.xml:6:20: '") && ContainsSubstring("includes itself"));
    CHECK_THAT(errors, ContainsSubstring("b.xml:2:21: '"));
    CHECK_THAT(errors, ContainsSubstring("dialect.xml:1:8: the dialect of an included file is ignored"));
    CHECK_THAT(errors, ContainsSubstring("main.xml:8:33: an <include> cannot contain a <x>"));
}

TEST_CASE("values stay bounded, however variables multiply them", "[unit][expand]")
{
    const auto doubling = [](int levels, int uses) { // a value of 2^levels bytes
        std::string text = "<scene>\n<default name='a0' value='x'/>\n";
        for (int i = 1; i <= levels; ++i)
            text += fmt::format("<default name='a{0}' value='$a{1}$a{1}'/>\n", i, i - 1);
        for (int i = 0; i < uses; ++i) text += fmt::format("<x v='$a{}'/>\n", levels);
        return text + "</scene>";
    };
    Files files;
    files.write("main.xml", doubling(20, 3));
    const Element root = files.expand().root;
    CHECK(files.diagnostics().all().empty());
    CHECK(root.children[2].value("v").size() == std::size_t{1} << 20);
    files.write("main.xml", doubling(100, 1));
    CHECK(files.errors() == "main.xml:23:28: with $a20 replaced, this value is longer than 1048576 bytes\n");

    // Each is short enough, but not all together.
    files.write("main.xml", doubling(20, 80));
    CHECK_THAT(files.errors(),
               ContainsSubstring("main.xml:85:7: with all $names replaced, the values of this scene are "
                                 "longer than 67108864 bytes together"));
    std::size_t size = 0;
    for (const Element& child : files.expand().root.children) size += child.value("v").size();
    CHECK(size <= std::size_t{64} << 20);
}

TEST_CASE("many variables without a value are reported in little time", "[unit][expand]")
{
    std::string text = "<scene>";
    for (int i = 0; i < 5000; ++i) text += fmt::format("<default name='name{}' value='1'/>", i);
    for (int i = 0; i < 5000; ++i) text += fmt::format("<x v='$nome{}'/>", i);
    Files files;
    files.write("main.xml", text + "</scene>");
    files.expand(); // 400 million comparisons of words would take minutes
    REQUIRE(files.diagnostics().all().size() == 20);
    CHECK_THAT(files.diagnostics().all().front().message, ContainsSubstring("did you mean '$name0'?"));
    CHECK_THAT(files.diagnostics().all().back().message, ContainsSubstring("; and 4980 more like it"));
}

TEST_CASE("a small file that is included often does not become a large scene", "[unit][expand]")
{
    std::string main = "<scene>\n";
    for (int i = 0; i < 5; ++i)
        main += "<include filename='part.xml'/>\n"; // of 5, 10 parts with their attributes
    Files files;
    files.write("part.xml", "<scene><a/><a x='1' y='2'/></scene>").write("main.xml", main + "</scene>");
    ExpansionLimits limits;
    limits.parts = 36;
    CHECK(files.errors({}, limits).empty());
    limits.parts = 30;
    CHECK_THAT(files.errors({}, limits),
               ContainsSubstring("main.xml:5:20: with '") &&
                   ContainsSubstring("part.xml', this scene has more than 30 elements and attributes\n"));
    CHECK(files.expand({}, limits).root.children.size() == 6);

    // And one that is all comments.
    files.write("part.xml", "<scene><!--" + std::string(1000, 'x') + "--></scene>");
    limits = {};
    limits.text_size = 4000;
    CHECK_THAT(
        files.errors({}, limits),
        ContainsSubstring("main.xml:5:20: with '") &&
            ContainsSubstring("part.xml', the files of this scene are larger than 4000 bytes together\n"));
}

TEST_CASE("includes come to an end", "[unit][expand]")
{
    Files files;
    // A chain of 70 files.
    for (int i = 0; i < 70; ++i)
        files.write(i == 0 ? "main.xml" : std::to_string(i) + ".xml",
                    "<scene><include filename='" + std::to_string(i + 1) + ".xml'/></scene>");
    files.write("70.xml", "<scene/>");
    CHECK_THAT(files.errors(), ContainsSubstring("more than 64 levels deep"));

    // Each file includes the next one twice: 2^30 in the end.
    for (int i = 0; i < 30; ++i) {
        const std::string include = "<include filename='" + std::to_string(i + 1) + ".xml'/>";
        files.write(i == 0 ? "main.xml" : std::to_string(i) + ".xml",
                    "<scene>" + include + include + "</scene>");
    }
    files.write("30.xml", "<scene/>");
    CHECK_THAT(files.errors(), ContainsSubstring("more than 1000 files are included"));
}
