#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scenes/needs.h"
#include "scenes/scene.h"
#include "server/kernels/area_light.h"
#include "server/kernels/light.h"
#include "server/render/environment.h"
#include "server/render/texture_lookup.h"

namespace macula {

/// What a hit on an instance needs beyond the factors of its material. What no lane of a packet needs is skipped.
enum Feature : std::uint32_t {
    kVertexColor = 1U << 0,
    kBaseColorTexture = 1U << 1,
    kMetallicRoughnessTexture = 1U << 2,
    kNormalTexture = 1U << 3,
    kEmissiveTexture = 1U << 4,
    kUnlit = 1U << 5,
    kTransmissionTexture = 1U << 6,
    kSpecularTexture = 1U << 7,
    kSpecularColorTexture = 1U << 8,
    kClearcoatTexture = 1U << 9,
    kClearcoatRoughnessTexture = 1U << 10,
    kClearcoatNormalTexture = 1U << 11,
    kSheenColorTexture = 1U << 12,
    kSheenRoughnessTexture = 1U << 13,
};

/// Needs of surfaces from which rays may go on.
inline constexpr std::uint32_t kBranchingNeeds =
    kNeedBlending | kNeedTransmission | kNeedRefraction | kNeedMirrors | kNeedGloss;

/// Needs of surfaces that have layers on top.
inline constexpr std::uint32_t kLayerNeeds = kNeedClearcoat | kNeedSheen;

/// A texture as one instance reads it.
struct ShadingTexture {
    TextureView view;
    const glm::vec2* uv = nullptr;  ///< per vertex
};

/// Textures of an instance whose material has extensions.
struct ShadingExtension {
    ShadingTexture transmission;
    ShadingTexture specular;
    ShadingTexture specular_color;
    ShadingTexture clearcoat;
    ShadingTexture clearcoat_roughness;
    ShadingTexture clearcoat_normal;
    ShadingTexture sheen_color;
    ShadingTexture sheen_roughness;
};

/// One instance with its material. Pointers are to the scene or to the ShadingScene.
struct ShadingInstance {
    const glm::uvec3* triangle = nullptr;
    const glm::vec3* normal = nullptr;    ///< unit; world space, or mesh space where the instance moves
    const glm::vec4* tangent = nullptr;   ///< in the same space; present with a normal texture
    const glm::vec3* position = nullptr;  ///< mesh space, m
    const glm::vec4* color = nullptr;     ///< present with kVertexColor
    const Material* material = nullptr;
    std::uint32_t features = 0;  ///< of `Feature`
    std::uint32_t needs = 0;     ///< of `Need`
    bool moves = false;
    /// Directions of mesh space in world space; of a moving instance, unity: its place has them.
    glm::mat3 world_from_mesh = glm::mat3(1.0F);
    /// What rays miss the planes of its largest triangles by, in units of the last place of a float: Embree's hit
    /// distance is wrong by some of those of the sum over the axes of |normal| * extent. Of a moving instance, in mesh
    /// space and for the worst turn.
    float plane_extent_m = 0.0F;
    glm::vec3 absorption_per_m = glm::vec3(0.0F);  ///< of the volume that the mesh encloses
    ShadingTexture base_color;
    ShadingTexture metallic_roughness;
    ShadingTexture normal_map;
    ShadingTexture emissive;
    const ShadingExtension* extension = nullptr;  ///< present with a texture of an extension
};

/// A light and whether its rays are traced.
struct ShadingLight {
    kernels::Light light{};
    kernels::RectangleLight rectangle{};  ///< instead of `light` where `is_rectangle`
    bool is_rectangle = false;
    bool has_extent = false;  ///< sampled in more than one point
    bool casts_shadow = true;
    bool is_seen = false;  ///< a surface of the scene shines in its place, which reflected rays see
};

/// A scene as shading reads it: every instance in world space. Keeps the scene. Constant once built.
class ShadingScene {
public:
    explicit ShadingScene(std::shared_ptr<const Scene> scene);
    ShadingScene(const ShadingScene&) = delete;  // instances point into it
    ShadingScene& operator=(const ShadingScene&) = delete;

    [[nodiscard]] const Scene& scene() const { return *scene_; }
    /// By the scene's instance index.
    [[nodiscard]] const std::vector<ShadingInstance>& instances() const { return instances_; }
    /// Without those of intensity zero; where they move, at time 0.
    [[nodiscard]] const std::vector<ShadingLight>& lights() const { return lights_; }
    /// The same lights where the animation's nodes stand at `world_from_node`.
    [[nodiscard]] std::vector<ShadingLight> lights_at(const std::vector<glm::mat4>& world_from_node) const;
    /// Null where the scene has none.
    [[nodiscard]] const EnvironmentMap* environment() const { return environment_.get(); }
    /// What all surfaces and lights need, of `Need`.
    [[nodiscard]] std::uint32_t needs() const { return needs_; }
    /// Bytes beyond those of the scene.
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    ShadingTexture texture(const TextureUse& use, const Mesh& mesh, TextureContent content, float alpha_cutoff = 0.0F);
    void add_instance(const Instance& instance, std::uint32_t needs);

    std::shared_ptr<const Scene> scene_;
    TextureLibrary textures_;
    std::vector<ShadingInstance> instances_;
    std::vector<ShadingLight> lights_;
    std::vector<glm::mat4> node_from_world_;  ///< of the animation's nodes at time 0
    std::uint32_t needs_ = 0;
    std::unique_ptr<const EnvironmentMap> environment_;
    // The inner vectors never move once filled.
    std::vector<std::vector<glm::vec3>> normals_;
    std::vector<std::vector<glm::vec4>> tangents_;
    std::vector<std::vector<glm::uvec3>> mirrored_triangles_;
    std::vector<std::unique_ptr<ShadingExtension>> extensions_;
};

/// Whether the instance turns its mesh inside out, which reverses the corner order of front faces.
bool mirrors(const Instance& instance);

}  // namespace macula
