// SPDX-License-Identifier: MIT
#include "plumb/display/live_view.h"

#include "display/connection.h"
#include "display/tev_packets.h"
#include "plumb/base/error.h"

#include <charconv>
#include <chrono>
#include <condition_variable>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <thread>

namespace plumb {

namespace {

constexpr auto last_moment = std::chrono::seconds(2); // for what is left at the end

int parse_port(const std::string& text, const std::string& whole)
{
    int port = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (problem != std::errc() || end != text.data() + text.size() || port < 1 || port > 65535)
        throw Error(fmt::format("the port must be from 1 to 65535, not '{}' (of '{}')", text, whole));
    return port;
}

} // namespace

ViewerAddress viewer_address(const std::string& text)
{
    ViewerAddress address;
    std::string host = text;
    const std::size_t bracket = text.starts_with('[') ? text.find(']') : std::string::npos;
    const std::size_t colon = text.find(':', bracket == std::string::npos ? 0 : bracket);
    if (bracket == std::string::npos && colon != text.rfind(':'))
        throw Error(
            fmt::format("'{}' must be HOST:PORT; an IPv6 address stands in brackets: [::1]:14158", text));
    if (colon != std::string::npos) {
        address.port = parse_port(text.substr(colon + 1), text);
        host = text.substr(0, colon);
    }
    if (host.starts_with('[')) {
        if (!host.ends_with(']')) throw Error(fmt::format("'{}' must be HOST:PORT or [IPv6]:PORT", text));
        host = host.substr(1, host.size() - 2);
    }
    if (!host.empty()) address.host = host;
    return address;
}

std::string to_string(const ViewerAddress& address)
{
    const bool is_v6 = address.host.find(':') != std::string::npos;
    return is_v6 ? fmt::format("[{}]:{}", address.host, address.port)
                 : fmt::format("{}:{}", address.host, address.port);
}

// Holds what is to be sent, and the thread that sends it.
class LiveView::Sender {
public:
    Sender(const ViewerAddress& address, const std::string& name, int width, int height,
           std::vector<std::string> channels)
        : address_(address), name_(name), channels_(std::move(channels))
    {
        try {
            connection_ = std::make_unique<Connection>(address);
            connection_->write(tev::create_image(name_, width, height, channels_), stop_);
            thread_ = std::thread([this] { run(); });
        } catch (const std::exception& error) {
            give_up(
                fmt::format("no live view: no viewer answers at {}: {}", to_string(address), error.what()));
        }
    }

    ~Sender()
    {
        {
            std::unique_lock lock(mutex_);
            closing_ = true;
            changed_.notify_all();
            changed_.wait_for(lock, last_moment,
                              [this] { return is_gone_ || (waiting_.empty() && !is_sending_); });
            stop_ = true;
            changed_.notify_all();
        }
        if (thread_.joinable()) thread_.join();
    }

    void update(const PixelRect& part, std::vector<float> values)
    {
        if (is_gone_) return;
        const std::lock_guard lock(mutex_);
        waiting_[{part.y, part.x, part.height, part.width}] = std::move(values);
        changed_.notify_all();
    }

    std::optional<std::string> take_problem()
    {
        const std::lock_guard lock(mutex_);
        return std::exchange(problem_, std::nullopt);
    }

private:
    using Place = std::array<int, 4>; // y, x, height, width: from the top

    void run()
    {
        try {
            while (send_next()) {
            }
        } catch (const std::exception& error) {
            give_up(fmt::format("the live view ended: the viewer at {} is gone: {}; rendering continues",
                                to_string(address_), error.what()));
        }
    }

    // Goes round the image, so that no part waits for ever. False: it is over.
    bool send_next()
    {
        std::pair<Place, std::vector<float>> next;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return stop_ || !waiting_.empty() || closing_; });
            if (stop_ || waiting_.empty()) return false;
            auto found = waiting_.upper_bound(last_);
            if (found == waiting_.end()) found = waiting_.begin();
            next = {found->first, std::move(found->second)};
            waiting_.erase(found);
            last_ = next.first;
            is_sending_ = true;
        }
        const auto [y, x, height, width] = next.first;
        const bool is_sent = connection_->write(
            tev::update_image(name_, channels_, {x, y, width, height}, next.second), stop_);
        const std::lock_guard lock(mutex_);
        is_sending_ = false;
        changed_.notify_all();
        return is_sent;
    }

    void give_up(std::string problem)
    {
        const std::lock_guard lock(mutex_);
        problem_ = std::move(problem);
        is_gone_ = true;
        waiting_.clear();
        changed_.notify_all();
    }

    const ViewerAddress address_;
    const std::string name_;
    const std::vector<std::string> channels_;
    std::unique_ptr<Connection> connection_; // of the thread, once that runs
    std::atomic<bool> is_gone_ = false;
    std::atomic<bool> stop_ = false;

    std::mutex mutex_; // of all below
    std::condition_variable changed_;
    std::map<Place, std::vector<float>> waiting_;
    Place last_{};
    bool is_sending_ = false;
    bool closing_ = false;
    std::optional<std::string> problem_;

    std::thread thread_;
};

LiveView::LiveView(const ViewerAddress& address, const std::string& name, int width, int height,
                   std::vector<std::string> channels)
    : sender_(std::make_unique<Sender>(address, name, width, height, std::move(channels)))
{}

LiveView::~LiveView() = default;

void LiveView::update(const PixelRect& part, std::vector<float> values)
{
    sender_->update(part, std::move(values));
}

std::optional<std::string> LiveView::take_problem()
{
    return sender_->take_problem();
}

} // namespace plumb
