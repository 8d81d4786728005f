#include "server/render/ray_filters.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "server/render/surface_fetch.h"

namespace macula {
namespace {

glm::vec3 direction_of(RTCRayN* ray, unsigned count, unsigned i) {
    return {RTCRayN_dir_x(ray, count, i), RTCRayN_dir_y(ray, count, i), RTCRayN_dir_z(ray, count, i)};
}

glm::vec3 normal_of(RTCHitN* hit, unsigned count, unsigned i) {
    return {RTCHitN_Ng_x(hit, count, i), RTCHitN_Ng_y(hit, count, i), RTCHitN_Ng_z(hit, count, i)};
}

TriangleHit place_of(RTCHitN* hit, unsigned count, unsigned i) {
    return {RTCHitN_primID(hit, count, i), RTCHitN_u(hit, count, i), RTCHitN_v(hit, count, i)};
}

const ShadingInstance& instance_of(const RTCFilterFunctionNArguments* args) {
    return *static_cast<const ShadingInstance*>(args->geometryUserPtr);
}

void cull_back_faces(const RTCFilterFunctionNArguments* args) {
    for (unsigned i = 0; i < args->N; ++i) {
        const float facing = glm::dot(direction_of(args->ray, args->N, i), normal_of(args->hit, args->N, i));
        args->valid[i] = facing > 0.0F ? 0 : args->valid[i];
    }
}

/// Rejects hits in holes of alpha-masked surfaces.
void cut_holes(const RTCFilterFunctionNArguments* args) {
    const ShadingInstance& instance = instance_of(args);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const glm::vec4 color = base_color_at(instance, place_of(args->hit, args->N, i));
        if (color.w < instance.material->alpha_cutoff) args->valid[i] = 0;
    }
}

void cull_and_cut(const RTCFilterFunctionNArguments* args) {
    cull_back_faces(args);
    cut_holes(args);
}

void begin_color(LightQuery& query, int lane) {
    query.colored |= 1U << lane;
    query.transmittance.set(lane, glm::vec3(1.0F));
    query.optical_depth.set(lane, glm::vec3(0.0F));
    query.open_absorption.set(lane, glm::vec3(0.0F));
    query.crossings[lane] = 0;
    for (LightQuery::Crossing& crossing : query.last[lane]) crossing = {};
}

/// Whether a lane has met this surface here before, in a neighbouring triangle; notes that it has.
bool met_before(LightQuery& query, int lane, const ShadingInstance& instance, float t, bool leaves) {
    const float signed_t = leaves ? -t : t;
    for (const LightQuery::Crossing& crossing : query.last[lane]) {
        if (crossing.instance == &instance && std::abs(crossing.t - signed_t) <= 1e-6F * t) return true;
    }
    query.last[lane][query.crossings[lane]++ % LightQuery::kRemembered] = {&instance, signed_t};
    return false;
}

/// Lets light pass, and notes what the surface takes of it.
void pass_light(const RTCFilterFunctionNArguments* args) {
    const ShadingInstance& instance = instance_of(args);
    auto& query = *reinterpret_cast<LightQuery*>(args->context);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const glm::vec3 direction = direction_of(args->ray, args->N, i);
        const glm::vec3 normal = normal_of(args->hit, args->N, i);
        const float lengths = glm::length(direction) * glm::length(normal);
        const float facing = glm::dot(direction, normal) / std::max(lengths, 1e-30F);
        const glm::vec3 share = light_past(instance, place_of(args->hit, args->N, i), std::abs(facing));
        if (std::max({share.x, share.y, share.z}) <= 0.0F) continue;  // the hit stands, and ends the query
        const auto lane = static_cast<int>(RTCRayN_id(args->ray, args->N, i));
        if ((query.colored >> lane & 1U) == 0) begin_color(query, lane);
        const float t = RTCRayN_tfar(args->ray, args->N, i);
        args->valid[i] = 0;
        if (met_before(query, lane, instance, t, facing > 0.0F)) continue;
        query.transmittance.set(lane, query.transmittance[lane] * share);
        if ((instance.needs & kNeedAbsorption) != 0) {
            const glm::vec3 leaves = instance.absorption_per_m * (facing > 0.0F ? 1.0F : -1.0F);
            const float path_m = t * query.length_m[lane];
            query.optical_depth.set(lane, query.optical_depth[lane] + leaves * path_m);
            query.open_absorption.set(lane, query.open_absorption[lane] - leaves);
        }
    }
}

}  // namespace

RTCFilterFunctionN sight_filter(const ShadingInstance& instance) {
    const bool both_sides = instance.material->double_sided || (instance.needs & kNeedRefraction) != 0;
    if ((instance.needs & kNeedAlphaMasks) != 0) return both_sides ? cut_holes : cull_and_cut;
    return both_sides ? nullptr : cull_back_faces;
}

RTCFilterFunctionN light_filter(const ShadingInstance& instance) {
    if ((instance.needs & (kNeedBlending | kNeedTransmission | kNeedRefraction)) != 0) return pass_light;
    return (instance.needs & kNeedAlphaMasks) != 0 ? cut_holes : nullptr;
}

glm::vec3 light_through(const LightQuery& query, int lane, float far) {
    if ((query.colored >> lane & 1U) == 0) return glm::vec3(1.0F);
    // A light inside a volume is entered for, and never left.
    const glm::vec3 open = glm::max(query.open_absorption[lane], glm::vec3(0.0F));
    glm::vec3 depth = query.optical_depth[lane];
    if (std::isfinite(far)) depth += open * (far * query.length_m[lane]);
    return query.transmittance[lane] * glm::exp(-glm::max(depth, glm::vec3(0.0F)));
}

}  // namespace macula
