#include "server/render/secondary_rays.h"

#include <algorithm>
#include <cmath>

#include "server/kernels/fresnel.h"
#include "server/kernels/shade.h"

namespace macula {
namespace {

using glm::vec3;

float largest(const vec3& v) {
    return std::max({v.x, v.y, v.z});
}

/// A share of coverage or light below which nothing is sent on: it changes no code of the display.
constexpr float kNothing = 1.0F / 1024.0F;

/// Cosine between normals above which coat and base reflect the same.
constexpr float kSameNormal = 0.9999F;

/// One lane of a packet, from which rays are sent.
class Branch {
public:
    Branch(const ShadingContext& context, const HitPacket& hits, const SurfacePacket& surfaces, const RayPath& path,
           int lane, RayStack& stack, TraceCounts& counts)
        : context_(context),
          hits_(hits),
          surfaces_(surfaces),
          path_(path),
          lane_(lane),
          instance_(context.scene.instances()[hits.instance[lane]]),
          stack_(stack),
          counts_(counts) {
        const vec3 direction = hits.direction[lane];
        const float length = glm::length(direction);
        direction_ = direction * (1.0F / length);
        segment_m_ = hits.distance[lane] * length;
        point_ = hits.origin[lane] + direction * hits.distance[lane];
        normal_ = surfaces.geometric_normal[lane];
        coverage_ = surfaces.coverage[lane];
    }

    /// Sends all rays; `radiance` as in send_rays.
    void send(vec3& radiance) {
        rest_ = vec3(0.0F);
        if ((instance_.needs & kNeedBlending) != 0) send_past();
        if (coverage_ > kNothing && ((surfaces_.lit >> lane_) & 1U) != 0) {
            layered_ = ((surfaces_.layered >> lane_) & 1U) != 0;
            if (layered_) passes_ = surfaces_.more[lane_].layers.passes;
            const bool coat = layered_ && surfaces_.more[lane_].coat_reflected > 0.0F;
            const bool glass = surfaces_.transmission[lane_] > 0.0F;
            const bool base = !glass && surfaces_.reflected[lane_] > 0.0F;
            if (glass) send_through_glass();
            if (coat && base && glm::dot(surfaces_.more[lane_].coat_normal, surfaces_.normal[lane_]) > kSameNormal) {
                send_both_reflections();
            } else {
                if (base) send_reflection(base_weight(), surfaces_.normal[lane_], surfaces_.roughness[lane_]);
                if (coat)
                    send_reflection(coat_weight(), surfaces_.more[lane_].coat_normal,
                                    surfaces_.more[lane_].coat_roughness);
            }
        }
        radiance = radiance * coverage_ + rest_;
    }

private:
    /// Side of the surface on which a ray goes on.
    enum class Side { same, other };

    [[nodiscard]] vec3 origin(Side side) const {
        return kernels::leave_surface(point_, side == Side::same ? normal_ : -normal_,
                                      std::max(segment_m_, surfaces_.plane_extent_m[lane_]));
    }

    /// Sends a ray that brings `weight` of its radiance. What the bounds hold back comes from the environment.
    void send_bounded(const RayPath& child, const vec3& weight, Side side, const vec3& direction, bool allowed) {
        const float share = largest(path_.throughput * weight);
        const float traced = allowed ? traced_share(share, context_.bounce_bound) : 0.0F;
        if (allowed && traced <= 0.0F) ++counts_.skipped_bounce;
        if (traced < 1.0F) rest_ += weight * (1.0F - traced) * surrounding_light(context_, direction, child.spread);
        if (traced > 0.0F) push(child, weight * traced, side, direction);
    }

    void push(RayPath child, const vec3& weight, Side side, const vec3& direction) {
        child.throughput = path_.throughput * weight;
        child.path_m = path_.path_m + segment_m_;
        child.width_m = hits_.width_m[lane_];
        if (!stack_.push({origin(side), direction, child}))
            rest_ += weight * surrounding_light(context_, direction, child.spread);
    }

    void send_past() {
        if (1.0F - coverage_ <= kNothing) return;
        RayPath child = path_;
        child.reflection = false;
        if (child.layers > 0) --child.layers;
        send_bounded(child, vec3(1.0F - coverage_), Side::other, direction_, path_.layers > 0);
    }

    /// The mirrored direction, kept on the surface's side where a bent normal would send it inside.
    [[nodiscard]] vec3 mirrored(const vec3& normal) const {
        const vec3 direction = direction_ - normal * (2.0F * glm::dot(direction_, normal));
        const float above = glm::dot(direction, normal_);
        constexpr float kLeast = 0.01F;
        return kernels::safe_normalize(above < kLeast ? direction + normal_ * (kLeast - above) : direction);
    }

    /// How much a curved surface widens reflections: change of the normal per metre.
    [[nodiscard]] float curvature() const {
        const glm::uvec3 t = instance_.triangle[hits_.triangle[lane_]];
        const vec3 a = instance_.normal[t.x];
        const vec3 b = instance_.normal[t.y];
        const vec3 c = instance_.normal[t.z];
        const float turn_sq = std::max({glm::dot(a - b, a - b), glm::dot(b - c, b - c), glm::dot(c - a, c - a)});
        // The cross product of two edges has the length of twice the area.
        return std::sqrt(turn_sq / std::max(glm::length(hits_.geometric_normal[lane_]), 1e-20F));
    }

    /// A path after a reflection at a lobe of this surface.
    [[nodiscard]] RayPath reflected_path(float roughness) const {
        RayPath child = path_;
        child.reflection = true;
        child.spread += lobe_spread(roughness) + 2.0F * curvature() * hits_.width_m[lane_];
        return child;
    }

    [[nodiscard]] vec3 base_weight() const {
        return surfaces_.surface.specular_albedo[lane_] * (passes_ * coverage_ * surfaces_.reflected[lane_]);
    }
    [[nodiscard]] vec3 coat_weight() const {
        const RichSurface& more = surfaces_.more[lane_];
        return vec3((1.0F - more.layers.coat_passes) * coverage_ * more.coat_reflected);
    }

    /// The bound has been applied to its share already.
    void send_reflection(const vec3& weight, const vec3& normal, float roughness) {
        RayPath child = reflected_path(roughness);
        --child.bounces;
        push(child, weight, Side::same, mirrored(normal));
    }

    /// One ray for coat and base, with the mean of their widths.
    void send_both_reflections() {
        const vec3 base = base_weight();
        const vec3 coat = coat_weight();
        const float share = largest(coat) / std::max(largest(coat + base), 1e-20F);
        const float roughness = glm::mix(surfaces_.roughness[lane_], surfaces_.more[lane_].coat_roughness, share);
        send_reflection(base + coat, surfaces_.normal[lane_], roughness);
    }

    /// Reflection and transmission of an interface whose exact share of reflection is `reflectance`.
    void send_split(float reflectance, const vec3& through, bool inside, std::uint32_t volume_behind,
                    const vec3& normal) {
        const float pass = surfaces_.transmission[lane_] * (1.0F - surfaces_.metallic[lane_]);
        RayPath reflection = reflected_path(surfaces_.roughness[lane_]);
        const bool total = reflectance >= 1.0F;
        if (total && reflection.layers > 0) --reflection.layers;
        if (!total && reflection.bounces > 0) --reflection.bounces;
        const bool may_reflect = total ? path_.layers > 0 : path_.bounces > 0 && path_.layers > 0;
        // The part of the surface that is not glass keeps its own colour of reflection.
        const vec3 mirror =
            glm::mix(surfaces_.surface.specular_albedo[lane_], vec3(reflectance), (1.0F - surfaces_.metallic[lane_]));
        if (inside) {
            reflection.volume = hits_.instance[lane_] + 1;
        }
        send_bounded(reflection, mirror * (coverage_ * passes_), Side::same, mirrored(normal), may_reflect);
        if (total) return;
        RayPath child = path_;
        child.reflection = false;
        child.volume = volume_behind;
        child.spread += lobe_spread(surfaces_.roughness[lane_]) * 0.5F;
        if (child.layers > 0) --child.layers;
        const vec3 weight = surfaces_.base_color[lane_] * (pass * (1.0F - reflectance) * coverage_ * passes_);
        if (largest(weight) <= 0.0F) return;
        send_bounded(child, weight, Side::other, through, path_.layers > 0);
    }

    void send_through_glass() {
        const bool inside = glm::dot(hits_.geometric_normal[lane_], direction_) > 0.0F;
        if ((instance_.needs & kNeedRefraction) == 0) {
            const float cosine = std::abs(glm::dot(surfaces_.normal[lane_], direction_));
            const float once = kernels::fresnel_dielectric(cosine, instance_.material->ior);
            send_split(1.0F - kernels::pane_transmittance(once), direction_, false, path_.volume,
                       surfaces_.normal[lane_]);
            return;
        }
        const float ior = instance_.material->ior;
        // A bent normal that the ray sees from behind would refract to the wrong side.
        const vec3 shading = surfaces_.normal[lane_];
        const vec3 normal = glm::dot(shading, direction_) < 0.0F ? shading : normal_;
        kernels::Refraction refraction = kernels::refract_ray(direction_, normal, inside ? 1.0F / ior : ior);
        const float below = -glm::dot(refraction.direction, normal_);
        if (refraction.reflectance < 1.0F && below < 0.0F)
            refraction = kernels::refract_ray(direction_, normal_, inside ? 1.0F / ior : ior);
        const std::uint32_t behind = inside ? 0U : hits_.instance[lane_] + 1;
        send_split(refraction.reflectance, refraction.direction, inside, behind, normal);
    }

    const ShadingContext& context_;
    const HitPacket& hits_;
    const SurfacePacket& surfaces_;
    const RayPath& path_;
    int lane_;
    const ShadingInstance& instance_;
    RayStack& stack_;
    TraceCounts& counts_;
    vec3 direction_{};  ///< unit
    vec3 point_{};
    vec3 normal_{};  ///< geometric, on the viewer's side
    vec3 rest_{};
    float segment_m_ = 0.0F;
    float passes_ = 1.0F;  ///< share of light that layers on top let through
    bool layered_ = false;
    float coverage_ = 1.0F;
};

}  // namespace

void send_rays(const ShadingContext& context, const HitPacket& hits, const SurfacePacket& surfaces,
               std::span<const RayPath, kLaneCount> path, Lanes3& radiance, RayStack& stack,
               TraceCounts& counts) noexcept {
    for_each_lane(surfaces.branching, [&](int lane) {
        vec3 own = radiance[lane];
        Branch(context, hits, surfaces, path[static_cast<std::size_t>(lane)], lane, stack, counts).send(own);
        radiance.set(lane, own);
    });
}

}  // namespace macula
