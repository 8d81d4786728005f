#include "scenes/gltf_material.h"

#include <cmath>
#include <utility>

#include "scenes/gltf_material_extension.h"
#include "scenes/gltf_member.h"

namespace macula {
namespace {

/// Copies a factor, clamped to [0, `most`] with a warning; an empty vector leaves the default. False if it has the
/// wrong length.
template <class Vector>
bool copy_factor(GltfContext& context, const std::string& element, const char* key, const std::vector<double>& from,
                 float most, Vector& to) {
    if (from.empty()) return true;
    if (from.size() != static_cast<std::size_t>(Vector::length())) return false;
    for (int i = 0; i < Vector::length(); ++i)
        to[i] = clamp_factor(context, element, key, from[static_cast<std::size_t>(i)], {0.0F, most});
    return true;
}

}  // namespace

GltfMaterialReader::GltfMaterialReader(GltfContext& context, Scene& scene)
    : context_(context),
      scene_(scene),
      textures_(context, scene),
      materials_(context.document.model.materials.size() + 1, -1) {}

Expected<int> GltfMaterialReader::material(int gltf_material) {
    const std::size_t slot = static_cast<std::size_t>(gltf_material) + 1;
    if (gltf_material < -1 || slot >= materials_.size())
        return context_.error("material " + std::to_string(gltf_material), "does not exist");
    if (materials_[slot] >= 0) return materials_[slot];

    Material material;
    material.name = "default";
    if (gltf_material >= 0) {
        const tinygltf::Material& from = context_.document.model.materials[slot - 1];
        const Expected<void> read_it = read(material, from, element_name("material", slot - 1, from.name));
        if (!read_it) return tl::unexpected(read_it.error());
    }
    scene_.materials.push_back(std::move(material));
    return materials_[slot] = static_cast<int>(scene_.materials.size()) - 1;
}

Expected<void> GltfMaterialReader::read(Material& to, const tinygltf::Material& from, const std::string& element) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    to.name = from.name;
    if (!copy_factor(context_, element, "baseColorFactor", pbr.baseColorFactor, 1.0F, to.base_color))
        return context_.error(element, "baseColorFactor is not four numbers");
    // glTF ends the emission at 1, too, but files that say more mean it.
    if (!copy_factor(context_, element, "emissiveFactor", from.emissiveFactor, kMostEmission, to.emissive))
        return context_.error(element, "emissiveFactor is not three numbers");
    to.metallic = clamp_factor(context_, element, "metallicFactor", pbr.metallicFactor, kShare);
    to.roughness = clamp_factor(context_, element, "roughnessFactor", pbr.roughnessFactor, kShare);
    to.normal_scale = static_cast<float>(from.normalTexture.scale);
    to.alpha_cutoff = static_cast<float>(from.alphaCutoff);
    if (!std::isfinite(to.normal_scale) || !std::isfinite(to.alpha_cutoff))
        return context_.error(element, "normal scale or alpha cutoff is not finite");
    to.double_sided = from.doubleSided;
    to.unlit = from.extensions.count("KHR_materials_unlit") > 0;
    if (from.alphaMode == "BLEND")
        to.alpha_mode = AlphaMode::blend;
    else if (from.alphaMode == "MASK")
        to.alpha_mode = AlphaMode::mask;
    else if (from.alphaMode != "OPAQUE")
        return context_.error(element, "alphaMode \"" + from.alphaMode + "\" is not glTF");

    const auto use = [&](TextureUse& slot, const tinygltf::TextureInfo& info, TextureCoding coding) -> Expected<void> {
        if (info.index == -1) return {};
        Expected<TextureUse> read_use = textures_.read(info, coding, element);
        if (!read_use) return tl::unexpected(read_use.error());
        slot = *read_use;
        return {};
    };
    tinygltf::TextureInfo normal;
    normal.index = from.normalTexture.index;
    normal.texCoord = from.normalTexture.texCoord;
    normal.extensions = from.normalTexture.extensions;
    return use(to.base_color_texture, pbr.baseColorTexture, TextureCoding::srgb)
        .and_then(
            [&] { return use(to.metallic_roughness_texture, pbr.metallicRoughnessTexture, TextureCoding::linear); })
        .and_then([&] { return use(to.normal_texture, normal, TextureCoding::linear); })
        .and_then([&] { return use(to.emissive_texture, from.emissiveTexture, TextureCoding::srgb); })
        .and_then([&] { return read_material_extensions(context_, textures_, from.extensions, element, to); });
}

}  // namespace macula
