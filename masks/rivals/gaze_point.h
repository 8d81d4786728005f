#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "masks/display.h"

namespace macula {

/// A rectangle of the window's plane, in pixels of the window; may reach beyond it, infinitely too.
struct PlaneBox {
    glm::dvec2 begin_px;
    glm::dvec2 end_px;
};

/// Pixels of the window that unit tangents (x right, y up) come to.
glm::dvec2 window_point_px(const Display& display, Eye eye, const glm::dvec2& tangent);

/// Where the gaze meets the window's plane, but no farther from the window than its size: there, what follows the gaze
/// is all outside. `gaze_eye` is a unit vector in eye space and may point anywhere.
glm::dvec2 gaze_point_px(const Display& display, Eye eye, const glm::vec3& gaze_eye);

/// The square around the gaze whose edges are `radius_rad` away from it along the gaze's row and column. Empty if the
/// gaze does not meet the window's plane.
std::optional<PlaneBox> box_around_gaze(const Display& display, Eye eye, const glm::vec3& gaze_eye, double radius_rad);

/// Tangent of a pixel at the axis, mean of the two directions.
double pixel_tangent(const Display& display, Eye eye);

}  // namespace macula
