// SPDX-License-Identifier: MIT
#pragma once

// An image in a viewer while it is made: in tev (https://github.com/Tom94/tev) or HDRView, by the protocol of tev (tev_packets.h).
//
// A thread of its own sends. Whoever updates never waits: of a part of the image that the viewer has not taken yet, only the
// newest values are kept. If the viewer goes away, updates are ignored from then on.

#include "plumb/image/image.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

// "HOST:PORT", "HOST", ":PORT" or "[::1]:PORT"; what is absent is 127.0.0.1 and 14158.
struct ViewerAddress {
    std::string host = "127.0.0.1";
    int port = 14158;
    friend bool operator==(const ViewerAddress&, const ViewerAddress&) = default;
};
// Throws Error.
ViewerAddress viewer_address(const std::string& text);
std::string to_string(const ViewerAddress& address);

class LiveView {
public:
    // Connects, within two seconds; if that fails, problem() says why. The image appears in the viewer under this name. The
    // channels of layers are called LAYER.X; both viewers show them as layers.
    LiveView(const ViewerAddress& address, const std::string& name, int width, int height,
             std::vector<std::string> channels);
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;
    // Sends what is left, for two seconds at most.
    ~LiveView();

    // values: of each pixel of the part, by rows, its channels. From any thread.
    void update(const PixelRect& part, std::vector<float> values);

    // Why there is no connection (any more); nothing: there is one, or it has been asked before. From any thread.
    std::optional<std::string> take_problem();

private:
    class Sender;
    std::unique_ptr<Sender> sender_;
};

} // namespace plumb
