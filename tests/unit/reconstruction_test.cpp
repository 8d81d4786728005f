// Names of reconstructions, which plans they fit, and samples put at their pixels.

#include "server/render/reconstruction.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "masks/mesh/mesh_table.h"
#include "server/render/sample_image.h"
#include "tests/support/reconstruct_cases.h"

namespace macula {
namespace {

TEST(Reconstruction, NamesAreParsedToWhatTheyName) {
    for (const char* name : {"tiles", "table", "raster", "push-pull", "cells", "nearest", "bilinear"}) {
        const auto parsed = parse_reconstruction(name);
        ASSERT_TRUE(parsed) << name;
        EXPECT_EQ(to_string(*parsed), name);
    }
    const auto refused = parse_reconstruction("splat");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::option);
    EXPECT_EQ(refused.error().message,
              "reconstruction must be tiles, table, raster, push-pull, cells, nearest or bilinear, not \"splat\"");
}

/// The names that fit a plan.
std::string fitting(const SamplePlan& plan) {
    std::string names;
    for (const char* name : {"tiles", "table", "raster", "push-pull", "cells", "nearest", "bilinear"})
        if (check_fits(parse_reconstruction(name).value(), plan)) names += std::string(names.empty() ? "" : " ") + name;
    return names;
}

SamplePlan plan_with_grids() {
    SamplePlan plan;
    plan.position.resize(1);
    plan.grids.log_polar.count = {16, 16};
    return plan;
}

TEST(Reconstruction, EachFitsThePlansThatItReads) {
    EXPECT_EQ(fitting(test::random_case(1).plan), "tiles push-pull cells nearest");
    EXPECT_EQ(fitting(plan_with_grids()), "bilinear");
    EXPECT_EQ(fitting(SamplePlan{}), "");
    SamplePlan off_centre = test::random_case(1).plan;
    off_centre.place.resize(off_centre.address_count());
    EXPECT_EQ(fitting(off_centre), "tiles");
}

TEST(Reconstruction, RefusalsSayWhatIsLackingAndWhatFits) {
    EXPECT_EQ(check_fits(Reconstruction::raster, test::random_case(1).plan).error().message,
              "reconstruction raster needs a mesh, which mesh samplers make; for this sampler take tiles, push-pull, "
              "cells or nearest");
    EXPECT_EQ(check_fits(Reconstruction::cells, plan_with_grids()).error().message,
              "reconstruction cells needs samples at pixel centres, which tile samplers and mesh samplers make; for "
              "this sampler take bilinear");
    EXPECT_EQ(check_fits(Reconstruction::tiles, SamplePlan{}).error().message,
              "reconstruction tiles needs tiles, which tile samplers make; no reconstruction fits this sampler");
    EXPECT_EQ(check_fits(Reconstruction::tiles, SamplePlan{}).error().code, ErrorCode::option);
}

TEST(SampleImage, HoldsEverySampleAtItsPixelAndNothingElse) {
    SampleImage image;  // one for all, of whose earlier content nothing may show
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const test::Case random = test::random_case(seed);
        image.fill(random.plan, random.samples, true);
        ASSERT_EQ(image.guard_px, 32);
        ASSERT_EQ(image.width_px, random.plan.width_px + 64);
        ASSERT_EQ(image.height_px, random.plan.height_px + 64);
        for (const std::uint32_t address : random.plan.trace_order) {
            const SamplePosition at = random.plan.position[address];
            const std::size_t pixel = image.index({at.x_px, at.y_px});
            ASSERT_EQ(image.color[pixel], random.samples.color[address]);
            ASSERT_EQ(image.inverse_depth_per_m[pixel], random.samples.inverse_depth_per_m[address]);
        }
        const auto held = std::count_if(image.inverse_depth_per_m.begin(), image.inverse_depth_per_m.end(),
                                        [](float depth) { return depth != -1.0F; });
        ASSERT_EQ(static_cast<std::size_t>(held), random.plan.trace_order.size());
    }
}

TEST(SampleImage, KeepsOtherPixelsWhereItIsNotCleared) {
    const test::Case random = test::random_case(7);
    SampleImage image;
    image.fill(random.plan, random.samples, true);
    SampleImage expected = image;
    for (std::size_t pixel = 0; pixel < image.color.size(); ++pixel)
        if (image.inverse_depth_per_m[pixel] < 0.0F) {
            image.color[pixel] = expected.color[pixel] = static_cast<Rgba8>(pixel);
            image.inverse_depth_per_m[pixel] = expected.inverse_depth_per_m[pixel] = 9.0F;
        }
    image.fill(random.plan, random.samples, false);
    EXPECT_EQ(image.color, expected.color);
    EXPECT_EQ(image.inverse_depth_per_m, expected.inverse_depth_per_m);
}

}  // namespace
}  // namespace macula
