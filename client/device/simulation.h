#pragma once

#include <cstdint>
#include <memory>

#include "client/device/source.h"

namespace macula {

/// How the simulated person moves. Angles are radians.
///
/// Saccades last 21 ms + 2.2 ms per degree of amplitude (Carpenter 1988, Movements of the Eyes) and follow a
/// minimum-jerk profile (Flash and Hogan 1985), whose peak velocity is 1.875 amplitude / duration: the main
/// sequence of Bahill, Clark and Stark 1975, 430 deg/s at 10 degrees. Amplitudes are exponentially distributed,
/// mostly below 15 degrees (Bahill, Adler and Stark 1975). The eyes stay within 35 degrees of the head's axis; the
/// head follows as a critically damped system and the eyes counter-rotate, so that the gaze holds its target in
/// the world (vestibulo-ocular reflex).
struct SimulationModel {
    static constexpr std::int64_t kInterval_ns = 4'000'000;  ///< 250 Hz

    float saccade_base_s = 0.021F;
    float saccade_s_per_rad = 0.0022F * 57.29578F;
    float saccade_mean_rad = 0.12F;
    float eye_limit_rad = 0.61F;
    float tracker_noise_rad = 0.0009F;  ///< standard deviation per axis; .07 degrees from sample to sample
    float head_rate_rad_s = 6.0F;       ///< natural frequency of the head's motion
    float eye_distance_m = 0.063F;
    float vergence_distance_m = 2.0F;

    /// Duration of a saccade of this amplitude.
    [[nodiscard]] float saccade_duration_s(float amplitude_rad) const {
        return saccade_base_s + saccade_s_per_rad * amplitude_rad;
    }
};

/// A person who fixates, makes saccades, pursues, turns the head and blinks; never ends. The same seed gives the
/// same samples on every machine with the same mathematics library.
std::unique_ptr<TrackSource> make_simulation(std::uint64_t seed, const SimulationModel& model = {});

}  // namespace macula
