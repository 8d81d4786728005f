#pragma once

#include "masks/law.h"

namespace macula {

/// The law of the shape of `shape`, stretched so that the tile sampler samples `share` of an eye's pixels.
inline AcuityLaw law_for_share(const Display& display, Eye eye, double share, const AcuityLaw& shape = {}) {
    SamplingPreset preset;
    preset.law = shape;
    preset.share = share;
    return *tile_law(display, eye, preset);
}

}  // namespace macula
