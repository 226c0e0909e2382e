// SPDX-License-Identifier: MIT
#include "display/connection.h"

#include "plumb/base/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace plumb {

namespace {

constexpr int connect_milliseconds = 2000;
constexpr int poll_milliseconds = 50; // how soon a stop is noticed

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Addresses find_addresses(const ViewerAddress& address)
{
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int problem =
        getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &found);
    if (problem != 0) throw Error(gai_strerror(problem));
    return {found, freeaddrinfo};
}

// 0, or what went wrong.
int connect_within(int socket, const addrinfo& address, int milliseconds)
{
    if (connect(socket, address.ai_addr, address.ai_addrlen) == 0) return 0;
    if (errno != EINPROGRESS) return errno;
    pollfd ready{socket, POLLOUT, 0};
    const int count = poll(&ready, 1, milliseconds);
    if (count == 0) return ETIMEDOUT;
    if (count < 0) return errno;
    int problem = 0;
    socklen_t size = sizeof problem;
    getsockopt(socket, SOL_SOCKET, SO_ERROR, &problem, &size);
    return problem;
}

} // namespace

Connection::Connection(const ViewerAddress& address)
{
    const Addresses addresses = find_addresses(address);
    int problem = ECONNREFUSED;
    for (const addrinfo* one = addresses.get(); one; one = one->ai_next) {
        socket_ = socket(one->ai_family, one->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, one->ai_protocol);
        problem = socket_ < 0 ? errno : connect_within(socket_, *one, connect_milliseconds);
        if (problem == 0) return;
        if (socket_ >= 0) close(socket_);
    }
    throw Error(std::strerror(problem));
}

Connection::~Connection()
{
    close(socket_);
}

bool Connection::write(std::span<const unsigned char> bytes, const std::atomic<bool>& stop)
{
    while (!bytes.empty()) {
        if (stop) return false;
        const ssize_t count = send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (count >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(count));
            continue;
        }
        if (errno == EINTR) continue;
        if (errno != EAGAIN && errno != EWOULDBLOCK) throw Error(std::strerror(errno));
        pollfd ready{socket_, POLLOUT, 0};
        poll(&ready, 1, poll_milliseconds);
    }
    return true;
}

} // namespace plumb
