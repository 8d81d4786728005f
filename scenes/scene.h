#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "protocol/base/geometry.h"
#include "scenes/animation.h"

namespace macula {

enum class TextureWrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class TextureFilter : std::uint8_t { nearest, linear };

/// What a channel of a texel is stored as. Codes of integers stand for 0 to 1.
enum class TexelType : std::uint8_t { u8, u16, f16, f32 };

constexpr std::size_t byte_count(TexelType type) {
    return type == TexelType::u8 ? 1 : (type == TexelType::f32 ? 4 : 2);
}

/// Pixels of an image, as small as its source had them. `srgb` says that grey and RGB are sRGB-coded colour.
struct TextureImage {
    std::string name;  ///< file or element it came from, for messages
    int width_px = 0;
    int height_px = 0;
    int channels = 4;  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; alpha is not multiplied into the others
    TexelType type = TexelType::u8;
    bool srgb = false;
    std::vector<std::uint8_t> texels;  ///< row 0 on top (glTF's v = 0), no gaps, in the machine's byte order

    [[nodiscard]] std::size_t texel_count() const {
        return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    }
    /// Bytes from a texel to the next.
    [[nodiscard]] std::size_t texel_bytes() const { return static_cast<std::size_t>(channels) * byte_count(type); }
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

enum class AlphaMode : std::uint8_t {
    opaque,  ///< alpha is ignored
    mask,    ///< alpha below the cutoff is a hole
    blend,   ///< alpha is the share of the light from behind that is covered
};

/// glTF 2.0 metallic-roughness material with the extensions that Macula reads. Factors are linear; each texture's
/// value is multiplied with the factor that is named like it.
struct Material {
    std::string name;
    glm::vec4 base_color = glm::vec4(1.0F);
    float metallic = 1.0F;
    float roughness = 1.0F;
    glm::vec3 emissive = glm::vec3(0.0F);  ///< radiance, KHR_materials_emissive_strength included
    float normal_scale = 1.0F;
    float alpha_cutoff = 0.5F;
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;  ///< otherwise back faces are invisible; they still cast shadows
    bool unlit = false;         ///< KHR_materials_unlit: radiance is the base colour
    TextureUse base_color_texture;
    TextureUse metallic_roughness_texture;  ///< G roughness, B metallic
    TextureUse normal_texture;
    TextureUse emissive_texture;

    float ior = 1.5F;                         ///< KHR_materials_ior; at least 1
    float specular = 1.0F;                    ///< KHR_materials_specular: strength of the dielectric reflection
    glm::vec3 specular_color = glm::vec3(1);  ///< its colour at normal incidence
    TextureUse specular_texture;              ///< A
    TextureUse specular_color_texture;        ///< sRGB

    float clearcoat = 0.0F;  ///< KHR_materials_clearcoat: strength of a layer of ior 1.5 on top
    float clearcoat_roughness = 0.0F;
    float clearcoat_normal_scale = 1.0F;
    TextureUse clearcoat_texture;            ///< R
    TextureUse clearcoat_roughness_texture;  ///< G
    TextureUse clearcoat_normal_texture;     ///< absent: the coat has the geometry's normals

    glm::vec3 sheen_color = glm::vec3(0.0F);  ///< KHR_materials_sheen
    float sheen_roughness = 0.0F;
    TextureUse sheen_color_texture;      ///< sRGB
    TextureUse sheen_roughness_texture;  ///< A

    float transmission = 0.0F;        ///< KHR_materials_transmission: share of the base that lets light through
    TextureUse transmission_texture;  ///< R
    /// KHR_materials_volume: 0 is a thin wall, that does not bend light; otherwise the mesh encloses a volume.
    float thickness_m = 0.0F;
    TextureUse thickness_texture;         ///< G
    float attenuation_distance_m = 0.0F;  ///< distance in which white light turns into attenuation_color; 0: clear
    glm::vec3 attenuation_color = glm::vec3(1.0F);  ///< positive, so that its logarithm is finite
};

/// Indexed triangles of one material, in mesh space; the corners turn counter-clockwise on the front, and a mirroring
/// placement does not change which side that is. Optional attributes are empty or one per vertex.
struct Mesh {
    std::string name;
    int material = 0;
    std::vector<glm::vec3> position_m;
    std::vector<glm::vec3> normal;   ///< unit; never empty after loading (flat normals are made where absent)
    std::vector<glm::vec4> tangent;  ///< unit xyz, w = +-1; present if the material or its coat has a normal texture
    std::vector<glm::vec2> uv0;      ///< present if a texture of the material uses set 0
    std::vector<glm::vec2> uv1;      ///< present if a texture of the material uses set 1
    std::vector<glm::vec4> color;    ///< linear vertex colour, multiplies the base colour
    std::vector<glm::uvec3> triangle;
};

/// One placement of a mesh. Its index + 1 is the object id of the samples that hit it.
struct Instance {
    std::string name;
    int mesh = 0;
    glm::mat4 world_from_mesh = glm::mat4(1.0F);  ///< affine, not singular; of a moving instance, at time 0
    int node = -1;                                ///< of the scene's animation that moves it; -1: it never moves
};

enum class LightKind : std::uint8_t { directional, point, spot, rectangle };

/// KHR_lights_punctual, with an extent for soft shadows, and rectangles. Shines along `direction` (world space, unit).
/// Of a light that moves, position, direction and edges are those at time 0.
struct Light {
    LightKind kind = LightKind::directional;
    glm::vec3 position_m = glm::vec3(0.0F);
    glm::vec3 direction = glm::vec3(0.0F, 0.0F, -1.0F);
    /// Directional: irradiance; point and spot: radiant intensity; rectangle: radiance.
    glm::vec3 intensity = glm::vec3(1.0F);
    float range_m = 0.0F;  ///< 0: unlimited
    float spot_cos_inner = 1.0F;
    float spot_cos_outer = 0.0F;
    bool casts_shadow = true;
    float radius_m = 0.0F;                 ///< of a point or spot light's ball; 0: shadows are hard
    float angular_radius_rad = 0.0F;       ///< of a directional light's disc; 0: shadows are hard
    glm::vec3 half_u_m = glm::vec3(0.0F);  ///< rectangle: from the centre `position_m` to the middle of one edge
    glm::vec3 half_v_m = glm::vec3(0.0F);  ///< and of the next; direction is along cross(half_u_m, half_v_m)
    int instance = -1;  ///< the emissive quad that this rectangle stands for, which does not shadow its own light
    int node = -1;      ///< of the scene's animation that moves it; -1: it never moves
};

/// Light from far away all around, a lat-long map: u = 0 and 1 at +Z, u = 1/4 at -X, u = 1/2 at -Z (straight ahead in
/// the middle), v = 0 at +Y.
struct Environment {
    int image = -1;             ///< index into the scene's images; negative: none
    float intensity = 1.0F;     ///< multiplies its radiance
    float rotation_rad = 0.0F;  ///< about +Y, counter-clockwise seen from above

    [[nodiscard]] bool present() const { return image >= 0; }
};

/// A camera of the file: a pose to start from, with the pitch and roll that the file gives it; level_head() of
/// scenes/framing.h takes them out. Of a camera that moves, at time 0.
struct SceneCamera {
    std::string name;  ///< different from those of the others
    Pose world_from_head;
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
    /// Where present, what a ray that hits nothing sees, and light from everywhere, beside ambient_radiance.
    Environment environment;
    Animation animation;               ///< moves the instances and lights that name a node of it
    std::vector<SceneCamera> cameras;  ///< in the file's order
    float exposure = 1.0F;             ///< radiance times exposure 1 is display white
    Pose world_from_start;             ///< head pose at which a session begins
    float near_m = 0.1F;               ///< nearest depth the depth stream resolves

    [[nodiscard]] std::size_t triangle_count() const {
        std::size_t count = 0;
        for (const Instance& instance : instances)
            count += meshes[static_cast<std::size_t>(instance.mesh)].triangle.size();
        return count;
    }
};

}  // namespace macula
