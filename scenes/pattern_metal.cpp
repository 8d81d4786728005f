#include <cmath>

#include "scenes/pattern_paint.h"
#include "scenes/pattern_surface.h"

namespace macula {
namespace {

constexpr glm::vec3 kDarkRust(0.25F, 0.13F, 0.07F);
constexpr glm::vec3 kLightRust(0.56F, 0.32F, 0.16F);

glm::vec3 rust_color(const WearNoise& noise, float u, float v) {
    const float mix = 0.6F * noise.blotches.at(2.0F * u, 2.0F * v) + 0.4F * noise.grain.at(u, v);
    return glm::mix(kDarkRust, kLightRust, ramp(0.25F, 0.8F, mix));
}

/// Dark wet-looking tracks that run down from nails in rows, 0 to 1; each nail column and row has its own strength.
float nail_tracks(const WearNoise& noise, float u, float v, int columns, int rows) {
    const float x = u * static_cast<float>(columns) + 0.25F * (noise.clouds.at(u, 3.0F * v) - 0.5F);
    const float y = v * static_cast<float>(rows);
    const int column = static_cast<int>(std::floor(x)) % columns;
    const int row = static_cast<int>(y);
    const float strength = hash01(column, row, 71);
    const float below = cell(y);
    const float width = 0.06F + 0.10F * below;
    return line(cell(x) - 0.5F, width, width) * ramp(0.0F, 0.02F, below) * (1.0F - ramp(0.2F, 0.95F, below / strength));
}

}  // namespace

SurfaceMaps make_rusty_sheet_surface(int size_px, const WearNoise& noise, const glm::vec3& paint) {
    constexpr int kNails = 24;
    constexpr int kRows = 3;
    return paint_surface("rusty painted sheet", size_px, kPaintColor | kPaintRoughness, [&](float u, float v) {
        SurfaceTexel t;
        const float clouds = noise.clouds.at(u, v);
        const float streaks = noise.streaks.at(u, v);
        const float grain = noise.grain.at(2.0F * u, 2.0F * v);
        // Chalking paint: paler where the sun and the rain were.
        t.color = paint * (0.86F + 0.20F * clouds + 0.07F * (grain - 0.5F));
        t.color = glm::mix(t.color, glm::vec3(glm::dot(t.color, glm::vec3(0.33F))), 0.25F * clouds);
        // Soot and dust run down.
        t.color *= 1.0F - 0.30F * ramp(0.45F, 0.85F, streaks);
        const float seam = cell(v * static_cast<float>(kRows));
        const float rust_here = nail_tracks(noise, u, v, kNails, kRows) * 0.85F +
                                0.55F * ramp(0.72F, 1.0F, seam) * ramp(0.4F, 0.7F, noise.blotches.at(u, v)) +
                                0.35F * ramp(0.62F, 0.9F, noise.blotches.at(2.0F * u + 0.3F, v));
        const float through = ramp(0.35F, 0.62F, rust_here * (0.6F + 0.8F * grain));
        const float stain = ramp(0.08F, 0.5F, rust_here);
        const glm::vec3 rust = rust_color(noise, u, v);
        t.color = glm::mix(t.color, t.color * glm::vec3(0.86F, 0.66F, 0.48F), stain);
        t.color = glm::mix(t.color, rust, through);
        t.roughness = glm::mix(0.55F + 0.2F * clouds, 0.92F, through);
        return t;
    });
}

SurfaceMaps make_zinc_surface(int size_px, const WearNoise& noise) {
    return paint_surface("zinc sheet", size_px, kPaintColor | kPaintRoughness, [&](float u, float v) {
        SurfaceTexel t;
        const float clouds = noise.clouds.at(u, v);
        const float streaks = noise.streaks.at(u + 0.37F, v);
        const float spangle = noise.blotches.at(4.0F * u, 4.0F * v);
        t.color = glm::vec3(0.52F, 0.535F, 0.54F) * (0.80F + 0.22F * clouds + 0.14F * (spangle - 0.5F));
        t.color *= 1.0F - 0.25F * ramp(0.4F, 0.9F, streaks);
        const float lap = ramp(0.80F, 1.0F, cell(2.0F * v)) + 0.5F * ramp(0.15F, 0.0F, cell(2.0F * v));
        const float amount = 0.6F * lap * ramp(0.35F, 0.65F, noise.blotches.at(u, v)) +
                             0.5F * ramp(0.60F, 0.85F, streaks * (0.6F + 0.7F * clouds)) +
                             nail_tracks(noise, u, v, 12, 2) * 0.25F;
        const float rust = ramp(0.2F, 0.7F, amount);
        t.color = glm::mix(t.color, rust_color(noise, u, v) * 1.1F, 0.85F * rust);
        t.roughness = glm::mix(0.52F + 0.12F * spangle, 0.9F, rust);
        t.metallic = 0.75F * (1.0F - rust);
        return t;
    });
}

SurfaceMaps make_chipped_paint_surface(int size_px, const WearNoise& noise, float wear) {
    return paint_surface("chipped paint", size_px, kPaintColor | kPaintRoughness | kPaintNormal, [&](float u, float v) {
        SurfaceTexel t;
        const float blotches = noise.blotches.at(u, v);
        const float grain = noise.grain.at(u, v);
        const float clouds = noise.clouds.at(u, v);
        const float threshold = 0.86F - 0.30F * wear;
        const float field = 0.40F * blotches + 0.34F * grain + 0.26F * clouds;
        const float chip = ramp(threshold - 0.01F, threshold + 0.012F, field);
        const float primer = ramp(threshold - 0.035F, threshold - 0.02F, field) * (1.0F - chip);
        t.color = glm::vec3(0.86F) * (0.90F + 0.12F * (clouds - 0.5F) + 0.06F * (grain - 0.5F));
        t.color *= 1.0F - 0.22F * ramp(0.55F, 0.95F, noise.streaks.at(2.0F * u, 2.0F * v));  // grease
        t.color = glm::mix(t.color, glm::vec3(0.52F, 0.42F, 0.36F), primer);
        t.color = glm::mix(t.color, rust_color(noise, u, v), chip);
        t.roughness = glm::mix(0.42F + 0.25F * clouds, 0.85F, chip);
        t.height = 0.0012F * (1.0F - chip) + 0.0004F * noise.blotches.at(2.0F * u, 2.0F * v);
        return t;
    });
}

SurfaceMaps make_worn_steel_surface(int size_px, const WearNoise& noise) {
    return paint_surface("worn steel", size_px, kPaintColor | kPaintRoughness, [&](float u, float v) {
        SurfaceTexel t;
        const float brush = noise.streaks.at(v, u);
        const float blotches = noise.blotches.at(u, v);
        t.color = glm::vec3(0.60F, 0.59F, 0.57F) * (0.82F + 0.25F * brush);
        const float brown = ramp(0.5F, 0.85F, 0.7F * blotches + 0.3F * noise.grain.at(u, v));
        t.color = glm::mix(t.color, rust_color(noise, u, v), 0.8F * brown);
        t.roughness = glm::mix(0.30F + 0.2F * brush + 0.15F * blotches, 0.85F, brown);
        t.metallic = 1.0F - 0.9F * brown;
        return t;
    });
}

SurfaceMaps make_aircraft_skin_surface(int size_px, const WearNoise& noise) {
    constexpr float kTile_m = 2.0F;
    return paint_surface("aircraft skin", size_px, kPaintColor | kPaintRoughness | kPaintNormal, [&](float u, float v) {
        SurfaceTexel t;
        // Panels of 0.5 x 0.4 m in staggered rows; rivets every 40 mm along the laps, two rows of them.
        constexpr int kColumns = 4;
        constexpr int kRows = 5;
        const float y = v * static_cast<float>(kRows);
        const int row = static_cast<int>(y);
        const float x = u * static_cast<float>(kColumns) + (row % 2 == 0 ? 0.0F : 0.5F);
        const int column = static_cast<int>(std::floor(x)) % kColumns;
        const glm::vec2 panel_m(kTile_m / static_cast<float>(kColumns), kTile_m / static_cast<float>(kRows));
        const glm::vec2 in_m = glm::vec2(cell(x), cell(y)) * panel_m;
        const glm::vec2 edge_m = glm::min(in_m, panel_m - in_m);
        const float lap_m = std::min(edge_m.x, edge_m.y);
        const float gap = line(lap_m, 0.0018F, 0.0018F);
        const auto rivets = [](float across_m, float along_m) {
            const float a = across_m - 0.018F;
            const float b = (cell(along_m / 0.04F) - 0.5F) * 0.04F;
            return std::sqrt(a * a + b * b);
        };
        const float rivet_m = std::min(rivets(edge_m.x, in_m.y), rivets(edge_m.y, in_m.x));
        const float head = 1.0F - ramp(0.0034F, 0.0062F, rivet_m);
        const float moat = line(rivet_m - 0.0068F, 0.0018F, 0.0015F);

        const float shade = hash01(column, row, 13);
        const float polish = noise.streaks.at(v, u);
        const float clouds = noise.clouds.at(u, v);
        t.color = glm::vec3(0.80F, 0.81F, 0.82F) * (0.95F + 0.05F * shade + 0.05F * (polish - 0.5F));
        const float dirt = glm::clamp(0.40F * gap + 0.25F * moat +
                                          0.12F * (1.0F - ramp(0.0F, 0.05F, lap_m)) * noise.blotches.at(u, v) +
                                          0.18F * ramp(0.66F, 0.95F, noise.streaks.at(1.0F - v, u)),
                                      0.0F, 0.85F);
        t.color = glm::mix(t.color, glm::vec3(0.20F, 0.17F, 0.14F), dirt);
        // Satin: above the roughness below which a tracer follows the reflection.
        t.roughness = 0.43F + 0.04F * shade + 0.06F * clouds + 0.04F * (polish - 0.5F) + 0.35F * dirt;
        t.metallic = 1.0F - 0.7F * dirt;
        // Skins bulge a little between their ribs ("oil canning").
        const glm::vec2 bulge = glm::vec2(1.0F) - glm::abs(in_m / panel_m * 2.0F - 1.0F);
        t.height = 0.0004F * bulge.x * bulge.y * (0.4F + shade) + 0.0011F * head - 0.0012F * gap +
                   0.00010F * (noise.blotches.at(u, v) - 0.5F);
        return t;
    });
}

}  // namespace macula
