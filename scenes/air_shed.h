#pragma once

#include "scenes/load.h"

namespace macula {

/// "air-shed": an old aircraft hangar of 36 x 56 m to stand in, made by code: a steel frame with riveted trusses and
/// corrugated sheets, two aircraft with radial engines, scaffolds, stores and workshops, daylight through windows and
/// doors and warm lamps. Fine detail everywhere: what sparse sampling loses shows here. `progress` may be empty.
LoadedScene make_air_shed(const LoadProgress& progress = {});

}  // namespace macula
