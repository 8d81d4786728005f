#pragma once

#include <optional>
#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "client/device/recording.h"

namespace macula {

/// The two layouts of raw recordings in the Salient360! toolbox (SMI eye tracker in an HTC Vive, recorded with
/// Unity; David et al., MMSys 2018): videos with the head's Euler angles, scenes with its quaternion and position.
/// Nothing if the header lacks a column that is needed.
std::optional<RowLayout> salient360_dynamic_layout(const Columns& columns);
std::optional<RowLayout> salient360_static_layout(const Columns& columns);

/// Unity's axes (left-handed, +Z forward) to ours (right-handed, -Z forward): Z is mirrored.
glm::vec3 from_unity(const glm::vec3& v);
glm::quat from_unity(const glm::quat& q);

/// Rotation that Unity makes of Euler angles in degrees: around Z, then X, then Y, of the fixed axes. Our axes.
glm::quat from_unity_euler(double pitch_deg, double yaw_deg, double roll_deg);

/// The eyes are sampled faster than the head, and a row repeats the last head pose that was known. Puts between
/// two updates of the head what lies between them: linear positions, spherical rotations. A head that held still
/// for longer than kLongestHold_ns stays where it is until that long before its next update.
void interpolate_held_poses(std::span<DeviceSample> samples);
inline constexpr std::int64_t kLongestHold_ns = 50'000'000;

/// Makes poses relative to the first: its position becomes the origin and its horizontal heading becomes -Z. Up
/// stays up, so pitch and roll are kept.
void move_to_start(std::span<DeviceSample> samples);

}  // namespace macula
