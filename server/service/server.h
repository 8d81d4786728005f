#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "protocol/base/error.h"
#include "protocol/transport/channel.h"
#include "server/service/connection.h"

namespace macula {

/// Accepts clients and serves each on threads of its own; all share the scene, the tracer and the thread pool. What
/// one client does wrong ends its own session only.
class Server {
public:
    /// Listens already when it is made; clients are served by run().
    Server(std::unique_ptr<Listener> listener, Supplies supplies, ServerOptions options,
           std::shared_ptr<spdlog::logger> logger);
    /// Stops, if stop() was not called.
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Accepts clients until stop(). Errors: `network` if the listener breaks.
    Expected<void> run();

    /// Says Bye to all clients, waits for their sessions to end, and ends run(). Any thread but a session's.
    void stop();

    [[nodiscard]] const ServerCounters& counters() const { return shared_.counters; }
    [[nodiscard]] std::uint16_t port() const { return listener_->port(); }

private:
    struct Served {
        std::unique_ptr<Connection> connection;
        std::jthread thread;
    };

    void serve(std::unique_ptr<Connection> connection);
    void forget_ended();

    std::unique_ptr<Listener> listener_;
    ConnectionShared shared_;
    std::atomic<bool> stopping_{false};
    std::mutex mutex_;
    std::list<Served> served_;
};

}  // namespace macula
