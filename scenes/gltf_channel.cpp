#include "scenes/gltf_channel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "scenes/gltf_accessor.h"

namespace macula {
namespace {

constexpr float kMaxTime = 1e9F;  // s

std::optional<Interpolation> interpolation_of(const std::string& name) {
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
    return std::nullopt;
}

std::size_t values_per_key(Interpolation interpolation) {
    return interpolation == Interpolation::cubic_spline ? 3 : 1;
}

/// Value of a key; with cubic_spline its tangents lie around it.
const glm::vec4& key_value(const AnimationChannel& channel, std::size_t key) {
    return channel.value[channel.interpolation == Interpolation::cubic_spline ? 3 * key + 1 : key];
}

Expected<std::vector<glm::vec4>> read_values(GltfContext& context, int accessor, AnimationPath path) {
    if (path == AnimationPath::rotation) return read_accessor<glm::vec4>(context, accessor);
    const Expected<std::vector<glm::vec3>> read = read_accessor<glm::vec3>(context, accessor);
    if (!read) return tl::unexpected(read.error());
    std::vector<glm::vec4> values;
    values.reserve(read->size());
    for (const glm::vec3& v : *read) values.emplace_back(v, 0.0F);
    return values;
}

/// Removes keys that do not come after the one before. Returns how many there were.
std::size_t drop_late_keys(AnimationChannel& channel) {
    const std::size_t width = values_per_key(channel.interpolation);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < channel.time_s.size(); ++k) {
        if (kept > 0 && !(channel.time_s[k] > channel.time_s[kept - 1])) continue;
        channel.time_s[kept] = channel.time_s[k];
        std::copy_n(channel.value.begin() + static_cast<std::ptrdiff_t>(k * width), width,
                    channel.value.begin() + static_cast<std::ptrdiff_t>(kept * width));
        ++kept;
    }
    const std::size_t dropped = channel.time_s.size() - kept;
    channel.time_s.resize(kept);
    channel.value.resize(kept * width);
    return dropped;
}

/// Makes the keys of a rotation unit, their tangents with them. Returns how many had no length.
std::size_t normalize_rotations(AnimationChannel& channel) {
    const std::size_t width = values_per_key(channel.interpolation);
    std::size_t zeros = 0;
    for (std::size_t k = 0; k < channel.time_s.size(); ++k) {
        const float length = glm::length(key_value(channel, k));
        const bool usable = length > 1e-6F && std::isfinite(length);
        if (!usable) ++zeros;
        for (std::size_t i = k * width; i < (k + 1) * width; ++i)
            channel.value[i] = usable ? channel.value[i] / length : glm::vec4(0.0F);
        if (!usable) channel.value[k * width + (width == 3 ? 1 : 0)] = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
    }
    return zeros;
}

}  // namespace

Expected<AnimationChannel> read_gltf_channel(GltfContext& context, const tinygltf::AnimationSampler& sampler,
                                             AnimationPath path, const std::string& element) {
    AnimationChannel channel;
    channel.path = path;
    const std::optional<Interpolation> interpolation = interpolation_of(sampler.interpolation);
    if (!interpolation)
        return context.error(element, "the interpolation \"" + sampler.interpolation + "\" is not glTF");
    channel.interpolation = *interpolation;
    const Expected<std::vector<glm::vec1>> times = read_accessor<glm::vec1>(context, sampler.input);
    if (!times) return tl::unexpected(times.error());
    Expected<std::vector<glm::vec4>> values = read_values(context, sampler.output, path);
    if (!values) return tl::unexpected(values.error());
    const std::size_t expected = times->size() * values_per_key(channel.interpolation);
    if (values->size() != expected)
        return context.error(element, "there are " + std::to_string(values->size()) + " values for " +
                                          std::to_string(times->size()) + " times, not " + std::to_string(expected));
    channel.time_s.reserve(times->size());
    for (const glm::vec1& time : *times) {
        if (!(std::abs(time.x) <= kMaxTime)) return context.error(element, "a time is beyond 1e9 s");
        channel.time_s.push_back(time.x);
    }
    channel.value = std::move(*values);
    if (const std::size_t late = drop_late_keys(channel); late > 0)
        context.warn(element, std::to_string(late) + " key(s) that do not come after the one before are left out");
    if (path == AnimationPath::rotation)
        if (const std::size_t zeros = normalize_rotations(channel); zeros > 0)
            context.warn(element, std::to_string(zeros) + " rotation(s) of length zero are taken as none");
    return channel;
}

double largest_value(const AnimationChannel& channel) {
    const auto length = [&channel](const glm::vec4& v) {
        if (channel.path != AnimationPath::scale) return glm::length(glm::dvec4(v));
        return static_cast<double>(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
    };
    double largest = 0.0;
    for (std::size_t k = 0; k < channel.time_s.size(); ++k) largest = std::max(largest, length(key_value(channel, k)));
    if (channel.interpolation != Interpolation::cubic_spline) return largest;
    // The weights of the two values are a mean; those of the tangents are at most 4/27 of the step.
    double around = 0.0;
    for (std::size_t k = 0; k + 1 < channel.time_s.size(); ++k) {
        const double step = static_cast<double>(channel.time_s[k + 1]) - static_cast<double>(channel.time_s[k]);
        around = std::max(around, step * (length(channel.value[3 * k + 2]) + length(channel.value[3 * k + 3])));
    }
    return largest + 4.0 / 27.0 * around;
}

bool is_constant(const AnimationChannel& channel) {
    const glm::vec4 first = key_value(channel, 0);
    const float tolerance =
        channel.path == AnimationPath::translation ? 0.0F : 1e-6F * std::max(1.0F, glm::length(first));
    for (std::size_t k = 0; k < channel.time_s.size(); ++k) {
        if (glm::length(key_value(channel, k) - first) > tolerance) return false;
        if (channel.interpolation == Interpolation::cubic_spline &&
            (channel.value[3 * k] != glm::vec4(0.0F) || channel.value[3 * k + 2] != glm::vec4(0.0F)))
            return false;
    }
    return true;
}

}  // namespace macula
