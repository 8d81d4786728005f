#include <cmath>
#include <numbers>

#include "scenes/pattern_paint.h"
#include "scenes/pattern_surface.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;
constexpr int kPlanks = 8;

/// Distance to the plank's knot in plank widths along v; along u the knot is drawn out.
glm::vec2 to_knot(int plank, float u, float across) {
    const float centre = hash01(plank, 7, 31);
    float along = u - centre;
    along -= std::round(along);
    return {along * 9.0F, across - 0.5F - 0.5F * (hash01(plank, 9, 31) - 0.5F)};
}

}  // namespace

SurfaceMaps make_plank_surface(int size_px, const WearNoise& noise) {
    return paint_surface("planks", size_px, kPaintColor | kPaintNormal, [&](float u, float v) {
        SurfaceTexel t;
        const float y = v * static_cast<float>(kPlanks);
        const int plank = static_cast<int>(y);
        const float across = cell(y);
        const float own = hash01(plank, 3, 31);
        const glm::vec2 knot = to_knot(plank, u, across);
        const float knot_sq = glm::dot(knot, knot);
        // Year rings: along the plank nearly straight, pushed aside by the knot.
        const float push = 0.35F * std::exp(-3.0F * knot_sq) * (knot.y > 0.0F ? 1.0F : -1.0F);
        const float bend = 0.8F * noise.clouds.at(u + own, 0.2F * across + own) + 0.15F * noise.blotches.at(u, v);
        const float rings = std::sin(kTau * ((across - push) * (4.0F + 4.0F * own) + 3.0F * bend));
        const float fibre = noise.streaks.at(v * 2.0F, u);
        const float grain = noise.grain.at(0.25F * std::round(4.0F * u) + v * 3.0F, v);
        const float late = ramp(-0.2F, 1.0F, rings);
        const glm::vec3 early_wood = glm::mix(glm::vec3(0.72F, 0.57F, 0.39F), glm::vec3(0.60F, 0.50F, 0.39F), own);
        t.color = glm::mix(early_wood, early_wood * glm::vec3(0.74F, 0.66F, 0.58F), 0.55F * late);
        t.color *= 0.86F + 0.22F * fibre + 0.05F * (grain - 0.5F);
        const float eye = 1.0F - ramp(0.02F, 0.05F, knot_sq);
        t.color = glm::mix(t.color, glm::vec3(0.27F, 0.17F, 0.10F) * (0.8F + 0.4F * fibre), 0.85F * eye);
        // Grey weathering and dirty hands.
        const float weather = ramp(0.45F, 0.85F, noise.clouds.at(u + 0.2F * own, v));
        t.color = glm::mix(t.color, glm::vec3(0.43F, 0.41F, 0.38F) * (0.8F + 0.4F * fibre), 0.55F * weather);
        const float edge = 0.5F - std::abs(across - 0.5F);
        const float gap = 1.0F - ramp(0.012F, 0.03F, edge);
        t.color *= 1.0F - 0.75F * gap;
        const float nail_u = (cell(4.0F * u) - 0.5F) / 4.0F * static_cast<float>(kPlanks);
        const float nail =
            std::min(glm::length(glm::vec2(nail_u, across - 0.22F)), glm::length(glm::vec2(nail_u, across - 0.78F)));
        const float head = 1.0F - ramp(0.020F, 0.028F, nail);
        t.color = glm::mix(t.color, glm::vec3(0.22F, 0.19F, 0.17F), 0.9F * head);
        t.color = glm::mix(t.color, t.color * glm::vec3(0.62F, 0.54F, 0.48F),
                           line(nail_u, 0.02F, 0.02F) * (1.0F - ramp(0.03F, 0.15F, nail)));
        t.roughness = 0.8F;
        t.height = -0.004F * gap - 0.0005F * late + 0.0008F * fibre + 0.0006F * head;
        return t;
    });
}

SurfaceMaps make_cardboard_surface(int size_px, const WearNoise& noise) {
    return paint_surface("cardboard", size_px, kPaintColor, [&](float u, float v) {
        SurfaceTexel t;
        const float flute = 0.5F + 0.5F * std::sin(kTau * 80.0F * u);
        const float clouds = noise.clouds.at(u, v);
        t.color = glm::vec3(0.63F, 0.48F, 0.33F) *
                  (0.88F + 0.16F * clouds + 0.04F * flute + 0.08F * (noise.grain.at(u, v) - 0.5F));
        t.color *= 1.0F - 0.25F * ramp(0.60F, 0.85F, noise.blotches.at(u, v));
        const float tape = line(v - 0.5F, 0.045F, 0.004F);
        t.color = glm::mix(t.color, glm::vec3(0.70F, 0.60F, 0.44F) * (0.9F + 0.15F * clouds), 0.8F * tape);
        t.roughness = glm::mix(0.85F, 0.45F, tape);
        return t;
    });
}

}  // namespace macula
