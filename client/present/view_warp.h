#pragma once

#include "client/present/taa_kernel.h"
#include "protocol/base/geometry.h"

namespace macula {

/// Where pixels of `from` lie in `to`.
kernels::ViewWarp make_view_warp(const EyeView& to, const EyeView& from);

}  // namespace macula
