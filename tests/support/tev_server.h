// SPDX-License-Identifier: MIT
#pragma once

// A viewer as tev's protocol (src/display/tev_packets.h) describes it, read independently: it keeps the images that it is sent.

#include <arpa/inet.h>
#include <atomic>
#include <cstring>
#include <map>
#include <mutex>
#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace plumb::test {

struct ShownImage {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;
    std::map<std::string, std::vector<float>> values; // by channel, by rows
    int updates = 0;
};

class TevServer {
public:
    enum class Manners {
        reads,      // everything
        leaves,     // closes the connection after a few updates
        never_reads // what it is sent stays in the network
    };

    explicit TevServer(Manners manners = Manners::reads) : manners_(manners)
    {
        listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const int small = 4096; // so that a viewer that does not read is noticed soon
        if (manners == Manners::never_reads)
            setsockopt(listener_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
        socklen_t size = sizeof address;
        if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || listen(listener_, 4) != 0 ||
            getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error("cannot listen");
        port_ = ntohs(address.sin_port);
        thread_ = std::thread([this] { serve(); });
    }
    ~TevServer()
    {
        stop_ = true;
        thread_.join();
        close(listener_);
    }
    TevServer(const TevServer&) = delete;
    TevServer& operator=(const TevServer&) = delete;

    int port() const { return port_; }
    std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

    // After the sender has closed the connection: everything is read then.
    std::map<std::string, ShownImage> images()
    {
        for (int i = 0; i < 2000 && !done_; ++i) usleep(5000);
        const std::lock_guard lock(mutex_);
        return images_;
    }
    std::string problem() const
    {
        const std::lock_guard lock(mutex_);
        return problem_;
    }

private:
    class Reader {
    public:
        explicit Reader(std::vector<unsigned char> bytes) : bytes_(std::move(bytes)) {}
        std::uint64_t number(std::size_t size)
        {
            std::uint64_t value = 0;
            for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t{next()} << 8 * i;
            return value;
        }
        int integer() { return static_cast<int>(static_cast<std::int32_t>(number(4))); }
        std::string text()
        {
            std::string text;
            while (const unsigned char c = next()) text += static_cast<char>(c);
            return text;
        }
        float real()
        {
            const auto bits = static_cast<std::uint32_t>(number(4));
            float value = 0.f;
            std::memcpy(&value, &bits, sizeof value);
            return value;
        }
        std::size_t left() const { return bytes_.size() - at_; }

    private:
        unsigned char next()
        {
            if (at_ == bytes_.size()) throw std::runtime_error("the packet ends early");
            return bytes_[at_++];
        }
        std::vector<unsigned char> bytes_;
        std::size_t at_ = 0;
    };

    void serve()
    {
        try {
            const int connection = accept_one();
            if (connection < 0) return;
            if (manners_ == Manners::never_reads) {
                while (!stop_) usleep(5000);
            } else {
                int packets = 0;
                while (!stop_ && take_packet(connection))
                    if (manners_ == Manners::leaves && ++packets == 3) break;
            }
            close(connection);
        } catch (const std::exception& error) {
            const std::lock_guard lock(mutex_);
            problem_ = error.what();
        }
        done_ = true;
    }

    int accept_one()
    {
        while (!stop_) {
            pollfd ready{listener_, POLLIN, 0};
            if (poll(&ready, 1, 5) > 0) return accept(listener_, nullptr, nullptr);
        }
        return -1;
    }

    // Nothing at the end.
    std::vector<unsigned char> read_bytes(int connection, std::size_t count)
    {
        std::vector<unsigned char> bytes(count);
        std::size_t have = 0;
        while (have < count && !stop_) {
            pollfd ready{connection, POLLIN, 0};
            if (poll(&ready, 1, 5) <= 0) continue;
            const ssize_t got = recv(connection, bytes.data() + have, count - have, 0);
            if (got <= 0) {
                if (have > 0) throw std::runtime_error("the connection ends inside a packet");
                return {};
            }
            have += static_cast<std::size_t>(got);
        }
        return bytes;
    }

    bool take_packet(int connection)
    {
        const std::vector<unsigned char> start = read_bytes(connection, 4);
        if (start.empty() || stop_) return false;
        const std::size_t length = start[0] | start[1] << 8 | start[2] << 16 | std::size_t{start[3]} << 24;
        if (length < 6) throw std::runtime_error("a packet of " + std::to_string(length) + " bytes");
        Reader reader(read_bytes(connection, length - 4));
        const auto kind = reader.number(1);
        reader.number(1); // whether to grab the focus
        const std::string name = reader.text();
        const std::lock_guard lock(mutex_);
        if (kind == 4)
            create(images_[name], reader);
        else if (kind == 6)
            update(images_.at(name), reader);
        else
            throw std::runtime_error("a packet of kind " + std::to_string(kind));
        if (reader.left() > 0) throw std::runtime_error("a packet has too many bytes");
        return true;
    }

    static void create(ShownImage& image, Reader& reader)
    {
        image = {};
        image.width = reader.integer();
        image.height = reader.integer();
        image.channels.resize(static_cast<std::size_t>(reader.integer()));
        for (std::string& channel : image.channels) {
            channel = reader.text();
            image.values[channel].resize(static_cast<std::size_t>(image.width) *
                                         static_cast<std::size_t>(image.height));
        }
    }

    static void update(ShownImage& image, Reader& reader)
    {
        std::vector<std::string> channels(static_cast<std::size_t>(reader.integer()));
        for (std::string& channel : channels) channel = reader.text();
        const int x = reader.integer(), y = reader.integer(), width = reader.integer(),
                  height = reader.integer();
        if (x < 0 || y < 0 || x + width > image.width || y + height > image.height)
            throw std::runtime_error("a part outside the image");
        std::vector<std::uint64_t> offsets, strides;
        for (std::size_t i = 0; i < channels.size(); ++i) offsets.push_back(reader.number(8));
        for (std::size_t i = 0; i < channels.size(); ++i) strides.push_back(reader.number(8));
        std::vector<float> data(reader.left() / 4);
        for (float& value : data) value = reader.real();
        for (std::size_t c = 0; c < channels.size(); ++c)
            for (int row = 0; row < height; ++row)
                for (int column = 0; column < width; ++column)
                    image.values.at(
                        channels[c])[static_cast<std::size_t>((y + row) * image.width + x + column)] =
                        data.at(offsets[c] + static_cast<std::size_t>(row * width + column) * strides[c]);
        ++image.updates;
    }

    const Manners manners_;
    int listener_ = -1;
    int port_ = 0;
    std::atomic<bool> stop_ = false;
    std::atomic<bool> done_ = false;
    mutable std::mutex mutex_;
    std::map<std::string, ShownImage> images_;
    std::string problem_;
    std::thread thread_;
};

} // namespace plumb::test
