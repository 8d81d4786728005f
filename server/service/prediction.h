#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "masks/display.h"
#include "protocol/base/geometry.h"
#include "protocol/message/message.h"

namespace macula {

/// How far ahead of its measurement a head pose is extrapolated; a display time beyond it is not believed.
inline constexpr std::int64_t kMaxPrediction_ns = 100'000'000;

/// Head pose at the Track's display time, at constant velocities: with w the angular velocity in start space,
/// orientation = exp(w dt / 2) * measured orientation and position = measured position + v dt, where
/// dt = display time - pose time, within [0, kMaxPrediction_ns].
Pose predict_head(const Track& track);

/// What each eye's image shows when the head stands at `world_from_head`.
PerEye<EyeView> eye_views(const Display& display, const Pose& world_from_head);

/// Where one eye looks, as the tracker says it, without smoothing: the newest sample with confidence. While the
/// tracker has lost the eye, the last good direction is held, since the eye is most likely still near it (a
/// blink); after kMaxHold_ns the eye is taken to look straight ahead, where the head points.
class GazeHold {
public:
    static constexpr float kLostBelow = 0.5F;  ///< confidence under which a direction is not believed
    static constexpr std::int64_t kMaxHold_ns = 500'000'000;

    /// Takes the newest sample and its time (any one clock); returns a unit vector in head space.
    glm::vec3 update(const GazeSample& sample, std::int64_t time_ns);

private:
    glm::vec3 last_good_ = glm::vec3(0.0F, 0.0F, -1.0F);
    std::int64_t last_good_ns_ = 0;
};

}  // namespace macula
