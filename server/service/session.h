#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "protocol/base/error.h"
#include "protocol/base/newest_slot.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "protocol/message/message.h"
#include "protocol/transport/channel.h"
#include "server/service/frame_maker.h"
#include "server/service/keyframe_wish.h"
#include "server/service/method_choices.h"
#include "server/service/pacing.h"
#include "server/service/statistics.h"

namespace spdlog {
class logger;
}

namespace macula {

/// Limits of a session. Tests shorten the times.
struct SessionOptions {
    std::chrono::milliseconds silence_limit{10'000};  ///< a peer that sends nothing for so long is gone
    std::chrono::milliseconds send_limit{5'000};      ///< a peer that does not read for so long is gone
    std::chrono::milliseconds log_interval{10'000};
    /// One frame in rendering, one in encoding, one on its way or in the client: with fewer a stage idles as soon
    /// as these take about equally long, with more, frames wait and grow old. With both programs on the same two
    /// cores, 2 and 3 gave the same frame rate, and 2 a fifth less latency at p99.
    int max_in_flight = 3;
};

/// Serves frames to one client after the handshake: one thread reads messages, one renders, one encodes and sends, and
/// one makes other methods when the client chooses them. Hand-offs of tracks and pictures are NewestSlots.
class Session {
public:
    /// What is the session's own.
    struct Parts {
        std::unique_ptr<FrameMaker> frame_maker;
        MethodChoices::Make make_method;  ///< for a client that chooses another method later
        std::unique_ptr<VideoEncoder> color_encoder;
        std::unique_ptr<DepthEncoder> depth_encoder;
        double refresh_hz = 90.0;
        std::uint64_t frame_pixels = 0;  ///< of both eyes
    };

    /// `name` begins the log lines. The channel outlives the session.
    Session(std::string name, Channel& channel, Parts parts, const SessionOptions& options,
            std::shared_ptr<spdlog::logger> logger);

    /// Serves until the client says Bye, stop() is called (both are success), or something goes wrong:
    /// `network` (the client is gone), `timeout` (it is silent, or does not read), `protocol` (a malformed or
    /// unexpected message), `graphics` or `internal` (rendering or encoding failed). The channel is closed then.
    Expected<void> run();

    /// Says Bye and ends the session. Any thread, any time.
    void stop(const std::string& reason);

private:
    struct ReceivedTrack {
        Track track;
        std::int64_t received_ns = 0;
    };

    void read_loop();
    void render_loop();
    void encode_loop();
    void choose_loop();
    Expected<void> handle(const Message& message);
    Expected<void> encode_and_send(Picture& picture);
    void fail_with(const Error& error);
    /// The first call decides how run() ends; `bye` goes to the client if it is not empty.
    void finish(Expected<void> outcome, const std::string& bye);

    const std::string name_;
    Channel& channel_;
    Parts parts_;
    const SessionOptions options_;
    const std::shared_ptr<spdlog::logger> logger_;

    NewestSlot<ReceivedTrack> tracks_;
    NewestSlot<Picture> pictures_;        ///< rendered, waits for the encoder
    NewestSlot<Picture> spare_pictures_;  ///< memory to render the next one into
    MethodChoices choices_;
    Pacer pacer_;
    KeyframeWish keyframe_wish_;
    SessionStatistics statistics_;

    std::mutex finish_mutex_;
    std::atomic<bool> finished_{false};
    Expected<void> outcome_;
};

}  // namespace macula
