#pragma once

#include <memory>
#include <stdexcept>
#include <utility>

#include <glm/vec3.hpp>

#include "scenes/scene.h"
#include "scenes/shapes.h"
#include "server/render/tracer.h"
#include "tests/support/plans.h"

namespace macula::test {

/// A rough white dielectric.
inline Material white() {
    Material material;
    material.metallic = 0.0F;
    return material;
}

/// White material that shows its colour without light.
inline Material unlit(const glm::vec4& color = glm::vec4(1.0F)) {
    Material material = white();
    material.unlit = true;
    material.base_color = color;
    return material;
}

/// Adds a mesh of a material of its own; returns the object id.
inline std::uint32_t add(Scene& scene, Mesh mesh, const Material& material,
                         const glm::mat4& world_from_mesh = glm::mat4(1.0F)) {
    mesh.material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(material);
    scene.instances.push_back({"", static_cast<int>(scene.meshes.size()), world_from_mesh});
    scene.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene.instances.size());
}

/// Square of 2 `half` edges around the centre, facing +Z; the image's top is +Y.
inline Mesh wall(const glm::vec3& centre, float half) {
    return make_quad(centre + glm::vec3(-half, half, 0.0F), {2.0F * half, 0.0F, 0.0F}, {0.0F, -2.0F * half, 0.0F});
}

/// Adds an RGBA8 image; returns its index.
inline int add_image(Scene& scene, int width_px, int height_px, std::vector<std::uint8_t> rgba, bool srgb = false) {
    scene.images.push_back({"test image", width_px, height_px, 4, TexelType::u8, srgb, std::move(rgba)});
    return static_cast<int>(scene.images.size()) - 1;
}

/// A square image of an eye that looks along -Z, with tangents -1..1.
inline EyeView square_view(int size_px, const glm::vec3& position_m = glm::vec3(0.0F)) {
    EyeView view;
    view.world_from_eye.position_m = position_m;
    view.width_px = size_px;
    view.height_px = size_px;
    return view;
}

/// A traced picture of every pixel, with linear radiance.
struct Traced {
    EyeView view;
    Samples samples;

    [[nodiscard]] std::size_t address(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width_px) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] glm::vec3 radiance(int x, int y) const { return samples.radiance[address(x, y)]; }
    [[nodiscard]] Rgba8 color(int x, int y) const { return samples.color[address(x, y)]; }
    [[nodiscard]] float inverse_depth(int x, int y) const { return samples.inverse_depth_per_m[address(x, y)]; }
    [[nodiscard]] float image_inverse_depth(int x, int y) const {
        return samples.image_inverse_depth_per_m[address(x, y)];
    }
    [[nodiscard]] std::uint32_t object(int x, int y) const { return samples.object_id[address(x, y)]; }
    /// Tangents of a pixel's centre, worked out from CONVENTIONS.md and not by the kernels.
    [[nodiscard]] glm::vec2 tangents(int x, int y) const {
        const Tangents& t = view.tangents;
        return {t.left + (static_cast<float>(x) + 0.5F) / static_cast<float>(view.width_px) * (t.right - t.left),
                t.top - (static_cast<float>(y) + 0.5F) / static_cast<float>(view.height_px) * (t.top - t.bottom)};
    }
};

inline std::unique_ptr<Tracer> tracer_of(const Scene& scene, const TracerOptions& options = {}) {
    auto tracer = make_embree_tracer(std::make_shared<const Scene>(scene), options);
    if (!tracer) throw std::runtime_error(tracer.error().message);  // a test that cannot go on
    return std::move(*tracer);
}

/// `counts` may be null.
inline Traced trace(const Scene& scene, const EyeView& view, const TracerOptions& options = {}, double time_s = 0.0,
                    TraceCounts* counts = nullptr) {
    Traced traced{view, {}};
    traced.samples.keep_radiance = true;
    traced.samples.keep_image_depth = true;
    const SamplePlan plan = full_plan(view.width_px, view.height_px);
    const TraceTask task{&traced.view, &plan, &traced.samples};
    const TraceCounts found = tracer_of(scene, options)->trace({&task, 1}, time_s);
    if (counts != nullptr) *counts = found;
    return traced;
}

}  // namespace macula::test
