#include "scenes/animation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace macula {
namespace {

glm::quat quat_of(const glm::vec4& xyzw) {
    return {xyzw.w, xyzw.x, xyzw.y, xyzw.z};
}

glm::vec4 xyzw_of(const glm::quat& q) {
    return {q.x, q.y, q.z, q.w};
}

/// Time since the last beginning, in [0, period].
float phase(double time_s, float period_s) {
    if (!(period_s > 0.0F)) return 0.0F;
    const double period = period_s;
    return static_cast<float>(time_s - period * std::floor(time_s / period));
}

/// Value at the time `t` after key `k`, of which there is a next (glTF 2.0, Appendix C).
glm::vec4 interpolate(const AnimationChannel& channel, std::size_t k, float t) {
    const float step = channel.time_s[k + 1] - channel.time_s[k];
    const float u = t / step;
    if (channel.interpolation == Interpolation::linear) {
        const glm::vec4& a = channel.value[k];
        const glm::vec4& b = channel.value[k + 1];
        // glm::slerp takes the shorter way and is linear where the two all but agree.
        if (channel.path == AnimationPath::rotation) return xyzw_of(glm::slerp(quat_of(a), quat_of(b), u));
        return glm::mix(a, b, u);
    }
    const float u2 = u * u;
    const float u3 = u2 * u;
    const glm::vec4& out_tangent = channel.value[3 * k + 2];
    const glm::vec4& in_tangent = channel.value[3 * k + 3];
    return (2.0F * u3 - 3.0F * u2 + 1.0F) * channel.value[3 * k + 1] + step * (u3 - 2.0F * u2 + u) * out_tangent +
           (3.0F * u2 - 2.0F * u3) * channel.value[3 * k + 4] + step * (u3 - u2) * in_tangent;
}

glm::vec4 key_value(const AnimationChannel& channel, std::size_t k) {
    return channel.interpolation == Interpolation::cubic_spline ? channel.value[3 * k + 1] : channel.value[k];
}

glm::vec4 sample(const AnimationChannel& channel, double time_s) {
    const float now = phase(time_s, channel.period_s);
    const auto after = std::upper_bound(channel.time_s.begin(), channel.time_s.end(), now);
    if (after == channel.time_s.begin()) return key_value(channel, 0);
    const auto k = static_cast<std::size_t>(after - channel.time_s.begin()) - 1;
    if (after == channel.time_s.end() || channel.interpolation == Interpolation::step) return key_value(channel, k);
    return interpolate(channel, k, now - channel.time_s[k]);
}

/// A spline of quaternions is not unit between its keys, and may lead through zero.
glm::quat unit_rotation(const glm::vec4& xyzw, const glm::quat& otherwise) {
    const float length = glm::length(xyzw);
    return length > 1e-6F ? quat_of(xyzw / length) : otherwise;
}

float away_from_zero(float scale) {
    return std::abs(scale) < kSmallestAnimatedScale ? std::copysign(kSmallestAnimatedScale, scale) : scale;
}

void apply(const AnimationChannel& channel, double time_s, AnimationNode& node) {
    const glm::vec4 value = sample(channel, time_s);
    switch (channel.path) {
        case AnimationPath::translation:
            node.translation_m = glm::vec3(value);
            break;
        case AnimationPath::rotation:
            node.rotation = unit_rotation(value, node.rotation);
            break;
        case AnimationPath::scale:
            node.scale = {away_from_zero(value.x), away_from_zero(value.y), away_from_zero(value.z)};
            break;
    }
}

}  // namespace

void pose_nodes(const Animation& animation, double time_s, std::vector<glm::mat4>& world_from_node) {
    std::vector<AnimationNode> posed = animation.nodes;
    for (const AnimationChannel& channel : animation.channels)
        apply(channel, time_s, posed[static_cast<std::size_t>(channel.node)]);
    world_from_node.resize(posed.size());
    for (std::size_t i = 0; i < posed.size(); ++i) {
        const AnimationNode& node = posed[i];
        glm::mat4 parent_from_node = glm::mat4_cast(node.rotation);
        for (int c = 0; c < 3; ++c) parent_from_node[c] *= node.scale[c];
        parent_from_node[3] = glm::vec4(node.translation_m, 1.0F);
        parent_from_node = node.parent_from_place * parent_from_node;
        world_from_node[i] = node.parent < 0
                                 ? parent_from_node
                                 : world_from_node[static_cast<std::size_t>(node.parent)] * parent_from_node;
    }
}

}  // namespace macula
