#include "scenes/gltf_texture.h"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "scenes/gltf_accessor.h"
#include "scenes/image_file.h"

namespace macula {
namespace {

/// Beyond this a texture coordinate has no fraction left in float.
constexpr double kMaxUv = 1e6;

/// A number of an object; `otherwise` where it is absent, nothing where it is no number.
std::optional<double> number_or(const tinygltf::Value& object, const char* key, double otherwise) {
    if (!object.Has(key)) return otherwise;
    const tinygltf::Value& value = object.Get(key);
    return value.IsNumber() ? std::optional(value.GetNumberAsDouble()) : std::nullopt;
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
    const std::optional<double> angle = number_or(transform, "rotation", 0.0);
    const std::optional<double> uv_set = number_or(transform, "texCoord", use.uv_set);
    if (!offset || !scale || !angle || !uv_set) return false;
    for (int i = 0; i < 2; ++i)
        if (std::abs((*offset)[i]) > kMaxUv || std::abs((*scale)[i]) > kMaxUv) return false;
    const double c = std::cos(*angle);
    const double s = std::sin(*angle);
    use.uv_offset = glm::vec2(*offset);
    use.uv_scale_rotation = glm::vec4(c * scale->x, -s * scale->x, s * scale->y, c * scale->y);
    use.uv_set = *uv_set >= 0.0 && *uv_set < 16.0 ? static_cast<int>(*uv_set) : -1;
    return true;
}

std::optional<TextureWrap> wrap_of(int gl_name) {
    if (gl_name == TINYGLTF_TEXTURE_WRAP_REPEAT) return TextureWrap::repeat;
    if (gl_name == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::clamp_to_edge;
    if (gl_name == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return TextureWrap::mirrored_repeat;
    return std::nullopt;
}

}  // namespace

GltfTextureReader::GltfTextureReader(GltfContext& context, Scene& scene)
    : context_(context),
      scene_(scene),
      images_(context.document.model.images.size(), {-1, -1}),
      unreadable_(context.document.model.images.size(), false) {}

Expected<TextureUse> GltfTextureReader::read(const tinygltf::TextureInfo& info, TextureCoding coding,
                                             const std::string& element) {
    const tinygltf::Model& model = context_.document.model;
    if (info.index < 0 || static_cast<std::size_t>(info.index) >= model.textures.size())
        return context_.error(element, "texture " + std::to_string(info.index) + " does not exist");
    const auto index = static_cast<std::size_t>(info.index);
    const tinygltf::Texture& from = model.textures[index];
    const std::string texture_element = element_name("texture", index, from.name);

    TextureUse use;
    use.uv_set = info.texCoord;
    const auto transform = info.extensions.find("KHR_texture_transform");
    if (transform != info.extensions.end() && !apply_texture_transform(transform->second, use))
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
        // How levels are chosen is the tracer's business: only the magnification filter counts.
        if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) use.filter = TextureFilter::nearest;
    }
    const Expected<int> decoded = image_of(from, texture_element, coding);
    if (!decoded) return tl::unexpected(decoded.error());
    use.image = *decoded;
    return use;
}

Expected<int> GltfTextureReader::image_of(const tinygltf::Texture& texture, const std::string& element,
                                          TextureCoding coding) {
    const auto webp = texture.extensions.find("EXT_texture_webp");
    if (webp != texture.extensions.end()) {
        const tinygltf::Value& source = webp->second.Get("source");
        if (!source.IsInt()) return context_.error(element, "EXT_texture_webp does not name an image");
        const int gltf_image = source.GetNumberAsInt();
        const bool failed_before = gltf_image >= 0 && static_cast<std::size_t>(gltf_image) < unreadable_.size() &&
                                   unreadable_[static_cast<std::size_t>(gltf_image)];
        if (!failed_before || texture.source < 0) {
            Expected<int> decoded = image(gltf_image, coding);
            if (decoded || texture.source < 0) return decoded;
            context_.warn(element, "its WebP image is replaced by image " + std::to_string(texture.source) + " (" +
                                       decoded.error().message + ")");
        }
    }
    if (texture.source < 0) return context_.error(element, "has no PNG, JPEG or WebP image");
    return image(texture.source, coding);
}

Expected<int> GltfTextureReader::image(int gltf_image, TextureCoding coding) {
    if (gltf_image < 0 || static_cast<std::size_t>(gltf_image) >= images_.size())
        return context_.error("image " + std::to_string(gltf_image), "does not exist");
    const auto index = static_cast<std::size_t>(gltf_image);
    const bool srgb = coding == TextureCoding::srgb;
    int& slot = images_[index][srgb ? 1 : 0];
    if (slot >= 0) return slot;

    const tinygltf::Image& from = context_.document.model.images[index];
    const std::string element = element_name("image", index, from.uri.empty() ? from.name : from.uri);
    TextureImage decoded;
    if (const int other = images_[index][srgb ? 0 : 1]; other >= 0) {
        decoded = scene_.images[static_cast<std::size_t>(other)];
        if (decoded.texel_count() > context_.texels_left) return context_.error(element, "too many texels");
    } else {
        Expected<TextureImage> read = decode(index, element);
        unreadable_[index] = !read;
        if (!read) return tl::unexpected(read.error());
        decoded = std::move(*read);
        decoded.name = from.uri.empty() ? element : from.uri;
    }
    decoded.srgb = srgb;
    context_.texels_left -= decoded.texel_count();
    scene_.images.push_back(std::move(decoded));
    return slot = static_cast<int>(scene_.images.size()) - 1;
}

Expected<TextureImage> GltfTextureReader::decode(std::size_t gltf_image, const std::string& element) {
    const tinygltf::Image& from = context_.document.model.images[gltf_image];
    std::span<const std::uint8_t> bytes = context_.document.image_bytes[gltf_image];
    if (from.bufferView >= 0) {
        const Expected<std::span<const std::uint8_t>> view = view_bytes(context_, from.bufferView, element);
        if (!view) return tl::unexpected(view.error());
        bytes = *view;
    }
    if (bytes.empty()) return context_.error(element, "the image file is missing or empty");
    Expected<TextureImage> read = decode_image(bytes, context_.limits.image_side_px, context_.texels_left);
    if (!read) return context_.error(element, read.error().message);
    return read;
}

}  // namespace macula
