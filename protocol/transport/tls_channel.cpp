#include "protocol/transport/tls_channel.h"

#include <algorithm>

#include <netinet/tcp.h>
#include <boost/asio/post.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

namespace macula {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// How long the peer of a closed channel may take to read what was sent last.
constexpr milliseconds kLinger{1000};

/// Unsent bytes that the kernel may hold. Its default grows to megabytes, in which frames would wait behind a
/// slow network where no newer frame can replace them. (Linux: Documentation/networking/ip-sysctl.rst.)
constexpr int kMaxUnsent_bytes = 128 << 10;

void tune(tcp::socket& socket) {
    boost::system::error_code ignored;  // without these it is slower, not wrong
    socket.set_option(tcp::no_delay(true), ignored);
    socket.set_option(asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>(kMaxUnsent_bytes), ignored);
}

}  // namespace

std::string name_of(const tcp::endpoint& endpoint) {
    asio::ip::address address = endpoint.address();
    if (address.is_v6() && address.to_v6().is_v4_mapped()) {
        address = asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
    }
    const std::string text = address.to_string();
    return (address.is_v6() ? "[" + text + "]" : text) + ":" + std::to_string(endpoint.port());
}

TlsConnection::TlsConnection(asio::io_context& io, asio::ssl::context& tls, MessageLimits limits)
    : io_(io), limits_(limits), stream_(io, tls), timer_(io) {}

void TlsConnection::handshake(asio::ssl::stream_base::handshake_type side, milliseconds timeout,
                              std::function<void(AsioError)> done) {
    tune(socket());
    AsioError unknown;
    const tcp::endpoint endpoint = socket().remote_endpoint(unknown);
    peer_ = unknown ? "unknown" : name_of(endpoint);
    close_after(timeout);
    stream_.async_handshake(side, [self = shared_from_this(), done = std::move(done)](AsioError error) {
        self->timer_.expires_at(steady_clock::time_point::max());
        done(error);
    });
}

void TlsConnection::start() {
    read_length();
}

void TlsConnection::abort() {
    break_off({ErrorCode::network, peer_ + ": the connection was given up"});
}

void TlsConnection::close_after(milliseconds delay) {
    timer_.expires_after(delay);
    timer_.async_wait([self = shared_from_this()](AsioError) {
        // The time may have been moved after this handler was queued.
        if (self->timer_.expiry() <= steady_clock::now()) self->abort();
    });
}

void TlsConnection::read_length() {
    reading_ = true;
    asio::async_read(stream_, asio::buffer(length_), [self = shared_from_this()](AsioError error, std::size_t got) {
        if (error) return self->break_off(self->describe(error, got > 0));
        self->read_body();
    });
}

void TlsConnection::read_body() {
    if (lingering_) return drain();
    const std::size_t size =
        length_[0] | std::size_t{length_[1]} << 8U | std::size_t{length_[2]} << 16U | std::size_t{length_[3]} << 24U;
    if (size > limits_.receive_bytes) {
        return break_off({ErrorCode::protocol, peer_ + " announced a message of " + std::to_string(size) +
                                                   " bytes; at most " + std::to_string(limits_.receive_bytes) +
                                                   " are accepted"});
    }
    incoming_.resize(size);
    asio::async_read(stream_, asio::buffer(incoming_), [self = shared_from_this()](AsioError error, std::size_t) {
        if (error) return self->break_off(self->describe(error, true));
        if (self->lingering_) return self->drain();
        self->reading_ = false;
        {
            const std::lock_guard lock(self->mutex_);
            if (!self->failure_) self->received_ = std::move(self->incoming_);
        }
        self->changed_.notify_all();
    });
}

Expected<Bytes> TlsConnection::receive(milliseconds timeout) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, timeout, [this] { return received_ || failure_; })) {
        return fail(ErrorCode::timeout, peer_ + " sent no message within " + std::to_string(timeout.count()) + " ms");
    }
    if (!received_) return tl::unexpected(*failure_);
    Bytes body = std::move(*received_);
    received_.reset();
    lock.unlock();
    asio::post(io_, [self = shared_from_this()] {
        if (!self->lingering_) self->read_length();
    });
    return body;
}

Expected<void> TlsConnection::send(std::span<const std::byte> body, milliseconds timeout) {
    if (body.size() > limits_.send_bytes) {
        return fail(ErrorCode::protocol, "a message of " + std::to_string(body.size()) + " bytes is larger than the " +
                                             std::to_string(limits_.send_bytes) + " that " + peer_ + " accepts");
    }
    const auto deadline = steady_clock::now() + timeout;
    std::unique_lock lock(mutex_);
    if (changed_.wait_until(lock, deadline, [this] { return !sending_ || failure_; }) && !failure_) {
        sending_ = true;
        written_ = false;
        // A copy, because a write that is given up may still be under way when this function has returned. One
        // buffer for length and body, because each buffer becomes a record of its own.
        outgoing_.clear();
        for (unsigned shift = 0; shift < 32; shift += 8) {
            outgoing_.push_back(static_cast<std::byte>(body.size() >> shift & 0xffU));
        }
        outgoing_.insert(outgoing_.end(), body.begin(), body.end());
        asio::post(io_, [self = shared_from_this()] { self->write(); });
        changed_.wait_until(lock, deadline, [this] { return written_ || failure_; });
        sending_ = false;
        changed_.notify_all();
        if (written_) return {};
    }
    if (!failure_) {
        failure_ = Error{ErrorCode::timeout,
                         peer_ + " did not read a message within " + std::to_string(timeout.count()) + " ms"};
        changed_.notify_all();
        asio::post(io_, [self = shared_from_this()] { self->abort(); });
    }
    return tl::unexpected(*failure_);
}

void TlsConnection::write() {
    if (lingering_) return;
    writing_ = true;
    asio::async_write(stream_, asio::buffer(outgoing_), [self = shared_from_this()](AsioError error, std::size_t) {
        self->writing_ = false;
        if (error) return self->break_off(self->describe(error, true));
        if (self->lingering_) self->end_sending();
        {
            const std::lock_guard lock(self->mutex_);
            self->written_ = true;
        }
        self->changed_.notify_all();
    });
}

void TlsConnection::close() {
    {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = Error{ErrorCode::network, "the channel to " + peer_ + " was closed on this side"};
        received_.reset();
    }
    changed_.notify_all();
    asio::post(io_, [self = shared_from_this()] { self->linger(); });
}

/// Ends our direction, after a message that is under way, and reads on until the peer ends his: a socket closed with
/// unread data in it resets the connection, and the peer would lose what was sent last, which is the reason for
/// closing.
void TlsConnection::linger() {
    if (lingering_ || !socket().is_open()) return;
    lingering_ = true;
    close_after(kLinger);
    if (!writing_) end_sending();
    if (!reading_) drain();
}

void TlsConnection::end_sending() {
    AsioError ignored;
    socket().shutdown(tcp::socket::shutdown_send, ignored);
}

/// Discards what arrives, encrypted as it is.
void TlsConnection::drain() {
    incoming_.resize(std::size_t{16} << 10);
    socket().async_read_some(asio::buffer(incoming_), [self = shared_from_this()](AsioError error, std::size_t) {
        if (error) return self->abort();
        self->drain();
    });
}

void TlsConnection::break_off(Error error) {
    {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::move(error);
    }
    changed_.notify_all();
    timer_.expires_at(steady_clock::time_point::max());
    AsioError ignored;
    socket().close(ignored);
}

Error TlsConnection::describe(AsioError error, bool inside_message) const {
    const bool ended = error == asio::error::eof || error == asio::ssl::error::stream_truncated ||
                       error == asio::error::connection_reset || error == asio::error::broken_pipe;
    if (!ended) return {ErrorCode::network, "the connection to " + peer_ + " broke: " + error.message()};
    return {ErrorCode::network,
            peer_ + (inside_message ? " closed the connection in the middle of a message" : " closed the connection")};
}

}  // namespace macula
