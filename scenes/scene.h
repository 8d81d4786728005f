#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "protocol/base/geometry.h"

namespace macula {

enum class TextureWrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class TextureFilter : std::uint8_t { nearest, linear };

/// Pixels of an image, RGBA8, row 0 on top (glTF's v = 0). `srgb` says that RGB are sRGB-coded colour.
struct TextureImage {
    std::string name;  ///< file or element it came from, for messages
    int width_px = 0;
    int height_px = 0;
    bool srgb = false;
    std::vector<std::uint8_t> rgba;
};

/// A texture as a material uses it. Negative `image` means that there is none.
struct TextureUse {
    int image = -1;
    int uv_set = 0;  ///< 0 or 1
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    TextureFilter filter = TextureFilter::linear;
    /// KHR_texture_transform: uv' = uv_scale_rotation * uv + uv_offset, columns of the 2x2 matrix first.
    glm::vec4 uv_scale_rotation = glm::vec4(1.0F, 0.0F, 0.0F, 1.0F);
    glm::vec2 uv_offset = glm::vec2(0.0F);

    [[nodiscard]] bool present() const { return image >= 0; }
};

/// glTF 2.0 metallic-roughness material. Factors are linear.
struct Material {
    std::string name;
    glm::vec4 base_color = glm::vec4(1.0F);
    float metallic = 1.0F;
    float roughness = 1.0F;
    glm::vec3 emissive = glm::vec3(0.0F);
    float normal_scale = 1.0F;
    float alpha_cutoff = 0.5F;
    bool alpha_mask = false;    ///< alpha below the cutoff is a hole
    bool double_sided = false;  ///< otherwise back faces are invisible; they still cast shadows
    bool unlit = false;         ///< KHR_materials_unlit: radiance is the base colour
    TextureUse base_color_texture;
    TextureUse metallic_roughness_texture;  ///< G roughness, B metallic
    TextureUse normal_texture;
    TextureUse emissive_texture;
};

/// Indexed triangles of one material, in mesh space; the corners turn counter-clockwise on the front, and a mirroring
/// placement does not change which side that is. Optional attributes are empty or one per vertex.
struct Mesh {
    std::string name;
    int material = 0;
    std::vector<glm::vec3> position_m;
    std::vector<glm::vec3> normal;   ///< unit; never empty after loading (flat normals are made where absent)
    std::vector<glm::vec4> tangent;  ///< unit xyz, w = +-1; present if the material has a normal texture
    std::vector<glm::vec2> uv0;      ///< present if a texture of the material uses set 0
    std::vector<glm::vec2> uv1;      ///< present if a texture of the material uses set 1
    std::vector<glm::vec4> color;    ///< linear vertex colour, multiplies the base colour
    std::vector<glm::uvec3> triangle;
};

/// One placement of a mesh. Its index + 1 is the object id of the samples that hit it.
struct Instance {
    std::string name;
    int mesh = 0;
    glm::mat4 world_from_mesh = glm::mat4(1.0F);  ///< affine, not singular
};

enum class LightKind : std::uint8_t { directional, point, spot };

/// KHR_lights_punctual. Shines along `direction` (world space, unit).
struct Light {
    LightKind kind = LightKind::directional;
    glm::vec3 position_m = glm::vec3(0.0F);
    glm::vec3 direction = glm::vec3(0.0F, 0.0F, -1.0F);
    glm::vec3 intensity = glm::vec3(1.0F);  ///< directional: irradiance; point and spot: radiant intensity
    float range_m = 0.0F;                   ///< 0: unlimited
    float spot_cos_inner = 1.0F;
    float spot_cos_outer = 0.0F;
    bool casts_shadow = true;
};

/// Everything that a tracer needs to know, in linear Rec.709 and metres. A value: built once, then constant and
/// shared by all sessions.
struct Scene {
    std::string name;
    std::vector<TextureImage> images;
    std::vector<Material> materials;  ///< never empty
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    glm::vec3 ambient_radiance = glm::vec3(0.0F);     ///< uniform light from everywhere, unshadowed
    glm::vec3 background_radiance = glm::vec3(0.0F);  ///< what a ray that hits nothing sees
    float exposure = 1.0F;                            ///< radiance times exposure 1 is display white
    Pose world_from_start;                            ///< head pose at which a session begins
    float near_m = 0.1F;                              ///< nearest depth the depth stream resolves

    [[nodiscard]] std::size_t triangle_count() const {
        std::size_t count = 0;
        for (const Instance& instance : instances)
            count += meshes[static_cast<std::size_t>(instance.mesh)].triangle.size();
        return count;
    }
};

}  // namespace macula
