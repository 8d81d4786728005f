// Bunny Box against a reference picture. MACULA_WRITE_GOLDEN=1 writes a new reference; look at it before you commit it.

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "scenes/load.h"
#include "server/render/tracer.h"
#include "tests/support/pictures.h"
#include "tests/support/plans.h"

namespace macula {
namespace {

const std::string kReferencePath = MACULA_SOURCE_DIR "/tests/golden/bunny_box.png";

/// Processors round differently, so that a ray at an edge may fall to the other side: two pixels from black to white
/// in an 8x8 block change its mean by 8. Over the whole picture such pixels even out.
constexpr double kLocalTolerance = 8.0;
constexpr double kMeanTolerance = 0.1;

ColorImage render(std::shared_ptr<const Scene> scene) {
    EyeView view;
    view.world_from_eye = scene->world_from_start;
    view.tangents = {-1.0F, 1.0F, -0.75F, 0.75F};
    view.width_px = 256;
    view.height_px = 192;
    const auto tracer = make_embree_tracer(std::move(scene));
    if (!tracer) throw std::runtime_error(tracer.error().message);  // a test that cannot go on
    const SamplePlan plan = test::full_plan(view.width_px, view.height_px);
    Samples samples;
    const TraceTask task{&view, &plan, &samples};
    (*tracer)->trace({&task, 1});
    ColorImage image(view.width_px, view.height_px);
    image.texels = samples.color;
    return image;
}

TEST(BunnyBox, LooksLikeItsReference) {
    const auto loaded = load_scene("bunny-box");
    ASSERT_TRUE(loaded) << loaded.error().message;
    if (!loaded->warnings.empty()) GTEST_SKIP() << "not the scene of the reference: " << loaded->warnings.front();
    const ColorImage result = render(loaded->scene);
    if (std::getenv("MACULA_WRITE_GOLDEN") != nullptr) {
        const auto written = test::write_png(kReferencePath, result);
        ASSERT_TRUE(written) << written.error().message;
        GTEST_SKIP() << "wrote " << kReferencePath;
    }
    const auto reference = test::read_png(kReferencePath);
    ASSERT_TRUE(reference) << reference.error().message;
    ASSERT_EQ(reference->width_px, result.width_px);
    ASSERT_EQ(reference->height_px, result.height_px);
    const test::PictureDifference difference = test::compare(result, *reference);
    EXPECT_LT(difference.largest_local, kLocalTolerance);
    EXPECT_LT(difference.signed_mean, kMeanTolerance);
    if (HasFailure()) {
        const std::string stem = testing::TempDir() + "bunny_box_";
        EXPECT_TRUE(test::write_png(stem + "reference.png", *reference));
        EXPECT_TRUE(test::write_png(stem + "result.png", result));
        EXPECT_TRUE(test::write_png(stem + "difference.png", difference.picture));
        ADD_FAILURE() << "see " << stem << "{reference,result,difference}.png";
    }
}

}  // namespace
}  // namespace macula
