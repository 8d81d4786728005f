#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "protocol/transport/channel.h"

namespace macula::testing {

/// One direction of a MemoryChannel: a bounded queue of message bodies.
class MemoryPipe {
public:
    explicit MemoryPipe(std::size_t capacity) : capacity_(capacity) {}

    Expected<void> put(std::span<const std::byte> body, std::chrono::milliseconds timeout) {
        std::unique_lock lock(mutex_);
        const bool done = changed_.wait_for(lock, timeout, [this] { return closed_ || bodies_.size() < capacity_; });
        if (closed_) return fail(ErrorCode::network, "closed");
        if (!done) return fail(ErrorCode::timeout, "the peer does not read");
        bodies_.emplace_back(body.begin(), body.end());
        changed_.notify_all();
        return {};
    }

    Expected<Bytes> take(std::chrono::milliseconds timeout) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, timeout, [this] { return closed_ || !bodies_.empty(); });
        if (!bodies_.empty()) {
            Bytes body = std::move(bodies_.front());
            bodies_.pop_front();
            changed_.notify_all();
            return body;
        }
        return closed_ ? Expected<Bytes>(fail(ErrorCode::network, "closed"))
                       : Expected<Bytes>(fail(ErrorCode::timeout, "nothing arrived"));
    }

    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }

private:
    std::size_t capacity_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Bytes> bodies_;
    bool closed_ = false;
};

/// Channel inside the process, for tests of what lies above channels.
class MemoryChannel : public Channel {
public:
    /// Two ends; each direction holds `capacity` messages before its sender has to wait.
    static std::pair<std::unique_ptr<Channel>, std::unique_ptr<Channel>> pair(std::size_t capacity) {
        auto there = std::make_shared<MemoryPipe>(capacity);
        auto back = std::make_shared<MemoryPipe>(capacity);
        return {std::make_unique<MemoryChannel>(there, back), std::make_unique<MemoryChannel>(back, there)};
    }

    MemoryChannel(std::shared_ptr<MemoryPipe> in, std::shared_ptr<MemoryPipe> out)
        : in_(std::move(in)), out_(std::move(out)) {}
    ~MemoryChannel() override { MemoryChannel::close(); }

    Expected<Bytes> receive(std::chrono::milliseconds timeout) override { return in_->take(timeout); }
    Expected<void> send(std::span<const std::byte> body, std::chrono::milliseconds timeout) override {
        return out_->put(body, timeout);
    }
    void close() noexcept override {
        in_->close();
        out_->close();
    }
    [[nodiscard]] std::string peer() const override { return "memory"; }

private:
    std::shared_ptr<MemoryPipe> in_;
    std::shared_ptr<MemoryPipe> out_;
};

}  // namespace macula::testing
