#include "client/present/view_warp.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace macula {

kernels::ViewWarp make_view_warp(const EyeView& to, const EyeView& from, const glm::dmat4x3& to_from_moved) {
    // In double: rotations between frames are small differences of large numbers in the corners.
    const glm::dquat world_from_to(to.world_from_eye.orientation);
    const glm::dquat world_from_from(from.world_from_eye.orientation);
    const glm::dmat3 to_from_world = glm::mat3_cast(glm::conjugate(glm::normalize(world_from_to)));
    const glm::dmat3 linear =
        to_from_world * glm::dmat3(to_from_moved) * glm::mat3_cast(glm::normalize(world_from_from));
    const glm::dvec3 translation_m = to_from_world * (to_from_moved * glm::dvec4(from.world_from_eye.position_m, 1.0) -
                                                      glm::dvec3(to.world_from_eye.position_m));

    // (x, y, 1) in pixels to a direction with z = -1. GLM's constructor takes columns.
    const Tangents& f = from.tangents;
    const glm::dmat3 direction_from_pixel(static_cast<double>(f.right - f.left) / from.width_px, 0.0, 0.0,   //
                                          0.0, static_cast<double>(f.bottom - f.top) / from.height_px, 0.0,  //
                                          f.left, f.top, -1.0);
    // A point of eye space to (X, Y, S) with S = -z.
    const Tangents& t = to.tangents;
    const double x_scale = to.width_px / static_cast<double>(t.right - t.left);
    const double y_scale = to.height_px / static_cast<double>(t.top - t.bottom);
    const glm::dmat3 pixel_from_point(x_scale, 0.0, 0.0,   //
                                      0.0, -y_scale, 0.0,  //
                                      t.left * x_scale, -t.top * y_scale, -1.0);

    const glm::dmat3 homography = pixel_from_point * linear * direction_from_pixel;
    const glm::dvec3 parallax = pixel_from_point * translation_m;
    const auto row = [&](int i) {
        return glm::vec4(homography[0][i], homography[1][i], homography[2][i], parallax[i]);
    };
    return {row(0), row(1), row(2)};
}

}  // namespace macula
