#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>

#include "protocol/message/message.h"

namespace macula {

/// Durations in bins whose edges grow by 2^(1/16) from 1 us, so that a percentile is exact within 4.5 % in
/// fixed memory.
class DurationHistogram {
public:
    void add(std::int64_t duration_ns);
    /// Middle of the bin that holds this share (0..1) of the durations, in milliseconds; 0 if there are none.
    [[nodiscard]] double percentile_ms(double share) const;

private:
    static constexpr int kBinsPerOctave = 16;
    static constexpr int kOctaves = 24;  // up to 17 s
    std::array<std::uint32_t, std::size_t{kBinsPerOctave} * kOctaves> bins_{};
    std::uint32_t total_ = 0;
};

/// What one session did, for its log lines: over the interval since the last line, and over all its life. All
/// members may be called from any thread.
class SessionStatistics {
public:
    /// `frame_pixels`: pixels of both eyes.
    SessionStatistics(std::int64_t now_ns, std::uint64_t frame_pixels);

    /// A frame whose sending ended at `sent_ns`.
    void add_frame(const StageTimes& times, std::uint32_t traced, std::size_t size_bytes, std::int64_t sent_ns);
    void add_report(const FrameReport& report);

    /// One line about the interval that ends now; the next interval begins.
    std::string interval_line(std::int64_t now_ns);
    /// One line about the whole session.
    [[nodiscard]] std::string summary_line(std::int64_t now_ns) const;

private:
    struct Tally {
        explicit Tally(std::int64_t start_ns) : begin_ns(start_ns) {}
        [[nodiscard]] std::string line(std::int64_t end_ns, std::uint64_t frame_pixels) const;

        std::int64_t begin_ns;
        std::uint64_t frames = 0;
        std::uint64_t traced = 0;
        std::uint64_t size_bytes = 0;
        std::uint64_t not_shown = 0;
        std::uint64_t not_decoded = 0;
        std::array<DurationHistogram, 6> stages;
    };

    mutable std::mutex mutex_;
    std::uint64_t frame_pixels_;
    Tally interval_;
    Tally total_;
};

}  // namespace macula
