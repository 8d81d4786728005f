// However many threads trace, and whichever batches they take, the picture is the same.

#include <gtest/gtest.h>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "scenes/load.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

struct Frame {
    PerEye<Samples> samples;
    TraceCounts counts;
};

Frame trace_with(int threads, const Tracer& tracer, const PerEye<EyeView>& views, const PerEye<SamplePlan>& plans) {
    // The arena has the threads that it asks for also on a machine of fewer cores.
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    Frame frame;
    for (Samples& s : frame.samples) s.keep_radiance = s.keep_image_depth = true;
    const std::array tasks{TraceTask{views.data(), plans.data(), frame.samples.data()},
                           TraceTask{&views[1], &plans[1], &frame.samples[1]}};
    arena.execute([&] { frame.counts = tracer.trace(tasks); });
    return frame;
}

TEST(TracerThreads, PathsAreTheSameHoweverManyTraceThem) {
    const auto loaded = load_scene("bunny-box");
    ASSERT_TRUE(loaded) << loaded.error().message;
    const auto tracer = test::tracer_of(*loaded->scene);
    PerEye<EyeView> views{test::square_view(96), test::square_view(51)};
    for (EyeView& view : views) view.world_from_eye = loaded->scene->world_from_start;
    views[1].world_from_eye.position_m.x += 0.06F;
    const PerEye<SamplePlan> plans{test::full_plan(96, 96), test::full_plan(51, 51)};
    const Frame expected = trace_with(1, *tracer, views, plans);
    EXPECT_GT(expected.counts.reflection, 100U);
    EXPECT_GT(expected.counts.transmission, 100U);
    for (const int threads : {2, 8}) {
        SCOPED_TRACE(threads);
        const Frame frame = trace_with(threads, *tracer, views, plans);
        for (const Eye eye : {kLeftEye, kRightEye}) {
            const Samples& found = frame.samples[eye];
            const Samples& wanted = expected.samples[eye];
            EXPECT_EQ(found.radiance, wanted.radiance);
            EXPECT_EQ(found.color, wanted.color);
            EXPECT_EQ(found.inverse_depth_per_m, wanted.inverse_depth_per_m);
            EXPECT_EQ(found.image_inverse_depth_per_m, wanted.image_inverse_depth_per_m);
            EXPECT_EQ(found.object_id, wanted.object_id);
        }
        EXPECT_EQ(frame.counts.primary, expected.counts.primary);
        EXPECT_EQ(frame.counts.shadow, expected.counts.shadow);
        EXPECT_EQ(frame.counts.reflection, expected.counts.reflection);
        EXPECT_EQ(frame.counts.transmission, expected.counts.transmission);
        EXPECT_EQ(frame.counts.skipped_shadow, expected.counts.skipped_shadow);
        EXPECT_EQ(frame.counts.skipped_bounce, expected.counts.skipped_bounce);
    }
}

}  // namespace
}  // namespace macula
