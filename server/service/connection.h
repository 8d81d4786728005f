#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "protocol/transport/channel.h"
#include "server/service/handshake.h"
#include "server/service/session.h"
#include "server/service/supplies.h"

namespace macula {

/// Limits of a server. Tests shorten the times.
struct ServerOptions {
    std::string token;  ///< clients must present it
    int max_sessions = 4;
    /// Connections whose client has not yet shown the token; more are closed at once.
    int max_greetings = 16;
    std::chrono::milliseconds greeting_limit{5'000};  ///< for a Hello to arrive
    SessionOptions session;
};

/// What happened since the start. Counts only grow, except `sessions` and `greetings`.
struct ServerCounters {
    std::atomic<std::uint64_t> connections{0};
    std::atomic<std::uint64_t> refused{0};    ///< Hellos that got a Refused
    std::atomic<std::uint64_t> malformed{0};  ///< connections ended by a message that breaks the protocol
    std::atomic<int> greetings{0};            ///< clients now in the handshake
    std::atomic<int> sessions{0};             ///< clients now served
};

/// What connections share.
struct ConnectionShared {
    Supplies supplies;
    ServerOptions options;
    std::shared_ptr<spdlog::logger> logger;
    ServerCounters counters;
};

/// One client from its first byte to its last: handshake, then a session.
class Connection {
public:
    /// `shared` outlives the connection. `number` names it in the log.
    Connection(std::uint64_t number, std::unique_ptr<Channel> channel, ConnectionShared& shared);

    /// Serves the client until it leaves or is told to. Never fails: what goes wrong is logged and counted.
    void run();

    /// Ends run() soon, with a Bye if a session is on. Any thread, any time.
    void stop(const std::string& reason);

    [[nodiscard]] bool ended() const { return ended_; }

private:
    Expected<void> greet_and_serve();
    Expected<Hello> receive_hello();
    Expected<void> serve(Admission admission);
    /// Tells the client why, if it can still hear it; returns the error.
    tl::unexpected<Error> refuse(const Error& error);

    std::string name_;
    std::unique_ptr<Channel> channel_;
    ConnectionShared& shared_;
    std::mutex mutex_;
    std::shared_ptr<Session> session_;
    bool stopped_ = false;
    std::atomic<bool> ended_{false};
};

}  // namespace macula
