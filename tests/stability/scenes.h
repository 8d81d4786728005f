#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace macula::test {

/// A scene that is hard for one reason, made by code in well under a second. The viewer begins at the origin.
///
///   wires     dark wires, .3 to 1 pixel wide, upright, slanted and level, before a plain sky
///   patterns  a checkerboard and a zone plate on walls, a floor of checks that runs to 24 m
///   gloss     a wall and a ball of glossy metal with bumps, roughness .2, under small lamps
///   mirror    a plain wall with a mirror that shows the patterned wall and the posts behind the viewer
///   glass     a thin tinted sheet and a solid block of glass before a patterned wall
///   moving    a patterned ball that swings across a wall, a box that turns, a bar that crosses the picture
///   posts     near posts and a ball before a far patterned wall: a head that moves uncovers much
///
/// Details are as fine as pixels of `vive`; with a divisor, `wires/8`, as those of that display with its edges divided
/// by it. Null for any other name.
std::shared_ptr<const Scene> test_scene(const std::string& name);

/// Names without divisors.
const std::vector<std::string>& test_scene_names();

}  // namespace macula::test
