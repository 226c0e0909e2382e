// SPDX-License-Identifier: MIT

// renderer batch with images of other programs. The other program is a shell script, or Plumb itself.

#include "cli/small_scene.h"
#include "plumb/image/image.h"
#include "support/catch.h"

#include <chrono>
#include <csignal>
#include <thread>

using namespace plumb;

namespace {

// An easy scene; "1,1,1" is its light.
std::string bright_scene()
{
    std::string scene = easy_scene;
    return scene.insert(scene.find('>') + 1, "<integrator type=\"path_mis\"/>");
}

struct ForeignDirectory : TempDirectory {
    ForeignDirectory()
    {
        write("scene.xml", bright_scene());
        std::string dark = bright_scene();
        dark.replace(dark.find("1,1,1"), 5, "0.5,0.5,0.5");
        write("dark.xml", dark);
        script("copy", "cp \"$1\" \"$2\"");
    }
    // A program beside the suite.
    void script(const std::string& name, const std::string& text) const
    {
        const auto file = write(name, "#!/bin/sh\n" + text + "\n");
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    }
    // As another program does: without error bars.
    void render(const std::string& name, const std::string& seed, const std::string& scene = "scene.xml",
                Names more = {"--no-variance"}) const
    {
        std::filesystem::create_directories((*this / name).parent_path());
        Names words = {scene, "--spp", "64", "--seed", seed, "--size", "48x36", "--quiet", "-o", name};
        words.insert(words.end(), more.begin(), more.end());
        REQUIRE(run_renderer(words, path()).exit_code == 0);
    }
    void suite(const std::string& entries) const
    {
        write("suite.xml", "<suite>\n" + entries + "\n</suite>\n");
    }
    RunResult batch(Names words = {"--allow-commands"}) const
    {
        words.insert(words.begin(), {"batch", "suite.xml"});
        return run_renderer(words, path());
    }
    std::string report() const { return read_bytes(*this / "batch/suite/report.json"); }
};

std::string quoted(std::string text)
{
    for (std::size_t i = text.find('"'); i != text.npos; i = text.find('"', i)) text.replace(i, 1, "&quot;");
    return text;
}

std::string entry(const std::string& command, const std::string& more = "")
{
    return "<render scene=\"scene.xml\" name=\"mine\" command=\"" + quoted(command) + "\" " + more + "/>";
}

const std::string by_plumb =
    std::string(PLUMB_RENDERER) + " {scene} -o {image} --seed {seed} --spp {spp} --no-variance --quiet";

bool lives(pid_t process)
{
    return kill(process, 0) == 0;
}

} // namespace

TEST_CASE("batch compares images that are there", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    directory.render("ref.exr", "9", "scene.xml", {});
    directory.render("out/a.exr", "1");
    directory.render("out/dark.exr", "1", "dark.xml");
    directory.suite("<render image=\"out/a.exr\" name=\"a\" reference=\"ref.exr\"/>");
    const RunResult same = directory.batch({});
    INFO(same.out << same.err);
    CHECK(same.exit_code == 0);
    CHECK(same.out.starts_with("a  passes "));
    directory.suite("<render image=\"out/{name}.exr\" name=\"dark\" reference=\"ref.exr\"/>");
    const RunResult dark = directory.batch({});
    CHECK(dark.exit_code == 3);
    CHECK_THAT(directory.report(),
               ContainsSubstring("\"compare_command\": \"renderer compare out/dark.exr ref.exr\""));
    CHECK(std::filesystem::exists(directory / "batch/suite/dark_significant.png"));
    // Nobody's image becomes a reference because it differs.
    CHECK_THAT(directory.report(), ContainsSubstring("\"accept_command\": null"));

    directory.suite("<render image=\"none.exr\" name=\"a\"/>");
    const RunResult none = directory.batch({});
    CHECK(none.exit_code == 1);
    CHECK_THAT(none.out, ContainsSubstring("suite.xml:2:16: error: image 'none.exr' does not exist\n"));
    directory.write("text.exr", "this is no image");
    directory.suite("<render image=\"text.exr\" name=\"a\"/>");
    CHECK_THAT(directory.batch({}).out, ContainsSubstring("suite.xml:2:16: error: cannot read 'text.exr'"));
}

TEST_CASE("batch runs commands only where it is allowed", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    directory.script("touch_it", "touch ../../../ran; cp \"$1\" \"$2\"");
    directory.render("in.exr", "1");
    directory.suite(entry("./touch_it {input} {image}", "inputs=\"in.exr\""));
    const RunResult refused = directory.batch({});
    CHECK(refused.exit_code == 1);
    CHECK_THAT(refused.out,
               ContainsSubstring(
                   "suite.xml:2:48: error: this entry runs a command, which needs --allow-commands\n"));
    CHECK_THAT(refused.out, ContainsSubstring("\n    ./touch_it " + (directory / "in.exr").string() + " "));
    CHECK_FALSE(std::filesystem::exists(directory / "ran"));
    CHECK(directory.batch().exit_code == 0);
    CHECK(std::filesystem::exists(directory / "ran"));
}

TEST_CASE("another program's images and replicas get a verdict", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    const std::string reference = " reference=\"ref.exr\" reference-spp=\"256\" reference-seed=\"99\"";
    directory.suite(entry(by_plumb, "spp=\"16\" replicas=\"4\"" + reference));
    CHECK(directory.batch({"--update"}).exit_code == 0);
    const RunResult made = directory.batch();
    INFO(made.out << made.err);
    CHECK(made.exit_code == 0);
    CHECK(made.out.starts_with("mine_16  passes "));
    const std::string report = directory.report();
    for (const char* part : {"\"batch/suite/mine_16_r4.exr\"", "\"exit_code\": 0,",
                             "\"peak_memory\": ", "batch/suite/mine_16_r4.exr --against ref.exr"})
        CHECK_THAT(report, ContainsSubstring(part));
    CHECK(read_bytes(directory / "batch/suite/mine_16_r1.exr") !=
          read_bytes(directory / "batch/suite/mine_16_r2.exr"));
    CHECK_FALSE(std::filesystem::exists(directory / "batch/suite/mine_16_work"));

    // The same words with another scene: a bug.
    directory.suite(entry(std::string(PLUMB_RENDERER) + " " + (directory / "dark.xml").string() +
                              " -o {image} --seed {seed} --spp {spp} --no-variance --quiet",
                          "spp=\"16\" replicas=\"4\"" + reference));
    CHECK(directory.batch().exit_code == 3);
}

TEST_CASE("a command is run again when its program, its inputs or its words change", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    directory.render("in.exr", "1");
    const auto is_up_to_date = [&] {
        return directory.batch().out.find("up to date\n") != std::string::npos;
    };
    directory.suite(entry("./copy {input} {image}", "inputs=\"in.exr\""));
    CHECK_FALSE(is_up_to_date());
    CHECK(is_up_to_date());
    directory.render("in.exr", "2");
    CHECK_FALSE(is_up_to_date());
    CHECK(is_up_to_date());
    directory.script("copy", "cp \"$1\" \"$2\" ");
    CHECK_FALSE(is_up_to_date());
    directory.suite(entry("./copy {input} {image} more", "inputs=\"in.exr\""));
    CHECK_FALSE(is_up_to_date());
    // A file that a word names is an input, too.
    directory.suite(entry("sh {directory}/copy {input} {image}", "inputs=\"in.exr\""));
    CHECK_FALSE(is_up_to_date());
    CHECK(is_up_to_date());
    directory.script("copy", "cp \"$1\" \"$2\"");
    CHECK_FALSE(is_up_to_date());
    directory.write("batch/suite/mine.exr", "x");
    CHECK_FALSE(is_up_to_date());
    directory.suite(entry("./copy {input} {image}", "inputs=\"none.exr\""));
    CHECK_THAT(directory.batch().out, ContainsSubstring("error: cannot read the input 'none.exr'\n"));
}

TEST_CASE("a missing reference is said before a command runs", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    directory.script("slow", "echo ran >> " + (directory / "log").string() + "; cp \"$1\" \"$2\"");
    directory.render("a.exr", "3");
    directory.suite(
        R"(<render name="a" command="./slow {directory}/a.exr {image}" reference="refs/a.exr"/>)");
    const RunResult run = directory.batch();
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.out,
               ContainsSubstring("reference 'refs/a.exr' does not exist, and no scene says how it is made"));
    CHECK_FALSE(std::filesystem::exists(directory / "log"));
}

TEST_CASE("what a command does wrong is one clear error with the end of its output", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    const auto complaint = [&](const std::string& text, const std::string& more = "") {
        directory.script("bad", text);
        directory.suite(entry("./bad {image}", more));
        const RunResult run = directory.batch();
        CHECK(run.exit_code == 1);
        CHECK_FALSE(std::filesystem::exists(directory / "batch/suite/mine.exr"));
        return run.out;
    };
    CHECK_THAT(complaint("echo one; echo two >&2; exit 7"),
               ContainsSubstring("suite.xml:2:48: error: the command failed with exit code 7\n"));
    CHECK_THAT(complaint("echo one; echo two >&2; exit 7"), ContainsSubstring("\n    one\n    two\n"));
    CHECK_THAT(complaint("kill -9 $$"), ContainsSubstring("error: the command was killed by signal 9 ("));
    CHECK_THAT(
        complaint("exit 0"),
        ContainsSubstring("error: the command ended without an error, but wrote no image to {image}\n"));
    CHECK_THAT(complaint("exit 0"), ContainsSubstring("\n    (it printed nothing)\n"));
    CHECK_THAT(complaint("echo nonsense > \"$1\""), ContainsSubstring("suite.xml:2:48: error: cannot read "));
    CHECK_THAT(complaint("ln -s /dev/zero \"$1\""), ContainsSubstring("wrote no image to {image}\n"));
    CHECK_THAT(complaint("mkfifo \"$1\""), ContainsSubstring("wrote no image to {image}\n"));
    // What steers a terminal, and more than anybody wants to read.
    const std::string loud =
        complaint(R"(printf '\033[2J'; yes something | head -c 3000000; echo last; exit 1)");
    CHECK_THAT(loud, ContainsSubstring("\n    something\n    last\n"));
    CHECK(loud.size() < 12000);
    CHECK(loud.find('\033') == std::string::npos);
    // Time.
    CHECK_THAT(
        complaint("echo working; sleep 1000", "timeout=\"1\""),
        ContainsSubstring("error: the command was stopped after 1.0 s; allow more with timeout=\"...\"\n"));
    directory.suite(entry("./none {image}"));
    CHECK_THAT(
        directory.batch().out,
        ContainsSubstring("error: cannot run './none': there is no program of this name beside the suite\n"));
    directory.suite(entry("plumb-none {image}"));
    CHECK_THAT(
        directory.batch().out,
        ContainsSubstring("error: cannot run 'plumb-none': there is no program of this name in PATH\n"));
}

TEST_CASE("a time-out and a signal end all processes of a command", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    // One that ignores SIGTERM, in the background.
    directory.script("slow", "(trap '' TERM; sh -c 'echo $PPID' > \"$2\"; while true; do sleep 0.1; done) &\n"
                             "sleep 1000");
    const std::string number = (directory / "number").string();
    const auto child = [&] { return static_cast<pid_t>(std::stol(read_bytes(number))); };
    const auto has_ended = [&](pid_t process) {
        for (int i = 0; i < 200 && lives(process); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return !lives(process);
    };
    directory.suite(entry("./slow {image} " + number, "timeout=\"1\""));
    CHECK(directory.batch().exit_code == 1);
    CHECK(has_ended(child()));

    std::filesystem::remove(number);
    directory.suite(entry("./slow {image} " + number) + "<render scene=\"scene.xml\" spp=\"1\"/>");
    const auto wait_and = [&](int signal) {
        return [&, signal](pid_t process) {
            while (!std::filesystem::exists(number) || read_bytes(number).find('\n') == std::string::npos)
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            kill(process, signal);
        };
    };
    const RunResult stopped =
        run_renderer({"batch", "suite.xml", "--allow-commands"}, directory.path(), "", wait_and(SIGINT));
    CHECK(stopped.exit_code == 128 + SIGINT);
    CHECK_THAT(stopped.out, ContainsSubstring("error: interrupted\n"));
    CHECK_THAT(stopped.out, ContainsSubstring("1 error, 1 not run"));
    CHECK(has_ended(child()));
    // A killed batch is resumed by the next one.
    directory.render("in.exr", "1");
    directory.script("slow", "cp \"$(dirname \"$2\")/in.exr\" \"$1\"");
    CHECK(directory.batch().exit_code == 0);
}

TEST_CASE("a command has no shell, and a directory of its own", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    directory.render("in.exr", "1");
    directory.script("show",
                     "for word in \"$@\"; do echo \"<$word>\"; done; pwd; echo \"$TMPDIR\"; cat; exit 1");
    directory.suite(entry(
        R"(./show 'a b' "c d" \$$HOME $$(id) `id` * > x; {{{seed}}} {name} {replica} {width}x{height} {image})",
        "size=\"4x3\" seed=\"5\""));
    const std::string out = directory.batch().out;
    for (const char* word : {"<a b>", "<c d>", "<$HOME>", "<$(id)>", "<`id`>", "<*>", "<>>", "<x;>", "<{5}>",
                             "<mine>", "<1>", "<4x3>"})
        CHECK_THAT(out, ContainsSubstring("\n    " + std::string(word) + "\n"));
    const std::string work = (directory / "batch/suite/mine_work").string();
    CHECK_THAT(out, ContainsSubstring("\n    " + work + "\n    " + work + "\n"));
    CHECK_FALSE(std::filesystem::exists(work));
    CHECK_FALSE(std::filesystem::exists(directory / "x"));
}

TEST_CASE("a batch that is killed takes the program along", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    const std::string number = (directory / "number").string();
    directory.script("slow", "echo $$ > \"$2\"; exec sleep 1000");
    directory.suite(entry("./slow {image} " + number));
    run_renderer({"batch", "suite.xml", "--allow-commands"}, directory.path(), "", [&](pid_t process) {
        while (!std::filesystem::exists(number) || read_bytes(number).find('\n') == std::string::npos)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        kill(process, SIGKILL);
    });
    const auto child = static_cast<pid_t>(std::stol(read_bytes(number)));
    for (int i = 0; i < 200 && lives(child); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK_FALSE(lives(child));
}

TEST_CASE("what is wrong with a command is said before anything is run", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    const auto complaint = [&](const std::string& entries) {
        directory.suite(entries);
        const RunResult run = directory.batch();
        CHECK(run.exit_code == 1);
        return run.err.substr(0, run.err.find('\n'));
    };
    CHECK(complaint(entry("./copy {scene} {imag}")) ==
          "suite.xml:2:48: error: unknown placeholder '{imag}'; did you mean 'image'?");
    CHECK(complaint(entry("./copy {spp} {image}")) ==
          "suite.xml:2:48: error: '{spp}' has no value here; add spp=\"...\"");
    CHECK(complaint(entry("./copy {scene}")) ==
          "suite.xml:2:48: error: the command does not say where to write; put {image} into it");
    CHECK(complaint(entry("./copy {image}", "replicas=\"3\"")) ==
          "suite.xml:2:48: error: 3 replicas would be the same; put {seed} or {replica} into the command");
    CHECK(complaint(entry("./copy '{image}")) == "suite.xml:2:48: error: the quotation mark ' is not closed");
    CHECK(complaint(entry("./copy {image")) ==
          "suite.xml:2:48: error: a single '{' stands in it; write {{ for the character");
    CHECK(complaint(entry("./copy {image}", "replicas=\"0\"")) ==
          "suite.xml:2:74: error: replicas must be an integer from 1 to 1000, not '0'");
    CHECK(
        complaint(entry("./copy {image}", "image=\"a.exr\"")) ==
        "suite.xml:2:64: error: an image is either there or made by a command; remove 'image' or 'command'");
    CHECK(complaint("<render/>") ==
          "suite.xml:2:1: error: <render> needs an attribute 'scene', or 'image' or 'command' "
          "for images of other programs: <render scene=\"...\" .../>");
    CHECK(complaint("<render image=\"a.exr\"/>") ==
          "suite.xml:2:1: error: <render> needs an attribute 'name' where it has no scene: <render "
          "name=\"...\" .../>");
}

TEST_CASE("--update makes what is missing, and replaces only what it is told to", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    const std::string entries = "<render scene=\"scene.xml\" spp=\"4\" reference=\"ref/*.exr\"/>"
                                "<render scene=\"dark.xml\" spp=\"4\" reference=\"ref/*.exr\"/>";
    directory.suite(entries);
    CHECK(directory.batch({"--update"}).exit_code == 0);
    const auto bytes = [&](const char* name) { return read_bytes(directory / name); };
    const std::string scene = bytes("ref/scene.exr"), dark = bytes("ref/dark.exr");
    CHECK(directory.batch({"--update"}).out ==
          "no reference is missing; --update=all or --update=NAME makes them again\n");

    // A changed scene blesses nothing by itself, and its reference is said to be stale.
    std::string brighter = bright_scene();
    brighter.replace(brighter.find("1,1,1"), 5, "3,3,3");
    directory.write("scene.xml", brighter);
    std::filesystem::remove(directory / "ref/dark.exr");
    CHECK(directory.batch({"--update"}).exit_code == 0);
    CHECK(bytes("ref/scene.exr") == scene);
    CHECK(bytes("ref/dark.exr") == dark);
    const RunResult stale = directory.batch({});
    CHECK(stale.exit_code == 3);
    CHECK_THAT(stale.out,
               ContainsSubstring("\n    the reference is stale: 'scene.xml' has changed\n"
                                 "    to accept it: renderer batch suite.xml --update=ref/scene.exr\n"));
    CHECK_THAT(stale.out, ContainsSubstring("; 1 stale"));
    CHECK_THAT(directory.report(), ContainsSubstring("\"'scene.xml' has changed\""));
    const RunResult checked = directory.batch({"--check-references"});
    CHECK(checked.exit_code == 3);
    CHECK_THAT(checked.out, ContainsSubstring("ref/scene.exr  differs "));
    CHECK_THAT(checked.out, ContainsSubstring("ref/dark.exr   passes "));

    const RunResult none = directory.batch({"--update=nothing"});
    CHECK(none.err == "error: no reference is called 'nothing'; the first one is 'ref/scene.exr'\n");
    // The old one is kept, and compared with the new one.
    const RunResult one = directory.batch({"--update=ref/scene.exr"});
    INFO(one.out << one.err);
    CHECK(one.exit_code == 0);
    CHECK(bytes("ref/scene.exr") != scene);
    CHECK(bytes("ref/dark.exr") == dark);
    CHECK_THAT(one.out, ContainsSubstring("; the new one differs from it: p "));
    CHECK_THAT(one.out, ContainsSubstring("\n    to restore it: cp batch/suite/replaced/scene_"));
    CHECK(std::filesystem::exists(directory / "batch/suite/references/report.html"));
    std::string kept;
    for (const auto& file : std::filesystem::directory_iterator(directory / "batch/suite/replaced"))
        kept = read_bytes(file.path());
    CHECK(kept == scene);
    CHECK(directory.batch({}).exit_code == 0);
    CHECK(directory.batch({"--check-references"}).exit_code == 0);
    CHECK(directory.batch({"--update=all"}).out.find("2 made") != std::string::npos);
    CHECK(directory.batch({"--update", "--check-references"}).exit_code == 2);
}

TEST_CASE("the report has failures first and remembers earlier runs", "[cli][batch][foreign]")
{
    const ForeignDirectory directory;
    directory.render("ref.exr", "9", "scene.xml", {});
    directory.render("a.exr", "1");
    directory.render("dark.exr", "1", "dark.xml");
    directory.suite("<render image=\"a.exr\" name=\"a\" reference=\"ref.exr\"/>"
                    "<render image=\"dark.exr\" name=\"dark\" reference=\"ref.exr\"/>");
    directory.batch({});
    directory.batch({});
    const std::string markdown = read_bytes(directory / "batch/suite/summary.md");
    CHECK(markdown.find("| dark | **differs**") < markdown.find("| a | passes"));
    const std::string history = read_bytes(directory / "batch/suite/history.json");
    CHECK(history.starts_with("[\n{\"schema\": 1,"));
    CHECK(std::count(history.begin(), history.end(), '\n') == 4);
    // A damaged history does no harm.
    directory.write("batch/suite/history.json", "{</script>}\n{\"images\": 3}\nnonsense");
    CHECK(directory.batch({}).exit_code == 3);
    const std::string page = read_bytes(directory / "batch/suite/report.html");
    CHECK(page.find("{</script>}") == std::string::npos);
    CHECK_THAT(page, ContainsSubstring("\"significant\": \"data-"));
}
