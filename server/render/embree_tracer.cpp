#include <algorithm>
#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "server/render/embree_scene.h"
#include "server/render/parallel_ranges.h"
#include "server/render/ray_batch.h"
#include "server/render/shading_scene.h"
#include "server/render/tracer.h"

namespace macula {
namespace {

/// Batches that one task of the thread pool traces in a row.
constexpr int kBatchesPerTask = 4;

/// Counts that tasks of the pool add to when they end.
class SharedCounts {
public:
    void add(const TraceCounts& counts) {
        primary_ += counts.primary;
        shadow_ += counts.shadow;
        reflection_ += counts.reflection;
        transmission_ += counts.transmission;
        skipped_shadow_ += counts.skipped_shadow;
        skipped_bounce_ += counts.skipped_bounce;
    }
    [[nodiscard]] TraceCounts sum() const {
        return {primary_, shadow_, reflection_, transmission_, skipped_shadow_, skipped_bounce_};
    }

private:
    std::atomic<std::uint64_t> primary_ = 0;
    std::atomic<std::uint64_t> shadow_ = 0;
    std::atomic<std::uint64_t> reflection_ = 0;
    std::atomic<std::uint64_t> transmission_ = 0;
    std::atomic<std::uint64_t> skipped_shadow_ = 0;
    std::atomic<std::uint64_t> skipped_bounce_ = 0;
};

void prepare(const TraceTask& task) {
    const std::size_t count = task.plan->address_count();
    Samples& samples = *task.samples;
    samples.color.resize(count);
    samples.inverse_depth_per_m.resize(count);
    samples.object_id.resize(count);
    if (samples.keep_radiance) samples.radiance.resize(count);
    if (samples.keep_image_depth) samples.image_inverse_depth_per_m.resize(count);
    for (const std::uint32_t address : task.plan->untraced) {
        samples.color[address] = 0xFF000000U;
        samples.inverse_depth_per_m[address] = -1.0F;
        samples.object_id[address] = 0;
        if (samples.keep_radiance) samples.radiance[address] = glm::vec3(0.0F);
        if (samples.keep_image_depth) samples.image_inverse_depth_per_m[address] = -1.0F;
    }
}

int batch_count(const TraceTask& task) {
    return static_cast<int>((task.plan->trace_order.size() + kBatchSamples - 1) / kBatchSamples);
}

/// Made when a thread traces its first batch, and kept.
BatchMemory& thread_memory() {
    thread_local const auto memory = std::make_unique<BatchMemory>();
    return *memory;
}

/// Without bounces, what only reflected rays are for falls away.
std::uint32_t needs_of(std::uint32_t scene, const TracerOptions& options) {
    const std::uint32_t needs = options.bounces > 0 ? scene : scene & ~(kNeedMirrors | kNeedGloss);
    return needs | options.forced_features;
}

class EmbreeTracer final : public Tracer {
public:
    EmbreeTracer(std::shared_ptr<const Scene> scene, const TracerOptions& options, RayTap* tap)
        : options_(options),
          tap_(tap),
          shading_(std::move(scene)),
          needs_(needs_of(shading_.needs(), options)),
          scene_(shading_, needs_) {}

    Expected<void> build() { return scene_.build(); }

    TraceCounts trace(std::span<const TraceTask> tasks, double time_s) const noexcept override;

    [[nodiscard]] std::string name() const override {
        return std::string("Embree ") + RTC_VERSION_STRING + ", packets of " + std::to_string(kLaneCount);
    }
    [[nodiscard]] std::size_t memory_bytes() const override { return shading_.memory_bytes() + scene_.memory_bytes(); }

private:
    TracerOptions options_;
    RayTap* tap_;
    ShadingScene shading_;
    std::uint32_t needs_;
    EmbreeScene scene_;
};

int samples_side(int light_samples) {
    int side = 1;
    while (side < 8 && side * side < light_samples) side *= 2;
    return side;
}

TraceCounts EmbreeTracer::trace(std::span<const TraceTask> tasks, double time_s) const noexcept {
    int total = 0;
    for (const TraceTask& task : tasks) {
        prepare(task);
        total += batch_count(task);
    }
    const std::shared_ptr<const ScenePose> pose = scene_.at(time_s);
    const BatchFrame frame{{shading_, *pose, needs_, options_.bounce_bound, samples_side(options_.light_samples),
                            options_.normal_roughness},
                           options_.bounces,
                           tap_};
    SharedCounts shared;
    parallel_ranges(0, total, kBatchesPerTask, [&](int begin, int end) {
        TraceCounts counts;
        BatchMemory& memory = thread_memory();
        for (const TraceTask& task : tasks) {
            if (end <= 0) break;
            const int count = batch_count(task);
            const Camera camera(*task.view);
            RayBatch batch(frame, task, camera, memory, counts);
            for (; begin < std::min(end, count); ++begin) batch.trace(static_cast<std::size_t>(begin) * kBatchSamples);
            begin = std::max(begin - count, 0);
            end -= count;
        }
        shared.add(counts);
    });
    return shared.sum();
}

}  // namespace

Expected<std::unique_ptr<Tracer>> make_embree_tracer(std::shared_ptr<const Scene> scene, const TracerOptions& options,
                                                     RayTap* tap) {
    auto tracer = std::make_unique<EmbreeTracer>(std::move(scene), options, tap);
    auto built = tracer->build();
    if (!built) return tl::unexpected(built.error());
    return tracer;
}

}  // namespace macula
