#pragma once

namespace macula::test {

/// Display file of 128x96 pixels an eye, 90 degrees wide, for tests that run the programs.
constexpr const char* kSmallHeadset = R"({
  "name": "small", "eye_width_px": 128, "eye_height_px": 96, "refresh_hz": 60,
  "left": {"tangents": {"left": -1, "right": 1, "bottom": -0.75, "top": 0.75},
           "head_from_eye": {"position_m": [-0.03, 0, 0]}},
  "right": {"tangents": {"left": -1, "right": 1, "bottom": -0.75, "top": 0.75},
            "head_from_eye": {"position_m": [0.03, 0, 0]}}})";

}  // namespace macula::test
