#include "server/render/environment.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "server/render/parallel_ranges.h"
#include "server/render/texel_read.h"

namespace macula {
namespace {

using glm::ivec2;
using glm::vec2;
using glm::vec3;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kTau = 2.0F * kPi;

/// Least height of a size; coarser ones would have no texels away from the poles.
constexpr int kLeastHeight_px = 4;

/// A prefiltered map, with texels of less than half the lobe's width. Its alpha is half that of the next one.
struct Lobe {
    float roughness;
    int height_px;
};
constexpr std::array<Lobe, 8> kLobes = {
    {{0.1F, 256}, {0.14F, 128}, {0.2F, 128}, {0.28F, 64}, {0.4F, 64}, {0.56F, 32}, {0.79F, 32}, {1.0F, 32}}};

/// Height of the map that lobes are summed over, a power of two.
constexpr int kSourceHeight_px = 256;

/// Blocks of directions are summed as one where they are smaller than this share of the lobe's width and distance.
constexpr float kBlockTolerance = 0.5F;

/// Largest edge of blocks that the horizon cuts, of a lobe of alpha 1; narrower lobes have little to lose there.
constexpr float kHorizonBlock_rad = 0.1F;

/// Direction of a map's coordinates, in the map's own space.
vec3 lat_long_direction(vec2 uv) {
    const float phi = uv.x * kTau;
    const float theta = uv.y * kPi;
    return {-std::sin(phi) * std::sin(theta), std::cos(theta), std::cos(phi) * std::sin(theta)};
}

/// Height of row y on the unit sphere, which its texels' solid angles are proportional to.
float row_weight(int y, int height) {
    const auto n = static_cast<float>(height);
    return std::cos(kPi * static_cast<float>(y) / n) - std::cos(kPi * static_cast<float>(y + 1) / n);
}

/// GGX's distribution of half vectors (Walter et al. 2007, eq. 33) but for a constant, times the cosine, of light at an
/// angle from the mirror direction where that is normal and view: the half vector has half the angle.
float lobe_weight(float cosine, float alpha_sq) {
    const float d = (alpha_sq - 1.0F) * (1.0F + cosine) * 0.5F + 1.0F;
    return std::max(cosine, 0.0F) / (d * d);
}

/// A block of directions: a texel of one of the halves of a map.
struct Block {
    vec3 direction;  ///< unit, of its middle
    float solid_angle;
    vec3 light_direction;  ///< unit, of the middle of its light
    float brightness;      ///< sum of the light's channels
    vec3 light;            ///< radiance times solid angle

    Block& operator+=(const Block& other) {
        direction += other.direction * other.solid_angle;
        solid_angle += other.solid_angle;
        light_direction += other.light_direction * other.brightness;
        brightness += other.brightness;
        light += other.light;
        return *this;
    }
};

/// Blocks of a lat-long map whose sides are powers of two, the finest first; each block is four of the size before.
class BlockTree {
public:
    /// `radiance(x, y)` is that of the finest blocks.
    template <class Radiance>
    BlockTree(int height, Radiance&& radiance) : height_(height) {
        for (int rows = height; rows >= kLeastHeight_px; rows /= 2) {
            std::vector<Block> blocks;
            blocks.reserve(2 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(rows));
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < 2 * rows; ++x)
                    blocks.push_back(level_.empty() ? finest(x, y, radiance(x, y)) : joined(x, y, 4 * rows));
            level_.push_back(std::move(blocks));
        }
    }

    /// Mean radiance weighted by GGX's distribution of half vectors around `axis`, which is normal and view, and by the
    /// cosine. A block's light is taken as coming from the middle of it.
    [[nodiscard]] vec3 mean_of_lobe(const vec3& axis, float roughness) const {
        Sum sum{axis, roughness * roughness * roughness * roughness, vec3(0.0F), 0.0F};
        const int top = static_cast<int>(level_.size()) - 1;
        const int rows = height_ >> top;
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < 2 * rows; ++x) add(top, x, y, sum);
        return sum.light / sum.weight;
    }

private:
    struct Sum {
        vec3 axis;
        float alpha_sq;
        vec3 light;
        float weight;
    };

    [[nodiscard]] Block finest(int x, int y, const vec3& radiance) const {
        const vec3 direction = lat_long_direction((vec2(x, y) + vec2(0.5F)) / vec2(2 * height_, height_));
        const float solid_angle = row_weight(y, height_) * kPi / static_cast<float>(height_);
        const vec3 light = radiance * solid_angle;
        return {direction, solid_angle, direction, light.x + light.y + light.z, light};
    }

    /// Of the four blocks that are a block of the next size, whose rows have `width`.
    [[nodiscard]] Block joined(int x, int y, int width) const {
        const Block* upper = level_.back().data() + std::ptrdiff_t{2} * (std::ptrdiff_t{y} * width + x);
        Block block{};
        for (const Block* row : {upper, upper + width})
            for (int i = 0; i < 2; ++i) block += row[i];
        block.direction = glm::normalize(block.direction);
        block.light_direction = block.brightness > 0.0F ? glm::normalize(block.light_direction) : block.direction;
        return block;
    }

    void add(int level, int x, int y, Sum& sum) const {
        const int rows = height_ >> level;
        const Block& block =
            level_[static_cast<std::size_t>(level)]
                  [static_cast<std::size_t>(y) * static_cast<std::size_t>(2 * rows) + static_cast<std::size_t>(x)];
        const float cosine = glm::dot(sum.axis, block.direction);
        const float edge = kPi / static_cast<float>(rows);
        if (cosine < -edge) return;  // all of it is behind the surface
        // The lobe falls to a quarter at 2 alpha, and beyond changes over distances like the one to its middle.
        const float scale_sq = 4.0F * sum.alpha_sq + 2.0F * (1.0F - cosine);
        const bool rises = cosine < edge && edge * sum.alpha_sq > kHorizonBlock_rad;
        if (level > 0 && (rises || edge * edge > kBlockTolerance * kBlockTolerance * scale_sq)) {
            for (int j = 0; j < 2; ++j)
                for (int i = 0; i < 2; ++i) add(level - 1, 2 * x + i, 2 * y + j, sum);
            return;
        }
        sum.light += block.light * lobe_weight(glm::dot(sum.axis, block.light_direction), sum.alpha_sq);
        sum.weight += block.solid_angle * lobe_weight(cosine, sum.alpha_sq);
    }

    int height_;
    std::vector<std::vector<Block>> level_;
};

/// Texels of a row or column of `from` that the i-th of `to` covers: [first, last), and how much of one.
struct Cover {
    int first;
    int last;
    float begin;
    float end;

    Cover(int i, int from, int to)
        : begin(static_cast<float>(i) * static_cast<float>(from) / static_cast<float>(to)),
          end(static_cast<float>(i + 1) * static_cast<float>(from) / static_cast<float>(to)) {
        first = static_cast<int>(begin);
        last = std::min(static_cast<int>(std::ceil(end)), from);
    }
    [[nodiscard]] float share(int k) const {
        return std::max(std::min(static_cast<float>(k + 1), end) - std::max(static_cast<float>(k), begin), 0.0F);
    }
};

}  // namespace

EnvironmentMap::EnvironmentMap(const TextureImage& image, float intensity, float rotation_rad)
    : image_(&image), intensity_(intensity), rotation_rad_(rotation_rad) {
    size_.push_back({{image.width_px, image.height_px}, {}});
    set_poles(size_.back());
    while (size_.back().size_px.y / 2 >= kLeastHeight_px && size_.back().size_px.x >= 2)
        size_.push_back(halve(size_.back()));
    find_lobes();
    find_harmonics();
}

vec3 EnvironmentMap::texel(const LatLongLevel& level, std::size_t index) const noexcept {
    if (!level.texel.empty()) return level.texel[index];
    const std::uint8_t* bytes = image_->texels.data() + index * image_->texel_bytes();
    const float* decode = decode_table(image_->type, image_->srgb);
    return with_texel_format(image_->type, image_->channels, [&]<TexelType type, int channels>() {
        return vec3(read_texel<type, channels>(bytes, decode));
    });
}

vec3 EnvironmentMap::row_at(const LatLongLevel& level, int y, float x) const noexcept {
    const float left = std::floor(x);
    const int x0 = static_cast<int>(left);
    const int width = level.size_px.x;
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    const auto column = [width](int i) { return static_cast<std::size_t>(i < 0 ? width - 1 : (i < width ? i : 0)); };
    return glm::mix(texel(level, row + column(x0)), texel(level, row + column(x0 + 1)), x - left);
}

vec3 EnvironmentMap::read(const LatLongLevel& level, vec2 uv) const noexcept {
    const float x = uv.x * static_cast<float>(level.size_px.x) - 0.5F;
    const float y = uv.y * static_cast<float>(level.size_px.y) - 0.5F;
    const int last = level.size_px.y - 1;
    // Between the pole and the middle of the row next to it.
    if (y < 0.0F) return glm::mix(row_at(level, 0, x), level.north, -2.0F * y);
    const float beyond = y - static_cast<float>(last);
    if (beyond >= 0.0F) return glm::mix(row_at(level, last, x), level.south, 2.0F * beyond);
    const float top = std::floor(y);
    const int y0 = static_cast<int>(top);
    return glm::mix(row_at(level, y0, x), row_at(level, y0 + 1, x), y - top);
}

vec3 EnvironmentMap::read_cone(vec2 uv, float width_rad) const noexcept {
    const float texels = width_rad * static_cast<float>(size_[0].size_px.y) * (1.0F / kPi);
    if (!(texels > 1.0F)) return read(size_[0], uv);
    const float level = std::min(std::log2(texels), static_cast<float>(size_.size() - 1));
    const auto first = static_cast<std::size_t>(level);
    const float weight = level - static_cast<float>(first);
    const vec3 finer = read(size_[first], uv);
    return weight > 0.0F ? glm::mix(finer, read(size_[first + 1], uv), weight) : finer;
}

vec3 EnvironmentMap::read_lobe(vec2 uv, float roughness) const noexcept {
    const float first = kLobes.front().roughness;
    if (roughness < first) {
        // Below the first lobe: a cone of its width at half its height, and towards its end the lobe itself.
        const float alpha = roughness * roughness;
        const float share = alpha / (first * first);
        return glm::mix(read_cone(uv, 4.0F * 0.644F * alpha), read(lobe_[0], uv), share * share);
    }
    std::size_t i = 1;
    while (i + 1 < kLobes.size() && kLobes[i].roughness < roughness) ++i;
    // Two lobes mixed so that their peak, which goes with alpha^-2, is right.
    const auto peak = [](float r) { return 1.0F / (r * r * r * r); };
    const float from = peak(kLobes[i - 1].roughness);
    const float weight = (peak(std::min(roughness, 1.0F)) - from) / (peak(kLobes[i].roughness) - from);
    return glm::mix(read(lobe_[i - 1], uv), read(lobe_[i], uv), weight);
}

vec3 EnvironmentMap::radiance(const vec3& direction, float width_rad) const noexcept {
    return read_cone(kernels::lat_long_uv(direction, rotation_rad_), width_rad) * intensity_;
}

vec3 EnvironmentMap::glossy_radiance(const vec3& direction, float roughness) const noexcept {
    return read_lobe(kernels::lat_long_uv(direction, rotation_rad_), roughness) * intensity_;
}

void EnvironmentMap::set_poles(LatLongLevel& level) const {
    const auto width = static_cast<std::size_t>(level.size_px.x);
    const std::size_t last = (static_cast<std::size_t>(level.size_px.y) - 1) * width;
    glm::dvec3 north(0.0);
    glm::dvec3 south(0.0);
    for (std::size_t x = 0; x < width; ++x) {
        north += glm::dvec3(texel(level, x));
        south += glm::dvec3(texel(level, last + x));
    }
    level.north = vec3(north / static_cast<double>(width));
    level.south = vec3(south / static_cast<double>(width));
}

vec3 EnvironmentMap::mean(const LatLongLevel& level, const ivec2& at, const ivec2& size_px) const {
    const Cover rows(at.y, level.size_px.y, size_px.y);
    const Cover columns(at.x, level.size_px.x, size_px.x);
    vec3 sum(0.0F);
    float weights = 0.0F;
    for (int y = rows.first; y < rows.last; ++y) {
        const float row = rows.share(y) * row_weight(y, level.size_px.y);
        const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(level.size_px.x);
        for (int x = columns.first; x < columns.last; ++x) {
            const float weight = row * columns.share(x);
            sum += texel(level, first + static_cast<std::size_t>(x)) * weight;
            weights += weight;
        }
    }
    return sum / weights;
}

template <class Radiance>
LatLongLevel EnvironmentMap::painted(const ivec2& size_px, Radiance&& radiance) const {
    LatLongLevel level{size_px, {}};
    const auto width = static_cast<std::size_t>(size_px.x);
    level.texel.resize(width * static_cast<std::size_t>(size_px.y));
    parallel_ranges(0, size_px.y, 2, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < size_px.x; ++x)
                level.texel[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = radiance(x, y);
    });
    set_poles(level);
    return level;
}

LatLongLevel EnvironmentMap::halve(const LatLongLevel& level) const {
    const ivec2 size = level.size_px / 2;
    return painted(size, [&](int x, int y) { return mean(level, {x, y}, size); });
}

void EnvironmentMap::find_lobes() {
    // Of the smallest size that has the rows; a smaller image's texels are as many blocks.
    std::size_t size = 0;
    while (size + 1 < size_.size() && size_[size + 1].size_px.y >= kSourceHeight_px) ++size;
    const int rows = std::min(
        kSourceHeight_px,
        static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(2 * image_->height_px, kLeastHeight_px)))));
    const BlockTree tree(rows, [&](int x, int y) { return mean(size_[size], {x, y}, {2 * rows, rows}); });
    for (const Lobe& lobe : kLobes) {
        const int height = std::min(lobe.height_px, rows);
        const ivec2 size_px(2 * height, height);
        lobe_.push_back(painted(size_px, [&](int x, int y) {
            return tree.mean_of_lobe(lat_long_direction((vec2(x, y) + vec2(0.5F)) / vec2(size_px)), lobe.roughness);
        }));
    }
}

void EnvironmentMap::find_harmonics() {
    // Of the size that has at least 64 rows, where there is one: halving keeps the light of every block of directions.
    std::size_t coarse = 0;
    while (coarse + 1 < size_.size() && size_[coarse + 1].size_px.y >= 64) ++coarse;
    const LatLongLevel& level = size_[coarse];
    std::array<glm::dvec3, 9> light{};
    for (int y = 0; y < level.size_px.y; ++y) {
        const double solid_angle = double{row_weight(y, level.size_px.y)} * kTau / level.size_px.x;
        for (int x = 0; x < level.size_px.x; ++x) {
            const vec2 uv = (vec2(x, y) + vec2(0.5F)) / vec2(level.size_px);
            // The map turned by its rotation: u of the world's direction is less by it.
            const vec3 n = lat_long_direction(vec2(uv.x - rotation_rad_ / kTau, uv.y));
            const glm::dvec3 l =
                glm::dvec3(texel(level, static_cast<std::size_t>(y) * static_cast<std::size_t>(level.size_px.x) +
                                            static_cast<std::size_t>(x))) *
                (solid_angle * intensity_);
            const std::array<double, 9> basis = {
                1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y};
            for (std::size_t i = 0; i < basis.size(); ++i) light[i] += l * basis[i];
        }
    }
    // Squares of the harmonics' constants times the cosine's factors pi, 2 pi / 3 and pi / 4.
    const auto term = [&light](std::size_t i, double factor) { return vec3(light[i] * factor); };
    harmonics_ = {term(0, 1.0 / 4.0),  term(1, 1.0 / 2.0),   term(2, 1.0 / 2.0),
                  term(3, 1.0 / 2.0),  term(4, 15.0 / 16.0), term(5, 15.0 / 16.0),
                  term(6, 5.0 / 64.0), term(7, 15.0 / 16.0), term(8, 15.0 / 64.0)};
}

std::size_t EnvironmentMap::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto* levels : {&size_, &lobe_})
        for (const LatLongLevel& level : *levels) bytes += level.texel.capacity() * sizeof(vec3);
    return bytes;
}

}  // namespace macula
