#include "server/render/texture_levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "server/kernels/color.h"
#include "server/render/parallel_ranges.h"
#include "server/render/texel_read.h"

namespace macula {
namespace {

using glm::ivec2;
using glm::vec3;
using glm::vec4;

/// Weight of colours that nothing covers, so that texels of which all is hidden keep a colour.
constexpr float kHiddenWeight = 1.0F / 1024.0F;

/// Channels of the levels of a normal map.
constexpr int kNormalChannels = 3;

constexpr int kRowsPerTask = 16;

std::size_t area(ivec2 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

/// A level as it is averaged: colours times alpha where covered_color asks for it, mean vectors of normal maps.
struct Pixels {
    ivec2 size_px;
    std::vector<vec4> value;
};

/// Writes row y to an array of the source's width.
using ReadRow = std::function<void(int y, vec4* row)>;

/// Source texels that one texel of a level covers: `count` of them, weights of their shares, sum 1.
struct Cover {
    int first;
    int count;
    float weight[3];
};

/// Of `from` texels that become `to`, which is half as many, rounded down, but at least 1.
Cover cover(int i, int from, int to) {
    if (from == to) return {i, 1, {1.0F, 0.0F, 0.0F}};
    if (from % 2 == 0) return {2 * i, 2, {0.5F, 0.5F, 0.0F}};
    const auto n = static_cast<float>(from);
    const auto share = static_cast<float>(to);
    return {2 * i, 3, {static_cast<float>(to - i) / n, share / n, static_cast<float>(i + 1) / n}};
}

Pixels halve(ivec2 from, const ReadRow& read_row) {
    Pixels result{glm::max(from / 2, ivec2(1)), {}};
    const ivec2 to = result.size_px;
    result.value.resize(area(to));
    parallel_ranges(0, to.y, kRowsPerTask, [&](int begin, int end) {
        std::vector<vec4> row(static_cast<std::size_t>(from.x));
        std::vector<vec4> sum(row.size());
        for (int y = begin; y < end; ++y) {
            const Cover rows = cover(y, from.y, to.y);
            std::fill(sum.begin(), sum.end(), vec4(0.0F));
            for (int j = 0; j < rows.count; ++j) {
                read_row(rows.first + j, row.data());
                for (std::size_t x = 0; x < row.size(); ++x) sum[x] += row[x] * rows.weight[j];
            }
            for (int x = 0; x < to.x; ++x) {
                const Cover columns = cover(x, from.x, to.x);
                vec4 mean(0.0F);
                for (int i = 0; i < columns.count; ++i)
                    mean +=
                        sum[static_cast<std::size_t>(columns.first) + static_cast<std::size_t>(i)] * columns.weight[i];
                result
                    .value[static_cast<std::size_t>(y) * static_cast<std::size_t>(to.x) + static_cast<std::size_t>(x)] =
                    mean;
            }
        }
    });
    return result;
}

ReadRow rows_of(const Pixels& pixels) {
    return [&pixels](int y, vec4* row) {
        const auto width = static_cast<std::size_t>(pixels.size_px.x);
        std::copy_n(pixels.value.data() + static_cast<std::size_t>(y) * width, width, row);
    };
}

vec4 as_averaged(const vec4& texel, TextureContent content) {
    if (content == TextureContent::covered_color) return vec4(vec3(texel) * (texel.w + kHiddenWeight), texel.w);
    if (content == TextureContent::values) return texel;
    const vec3 normal = vec3(texel) * 2.0F - vec3(1.0F);
    const float length = glm::length(normal);
    return length > 0.0F ? vec4(normal / length, 0.0F) : vec4(0.0F, 0.0F, 1.0F, 0.0F);
}

ReadRow rows_of(const TextureImage& image, TextureContent content) {
    return [&image, content](int y, vec4* row) {
        const float* decode = decode_table(image.type, image.srgb && content != TextureContent::normals);
        with_texel_format(image.type, image.channels, [&]<TexelType type, int channels>() {
            constexpr std::size_t kBytes = static_cast<std::size_t>(channels) * byte_count(type);
            const auto width = static_cast<std::size_t>(image.width_px);
            const std::uint8_t* texel = image.texels.data() + static_cast<std::size_t>(y) * width * kBytes;
            for (std::size_t x = 0; x < width; ++x, texel += kBytes)
                row[x] = as_averaged(read_texel<type, channels>(texel, decode), content);
        });
    };
}

/// Share of the image's texels whose alpha reaches the cutoff.
float covered_share(const TextureImage& image, float cutoff) {
    std::vector<vec4> row(static_cast<std::size_t>(image.width_px));
    const ReadRow read_row = rows_of(image, TextureContent::values);
    std::size_t covered = 0;
    for (int y = 0; y < image.height_px; ++y) {
        read_row(y, row.data());
        covered += static_cast<std::size_t>(
            std::count_if(row.begin(), row.end(), [cutoff](const vec4& texel) { return texel.w >= cutoff; }));
    }
    return static_cast<float>(covered) / static_cast<float>(image.texel_count());
}

/// Factor of a level's alpha that makes the given share of its texels reach the cutoff, as nearly as they can be told
/// apart.
float alpha_scale(const Pixels& level, float share, float cutoff) {
    std::vector<float> alpha(level.value.size());
    std::transform(level.value.begin(), level.value.end(), alpha.begin(), [](const vec4& texel) { return texel.w; });
    const auto wanted = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<float>(alpha.size())));
    std::sort(alpha.begin(), alpha.end(), std::greater<>());
    const auto count = static_cast<std::ptrdiff_t>(alpha.size());
    const float last_in = wanted > 0 ? alpha[static_cast<std::size_t>(wanted - 1)] : 2.0F;
    const float first_out = wanted < count ? alpha[static_cast<std::size_t>(wanted)] : 0.0F;
    if ((last_in >= cutoff && first_out < cutoff) || last_in <= 0.0F) return 1.0F;
    // In the middle between the two, or, of a level all in or all out, just enough.
    if (wanted == 0) return 0.99F * cutoff / first_out;
    return wanted == count ? cutoff / last_in * 1.01F : 2.0F * cutoff / (last_in + first_out);
}

void write_value(std::uint8_t* to, TexelType type, float value, bool srgb) {
    if (type == TexelType::f32) {
        std::memcpy(to, &value, sizeof(value));
        return;
    }
    if (type == TexelType::f16) {
        const std::uint16_t code = glm::packHalf1x16(value);
        std::memcpy(to, &code, sizeof(code));
        return;
    }
    const float coded = srgb ? kernels::srgb_from_linear(value) : glm::clamp(value, 0.0F, 1.0F);
    if (type == TexelType::u8) {
        *to = static_cast<std::uint8_t>(kernels::byte_from_unit(coded));
    } else {
        const auto code = static_cast<std::uint16_t>(std::lround(coded * 65535.0F));
        std::memcpy(to, &code, sizeof(code));
    }
}

void write_colors(const Pixels& level, const TextureImage& image, TextureContent content, float alpha_factor,
                  std::uint8_t* to) {
    const std::size_t bytes = byte_count(image.type);
    const int colors = image.channels < 3 ? 1 : 3;
    for (const vec4& pixel : level.value) {
        vec4 texel = pixel;
        if (content == TextureContent::covered_color) texel = vec4(vec3(pixel) / (pixel.w + kHiddenWeight), pixel.w);
        for (int c = 0; c < colors; ++c, to += bytes) write_value(to, image.type, texel[c], image.srgb);
        if (image.channels % 2 == 1) continue;
        write_value(to, image.type, std::min(texel.w * alpha_factor, 1.0F), false);
        to += bytes;
    }
}

void write_normals(const Pixels& level, std::uint8_t* to) {
    for (const vec4& pixel : level.value) {
        const vec3 mean(pixel);
        const float length = glm::length(mean);
        const vec3 normal = length > 0.0F ? mean / length : vec3(0.0F, 0.0F, 1.0F);
        *to++ = static_cast<std::uint8_t>(kernels::byte_from_unit(normal.x * 0.5F + 0.5F));
        *to++ = static_cast<std::uint8_t>(kernels::byte_from_unit(normal.y * 0.5F + 0.5F));
        *to++ = static_cast<std::uint8_t>(kernels::byte_from_unit(std::sqrt(lost_variance(length))));
    }
}

}  // namespace

float lost_variance(float mean_length) {
    // Kappa = r (3 - r^2) / (1 - r^2). A direction's variance on each axis is then 1 / kappa, and GGX's alpha squared
    // twice the variance of a slope, as Beckmann's is.
    const float r = glm::clamp(mean_length, 1e-3F, 1.0F);
    const float r_sq = r * r;
    return std::min(2.0F * (1.0F - r_sq) / (r * (3.0F - r_sq)), 1.0F);
}

TextureLevels::TextureLevels(const TextureImage& image, TextureContent content, float alpha_cutoff) {
    const bool normals = content == TextureContent::normals;
    const std::size_t texel_bytes = normals ? kNormalChannels : image.texel_bytes();
    const ivec2 full(image.width_px, image.height_px);
    std::size_t bytes = 0;
    for (ivec2 size = full; size != ivec2(1);) {
        size = glm::max(size / 2, ivec2(1));
        bytes += area(size) * texel_bytes;
    }
    texels_.resize(bytes);
    levels_.push_back({image.texels.data(), full});
    const bool keeps_coverage = alpha_cutoff > 0.0F && image.channels % 2 == 0;
    const float share = keeps_coverage ? covered_share(image, alpha_cutoff) : 0.0F;
    Pixels pixels;
    std::uint8_t* to = texels_.data();
    while (levels_.back().size_px != ivec2(1)) {
        pixels = levels_.size() == 1 ? halve(full, rows_of(image, content)) : halve(pixels.size_px, rows_of(pixels));
        if (normals) {
            write_normals(pixels, to);
        } else {
            const float factor = keeps_coverage ? alpha_scale(pixels, share, alpha_cutoff) : 1.0F;
            write_colors(pixels, image, content, factor, to);
        }
        levels_.push_back({to, pixels.size_px});
        to += area(pixels.size_px) * texel_bytes;
    }
}

}  // namespace macula
