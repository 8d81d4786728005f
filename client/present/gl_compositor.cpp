#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "client/present/make_compositor.h"
#include "client/present/object_motion.h"
#include "client/present/view_warp.h"
#include "kernel_text/taa_accumulate.h"
#include "kernel_text/taa_buffers.h"
#include "kernel_text/taa_kernel.h"
#include "kernel_text/taa_show.h"
#include "masks/levels.h"
#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"

namespace macula {
namespace {

using kernels::kBlock_px;

/// As in taa_buffers.glsl.
struct EyeParameters {
    kernels::ViewWarp warp;
    glm::ivec4 sampling;
};
struct Parameters {
    std::array<EyeParameters, kEyeCount> eyes;
    glm::ivec4 size;
    kernels::TaaWeights weights;
    std::int32_t moves;
    std::int32_t exact;
};
static_assert(sizeof(Parameters) == 2 * 64 + 16 + 32);

/// Four bytes a word.
std::vector<std::uint32_t> words_of(std::span<const std::uint8_t> bytes) {
    std::vector<std::uint32_t> words((bytes.size() + 3) / 4);
    for (std::size_t i = 0; i < bytes.size(); ++i) words[i / 4] |= std::uint32_t{bytes[i]} << (8 * (i % 4));
    return words;
}

class GlCompositor final : public Compositor {
public:
    /// The context is current.
    GlCompositor(std::unique_ptr<GlContext> context, ComputeProgram accumulate, ComputeProgram show,
                 const Display& display, const kernels::TaaWeights& weights)
        : context_(std::move(context)),
          accumulate_(std::move(accumulate)),
          show_(std::move(show)),
          display_(display),
          weights_(weights),
          width_(display.eye_width_px),
          height_(display.eye_height_px),
          motion_(display) {
        std::vector<std::uint8_t> hidden = hidden_pixels(display, kLeftEye);
        const std::vector<std::uint8_t> right = hidden_pixels(display, kRightEye);
        hidden.insert(hidden.end(), right.begin(), right.end());
        hidden_.write(words_of(hidden));
        const std::size_t pixels = hidden.size();
        const std::vector<glm::uvec2> unknown(pixels, glm::uvec2(0U));
        before_.write(unknown);
        after_.write(unknown);
        stable_.write(std::vector<Rgba8>(pixels, 0xFF000000U));
        picture_.resize(pixels);
        const std::vector<float> nothing(pixels / (kBlock_px * kBlock_px), 0.0F);
        depth_.write(nothing);
        depth_before_.write(nothing);
        // What is never read while nothing moves must be there all the same.
        slots_.write(std::vector<std::uint32_t>(1));
        shown_depth_.write(std::vector<float>(1));
        warps_.write(std::vector<kernels::ViewWarp>(1));
    }

    Expected<void> accumulate(const NewFrame& frame) override {
        const auto current = CurrentContext::enter(*context_);
        if (!current) return tl::unexpected(current.error());
        std::swap(before_, after_);
        std::swap(depth_before_, depth_);
        const PerEye<Pose> poses_before = std::exchange(world_from_eye_, frame.world_from_eye);
        const bool continues = std::exchange(has_history_, true) && frame.continues;
        Parameters parameters = parameters_for(world_from_eye_, poses_before);
        motion_.accept(frame, poses_before);
        if (motion_.accumulates() && weights_.knows_motion != 0) {
            parameters.moves = 1;
            write_slots(motion_.before(), {});
            write_warps(motion_.to_before(0), motion_.to_before(1));
        }
        parameters.size.z = frame.rank_tile_size_px;
        parameters.size.w = continues ? 1 : 0;
        std::vector<std::uint32_t> counts;
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
            const EyeSamplingMessage& sampling = *frame.sampling[eye];
            parameters.eyes[eye].sampling =
                glm::ivec4(sampling.phase_px, sampling.tiles_x, static_cast<int>(counts.size()));
            if (sampling.exact) parameters.exact |= 1 << eye;
            for (const std::uint8_t level : sampling.level) counts.push_back(kLevelCounts[level]);
        }
        parameters_.write(parameters);
        color_.write(frame.color->texels);
        depth_.write(frame.depth->texels);
        ranks_.write(words_of(frame.rank_tile));
        counts_.write(counts);
        parameters_.bind(0);
        color_.bind(1);
        depth_.bind(2);
        hidden_.bind(3);
        depth_before_.bind(4);
        before_.bind(5);
        after_.bind(6);
        stable_.bind(7);
        ranks_.bind(8);
        counts_.bind(9);
        slots_.bind(10);
        warps_.bind(12);
        dispatch(accumulate_);
        return {};
    }

    Expected<void> show(const PerEye<Pose>& world_from_eye, std::int64_t time_ns, ColorImage& picture) override {
        const auto current = CurrentContext::enter(*context_);
        if (!current) return tl::unexpected(current.error());
        Parameters parameters = parameters_for(world_from_eye, world_from_eye_);
        if (motion_.place(world_from_eye, time_ns)) {
            parameters.moves = 1;
            write_slots({}, motion_.shown());
            write_warps(motion_.from_shown(0), motion_.from_shown(1));
            shown_depth_.write(motion_.shown_depth());
        }
        parameters_.write(parameters);
        parameters_.bind(0);
        stable_.bind(1);
        depth_.bind(2);
        hidden_.bind(3);
        picture_.bind(7);
        slots_.bind(10);
        shown_depth_.bind(11);
        warps_.bind(12);
        dispatch(show_);
        if (picture.width_px != 2 * width_ || picture.height_px != height_) picture = ColorImage(2 * width_, height_);
        return picture_.read([&](std::span<const Rgba8> pixels) { std::ranges::copy(pixels, picture.texels.begin()); });
    }

    [[nodiscard]] std::string name() const override {
        return "GL (" + context_->kind_name() + ", " + context_->renderer() + ")";
    }

private:
    [[nodiscard]] Parameters parameters_for(const PerEye<Pose>& from, const PerEye<Pose>& to) const {
        Parameters parameters{};
        for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
            const Tangents& tangents = display_.eyes[eye].tangents;
            parameters.eyes[eye].warp =
                make_view_warp({to[eye], tangents, width_, height_}, {from[eye], tangents, width_, height_});
        }
        parameters.size = glm::ivec4(width_, height_, 0, 0);
        parameters.weights = weights_;
        return parameters;
    }
    /// A word for each block: slots of the new frame, and those of the others that are given.
    void write_slots(std::span<const std::uint8_t> before, std::span<const std::uint8_t> shown) {
        const std::vector<std::uint8_t>& now = motion_.now();
        std::vector<std::uint32_t> words(now.begin(), now.end());
        for (std::size_t i = 0; i < before.size(); ++i) words[i] |= std::uint32_t{before[i]} << 8;
        for (std::size_t i = 0; i < shown.size(); ++i) words[i] |= std::uint32_t{shown[i]} << 16;
        slots_.write(words);
    }
    void write_warps(std::span<const kernels::ViewWarp> left, std::span<const kernels::ViewWarp> right) {
        std::vector<kernels::ViewWarp> warps(left.begin(), left.end());
        warps.insert(warps.end(), right.begin(), right.end());
        warps_.write(warps);
    }
    void dispatch(const ComputeProgram& program) const {
        program.dispatch(static_cast<unsigned>(width_ + 15) / 16, static_cast<unsigned>(height_ + 7) / 8, kEyeCount);
    }

    std::unique_ptr<GlContext> context_;
    ComputeProgram accumulate_;
    ComputeProgram show_;
    Display display_;
    kernels::TaaWeights weights_;
    int width_;
    int height_;
    StorageBuffer<Parameters> parameters_{*context_};
    StorageBuffer<Rgba8> color_{*context_};
    StorageBuffer<float> depth_{*context_};
    StorageBuffer<std::uint32_t> hidden_{*context_};
    StorageBuffer<float> depth_before_{*context_};
    StorageBuffer<glm::uvec2> before_{*context_};
    StorageBuffer<glm::uvec2> after_{*context_};
    StorageBuffer<Rgba8> stable_{*context_};
    StorageBuffer<Rgba8> picture_{*context_};
    StorageBuffer<std::uint32_t> ranks_{*context_};
    StorageBuffer<std::uint32_t> counts_{*context_};
    StorageBuffer<std::uint32_t> slots_{*context_};
    StorageBuffer<float> shown_depth_{*context_};
    StorageBuffer<kernels::ViewWarp> warps_{*context_};
    ObjectMotion motion_;
    PerEye<Pose> world_from_eye_;
    bool has_history_ = false;
};

}  // namespace

Expected<std::unique_ptr<Compositor>> make_gl_compositor(std::unique_ptr<GlContext> context, const Display& display,
                                                         const kernels::TaaWeights& weights) {
    const auto current = CurrentContext::enter(*context);
    if (!current) return tl::unexpected(current.error());
    const auto build = [&](const KernelText& main) {
        return ComputeProgram::build(*context, std::array{taa_kernel_text, taa_buffers_text, main});
    };
    auto accumulate = build(taa_accumulate_text);
    if (!accumulate) return tl::unexpected(accumulate.error());
    auto show = build(taa_show_text);
    if (!show) return tl::unexpected(show.error());
    return std::make_unique<GlCompositor>(std::move(context), std::move(*accumulate), std::move(*show), display,
                                          weights);
}

}  // namespace macula
