#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "protocol/message/message.h"
#include "protocol/transport/tls.h"

namespace macula::testing {

/// Longer than anything takes that must happen, sanitizers and a busy machine included.
inline constexpr std::chrono::milliseconds kPatience{20'000};
/// For what must not happen.
inline constexpr std::chrono::milliseconds kAWhile{100};

/// Hello of a client with a 128x128 display, 90 degrees square, that leaves the sampling to the server.
Hello small_hello(const std::string& token);

/// A client that follows a script instead of a headset.
class Peer {
public:
    /// Connects to a server on this machine; fails the test if there is none.
    Peer(std::uint16_t port, const Credentials& credentials);

    void send(const Message& message);
    /// Next message; nothing when the time is up or the connection has ended.
    std::optional<Message> receive(std::chrono::milliseconds timeout = kPatience);
    /// Next message if it is a T; else the test fails.
    template <class T>
    std::optional<T> expect(std::chrono::milliseconds timeout = kPatience) {
        auto message = receive(timeout);
        if (message && std::holds_alternative<T>(*message)) return std::get<T>(*std::move(message));
        complain(message);
        return std::nullopt;
    }
    /// Says Hello and expects to be welcome.
    std::optional<Welcome> greet();

    /// Sends a Track with the next id, for a head at rest that looks ahead; returns the id.
    std::uint64_t send_track();
    /// Sends a Track, receives the frame and reports it as shown.
    std::optional<Frame> next_frame();
    /// Waits until the server has closed the connection.
    bool wait_for_end();

    [[nodiscard]] Channel& channel() { return *channel_; }
    /// Breaks the connection without a word.
    void vanish() { channel_.reset(); }

private:
    static void complain(const std::optional<Message>& message);

    Credentials credentials_;
    std::unique_ptr<Channel> channel_;
    std::uint64_t tracks_ = 0;
};

}  // namespace macula::testing
