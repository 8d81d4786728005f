#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "server/render/packet_shading.h"
#include "server/render/ray_stack.h"
#include "server/render/tracer.h"

namespace macula {

// Measured on Bunny Box with every reflection traced, .13 secondary rays for each primary one (trace_bench
// --bounce-bound 0, 27 %, processor time, two runs each): waves in the order in which rays were sent, 331 and 315 ns a
// primary ray; sorted by octant and kind 321 and 312; sorted by sample 322 and 321; waves of 64 rays 313 and 315;
// secondary rays traced after each eye packet instead of after 16, which leaves more lanes empty, 320 and 317. No
// choice stands out from the noise, so there is no sorting.

/// Primary packets of a batch. More of them fill the packets of secondary rays better, and need more cache.
inline constexpr int kBatchPackets = 16;
inline constexpr int kBatchSamples = kBatchPackets * kLaneCount;

/// Secondary rays that are ordered together and traced in a row.
inline constexpr int kWaveRays = 256;

/// An eye as its rays need it.
struct Camera {
    explicit Camera(const EyeView& view);

    glm::mat3 world_from_eye;
    glm::vec3 origin;
    glm::vec4 edges;  ///< tangents: left, right, bottom, top
    glm::vec2 size_px;
    float pixel_tangent;  ///< distance of neighbouring pixels at distance 1
};

/// A sample while its rays are traced.
struct SampleSlot {
    glm::vec3 radiance = glm::vec3(0.0F);
    float first_light = 0.0F;       ///< of the first surface itself
    float other_light = 0.0F;       ///< that later surfaces sent
    float strongest = 0.0F;         ///< what the strongest of these sent
    float strongest_path_m = 0.0F;  ///< and the way to it; 0: it lies infinitely far
};

/// Memory of one thread, used by one batch after the other.
struct BatchMemory {
    BatchMemory();

    RayStack stack;
    std::vector<SecondaryRay> wave;
    std::array<SampleSlot, kBatchSamples> slots;
    std::array<float, kBatchSamples> metres_per_depth{};  ///< length of the sample's ray per metre of depth
    std::array<std::uint32_t, kBatchSamples> pixel{};
};

/// What is the same for all batches of a frame.
struct BatchFrame {
    ShadingContext shading;
    int bounces = 1;
    RayTap* tap = nullptr;
};

/// Traces and shades `kBatchPackets` packets of one eye: first all its eye rays with their direct light, then, wave by
/// wave, what mirrors, glass and coverage send on. Which samples share a batch is fixed by the plan alone, so that the
/// picture does not depend on threads.
class RayBatch {
public:
    RayBatch(const BatchFrame& frame, const TraceTask& task, const Camera& camera, BatchMemory& memory,
             TraceCounts& counts)
        : frame_(frame), task_(task), camera_(camera), memory_(memory), counts_(counts) {}

    /// Samples of the plan's order from entry `first` on.
    void trace(std::size_t first) noexcept;

private:
    void trace_eye_rays(std::size_t first_in_batch, std::span<const std::uint32_t> addresses);
    void absorb_before_eye(const HitPacket& hits, std::span<RayPath, kLaneCount> path, LaneMask lanes) const;
    void trace_wave(std::span<SecondaryRay> wave);
    void trace_secondary(std::span<SecondaryRay> rays);
    void store(std::span<const std::uint32_t> addresses, std::size_t slot);
    void store_color(std::span<const std::uint32_t> addresses, const Lanes3& radiance);
    void store_image_depth(std::span<const std::uint32_t> addresses, std::size_t slot);

    const BatchFrame& frame_;
    const TraceTask& task_;
    const Camera& camera_;
    BatchMemory& memory_;
    TraceCounts& counts_;
};

}  // namespace macula
