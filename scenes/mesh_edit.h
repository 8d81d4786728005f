#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace macula {

/// Adds a copy of `part`, moved by an affine transform that may mirror, behind what is in `to`. Where only one of both
/// has vertex colours the other is white; tangents and the second texture coordinates are not kept.
void append(Mesh& to, const Mesh& part, const glm::mat4& to_from_part = glm::mat4(1.0F));

/// `part`, moved.
[[nodiscard]] Mesh moved(const Mesh& part, const glm::mat4& to_from_part);

/// Multiplies the vertex colours (linear).
void tint(Mesh& mesh, const glm::vec3& factor);

/// Moves the texture coordinates, so that copies of a part do not show the same piece of a texture.
void shift_uv(Mesh& mesh, const glm::vec2& by);

/// Multiplies the texture coordinates.
void scale_uv(Mesh& mesh, const glm::vec2& by);

/// Whether the triangles enclose a volume: each directed edge between positions, rounded to 10 um, is there once and
/// meets its opposite.
bool is_closed(const Mesh& mesh);

/// Translation after a turn about +Y, counter-clockwise seen from above, after a scale.
glm::mat4 place(const glm::vec3& at, float yaw_deg = 0.0F, float scale = 1.0F);

/// Translation after a turn about any axis.
glm::mat4 turned(const glm::vec3& at, float angle_deg, const glm::vec3& axis);

/// Takes the y axis to the direction from `from` to `to` and the origin to `from`; `to_side` says where x comes to lie.
glm::mat4 along(const glm::vec3& from, const glm::vec3& to, const glm::vec3& to_side = glm::vec3(1.0F, 0.0F, 0.0F));

}  // namespace macula
