#include "server/service/server.h"

#include <utility>

namespace macula {

namespace {

/// How often the accept loop looks for sessions that ended.
constexpr std::chrono::milliseconds kTidy{200};

}  // namespace

Server::Server(std::unique_ptr<Listener> listener, Supplies supplies, ServerOptions options,
               std::shared_ptr<spdlog::logger> logger)
    : listener_(std::move(listener)) {
    shared_.supplies = std::move(supplies);
    shared_.options = std::move(options);
    shared_.logger = std::move(logger);
}

Server::~Server() {
    stop();
}

Expected<void> Server::run() {
    std::uint64_t number = 0;
    while (!stopping_) {
        auto channel = listener_->accept(kTidy);
        forget_ended();
        if (channel)
            serve(std::make_unique<Connection>(++number, *std::move(channel), shared_));
        else if (channel.error().code != ErrorCode::timeout && !stopping_)
            return tl::unexpected(channel.error());
    }
    return {};
}

void Server::stop() {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    listener_->close();
    for (Served& served : served_) served.connection->stop("the server stops");
    served_.clear();
}

void Server::serve(std::unique_ptr<Connection> connection) {
    const std::lock_guard lock(mutex_);
    if (stopping_) return;
    Connection& served = *connection;
    served_.push_back({std::move(connection), std::jthread([&served] { served.run(); })});
}

void Server::forget_ended() {
    const std::lock_guard lock(mutex_);
    std::erase_if(served_, [](const Served& served) { return served.connection->ended(); });
}

}  // namespace macula
