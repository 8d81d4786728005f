#include "scenes/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include <glm/common.hpp>

#include "scenes/noise.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

/// Fills an image with `color(u, v)`, the mean of `grid` x `grid` points in each texel.
template <class Color>
TextureImage paint(std::string name, int size_px, int grid, Color color) {
    TextureImage image;
    image.name = std::move(name);
    image.width_px = size_px;
    image.height_px = size_px;
    image.channels = 3;
    image.srgb = true;
    image.texels.reserve(image.texel_count() * image.texel_bytes());
    const float step = 1.0F / static_cast<float>(size_px * grid);
    for (int y = 0; y < size_px; ++y)
        for (int x = 0; x < size_px; ++x) {
            glm::vec3 sum(0.0F);
            for (int j = 0; j < grid; ++j)
                for (int i = 0; i < grid; ++i)
                    sum += color((static_cast<float>(x * grid + i) + 0.5F) * step,
                                 (static_cast<float>(y * grid + j) + 0.5F) * step);
            const glm::vec3 bytes =
                glm::clamp(sum / static_cast<float>(grid * grid), 0.0F, 1.0F) * 255.0F + glm::vec3(0.5F);
            for (int c = 0; c < 3; ++c) image.texels.push_back(static_cast<std::uint8_t>(bytes[c]));
        }
    return image;
}

/// The Sloan letters on their 5 x 5 grid, rows from the top.
constexpr std::array<std::array<std::string_view, 5>, 10> kSloan = {{
    {".####", "##...", "#....", "##...", ".####"},  // C
    {"####.", "#...#", "#...#", "#...#", "####."},  // D
    {"#...#", "#...#", "#####", "#...#", "#...#"},  // H
    {"#..##", "#.##.", "###..", "#.##.", "#..##"},  // K
    {"#...#", "##..#", "#.#.#", "#..##", "#...#"},  // N
    {".###.", "#...#", "#...#", "#...#", ".###."},  // O
    {"####.", "#...#", "####.", "#.##.", "#..##"},  // R
    {".####", "#....", ".###.", "....#", "####."},  // S
    {"#...#", "#...#", ".#.#.", ".#.#.", "..#.."},  // V
    {"#####", "...#.", "..#..", ".#...", "#####"},  // Z
}};

/// Whether the letter has ink at (x, y) in [0, 1)^2.
bool sloan_ink(int letter, float x, float y) {
    if (x < 0.0F || x >= 1.0F || y < 0.0F || y >= 1.0F) return false;
    return kSloan[static_cast<std::size_t>(letter)][static_cast<std::size_t>(y * 5.0F)]
                 [static_cast<std::size_t>(x * 5.0F)] == '#';
}

int random_letter(int x, int y, int seed) {
    return static_cast<int>(hash01(x, y, seed) * 10.0F);
}

constexpr glm::vec3 kInk = glm::vec3(0.06F);
constexpr glm::vec3 kPaper = glm::vec3(0.94F, 0.93F, 0.90F);

}  // namespace

TextureImage make_checkerboard(int size_px, int cells, const TwoColors& colors) {
    const auto n = static_cast<float>(cells);
    return paint("checkerboard", size_px, 1, [&](float u, float v) {
        return (static_cast<int>(u * n) + static_cast<int>(v * n)) % 2 == 0 ? colors.first : colors.second;
    });
}

TextureImage make_stripes(int size_px, int periods, const TwoColors& colors) {
    const auto n = static_cast<float>(2 * periods);
    return paint("stripes", size_px, 1,
                 [&](float u, float) { return static_cast<int>(u * n) % 2 == 0 ? colors.first : colors.second; });
}

TextureImage make_zone_plate(int size_px, float edge_cycles_per_px) {
    // Phase k r^2 has frequency 2 k r / tau cycles per unit; at r = 0.5 that is k / tau.
    const float k = kTau * edge_cycles_per_px * static_cast<float>(size_px);
    return paint("zone plate", size_px, 2, [k](float u, float v) {
        const float x = u - 0.5F;
        const float y = v - 0.5F;
        return glm::vec3(0.5F + 0.45F * std::cos(k * (x * x + y * y)));
    });
}

TextureImage make_siemens_star(int size_px, int spokes) {
    return paint("Siemens star", size_px, 2, [spokes](float u, float v) {
        const float x = u - 0.5F;
        const float y = v - 0.5F;
        if (x * x + y * y > 0.23F) return kPaper;
        return std::sin(std::atan2(y, x) * static_cast<float>(spokes)) > 0.0F ? kInk : kPaper;
    });
}

TextureImage make_bar_chart(int size_px) {
    return paint("bar chart", size_px, 2, [](float u, float v) {
        constexpr float kMargin = 0.05F;
        constexpr float kRows = 12.0F;
        const float y = (v - kMargin) / (1.0F - 2.0F * kMargin) * kRows;
        if (u < kMargin || u > 1.0F - kMargin || y < 0.0F || y >= kRows) return kPaper;
        if (y - std::floor(y) > 0.85F) return kPaper;
        const float periods = 6.0F * std::exp2(0.5F * std::floor(y));
        const float phase = (u - kMargin) / (1.0F - 2.0F * kMargin) * periods;
        return phase - std::floor(phase) < 0.5F ? kInk : kPaper;
    });
}

TextureImage make_sloan_chart(int size_px) {
    return paint("Sloan chart", size_px, 3, [](float u, float v) {
        // Rows of height h and as much space as the row is high, as on an ETDRS chart.
        float top = 0.04F;
        float height = 0.095F;
        for (int row = 0; row < 14; ++row, top += 2.0F * height, height *= 0.794F) {
            if (v < top || v >= top + height) continue;
            const float x = (u - 0.5F) / height + 4.5F;  // five letters and four spaces
            const int cell = static_cast<int>(std::floor(x));
            if (cell < 0 || cell > 8 || cell % 2 != 0) return kPaper;
            const bool ink = sloan_ink(random_letter(cell, row, 7), x - std::floor(x), (v - top) / height);
            return ink ? kInk : kPaper;
        }
        return kPaper;
    });
}

TextureImage make_text_page(int size_px) {
    return paint("text", size_px, 2, [](float u, float v) {
        constexpr float kMargin = 0.08F;
        constexpr float kLines = 32.0F;
        constexpr float kColumns = 44.0F;
        const float y = (v - kMargin) / (1.0F - 2.0F * kMargin) * kLines;
        const float x = (u - kMargin) / (1.0F - 2.0F * kMargin) * kColumns;
        if (x < 0.0F || x >= kColumns || y < 0.0F || y >= kLines) return kPaper;
        const int line = static_cast<int>(y);
        const int column = static_cast<int>(x);
        const bool last_line_of_paragraph = line % 8 == 7;
        const bool space = hash01(column, line, 3) < 0.17F || (last_line_of_paragraph && x > 0.6F * kColumns);
        if (space) return kPaper;
        const float glyph_x = (x - std::floor(x)) / 0.8F;
        const float glyph_y = (y - std::floor(y)) / 0.62F;
        return sloan_ink(random_letter(column, line, 11), glyph_x, glyph_y) ? kInk : kPaper;
    });
}

TextureImage make_bricks(int size_px, const TwoColors& colors) {
    return paint("bricks", size_px, 2, [&](float u, float v) {
        constexpr int kRows = 16;
        constexpr int kBricks = 6;
        const float y = v * static_cast<float>(kRows);
        const int row = static_cast<int>(y);
        const float x = u * static_cast<float>(kBricks) + (row % 2 == 0 ? 0.0F : 0.5F);
        const int brick = static_cast<int>(x) % kBricks;
        const float fx = x - std::floor(x);
        const float fy = y - std::floor(y);
        if (fx < 0.035F || fy < 0.09F) return colors.second;
        const float shade = 0.85F + 0.3F * hash01(brick, row, 5);
        const float grain = 0.94F + 0.12F * value_noise(u * 256.0F, v * 256.0F, 256, 9);
        return colors.first * shade * grain;
    });
}

TextureImage make_wood(int size_px, const TwoColors& colors) {
    return paint("wood", size_px, 1, [&](float u, float v) {
        const float bend = fractal_noise(u, v, 3, 21);
        const float ring = std::sin(kTau * (v * 9.0F + bend * 3.0F)) * 0.5F + 0.5F;
        const float fibre = value_noise(u * 8.0F, v * 256.0F, 256, 33);
        return glm::mix(colors.first, colors.second, glm::clamp(0.75F * ring + 0.35F * fibre, 0.0F, 1.0F));
    });
}

TextureImage make_noise(int size_px, int cells, const TwoColors& colors) {
    return paint("noise", size_px, 1, [&](float u, float v) {
        const float n = fractal_noise(u, v, cells, 41);
        return glm::mix(colors.first, colors.second, glm::clamp((n - 0.25F) * 2.0F, 0.0F, 1.0F));
    });
}

}  // namespace macula
