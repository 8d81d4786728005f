#pragma once

#include <string>

#include "scenes/load.h"

namespace macula {

/// Where Debian's package glmark2-data keeps the Stanford bunny.
inline constexpr const char* kBunnyPath = "/usr/share/glmark2/models/bunny.obj";

/// "bunny-box": a room of 6 x 4 x 6 m to stand in, with test charts on the walls, simple objects and the Stanford
/// bunny on a pedestal, made by code; a mirror on the wall behind it and a ball of solid glass beside it. Plain and
/// high-frequency textures that do not mask what foveation does wrong. Where `bunny_path` cannot be read a torus knot
/// stands in and a warning says what to install.
LoadedScene make_bunny_box(const std::string& bunny_path = kBunnyPath);

}  // namespace macula
