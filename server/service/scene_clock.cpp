#include "server/service/scene_clock.h"

#include <algorithm>

namespace macula {

double SceneClock::display_time_s(const Track& track, std::int64_t received_ns) {
    // Times of messages lie within +-2^60 ns, so none of these sums overflows.
    const std::int64_t offset_ns = received_ns - track.pose_time_ns;
    // Tracks come in order, so a pose from before the last one's tells that the client's clock was set back: what is
    // known of it no longer holds.
    const bool set_back = track.pose_time_ns < pose_before_ns_;
    pose_before_ns_ = track.pose_time_ns;
    if (!started_ || set_back) {
        started_ = true;
        window_begin_ns_ = received_ns;
        offset_ns_ = offset_before_ns_ = offset_ns;
    } else if (received_ns - window_begin_ns_ >= kWindow_ns) {
        // After a silence of two windows and more, what the last one knew is old, too.
        offset_before_ns_ = received_ns - window_begin_ns_ < 2 * kWindow_ns ? offset_ns_ : offset_ns;
        offset_ns_ = offset_ns;
        window_begin_ns_ = received_ns;
    }
    offset_ns_ = std::min(offset_ns_, offset_ns);
    const std::int64_t display_ns = std::clamp(track.display_time_ns + std::min(offset_ns_, offset_before_ns_),
                                               received_ns - kMaxAhead_ns, received_ns + kMaxAhead_ns);
    return 1e-9 * static_cast<double>(display_ns - start_ns_);
}

}  // namespace macula
