#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace macula::testing {

/// Plain TCP to a port of this machine; says only what it is told to.
class RawSocket {
public:
    explicit RawSocket(std::uint16_t port) : descriptor_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        connected_ = ::connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    }
    ~RawSocket() { ::close(descriptor_); }
    RawSocket(const RawSocket&) = delete;
    RawSocket& operator=(const RawSocket&) = delete;

    [[nodiscard]] int get() const { return descriptor_; }
    [[nodiscard]] bool connected() const { return connected_; }
    [[nodiscard]] bool send(const std::string& text) const {
        return ::send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
    }
    /// Waits until the other side has closed; what it still says is thrown away.
    void wait_for_end() const {
        std::array<char, 4096> buffer{};
        while (::recv(descriptor_, buffer.data(), buffer.size(), 0) > 0) {
        }
    }

private:
    int descriptor_;
    bool connected_ = false;
};

/// A TLS client that frames nothing by itself.
class RawTls {
public:
    explicit RawTls(std::uint16_t port, int highest_version = TLS1_3_VERSION)
        : socket_(port), context_(SSL_CTX_new(TLS_client_method())) {
        SSL_CTX_set_max_proto_version(context_, highest_version);
        tls_ = SSL_new(context_);
        SSL_set_fd(tls_, socket_.get());
        connected_ = SSL_connect(tls_) == 1;
    }
    ~RawTls() {
        SSL_free(tls_);
        SSL_CTX_free(context_);
    }
    RawTls(const RawTls&) = delete;
    RawTls& operator=(const RawTls&) = delete;

    [[nodiscard]] bool connected() const { return connected_; }
    [[nodiscard]] const RawSocket& socket() const { return socket_; }
    [[nodiscard]] bool write(const std::vector<std::byte>& bytes) const {
        return SSL_write(tls_, bytes.data(), static_cast<int>(bytes.size())) == static_cast<int>(bytes.size());
    }

private:
    RawSocket socket_;
    SSL_CTX* context_;
    SSL* tls_ = nullptr;
    bool connected_ = false;
};

}  // namespace macula::testing
