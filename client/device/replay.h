#pragma once

#include <memory>

#include "client/device/recording.h"
#include "client/device/source.h"

namespace macula {

/// Plays a recording with its own timing; ends with it, or begins again one mean sample interval after its last
/// sample.
std::unique_ptr<TrackSource> make_replay(Recording recording, bool loop);

}  // namespace macula
