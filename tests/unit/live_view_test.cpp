// SPDX-License-Identifier: MIT

// Sending images to a viewer that speaks tev's protocol.

#include "plumb/display/live_view.h"

#include "display/tev_packets.h"
#include "plumb/base/error.h"
#include "support/catch.h"
#include "support/tev_server.h"

#include <chrono>

using namespace plumb;
using test::TevServer;

namespace {

using Names = std::vector<std::string>;

ViewerAddress address_of(const TevServer& server)
{
    return {"127.0.0.1", server.port()};
}

double seconds_of(const std::function<void()>& work)
{
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

TEST_CASE("packets are byte for byte those of tev's protocol", "[unit][display]")
{
    // As the author's Python module, tevclient 1.0.4, makes them.
    const Names channels = {"R", "a.Z"};
    const auto bytes = [](const tev::Packet& packet) { return std::string(packet.begin(), packet.end()); };
    using namespace std::string_literals;
    CHECK(bytes(tev::create_image("x", 3, 2, channels)) ==
          "\x1a\0\0\0\x04\0x\0\x03\0\0\0\x02\0\0\0\x02\0\0\0R\0a.Z\0"s);
    const float values[] = {1.f, -2.f};
    CHECK(bytes(tev::update_image("x", channels, {1, 0, 1, 1}, values)) ==
          "\x4a\0\0\0\x06\0x\0\x02\0\0\0R\0a.Z\0"s  // 4 + 4 + 4 + 6 bytes
          "\x01\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0"s // x, y, width, height
          "\0\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0"s     // offsets
          "\x02\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0"s   // strides
          "\0\0\x80\x3f\0\0\0\xc0"s);
}

TEST_CASE("a viewer has the image that was sent last", "[unit][display]")
{
    TevServer server;
    {
        LiveView view(address_of(server), "scene.xml", 40, 30, {"R", "G", "B", "depth.Z"});
        CHECK_FALSE(view.take_problem());
        for (int round = 1; round <= 50; ++round)
            for (int y = 0; y < 30; y += 10)
                for (int x = 0; x < 40; x += 10) {
                    std::vector<float> values;
                    for (int i = 0; i < 100; ++i)
                        for (int c = 0; c < 4; ++c)
                            values.push_back(
                                static_cast<float>(round * 10000 + (y + i / 10) * 100 + x + i % 10) +
                                0.25f * static_cast<float>(c));
                    view.update({x, y, 10, 10}, std::move(values));
                }
    }
    const auto images = server.images();
    CHECK(server.problem().empty());
    REQUIRE(images.contains("scene.xml"));
    const test::ShownImage& image = images.at("scene.xml");
    CHECK(image.channels == Names{"R", "G", "B", "depth.Z"});
    CHECK(image.updates >= 12);
    CHECK(image.updates <= 600); // parts that were overtaken may be left out
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            for (std::size_t c = 0; c < 4; ++c)
                REQUIRE(image.values.at(image.channels[c])[static_cast<std::size_t>(y * 40 + x)] ==
                        static_cast<float>(500000 + y * 100 + x) + 0.25f * static_cast<float>(c));
}

TEST_CASE("where no viewer is, updates cost nothing and one problem is told", "[unit][display]")
{
    int port = 0;
    {
        const TevServer gone;
        port = gone.port();
    }
    LiveView view({"127.0.0.1", port}, "x", 4, 4, {"R", "G", "B"});
    const auto problem = view.take_problem();
    REQUIRE(problem);
    CHECK(*problem ==
          "no live view: no viewer answers at 127.0.0.1:" + std::to_string(port) + ": Connection refused");
    view.update({0, 0, 4, 4}, std::vector<float>(48));
    CHECK_FALSE(view.take_problem());
}

TEST_CASE("a viewer that leaves is told once", "[unit][display]")
{
    TevServer server(TevServer::Manners::leaves);
    LiveView view(address_of(server), "x", 64, 64, {"R", "G", "B"});
    std::optional<std::string> problem;
    for (int i = 0; i < 2000 && !problem; ++i) {
        view.update({0, i % 64, 64, 1}, std::vector<float>(192));
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        problem = view.take_problem();
    }
    REQUIRE(problem);
    CHECK_THAT(*problem,
               ContainsSubstring("the live view ended: the viewer at " + server.address() + " is gone: "));
    CHECK_THAT(*problem, ContainsSubstring("; rendering continues"));
    for (int i = 0; i < 10; ++i) view.update({0, 0, 64, 1}, std::vector<float>(192));
    CHECK_FALSE(view.take_problem());
}

TEST_CASE("a viewer that does not read stops nobody", "[unit][display]")
{
    TevServer server(TevServer::Manners::never_reads);
    std::optional<LiveView> view(std::in_place, address_of(server), "x", 1024, 1024, Names{"R", "G", "B"});
    const std::vector<float> values(3 * 1024 * 64);
    // 120 MB, far more than sockets hold: what is not taken is replaced.
    const double updating = seconds_of([&] {
        for (int round = 0; round < 10; ++round)
            for (int y = 0; y < 1024; y += 64) view->update({0, y, 1024, 64}, values);
    });
    CHECK(updating < 30.0); // it would be for ever
    const double closing = seconds_of([&] { view.reset(); });
    CHECK(closing < 30.0); // two seconds, and what a busy machine adds
}

TEST_CASE("addresses of viewers", "[unit][display]")
{
    using Address = ViewerAddress;
    CHECK(viewer_address("") == Address{"127.0.0.1", 14158});
    CHECK(viewer_address("desk") == Address{"desk", 14158});
    CHECK(viewer_address("desk:99") == Address{"desk", 99});
    CHECK(viewer_address(":99") == Address{"127.0.0.1", 99});
    CHECK(viewer_address("[::1]:99") == Address{"::1", 99});
    CHECK(viewer_address("[::1]") == Address{"::1", 14158});
    CHECK(to_string(Address{"::1", 99}) == "[::1]:99");
    CHECK(to_string(Address{"desk", 99}) == "desk:99");
    CHECK_THROWS_WITH(viewer_address("desk:"), "the port must be from 1 to 65535, not '' (of 'desk:')");
    CHECK_THROWS_WITH(viewer_address("desk:70000"),
                      "the port must be from 1 to 65535, not '70000' (of 'desk:70000')");
    CHECK_THROWS_WITH(viewer_address("::1"),
                      "'::1' must be HOST:PORT; an IPv6 address stands in brackets: [::1]:14158");
    CHECK_THROWS_WITH(viewer_address("[::1"), ContainsSubstring("must be HOST:PORT"));
}
