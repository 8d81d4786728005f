#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_shell.h"
#include "scenes/mesh_edit.h"
#include "scenes/noise.h"
#include "scenes/shapes.h"
#include "scenes/shapes_steel.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

using Size = AirShedSize;

constexpr float kSlab = 4.0F;  // m
constexpr glm::vec3 kYellow(0.80F, 0.50F, 0.06F);
constexpr glm::vec3 kWhite(0.85F, 0.84F, 0.80F);
constexpr glm::vec3 kRed(0.55F, 0.06F, 0.04F);
constexpr glm::vec3 kBlack(0.025F, 0.025F, 0.028F);

float soft_step(float from, float to, float x) {
    const float t = glm::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// The taxi line: from the doors straight in, then to the right.
glm::vec3 taxi_point(float t) {
    const float z = glm::mix(-Size::kHalfLength - 20.0F, 20.0F, t);
    const float bend = soft_step(-6.0F, 16.0F, z);
    return {-1.0F + 6.0F * bend, 0.0F, z};
}

/// Large stains, wear along the traffic, dirt along the walls, rubber on the wheel tracks.
glm::vec3 floor_tint(float x, float z) {
    const float large = fractal_noise(0.011F * x + 0.5F, 0.011F * z + 0.5F, 16, 77);
    const float small = value_noise(1.7F * x + 200.0F, 1.7F * z + 200.0F, 4096, 78);
    float light = 0.90F + 0.5F * (large - 0.5F) + 0.10F * (small - 0.5F);
    const float wall = std::min(Size::kHalfWidth - std::abs(x), Size::kHalfLength - z);
    light *= 0.62F + 0.38F * soft_step(0.0F, 1.8F, wall + 0.8F * (large - 0.5F));
    for (const float offset : {-2.6F, 2.6F}) {
        const float track =
            std::abs(x - taxi_point((z + Size::kHalfLength + 20.0F) / (Size::kHalfLength + 40.0F)).x - offset);
        light *= 1.0F - 0.22F * (1.0F - soft_step(0.10F, 0.28F + 0.2F * small, track));
    }
    glm::vec3 tint(light);
    // Oil: dark, brownish.
    constexpr glm::vec4 kSpills[] = {{-5.2F, -1.0F, 1.1F, 0.9F},  {1.4F, -3.4F, 0.9F, 0.8F},
                                     {6.2F, 6.3F, 0.9F, 1.0F},    {6.0F, -14.5F, 1.0F, 0.7F},
                                     {-12.0F, 10.0F, 1.5F, 0.6F}, {3.0F, 14.0F, 0.6F, 0.5F}};
    for (const glm::vec4& s : kSpills) {
        const float d = glm::length(glm::vec2(x - s.x, z - s.y)) / s.z;
        const float spill = s.w * (1.0F - soft_step(0.35F, 1.0F, d + 0.5F * (small - 0.5F) + 0.6F * (large - 0.5F)));
        tint *= glm::mix(glm::vec3(1.0F), glm::vec3(0.34F, 0.31F, 0.28F), spill);
    }
    return glm::clamp(tint, glm::vec3(0.08F), glm::vec3(1.0F));
}

void build_slabs(SceneBuilder& builder, const AirShedMaterials& m) {
    constexpr int kCells = 12;
    constexpr float kGap = 0.008F;
    Mesh slabs;
    const int columns = static_cast<int>(2.0F * Size::kHalfWidth / kSlab);
    const int rows = static_cast<int>(2.0F * Size::kHalfLength / kSlab);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const glm::vec2 low(-Size::kHalfWidth + kSlab * static_cast<float>(column) + kGap,
                                -Size::kHalfLength + kSlab * static_cast<float>(row) + kGap);
            const float side = kSlab - 2.0F * kGap;
            // Slabs were cast one by one: none lies quite as high as its neighbour, and none has its texture.
            const float level = -0.002F * hash01(column, row, 61);
            Mesh slab = make_surface(kCells, kCells, false, [&](float u, float v) {
                const bool rim = u == 0.0F || v == 0.0F || u == 1.0F || v == 1.0F;
                return glm::vec3(low.x + u * side, level - (rim ? 0.004F : 0.0F), low.y + (1.0F - v) * side);
            });
            slab.normal.assign(slab.position_m.size(), glm::vec3(0.0F, 1.0F, 0.0F));
            const float own = 0.90F + 0.12F * hash01(column, row, 62);
            for (std::size_t i = 0; i < slab.position_m.size(); ++i) {
                const glm::vec3& p = slab.position_m[i];
                slab.color.emplace_back(floor_tint(p.x, p.z) * own, 1.0F);
                slab.uv0[i] = glm::vec2(p.x, p.z) + 2.5F * glm::vec2(hash01(column, row, 63), hash01(column, row, 64));
            }
            append(slabs, slab);
        }
    builder.place_mesh("floor slabs", builder.add_mesh(std::move(slabs), m.concrete));
    const glm::vec3 corner(-Size::kHalfWidth, -0.012F, -Size::kHalfLength);
    builder.place_mesh("floor joints", builder.add_mesh(make_quad(corner, {2.0F * Size::kHalfWidth, 0.0F, 0.0F},
                                                                  {0.0F, 0.0F, 2.0F * Size::kHalfLength}),
                                                        m.joint));
}

/// Strip of paint `width_m` wide along a path on the floor; its texture coordinates are the place on the floor.
Mesh make_strip(const std::vector<glm::vec3>& path, float width_m, const glm::vec3& color) {
    Mesh strip;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const glm::vec3 d = glm::normalize(path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]);
        const glm::vec3 side = glm::vec3(-d.z, 0.0F, d.x) * (0.5F * width_m);
        for (const glm::vec3& p : {path[i] - side, path[i] + side}) {
            strip.position_m.push_back(p);
            strip.normal.emplace_back(0.0F, 1.0F, 0.0F);
            strip.uv0.emplace_back(p.x, p.z);
            strip.color.emplace_back(color, 1.0F);
        }
        if (i == 0) continue;
        const auto b = static_cast<unsigned>(2 * i);
        strip.triangle.emplace_back(b - 2, b + 1, b - 1);
        strip.triangle.emplace_back(b - 2, b, b + 1);
    }
    for (glm::uvec3& t : strip.triangle)  // the front is above, whichever way the path runs
        if (glm::cross(strip.position_m[t.y] - strip.position_m[t.x], strip.position_m[t.z] - strip.position_m[t.x]).y <
            0.0F)
            std::swap(t.y, t.z);
    return strip;
}

/// Slanted stripes of two colours along x.
Mesh make_hazard_band(float length_m, float width_m) {
    Mesh band;
    const int stripes = static_cast<int>(length_m / 0.3F);
    for (int i = 0; i < stripes; ++i) {
        const float x = 0.3F * static_cast<float>(i);
        Mesh stripe = make_quad({x, 0.0F, 0.0F}, {0.3F, 0.0F, 0.0F}, {-0.3F, 0.0F, width_m});
        for (std::size_t c = 0; c < 4; ++c) stripe.uv0[c] = {stripe.position_m[c].x, stripe.position_m[c].z};
        tint(stripe, i % 2 == 0 ? kYellow : kBlack);
        append(band, stripe);
    }
    return band;
}

void build_markings(SceneBuilder& builder, const AirShedMaterials& m) {
    constexpr float kLift = 0.002F;  // m above the slabs
    Mesh paint;
    std::vector<glm::vec3> taxi;
    for (int i = 0; i <= 96; ++i)
        taxi.push_back(taxi_point(static_cast<float>(i) / 96.0F) + glm::vec3(0.0F, kLift, 0.0F));
    append(paint, make_strip(taxi, 0.15F, kYellow));
    const auto box = [&paint](const glm::vec2& low, const glm::vec2& high, float width_m, const glm::vec3& color) {
        const float y = kLift + 0.0005F;
        append(paint, make_strip({{low.x, y, low.y}, {high.x, y, low.y}}, width_m, color));
        append(paint, make_strip({{low.x, y, high.y}, {high.x, y, high.y}}, width_m, color));
        append(paint, make_strip({{low.x, y + 0.0004F, low.y}, {low.x, y + 0.0004F, high.y}}, width_m, color));
        append(paint, make_strip({{high.x, y + 0.0004F, low.y}, {high.x, y + 0.0004F, high.y}}, width_m, color));
    };
    box({-17.0F, 2.0F}, {-9.6F, 13.0F}, 0.10F, kWhite);
    box({-17.0F, 14.0F}, {-9.6F, 25.0F}, 0.10F, kWhite);
    box({9.6F, -24.0F}, {17.0F, -12.0F}, 0.10F, kWhite);
    box({14.6F, 4.2F}, {17.2F, 6.8F}, 0.08F, kRed);
    for (const float x : {-9.0F, 9.0F})  // walkways
        append(paint, make_strip({{x, kLift, -26.0F}, {x, kLift, 26.0F}}, 0.08F, kWhite));
    append(paint, make_hazard_band(2.0F * Size::kDoorHalfWidth, 0.45F),
           place({-Size::kDoorHalfWidth + 0.3F, kLift, -Size::kHalfLength + 0.4F}));
    append(paint, make_hazard_band(7.2F, 0.25F), place({2.6F, kLift, 11.4F}));
    builder.place_mesh("floor lines", builder.add_mesh(std::move(paint), m.marking));

    Mesh letters;
    const auto write = [&](AirShedText text, float height_m, const glm::vec3& at, float yaw_deg,
                           const glm::vec3& color) {
        append(
            letters, make_decal(m, text, height_m, color),
            place(at + glm::vec3(0.0F, 0.0035F, 0.0F), yaw_deg) * turned(glm::vec3(0.0F), -90.0F, {1.0F, 0.0F, 0.0F}));
    };
    write(AirShedText::bay_1, 1.3F, {-13.3F, 0.0F, 11.5F}, 90.0F, kWhite);
    write(AirShedText::bay_2, 1.3F, {-13.3F, 0.0F, 20.5F}, 90.0F, kWhite);
    write(AirShedText::bay_3, 1.3F, {13.2F, 0.0F, -13.2F}, 0.0F, kWhite);
    write(AirShedText::keep_clear, 0.9F, {-0.8F, 0.0F, -25.6F}, 0.0F, kYellow);
    write(AirShedText::no_smoking, 0.9F, {6.2F, 0.0F, 10.4F}, 0.0F, kYellow);
    write(AirShedText::fire_point, 0.5F, {15.9F, 0.0F, 7.4F}, -90.0F, kRed);
    write(AirShedText::crew_only, 0.5F, {-9.5F, 0.0F, 4.0F}, 90.0F, kWhite);
    builder.place_mesh("floor letters", builder.add_mesh(std::move(letters), m.decal));

    Mesh drain;  // a slotted channel across the shed
    for (int i = 0; i < 36; ++i)
        append(drain, make_grating({0.98F, 0.28F}, 0.04F, 0.02F),
               place({-17.5F + static_cast<float>(i), 0.004F, -24.0F}));
    builder.place_mesh("drain", builder.add_mesh(std::move(drain), m.black_iron));
}

void build_ground(SceneBuilder& builder, const AirShedMaterials& m) {
    const float front = -Size::kHalfLength;
    builder.place_mesh(
        "apron", builder.add_mesh(make_quad({-90.0F, -0.03F, front - 70.0F}, {180.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 70.0F}),
                                  m.asphalt));
    builder.place_mesh(
        "airfield",
        builder.add_mesh(make_quad({-900.0F, -0.15F, -900.0F}, {1800.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1800.0F}), m.grass));
    Mesh runway = make_quad({-900.0F, -0.06F, front - 135.0F}, {1800.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 30.0F});
    builder.place_mesh("runway", builder.add_mesh(std::move(runway), m.asphalt));

    // A wood far off: crowns in three rows, thinner towards the gaps.
    Mesh wood;
    Mesh crown = make_surface(8, 5, true, [](float u, float v) {
        const float a = 2.0F * std::numbers::pi_v<float> * u;
        const float b = std::numbers::pi_v<float> * (v - 0.5F);
        const float bump = 1.0F + 0.4F * std::cos(b) * (value_noise(6.0F * u, 5.0F * v, 6, 91) - 0.5F);
        return glm::vec3(std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)) * bump;
    });
    for (int ring = 0; ring < 3; ++ring)
        for (int i = 0; i < 150; ++i) {
            const float angle = glm::radians(-75.0F + static_cast<float>(i) + 0.7F * hash01(i, ring, 92));
            const float far = 330.0F + 25.0F * static_cast<float>(ring) + 20.0F * hash01(i, ring, 93);
            if (fractal_noise(0.5F + 0.004F * static_cast<float>(i), 0.3F, 16, 94) < 0.40F) continue;
            const float size = 5.0F + 5.0F * hash01(i, ring, 95);
            Mesh tree = crown;
            tint(tree, glm::vec3(0.7F + 0.5F * hash01(i, ring, 96)));
            append(wood, tree,
                   place({far * std::sin(angle), 0.7F * size, -far * std::cos(angle)}, 360.0F * hash01(i, ring, 97),
                         size));
        }
    builder.place_mesh("wood", builder.add_mesh(std::move(wood), m.foliage));

    Mesh fence;
    for (int i = 0; i < 60; ++i) {
        const float x = -90.0F + 3.0F * static_cast<float>(i);
        append(fence, make_pipe({{x, 0.0F, front - 72.0F}, {x, 1.5F, front - 72.0F}}, 0.04F, 6));
    }
    for (const float y : {0.5F, 1.0F, 1.45F})
        append(fence, make_pipe({{-90.0F, y, front - 72.0F}, {87.0F, y, front - 72.0F}}, 0.02F, 5));
    builder.place_mesh("fence", builder.add_mesh(std::move(fence), m.white));
}

}  // namespace

void build_floor(SceneBuilder& builder, const AirShedMaterials& m) {
    build_slabs(builder, m);
    build_markings(builder, m);
    build_ground(builder, m);
}

}  // namespace macula
