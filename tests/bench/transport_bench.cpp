// How long a message takes to come back over a loopback connection, and how fast messages flow one way. Plain TCP
// with the same framing and the same blocking threads is the yardstick: the difference is TLS and the hand-over to
// the I/O thread.

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include "protocol/base/clock.h"
#include "protocol/transport/tls.h"

namespace {

using namespace macula;
constexpr std::chrono::seconds kPatience{10};

void report(benchmark::State& state, std::vector<std::int64_t>& times_ns) {
    std::sort(times_ns.begin(), times_ns.end());
    const auto percentile_us = [&](double share) {
        return 1e-3 * static_cast<double>(
                          times_ns[static_cast<std::size_t>(share * static_cast<double>(times_ns.size() - 1))]);
    };
    state.counters["min_us"] = percentile_us(0.0);
    state.counters["p50_us"] = percentile_us(0.5);
    state.counters["p99_us"] = percentile_us(0.99);
}

struct Pair {
    std::unique_ptr<Listener> listener;
    std::unique_ptr<Channel> client;
    std::unique_ptr<Channel> server;
};

Pair channels() {
    Identity identity;
    identity.pem = make_certificate().value();
    const std::string fingerprint = check_certificate(identity.pem).value();
    ListenOptions options;
    options.port = 0;
    Pair pair;
    pair.listener = std::move(listen(options, identity).value());
    pair.client = std::move(connect("127.0.0.1", pair.listener->port(), fingerprint, kPatience).value());
    pair.server = std::move(pair.listener->accept(kPatience).value());
    return pair;
}

/// The server sends a message of the argument's size; the client answers with a short one.
void channel_round_trip(benchmark::State& state) {
    const Pair pair = channels();
    std::thread client([&channel = *pair.client] {
        while (channel.receive(kPatience) && channel.send(Bytes(100), kPatience)) {
        }
    });
    const Bytes body(static_cast<std::size_t>(state.range(0)));
    std::vector<std::int64_t> times_ns;
    for (auto _ : state) {
        const std::int64_t begin_ns = now_ns();
        if (!pair.server->send(body, kPatience) || !pair.server->receive(kPatience)) {
            state.SkipWithError("the channel broke");
            break;
        }
        times_ns.push_back(now_ns() - begin_ns);
    }
    pair.server->close();
    client.join();
    report(state, times_ns);
}

/// Reads or writes all of it on a plain socket.
template <class Call, class Byte>
bool whole(Call call, int socket, Byte* data, std::size_t size) {
    while (size > 0) {
        const ssize_t done = call(socket, data, size, MSG_NOSIGNAL);
        if (done <= 0) return false;
        data += done;
        size -= static_cast<std::size_t>(done);
    }
    return true;
}

void plain_tcp_round_trip(benchmark::State& state) {
    const int door = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t address_size = sizeof address;
    const int client_end = ::socket(AF_INET, SOCK_STREAM, 0);
    if (::bind(door, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 || ::listen(door, 1) != 0 ||
        ::getsockname(door, reinterpret_cast<sockaddr*>(&address), &address_size) != 0 ||
        ::connect(client_end, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
        state.SkipWithError("no loopback socket");
        return;
    }
    const int server_end = ::accept(door, nullptr, nullptr);
    const int on = 1;
    ::setsockopt(client_end, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::setsockopt(server_end, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const auto size = static_cast<std::size_t>(state.range(0)) + 4;
    std::thread client([size, client_end] {
        std::vector<char> message(size);
        while (whole(::recv, client_end, message.data(), size) && whole(::send, client_end, message.data(), 104)) {
        }
    });
    std::vector<char> message(size);
    std::vector<std::int64_t> times_ns;
    for (auto _ : state) {
        const std::int64_t begin_ns = now_ns();
        if (!whole(::send, server_end, message.data(), size) || !whole(::recv, server_end, message.data(), 104)) {
            state.SkipWithError("the socket broke");
            break;
        }
        times_ns.push_back(now_ns() - begin_ns);
    }
    ::close(server_end);
    client.join();
    ::close(client_end);
    ::close(door);
    report(state, times_ns);
}

void channel_one_way(benchmark::State& state) {
    const Pair pair = channels();
    std::thread client([&channel = *pair.client] {
        while (channel.receive(kPatience)) {
        }
    });
    const Bytes body(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        if (!pair.server->send(body, kPatience)) state.SkipWithError("the channel broke");
    }
    state.SetBytesProcessed(state.iterations() * state.range(0));
    pair.server->close();
    client.join();
}

BENCHMARK(channel_round_trip)->Arg(100)->Arg(50'000)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(plain_tcp_round_trip)->Arg(100)->Arg(50'000)->UseRealTime()->Unit(benchmark::kMicrosecond);
BENCHMARK(channel_one_way)->Arg(50'000)->Arg(1'000'000)->UseRealTime()->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
