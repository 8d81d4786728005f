#include "tests/pipeline/scenario.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <utility>

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "client/device/recording.h"
#include "client/device/simulation.h"

namespace macula::test {

namespace {

constexpr double kStart_ns = 1e9;
/// Half-widths of what scenarios show, degrees.
constexpr float kOffAxis_deg = 5.0F;
constexpr float kPursuit_deg_s = 10.0F;
constexpr float kSaccade_deg = 15.0F;
constexpr float kFound_deg = 8.0F;
constexpr float kEdgeFrom_deg = 30.0F;
constexpr float kEdgeTo_deg = 70.0F;
constexpr float kPan_deg_s = 150.0F;
constexpr float kCut_deg = 60.0F;
constexpr float kCut_m = 0.3F;
constexpr float kSwaySpeed_m_s = 0.5F;
constexpr float kSwayRate_rad_s = 6.25F;
/// A tenth of a pixel of `vive`, whose pixels lie 1 / 571.04 apart at unit distance.
constexpr float kSlowPan_rad = 0.1F / 571.04F;
/// Standard deviation per axis for .08 degrees rms from sample to sample in both axes together.
constexpr float kNoise_deg = 0.04F;

/// What a scenario is made for.
struct Clip {
    int frames = 0;
    double rate_hz = 90.0;
    std::uint32_t seed = 1;
    [[nodiscard]] float seconds(int frame) const { return static_cast<float>(frame / rate_hz); }
    /// Seconds from the middle of the clip.
    [[nodiscard]] float from_middle(int frame) const { return seconds(frame) - 0.5F * seconds(frames - 1); }
    /// Directions of successive seeds are far from each other: the golden angle.
    [[nodiscard]] float direction_rad() const { return 2.39996F * static_cast<float>(seed); }
    [[nodiscard]] float sign() const { return seed % 2 == 1 ? 1.0F : -1.0F; }
};

/// Unit vector at an angle from the axis, in the clip's direction around it.
glm::vec3 towards(const Clip& clip, float angle_deg) {
    const float angle = glm::radians(angle_deg);
    return {std::sin(angle) * std::cos(clip.direction_rad()), std::sin(angle) * std::sin(clip.direction_rad()),
            -std::cos(angle)};
}

/// The same in the horizontal plane, to the right.
glm::vec3 aside(float angle_deg) {
    return {std::sin(glm::radians(angle_deg)), 0.0F, -std::cos(glm::radians(angle_deg))};
}

void look(Moment& moment, const glm::vec3& gaze_head) {
    moment.gaze_head = moment.true_gaze_head = gaze_head;
}

void turn(Moment& moment, float yaw_rad, float rate_rad_s) {
    moment.start_from_head.orientation = glm::angleAxis(yaw_rad, glm::vec3(0.0F, 1.0F, 0.0F));
    moment.angular_velocity_rad_s = {0.0F, rate_rad_s, 0.0F};
}

void still(const Clip& clip, Scenario& scenario) {
    for (Moment& moment : scenario.moments) look(moment, towards(clip, kOffAxis_deg));
}

void noise(const Clip& clip, Scenario& scenario) {
    still(clip, scenario);
    std::mt19937 random(clip.seed);
    const auto uniform = [&random] { return (static_cast<float>(random()) + 1.0F) / 4294967296.0F; };
    for (Moment& moment : scenario.moments) {
        // Box and Muller (1958), since the standard library's distribution differs between libraries.
        const float radius = glm::radians(kNoise_deg) * std::sqrt(-2.0F * std::log(std::min(uniform(), 1.0F)));
        const float angle = 2.0F * std::numbers::pi_v<float> * uniform();
        moment.gaze_head =
            glm::normalize(moment.true_gaze_head + radius * glm::vec3(std::cos(angle), std::sin(angle), 0.0F));
    }
}

void pursuit(const Clip& clip, Scenario& scenario) {
    for (int i = 0; i < clip.frames; ++i)
        look(scenario.moments[i], towards(clip, kPursuit_deg_s * clip.from_middle(i)));
}

void saccade(const Clip& clip, Scenario& scenario) {
    const float duration_s = SimulationModel().saccade_duration_s(glm::radians(kSaccade_deg));
    scenario.event = clip.frames / 2;
    for (int i = 0; i < clip.frames; ++i) {
        // Minimum jerk (SimulationModel), landing at the event.
        const float t = std::clamp(1.0F + (clip.seconds(i) - clip.seconds(scenario.event)) / duration_s, 0.0F, 1.0F);
        const float done = t * t * t * (10.0F - 15.0F * t + 6.0F * t * t);
        look(scenario.moments[i], towards(clip, kSaccade_deg * (done - 0.5F)));
    }
}

void lost(const Clip& clip, Scenario& scenario) {
    const int begin = clip.frames / 3;
    scenario.event = 2 * clip.frames / 3;
    for (int i = 0; i < clip.frames; ++i) {
        Moment& moment = scenario.moments[i];
        look(moment, towards(clip, i < begin ? 0.0F : kFound_deg));
        if (i < begin || i >= scenario.event) continue;
        moment.confidence = 0.0F;
        moment.gaze_head = towards(clip, 0.0F);
    }
}

void edge(const Clip& clip, Scenario& scenario) {
    for (int i = 0; i < clip.frames; ++i) {
        const float way = std::min(2.0F * static_cast<float>(i) / static_cast<float>(clip.frames), 1.0F);
        look(scenario.moments[i], aside(clip.sign() * (kEdgeFrom_deg + way * (kEdgeTo_deg - kEdgeFrom_deg))));
    }
}

void pan(const Clip& clip, Scenario& scenario) {
    still(clip, scenario);
    const float rate = clip.sign() * glm::radians(kPan_deg_s);
    for (int i = 0; i < clip.frames; ++i) turn(scenario.moments[i], rate * clip.from_middle(i), rate);
}

void slow_pan(const Clip& clip, Scenario& scenario) {
    still(clip, scenario);
    for (int i = 0; i < clip.frames; ++i)
        turn(scenario.moments[i], clip.sign() * kSlowPan_rad * static_cast<float>(i),
             clip.sign() * kSlowPan_rad * static_cast<float>(clip.rate_hz));
}

void sway(const Clip& clip, Scenario& scenario) {
    still(clip, scenario);
    for (int i = 0; i < clip.frames; ++i) {
        Moment& moment = scenario.moments[i];
        const float phase = kSwayRate_rad_s * clip.from_middle(i);
        moment.start_from_head.position_m.x = clip.sign() * kSwaySpeed_m_s / kSwayRate_rad_s * std::sin(phase);
        moment.linear_velocity_m_s.x = clip.sign() * kSwaySpeed_m_s * std::cos(phase);
    }
}

void cut(const Clip& clip, Scenario& scenario) {
    still(clip, scenario);
    scenario.event = clip.frames / 2;
    for (int i = scenario.event; i < clip.frames; ++i) {
        turn(scenario.moments[i], clip.sign() * glm::radians(kCut_deg), 0.0F);
        scenario.moments[i].start_from_head.position_m.x = clip.sign() * kCut_m;
    }
}

/// Axis times rate of the rotation from one pose to the next.
glm::vec3 angular_velocity(const glm::quat& from, const glm::quat& to, double rate_hz) {
    glm::quat change = to * glm::conjugate(from);
    if (change.w < 0.0F) change = -change;
    const glm::vec3 axis(change.x, change.y, change.z);
    return 2.0F * static_cast<float>(rate_hz) * axis;  // the sine of a small half angle
}

Expected<void> recorded(const Clip& clip, bool head, Scenario& scenario) {
    static const std::string path = MACULA_SOURCE_DIR "/../shared/gaze/salient360_rawDataDyn1.csv";
    const auto recording = load_recording(path);
    if (!recording) return tl::unexpected(recording.error());
    const std::int64_t end_ns = recording->samples.back().time_ns;
    // Parts of two seeds do not overlap unless clips are longer than these steps.
    const double begin_s = 1.0 + 1.7 * (clip.seed - 1);
    if (1e-9 * static_cast<double>(end_ns) < begin_s + clip.frames / clip.rate_hz)
        return fail(ErrorCode::option, "seed " + std::to_string(clip.seed) + " begins beyond the recording's end");
    auto next = recording->samples.begin();
    std::optional<Pose> head_from_start;
    for (int i = 0; i < clip.frames; ++i) {
        const auto time_ns = static_cast<std::int64_t>(1e9 * (begin_s + i / clip.rate_hz));
        while (next + 1 != recording->samples.end() && (next + 1)->time_ns <= time_ns) ++next;
        Moment& moment = scenario.moments[i];
        look(moment, next->gaze[kLeftEye].direction);
        moment.confidence = next->gaze[kLeftEye].confidence;
        if (!head) continue;
        // The clip begins where the session does, so that it shows what the scene has to show.
        if (!head_from_start) head_from_start = next->start_from_head.inverse();
        moment.start_from_head = *head_from_start * next->start_from_head;
        if (i == 0) continue;
        const Pose& before = scenario.moments[i - 1].start_from_head;
        moment.linear_velocity_m_s =
            (moment.start_from_head.position_m - before.position_m) * static_cast<float>(clip.rate_hz);
        moment.angular_velocity_rad_s =
            angular_velocity(before.orientation, moment.start_from_head.orientation, clip.rate_hz);
    }
    return {};
}

struct Maker {
    std::function<Expected<void>(const Clip&, Scenario&)> make;
    bool head_moves = false;
};

Maker simple(void (*make)(const Clip&, Scenario&), bool head_moves = false) {
    return {[make](const Clip& clip, Scenario& scenario) -> Expected<void> {
                make(clip, scenario);
                return {};
            },
            head_moves};
}

const std::vector<std::pair<std::string, Maker>>& makers() {
    static const std::vector<std::pair<std::string, Maker>> all = {
        {"still", simple(still)},
        {"noise", simple(noise)},
        {"pursuit", simple(pursuit)},
        {"saccade", simple(saccade)},
        {"lost", simple(lost)},
        {"edge", simple(edge)},
        {"pan", simple(pan, true)},
        {"slow-pan", simple(slow_pan, true)},
        {"sway", simple(sway, true)},
        {"cut", simple(cut, true)},
        {"recorded-gaze", {[](const Clip& clip, Scenario& s) { return recorded(clip, false, s); }, false}},
        {"recorded", {[](const Clip& clip, Scenario& s) { return recorded(clip, true, s); }, true}},
    };
    return all;
}

}  // namespace

const std::vector<std::string>& scenario_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        for (const auto& [name, maker] : makers()) result.push_back(name);
        return result;
    }();
    return names;
}

Expected<Scenario> make_scenario(const std::string& name, int frames, double rate_hz, std::uint32_t seed) {
    const auto maker = std::ranges::find(makers(), name, &std::pair<std::string, Maker>::first);
    if (maker == makers().end()) {
        std::string known;
        for (const std::string& each : scenario_names()) known.append(known.empty() ? "" : ", ").append(each);
        return fail(ErrorCode::option, "no scenario '" + name + "': there are " + known);
    }
    Scenario scenario;
    scenario.name = name;
    scenario.head_moves = maker->second.head_moves;
    scenario.moments.resize(static_cast<std::size_t>(std::max(frames, 1)));
    for (int i = 0; i < static_cast<int>(scenario.moments.size()); ++i)
        scenario.moments[i].time_ns = static_cast<std::int64_t>(kStart_ns + 1e9 * i / rate_hz);
    if (auto made = maker->second.make({std::max(frames, 1), rate_hz, seed}, scenario); !made)
        return tl::unexpected(made.error());
    return scenario;
}

}  // namespace macula::test
