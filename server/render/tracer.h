#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

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
    std::vector<float> inverse_depth_per_m;  ///< 0: nothing hit; -1: the address was not traced
    std::vector<std::uint32_t> object_id;    ///< 0: nothing hit; else scene instance index + 1
    std::vector<glm::vec3> radiance;         ///< linear, unclamped; filled only where `keep_radiance` is set
    bool keep_radiance = false;
};

/// One eye's work. The plan and the samples outlive the call.
struct TraceTask {
    const EyeView* view = nullptr;
    const SamplePlan* plan = nullptr;
    Samples* samples = nullptr;
};

/// Traces and shades samples of a scene. Called once per frame with all eyes, never per ray. A tracer and its
/// scene are shared by all sessions: trace() may be called from several threads at once.
class Tracer {
public:
    Tracer() = default;
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;
    virtual ~Tracer() = default;
    /// Fills every address of each task's samples, all tasks in one parallel region.
    virtual void trace(std::span<const TraceTask> tasks) const noexcept = 0;
    /// For logs: "Embree 3.13.5, packets of 16".
    [[nodiscard]] virtual std::string name() const = 0;
};

/// CPU tracer. Keeps a reference to the scene.
/// Errors: `internal` with Embree's message (out of memory, unsupported CPU).
Expected<std::unique_ptr<Tracer>> make_embree_tracer(std::shared_ptr<const Scene> scene);

}  // namespace macula
