#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/steady_timer.hpp>

#include "protocol/transport/channel.h"
#include "protocol/transport/io_thread.h"

namespace macula {

/// "address:port", IPv6 in brackets.
std::string name_of(const boost::asio::ip::tcp::endpoint& endpoint);

struct MessageLimits {
    std::size_t receive_bytes;
    std::size_t send_bytes;
};

/// A TLS stream that carries framed messages. It has two faces: the first half of its members runs on the I/O
/// thread and never blocks; the second half is the blocking interface of Channel, for any thread.
///
/// Reading is one message ahead: the next is read while the user works on the last, and no further.
class TlsConnection : public std::enable_shared_from_this<TlsConnection> {
public:
    using AsioError = boost::system::error_code;
    using Stream = boost::asio::ssl::stream<boost::asio::ip::tcp::socket>;

    TlsConnection(boost::asio::io_context& io, boost::asio::ssl::context& tls, MessageLimits limits);

    // --- on the I/O thread

    [[nodiscard]] boost::asio::ip::tcp::socket& socket() { return stream_.next_layer(); }
    [[nodiscard]] Stream& stream() { return stream_; }
    /// Tunes the connected socket and shakes hands; after `timeout` the socket is closed and `done` gets an error.
    void handshake(boost::asio::ssl::stream_base::handshake_type side, std::chrono::milliseconds timeout,
                   std::function<void(AsioError)> done);
    /// Starts to read, after the handshake.
    void start();
    /// Closes the socket at once.
    void abort();

    // --- on any thread; the contract of Channel

    Expected<Bytes> receive(std::chrono::milliseconds timeout);
    Expected<void> send(std::span<const std::byte> body, std::chrono::milliseconds timeout);
    void close();
    [[nodiscard]] const std::string& peer() const { return peer_; }

private:
    void read_length();
    void read_body();
    void write();
    void linger();
    void end_sending();
    void drain();
    void close_after(std::chrono::milliseconds delay);
    void break_off(Error error);
    [[nodiscard]] Error describe(AsioError error, bool inside_message) const;

    boost::asio::io_context& io_;
    const MessageLimits limits_;
    Stream stream_;
    boost::asio::steady_timer timer_;
    std::string peer_;
    std::array<unsigned char, 4> length_{};
    Bytes incoming_;
    bool reading_ = false;
    bool writing_ = false;
    bool lingering_ = false;

    std::mutex mutex_;  ///< guards what follows, except outgoing_ while it is being written
    std::condition_variable changed_;
    std::optional<Bytes> received_;
    std::optional<Error> failure_;  ///< why the channel has ended; set once
    bool sending_ = false;          ///< a thread is in send()
    bool written_ = true;           ///< its message is in the system's hands
    Bytes outgoing_;
};

/// A connection as its users hold it: keeps the I/O thread alive, and closes the connection when it goes.
class TlsChannel final : public Channel {
public:
    TlsChannel(std::shared_ptr<IoThread> io, std::shared_ptr<TlsConnection> connection)
        : io_(std::move(io)), connection_(std::move(connection)) {}
    ~TlsChannel() override { connection_->close(); }

    Expected<Bytes> receive(std::chrono::milliseconds timeout) override { return connection_->receive(timeout); }
    Expected<void> send(std::span<const std::byte> body, std::chrono::milliseconds timeout) override {
        return connection_->send(body, timeout);
    }
    void close() noexcept override { connection_->close(); }
    [[nodiscard]] std::string peer() const override { return connection_->peer(); }

private:
    std::shared_ptr<IoThread> io_;  // declared first: outlives the connection
    std::shared_ptr<TlsConnection> connection_;
};

}  // namespace macula
