#include <cmath>

#include "scenes/pattern_paint.h"
#include "scenes/pattern_surface.h"

namespace macula {

SurfaceMaps make_concrete_surface(int size_px, const WearNoise& noise) {
    return paint_surface("concrete", size_px, kPaintColor | kPaintRoughness | kPaintNormal, [&](float u, float v) {
        SurfaceTexel t;
        const float clouds = noise.clouds.at(u, v);
        const float blotches = noise.blotches.at(u, v);
        const float grain = noise.grain.at(2.0F * u, 2.0F * v);
        const float speckle = noise.speckle.at(2.0F * u, 2.0F * v);
        const float trowel = noise.blotches.at(u + 0.5F * v, v - 0.25F * clouds);
        t.color = glm::vec3(0.545F, 0.53F, 0.50F) *
                  (0.86F + 0.20F * (clouds - 0.5F) + 0.16F * (trowel - 0.5F) + 0.10F * (grain - 0.5F));
        // Sand and stones where the skin is worn off.
        const float worn = ramp(0.50F, 0.75F, 0.5F * clouds + 0.5F * blotches);
        const float stone = ramp(0.60F, 0.72F, speckle);
        t.color *= 1.0F + worn * 0.22F * (speckle - 0.45F);
        t.color = glm::mix(t.color, glm::vec3(0.36F, 0.33F, 0.30F), 0.35F * worn * stone);
        // Crazing: a crack runs where two warped noises cross their middle.
        const float wander = noise.blotches.at(u + 0.13F, v + 0.41F);
        const float crack_field = noise.clouds.at(u + 0.06F * wander, v + 0.06F * blotches) - 0.52F;
        const float crack = line(crack_field, 0.0022F, 0.0022F) * ramp(0.42F, 0.55F, noise.clouds.at(v + 0.3F, u));
        t.color *= 1.0F - 0.62F * crack;
        const float grease = ramp(0.66F, 0.85F, noise.clouds.at(u + 0.61F, v + 0.23F));
        t.color = glm::mix(t.color, glm::vec3(0.24F, 0.22F, 0.20F), 0.5F * grease);
        t.roughness = glm::clamp(0.62F + 0.20F * worn - 0.14F * grease + 0.12F * (trowel - 0.5F), 0.45F, 1.0F);
        t.height = 0.0008F * (clouds - 0.5F) + 0.00035F * grain + 0.0003F * worn * speckle - 0.0016F * crack;
        return t;
    });
}

SurfaceMaps make_brick_surface(int size_px, const WearNoise& noise) {
    return paint_surface("old brick", size_px, kPaintColor | kPaintRoughness | kPaintNormal, [&](float u, float v) {
        constexpr int kCourses = 16;
        constexpr int kBricks = 5;
        SurfaceTexel t;
        const float ragged = 0.012F * (noise.blotches.at(u, v) - 0.5F);
        const float y = (v + ragged) * static_cast<float>(kCourses);
        const int course = (static_cast<int>(std::floor(y)) + kCourses) % kCourses;
        const float x = (u + ragged) * static_cast<float>(kBricks) + (course % 2 == 0 ? 0.0F : 0.5F);
        const int brick = (static_cast<int>(std::floor(x)) + kBricks) % kBricks;
        const float edge_x = (0.5F - std::abs(cell(x) - 0.5F)) * 0.24F;
        const float edge_y = (0.5F - std::abs(cell(y) - 0.5F)) * 0.075F;
        const float face = ramp(0.004F, 0.008F, std::min(edge_x, edge_y));
        const float shade = hash01(brick, course, 5);
        const float grain = noise.grain.at(2.0F * u, 2.0F * v);
        const float clouds = noise.clouds.at(u, v);
        const glm::vec3 clay = glm::mix(glm::vec3(0.47F, 0.25F, 0.18F), glm::vec3(0.60F, 0.38F, 0.28F), shade);
        const glm::vec3 mortar = glm::vec3(0.56F, 0.54F, 0.50F) * (0.8F + 0.3F * grain);
        t.color = glm::mix(mortar, clay * (0.78F + 0.4F * noise.blotches.at(u, v)), face);
        const float bloom = ramp(0.6F, 0.85F, noise.clouds.at(u + 0.4F, v + 0.2F));
        t.color = glm::mix(t.color, glm::vec3(0.72F, 0.69F, 0.65F), 0.35F * bloom * grain);
        t.color *= 0.85F + 0.22F * clouds;
        t.roughness = 0.9F;
        t.height = 0.006F * face + 0.0022F * face * noise.blotches.at(u, v) + 0.0008F * grain;
        return t;
    });
}

SurfaceMaps make_worn_marking_surface(int size_px, const WearNoise& noise) {
    return paint_surface("worn marking", size_px, kPaintColor | kPaintAlpha, [&](float u, float v) {
        SurfaceTexel t;
        const float clouds = noise.clouds.at(u, v);
        const float grain = noise.grain.at(u, v);
        const float blotches = noise.blotches.at(u, v);
        t.color = glm::vec3(0.93F) * (0.80F + 0.22F * blotches);
        t.color *= 1.0F - 0.35F * ramp(0.5F, 0.9F, noise.streaks.at(u, v));
        const float left = 0.55F * blotches + 0.35F * grain + 0.35F * clouds;
        t.alpha = 1.0F - 0.95F * ramp(0.63F, 0.74F, left);
        return t;
    });
}

SurfaceMaps make_pane_surface(int size_px, const WearNoise& noise) {
    return paint_surface("window pane", size_px, kPaintColor | kPaintAlpha, [&](float u, float v) {
        SurfaceTexel t;
        const float edge = std::min(std::min(u, 1.0F - u), std::min(v, 1.0F - v));
        const float corner = ramp(0.30F, 0.0F, edge + 0.25F * (noise.blotches.at(u, v) - 0.5F));
        const float runs = ramp(0.45F, 0.9F, noise.streaks.at(u, v));
        t.color = glm::vec3(0.46F, 0.45F, 0.40F);
        t.alpha = 0.10F + 0.50F * corner + 0.18F * runs + 0.22F * ramp(0.5F, 0.8F, noise.clouds.at(u, v));
        return t;
    });
}

}  // namespace macula
