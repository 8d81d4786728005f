#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "protocol/base/error.h"
#include "protocol/message/message.h"

namespace macula {

/// One authenticated, encrypted, ordered stream of whole messages to one peer. Made so that a datagram media
/// plane can join behind it without touching its users. One thread may receive while another sends; close()
/// may be called from any thread.
class Channel {
public:
    Channel() = default;
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;
    virtual ~Channel() = default;

    /// Next message body. Errors: `timeout` (no whole message arrived; the channel stays usable, and what arrived
    /// of one is kept), `protocol` (oversized length; the channel is then closed), `network` (closed or broken).
    virtual Expected<Bytes> receive(std::chrono::milliseconds timeout) = 0;

    /// Sends one message body; returns when the system has taken it. Several threads may send: whole messages go
    /// out one after the other. Errors: `timeout` (the peer does not read; the channel is then closed),
    /// `protocol` (larger than the peer accepts; nothing is sent), `network`.
    virtual Expected<void> send(std::span<const std::byte> body, std::chrono::milliseconds timeout) = 0;

    /// Ends the channel; pending and later calls fail with `network`. What was sent before still reaches a peer
    /// that reads.
    virtual void close() noexcept = 0;

    /// "address:port" of the peer, for logs.
    [[nodiscard]] virtual std::string peer() const = 0;
};

/// Accepts channels on a port. A peer that is slow or malformed in the handshake holds up nobody else.
class Listener {
public:
    Listener() = default;
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    virtual ~Listener() = default;

    /// Next channel whose handshake is complete; `timeout` if there was none, `network` after close().
    virtual Expected<std::unique_ptr<Channel>> accept(std::chrono::milliseconds timeout) = 0;
    virtual void close() noexcept = 0;
    [[nodiscard]] virtual std::uint16_t port() const = 0;
};

}  // namespace macula
