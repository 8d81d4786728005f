#pragma once

#include "masks/display.h"

namespace macula::test {

/// A Vive's optics with few pixels.
inline Display small_display(int width_px = 188, int height_px = 208) {
    static const Display kVive = load_display("vive").value();  // solves for its outline, which takes 30 ms
    Display display = kVive;
    display.eye_width_px = width_px;
    display.eye_height_px = height_px;
    return display;
}

}  // namespace macula::test
