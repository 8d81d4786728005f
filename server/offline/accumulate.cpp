#include "server/offline/accumulate.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "server/kernels/color.h"

namespace macula {
namespace {

/// Digits of `index` in base 2, mirrored at the point.
double radical_inverse(std::uint32_t index) {
    double result = 0.0;
    for (double digit = 0.5; index != 0; index >>= 1U, digit *= 0.5) result += (index & 1U) != 0 ? digit : 0.0;
    return result;
}

int position_nearest_centre(int count) {
    int nearest = 0;
    for (int i = 1; i < count; ++i) {
        const auto off_centre = [count](int k) { return glm::length(sample_position(k, count) - 0.5F); };
        if (off_centre(i) < off_centre(nearest)) nearest = i;
    }
    return nearest;
}

void add(TraceCounts& sum, const TraceCounts& counts) {
    sum.primary += counts.primary;
    sum.shadow += counts.shadow;
    sum.reflection += counts.reflection;
    sum.transmission += counts.transmission;
    sum.skipped_shadow += counts.skipped_shadow;
    sum.skipped_bounce += counts.skipped_bounce;
}

/// What is kept of a shot from pass to pass.
struct Kept {
    std::vector<glm::dvec3> radiance;  ///< sum
    std::vector<float> inverse_depth_per_m;
    std::vector<std::uint32_t> object_id;
};

void put_mean(const Kept& kept, int spp, float exposure, Samples& samples) {
    samples.inverse_depth_per_m = kept.inverse_depth_per_m;
    samples.object_id = kept.object_id;
    for (std::size_t i = 0; i < kept.radiance.size(); ++i) {
        samples.radiance[i] = glm::vec3(kept.radiance[i] / static_cast<double>(spp));
        samples.color[i] = kernels::srgb8_from_linear(samples.radiance[i] * exposure);
    }
}

}  // namespace

glm::vec2 sample_position(int index, int count) {
    return {(index + 0.5) / count, radical_inverse(static_cast<std::uint32_t>(index)) + 0.5 / count};
}

TraceCounts accumulate(const Tracer& tracer, std::span<Shot> shots, int spp, double time_s, float exposure,
                       const PassProgress& progress) {
    TraceCounts counts;
    std::vector<Kept> kept(shots.size());
    const int middle = position_nearest_centre(spp);
    for (int pass = 0; pass < spp; ++pass) {
        std::vector<TraceTask> tasks;
        for (Shot& shot : shots) {
            shot.samples.keep_radiance = true;
            tasks.push_back({&shot.view, &shot.plan, &shot.samples, sample_position(pass, spp),
                             1.0F / std::sqrt(static_cast<float>(spp))});
        }
        add(counts, tracer.trace(tasks, time_s));
        if (progress) progress(pass + 1, spp);
        if (spp == 1) return counts;
        for (std::size_t s = 0; s < shots.size(); ++s) {
            const Samples& samples = shots[s].samples;
            kept[s].radiance.resize(samples.radiance.size(), glm::dvec3(0.0));
            for (std::size_t i = 0; i < samples.radiance.size(); ++i)
                kept[s].radiance[i] += glm::dvec3(samples.radiance[i]);
            if (pass != middle) continue;
            kept[s].inverse_depth_per_m = samples.inverse_depth_per_m;
            kept[s].object_id = samples.object_id;
        }
    }
    for (std::size_t s = 0; s < shots.size(); ++s) put_mean(kept[s], spp, exposure, shots[s].samples);
    return counts;
}

}  // namespace macula
