#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "masks/make/mask.h"
#include "masks/make/recipe.h"
#include "masks/mesh/sample_mesh.h"
#include "masks/tool/options.h"
#include "protocol/base/error.h"
#include "protocol/base/progress.h"

namespace macula {

/// A mask as read from a file.
struct MaskInput {
    Mask mask;
    std::optional<SampleMesh> mesh;  ///< where the file is a mesh; the mask is then its sites
    std::optional<Recipe> recipe;    ///< where the file has one
};

/// Reads FILE.png or FILE.glb, whichever the name's end says. Errors: `input_file`, also for a name with another end.
Expected<MaskInput> read_mask_input(const std::string& path);

/// The sites of a mesh.
Mask mask_of(const SampleMesh& mesh);

/// What the options mean. Errors: `option`; `input_file` for a display file.
Expected<Recipe> recipe_of(const RecipeOptions& options);

/// One recipe for each entry of `options.sampling`, a list with commas. Errors: as recipe_of(); `option` for an empty
/// list.
Expected<std::vector<Recipe>> recipes_of(const RecipeOptions& options);

/// The entries of a list of presets with commas; those inside "law:NAME=VALUE,NAME=VALUE" separate nothing.
std::vector<std::string> split_presets(const std::string& list);

/// Two numbers "X,Y". Nothing if the text is anything else.
std::optional<glm::ivec2> parse_pixel(const std::string& text);

/// Tells the stages of mask making by `progress`, which must live as long.
MaskProgress tell_stages(Progress& progress);

}  // namespace macula
