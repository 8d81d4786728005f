#include "masks/rivals/gaze_point.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>

namespace macula {
namespace {

/// A gaze less steep than this to the window's plane is taken for parallel.
constexpr float kLeastForward = 0.01F;

/// Tangent of an angle, infinite from a right angle on.
double tangent_of(double angle_rad) {
    constexpr double kRight = 0.5 * std::numbers::pi - 1e-9;
    if (angle_rad >= kRight) return std::numeric_limits<double>::infinity();
    if (angle_rad <= -kRight) return -std::numeric_limits<double>::infinity();
    return std::tan(angle_rad);
}

}  // namespace

glm::dvec2 window_point_px(const Display& display, Eye eye, const glm::dvec2& tangent) {
    const Tangents& edge = display.eyes[eye].tangents;
    return {(tangent.x - edge.left) / (double{edge.right} - edge.left) * display.eye_width_px,
            (edge.top - tangent.y) / (double{edge.top} - edge.bottom) * display.eye_height_px};
}

glm::dvec2 gaze_point_px(const Display& display, Eye eye, const glm::vec3& gaze_eye) {
    const double forward = std::max(-gaze_eye.z, kLeastForward);
    const glm::dvec2 point_px = window_point_px(display, eye, {gaze_eye.x / forward, gaze_eye.y / forward});
    const glm::dvec2 size_px(display.eye_width_px, display.eye_height_px);
    return glm::clamp(point_px, -size_px, 2.0 * size_px);
}

std::optional<PlaneBox> box_around_gaze(const Display& display, Eye eye, const glm::vec3& gaze_eye, double radius_rad) {
    if (gaze_eye.z > -kLeastForward) return std::nullopt;
    const glm::dvec3 gaze(gaze_eye);
    // Along the gaze's row all directions lie in one plane with the x axis: there the angle from the gaze is a
    // difference of angles. The same holds for its column.
    const double row_distance = std::hypot(gaze.y, gaze.z);
    const double column_distance = std::hypot(gaze.x, gaze.z);
    const double azimuth_rad = std::atan2(gaze.x, row_distance);
    const double height_rad = std::atan2(gaze.y, column_distance);
    const auto edge = [&](double turn_rad) {
        return window_point_px(display, eye,
                               {tangent_of(azimuth_rad + turn_rad) * row_distance / -gaze.z,
                                tangent_of(height_rad - turn_rad) * column_distance / -gaze.z});
    };
    return PlaneBox{edge(-radius_rad), edge(radius_rad)};
}

double pixel_tangent(const Display& display, Eye eye) {
    const Tangents& edge = display.eyes[eye].tangents;
    return std::sqrt((double{edge.right} - edge.left) / display.eye_width_px * (double{edge.top} - edge.bottom) /
                     display.eye_height_px);
}

}  // namespace macula
