#include <string>
#include <vector>

#include "scenes/air_shed_props.h"
#include "scenes/mesh_edit.h"
#include "scenes/noise.h"

namespace macula {
namespace {

/// Where copies of a model stand.
struct Stand {
    glm::vec3 at_m;
    float yaw_deg = 0.0F;
};

void place_all(SceneBuilder& builder, const std::string& name, const Model& model, const std::vector<Stand>& stands) {
    const ModelMeshes meshes = builder.add_model(name, model);
    int index = 0;
    for (const Stand& s : stands)
        builder.place_model(name + " " + std::to_string(++index), meshes, place(s.at_m, s.yaw_deg));
}

void furnish_workshop(SceneBuilder& builder, const AirShedMaterials& m) {
    place_all(builder, "workbench", make_workbench(m, 1),
              {{{16.6F, 0.0F, 9.4F}, -90.0F}, {{16.6F, 0.0F, 16.3F}, -90.0F}});
    place_all(builder, "second workbench", make_workbench(m, 2),
              {{{16.6F, 0.0F, 12.8F}, -90.0F}, {{-16.7F, 0.0F, -13.0F}, 90.0F}});
    place_all(builder, "red trolley", make_tool_trolley(m, m.red),
              {{{2.2F, 0.0F, 4.6F}, 205.0F}, {{13.9F, 0.0F, 11.2F}, -70.0F}, {{7.0F, 0.0F, -11.0F}, 30.0F}});
    place_all(builder, "blue trolley", make_tool_trolley(m, m.blue),
              {{{-8.2F, 0.0F, 3.6F}, 160.0F}, {{14.2F, 0.0F, 15.0F}, -110.0F}});
    place_all(builder, "engine stand", make_engine_stand(m),
              {{{6.3F, 0.0F, 6.4F}, 215.0F}, {{12.2F, 0.0F, 19.4F}, 230.0F}});
    place_all(builder, "compressor", make_compressor(m),
              {{{15.8F, 0.0F, 21.6F}, -60.0F}, {{4.1F, 0.0F, 3.0F}, -20.0F}});
    place_all(builder, "tractor", make_tractor(m), {{{5.6F, 0.0F, -20.5F}, 200.0F}});
    place_all(builder, "bottles", make_bottle_basket(m), {{{14.6F, 0.0F, 8.2F}, 20.0F}});
    place_all(builder, "bucket", make_bucket(m),
              {{{5.2F, 0.0F, 6.6F}, 30.0F}, {{1.4F, 0.0F, 3.5F}, 0.0F}, {{-15.8F, 0.0F, 5.4F}, 70.0F}});
    place_all(builder, "cone", make_cone(m),
              {{{-0.6F, 0.0F, 5.6F}, 12.0F},
               {{-5.6F, 0.0F, 6.4F}, 40.0F},
               {{-9.3F, 0.0F, 6.5F}, 70.0F},
               {{9.0F, 0.0F, -2.2F}, 5.0F},
               {{4.9F, 0.0F, -9.6F}, 33.0F},
               {{-2.5F, 0.0F, -26.0F}, 3.0F},
               {{3.0F, 0.0F, -26.2F}, 20.0F}});
    place_all(builder, "extinguisher", make_extinguisher(m),
              {{{17.2F, 0.0F, 6.2F}, -90.0F},
               {{16.8F, 0.0F, 6.2F}, -80.0F},
               {{16.4F, 0.0F, 5.9F}, -100.0F},
               {{-17.1F, 0.0F, 1.2F}, 90.0F},
               {{1.6F, 0.0F, 5.2F}, 60.0F},
               {{-9.4F, 0.0F, -9.0F}, 0.0F}});
}

void furnish_access(SceneBuilder& builder, const AirShedMaterials& m) {
    place_all(builder, "ladder", make_wheeled_ladder(m, 2.6F),
              {{{1.9F, 0.0F, 0.2F}, -30.0F}, {{13.6F, 0.0F, -6.6F}, 140.0F}});
    place_all(builder, "tall ladder", make_wheeled_ladder(m, 3.8F),
              {{{-11.6F, 0.0F, -17.5F}, 15.0F}, {{-14.8F, 0.0F, 16.0F}, 80.0F}});
    place_all(builder, "platform", make_platform(m, 2.1F), {{{-9.8F, 0.0F, 1.2F}, 24.0F}});
    place_all(builder, "low platform", make_platform(m, 1.3F), {{{12.2F, 0.0F, -8.4F}, -32.0F}});
    place_all(builder, "trestle", make_trestle(m, 1.5F),
              {{{-14.6F, 0.0F, -24.6F}, 10.0F},
               {{-12.6F, 0.0F, -25.2F}, 24.0F},
               {{15.8F, 0.0F, -21.0F}, 80.0F},
               {{15.4F, 0.0F, -19.3F}, 95.0F}});
    place_all(builder, "chocks", make_chocks(m),
              {{{-0.61F, 0.0F, -2.19F}, 24.0F}, {{10.52F, 0.0F, -11.66F}, -32.0F}, {{8.40F, 0.0F, -12.98F}, -32.0F}});
}

void furnish_stores(SceneBuilder& builder, const AirShedMaterials& m) {
    place_all(builder, "large crate", make_crate(m, {1.5F, 1.1F, 1.1F}, 1),
              {{{-14.6F, 0.144F, 5.0F}, 80.0F}, {{-12.2F, 0.144F, 21.4F}, 12.0F}, {{7.6F, 0.0F, 23.6F}, 170.0F}});
    place_all(builder, "crate", make_crate(m, {0.9F, 0.7F, 0.7F}, 2),
              {{{-14.5F, 1.268F, 5.2F}, 65.0F},
               {{-12.5F, 0.0F, 5.6F}, 100.0F},
               {{-12.3F, 1.268F, 21.5F}, 30.0F},
               {{5.6F, 0.0F, 24.0F}, 160.0F},
               {{10.9F, 0.0F, 9.7F}, 215.0F},
               {{8.3F, 0.0F, 4.6F}, 150.0F},
               {{-3.4F, 0.0F, 7.4F}, 30.0F}});
    place_all(builder, "long crate", make_crate(m, {2.4F, 0.55F, 0.6F}, 3),
              {{{-13.0F, 0.0F, 8.2F}, 95.0F},
               {{-13.1F, 0.575F, 8.3F}, 88.0F},
               {{1.5F, 0.0F, 26.4F}, 182.0F},
               {{1.2F, 0.575F, 26.5F}, 176.0F}});
    place_all(builder, "small crate", make_crate(m, {0.55F, 0.4F, 0.42F}, 4),
              {{{-12.6F, 0.724F, 5.7F}, 120.0F},
               {{-13.2F, 1.15F, 8.0F}, 70.0F},
               {{10.8F, 0.724F, 9.6F}, 200.0F},
               {{5.5F, 0.724F, 24.1F}, 190.0F},
               {{7.2F, 1.124F, 23.5F}, 150.0F},
               {{-15.9F, 0.0F, 11.2F}, 85.0F},
               {{8.2F, 0.724F, 4.7F}, 170.0F}});
    std::vector<Stand> pallets = {{{-14.6F, 0.0F, 5.0F}, 80.0F}, {{-12.2F, 0.0F, 21.4F}, 12.0F}};
    for (int i = 0; i < 7; ++i)
        pallets.push_back(
            {{-15.6F + 0.03F * hash01(i, 1, 59), 0.144F * static_cast<float>(i), 23.6F}, 4.0F * hash01(i, 2, 59)});
    place_all(builder, "pallet", make_pallet(m), pallets);
    const std::vector<std::pair<std::string, int>> paints = {
        {"blue drum", m.blue}, {"red drum", m.red}, {"green drum", m.green}, {"orange drum", m.orange}};
    const std::vector<std::vector<Stand>> drums = {{{{13.9F, 0.0F, -21.8F}, 200.0F},
                                                    {{14.6F, 0.0F, -21.9F}, 250.0F},
                                                    {{14.2F, 0.0F, -22.5F}, 170.0F},
                                                    {{11.6F, 0.0F, 8.4F}, 240.0F},
                                                    {{8.9F, 0.0F, 5.9F}, 200.0F},
                                                    {{-9.9F, 0.0F, 24.4F}, 160.0F}},
                                                   {{{14.0F, 0.88F, -22.0F}, 190.0F},
                                                    {{12.3F, 0.0F, 8.9F}, 190.0F},
                                                    {{-10.6F, 0.0F, 24.6F}, 185.0F},
                                                    {{-16.3F, 0.0F, -2.4F}, 80.0F}},
                                                   {{{15.3F, 0.0F, -22.1F}, 180.0F},
                                                    {{12.9F, 0.0F, 8.2F}, 260.0F},
                                                    {{-16.4F, 0.0F, -3.1F}, 110.0F},
                                                    {{-15.8F, 0.0F, -3.6F}, 50.0F}},
                                                   {{{-10.2F, 0.0F, 25.2F}, 150.0F}, {{14.9F, 0.88F, -22.2F}, 230.0F}}};
    for (std::size_t i = 0; i < paints.size(); ++i)
        place_all(builder, paints[i].first, make_oil_drum(m, paints[i].second), drums[i]);
    for (int i = 0; i < 3; ++i)
        place_all(builder, "shelf " + std::to_string(i + 1), make_shelf(m, 3 + i),
                  i == 0
                      ? std::vector<Stand>{{{-17.0F, 0.0F, -8.6F}, 90.0F}, {{12.6F, 0.0F, 27.3F}, 180.0F}}
                      : (i == 1 ? std::vector<Stand>{{{-17.0F, 0.0F, -5.8F}, 90.0F}, {{15.2F, 0.0F, 27.3F}, 180.0F}}
                                : std::vector<Stand>{{{-17.0F, 0.0F, 8.6F}, 90.0F}, {{-17.0F, 0.0F, 11.2F}, 90.0F}}));
    place_all(builder, "tyres", make_tyre_stack(m, 4), {{{-16.6F, 0.0F, -16.2F}, 0.0F}, {{11.6F, 0.0F, 25.6F}, 50.0F}});
    place_all(builder, "low tyres", make_tyre_stack(m, 2), {{{-15.5F, 0.0F, -16.6F}, 70.0F}});
    place_all(builder, "oxygen bottle", make_gas_bottle(m, m.blue),
              {{{17.3F, 0.0F, 1.6F}, -90.0F}, {{17.3F, 0.0F, 1.9F}, -70.0F}, {{-17.2F, 0.0F, 14.4F}, 90.0F}});
    place_all(builder, "acetylene bottle", make_gas_bottle(m, m.red),
              {{{17.3F, 0.0F, 2.2F}, -90.0F}, {{-17.2F, 0.0F, 14.7F}, 90.0F}});
    place_all(builder, "jerrycan", make_jerrycan(m, m.green),
              {{{13.2F, 0.0F, 9.8F}, 200.0F},
               {{13.5F, 0.0F, 9.7F}, 190.0F},
               {{-15.2F, 0.0F, -2.8F}, 60.0F},
               {{6.4F, 0.0F, -18.4F}, 10.0F}});
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 size(0.4F + 0.08F * static_cast<float>(i), 0.3F + 0.05F * static_cast<float>(i % 2), 0.35F);
        place_all(builder, "carton " + std::to_string(i + 1), make_cardboard_box(m, size, 7 + i),
                  {{{10.2F + 0.3F * static_cast<float>(i), 0.0F, 24.0F + 0.5F * static_cast<float>(i % 2)},
                    170.0F + 20.0F * static_cast<float>(i)},
                   {{-11.4F + 0.1F * static_cast<float>(i), 0.0F, 9.4F + 0.55F * static_cast<float>(i)},
                    100.0F - 14.0F * static_cast<float>(i)}});
    }
}

}  // namespace

void furnish(SceneBuilder& builder, const AirShedMaterials& m) {
    furnish_workshop(builder, m);
    furnish_access(builder, m);
    furnish_stores(builder, m);
}

}  // namespace macula
