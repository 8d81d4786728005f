#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// Things made of wire and rope, in metres.

/// Chain of oval links along a path, each a quarter turn from the one before it. `wire_m` is the link's wire radius;
/// a link is ten of it long and seven wide.
Mesh make_chain(std::span<const glm::vec3> path, float wire_m);

/// Rope of three strands twisted around a path. u along in metres.
Mesh make_rope(std::span<const glm::vec3> path, float radius_m, float turns_per_m);

/// Ring of round wire about +Y around the origin.
Mesh make_ring(float ring_radius_m, float wire_radius_m, int segments = 28, int sides = 8);

/// Wire wound around +Y from y = 0.
Mesh make_coil(float ring_radius_m, float wire_radius_m, float height_m, float turns, int pieces_per_turn = 20);

/// Handrail: posts of pipe with a top rail, a middle rail and a toe board, along a polyline on the floor level y.
Mesh make_railing(std::span<const glm::vec3> path, float height_m, float pipe_radius_m, bool closed = false);

}  // namespace macula
