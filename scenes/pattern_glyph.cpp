#include "scenes/pattern_glyph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/pattern_paint.h"

namespace macula {
namespace {

/// Polylines of a letter: points as two digits, column 0..4 and row 0..6 from below; spaces between polylines.
struct Glyph {
    char letter;
    std::string_view strokes;
};
constexpr std::array<Glyph, 42> kGlyphs = {{
    {'A', "002640 1232"},
    {'B', "00063645443303 3342413000"},
    {'C', "4536160501103041"},
    {'D', "00062644422000"},
    {'E', "40000646 0333"},
    {'F', "000646 0333"},
    {'G', "45361605011030414323"},
    {'H', "0006 4046 0343"},
    {'I', "2026"},
    {'J', "0110304146"},
    {'K', "0006 460340"},
    {'L', "060040"},
    {'M', "0006234640"},
    {'N', "00064046"},
    {'O', "100105163645413010"},
    {'P', "00063645443303"},
    {'Q', "100105163645413010 2240"},
    {'R', "00063645443303 2340"},
    {'S', "453616050413334241301001"},
    {'T', "0646 2620"},
    {'U', "060110304146"},
    {'V', "062046"},
    {'W', "0610233046"},
    {'X', "0046 0640"},
    {'Y', "062346 2320"},
    {'Z', "06460040"},
    {'0', "100105163645413010"},
    {'1', "152620"},
    {'2', "05163645440040"},
    {'3', "0516364544334241301001 1333"},
    {'4', "30360242"},
    {'5', "460603334241301001"},
    {'6', "4536160501103041423303"},
    {'7', "064610"},
    {'8', "13334445361605041302011030414233"},
    {'9', "0110304145361605041343"},
    {'-', "1333"},
    {'.', "2020"},
    {'/', "0046"},
    {':', "2424 2121"},
    {'!', "2622 2020"},
    {'+', "1333 2224"},
}};
constexpr std::string_view kClosedLetters = "ABDOPQR04689";
constexpr float kUnit = 1.0F / 6.0F;      // grid cell in letter heights
constexpr float kAdvance = 5.6F * kUnit;  // from letter to letter

std::string_view strokes_of(char letter) {
    const auto found =
        std::find_if(kGlyphs.begin(), kGlyphs.end(), [letter](const Glyph& g) { return g.letter == letter; });
    return found == kGlyphs.end() ? std::string_view() : found->strokes;
}

float segment_distance(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 d = b - a;
    const float length_sq = glm::dot(d, d);
    const float t = length_sq > 0.0F ? glm::clamp(glm::dot(p - a, d) / length_sq, 0.0F, 1.0F) : 0.0F;
    return glm::length(p - a - t * d);
}

/// Distance to a letter's strokes in grid cells.
float stroke_distance(std::string_view strokes, const glm::vec2& p) {
    float nearest = 1e9F;
    const auto point = [&](std::size_t i) { return glm::vec2(strokes[i] - '0', strokes[i + 1] - '0'); };
    for (std::size_t i = 0; i + 3 < strokes.size(); i += 2) {
        if (strokes[i + 2] == ' ') {
            i += 1;  // the next polyline begins behind the space
            continue;
        }
        nearest = std::min(nearest, segment_distance(p, point(i), point(i + 2)));
    }
    return nearest;
}

}  // namespace

float text_width(std::string_view text) {
    return text.empty() ? 0.0F : static_cast<float>(text.size()) * kAdvance - 1.6F * kUnit;
}

float text_ink(std::string_view text, const glm::vec2& at, float half_stroke, float soft, bool stencil) {
    const float place = std::floor((at.x + 0.8F * kUnit) / kAdvance);
    if (place < 0.0F || place >= static_cast<float>(text.size())) return 0.0F;
    const char letter = text[static_cast<std::size_t>(place)];
    const std::string_view strokes = strokes_of(letter);
    if (strokes.empty()) return 0.0F;
    const glm::vec2 p((at.x - place * kAdvance) / kUnit, at.y / kUnit);
    float ink = 1.0F - ramp(half_stroke - soft, half_stroke + soft, stroke_distance(strokes, p) * kUnit);
    if (stencil && kClosedLetters.find(letter) != std::string_view::npos)
        ink *= ramp(0.22F, 0.32F, std::abs(p.x - 2.0F));
    return ink;
}

DecalSheet make_decal_sheet(int size_px, const std::vector<DecalText>& texts, const NoiseField& wear) {
    DecalSheet sheet;
    sheet.image = blank_image("decals", size_px, size_px, 4, true);
    const auto size = static_cast<float>(size_px);
    // No ink anywhere has the colour of the ink beside it, so that filtering does not bring in black.
    for (std::size_t i = 0; i < sheet.image.texels.size(); ++i) sheet.image.texels[i] = i % 4 == 3 ? 0 : 230;
    int x0 = 0;
    int y0 = 0;
    int row_height = 0;
    for (const DecalText& text : texts) {
        const auto height = static_cast<float>(text.height_px);
        const int margin = text.height_px / 5 + 2;
        const int width_px = static_cast<int>(text_width(text.text) * height) + 2 * margin;
        const int height_px = text.height_px + 2 * margin;
        if (x0 + width_px > size_px) {
            x0 = 0;
            y0 += row_height;
            row_height = 0;
        }
        DecalPlace place;
        if (y0 + height_px > size_px || width_px > size_px) {
            place.uv_high = place.uv_low;
            sheet.places.push_back(place);
            continue;
        }
        const float soft = 0.7F / height;
        for (int y = 0; y < height_px; ++y)
            for (int x = 0; x < width_px; ++x) {
                const glm::vec2 at((static_cast<float>(x - margin) + 0.5F) / height,
                                   (static_cast<float>(height_px - margin - y) - 0.5F) / height);
                const glm::vec2 uv(static_cast<float>(x0 + x) / size, static_cast<float>(y0 + y) / size);
                const float worn =
                    ramp(0.66F, 0.78F, 0.5F * wear.at(uv.x * 2.0F, uv.y * 2.0F) + 0.5F * wear.at(uv.x, uv.y));
                std::uint8_t* to = &sheet.image.texels[4 * static_cast<std::size_t>((y0 + y) * size_px + x0 + x)];
                for (int c = 0; c < 3; ++c) to[c] = unit_byte(text.color[c]);
                to[3] = unit_byte(text_ink(text.text, at, 0.085F, soft, text.stencil) * (1.0F - 0.9F * worn));
            }
        place.uv_low = glm::vec2(x0, y0) / size;
        place.uv_high = glm::vec2(x0 + width_px, y0 + height_px) / size;
        place.aspect = static_cast<float>(width_px) / static_cast<float>(height_px);
        sheet.places.push_back(place);
        x0 += width_px;
        row_height = std::max(row_height, height_px);
    }
    return sheet;
}

}  // namespace macula
