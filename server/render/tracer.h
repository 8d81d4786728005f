#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "masks/sample_plan.h"
#include "protocol/base/error.h"
#include "protocol/base/geometry.h"
#include "protocol/base/image.h"

namespace macula {

struct Scene;

/// What a tracer found, by the plan's addresses.
struct Samples {
    std::vector<Rgba8> color;                ///< sRGB-coded, exposed and clamped
    std::vector<float> inverse_depth_per_m;  ///< of the first surface; 0: nothing hit; -1: the address was not traced
    std::vector<std::uint32_t> object_id;    ///< of the first surface; 0: nothing hit; else instance index + 1
    std::vector<glm::vec3> radiance;         ///< linear, unclamped; filled only where `keep_radiance` is set
    /// Filled only where `keep_image_depth` is set: inverse depth of what is seen at the sample. It differs from
    /// inverse_depth_per_m where most of the light comes from a mirror or through glass: then it is that of the image,
    /// which lies as far behind the mirror as the object is before it. What reprojection needs.
    std::vector<float> image_inverse_depth_per_m;
    bool keep_radiance = false;
    bool keep_image_depth = false;
};

/// One eye's work. The plan and the samples outlive the call.
struct TraceTask {
    const EyeView* view = nullptr;
    const SamplePlan* plan = nullptr;
    Samples* samples = nullptr;
    /// Where in its pixel a sample lies; one that the plan gives a place of its own lies by sample_px - .5 beside it.
    glm::vec2 sample_px = glm::vec2(0.5F);
    float footprint_scale = 1.0F;  ///< of a sample, in distances of the plan's samples; for several per pixel
};

/// Rays that were traced, by what they were for.
struct TraceCounts {
    std::uint64_t primary = 0;
    std::uint64_t shadow = 0;
    std::uint64_t reflection = 0;
    std::uint64_t transmission = 0;    ///< through glass, and past surfaces that cover a part
    std::uint64_t skipped_shadow = 0;  ///< shadow rays that could not have changed anything
    std::uint64_t skipped_bounce = 0;  ///< reflections and refractions that fell below the bounce bound
};

/// How a tracer is made.
struct TracerOptions {
    int bounces = 1;  ///< reflections in a row, 0 or more; light through glass and past coverage is not counted
    /// A reflection or refraction that brings less than this share of its light to the eye comes from the environment.
    /// 0: all are traced; at 1 / 2 / 4 / 8 bounces that takes 1.01 / 1.09 / 1.36 / 2.3 times as long on Bunny Box.
    float bounce_bound = 0.02F;
    int light_samples = 4;  ///< shadow rays to a light with an extent: 1, 4, 16 or 64
    /// Normals that a footprint averages away widen the lobe. False: they are lost; for measuring what they are worth.
    bool normal_roughness = true;
    /// Code for these features is run whether the scene has them or not; for measuring what that costs.
    std::uint32_t forced_features = 0;
};

/// Sees every packet of rays before it is traced; for benchmarks that trace the same rays again.
class RayTap {
public:
    RayTap() = default;
    RayTap(const RayTap&) = delete;
    RayTap& operator=(const RayTap&) = delete;
    virtual ~RayTap() = default;
    enum class Kind : std::uint8_t { primary, shadow, reflection, transmission };
    /// 16 rays: those whose `valid` is -1 take part. `direction` may have any length; the ray ends at `far` lengths.
    /// Called from several threads at once.
    virtual void packet(Kind kind, const int* valid, const float* origin_x16y16z16, const float* direction_x16y16z16,
                        const float* far16) = 0;
};

/// Traces and shades samples of a scene. Called once per frame with all eyes, never per ray. A tracer and its
/// scene are shared by all sessions: trace() may be called from several threads at once.
class Tracer {
public:
    Tracer() = default;
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;
    virtual ~Tracer() = default;
    /// Fills every address of each task's samples, all tasks in one parallel region. The scene's animation stands at
    /// `time_s`.
    virtual TraceCounts trace(std::span<const TraceTask> tasks, double time_s = 0.0) const noexcept = 0;
    /// For logs: "Embree 3.13.5, packets of 16".
    [[nodiscard]] virtual std::string name() const = 0;
    /// Bytes of the tracer's own data: tree, normals, texture levels. Not those of the scene.
    [[nodiscard]] virtual std::size_t memory_bytes() const = 0;
};

/// CPU tracer. Keeps a reference to the scene. `tap` (may be null) outlives it.
/// Errors: `internal` with Embree's message (out of memory, unsupported CPU).
Expected<std::unique_ptr<Tracer>> make_embree_tracer(std::shared_ptr<const Scene> scene,
                                                     const TracerOptions& options = {}, RayTap* tap = nullptr);

}  // namespace macula
