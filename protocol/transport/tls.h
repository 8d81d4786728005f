#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "protocol/base/error.h"
#include "protocol/transport/channel.h"
#include "protocol/transport/identity.h"

namespace macula {

inline constexpr std::uint16_t kDefaultPort = 7470;

/// Where a server listens.
struct ListenOptions {
    std::string address = {};           ///< IPv4 or IPv6 literal; empty: every address of both families
    std::uint16_t port = kDefaultPort;  ///< 0: the system chooses one (Listener::port)
    /// Connections in the handshake, and connections that finished it and wait for accept(). One more pushes
    /// out the oldest handshake, or is itself closed.
    std::size_t max_pending = 64;
    std::chrono::milliseconds handshake_timeout{5000};
};

/// Channels over TLS 1.3 on TCP. All channels of a listener share one I/O thread, which lives as long as any
/// of them. Received messages are at most kMaxClientMessage_bytes, sent ones kMaxServerMessage_bytes.
/// Errors: `network` (port in use, address not of this machine, no permission), `option` (not an address),
/// `input_file` (identity not usable).
Expected<std::unique_ptr<Listener>> listen(const ListenOptions& options, const Identity& identity);

/// Connects to a server, whose certificate must have `fingerprint` (any form that parse_fingerprint takes).
/// Tries every address of `host` within `timeout` altogether; looking up a name may take longer than that.
/// Errors: `option` (malformed fingerprint), `network` (no such host, nobody listens), `timeout`, `protocol`
/// (something else than TLS 1.3 answers), `refused` (another key; the message names both fingerprints).
Expected<std::unique_ptr<Channel>> connect(const std::string& host, std::uint16_t port, const std::string& fingerprint,
                                           std::chrono::milliseconds timeout);

}  // namespace macula
