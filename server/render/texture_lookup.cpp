#include "server/render/texture_lookup.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "server/render/texel_read.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;

/// Levels nearer to a whole number than this are read as it: half the work, and a step that does not show. Always
/// reading the nearest level alone would lose 1 dB and shimmer a tenth more (shimmer_bench).
constexpr float kSameLevel = 1.0F / 16.0F;

int kernel_wrap(TextureWrap wrap) {
    if (wrap == TextureWrap::clamp_to_edge) return kernels::kWrapClampToEdge;
    return wrap == TextureWrap::mirrored_repeat ? kernels::kWrapMirroredRepeat : kernels::kWrapRepeat;
}

/// The four texels of a level around wrapped coordinates, mixed.
template <TexelType type, int channels>
vec4 read_level(const TextureView& t, const TextureLevel& level, bool nearest, vec2 at) {
    constexpr std::size_t kBytes = static_cast<std::size_t>(channels) * byte_count(type);
    const kernels::TexelFootprint f = kernels::level_footprint(level.size_px, t.lookup.wrap, nearest, at);
    const std::size_t row_bytes = static_cast<std::size_t>(level.size_px.x) * kBytes;
    const std::uint8_t* upper = level.texels + static_cast<std::size_t>(f.y.x) * row_bytes;
    const std::uint8_t* lower = level.texels + static_cast<std::size_t>(f.y.y) * row_bytes;
    const std::size_t left = static_cast<std::size_t>(f.x.x) * kBytes;
    const std::size_t right = static_cast<std::size_t>(f.x.y) * kBytes;
    if (nearest) return read_texel<type, channels>(upper + left, t.decode);
    return kernels::mix_texels(
        f, read_texel<type, channels>(upper + left, t.decode), read_texel<type, channels>(upper + right, t.decode),
        read_texel<type, channels>(lower + left, t.decode), read_texel<type, channels>(lower + right, t.decode));
}

/// Two neighbouring levels and how much the second one counts.
struct LevelPair {
    int first;
    float second_weight;  ///< 0: the second one may not exist
};

LevelPair level_pair(const TextureView& texture, float level) {
    const float bounded = std::min(level, static_cast<float>(texture.level_count - 1));
    const int first = static_cast<int>(bounded);
    const float weight = bounded - static_cast<float>(first);
    if (weight < kSameLevel) return {first, 0.0F};
    return weight > 1.0F - kSameLevel ? LevelPair{first + 1, 0.0F} : LevelPair{first, weight};
}

template <TexelType type, int channels>
vec4 look_up_as(const TextureView& t, vec2 at, const kernels::TapPlan& plan) {
    const LevelPair pair = level_pair(t, plan.level);
    const TextureLevel* level = t.levels + pair.first;
    vec4 sum(0.0F);
    at += plan.first;
    for (int tap = 0; tap < plan.count; ++tap, at += plan.step) {
        const vec2 wrapped = kernels::wrap_coordinates(at, t.lookup.wrap);
        vec4 texel = read_level<type, channels>(t, level[0], false, wrapped);
        if (pair.second_weight > 0.0F)
            texel = glm::mix(texel, read_level<type, channels>(t, level[1], false, wrapped), pair.second_weight);
        sum += texel;
    }
    return sum * (1.0F / static_cast<float>(plan.count));
}

/// Whether one tap at level 0 is all.
bool is_magnified(const kernels::TapPlan& plan) {
    return plan.count == 1 && plan.level <= 0.0F;
}

vec3 unit_or_up(const vec3& v) {
    const float length_sq = glm::dot(v, v);
    return length_sq > 1e-12F ? v * (1.0F / std::sqrt(length_sq)) : vec3(0.0F, 0.0F, 1.0F);
}

/// x and y of the mean normal around wrapped coordinates, and the variance around it, from a level below the image.
vec3 read_mean_normal(const TextureView& t, const TextureLevel& level, vec2 at) {
    constexpr std::size_t kBytes = 3;
    const kernels::TexelFootprint f = kernels::level_footprint(level.size_px, t.lookup.wrap, false, at);
    const auto texel = [&](int x, int y) {
        const std::uint8_t* codes =
            level.texels + kBytes * (static_cast<std::size_t>(y) * static_cast<std::size_t>(level.size_px.x) +
                                     static_cast<std::size_t>(x));
        const auto deviation = static_cast<float>(codes[2]);
        return vec4(codes[0], codes[1], deviation * deviation, 0.0F);
    };
    const vec4 codes =
        kernels::mix_texels(f, texel(f.x.x, f.y.x), texel(f.x.y, f.y.x), texel(f.x.x, f.y.y), texel(f.x.y, f.y.y));
    return {codes.x * (2.0F / 255.0F) - 1.0F, codes.y * (2.0F / 255.0F) - 1.0F, codes.z * (1.0F / (255.0F * 255.0F))};
}

/// The same of any level; the image itself has no variance.
vec3 read_normal(const TextureView& t, int level, vec2 at) {
    if (level > 0) return read_mean_normal(t, t.levels[level], at);
    const vec4 texel = with_texel_format(t.type, t.channels, [&]<TexelType type, int channels>() {
        return read_level<type, channels>(t, t.levels[0], false, at);
    });
    return vec3(vec2(unit_or_up(vec3(texel) * 2.0F - vec3(1.0F))), 0.0F);
}

}  // namespace

TextureView TextureLibrary::view(const TextureUse& use, const TextureImage& image, TextureContent content,
                                 float alpha_cutoff) {
    std::unique_ptr<TextureLevels>& levels = levels_[{&image, content, alpha_cutoff}];
    if (!levels) levels = std::make_unique<TextureLevels>(image, content, alpha_cutoff);
    TextureView view;
    view.lookup.uv_scale_rotation = use.uv_scale_rotation;
    view.lookup.uv_offset = use.uv_offset;
    view.lookup.size_px = {image.width_px, image.height_px};
    view.lookup.wrap = {kernel_wrap(use.wrap_u), kernel_wrap(use.wrap_v)};
    view.lookup.nearest = use.filter == TextureFilter::nearest ? 1 : 0;
    view.levels = levels->levels().data();
    view.level_count = static_cast<int>(levels->levels().size());
    view.channels = image.channels;
    view.type = image.type;
    view.decode = decode_table(image.type, image.srgb && content != TextureContent::normals);
    return view;
}

std::size_t TextureLibrary::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& [key, levels] : levels_) bytes += levels->memory_bytes();
    return bytes;
}

vec4 look_up(const TextureView& texture, vec2 uv) noexcept {
    const vec2 wrapped = kernels::wrap_coordinates(kernels::transform_uv(texture.lookup, uv), texture.lookup.wrap);
    return with_texel_format(texture.type, texture.channels, [&]<TexelType type, int channels>() {
        return read_level<type, channels>(texture, texture.levels[0], texture.lookup.nearest == 1, wrapped);
    });
}

vec4 look_up(const TextureView& texture, vec2 uv, const kernels::UvFootprint& footprint) noexcept {
    const kernels::TapPlan plan = kernels::plan_taps(texture.lookup, footprint);
    if (is_magnified(plan)) return look_up(texture, uv);
    const vec2 at = kernels::transform_uv(texture.lookup, uv);
    return with_texel_format(texture.type, texture.channels, [&]<TexelType type, int channels>() {
        return look_up_as<type, channels>(texture, at, plan);
    });
}

NormalLookup look_up_normal(const TextureView& texture, vec2 uv, const kernels::UvFootprint& footprint) noexcept {
    const kernels::TapPlan plan = kernels::plan_taps(texture.lookup, footprint);
    if (is_magnified(plan)) return {unit_or_up(vec3(look_up(texture, uv)) * 2.0F - vec3(1.0F)), 0.0F};
    vec2 at = kernels::transform_uv(texture.lookup, uv);
    const LevelPair pair = level_pair(texture, plan.level);
    vec3 normals(0.0F);
    float variances = 0.0F;
    at += plan.first;
    for (int tap = 0; tap < plan.count; ++tap, at += plan.step) {
        const vec2 wrapped = kernels::wrap_coordinates(at, texture.lookup.wrap);
        vec3 normal = read_normal(texture, pair.first, wrapped);
        if (pair.second_weight > 0.0F)
            normal = glm::mix(normal, read_mean_normal(texture, texture.levels[pair.first + 1], wrapped),
                              pair.second_weight);
        const float z_sq = 1.0F - normal.x * normal.x - normal.y * normal.y;
        normals += vec3(normal.x, normal.y, std::sqrt(std::max(z_sq, 0.0F)));
        variances += normal.z;
    }
    // What the taps differ by is lost, too.
    const float share = 1.0F / static_cast<float>(plan.count);
    const float between = plan.count > 1 ? lost_variance(glm::length(normals) * share) : 0.0F;
    return {unit_or_up(normals), std::min(variances * share + between, 1.0F)};
}

}  // namespace macula
