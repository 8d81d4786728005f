#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "protocol/base/error.h"
#include "protocol/base/geometry.h"

namespace macula {

/// One eye of a headset.
struct EyeDisplay {
    Tangents tangents;
    Pose head_from_eye;
    /// Closed polygon of tangents (x right, y up) outside which the lens shows nothing; empty: all is visible.
    std::vector<glm::vec2> visible_outline;
};

/// Geometry of a headset's displays, as data: built in, or read from a user's JSON file.
struct Display {
    std::string name;
    int eye_width_px = 0;  ///< of each eye's buffer
    int eye_height_px = 0;
    float refresh_hz = 90.0F;
    PerEye<EyeDisplay> eyes;
};

/// Built-in geometry "vive" or "desktop", or a path of a display file (masks/display.md documents the JSON).
/// Errors: `option` for an unknown name, `input_file` for a file that is missing or wrong, naming the field.
Expected<Display> load_display(const std::string& name_or_path);

/// Checks ranges as load_display does, for geometry that came in a message.
/// Errors: `protocol`, naming the field.
Expected<void> validate_display(const Display& display);

/// 1 for each pixel of the eye's buffer whose centre lies outside the visible outline, row-major.
std::vector<std::uint8_t> hidden_pixels(const Display& display, Eye eye);

}  // namespace macula
