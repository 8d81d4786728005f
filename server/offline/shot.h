#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "masks/display.h"
#include "masks/sample_plan.h"
#include "masks/tile_tables.h"
#include "protocol/base/error.h"
#include "protocol/base/geometry.h"
#include "server/mesh_shelf.h"
#include "server/method.h"
#include "server/offline/options.h"
#include "server/render/tracer.h"

namespace macula {

/// One picture to make: an eye of a display, or a plain camera.
struct Shot {
    std::string name;  ///< "left", "right", or empty for a camera
    EyeView view;
    glm::vec3 gaze_eye;  ///< unit
    std::unique_ptr<Sampler> sampler;
    SamplePlan plan;
    Samples samples;
};

/// What is looked at and how densely, checked before a scene is loaded, which may take a while.
class ShotPlan {
public:
    /// Errors: `option` naming the option; `input_file` for a display file.
    static Expected<ShotPlan> parse(const RenderOptions& options);

    /// The pictures to make for a session that starts at the pose. Solves the acuity law, or makes the mesh.
    /// Errors: those of make_sampler().
    [[nodiscard]] Expected<std::vector<Shot>> shots(const Pose& world_from_start,
                                                    const std::shared_ptr<const TileTables>& tables,
                                                    MeshShelf& meshes) const;
    [[nodiscard]] const Method& method() const { return method_; }
    /// Whether every visible pixel is traced, so that nothing has to be filled in.
    [[nodiscard]] bool full() const {
        return method_.sampler == SamplerKind::tiles && method_.preset.full &&
               method_.reconstruction == Reconstruction::tiles;
    }

private:
    Display display_;  ///< of a camera: the same for both eyes
    std::vector<Eye> eyes_;
    bool camera_ = false;
    std::optional<glm::vec3> position_m_;
    glm::quat start_from_head_ = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    glm::vec3 gaze_head_ = glm::vec3(0.0F, 0.0F, -1.0F);
    Method method_;
};

/// Parses `count` finite numbers with commas between them. Errors: `option`, naming the option.
Expected<std::vector<float>> parse_numbers(const std::string& option, const std::string& text, std::size_t count);

}  // namespace macula
