#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "protocol/transport/identity.h"
#include "server/service/server.h"
#include "tests/support/peer.h"

namespace macula::testing {

/// Distance of the wall that small_supplies() shows, and its sRGB colour.
inline constexpr float kWallDistance_m = 2.0F;
inline constexpr Rgba8 kWallColor = 0xff00bcbc;

/// Everything that a server needs, for real: Embree, tile sampling at 27 %, C++ reconstruction, x264; the scene is
/// one unlit wall before the viewer. Made once and shared, since the tables take a moment. Encoders are told to use
/// one thread; a test that limits oneTBB to one thread as well keeps all code on threads that sanitizers understand.
const Supplies& small_supplies();

/// A server on a free loopback port, running until it goes.
class RunningServer {
public:
    explicit RunningServer(ServerOptions options = {}, const Supplies& supplies = small_supplies());
    ~RunningServer();

    [[nodiscard]] std::uint16_t port() const { return server_->port(); }
    [[nodiscard]] const Credentials& credentials() const { return identity_.credentials; }
    [[nodiscard]] const ServerCounters& counters() const { return server_->counters(); }
    void stop() { server_->stop(); }
    /// Waits until the counters say so, for example `[](const ServerCounters& now) { return now.sessions == 0; }`.
    template <class Condition>
    [[nodiscard]] bool wait_until(Condition condition) const {
        const auto deadline = std::chrono::steady_clock::now() + kPatience;
        while (!condition(counters())) {
            if (std::chrono::steady_clock::now() > deadline) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }

private:
    Identity identity_;
    std::unique_ptr<Server> server_;
    std::future<Expected<void>> outcome_;
};

}  // namespace macula::testing
