#include "scenes/gltf_material.h"

#include <cmath>
#include <optional>
#include <utility>

#include <glm/common.hpp>

#include "scenes/gltf_accessor.h"
#include "scenes/image_file.h"

namespace macula {
namespace {

/// Beyond this a texture coordinate has no fraction left in float.
constexpr double kMaxUv = 1e6;

double number_or(const tinygltf::Value& object, const char* key, double otherwise) {
    const tinygltf::Value& value = object.Get(key);
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

/// Two numbers of an array member; `otherwise` where it is absent, nothing where it is not two numbers.
std::optional<glm::dvec2> pair_or(const tinygltf::Value& object, const char* key, const glm::dvec2& otherwise) {
    if (!object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    if (!value.IsArray() || value.ArrayLen() != 2 || !value.Get(0).IsNumber() || !value.Get(1).IsNumber())
        return std::nullopt;
    return glm::dvec2(value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble());
}

/// KHR_texture_transform: uv' = translation * rotation * scale * uv, rotation counter-clockwise where v points down.
/// Returns false if it is malformed.
bool apply_texture_transform(const tinygltf::Value& transform, TextureUse& use) {
    const std::optional<glm::dvec2> offset = pair_or(transform, "offset", glm::dvec2(0.0));
    const std::optional<glm::dvec2> scale = pair_or(transform, "scale", glm::dvec2(1.0));
    if (!offset || !scale) return false;
    for (int i = 0; i < 2; ++i)
        if (std::abs((*offset)[i]) > kMaxUv || std::abs((*scale)[i]) > kMaxUv) return false;
    const double angle = number_or(transform, "rotation", 0.0);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    use.uv_offset = glm::vec2(*offset);
    use.uv_scale_rotation = glm::vec4(c * scale->x, -s * scale->x, s * scale->y, c * scale->y);
    const double uv_set = number_or(transform, "texCoord", use.uv_set);
    use.uv_set = uv_set >= 0.0 && uv_set < 16.0 ? static_cast<int>(uv_set) : -1;
    return true;
}

std::optional<TextureWrap> wrap_of(int gl_name) {
    if (gl_name == TINYGLTF_TEXTURE_WRAP_REPEAT) return TextureWrap::repeat;
    if (gl_name == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp_to_edge;
    if (gl_name == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return TextureWrap::mirrored_repeat;
    return std::nullopt;
}

/// Copies a factor; an empty vector leaves the default. False if it has the wrong length or is not finite.
template <class Vector>
bool copy_factor(const std::vector<double>& from, Vector& to) {
    if (from.empty()) return true;
    if (from.size() != static_cast<std::size_t>(Vector::length())) return false;
    for (int i = 0; i < Vector::length(); ++i) {
        to[i] = static_cast<float>(from[static_cast<std::size_t>(i)]);
        if (!std::isfinite(to[i]) || to[i] < 0.0F) return false;
    }
    return true;
}

}  // namespace

GltfMaterialReader::GltfMaterialReader(GltfContext& context, Scene& scene)
    : context_(context),
      scene_(scene),
      materials_(context.document.model.materials.size() + 1, -1),
      images_(context.document.model.images.size(), {-1, -1}) {}

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
    if (!copy_factor(pbr.baseColorFactor, to.base_color) || !copy_factor(from.emissiveFactor, to.emissive))
        return context_.error(element, "a colour factor is malformed or negative");
    to.metallic = glm::clamp(static_cast<float>(pbr.metallicFactor), 0.0F, 1.0F);
    to.roughness = glm::clamp(static_cast<float>(pbr.roughnessFactor), 0.0F, 1.0F);
    to.normal_scale = static_cast<float>(from.normalTexture.scale);
    to.alpha_cutoff = static_cast<float>(from.alphaCutoff);
    if (!std::isfinite(to.normal_scale) || !std::isfinite(to.alpha_cutoff))
        return context_.error(element, "normal scale or alpha cutoff is not finite");
    to.double_sided = from.doubleSided;
    to.unlit = from.extensions.count("KHR_materials_unlit") > 0;
    if (from.alphaMode == "BLEND") {
        to.alpha_mode = AlphaMode::mask;
        to.alpha_cutoff = 0.5F;
        context_.warn(element, "alphaMode BLEND is shown as MASK with cutoff 0.5");
    } else if (from.alphaMode == "MASK") {
        to.alpha_mode = AlphaMode::mask;
    } else if (from.alphaMode != "OPAQUE") {
        return context_.error(element, "alphaMode \"" + from.alphaMode + "\" is not glTF");
    }

    const auto use = [&](TextureUse& slot, const auto& info, bool srgb) -> Expected<void> {
        if (info.index < 0) return {};
        Expected<TextureUse> read_use = texture(info.index, info.texCoord, info.extensions, srgb, element);
        if (!read_use) return tl::unexpected(read_use.error());
        slot = *read_use;
        return {};
    };
    return use(to.base_color_texture, pbr.baseColorTexture, true)
        .and_then([&] { return use(to.metallic_roughness_texture, pbr.metallicRoughnessTexture, false); })
        .and_then([&] { return use(to.normal_texture, from.normalTexture, false); })
        .and_then([&] { return use(to.emissive_texture, from.emissiveTexture, true); });
}

Expected<TextureUse> GltfMaterialReader::texture(int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                                                 bool srgb, const std::string& element) {
    const tinygltf::Model& model = context_.document.model;
    if (static_cast<std::size_t>(texture) >= model.textures.size())
        return context_.error(element, "texture " + std::to_string(texture) + " does not exist");
    const tinygltf::Texture& from = model.textures[static_cast<std::size_t>(texture)];
    const std::string texture_element = element_name("texture", static_cast<std::size_t>(texture), from.name);

    TextureUse use;
    use.uv_set = uv_set;
    const auto transform = extensions.find("KHR_texture_transform");
    if (transform != extensions.end() && !apply_texture_transform(transform->second, use))
        return context_.error(element, "KHR_texture_transform is malformed or beyond 1e6");
    if (use.uv_set < 0 || use.uv_set > 1)
        return context_.error(element, "Macula reads TEXCOORD_0 and TEXCOORD_1, no others");

    if (from.sampler >= 0) {
        if (static_cast<std::size_t>(from.sampler) >= model.samplers.size())
            return context_.error(texture_element, "sampler " + std::to_string(from.sampler) + " does not exist");
        const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(from.sampler)];
        const std::optional<TextureWrap> wrap_u = wrap_of(sampler.wrapS);
        const std::optional<TextureWrap> wrap_v = wrap_of(sampler.wrapT);
        if (!wrap_u || !wrap_v)
            return context_.error(element_name("sampler", static_cast<std::size_t>(from.sampler), sampler.name),
                                  "the wrap mode is not glTF");
        use.wrap_u = *wrap_u;
        use.wrap_v = *wrap_v;
        // There is one level and no minification filter: the magnification filter decides.
        if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) use.filter = TextureFilter::nearest;
    }
    if (from.source < 0) return context_.error(texture_element, "has no PNG or JPEG image");
    const Expected<int> decoded = image(from.source, srgb);
    if (!decoded) return tl::unexpected(decoded.error());
    use.image = *decoded;
    return use;
}

Expected<int> GltfMaterialReader::image(int gltf_image, bool srgb) {
    const auto index = static_cast<std::size_t>(gltf_image);
    if (index >= images_.size()) return context_.error(element_name("image", index), "does not exist");
    int& slot = images_[index][srgb ? 1 : 0];
    if (slot >= 0) return slot;

    const tinygltf::Image& from = context_.document.model.images[index];
    const std::string element = element_name("image", index, from.uri.empty() ? from.name : from.uri);
    TextureImage decoded;
    if (const int other = images_[index][srgb ? 0 : 1]; other >= 0) {
        decoded = scene_.images[static_cast<std::size_t>(other)];
        if (decoded.texel_count() > context_.texels_left) return context_.error(element, "too many texels");
    } else {
        std::span<const std::uint8_t> bytes = context_.document.image_bytes[index];
        if (from.bufferView >= 0) {
            const Expected<std::span<const std::uint8_t>> view = view_bytes(context_, from.bufferView, element);
            if (!view) return tl::unexpected(view.error());
            bytes = *view;
        }
        if (bytes.empty()) return context_.error(element, "the image file is missing or empty");
        Expected<TextureImage> read = decode_image(bytes, context_.limits.image_side_px, context_.texels_left);
        if (!read) return context_.error(element, read.error().message);
        decoded = std::move(*read);
        decoded.name = from.uri.empty() ? element : from.uri;
    }
    decoded.srgb = srgb;
    context_.texels_left -= decoded.texel_count();
    scene_.images.push_back(std::move(decoded));
    return slot = static_cast<int>(scene_.images.size()) - 1;
}

}  // namespace macula
