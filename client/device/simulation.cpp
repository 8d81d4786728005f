#include "client/device/simulation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>

namespace macula {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr glm::vec3 kForward{0.0F, 0.0F, -1.0F};

/// Random numbers that are the same with every standard library, whose distributions are not.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// In [0, 1).
    float uniform() { return static_cast<float>(engine_() >> 40) * 0x1p-24F; }
    float uniform(float low, float high) { return low + (high - low) * uniform(); }
    float exponential(float mean) { return -mean * std::log(1.0F - uniform()); }
    /// Box and Muller 1958.
    float normal() { return std::sqrt(-2.0F * std::log(1.0F - uniform())) * std::cos(2.0F * kPi * uniform()); }

private:
    std::mt19937_64 engine_;
};

/// Direction of yaw (to the left) and pitch (upwards).
glm::vec3 direction_of(float yaw_rad, float pitch_rad) {
    return {-std::sin(yaw_rad) * std::cos(pitch_rad), std::sin(pitch_rad), -std::cos(yaw_rad) * std::cos(pitch_rad)};
}
float yaw_of(const glm::vec3& d) {
    return std::atan2(-d.x, -d.z);
}
float pitch_of(const glm::vec3& d) {
    return std::asin(std::clamp(d.y, -1.0F, 1.0F));
}
float angle_between(const glm::vec3& a, const glm::vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}
/// Moves from `a` towards `b` along the great circle by an angle.
glm::vec3 turned_towards(const glm::vec3& a, const glm::vec3& b, float angle_rad) {
    const glm::vec3 across = b - a * glm::dot(a, b);
    const float length = glm::length(across);
    if (length < 1e-6F) return a;
    return glm::normalize(a * std::cos(angle_rad) + across / length * std::sin(angle_rad));
}
/// Into [-pi, pi).
float wrapped(float angle_rad) {
    return angle_rad - 2.0F * kPi * std::floor((angle_rad + kPi) / (2.0F * kPi));
}
/// Position of a minimum-jerk movement at time t in [0, 1].
float minimum_jerk(float t) {
    return t * t * t * (10.0F + t * (6.0F * t - 15.0F));
}

/// Where the gaze is meant to be in the world, as a chain of movements.
class GazeTarget {
public:
    GazeTarget(const SimulationModel& model, Random& random) : model_(model), random_(random) { fixate(); }

    glm::vec3 advance(float step_s) {
        time_s_ += step_s;
        while (time_s_ >= duration_s_) {
            time_s_ -= duration_s_;
            from_ = to_;
            next_movement();
        }
        const float t = time_s_ / duration_s_;
        const float share = kind_ == Kind::saccade ? minimum_jerk(t) : t;
        return turned_towards(from_, to_, share * angle_between(from_, to_));
    }

private:
    enum class Kind { fixation, saccade, pursuit };

    void next_movement() {
        if (kind_ != Kind::fixation) return fixate();
        const float choice = random_.uniform();
        if (choice < 0.15F) return pursue();
        if (choice < 0.30F) return turn();
        saccade_by(std::clamp(random_.exponential(model_.saccade_mean_rad), 0.01F, 0.5F));
    }
    void fixate() {
        kind_ = Kind::fixation;
        to_ = from_;
        duration_s_ = 0.12F + random_.exponential(0.2F);
    }
    void saccade_by(float amplitude_rad) {
        move_to(aside(amplitude_rad));
        kind_ = Kind::saccade;
        duration_s_ = model_.saccade_duration_s(angle_between(from_, to_));
    }
    /// A saccade too large for the eyes alone, to the side: the head has to turn.
    void turn() {
        const float side = random_.uniform() < 0.5F ? -1.0F : 1.0F;
        move_to(direction_of(yaw_of(from_) + side * random_.uniform(0.6F, 1.4F), random_.uniform(-0.2F, 0.2F)));
        kind_ = Kind::saccade;
        duration_s_ = model_.saccade_duration_s(angle_between(from_, to_));
    }
    void pursue() {
        const float duration_s = random_.uniform(0.5F, 1.5F);
        move_to(aside(duration_s * random_.uniform(0.08F, 0.35F)));  // 5 to 20 degrees a second
        kind_ = Kind::pursuit;
        duration_s_ = duration_s;
    }
    void move_to(const glm::vec3& to) { to_ = to; }
    /// A direction at this angle from the present one, rather sideways than up or down, not far from the horizon.
    glm::vec3 aside(float amplitude_rad) {
        const float around_rad = random_.uniform(0.0F, 2.0F * kPi);
        const float yaw_rad = yaw_of(from_) + amplitude_rad * std::cos(around_rad) / std::cos(pitch_of(from_));
        const float pitch_rad = pitch_of(from_) + 0.6F * amplitude_rad * std::sin(around_rad);
        return direction_of(yaw_rad, std::clamp(pitch_rad, -0.5F, 0.5F));
    }

    const SimulationModel& model_;
    Random& random_;
    Kind kind_ = Kind::fixation;
    glm::vec3 from_ = kForward;
    glm::vec3 to_ = kForward;
    float time_s_ = 0.0F;
    float duration_s_ = 1.0F;
};

/// The head turns to bring the gaze near its axis, as a critically damped system, and sways a little.
class Head {
public:
    explicit Head(const SimulationModel& model) : model_(model) {}

    Pose advance(const glm::vec3& target, float step_s) {
        time_s_ += step_s;
        constexpr float kComfortable_rad = 0.17F;
        const float off_rad = wrapped(yaw_of(target) - yaw_.angle_rad);
        const float wanted_rad = yaw_.angle_rad + off_rad - std::clamp(off_rad, -kComfortable_rad, kComfortable_rad);
        follow(yaw_, wanted_rad, step_s);
        follow(pitch_, 0.6F * pitch_of(target), step_s);
        const float roll_rad = 0.02F * std::sin(0.9F * time_s_);
        const glm::quat orientation = glm::angleAxis(yaw_.angle_rad, glm::vec3(0.0F, 1.0F, 0.0F)) *
                                      glm::angleAxis(pitch_.angle_rad, glm::vec3(1.0F, 0.0F, 0.0F)) *
                                      glm::angleAxis(roll_rad, glm::vec3(0.0F, 0.0F, 1.0F));
        const glm::vec3 sway_m(0.015F * std::sin(1.3F * time_s_), 0.005F * std::sin(2.1F * time_s_),
                               0.012F * std::sin(0.7F * time_s_));
        return {orientation, sway_m};
    }

private:
    struct Axis {
        float angle_rad = 0.0F;
        float rate_rad_s = 0.0F;
    };
    void follow(Axis& axis, float wanted_rad, float step_s) const {
        const float w = model_.head_rate_rad_s;
        const float acceleration = w * w * (wanted_rad - axis.angle_rad) - 2.0F * w * axis.rate_rad_s;
        axis.rate_rad_s += acceleration * step_s;
        axis.angle_rad += axis.rate_rad_s * step_s;
    }

    const SimulationModel& model_;
    Axis yaw_;
    Axis pitch_;
    float time_s_ = 0.0F;
};

class Simulation final : public TrackSource {
public:
    Simulation(std::uint64_t seed, const SimulationModel& model)
        : seed_(seed), model_(model), random_(seed), target_(model_, random_), head_(model_) {}

    void begin(std::int64_t now_ns) override { next_ns_ = now_ns; }
    [[nodiscard]] std::optional<std::int64_t> due_ns() const override { return next_ns_; }

    std::optional<DeviceSample> next(std::int64_t now_ns) override {
        if (next_ns_ > now_ns) return std::nullopt;
        constexpr float kStep_s = static_cast<float>(SimulationModel::kInterval_ns) * 1e-9F;
        const glm::vec3 target = target_.advance(kStep_s);
        sample_.time_ns = next_ns_;
        sample_.discontinuity = first_;
        sample_.start_from_head = head_.advance(target, kStep_s);
        look(glm::conjugate(sample_.start_from_head.orientation) * target, blinking(kStep_s));
        next_ns_ += SimulationModel::kInterval_ns;
        first_ = false;
        return sample_;
    }

    [[nodiscard]] std::string name() const override { return "simulation with seed " + std::to_string(seed_); }

private:
    bool blinking(float step_s) {
        until_blink_s_ -= step_s;
        if (until_blink_s_ > 0.0F) return false;
        if (until_blink_s_ < -0.12F) until_blink_s_ = random_.uniform(2.0F, 6.0F);
        return true;
    }

    /// Points both eyes at what lies in this direction of head space.
    void look(const glm::vec3& wanted, bool blink) {
        const float off_rad = angle_between(kForward, wanted);
        const glm::vec3 direction = turned_towards(kForward, wanted, std::min(off_rad, model_.eye_limit_rad));
        const glm::vec3 point_m = direction * model_.vergence_distance_m;
        for (int eye = 0; eye < kEyeCount; ++eye) {
            GazeSample& gaze = sample_.gaze[static_cast<std::size_t>(eye)];
            gaze.confidence = blink ? 0.0F : 1.0F;
            if (blink) continue;
            const float side_m = (eye == kLeftEye ? -0.5F : 0.5F) * model_.eye_distance_m;
            const glm::vec3 noise(random_.normal(), random_.normal(), 0.0F);
            gaze.direction = glm::normalize(glm::normalize(point_m - glm::vec3(side_m, 0.0F, 0.0F)) +
                                            model_.tracker_noise_rad * noise);
        }
    }

    std::uint64_t seed_;
    SimulationModel model_;
    Random random_;
    GazeTarget target_;
    Head head_;
    DeviceSample sample_;
    std::int64_t next_ns_ = 0;
    float until_blink_s_ = 3.0F;
    bool first_ = true;
};

}  // namespace

std::unique_ptr<TrackSource> make_simulation(std::uint64_t seed, const SimulationModel& model) {
    return std::make_unique<Simulation>(seed, model);
}

}  // namespace macula
