// Samples to layers: what is where a sample is, where none is, and what interpolation fills in.

#include "server/offline/layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "server/kernels/color.h"
#include "server/offline/writer.h"

namespace macula {
namespace {

/// A camera's shot at 18 %, its samples made up of their pixels.
class LayersTest : public ::testing::Test {
protected:
    LayersTest() {
        RenderOptions options;
        options.camera_fov_deg = 60.0;
        options.size = "100x70";
        options.sampling = "18";
        MeshShelf meshes({}, [](const std::string&) {});
        shots_ = ShotPlan::parse(options)->shots({}, tables_, meshes).value();
        shot().sampler->plan({shot().gaze_eye, glm::ivec2(0)}, shot().plan);
        const std::size_t count = shot().plan.address_count();
        Samples& samples = shot().samples;
        samples.color.assign(count, 0xFFABCDEFU);
        samples.inverse_depth_per_m.assign(count, -1.0F);
        samples.object_id.assign(count, 0);
        samples.radiance.assign(count, glm::vec3(9.0F));
        for (const std::uint32_t address : shot().plan.trace_order) {
            const SamplePosition at = shot().plan.position[address];
            samples.radiance[address] = glm::vec3(0.01F * static_cast<float>(at.x_px), 0.5F, 0.25F);
            samples.color[address] = kernels::srgb8_from_linear(samples.radiance[address] * kExposure);
            samples.inverse_depth_per_m[address] = at.y_px < 10 ? 0.0F : 0.25F;
            samples.object_id[address] = static_cast<std::uint32_t>(at.y_px < 10 ? 0 : 7 + at.x_px);
        }
    }
    Shot& shot() { return shots_.front(); }

    static constexpr float kExposure = 0.8F;
    std::shared_ptr<const TileTables> tables_ = std::make_shared<const TileTables>(make_rank_tile());
    std::vector<Shot> shots_;
};

TEST_F(LayersTest, WithoutInterpolationTheRestIsBlack) {
    const auto layers = make_layers(shot(), nullptr, kExposure);
    ASSERT_TRUE(layers);
    std::uint32_t traced = 0;
    for (int y = 0; y < 70; ++y) {
        for (int x = 0; x < 100; ++x) {
            const bool sampled = layers->traced.at(x, y) != 0;
            traced += sampled ? 1 : 0;
            const glm::vec3 expected =
                sampled ? glm::vec3(0.01F * static_cast<float>(x), 0.5F, 0.25F) : glm::vec3(0.0F);
            EXPECT_EQ(layers->radiance.at(x, y), expected);
            EXPECT_EQ(layers->object.at(x, y), sampled && y >= 10 ? static_cast<std::uint32_t>(7 + x) : 0U);
            EXPECT_EQ(layers->depth_m.at(x, y), sampled && y >= 10 ? 4.0F : INFINITY);
            if (!sampled) {
                EXPECT_EQ(layers->color.at(x, y), 0xFF000000U);
            }
        }
    }
    EXPECT_EQ(traced, shot().plan.traced_in_window);
}

TEST_F(LayersTest, TilesSayHowManySamplesTheyHave) {
    const auto layers = make_layers(shot(), nullptr, kExposure);
    // A tile in the middle of the image: its samples counted one by one.
    int counted = 0;
    for (int y = 32; y < 48; ++y)
        for (int x = 48; x < 64; ++x) counted += layers->traced.at(x, y);
    EXPECT_EQ(layers->tile_samples.at(50, 40), counted);
}

TEST_F(LayersTest, InterpolationFillsTheRest) {
    const auto reconstructor = make_reference_reconstructor(tables_);
    const auto layers = make_layers(shot(), reconstructor.get(), kExposure);
    ASSERT_TRUE(layers);
    for (int y = 24; y < 60; ++y) {
        for (int x = 16; x < 84; ++x) {
            // The made-up picture is smooth: interpolation in the display's coding is off by no more than its rounding.
            EXPECT_NEAR(layers->radiance.at(x, y).x, 0.01F * static_cast<float>(x), 0.02F);
            EXPECT_NEAR(layers->radiance.at(x, y).y, 0.5F, 0.005F);
            EXPECT_NEAR(layers->depth_m.at(x, y), 4.0F, 1e-3F);
        }
    }
}

TEST(ColorOfObject, IsDistinctAndBlackOnlyForNothing) {
    EXPECT_EQ(color_of_object(0), 0U);
    std::set<std::uint32_t> colors;
    for (std::uint32_t id = 0; id < 100000; ++id) colors.insert(color_of_object(id));
    EXPECT_EQ(colors.size(), 100000U);
}

}  // namespace
}  // namespace macula
