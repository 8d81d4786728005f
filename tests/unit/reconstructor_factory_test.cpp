// Where a server reconstructs, by options and by what the machine has.

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "server/render/reconstructor_choice.h"
#include "server/render/reconstructor_factory.h"
#include "tests/support/reconstruct_cases.h"

namespace macula {
namespace {

Expected<std::unique_ptr<ReconstructorFactory>> factory_for(const std::string& context, const std::string& on) {
    return make_reconstructor_factory(
        {.context = context, .reconstruct_on = on, .eye_width_px = 320, .eye_height_px = 240}, test::shared_tables());
}

TEST(ReconstructorFactory, CpuNeedsNoContext) {
    const auto factory = factory_for("auto", "cpu");
    ASSERT_TRUE(factory) << factory.error().message;
    EXPECT_EQ((*factory)->name(), "C++");
    EXPECT_TRUE((*factory)->make());
}

TEST(ReconstructorFactory, GlIsTakenWhereItIsAskedFor) {
    for (const auto& [option, name] : {std::pair{"surfaceless", "EGL surfaceless"}, std::pair{"osmesa", "OSMesa"}}) {
        const auto factory = factory_for(option, "gl");
        ASSERT_TRUE(factory) << factory.error().message;
        EXPECT_NE((*factory)->name().find(name), std::string::npos) << (*factory)->name();
        const auto reconstructor = (*factory)->make();
        ASSERT_TRUE(reconstructor) << reconstructor.error().message;
        EXPECT_EQ((*reconstructor)->name(), (*factory)->name());
    }
}

TEST(ReconstructorFactory, OnSoftwareGlTheFasterIsTaken) {
    const auto choice =
        choose_reconstructor(ContextKind::osmesa, ReconstructOn::automatic, test::shared_tables(), {320, 240});
    ASSERT_TRUE(choice) << choice.error().message;
    EXPECT_GT(choice->gl_ms, 0.0);
    EXPECT_GT(choice->cpu_ms, 0.0);
    EXPECT_EQ(choice->use_gl, choice->gl_ms < choice->cpu_ms);
    EXPECT_NE(choice->reason.find("320x240"), std::string::npos) << choice->reason;
}

TEST(ReconstructorFactory, UnknownOptionsAreRefused) {
    for (const auto& [context, on] : {std::pair{"vulkan", "auto"}, std::pair{"auto", "gpu"}}) {
        const auto factory = factory_for(context, on);
        ASSERT_FALSE(factory);
        EXPECT_EQ(factory.error().code, ErrorCode::option);
    }
}

TEST(ReconstructorFactory, ADeviceThatIsAskedForAndMissingIsAnError) {
    if (make_gl_context(ContextKind::egl)) GTEST_SKIP() << "this machine has a GPU";
    for (const char* on : {"auto", "gl"}) {
        const auto factory = factory_for("egl", on);
        ASSERT_FALSE(factory);
        EXPECT_EQ(factory.error().code, ErrorCode::graphics);
        EXPECT_NE(factory.error().message.find("EGL device"), std::string::npos) << factory.error().message;
    }
}

TEST(ReconstructorFactory, ServesSessionsOnSeveralThreads) {
    const auto factory = factory_for("auto", "gl");
    ASSERT_TRUE(factory) << factory.error().message;
    const test::Case session = test::random_case(5);
    const test::Picture expected =
        test::reconstruct(*make_reference_reconstructor(test::shared_tables()), session.plan, session.samples);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] {
            const auto reconstructor = (*factory)->make();
            ASSERT_TRUE(reconstructor) << reconstructor.error().message;
            for (int frame = 0; frame < 5; ++frame)
                EXPECT_EQ(test::reconstruct(**reconstructor, session.plan, session.samples).color.texels,
                          expected.color.texels);
        });
    for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace macula
