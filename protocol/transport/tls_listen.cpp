#include <algorithm>
#include <deque>

#include <openssl/ssl.h>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>

#include "protocol/transport/tls.h"
#include "protocol/transport/tls_channel.h"

namespace macula {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using std::chrono::milliseconds;

constexpr MessageLimits kServerLimits{kMaxClientMessage_bytes, kMaxServerMessage_bytes};

/// Accepts and shakes hands, on the I/O thread; take() and close() are for any other thread.
class Door : public std::enable_shared_from_this<Door> {
public:
    Door(asio::io_context& io, const ListenOptions& options)
        : io_(io), options_(options), tls_(asio::ssl::context::tls_server), acceptor_(io), retry_(io) {}

    Expected<void> use(const Identity& identity) {
        SSL_CTX_set_min_proto_version(tls_.native_handle(), TLS1_3_VERSION);
        SSL_CTX_set_num_tickets(tls_.native_handle(), 0);  // sessions are never resumed
        error_code error;
        tls_.use_certificate(asio::buffer(identity.pem), asio::ssl::context::pem, error);
        if (!error) tls_.use_private_key(asio::buffer(identity.pem), asio::ssl::context::pem, error);
        if (error) return fail(ErrorCode::input_file, "the server's identity is not usable: " + error.message());
        return {};
    }

    Expected<void> open() {
        if (!options_.address.empty()) {
            error_code error;
            const asio::ip::address address = asio::ip::make_address(options_.address, error);
            if (error) {
                return fail(ErrorCode::option,
                            "'" + options_.address + "' is not an IPv4 or IPv6 address to listen on");
            }
            return explained(listen_at({address, options_.port}));
        }
        const error_code both = listen_at({tcp::v6(), options_.port});
        const bool no_ipv6 =
            both == asio::error::address_family_not_supported || both == boost::system::errc::address_not_available;
        return explained(no_ipv6 ? listen_at({tcp::v4(), options_.port}) : both);
    }

    [[nodiscard]] std::uint16_t port() const { return port_; }

    void accept_next() {
        auto connection = std::make_shared<TlsConnection>(io_, tls_, kServerLimits);
        acceptor_.async_accept(connection->socket(), [self = shared_from_this(), connection](error_code error) {
            if (!self->acceptor_.is_open()) return;
            if (error) return self->retry_later();
            self->greet(connection);
            self->accept_next();
        });
    }

    Expected<std::shared_ptr<TlsConnection>> take(milliseconds timeout) {
        std::unique_lock lock(mutex_);
        if (!changed_.wait_for(lock, timeout, [this] { return !ready_.empty() || closed_; })) {
            return fail(ErrorCode::timeout, "nobody connected within " + std::to_string(timeout.count()) + " ms");
        }
        if (closed_) return fail(ErrorCode::network, "the listener is closed");
        std::shared_ptr<TlsConnection> connection = std::move(ready_.front());
        ready_.pop_front();
        return connection;
    }

    /// Returns when the port is free again.
    void close() {
        std::unique_lock lock(mutex_);
        closed_ = true;
        changed_.notify_all();
        asio::post(io_, [self = shared_from_this()] { self->shut(); });
        changed_.wait(lock, [this] { return shut_; });
    }

private:
    error_code listen_at(const tcp::endpoint& endpoint) {
        error_code error;
        acceptor_.open(endpoint.protocol(), error);
        // So that a restarted server finds its port free though old connections linger in TIME_WAIT.
        if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
        if (!error && endpoint.address() == asio::ip::address_v6::any()) {
            acceptor_.set_option(asio::ip::v6_only(false), error);
        }
        if (!error) acceptor_.bind(endpoint, error);
        if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
        if (!error) port_ = acceptor_.local_endpoint(error).port();
        if (error) {
            error_code ignored;
            acceptor_.close(ignored);
        }
        return error;
    }

    [[nodiscard]] Expected<void> explained(error_code error) const {
        const std::string port = "port " + std::to_string(options_.port);
        if (!error) return {};
        if (error == asio::error::address_in_use) {
            return fail(ErrorCode::network, port + " is in use: stop the other server or choose another port");
        }
        if (error == asio::error::access_denied) {
            return fail(ErrorCode::network, port + " needs more rights: choose one above 1023");
        }
        return fail(ErrorCode::network, "cannot listen on '" + options_.address + "' " + port + ": " + error.message());
    }

    /// Out of descriptors, most likely; they come back when sessions end.
    void retry_later() {
        retry_.expires_after(milliseconds(100));
        retry_.async_wait([self = shared_from_this()](error_code) {
            if (self->acceptor_.is_open()) self->accept_next();
        });
    }

    void greet(const std::shared_ptr<TlsConnection>& connection) {
        if (greeted_.size() >= options_.max_pending) {
            greeted_.front()->abort();
            greeted_.pop_front();
        }
        greeted_.push_back(connection);
        connection->handshake(asio::ssl::stream_base::server, options_.handshake_timeout,
                              [self = shared_from_this(), connection](error_code error) {
                                  std::erase(self->greeted_, connection);
                                  if (error) return connection->abort();
                                  self->deliver(connection);
                              });
    }

    void deliver(const std::shared_ptr<TlsConnection>& connection) {
        {
            const std::lock_guard lock(mutex_);
            if (closed_ || ready_.size() >= options_.max_pending) return connection->abort();
            ready_.push_back(connection);
        }
        connection->start();
        changed_.notify_all();
    }

    void shut() {
        error_code ignored;
        acceptor_.close(ignored);
        retry_.cancel();
        for (const auto& connection : greeted_) connection->abort();
        {
            const std::lock_guard lock(mutex_);
            for (const auto& connection : ready_) connection->abort();
            ready_.clear();
            shut_ = true;
        }
        changed_.notify_all();
    }

    asio::io_context& io_;
    const ListenOptions options_;
    asio::ssl::context tls_;
    tcp::acceptor acceptor_;
    asio::steady_timer retry_;
    std::uint16_t port_ = 0;
    std::deque<std::shared_ptr<TlsConnection>> greeted_;  ///< in the handshake, oldest first

    std::mutex mutex_;  ///< guards what follows
    std::condition_variable changed_;
    std::deque<std::shared_ptr<TlsConnection>> ready_;
    bool closed_ = false;
    bool shut_ = false;
};

class TlsListener final : public Listener {
public:
    TlsListener(std::shared_ptr<IoThread> io, std::shared_ptr<Door> door)
        : io_(std::move(io)), door_(std::move(door)) {}
    ~TlsListener() override { door_->close(); }

    Expected<std::unique_ptr<Channel>> accept(milliseconds timeout) override {
        Expected<std::shared_ptr<TlsConnection>> connection = door_->take(timeout);
        if (!connection) return tl::unexpected(connection.error());
        return std::make_unique<TlsChannel>(io_, std::move(*connection));
    }
    void close() noexcept override { door_->close(); }
    [[nodiscard]] std::uint16_t port() const override { return door_->port(); }

private:
    std::shared_ptr<IoThread> io_;
    std::shared_ptr<Door> door_;
};

}  // namespace

Expected<std::unique_ptr<Listener>> listen(const ListenOptions& options, const Identity& identity) {
    try {
        auto io = std::make_shared<IoThread>();
        auto door = std::make_shared<Door>(io->context(), options);
        if (const Expected<void> used = door->use(identity); !used) return tl::unexpected(used.error());
        if (const Expected<void> opened = door->open(); !opened) return tl::unexpected(opened.error());
        door->accept_next();
        io->start();
        return std::make_unique<TlsListener>(std::move(io), std::move(door));
    } catch (const std::exception& failure) {  // Asio and std::thread, when the system is out of something
        return fail(ErrorCode::network, std::string("cannot listen: ") + failure.what());
    }
}

}  // namespace macula
