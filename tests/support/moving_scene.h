#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include <oneapi/tbb/parallel_for.h>

#include "client/present/compositor.h"
#include "masks/law.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/codec/depth_plane.h"
#include "server/render/reconstructor.h"
#include "tests/support/law_for_share.h"

namespace macula::test {

/// A room in closed form, 6 m wide: zone plate, checks, noise, a flat ceiling, and wires of 8 mm before them. What a
/// ray from a place along a direction sees; `inverse` is one over the ray's parameter.
struct Seen {
    glm::vec3 color{0.0F};  ///< display coding, 0..1
    float inverse = 0.0F;
    std::uint32_t object = 0;  ///< id, where it matters
};

/// A scene as a function of the ray's origin and direction.
using SceneRay = std::function<Seen(const glm::vec3& from, const glm::vec3& along)>;

inline float lattice_noise(int x, int y) {
    auto h = static_cast<std::uint32_t>(x) * 0x9e3779b1U ^ static_cast<std::uint32_t>(y) * 0x85ebca77U;
    h = (h ^ h >> 15) * 0x2c1b3c6dU;
    return static_cast<float>((h ^ h >> 13) & 0xFFFFU) / 65535.0F;
}

inline Seen moving_scene(const glm::vec3& from, const glm::vec3& along) {
    const auto plane = [](float distance, float speed) { return speed / distance; };
    const std::array<float, 6> inverse = {plane(3.0F - from.x, along.x), plane(3.0F + from.x, -along.x),
                                          plane(1.4F - from.y, along.y), plane(1.6F + from.y, -along.y),
                                          plane(3.0F - from.z, along.z), plane(4.0F + from.z, -along.z)};
    const auto nearest = std::ranges::max_element(inverse);
    Seen seen{glm::vec3(0.0F), *nearest};
    const glm::vec3 p = from + along / *nearest;
    const auto checks = [](float u, float v) {
        return (static_cast<int>(std::floor(u)) + static_cast<int>(std::floor(v))) % 2 == 0 ? 0.75F : 0.25F;
    };
    switch (nearest - inverse.begin()) {
        case 0:
        case 1:
            seen.color = glm::vec3(0.9F, 0.7F, 0.6F) * checks(10.0F * p.y, 10.0F * p.z);
            break;
        case 2:
            seen.color = glm::vec3(0.75F, 0.85F, 0.95F);
            break;
        case 3: {
            const float u = 12.0F * p.x;
            const float v = 12.0F * p.z;
            const int x = static_cast<int>(std::floor(u));
            const int y = static_cast<int>(std::floor(v));
            const float fu = u - std::floor(u);
            const float fv = v - std::floor(v);
            const float upper = glm::mix(lattice_noise(x, y), lattice_noise(x + 1, y), fu);
            const float lower = glm::mix(lattice_noise(x, y + 1), lattice_noise(x + 1, y + 1), fu);
            seen.color = glm::vec3(0.6F, 0.5F, 0.4F) * (0.4F + 0.6F * glm::mix(upper, lower, fv));
            break;
        }
        default:
            seen.color = glm::vec3(0.5F + 0.4F * std::cos(12.0F * (p.x * p.x + p.y * p.y)));
    }
    // Wires: upright cylinders of radius 4 mm.
    for (int k = 0; k < 14; ++k) {
        const float cx = -2.0F + 0.3F * static_cast<float>(k) - from.x;
        const float cz = -1.6F - 0.25F * static_cast<float>(k * 5 % 7) - from.z;
        const float a = along.x * along.x + along.z * along.z;
        const float b = along.x * cx + along.z * cz;
        const float discriminant = b * b - a * (cx * cx + cz * cz - 16e-6F);
        if (discriminant <= 0.0F) continue;
        const float wire = a / (b - std::sqrt(discriminant));
        if (wire > seen.inverse) seen = {glm::vec3(0.05F, 0.05F, 0.1F), wire};
    }
    return seen;
}

inline Rgba8 coded(const glm::vec3& color) {
    const auto byte = [](float v) { return static_cast<Rgba8>(std::clamp(v, 0.0F, 1.0F) * 255.0F + 0.5F); };
    return byte(color.x) | byte(color.y) << 8 | byte(color.z) << 16 | 0xFF000000U;
}

/// What a ray through the place (x, y) of a picture sees; `inverse` is the inverse depth.
inline Seen see(const SceneRay& scene, const EyeView& view, float x, float y) {
    const Tangents& t = view.tangents;
    const glm::vec3 direction(t.left + x / static_cast<float>(view.width_px) * (t.right - t.left),
                              t.top - y / static_cast<float>(view.height_px) * (t.top - t.bottom), -1.0F);
    return scene(view.world_from_eye.position_m, view.world_from_eye.direction(direction));
}

/// The picture with 16 rays a pixel, averaged as the display shows it.
inline ColorImage reference_picture(const EyeView& view, const SceneRay& scene = moving_scene) {
    ColorImage picture(view.width_px, view.height_px);
    tbb::parallel_for(0, view.height_px, [&](int y) {
        for (int x = 0; x < view.width_px; ++x) {
            glm::vec3 sum(0.0F);
            for (int i = 0; i < 16; ++i) {
                sum += see(scene, view, static_cast<float>(x) + (static_cast<float>(i % 4) + 0.5F) / 4.0F,
                           static_cast<float>(y) + (static_cast<float>(i / 4) + 0.5F) / 4.0F)
                           .color;
            }
            picture.at(x, y) = coded(sum / 16.0F);
        }
    });
    return picture;
}

/// Makes frames of a scene as a server would: plan, one ray a sample, reconstruction, nearest depth of each
/// 4x4 block in 8-bit codes. One eye, shown to both; no video coding.
class FoveatedView {
public:
    /// `share` of the pixels is traced; nothing: all of them.
    FoveatedView(const Display& display, std::optional<double> share)
        : display_(display),
          tables_(std::make_shared<const TileTables>(make_rank_tile())),
          sampler_(display, kLeftEye,
                   share ? std::optional(law_for_share(display, kLeftEye, *share)) : std::optional<AcuityLaw>(),
                   tables_),
          reconstructor_(make_cpu_reconstructor(tables_)) {
        color = ColorImage(2 * display.eye_width_px, display.eye_height_px);
        full_depth = InverseDepthImage(color.width_px, color.height_px);
        depth = InverseDepthImage(color.width_px / 4, color.height_px / 4);
    }

    [[nodiscard]] EyeView view(const Pose& world_from_eye) const {
        return {world_from_eye, display_.eyes[kLeftEye].tangents, display_.eye_width_px, display_.eye_height_px};
    }

    /// Frame number `index`, seen from a pose, for a gaze in eye space. Valid until the next call.
    NewFrame frame(int index, const Pose& world_from_eye, const glm::vec3& gaze = glm::vec3(0.0F, 0.0F, -1.0F)) {
        // The R2 sequence spreads the phases of few frames evenly (Roberts 2018).
        const auto r2 = [&](double step) { return static_cast<int>(64.0 * (index * step - std::floor(index * step))); };
        sampler_.plan({gaze, glm::ivec2(r2(0.7548776662466927), r2(0.5698402909980532))}, plan);
        const EyeView from = view(world_from_eye);
        samples.color.assign(plan.address_count(), 0xFF000000U);
        samples.inverse_depth_per_m.assign(plan.address_count(), -1.0F);
        samples.object_id.assign(plan.address_count(), 0);
        tbb::parallel_for(std::size_t{0}, plan.trace_order.size(), [&](std::size_t i) {
            const std::uint32_t address = plan.trace_order[i];
            const SamplePosition at = plan.position[address];
            const Seen seen = see(scene, from, static_cast<float>(at.x_px) + 0.5F, static_cast<float>(at.y_px) + 0.5F);
            samples.color[address] = coded(seen.color);
            samples.inverse_depth_per_m[address] = seen.inverse;
            samples.object_id[address] = seen.object;
        });
        const auto stride = static_cast<std::size_t>(color.width_px);
        static_cast<void>(reconstructor_->reconstruct(plan, samples,
                                                      {color.texels.data(), stride, full_depth.texels.data(), stride}));
        for (int y = 0; y < color.height_px; ++y) {
            std::copy_n(color.row(y), display_.eye_width_px, color.row(y) + display_.eye_width_px);
            std::copy_n(full_depth.row(y), display_.eye_width_px, full_depth.row(y) + display_.eye_width_px);
        }
        constexpr float kNear_m = 0.5F;
        codes_.resize(depth.texels.size());
        nearest_depth_codes(full_depth, kNear_m, codes_.data(), depth.width_px);
        for (std::size_t i = 0; i < codes_.size(); ++i) depth.texels[i] = inverse_depth_of(codes_[i], kNear_m);

        sampling_.phase_px = plan.phase_px;
        sampling_.tiles_x = plan.tiles_x - 2;
        sampling_.tiles_y = plan.tiles_y - 2;
        sampling_.level.clear();
        for (int y = 0; y < sampling_.tiles_y; ++y) {
            const auto row = plan.level.begin() + (y + 1) * plan.tiles_x + 1;
            sampling_.level.insert(sampling_.level.end(), row, row + sampling_.tiles_x);
        }
        NewFrame made;
        made.color = &color;
        made.depth = &depth;
        made.world_from_eye = {world_from_eye, world_from_eye};
        made.sampling = {&sampling_, &sampling_};
        made.rank_tile = tables_->rank_tile().rank;
        made.rank_tile_size_px = RankTile::kEdge_px;
        return made;
    }

    ColorImage color;              ///< of the last frame
    InverseDepthImage depth;       ///< of the last frame, by blocks
    SamplePlan plan;               ///< of the last frame
    Samples samples;               ///< of the last frame
    InverseDepthImage full_depth;  ///< of the last frame, by pixels
    SceneRay scene = moving_scene;

private:
    Display display_;
    std::shared_ptr<const TileTables> tables_;
    TileSampler sampler_;
    std::unique_ptr<Reconstructor> reconstructor_;
    std::vector<std::uint8_t> codes_;
    EyeSamplingMessage sampling_;
};

}  // namespace macula::test
