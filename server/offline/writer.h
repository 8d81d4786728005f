#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/base/error.h"
#include "server/offline/layers.h"

namespace macula {

/// What may be written of a picture.
struct LayerChoice {
    bool color = false;
    bool depth = false;
    bool object = false;
    bool positions = false;
    bool levels = false;
};

/// Parses "color,depth,object,positions,levels", any of them. Errors: `option`.
Expected<LayerChoice> parse_layers(const std::string& text);

/// One written file.
struct WrittenFile {
    std::string layer;  ///< as in parse_layers(); "all" for EXR
    std::string path;
    double depth_m_per_unit = 0.0;  ///< of a PNG of depth: metres that one step of its values stands for
};

/// Colour that stands for an object in a PNG: distinct for all ids below 2^24, black for 0. RGB in the low bytes.
std::uint32_t color_of_object(std::uint32_t id);

/// Writes each chosen layer to STEM_LAYER.png. Errors: `output`, naming the file.
Expected<std::vector<WrittenFile>> write_png_layers(const Layers& layers, const LayerChoice& choice,
                                                    const std::string& stem);

/// Writes the chosen layers as channels of STEM.exr. Errors: `output`, naming the file.
Expected<std::vector<WrittenFile>> write_exr_layers(const Layers& layers, const LayerChoice& choice,
                                                    const std::string& stem, float exposure);

}  // namespace macula
