#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "protocol/base/error.h"

namespace macula::test {

/// One measurement: all that must be said to make it again. Its name is one line:
///
///     SCENE SCENARIO METHOD [taa=macula|paper|off] [codec=h264|none] [display=vive/2] [frames=24] [warm=24] [seed=1]
///     [latency=0] [mbits=25] [without=PART+PART...]
///
///     bunny-box pursuit tiles:27/tiles
///     air-shed recorded mesh:paper-54/raster taa=paper display=vive/4 seed=3
///
/// What is left out has the value shown. Order of the settings does not matter.
struct Row {
    std::string scene;     ///< bunny-box, air-shed, a glTF file, or a name of stability/scenes.h
    std::string scenario;  ///< scenario.h
    std::string method;    ///< server/method.h, complete
    std::string taa = "macula";
    std::string codec = "h264";
    std::string display = "vive/2";  ///< a display and, after a slash, by what its edges are divided
    int frames = 24;                 ///< that are judged
    int warm = 24;                   ///< before them, so that temporal accumulation is what it is in use
    std::uint32_t seed = 1;
    int latency = 0;  ///< frames from a head pose and gaze to the picture that is made of them
    /// Of the video, Mb/s, if the display had the size of `vive`; a smaller one gets the square root of its share of
    /// the pixels, since the smaller a picture of the same scene, the more there is to say about each pixel.
    int mbits = 25;
    /// Models that are switched off: see ablation.h.
    std::set<std::string> without;

    /// The name in its shortest form; parse_row() reads it back.
    [[nodiscard]] std::string name() const;
};

/// Errors: `option`, naming what was wrong.
Expected<Row> parse_row(const std::string& text);

}  // namespace macula::test
