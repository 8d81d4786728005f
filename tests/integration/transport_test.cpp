// Channels over real loopback sockets: both ends of ours, and peers that misbehave.

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "protocol/transport/tls.h"
#include "tests/support/raw_peer.h"

namespace macula {
namespace {

using macula::testing::RawSocket;
using macula::testing::RawTls;
using std::chrono::milliseconds;
using std::chrono::seconds;
constexpr milliseconds kPatience = seconds(20);  ///< for what must happen
constexpr milliseconds kAWhile{100};             ///< for what must not

/// Bytes that no wrong order, loss or mix-up leaves the same.
Bytes random_bytes(std::size_t size, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> words(size / 4 + 1);
    std::generate(words.begin(), words.end(), std::ref(random));
    const auto* begin = reinterpret_cast<const std::byte*>(words.data());
    return {begin, begin + size};
}

/// Compares large messages quickly under sanitizers, and without printing them.
bool is(const Expected<Bytes>& received, const Bytes& sent) {
    return received && received->size() == sent.size() &&
           (sent.empty() || std::memcmp(received->data(), sent.data(), sent.size()) == 0);
}

Identity new_identity() {
    Identity identity;
    identity.pem = make_certificate().value();
    identity.credentials = {check_certificate(identity.pem).value(), make_token().value()};
    return identity;
}

class TransportTest : public ::testing::Test {
protected:
    void SetUp() override {
        identity_ = new_identity();
        restart({});
    }

    void restart(ListenOptions options) {
        listener_.reset();
        options.port = 0;
        Expected<std::unique_ptr<Listener>> listener = listen(options, identity_);
        ASSERT_TRUE(listener) << listener.error().message;
        listener_ = std::move(*listener);
    }

    Expected<std::unique_ptr<Channel>> dial(const std::string& host = "127.0.0.1") const {
        return connect(host, listener_->port(), identity_.credentials.fingerprint, kPatience);
    }

    /// A client's and a server's end of one new connection.
    std::pair<std::unique_ptr<Channel>, std::unique_ptr<Channel>> pair() const {
        Expected<std::unique_ptr<Channel>> client = dial();
        EXPECT_TRUE(client) << client.error().message;
        Expected<std::unique_ptr<Channel>> server = listener_->accept(kPatience);
        EXPECT_TRUE(server) << server.error().message;
        return {std::move(*client), std::move(*server)};
    }

    /// The server still serves.
    void expect_service() const {
        const auto [client, server] = pair();
        const Bytes body = random_bytes(1000, 1);
        ASSERT_TRUE(client->send(body, kPatience));
        EXPECT_EQ(server->receive(kPatience), body);
    }

    Identity identity_;
    std::unique_ptr<Listener> listener_;
};

TEST_F(TransportTest, MessagesOfEverySizeArriveWhole) {
    const auto [client, server] = pair();
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{4}, std::size_t{16384},
                                   std::size_t{16385}, kMaxClientMessage_bytes}) {
        const Bytes body = random_bytes(size, 2);
        ASSERT_TRUE(client->send(body, kPatience));
        EXPECT_TRUE(is(server->receive(kPatience), body)) << size;
    }
    const Bytes largest = random_bytes(kMaxServerMessage_bytes, 3);
    std::thread sender([&server = *server, &largest] { EXPECT_TRUE(server.send(largest, kPatience)); });
    EXPECT_TRUE(is(client->receive(kPatience), largest));
    sender.join();
}

TEST_F(TransportTest, BothDirectionsFlowAtOnce) {
    const auto [client, server] = pair();
    constexpr int kMessages = 20;
    const auto send_all = [](Channel& channel, std::size_t size, unsigned seed) {
        for (unsigned i = 0; i < kMessages; ++i) ASSERT_TRUE(channel.send(random_bytes(size, seed + i), kPatience));
    };
    const auto receive_all = [](Channel& channel, std::size_t size, unsigned seed) {
        for (unsigned i = 0; i < kMessages; ++i)
            EXPECT_TRUE(is(channel.receive(kPatience), random_bytes(size, seed + i)));
    };
    constexpr std::size_t kLarge = 150'000;
    std::thread a([&, &channel = *server] { send_all(channel, kLarge, 10); });
    std::thread b([&, &channel = *client] { send_all(channel, kMaxClientMessage_bytes, 90); });
    std::thread c([&, &channel = *server] { receive_all(channel, kMaxClientMessage_bytes, 90); });
    receive_all(*client, kLarge, 10);
    a.join();
    b.join();
    c.join();
}

TEST_F(TransportTest, SeveralThreadsMaySendOnOneChannel) {
    const auto [client, server] = pair();
    std::vector<std::thread> senders;
    for (unsigned id = 0; id < 4; ++id) {
        senders.emplace_back([&channel = *server, id] {
            for (int i = 0; i < 25; ++i) EXPECT_TRUE(channel.send(Bytes(1000 + id, std::byte(id)), kPatience));
        });
    }
    std::array<int, 4> arrived{};
    for (int i = 0; i < 100; ++i) {
        const Expected<Bytes> body = client->receive(kPatience);
        ASSERT_TRUE(body) << body.error().message;
        const auto id = std::to_integer<unsigned>(body->front());
        ASSERT_EQ(*body, Bytes(1000 + id, std::byte(id)));
        ++arrived[id];
    }
    EXPECT_EQ(arrived, (std::array<int, 4>{25, 25, 25, 25}));
    for (std::thread& sender : senders) sender.join();
}

TEST_F(TransportTest, WorksOverIPv6AndByName) {
    EXPECT_TRUE(dial("localhost"));
    const int probe = ::socket(AF_INET6, SOCK_STREAM, 0);
    sockaddr_in6 loopback{};
    loopback.sin6_family = AF_INET6;
    loopback.sin6_addr = in6addr_loopback;
    const bool has_ipv6 = probe >= 0 && ::bind(probe, reinterpret_cast<sockaddr*>(&loopback), sizeof loopback) == 0;
    if (probe >= 0) ::close(probe);
    if (!has_ipv6) GTEST_SKIP() << "this machine has no IPv6";
    const Expected<std::unique_ptr<Channel>> client = dial("::1");
    ASSERT_TRUE(client) << client.error().message;
    EXPECT_EQ((*client)->peer(), "[::1]:" + std::to_string(listener_->port()));
}

TEST_F(TransportTest, PeersAreNamed) {
    const auto [client, server] = pair();
    EXPECT_EQ(client->peer(), "127.0.0.1:" + std::to_string(listener_->port()));
    EXPECT_EQ(server->peer().rfind("127.0.0.1:", 0), 0U) << server->peer();
}

TEST_F(TransportTest, OversizedMessagesAreNotSent) {
    const auto [client, server] = pair();
    EXPECT_EQ(client->send(Bytes(kMaxClientMessage_bytes + 1), kPatience).error().code, ErrorCode::protocol);
    EXPECT_EQ(server->send(Bytes(kMaxServerMessage_bytes + 1), kPatience).error().code, ErrorCode::protocol);
    EXPECT_TRUE(client->send(Bytes(5), kPatience));
    EXPECT_EQ(server->receive(kPatience), Bytes(5));
}

TEST_F(TransportTest, AnotherKeyIsRefusedAndBothAreNamed) {
    const std::string other = new_identity().credentials.fingerprint;
    const Expected<std::unique_ptr<Channel>> client = connect("127.0.0.1", listener_->port(), other, kPatience);
    ASSERT_FALSE(client);
    EXPECT_EQ(client.error().code, ErrorCode::refused);
    EXPECT_NE(client.error().message.find(other), std::string::npos) << client.error().message;
    EXPECT_NE(client.error().message.find(identity_.credentials.fingerprint), std::string::npos);
    EXPECT_EQ(connect("127.0.0.1", listener_->port(), "12:34", kPatience).error().code, ErrorCode::option);
}

TEST_F(TransportTest, PortInUseIsExplained) {
    ListenOptions options;
    options.port = listener_->port();
    const Expected<std::unique_ptr<Listener>> second = listen(options, identity_);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::network);
    EXPECT_NE(second.error().message.find("port " + std::to_string(options.port) + " is in use"), std::string::npos)
        << second.error().message;
    const auto [client, server] = pair();
    listener_.reset();  // the port is free at once, though a connection lives on
    EXPECT_TRUE(listen(options, identity_));
}

TEST_F(TransportTest, BadListenOptionsAreExplained) {
    EXPECT_EQ(listen({.address = "not an address"}, identity_).error().code, ErrorCode::option);
    EXPECT_EQ(listen({.address = "192.0.2.1", .port = 0}, identity_).error().code, ErrorCode::network);
    EXPECT_EQ(listen({.port = 0}, Identity{}).error().code, ErrorCode::input_file);
}

TEST_F(TransportTest, NobodyThereIsExplained) {
    const std::uint16_t port = listener_->port();
    listener_.reset();
    const Expected<std::unique_ptr<Channel>> client =
        connect("127.0.0.1", port, identity_.credentials.fingerprint, kPatience);
    ASSERT_FALSE(client);
    EXPECT_EQ(client.error().code, ErrorCode::network);
    EXPECT_NE(client.error().message.find("127.0.0.1 port " + std::to_string(port)), std::string::npos)
        << client.error().message;
}

TEST_F(TransportTest, ServerThatNeverAnswersTimesOut) {
    const int silent = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::bind(silent, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::listen(silent, 4), 0);
    socklen_t size = sizeof address;
    ASSERT_EQ(::getsockname(silent, reinterpret_cast<sockaddr*>(&address), &size), 0);
    const Expected<std::unique_ptr<Channel>> client =
        connect("127.0.0.1", ntohs(address.sin_port), identity_.credentials.fingerprint, milliseconds(200));
    ASSERT_FALSE(client);
    EXPECT_EQ(client.error().code, ErrorCode::timeout) << client.error().message;
    ::close(silent);
}

TEST_F(TransportTest, GarbageInTheHandshakeDisturbsNobody) {
    const RawSocket browser(listener_->port());
    EXPECT_TRUE(browser.send("GET / HTTP/1.1\r\nHost: example\r\n\r\n"));
    browser.wait_for_end();
    EXPECT_EQ(listener_->accept(kAWhile).error().code, ErrorCode::timeout);
    expect_service();
}

TEST_F(TransportTest, OlderTlsIsRefused) {
    EXPECT_FALSE(RawTls(listener_->port(), TLS1_2_VERSION).connected());
    expect_service();
}

TEST_F(TransportTest, SlowHandshakesHoldUpNobodyAndEnd) {
    restart({.max_pending = 4, .handshake_timeout = milliseconds(500)});
    std::vector<std::unique_ptr<RawSocket>> silent;
    for (int i = 0; i < 12; ++i) silent.push_back(std::make_unique<RawSocket>(listener_->port()));
    expect_service();
    for (const auto& socket : silent) socket->wait_for_end();
}

TEST_F(TransportTest, ConnectionsThatNobodyAcceptsAreBounded) {
    restart({.max_pending = 3});
    std::vector<std::unique_ptr<Channel>> clients;
    for (int i = 0; i < 5; ++i) clients.push_back(std::move(dial().value()));
    EXPECT_EQ(clients.back()->receive(kPatience).error().code, ErrorCode::network);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(listener_->accept(kPatience));
    EXPECT_EQ(listener_->accept(kAWhile).error().code, ErrorCode::timeout);
    expect_service();
}

TEST_F(TransportTest, OversizedLengthIsRefused) {
    const RawTls peer(listener_->port());
    ASSERT_TRUE(peer.connected());
    const Expected<std::unique_ptr<Channel>> server = listener_->accept(kPatience);
    ASSERT_TRUE(server) << server.error().message;
    EXPECT_TRUE(peer.write({std::byte{1}, std::byte{0}, std::byte{1}, std::byte{0}}));  // 65537
    const Expected<Bytes> body = (*server)->receive(kPatience);
    ASSERT_FALSE(body);
    EXPECT_EQ(body.error().code, ErrorCode::protocol);
    EXPECT_NE(body.error().message.find("65537"), std::string::npos) << body.error().message;
    peer.socket().wait_for_end();
    expect_service();
}

TEST_F(TransportTest, SilentPeerTimesOutAndMaySpeakLater) {
    const auto [client, server] = pair();
    EXPECT_EQ(server->receive(kAWhile).error().code, ErrorCode::timeout);
    ASSERT_TRUE(client->send(Bytes(7), kPatience));
    EXPECT_EQ(server->receive(kPatience), Bytes(7));
}

TEST_F(TransportTest, MessageThatArrivesInPiecesIsKeptAcrossTimeouts) {
    const RawTls peer(listener_->port());
    const Expected<std::unique_ptr<Channel>> server = listener_->accept(kPatience);
    ASSERT_TRUE(server) << server.error().message;
    for (const Bytes& piece : {Bytes{std::byte{3}}, Bytes(3), Bytes(1, std::byte{5})}) {
        EXPECT_TRUE(peer.write(piece));
        EXPECT_EQ((*server)->receive(kAWhile).error().code, ErrorCode::timeout);
    }
    EXPECT_TRUE(peer.write(Bytes(2, std::byte{6})));
    EXPECT_EQ((*server)->receive(kPatience), (Bytes{std::byte{5}, std::byte{6}, std::byte{6}}));
}

TEST_F(TransportTest, PeerThatNeverReadsTimesOut) {
    const RawTls peer(listener_->port());
    const Expected<std::unique_ptr<Channel>> server = listener_->accept(kPatience);
    ASSERT_TRUE(server) << server.error().message;
    Expected<void> sent;
    // The kernels on both sides hold a few megabytes.
    for (int i = 0; i < 100 && sent; ++i) sent = (*server)->send(Bytes(1'000'000), milliseconds(300));
    ASSERT_FALSE(sent);
    EXPECT_EQ(sent.error().code, ErrorCode::timeout) << sent.error().message;
    EXPECT_FALSE((*server)->send(Bytes(1), kAWhile));
    EXPECT_FALSE((*server)->receive(kAWhile));
    expect_service();
}

TEST_F(TransportTest, PeerKilledInTheMiddleOfAMessage) {
    auto peer = std::make_unique<RawTls>(listener_->port());
    const Expected<std::unique_ptr<Channel>> server = listener_->accept(kPatience);
    ASSERT_TRUE(server) << server.error().message;
    EXPECT_TRUE(peer->write({std::byte{100}, std::byte{0}, std::byte{0}, std::byte{0}, std::byte{1}}));
    peer.reset();
    const Expected<Bytes> body = (*server)->receive(kPatience);
    ASSERT_FALSE(body);
    EXPECT_EQ(body.error().code, ErrorCode::network);
    EXPECT_NE(body.error().message.find("in the middle of a message"), std::string::npos) << body.error().message;
    expect_service();
}

TEST_F(TransportTest, CloseFromAnotherThreadEndsReceive) {
    const auto [client, server] = pair();
    std::thread closer([&channel = *client] {
        std::this_thread::sleep_for(kAWhile);
        channel.close();
    });
    EXPECT_EQ(client->receive(kPatience).error().code, ErrorCode::network);
    EXPECT_EQ(client->send(Bytes(1), kPatience).error().code, ErrorCode::network);
    EXPECT_EQ(server->receive(kPatience).error().code, ErrorCode::network);
    closer.join();
}

TEST_F(TransportTest, CloseOfTheListenerEndsAccept) {
    std::thread closer([this] {
        std::this_thread::sleep_for(kAWhile);
        listener_->close();
    });
    EXPECT_EQ(listener_->accept(kPatience).error().code, ErrorCode::network);
    closer.join();
    EXPECT_EQ(listener_->accept(kPatience).error().code, ErrorCode::network);
}

/// A reason for closing must not be lost because the peer was still sending.
TEST_F(TransportTest, LastMessageBeforeCloseArrivesThoughThePeerIsSending) {
    for (int round = 0; round < 10; ++round) {
        auto [client, server] = pair();
        std::thread chatter([&channel = *client] {
            while (channel.send(Bytes(2000), kPatience)) {
            }
        });
        ASSERT_TRUE(server->receive(kPatience));
        ASSERT_TRUE(server->send(Bytes(9, std::byte{9}), kPatience));
        server.reset();
        EXPECT_EQ(client->receive(kPatience), Bytes(9, std::byte{9}));
        client->close();
        chatter.join();
    }
}

TEST_F(TransportTest, LastMessageBeforeCloseArrivesThoughAnotherThreadIsStillSending) {
    const Bytes last = random_bytes(10, 5);
    for (int round = 0; round < 10; ++round) {
        auto [client, server] = pair();
        std::thread asking([&peer = *client] {
            while (peer.send(Bytes(2000), kPatience)) {
            }
        });
        // The first is fetched ahead of receive(); the last one waits in the system.
        EXPECT_TRUE(server->send(Bytes(5), kPatience));
        EXPECT_TRUE(server->send(last, kPatience));
        // Nobody reads, so that one of these gets stuck.
        std::thread answering([&mine = *server] {
            while (mine.send(Bytes(1'000'000), kPatience)) {
            }
        });
        std::this_thread::sleep_for(milliseconds(5));
        server->close();
        std::this_thread::sleep_for(milliseconds(5));
        EXPECT_EQ(client->receive(kPatience), Bytes(5));
        EXPECT_TRUE(is(client->receive(kPatience), last)) << "round " << round;
        client->close();
        asking.join();
        answering.join();
    }
}

TEST_F(TransportTest, ChannelsOutliveTheListener) {
    const auto [client, server] = pair();
    listener_.reset();
    ASSERT_TRUE(client->send(Bytes(3), kPatience));
    EXPECT_EQ(server->receive(kPatience), Bytes(3));
}

TEST_F(TransportTest, ManyConnectAtOnce) {
    constexpr unsigned kClients = 24;
    std::vector<std::thread> clients;
    for (unsigned id = 0; id < kClients; ++id) {
        clients.emplace_back([this, id] {
            const Expected<std::unique_ptr<Channel>> client = dial();
            ASSERT_TRUE(client) << client.error().message;
            ASSERT_TRUE((*client)->send(Bytes(id + 1), kPatience));
            EXPECT_EQ((*client)->receive(kPatience), Bytes(2 * (id + 1)));
        });
    }
    std::vector<std::thread> sessions;
    for (unsigned i = 0; i < kClients; ++i) {
        Expected<std::unique_ptr<Channel>> server = listener_->accept(kPatience);
        EXPECT_TRUE(server) << server.error().message;
        if (!server) break;
        sessions.emplace_back([channel = std::move(*server)] {
            const Expected<Bytes> body = channel->receive(kPatience);
            ASSERT_TRUE(body) << body.error().message;
            EXPECT_TRUE(channel->send(Bytes(2 * body->size()), kPatience));
            EXPECT_FALSE(channel->receive(kPatience));  // until the client has gone
        });
    }
    for (std::thread& client : clients) client.join();
    for (std::thread& session : sessions) session.join();
}

}  // namespace
}  // namespace macula
