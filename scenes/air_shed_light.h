#pragma once

#include "scenes/scene_builder.h"

namespace macula {

/// Sun, daylight through doors, windows and skylights, lamps; the sky that is seen through the openings; and light from
/// all around: what a point in the middle of the shed sees, so that it is bright from the windows and dim elsewhere.
void build_light(SceneBuilder& builder);

}  // namespace macula
