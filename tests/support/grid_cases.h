#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "masks/display.h"
#include "masks/rivals/layer_sampler.h"
#include "masks/rivals/log_polar_sampler.h"
#include "masks/rivals/uniform_sampler.h"
#include "server/render/tracer.h"

namespace macula::test {

/// A small wide eye, its axis off centre, of which a dented outline shows some three quarters.
inline Display small_display(int width_px = 172, int height_px = 140) {
    Display display{
        .name = "small", .eye_width_px = width_px, .eye_height_px = height_px, .refresh_hz = 90.0F, .eyes = {}};
    for (EyeDisplay& eye : display.eyes) {
        eye.tangents = {.left = -1.2F, .right = 0.9F, .bottom = -0.8F, .top = 0.9F};
        eye.visible_outline = {{-1.1F, 0.3F}, {-0.5F, 0.85F}, {0.2F, 0.4F},   {0.7F, 0.9F},   {0.95F, 0.1F},
                               {0.5F, -0.8F}, {0.1F, -0.1F},  {-0.4F, -0.9F}, {-1.25F, -0.4F}};
    }
    return display;
}

inline Display without_outline(Display display) {
    for (EyeDisplay& eye : display.eyes) eye.visible_outline.clear();
    return display;
}

/// The kinds of samplers whose plans are grids.
inline const std::vector<std::string>& grid_samplers() {
    static const std::vector<std::string> kNames = {"uniform", "layers", "log-polar"};
    return kNames;
}

inline std::unique_ptr<Sampler> make_grid_sampler(const std::string& name, const Display& display, double share) {
    if (name == "uniform") return std::make_unique<UniformSampler>(display, kLeftEye, share);
    if (name == "layers") return std::make_unique<LayerSampler>(display, kLeftEye, share);
    return LogPolarSampler::make(display, kLeftEye, share).value();
}

/// Gazes over the window, beside it, and behind the eye; any phase.
inline PlanRequest random_request(std::mt19937& random) {
    std::uniform_real_distribution<float> tangent(-1.5F, 1.5F);
    std::uniform_int_distribution phase(0, 63);
    PlanRequest request;
    request.phase_px = {phase(random), phase(random)};
    const float forward = std::uniform_int_distribution(0, 9)(random) == 0 ? 0.5F : -1.0F;
    request.gaze_eye = glm::normalize(glm::vec3(tangent(random), tangent(random), forward));
    return request;
}

/// Place of a sample in the window.
inline glm::dvec2 place_px(const SamplePlan& plan, std::uint32_t address) {
    const PlaceInPixel place = plan.place.empty() ? PlaceInPixel{} : plan.place[address];
    return {plan.position[address].x_px + place.x / 256.0, plan.position[address].y_px + place.y / 256.0};
}

/// What a tracer would find where `color(x, y)` and `inverse_depth(x, y)` are the picture.
template <class Color, class Depth>
Samples trace_picture(const SamplePlan& plan, Color&& color, Depth&& inverse_depth) {
    Samples samples;
    samples.color.assign(plan.address_count(), 0xFFFF00FFU);
    samples.inverse_depth_per_m.assign(plan.address_count(), -1.0F);
    for (const std::uint32_t address : plan.trace_order) {
        const glm::dvec2 at = place_px(plan, address);
        samples.color[address] = color(at.x, at.y);
        samples.inverse_depth_per_m[address] = inverse_depth(at.x, at.y);
    }
    return samples;
}

inline bool is_visible(const SamplePlan& plan, int x, int y) {
    return !plan.hidden || (*plan.hidden)[static_cast<std::size_t>(y * plan.width_px + x)] == 0;
}

}  // namespace macula::test
