#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

#include <glm/vec2.hpp>

namespace macula {

/// Shift of the rank tile for the frame of this index: the R2 low-discrepancy sequence (M. Roberts 2018) on the
/// 64x64 torus in a cycle of 64, so that temporal accumulation soon meets a traced sample at every pixel.
glm::ivec2 phase_of_frame(std::uint64_t index);

/// Decides when a session may begin its next frame. A frame is *in flight* from the moment it is begun until
/// the client reports it. With few in flight a slow client or network gets fewer frames, never stale ones; and as
/// none is begun while another waits for the encoder, none is rendered in vain. No clock inside: time is an
/// argument.
class PacingState {
public:
    /// `refresh_hz` bounds the frame rate.
    PacingState(double refresh_hz, int max_in_flight);

    /// Earliest time at which the refresh rate lets the next frame begin.
    [[nodiscard]] std::int64_t next_begin_ns() const { return next_begin_ns_; }
    /// Whether another frame may be begun: few are in flight, and none waits for the encoder.
    [[nodiscard]] bool has_room() const { return in_flight() < max_in_flight_ && waiting_ == 0; }
    [[nodiscard]] int in_flight() const;

    void begin(std::int64_t now_ns);                ///< rendering of a frame starts
    void rendered() { ++waiting_; }                 ///< it waits for the encoder
    void taken() { --waiting_; }                    ///< the encoder has it
    std::uint64_t encoded() { return ++encoded_; }  ///< gives it the next frame id: from 1, without gaps
    /// The client has shown or given up this frame and, since frames arrive in order, all before it. An id that
    /// was never given counts as the newest that was.
    void reported(std::uint64_t frame_id);
    /// Counts all frames in flight as lost, if none of them is still in the server.
    void give_up_reports();

private:
    std::int64_t period_ns_;
    int max_in_flight_;
    std::int64_t next_begin_ns_ = 0;
    std::uint64_t begun_ = 0;
    std::uint64_t encoded_ = 0;
    std::uint64_t reported_ = 0;
    int waiting_ = 0;
};

/// PacingState shared by the threads of a session.
class Pacer {
public:
    /// When nothing has happened for so long, neither a report nor a stage, frames in flight or their reports are lost:
    /// a session without room goes on.
    static constexpr std::chrono::milliseconds kReportLimit{2'000};

    Pacer(double refresh_hz, int max_in_flight) : state_(refresh_hz, max_in_flight) {}

    /// Waits until a frame may begin; false when the pacer was closed.
    bool wait_for_room();
    /// Ends all waits, now and later.
    void close();

    /// Applies a change, for example `[](PacingState& state) { state.rendered(); }`, and wakes who waits.
    template <class Change>
    auto update(Change change) {
        const std::lock_guard lock(mutex_);
        changed_.notify_all();
        return change(state_);
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    PacingState state_;
    bool closed_ = false;
};

}  // namespace macula
