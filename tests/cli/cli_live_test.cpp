// SPDX-License-Identifier: MIT

// --tev and --preview, with the real program.

#include "cli/small_scene.h"
#include "plumb/image/image.h"
#include "support/catch.h"
#include "support/tev_server.h"

#include <cstdlib>
#include <pty.h>
#include <sys/wait.h>

using namespace plumb;
using test::TevServer;

TEST_CASE("a viewer has the finished image, with its layers, bit for bit", "[cli][live]")
{
    const SceneDirectory directory;
    const Names aov = {"--aov", "normal,depth,object"};
    const auto render = [&](Names words) {
        words.insert(words.end(), aov.begin(), aov.end());
        return directory.run(words);
    };
    REQUIRE(render({"scene.xml", "-o", "plain.exr", "--spp", "40"}).exit_code == 0);
    TevServer server;
    const RunResult run = render({"scene.xml", "-o", "a.exr", "--spp", "40", "--tev=" + server.address()});
    CHECK(run.exit_code == 0);
    CHECK(run.err.find("warning") == std::string::npos);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "plain.exr"));

    const auto images = server.images();
    CHECK(server.problem().empty());
    REQUIRE(images.size() == 1);
    const auto& [name, shown] = *images.begin();
    CHECK(name == "scene.xml");
    const Image image = read_image(directory / "a.exr", false);
    REQUIRE(shown.width == image.full_width());
    REQUIRE(shown.height == image.full_height());
    CHECK(shown.channels == Names{"R", "G", "B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "object.id"});
    for (const std::string& channel : shown.channels) {
        const auto& names = image.channel_names();
        const auto place = std::find(names.begin(), names.end(), channel) - names.begin();
        std::size_t i = 0;
        for (int y = 0; y < shown.height; ++y)
            for (int x = 0; x < shown.width; ++x)
                REQUIRE(shown.values.at(channel)[i++] == image.pixel(x, y)[place]);
    }
}

TEST_CASE("a viewer of a crop has the crop in its place", "[cli][live]")
{
    const SceneDirectory directory;
    TevServer server;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--crop", "8,4,20,10", "--tev=" + server.address()})
                .exit_code == 0);
    const auto images = server.images();
    CHECK(server.problem().empty());
    const test::ShownImage& shown = images.at("scene.xml");
    CHECK(shown.width == 48);
    const Image image = read_image(directory / "a.exr", false);
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) {
            const bool inside = x >= 8 && x < 28 && y >= 4 && y < 14;
            REQUIRE(shown.values.at("G")[static_cast<std::size_t>(48 * y + x)] ==
                    (inside ? image.color(x, y).g : 0.f));
        }
}

TEST_CASE("a resumed rendering shows what it has already", "[cli][live]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--checkpoint", "c.exr"}).exit_code == 0);
    TevServer server; // nothing is left to be rendered
    REQUIRE(directory
                .run({"scene.xml", "-o", "a.exr", "--checkpoint", "c.exr", "--resume",
                      "--tev=" + server.address()})
                .exit_code == 0);
    const Image image = read_image(directory / "a.exr", false);
    const auto images = server.images();
    CHECK(images.at("scene.xml").values.at("R")[48 * 20 + 20] == image.color(20, 20).r);
}

TEST_CASE("a rendering goes on without a viewer, with one warning", "[cli][live]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "plain.exr", "--spp", "64"}).exit_code == 0);
    const auto warnings = [](const std::string& text) {
        int count = 0;
        for (std::size_t at = 0; (at = text.find("warning: ", at)) != std::string::npos; ++at) ++count;
        return count;
    };
    std::string nobody;
    {
        const TevServer gone;
        nobody = gone.address();
    }
    const RunResult none = directory.run({"scene.xml", "-o", "a.exr", "--spp", "64", "--tev=" + nobody});
    CHECK(none.exit_code == 0);
    CHECK(warnings(none.err) == 1);
    CHECK_THAT(none.err, ContainsSubstring("warning: no live view: no viewer answers at " + nobody +
                                           ": Connection refused\n"));
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "plain.exr"));

    TevServer server(TevServer::Manners::leaves);
    const RunResult left =
        directory.run({"scene.xml", "-o", "b.exr", "--spp", "64", "--tev=" + server.address()});
    CHECK(left.exit_code == 0);
    CHECK(warnings(left.err) <= 1); // none if the end was nearer than the viewer's
    CHECK(read_bytes(directory / "b.exr") == read_bytes(directory / "plain.exr"));
}

TEST_CASE("wrong addresses and kinds of preview are wrong usage", "[cli][live]")
{
    const SceneDirectory directory;
    const RunResult port = directory.run({"scene.xml", "--tev=desk:0"});
    CHECK(port.exit_code == 2);
    CHECK(port.err == "error: --tev: the port must be from 1 to 65535, not '0' (of 'desk:0')\n");
    const RunResult kind = directory.run({"scene.xml", "--preview=ascii"});
    CHECK(kind.exit_code == 2);
    CHECK(kind.err == "error: --preview cannot be 'ascii'; known are blocks, sixel and kitty\n");
}

namespace {

// What the program writes to a terminal of 80x24 characters.
std::string output_on_terminal(const Names& words, const std::filesystem::path& directory)
{
    winsize size{};
    size.ws_col = 80;
    size.ws_row = 24;
    int master = -1;
    std::vector<std::string> all = words;
    all.insert(all.begin(), PLUMB_RENDERER);
    std::vector<char*> argv;
    for (std::string& word : all) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t process = forkpty(&master, nullptr, nullptr, &size);
    if (process == 0) {
        setenv("TERM", "xterm-256color", 1);
        for (const char* name : {"COLORTERM", "TMUX", "TERM_PROGRAM", "KITTY_WINDOW_ID", "KONSOLE_VERSION"})
            unsetenv(name);
        if (chdir(directory.c_str()) == 0) execv(argv[0], argv.data());
        _exit(127);
    }
    REQUIRE(process > 0);
    std::string text;
    char buffer[4096];
    for (ssize_t count = 0; (count = read(master, buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<std::size_t>(count));
    int status = 0;
    waitpid(process, &status, 0);
    close(master);
    CHECK(status == 0);
    return text;
}

} // namespace

TEST_CASE("a preview is drawn on a terminal if it is asked for", "[cli][live]")
{
    const SceneDirectory directory;
    const std::string block = "\u2580";
    const Names words = {"scene.xml", "-o", "a.exr"};
    CHECK(output_on_terminal(words, directory.path()).find(block) == std::string::npos);
    const auto with = [&](const std::string& option) {
        Names more = words;
        more.push_back(option);
        return output_on_terminal(more, directory.path());
    };
    const std::string blocks = with("--preview"); // 24x18 pixels: 12 lines are half of the terminal
    std::size_t count = 0;
    for (std::size_t at = 0; (at = blocks.find(block, at)) != std::string::npos; at += block.size()) ++count;
    CHECK(count > 0);
    CHECK(count % (32 * 12) == 0);
    CHECK_THAT(with("--preview=sixel"), ContainsSubstring("\033P0;1;0q\"1;1;48;36#"));
    CHECK_THAT(with("--preview=kitty"), ContainsSubstring("\033_Ga=T,f=24,s=48,v=36,c=5,r=2,"));
    Names quiet = words;
    quiet.insert(quiet.end(), {"--preview", "--quiet"});
    CHECK(output_on_terminal(quiet, directory.path()).empty());
}

TEST_CASE("a preview needs a terminal", "[cli][live]")
{
    const SceneDirectory directory;
    const Names words = {"scene.xml", "-o", "a.exr", "--preview=blocks"};
    const RunResult run = directory.run(words);
    CHECK(run.exit_code == 0);
    CHECK(run.err.find('\033') == std::string::npos);
}
