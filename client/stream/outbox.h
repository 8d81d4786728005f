#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/message/message.h"

namespace macula {

/// What waits to be sent: the newest Track, and small messages that must all arrive. All members may be called
/// from any thread.
class Outbox {
public:
    /// Replaces a Track that was not sent yet.
    void put_track(const Track& track) {
        {
            const std::lock_guard lock(mutex_);
            if (track_) ++dropped_tracks_;
            track_ = track;
        }
        changed_.notify_one();
    }

    /// Reports, Pings and Pongs, in order. While nobody sends them, the oldest of kMost are lost.
    void put(Message message) {
        {
            const std::lock_guard lock(mutex_);
            if (others_.size() == kMost) others_.erase(others_.begin());
            others_.push_back(std::move(message));
        }
        changed_.notify_one();
    }

    /// Waits for anything to send; empty after `timeout` or an interruption.
    std::vector<Message> take(std::chrono::milliseconds timeout) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, timeout, [this] { return track_ || !others_.empty() || interrupted_; });
        interrupted_ = false;
        std::vector<Message> messages = std::exchange(others_, {});
        if (track_) messages.emplace_back(*std::exchange(track_, std::nullopt));
        return messages;
    }

    /// Forgets what waits: it was meant for a connection that is gone.
    void clear() {
        const std::lock_guard lock(mutex_);
        others_.clear();
        track_.reset();
        interrupted_ = false;
    }

    /// Ends a wait in take().
    void interrupt() {
        {
            const std::lock_guard lock(mutex_);
            interrupted_ = true;
        }
        changed_.notify_all();
    }

    [[nodiscard]] std::uint64_t dropped_tracks() const {
        const std::lock_guard lock(mutex_);
        return dropped_tracks_;
    }

private:
    static constexpr std::size_t kMost = 256;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Track> track_;
    std::vector<Message> others_;
    std::uint64_t dropped_tracks_ = 0;
    bool interrupted_ = false;
};

}  // namespace macula
