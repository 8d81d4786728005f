#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/air_shed_aircraft.h"
#include "scenes/mesh_edit.h"
#include "scenes/shapes_surface.h"

namespace macula {
namespace {

constexpr float kTau = 2.0F * std::numbers::pi_v<float>;

/// Catmull-Rom through four values.
float spline(float a, float b, float c, float d, float t) {
    return b + 0.5F * t * (c - a + t * (2.0F * a - 5.0F * b + 4.0F * c - d + t * (3.0F * (b - c) + d - a)));
}

FuselageStation station_at(const std::vector<FuselageStation>& s, float v) {
    const auto last = static_cast<float>(s.size() - 1);
    const float at = glm::clamp(v, 0.0F, 1.0F) * last;
    const int i = std::min(static_cast<int>(at), static_cast<int>(s.size()) - 2);
    const float t = at - static_cast<float>(i);
    const auto get = [&s](int k) {
        return s[static_cast<std::size_t>(std::clamp(k, 0, static_cast<int>(s.size()) - 1))];
    };
    const FuselageStation a = get(i - 1);
    const FuselageStation b = get(i);
    const FuselageStation c = get(i + 1);
    const FuselageStation d = get(i + 2);
    return {spline(a.z_m, b.z_m, c.z_m, d.z_m, t), spline(a.y_m, b.y_m, c.y_m, d.y_m, t),
            std::max(0.0F, spline(a.half_width_m, b.half_width_m, c.half_width_m, d.half_width_m, t)),
            std::max(0.0F, spline(a.half_height_m, b.half_height_m, c.half_height_m, d.half_height_m, t))};
}

}  // namespace

glm::vec3 fuselage_point(const std::vector<FuselageStation>& stations, float u, float v, float lift_m) {
    const FuselageStation s = station_at(stations, v);
    const float a = -kTau * u;
    const auto power = [](float x) { return std::copysign(std::pow(std::abs(x), 2.0F / 2.4F), x); };
    const glm::vec2 out(power(std::sin(a)), power(std::cos(a)));
    return {out.x * (s.half_width_m + lift_m), s.y_m + out.y * (s.half_height_m + lift_m), s.z_m};
}

Mesh make_fuselage(const std::vector<FuselageStation>& stations, int columns, int rows,
                   const std::function<bool(float u, float v)>& open) {
    Mesh skin = make_surface(columns, rows, true, [&](float u, float v) { return fuselage_point(stations, u, v); });
    if (open) {
        const auto is_open = [&](const glm::uvec3& t) {
            const glm::vec2 middle = (skin.uv0[t.x] + skin.uv0[t.y] + skin.uv0[t.z]) / 3.0F;
            return open(middle.x, 1.0F - middle.y);
        };
        std::erase_if(skin.triangle, is_open);
    }
    float widest = 0.0F;
    for (const FuselageStation& s : stations) widest = std::max(widest, s.half_width_m + s.half_height_m);
    scale_uv(skin, {2.0F * std::round(0.25F * kTau * widest), stations.back().z_m - stations.front().z_m});
    return skin;
}

Mesh make_wing(const WingShape& shape) {
    const float span = glm::length(shape.tip_m - shape.root_m);
    Mesh wing = make_surface(shape.columns, shape.rows, false, [&](float u, float v) {
        // From the trailing edge over the top to the leading edge and back below; rows close up towards the tip.
        const float s = 1.0F - (1.0F - v) * (1.0F - v);
        const float a = kTau * u;
        const float x = 0.5F * (1.0F + std::cos(a));  // over chord, from the leading edge
        const float half = 5.0F * shape.thickness *
                           (0.2969F * std::sqrt(x) + x * (-0.1260F + x * (-0.3516F + x * (0.2843F - 0.1036F * x))));
        const float round = std::sqrt(std::max(0.0F, 1.0F - std::pow(std::max(0.0F, (s - 0.93F) / 0.07F), 2.0F)));
        const float chord = glm::mix(shape.root_chord_m, shape.tip_chord_m, s);
        const float camber = 0.08F * x * (1.0F - x);
        const float inset = 0.5F * (1.0F - (0.35F + 0.65F * round));
        const float y = (camber + (u < 0.5F ? half : -half)) * chord * round;
        const glm::vec3 edge = glm::mix(shape.root_m, shape.tip_m, s);
        return edge + glm::vec3(0.0F, y, -chord * glm::mix(x, 0.5F, 2.0F * inset));
    });
    scale_uv(wing, {2.2F * shape.root_chord_m, span});
    return wing;
}

}  // namespace macula
