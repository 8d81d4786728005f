#pragma once

#include <glm/mat4x3.hpp>

#include "client/present/taa_kernel.h"
#include "protocol/base/geometry.h"

namespace macula {

/// Where pixels of `from` lie in `to`. What they show may have moved in between, by an affine motion in world space.
kernels::ViewWarp make_view_warp(const EyeView& to, const EyeView& from,
                                 const glm::dmat4x3& to_from_moved = glm::dmat4x3(1.0));

}  // namespace macula
