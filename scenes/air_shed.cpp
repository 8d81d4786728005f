#include "scenes/air_shed.h"

#include <memory>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include "scenes/air_shed_aircraft.h"
#include "scenes/air_shed_light.h"
#include "scenes/air_shed_materials.h"
#include "scenes/air_shed_props.h"
#include "scenes/air_shed_shell.h"
#include "scenes/mesh_edit.h"
#include "scenes/openness.h"

namespace macula {
LoadedScene make_air_shed(const LoadProgress& progress) {
    const auto report = [&progress](const char* stage, double fraction) {
        if (progress) progress(stage, fraction);
    };
    SceneBuilder builder;
    report("textures", 0.0);
    const AirShedMaterials materials = add_air_shed_materials(builder);
    report("frames", 0.5);
    build_frames(builder, materials);
    report("cladding", 0.6);
    build_cladding(builder, materials);
    build_openings(builder, materials);
    report("floor", 0.7);
    build_floor(builder, materials);
    report("aircraft", 0.8);
    builder.add_placed("transport", make_transport(materials), place({-4.2F, 0.0F, -3.5F}, 24.0F));
    builder.add_placed("trainer", make_trainer(materials), place({10.2F, 0.0F, -13.5F}, -32.0F));
    report("furniture", 0.9);
    furnish(builder, materials);
    build_services(builder, materials);
    build_light(builder);
    Scene& scene = builder.scene();
    report("light", 0.95);
    OpennessOptions openness;
    openness.low = glm::vec3(-AirShedSize::kHalfWidth - 0.6F, -0.3F, -AirShedSize::kHalfLength - 1.0F);
    openness.high =
        glm::vec3(AirShedSize::kHalfWidth + 0.6F, AirShedSize::kRidge + 0.3F, AirShedSize::kHalfLength + 0.6F);
    darken_corners(scene, openness);
    scene.name = "air-shed";
    scene.world_from_start.position_m = glm::vec3(4.6F, 1.7F, 10.6F);
    scene.world_from_start.orientation = glm::angleAxis(glm::radians(24.0F), glm::vec3(0.0F, 1.0F, 0.0F));
    const auto camera = [&scene](const char* name, const glm::vec3& at, float yaw_deg) {
        SceneCamera c;
        c.name = name;
        c.world_from_head.position_m = at;
        c.world_from_head.orientation = glm::angleAxis(glm::radians(yaw_deg), glm::vec3(0.0F, 1.0F, 0.0F));
        scene.cameras.push_back(c);
    };
    camera("workshop", {12.6F, 1.7F, 13.4F}, -62.0F);
    camera("doors", {-0.5F, 1.7F, -24.0F}, 172.0F);
    camera("stores", {-9.2F, 1.7F, 10.4F}, 66.0F);
    scene.near_m = 0.1F;
    scene.exposure = 1.2F;
    report("done", 1.0);
    LoadedScene loaded;
    loaded.scene = std::make_shared<const Scene>(std::move(scene));
    return loaded;
}

}  // namespace macula
