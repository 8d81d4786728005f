#include "scenes/gltf_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace macula {
namespace {

constexpr float kKeyRadiance = 0.8F;
constexpr float kDark = 1e-20F;           // irradiance of lights that are as good as off
constexpr float kMostIntensity = 1e30F;   // of one that is far away among near ones
constexpr float kLeastIrradiance = 0.5F;  // of rectangles that need no sun

float luminance(const glm::vec3& c) {
    return glm::dot(c, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

/// What the light would send to a surface there that is turned to it, if nothing were in the way, by luminance.
float metered_irradiance(const Light& light, const glm::vec3& point, float nearest) {
    const float brightness = luminance(light.intensity);
    if (light.kind == LightKind::directional) return brightness;
    const glm::vec3 to_point = point - light.position_m;
    const float distance = std::max(glm::length(to_point), nearest);
    if (light.kind != LightKind::rectangle) return brightness / (distance * distance);
    const float area = 4.0F * glm::length(glm::cross(light.half_u_m, light.half_v_m));
    const float cosine = std::max(glm::dot(light.direction, to_point) / distance, 0.0F);
    return brightness * area * cosine / (distance * distance);
}

void add_default_light(Scene& scene) {
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(glm::vec3(0.45F, -1.0F, -0.6F));
    sun.intensity = glm::vec3(2.25F, 2.2F, 2.1F);
    scene.lights.push_back(sun);
    scene.ambient_radiance = glm::vec3(0.25F);
    scene.background_radiance = glm::vec3(0.25F, 0.42F, 0.68F);
}

}  // namespace

Expected<Light> read_gltf_light(const GltfContext& context, int light, const glm::mat4& world_from_node) {
    const auto& lights = context.document.model.lights;
    if (light < 0 || static_cast<std::size_t>(light) >= lights.size())
        return context.error("light " + std::to_string(light), "does not exist");
    const tinygltf::Light& from = lights[static_cast<std::size_t>(light)];
    const std::string element = element_name("light", static_cast<std::size_t>(light), from.name);

    Light to;
    if (from.type == "directional")
        to.kind = LightKind::directional;
    else if (from.type == "point")
        to.kind = LightKind::point;
    else if (from.type == "spot")
        to.kind = LightKind::spot;
    else
        return context.error(element, "type \"" + from.type + "\" is none of directional, point, spot");

    glm::vec3 color(1.0F);
    if (!from.color.empty()) {
        if (from.color.size() != 3) return context.error(element, "the colour does not have three numbers");
        for (int i = 0; i < 3; ++i) color[i] = static_cast<float>(from.color[static_cast<std::size_t>(i)]);
    }
    to.intensity = static_cast<float>(from.intensity) * color;
    to.range_m = static_cast<float>(from.range);
    for (const float number : {to.intensity.r, to.intensity.g, to.intensity.b, to.range_m})
        if (!(number >= 0.0F) || !std::isfinite(number))
            return context.error(element, "intensity, colour or range is negative or not finite");
    if (to.kind == LightKind::spot) {
        const double inner = from.spot.innerConeAngle;
        const double outer = from.spot.outerConeAngle;
        if (!(inner >= 0.0 && inner < outer && outer <= std::numbers::pi / 2.0 + 1e-6))
            return context.error(element, "cone angles need 0 <= inner < outer <= pi/2");
        to.spot_cos_inner = static_cast<float>(std::cos(inner));
        to.spot_cos_outer = static_cast<float>(std::max(std::cos(outer), 0.0));
    }
    to.position_m = glm::vec3(world_from_node[3]);
    to.direction = -glm::normalize(glm::vec3(world_from_node[2]));
    return to;
}

void expose_gltf_lights(Scene& scene, const Bounds& bounds) {
    const float nearest = std::max(0.25F * bounds.radius(), 1e-3F);
    float punctual = 0.0F;
    float rectangles = 0.0F;
    for (const Light& light : scene.lights)
        (light.kind == LightKind::rectangle ? rectangles : punctual) +=
            metered_irradiance(light, bounds.middle(), nearest);
    if (!(punctual > kDark) && !(rectangles >= kLeastIrradiance)) return add_default_light(scene);
    scene.ambient_radiance = glm::vec3(0.04F);
    if (!(punctual > kDark)) return;
    // A white diffuse surface has radiance irradiance / pi.
    const float factor = kKeyRadiance * std::numbers::pi_v<float> / punctual;
    for (Light& light : scene.lights)
        if (light.kind != LightKind::rectangle)
            light.intensity = glm::min(light.intensity * factor, glm::vec3(kMostIntensity));
}

}  // namespace macula
