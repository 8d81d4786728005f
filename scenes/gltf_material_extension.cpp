#include "scenes/gltf_material_extension.h"

#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "scenes/gltf_member.h"

namespace macula {
namespace {

void read_emissive_strength(GltfMembers& from, Material& to) {
    to.emissive *= from.number("emissiveStrength", 1.0F, {0.0F, kMostEmission});
}

void read_ior(GltfMembers& from, Material& to) {
    const float ior = from.number("ior", 1.5F, {0.0F, kMirrorIor});
    to.ior = ior == 0.0F ? kMirrorIor : glm::max(ior, 1.0F);
}

void read_specular(GltfMembers& from, Material& to) {
    to.specular = from.number("specularFactor", 1.0F, kShare);
    to.specular_color = from.color("specularColorFactor", glm::vec3(1.0F), {0.0F, 1e6F});
    if (to.specular == 0.0F) return;
    to.specular_texture = from.texture("specularTexture", TextureCoding::linear);
    to.specular_color_texture = from.texture("specularColorTexture", TextureCoding::srgb);
}

void read_clearcoat(GltfMembers& from, Material& to) {
    to.clearcoat = from.number("clearcoatFactor", 0.0F, kShare);
    to.clearcoat_roughness = from.number("clearcoatRoughnessFactor", 0.0F, kShare);
    if (to.clearcoat == 0.0F) return;
    to.clearcoat_texture = from.texture("clearcoatTexture", TextureCoding::linear);
    to.clearcoat_roughness_texture = from.texture("clearcoatRoughnessTexture", TextureCoding::linear);
    to.clearcoat_normal_texture = from.normal_texture("clearcoatNormalTexture", to.clearcoat_normal_scale);
}

void read_sheen(GltfMembers& from, Material& to) {
    to.sheen_color = from.color("sheenColorFactor", glm::vec3(0.0F), kShare);
    to.sheen_roughness = from.number("sheenRoughnessFactor", 0.0F, kShare);
    if (to.sheen_color == glm::vec3(0.0F)) return;
    to.sheen_color_texture = from.texture("sheenColorTexture", TextureCoding::srgb);
    to.sheen_roughness_texture = from.texture("sheenRoughnessTexture", TextureCoding::linear);
}

void read_transmission(GltfMembers& from, Material& to) {
    to.transmission = from.number("transmissionFactor", 0.0F, kShare);
    if (to.transmission > 0.0F) to.transmission_texture = from.texture("transmissionTexture", TextureCoding::linear);
}

void read_volume(GltfMembers& from, Material& to) {
    to.thickness_m = from.number("thicknessFactor", 0.0F, {0.0F, 1e9F});
    // The default is infinity, which is no number of JSON: the material's 0 stands for it.
    to.attenuation_distance_m = from.number("attenuationDistance", 0.0F, kNotNegative);
    if (to.attenuation_distance_m > 0.0F) to.attenuation_distance_m = glm::max(to.attenuation_distance_m, 1e-6F);
    to.attenuation_color =
        glm::max(from.color("attenuationColor", glm::vec3(1.0F), kShare), glm::vec3(kDarkestAttenuation));
    if (to.thickness_m > 0.0F) to.thickness_texture = from.texture("thicknessTexture", TextureCoding::linear);
}

struct MaterialExtension {
    const char* name;
    void (*read)(GltfMembers& from, Material& to);
};

constexpr std::array<MaterialExtension, 7> kExtensions = {{
    {"KHR_materials_emissive_strength", read_emissive_strength},
    {"KHR_materials_ior", read_ior},
    {"KHR_materials_specular", read_specular},
    {"KHR_materials_clearcoat", read_clearcoat},
    {"KHR_materials_sheen", read_sheen},
    {"KHR_materials_transmission", read_transmission},
    {"KHR_materials_volume", read_volume},
}};

}  // namespace

Expected<void> read_material_extensions(GltfContext& context, GltfTextureReader& textures,
                                        const tinygltf::ExtensionMap& extensions, const std::string& element,
                                        Material& material) {
    for (const MaterialExtension& extension : kExtensions) {
        const auto found = extensions.find(extension.name);
        if (found == extensions.end()) continue;
        GltfMembers members(context, textures, found->second, element + ", " + extension.name);
        extension.read(members, material);
        if (Expected<void> result = members.result(); !result) return result;
    }
    return {};
}

}  // namespace macula
