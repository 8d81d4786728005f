#pragma once

#include <limits>
#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "scenes/gltf_document.h"
#include "scenes/gltf_texture.h"

namespace macula {

/// Values that a factor may have; others are clamped.
struct FactorRange {
    float low = 0.0F;
    float high = 1.0F;
};
inline constexpr FactorRange kShare = {0.0F, 1.0F};
inline constexpr FactorRange kNotNegative = {0.0F, std::numeric_limits<float>::max()};

/// Reads members of one JSON object of `element`, such as a material's extension. A member that is absent gives the
/// default; one that is out of range is clamped with a warning; the first that is malformed makes an error, and reading
/// goes on with defaults, so that callers ask once, at the end.
class GltfMembers {
public:
    GltfMembers(GltfContext& context, GltfTextureReader& textures, const tinygltf::Value& object, std::string element)
        : context_(context), textures_(textures), object_(object), element_(std::move(element)) {}

    float number(const char* key, float otherwise, const FactorRange& range);
    glm::vec3 color(const char* key, const glm::vec3& otherwise, const FactorRange& range);
    TextureUse texture(const char* key, TextureCoding coding);
    /// A normalTextureInfo, which has a scale.
    TextureUse normal_texture(const char* key, float& scale);

    [[nodiscard]] Expected<void> result() const {
        return error_ ? Expected<void>(tl::unexpected(*error_)) : Expected<void>();
    }

private:
    void refuse(const std::string& what);
    float clamped(const char* key, double value, const FactorRange& range);

    GltfContext& context_;
    GltfTextureReader& textures_;
    const tinygltf::Value& object_;
    std::string element_;
    std::optional<Error> error_;
};

/// `value` within `range`, with a warning where it was not. Not a number gives the range's low end.
float clamp_factor(GltfContext& context, const std::string& element, const std::string& key, double value,
                   const FactorRange& range);

}  // namespace macula
