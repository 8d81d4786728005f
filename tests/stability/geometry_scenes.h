#pragma once

#include <optional>
#include <string>
#include <vector>

#include "masks/display.h"
#include "scenes/scene.h"

namespace macula::test {

// Scenes in which ray tracers run out of digits, as the tests of the tracer alone have them (tests/golden), for the
// whole way to what a client shows. Each knows what must be seen without asking the tracer about the same numbers.

/// A scene whose picture has one colour wherever nothing goes wrong.
struct PlainCase {
    std::string name;
    Scene scene;
    int code = 0;         ///< sRGB-coded, of all channels
    bool rounds = false;  ///< 10 km away, where floats are 1 mm apart, so that hits at edges may lie beyond them
};

/// The left eye of the display looks at each from the start. Closed rooms without light, shapes that vanish in light
/// from everywhere, mirrors under an even sky, planes as bright as their background.
std::vector<PlainCase> plain_cases(const Display& display);

/// A scene that is hard, and one that is not and looks the same; or none that would.
struct HardCase {
    std::string name;
    Scene scene;
    std::optional<Scene> twin;
    bool rounds = false;  ///< as in PlainCase
};

/// With a twin: the same scene a thousand times smaller, a hundred thousand times larger, ten kilometres away, under
/// light of other powers; walls made of needles, with triangles without area, in one place more than once. Without:
/// mirrors that face each other, glass in glass, a tiny bright lamp over gloss, a sky of what is no number.
std::vector<HardCase> hard_cases(const Display& display);

}  // namespace macula::test
