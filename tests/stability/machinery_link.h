#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <variant>

#include "protocol/base/clock.h"
#include "protocol/message/message.h"
#include "protocol/transport/channel.h"

namespace macula::test {

/// What happens to a frame on its way to the client.
struct Fate {
    std::chrono::milliseconds late{0};
    int copies = 1;           ///< 0: it is lost
    bool after_next = false;  ///< it changes places with the next frame
};

/// What a Link does, by the number of the frame or report on this connection, from 0. Set before the first message;
/// called from any thread, one at a time. What is empty does nothing.
struct LinkFaults {
    std::function<Fate(int frame)> frame;
    std::function<bool(int report)> loses_report;
    /// Nothing is read from the server until then, this machine's time.
    std::function<std::int64_t()> reads_from_ns;
};

/// What a Link saw.
struct LinkRecord {
    std::mutex mutex;
    int frames = 0;     ///< that the server sent
    int keyframes = 0;  ///< of these
    int reports = 0;
    std::uint64_t newest_reported = 0;
    /// Most frames that were sent and neither reported nor followed by a reported one.
    std::uint64_t most_in_flight = 0;
};

/// A client's channel with faults between it and the server. Keeps the order of messages but where it is told not to: a
/// late one holds up those after it, as TCP does.
class Link final : public Channel {
public:
    Link(std::unique_ptr<Channel> channel, LinkFaults faults, std::shared_ptr<LinkRecord> record)
        : channel_(std::move(channel)), faults_(std::move(faults)), record_(std::move(record)) {}

    Expected<Bytes> receive(std::chrono::milliseconds timeout) override {
        const std::int64_t end_ns = now_ns() + timeout.count() * 1'000'000;
        while (true) {
            const std::int64_t now = now_ns();
            if (!arrived_.empty() && arrived_.front().due_ns <= now) {
                Bytes body = std::move(arrived_.front().body);
                arrived_.pop_front();
                return body;
            }
            if (now >= end_ns) return fail(ErrorCode::timeout, "nothing is due");
            const std::int64_t until_ns = arrived_.empty() ? end_ns : std::min(end_ns, arrived_.front().due_ns);
            const std::chrono::milliseconds wait((until_ns - now) / 1'000'000 + 1);
            if (faults_.reads_from_ns && now < faults_.reads_from_ns()) {
                std::this_thread::sleep_for(std::min(wait, std::chrono::milliseconds(5)));
                continue;
            }
            auto body = channel_->receive(wait);
            if (body)
                accept(*std::move(body));
            else if (body.error().code != ErrorCode::timeout)
                return body;
        }
    }

    Expected<void> send(std::span<const std::byte> body, std::chrono::milliseconds timeout) override {
        if (const auto message = decode_message(body); message && std::holds_alternative<FrameReport>(*message)) {
            const std::lock_guard lock(record_->mutex);
            const int number = record_->reports++;
            if (faults_.loses_report && faults_.loses_report(number)) return {};
            record_->newest_reported = std::max(record_->newest_reported, std::get<FrameReport>(*message).frame_id);
        }
        return channel_->send(body, timeout);
    }

    void close() noexcept override { channel_->close(); }
    [[nodiscard]] std::string peer() const override { return channel_->peer(); }

private:
    struct Arrived {
        Bytes body;
        std::int64_t due_ns = 0;
    };

    void accept(Bytes body) {
        Fate fate;
        bool is_frame = false;
        if (const auto message = decode_message(body); message && std::holds_alternative<Frame>(*message)) {
            const Frame& frame = std::get<Frame>(*message);
            const std::lock_guard lock(record_->mutex);
            const int number = record_->frames++;
            if (frame.keyframe) ++record_->keyframes;
            record_->most_in_flight = std::max(record_->most_in_flight, frame.id - record_->newest_reported);
            if (faults_.frame) fate = faults_.frame(number);
            is_frame = true;
        }
        if (fate.after_next) {
            held_ = std::move(body);
            return;
        }
        newest_due_ns_ = std::max(newest_due_ns_, now_ns() + fate.late.count() * 1'000'000);
        for (int i = 0; i < fate.copies; ++i) arrived_.push_back({body, newest_due_ns_});
        if (is_frame && !held_.empty()) arrived_.push_back({std::exchange(held_, {}), newest_due_ns_});
    }

    std::unique_ptr<Channel> channel_;
    LinkFaults faults_;
    std::shared_ptr<LinkRecord> record_;
    std::deque<Arrived> arrived_;  // receive() only, like the rest
    std::int64_t newest_due_ns_ = 0;
    Bytes held_;
};

}  // namespace macula::test
