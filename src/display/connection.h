// SPDX-License-Identifier: MIT
#pragma once

// A TCP connection to which we write.

#include "plumb/display/live_view.h"

#include <atomic>
#include <span>

namespace plumb {

class Connection {
public:
    // Throws Error with the reason: nobody listens, or did not answer within two seconds.
    explicit Connection(const ViewerAddress& address);
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection();

    // Waits until all bytes are taken over, or until `stop` is set. False: it was. Throws Error if the connection is gone.
    bool write(std::span<const unsigned char> bytes, const std::atomic<bool>& stop);

private:
    int socket_ = -1;
};

} // namespace plumb
