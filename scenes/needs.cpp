#include "scenes/needs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "scenes/texel.h"

namespace macula {
namespace {

struct NeedText {
    const char* name;
    const char* absent;  ///< why it is not needed
};

constexpr std::array<NeedText, kNeedCount> kTexts = {{
    {"textures", "no material has an image"},
    {"normal maps", "no material has a normal texture that bends anything"},
    {"vertex colours", "no mesh has colours at its vertices"},
    {"alpha masks", "no material cuts holes"},
    {"blending", "every surface covers all of what lies behind it"},
    {"transmission", "no thin wall lets light through"},
    {"refraction", "no mesh encloses a volume that lets light through"},
    {"absorption", "no volume colours the light that passes"},
    {"mirrors", "no surface is smooth enough to reflect a sharp image"},
    {"gloss", "every surface is too rough for its reflections to be traced, or too smooth to blur them"},
    {"clearcoat", "no material has a clear layer"},
    {"sheen", "no material is a fabric"},
    {"specular", "every dielectric reflects the usual 4 %"},
    {"shadows", "no light casts shadows"},
    {"soft shadows", "every light is a point or infinitely far"},
    {"environment", "no image shines from all around"},
    {"animation", "nothing moves"},
}};

/// Least and largest stored value of a channel, 0 to 3 for red, green, blue, alpha.
std::pair<float, float> channel_range(const TextureImage& image, int channel) {
    float low = std::numeric_limits<float>::infinity();
    float high = 0.0F;
    for (std::size_t i = 0; i < image.texel_count(); ++i) {
        const float value = stored_texel(image, i)[channel];
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return {low, high};
}

std::uint32_t image_needs(const Material& m) {
    const auto any = [](std::initializer_list<const TextureUse*> uses) {
        return std::any_of(uses.begin(), uses.end(), [](const TextureUse* use) { return use->present(); });
    };
    std::uint32_t needs = any({&m.base_color_texture}) ? kNeedTextures : 0U;
    if (m.unlit) return needs;
    if (any({&m.metallic_roughness_texture, &m.emissive_texture, &m.specular_texture, &m.specular_color_texture,
             &m.clearcoat_texture, &m.clearcoat_roughness_texture, &m.sheen_color_texture, &m.sheen_roughness_texture,
             &m.transmission_texture, &m.thickness_texture}))
        needs |= kNeedTextures;
    if ((m.normal_texture.present() && m.normal_scale != 0.0F) ||
        (m.clearcoat > 0.0F && m.clearcoat_normal_texture.present() && m.clearcoat_normal_scale != 0.0F))
        needs |= kNeedTextures | kNeedNormalMaps;
    return needs;
}

/// Which reflections a layer with a range of roughness has.
std::uint32_t gloss_needs(float smoothest, float roughest) {
    if (smoothest > kGlossLimit) return 0;
    return (smoothest <= kMirrorLimit ? kNeedMirrors : 0U) | (roughest > kMirrorLimit ? kNeedGloss : 0U);
}

std::string quoted(const char* kind, const std::string& name, std::size_t index) {
    std::string text = kind;
    if (name.empty()) return text.append(" ").append(std::to_string(index));
    return text.append(" '").append(name).append("'");
}

/// Who asks for each need: the first by name, and how many there are.
class Askers {
public:
    void add(std::uint32_t needs, const std::string& who) {
        for (std::size_t bit = 0; bit < kNeedCount; ++bit) {
            if ((needs >> bit & 1U) == 0) continue;
            if (count_[bit]++ == 0) first_[bit] = who;
        }
    }
    [[nodiscard]] SceneNeeds result() const {
        SceneNeeds result;
        for (std::size_t bit = 0; bit < kNeedCount; ++bit) {
            if (count_[bit] == 0) {
                result.reason.emplace_back(kTexts[bit].absent);
                continue;
            }
            result.needs |= 1U << bit;
            const std::size_t others = count_[bit] - 1;
            std::string who = first_[bit];
            if (others > 0) who.append(" and ").append(std::to_string(others)).append(" more");
            result.reason.push_back(std::move(who));
        }
        return result;
    }

private:
    std::array<std::size_t, kNeedCount> count_{};
    std::array<std::string, kNeedCount> first_;
};

}  // namespace

SurfaceNeeds::Range SurfaceNeeds::factor_range(float factor, const TextureUse& use, int channel) {
    if (!use.present() || factor == 0.0F) return {factor, factor};
    const auto [entry, is_new] = range_.try_emplace({use.image, channel});
    if (is_new) {
        const auto [low, high] = channel_range(scene_.images[static_cast<std::size_t>(use.image)], channel);
        entry->second = {low, high};
    }
    return {factor * entry->second.low, factor * entry->second.high};
}

bool SurfaceNeeds::has_factor(float factor, const TextureUse& use, int channel) {
    return factor_range(factor, use, channel).high > 0.0F;
}

bool SurfaceNeeds::has_color(const glm::vec3& factor, const TextureUse& use) {
    return has_factor(factor.x, use, 0) || has_factor(factor.y, use, 1) || has_factor(factor.z, use, 2);
}

float SurfaceNeeds::least_alpha(const Mesh& mesh, const Material& material) {
    const float alpha = factor_range(material.base_color.w, material.base_color_texture, 3).low;
    if (mesh.color.empty()) return alpha;
    float least = std::numeric_limits<float>::infinity();
    for (const glm::vec4& color : mesh.color) least = std::min(least, color.w);
    return alpha * least;
}

std::uint32_t SurfaceNeeds::of_alpha(const Mesh& mesh, const Material& material) {
    if (material.alpha_mode == AlphaMode::opaque) return 0;
    const float least = least_alpha(mesh, material);
    if (material.alpha_mode == AlphaMode::mask) return least < material.alpha_cutoff ? kNeedAlphaMasks : 0U;
    return least < 1.0F ? kNeedBlending : 0U;
}

std::uint32_t SurfaceNeeds::of_transmission(const Material& m) {
    if (!has_factor(m.transmission, m.transmission_texture, 0)) return 0;
    if (factor_range(m.metallic, m.metallic_roughness_texture, 2).low >= 1.0F) return 0;
    if (!has_factor(m.thickness_m, m.thickness_texture, 1)) return kNeedTransmission;
    const bool absorbs = m.attenuation_distance_m > 0.0F && m.attenuation_color != glm::vec3(1.0F);
    return kNeedRefraction | (absorbs ? kNeedAbsorption : 0U);
}

std::uint32_t SurfaceNeeds::of_reflection(const Material& m) {
    std::uint32_t needs = 0;
    const Range metallic = factor_range(m.metallic, m.metallic_roughness_texture, 2);
    const Range roughness = factor_range(m.roughness, m.metallic_roughness_texture, 1);
    const bool dielectric = metallic.low < 1.0F;
    if (metallic.high > 0.0F || (dielectric && has_factor(m.specular, m.specular_texture, 3)))
        needs |= gloss_needs(roughness.low, roughness.high);
    if (dielectric && (m.ior != 1.5F || m.specular != 1.0F || m.specular_color != glm::vec3(1.0F) ||
                       m.specular_texture.present() || m.specular_color_texture.present()))
        needs |= kNeedSpecular;
    if (has_factor(m.clearcoat, m.clearcoat_texture, 0)) {
        const Range coat = factor_range(m.clearcoat_roughness, m.clearcoat_roughness_texture, 1);
        needs |= kNeedClearcoat | gloss_needs(coat.low, coat.high);
    }
    if (has_color(m.sheen_color, m.sheen_color_texture)) needs |= kNeedSheen;
    return needs;
}

std::uint32_t SurfaceNeeds::of(const Mesh& mesh) {
    const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
    std::uint32_t needs = image_needs(material) | of_alpha(mesh, material);
    if (!mesh.color.empty()) needs |= kNeedVertexColors;
    if (material.unlit) return needs;
    return needs | of_transmission(material) | of_reflection(material);
}

std::uint32_t light_needs(const Light& light) {
    if (light.intensity == glm::vec3(0.0F) || !light.casts_shadow) return 0;
    const bool extended =
        light.kind == LightKind::rectangle || light.radius_m > 0.0F || light.angular_radius_rad > 0.0F;
    return kNeedShadows | (extended ? kNeedSoftShadows : 0U);
}

SceneNeeds scene_needs(const Scene& scene) {
    SurfaceNeeds surfaces(scene);
    return scene_needs(scene, surfaces);
}

SceneNeeds scene_needs(const Scene& scene, SurfaceNeeds& surfaces) {
    // What a mesh asks for is found once, however often it is placed.
    Askers askers;
    std::vector<bool> seen(scene.meshes.size(), false);
    std::map<int, std::uint32_t> of_material;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const auto index = static_cast<std::size_t>(instance.mesh);
        if (instance.node >= 0) askers.add(kNeedAnimation, quoted("instance", instance.name, i));
        if (seen[index]) continue;
        seen[index] = true;
        of_material[scene.meshes[index].material] |= surfaces.of(scene.meshes[index]);
    }
    for (const auto& [material, needs] : of_material) {
        const auto index = static_cast<std::size_t>(material);
        askers.add(needs, quoted("material", scene.materials[index].name, index));
    }
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        askers.add(light_needs(scene.lights[i]), quoted("light", "", i));
        if (scene.lights[i].node >= 0) askers.add(kNeedAnimation, quoted("light", "", i));
    }
    if (scene.environment.present() && scene.environment.intensity > 0.0F)
        askers.add(kNeedEnvironment,
                   quoted("image", scene.images[static_cast<std::size_t>(scene.environment.image)].name,
                          static_cast<std::size_t>(scene.environment.image)));
    return askers.result();
}

std::string explain(const SceneNeeds& needs) {
    std::string text;
    for (std::size_t bit = 0; bit < kNeedCount; ++bit) {
        std::string line = kTexts[bit].name;
        line.resize(16, ' ');
        text += line + ((needs.needs >> bit & 1U) != 0 ? "yes  " : "no   ") + needs.reason[bit] + "\n";
    }
    return text;
}

std::string summary(const SceneNeeds& needs) {
    std::string text;
    for (std::size_t bit = 0; bit < kNeedCount; ++bit) {
        if ((needs.needs >> bit & 1U) == 0) continue;
        text.append(text.empty() ? "" : ", ").append(kTexts[bit].name);
    }
    return text.empty() ? "nothing" : text;
}

}  // namespace macula
