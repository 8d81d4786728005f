#include "scenes/gltf_member.h"

#include <algorithm>
#include <cmath>

namespace macula {

float clamp_factor(GltfContext& context, const std::string& element, const std::string& key, double value,
                   const FactorRange& range) {
    if (value >= range.low && value <= range.high) return static_cast<float>(value);
    const float clamped = value > range.high ? range.high : range.low;
    context.warn(element, key + " is out of range and taken as " + std::to_string(clamped));
    return clamped;
}

void GltfMembers::refuse(const std::string& what) {
    if (!error_) error_ = context_.error(element_, what).value();
}

float GltfMembers::number(const char* key, float otherwise, const FactorRange& range) {
    if (!object_.Has(key)) return otherwise;
    const tinygltf::Value& value = object_.Get(key);
    if (!value.IsNumber()) {
        refuse(std::string(key) + " is not a number");
        return otherwise;
    }
    return clamp_factor(context_, element_, key, value.GetNumberAsDouble(), range);
}

glm::vec3 GltfMembers::color(const char* key, const glm::vec3& otherwise, const FactorRange& range) {
    if (!object_.Has(key)) return otherwise;
    const tinygltf::Value& value = object_.Get(key);
    glm::vec3 color = otherwise;
    if (!value.IsArray() || value.ArrayLen() != 3) {
        refuse(std::string(key) + " is not three numbers");
        return otherwise;
    }
    for (int i = 0; i < 3; ++i) {
        const tinygltf::Value& number = value.Get(i);
        if (!number.IsNumber()) {
            refuse(std::string(key) + " is not three numbers");
            return otherwise;
        }
        color[i] = clamp_factor(context_, element_, key, number.GetNumberAsDouble(), range);
    }
    return color;
}

TextureUse GltfMembers::texture(const char* key, TextureCoding coding) {
    if (!object_.Has(key)) return {};
    const tinygltf::Value& value = object_.Get(key);
    tinygltf::TextureInfo info;
    if (!value.IsObject() || !value.Get("index").IsInt() || (value.Has("texCoord") && !value.Get("texCoord").IsInt())) {
        refuse(std::string(key) + " is not a texture");
        return {};
    }
    info.index = value.Get("index").GetNumberAsInt();
    if (value.Has("texCoord")) info.texCoord = value.Get("texCoord").GetNumberAsInt();
    if (value.Get("extensions").IsObject()) info.extensions = value.Get("extensions").Get<tinygltf::Value::Object>();
    Expected<TextureUse> use = textures_.read(info, coding, element_);
    if (use) return *use;
    if (!error_) error_ = use.error();
    return {};
}

TextureUse GltfMembers::normal_texture(const char* key, float& scale) {
    const TextureUse use = texture(key, TextureCoding::linear);
    if (use.present()) {
        const tinygltf::Value& value = object_.Get(key);
        if (value.Has("scale")) {
            const double number = value.Get("scale").IsNumber() ? value.Get("scale").GetNumberAsDouble() : NAN;
            scale = static_cast<float>(number);
            if (!std::isfinite(scale)) refuse(std::string(key) + ": the scale is not a finite number");
        }
    }
    return use;
}

}  // namespace macula
