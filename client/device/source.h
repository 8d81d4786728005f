#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/base/geometry.h"
#include "protocol/message/message.h"

namespace macula {

/// What the headset and the eye tracker knew at one time.
struct DeviceSample {
    std::int64_t time_ns = 0;    ///< when the head had this pose and the eyes looked there
    Pose start_from_head;        ///< head pose relative to where the session begins
    PerEye<GazeSample> gaze;     ///< in head space; while an eye is lost, confidence 0 and the last known direction
    bool discontinuity = false;  ///< the pose does not continue the one before (a recording that begins again)
};

/// A headset with an eye tracker, real or not. Time is an argument, so that pacing can be tested. One thread at a
/// time.
class TrackSource {
public:
    TrackSource() = default;
    TrackSource(const TrackSource&) = delete;
    TrackSource& operator=(const TrackSource&) = delete;
    virtual ~TrackSource() = default;

    /// Says that the source's own time 0 is `now_ns` of the host's clock. Called once, before the others.
    virtual void begin(std::int64_t now_ns) = 0;

    /// When the next sample is due, host clock; nothing when the source has ended.
    [[nodiscard]] virtual std::optional<std::int64_t> due_ns() const = 0;

    /// The next sample if it is due, each sample once and in order. Its time is the host's clock.
    virtual std::optional<DeviceSample> next(std::int64_t now_ns) = 0;

    /// For logs and reports.
    [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace macula
