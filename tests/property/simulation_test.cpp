#include "client/device/simulation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace macula {
namespace {

constexpr float kDegree_rad = 0.01745329F;
constexpr float kStep_s = 0.004F;

std::vector<DeviceSample> simulate(std::uint64_t seed, std::size_t count, const SimulationModel& model = {}) {
    const auto source = make_simulation(seed, model);
    source->begin(0);
    std::vector<DeviceSample> samples;
    while (samples.size() < count) samples.push_back(*source->next(*source->due_ns()));
    return samples;
}

float angle_between(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Without noise, and with the eyes' axes parallel: what is left is the movement itself.
SimulationModel clean() {
    SimulationModel model;
    model.tracker_noise_rad = 0.0F;
    model.eye_distance_m = 0.0F;
    return model;
}

glm::vec3 gaze_in_world(const DeviceSample& sample) {
    return sample.start_from_head.direction(sample.gaze[kLeftEye].direction);
}

bool blinking(const DeviceSample& sample) {
    return sample.gaze[kLeftEye].confidence == 0.0F;
}

TEST(Simulation, IsDeterministicBySeed) {
    const auto a = simulate(7, 3000);
    const auto b = simulate(7, 3000);
    const auto c = simulate(8, 3000);
    bool differs = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].gaze[kLeftEye].direction, b[i].gaze[kLeftEye].direction);
        ASSERT_EQ(a[i].start_from_head.orientation, b[i].start_from_head.orientation);
        differs = differs || a[i].gaze[kLeftEye].direction != c[i].gaze[kLeftEye].direction;
    }
    EXPECT_TRUE(differs);
}

TEST(Simulation, SamplesAreValidAndInTime) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(seed);
        std::int64_t expected_ns = 0;
        for (const DeviceSample& sample : simulate(seed, 5000)) {
            ASSERT_EQ(sample.time_ns, expected_ns);
            expected_ns += SimulationModel::kInterval_ns;
            ASSERT_NEAR(glm::length(sample.start_from_head.orientation), 1.0F, 1e-4F);
            for (const GazeSample& gaze : sample.gaze) {
                ASSERT_NEAR(glm::length(gaze.direction), 1.0F, 1e-4F);
                ASSERT_LT(angle_between(gaze.direction, glm::vec3(0, 0, -1)), 37.0F * kDegree_rad);
            }
        }
    }
}

TEST(Simulation, SaccadesFollowTheMainSequence) {
    const SimulationModel model = clean();
    int saccades = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto samples = simulate(seed, 10000, model);
        for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
            // A saccade is a run of world gaze faster than any pursuit; its ends are slow for the profile's sake.
            std::size_t end = i;
            float peak_rad_s = 0.0F;
            bool usable = true;
            while (end < samples.size()) {
                const float step_rad = angle_between(gaze_in_world(samples[end - 1]), gaze_in_world(samples[end]));
                if (step_rad / kStep_s < 25.0F * kDegree_rad) break;
                peak_rad_s = std::max(peak_rad_s, step_rad / kStep_s);
                const float off_rad = angle_between(samples[end].gaze[kLeftEye].direction, glm::vec3(0, 0, -1));
                usable = usable && !blinking(samples[end - 1]) && !blinking(samples[end]) &&
                         off_rad < model.eye_limit_rad - 0.01F;
                ++end;
            }
            if (end - i >= 6 && usable) {
                const float amplitude_rad =
                    angle_between(gaze_in_world(samples[i - 1]), gaze_in_world(samples[end - 1]));
                const float expected_rad_s = 1.875F * amplitude_rad / model.saccade_duration_s(amplitude_rad);
                EXPECT_NEAR(peak_rad_s, expected_rad_s, 0.08F * expected_rad_s) << amplitude_rad / kDegree_rad;
                ++saccades;
            }
            i = end;
        }
    }
    EXPECT_GT(saccades, 100);
}

TEST(Simulation, EyesCounterRotateWhileTheHeadTurns) {
    const auto samples = simulate(3, 10000, clean());
    float slip_rad = 0.0F;
    int turning = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (blinking(samples[i]) || blinking(samples[i - 1])) continue;
        const float world_rad = angle_between(gaze_in_world(samples[i - 1]), gaze_in_world(samples[i]));
        const glm::vec3 before = samples[i - 1].start_from_head.direction(glm::vec3(0, 0, -1));
        const glm::vec3 after = samples[i].start_from_head.direction(glm::vec3(0, 0, -1));
        const float head_rad = angle_between(before, after);
        const float off_rad = angle_between(samples[i].gaze[kLeftEye].direction, glm::vec3(0, 0, -1));
        // Head faster than 30 degrees a second, gaze still: a fixation during a head turn.
        if (head_rad < 30.0F * kDegree_rad * kStep_s || off_rad > 0.60F) continue;
        if (world_rad > 3.0F * kDegree_rad * kStep_s) continue;
        ++turning;
        slip_rad = std::max(slip_rad, world_rad);
    }
    EXPECT_GT(turning, 200) << "no fixation during a head turn: the eyes do not counter-rotate";
    EXPECT_LT(slip_rad, 0.05F * kDegree_rad);
}

}  // namespace
}  // namespace macula
