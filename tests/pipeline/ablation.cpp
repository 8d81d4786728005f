#include "tests/pipeline/ablation.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

namespace macula::test {
namespace {

/// Precision that makes a new pixel weigh .1 against a settled history, whose precision is 1.
constexpr float kTenth = 1.0F / 9.0F;

bool has(const std::set<std::string>& without, const char* name) {
    return without.find(name) != without.end();
}

/// Edges at equal distances on both sides of the axis, the same angle apart as before.
std::pair<float, float> centred(float low, float high) {
    const float half = std::tan((std::atan(high) - std::atan(low)) * 0.5F);
    return {-half, half};
}

/// Where a tangent goes when the buffer's edges get others.
float moved(float tangent, float low, float high, const std::pair<float, float>& to) {
    return to.first + (tangent - low) / (high - low) * (to.second - to.first);
}

void make_symmetric(EyeDisplay& eye) {
    const Tangents from = eye.tangents;
    const auto across = centred(from.left, from.right);
    const auto upward = centred(from.bottom, from.top);
    eye.tangents.left = across.first;
    eye.tangents.right = across.second;
    eye.tangents.bottom = upward.first;
    eye.tangents.top = upward.second;
    for (glm::vec2& corner : eye.visible_outline)
        corner = {moved(corner.x, from.left, from.right, across), moved(corner.y, from.bottom, from.top, upward)};
}

/// Traces as another tracer does, every texture read at full resolution.
class UnfilteredTracer final : public Tracer {
public:
    explicit UnfilteredTracer(std::shared_ptr<const Tracer> tracer) : tracer_(std::move(tracer)) {}

    TraceCounts trace(std::span<const TraceTask> tasks, double time_s) const noexcept override {
        std::vector<TraceTask> unfiltered(tasks.begin(), tasks.end());
        for (TraceTask& task : unfiltered) task.footprint_scale = 0.0F;
        return tracer_->trace(unfiltered, time_s);
    }
    [[nodiscard]] std::string name() const override { return tracer_->name() + ", textures not filtered"; }
    [[nodiscard]] std::size_t memory_bytes() const override { return tracer_->memory_bytes(); }

private:
    std::shared_ptr<const Tracer> tracer_;
};

}  // namespace

const std::vector<std::string>& ablation_names() {
    static const std::vector<std::string> kNames = {"hidden-area",      "true-tangents", "footprint-mips",
                                                    "normal-roughness", "hysteresis",    "eccentricity-weight",
                                                    "bounce-bound"};
    return kNames;
}

Expected<void> check_ablation(const std::set<std::string>& without) {
    const std::vector<std::string>& known = ablation_names();
    for (const std::string& name : without) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        std::string message = "unknown model '";
        message.append(name).append("' to switch off; there are");
        for (const std::string& one : known) message.append(" ").append(one);
        return fail(ErrorCode::option, message);
    }
    return {};
}

Display ablated_display(Display display, const std::set<std::string>& without) {
    if (has(without, "hidden-area"))
        for (EyeDisplay& eye : display.eyes) eye.visible_outline.clear();
    return display;
}

Display ablated_sampler_display(Display display, const std::set<std::string>& without) {
    display = ablated_display(std::move(display), without);
    if (has(without, "true-tangents"))
        for (EyeDisplay& eye : display.eyes) make_symmetric(eye);
    return display;
}

TileSamplerOptions ablated_sampler_options(const std::set<std::string>& without) {
    TileSamplerOptions options;
    if (has(without, "hysteresis")) options.hysteresis = 1.0F;
    return options;
}

TracerOptions ablated_tracer_options(const std::set<std::string>& without) {
    TracerOptions options;
    if (has(without, "normal-roughness")) options.normal_roughness = false;
    if (has(without, "bounce-bound")) options.bounce_bound = 0.0F;
    return options;
}

std::shared_ptr<const Tracer> ablated_tracer(std::shared_ptr<const Tracer> tracer,
                                             const std::set<std::string>& without) {
    if (!has(without, "footprint-mips")) return tracer;
    return std::make_shared<const UnfilteredTracer>(std::move(tracer));
}

kernels::TaaWeights ablated_taa_weights(kernels::TaaWeights weights, const std::set<std::string>& without) {
    if (has(without, "eccentricity-weight") && weights.traced != weights.interpolated) {
        weights.traced = kTenth;
        weights.interpolated = kTenth;
    }
    return weights;
}

}  // namespace macula::test
