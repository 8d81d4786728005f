#pragma once

#include <array>

#include "scenes/scene.h"

namespace macula {

/// All textures of a material, present or not.
inline std::array<const TextureUse*, 13> texture_uses(const Material& material) {
    return {&material.base_color_texture,       &material.metallic_roughness_texture,
            &material.normal_texture,           &material.emissive_texture,
            &material.specular_texture,         &material.specular_color_texture,
            &material.clearcoat_texture,        &material.clearcoat_roughness_texture,
            &material.clearcoat_normal_texture, &material.sheen_color_texture,
            &material.sheen_roughness_texture,  &material.transmission_texture,
            &material.thickness_texture};
}

}  // namespace macula
