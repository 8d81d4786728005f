#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace macula {

/// Hand-off between two threads in which the newest value wins: a value that nobody took in time is
/// replaced and counted. In VR a late frame is worthless and a queue only hides latency.
/// All members may be called from any thread.
template <class T>
class NewestSlot {
public:
    /// Puts a value, replacing one that was not taken. Returns the replaced value, if any.
    std::optional<T> put(T value) {
        std::optional<T> replaced;
        {
            const std::lock_guard lock(mutex_);
            if (closed_) return value;
            replaced = std::exchange(value_, std::move(value));
            if (replaced) ++dropped_;
        }
        changed_.notify_one();
        return replaced;
    }

    /// Takes the value if there is one.
    std::optional<T> try_take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(value_, std::nullopt);
    }

    /// Waits for a value; empty after `timeout` or when the slot is closed.
    std::optional<T> take(std::chrono::milliseconds timeout) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, timeout, [this] { return value_.has_value() || closed_; });
        return std::exchange(value_, std::nullopt);
    }

    /// Ends all waits; later puts are ignored. What was put before can still be taken.
    void close() {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
        }
        changed_.notify_all();
    }

    [[nodiscard]] bool closed() const {
        const std::lock_guard lock(mutex_);
        return closed_;
    }

    /// Values that were replaced before anybody took them.
    [[nodiscard]] std::uint64_t dropped() const {
        const std::lock_guard lock(mutex_);
        return dropped_;
    }

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<T> value_;
    std::uint64_t dropped_ = 0;
    bool closed_ = false;
};

}  // namespace macula
