#include <openssl/ssl.h>
#include <boost/asio/connect.hpp>

#include "protocol/transport/tls.h"
#include "protocol/transport/tls_channel.h"

namespace macula {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr MessageLimits kClientLimits{kMaxServerMessage_bytes, kMaxClientMessage_bytes};

/// One attempt to reach a server. Runs the context on the calling thread, one step after the other.
class Attempt {
public:
    Attempt(asio::io_context& io, const std::string& host, std::uint16_t port, milliseconds timeout)
        : io_(io),
          tls_(asio::ssl::context::tls_client),
          host_(host),
          port_(std::to_string(port)),
          timeout_(timeout),
          deadline_(steady_clock::now() + timeout) {
        SSL_CTX_set_min_proto_version(tls_.native_handle(), TLS1_3_VERSION);
        // No authority vouches for a server: check_key compares its certificate with the pin instead.
        tls_.set_verify_mode(asio::ssl::verify_none);
        connection_ = std::make_shared<TlsConnection>(io_, tls_, kClientLimits);
    }

    Expected<std::shared_ptr<TlsConnection>> run(const std::string& fingerprint) {
        return find_host()
            .and_then([this] { return reach(); })
            .and_then([this] { return shake_hands(); })
            .and_then([&] { return check_key(fingerprint); })
            .map([this] {
                connection_->start();
                return connection_;
            });
    }

private:
    [[nodiscard]] std::string server() const { return host_ + " port " + port_; }

    /// Runs the context until `step` has a result or the time is over.
    Expected<void> finish(const std::optional<error_code>& step, const char* task) {
        while (!step && steady_clock::now() < deadline_) io_.run_one_until(deadline_);
        // The handshake has a deadline of its own, which is the same and may be noticed first.
        if (step && *step != asio::error::operation_aborted) return {};
        connection_->abort();
        return fail(ErrorCode::timeout, server() + " did not " + task + " within " + std::to_string(timeout_.count()) +
                                            " ms: check the address, the network and that the server runs");
    }

    Expected<void> find_host() {
        tcp::resolver resolver(io_);
        const auto result = std::make_shared<std::optional<error_code>>();
        resolver.async_resolve(host_, port_, [this, result](error_code error, tcp::resolver::results_type found) {
            *result = error;
            addresses_ = std::move(found);
        });
        Expected<void> finished = finish(*result, "resolve");
        if (finished && **result) {
            return fail(ErrorCode::network, "no address is known for host '" + host_ + "': " + (*result)->message());
        }
        return finished;
    }

    Expected<void> reach() {
        const auto result = std::make_shared<std::optional<error_code>>();
        asio::async_connect(connection_->socket(), addresses_,
                            [result](error_code error, const tcp::endpoint&) { *result = error; });
        Expected<void> finished = finish(*result, "answer");
        if (finished && **result) {
            return fail(ErrorCode::network, "cannot connect to " + server() + ": " + (*result)->message() +
                                                ": check the address and that the server runs");
        }
        return finished;
    }

    Expected<void> shake_hands() {
        const auto result = std::make_shared<std::optional<error_code>>();
        const auto left = std::chrono::duration_cast<milliseconds>(deadline_ - steady_clock::now());
        connection_->handshake(asio::ssl::stream_base::client, left, [result](error_code error) { *result = error; });
        Expected<void> finished = finish(*result, "finish the TLS handshake");
        if (finished && **result) {
            return fail(ErrorCode::protocol,
                        server() + " does not speak TLS 1.3: " + (*result)->message() + ": is it a Macula server?");
        }
        return finished;
    }

    /// The handshake has proved that the server holds the key of the certificate that it showed.
    Expected<void> check_key(const std::string& fingerprint) {
        const std::unique_ptr<X509, decltype(&X509_free)> certificate(
            SSL_get1_peer_certificate(connection_->stream().native_handle()), &X509_free);
        const std::string shown = certificate ? fingerprint_of(*certificate) : "none";
        if (shown == fingerprint) return {};
        connection_->abort();
        return fail(ErrorCode::refused, server() + " shows another key than expected.\n  expected " + fingerprint +
                                            "\n  shown    " + shown +
                                            "\nIf the server's state folder was made anew, take over the fingerprint "
                                            "that it prints at its start; otherwise this is not your server.");
    }

    asio::io_context& io_;
    asio::ssl::context tls_;
    const std::string host_;
    const std::string port_;
    const milliseconds timeout_;
    const steady_clock::time_point deadline_;
    std::shared_ptr<TlsConnection> connection_;
    tcp::resolver::results_type addresses_;
};

}  // namespace

Expected<std::unique_ptr<Channel>> connect(const std::string& host, std::uint16_t port, const std::string& fingerprint,
                                           milliseconds timeout) {
    const Expected<std::string> pin = parse_fingerprint(fingerprint);
    if (!pin) return tl::unexpected(pin.error());
    try {
        auto io = std::make_shared<IoThread>();
        Expected<std::shared_ptr<TlsConnection>> connection = Attempt(io->context(), host, port, timeout).run(*pin);
        if (!connection) return tl::unexpected(connection.error());
        io->start();
        return std::make_unique<TlsChannel>(std::move(io), std::move(*connection));
    } catch (const std::exception& failure) {  // Asio and std::thread, when the system is out of something
        return fail(ErrorCode::network, "cannot connect to " + host + ": " + failure.what());
    }
}

}  // namespace macula
