#include "server/service/handshake.h"

#include <gtest/gtest.h>

#include "tests/support/render_fakes.h"

namespace macula {
namespace {

Hello good_hello() {
    Hello hello;
    hello.client_name = "test";
    hello.token = "secret";
    hello.display_name = "small";
    hello.eye_width_px = 64;
    hello.eye_height_px = 80;
    hello.codecs = {"av1", "h264"};
    return hello;
}

Supplies fake_supplies() {
    Supplies supplies;
    Scene scene;
    scene.name = "scene";
    scene.near_m = 0.5F;
    scene.world_from_start.position_m = {1.0F, 2.0F, 3.0F};
    supplies.scene = std::make_shared<const Scene>(scene);
    supplies.tracer = std::make_shared<testing::FakeTracer>();
    auto rank_tile = std::make_shared<RankTile>();
    rank_tile->rank[5] = 77;
    supplies.rank_tile = rank_tile;
    supplies.renderer = "fakes";
    supplies.default_sampling = "27";
    supplies.make_sampler = [](const Display& display, Eye,
                               const std::string& preset) -> Expected<std::unique_ptr<Sampler>> {
        if (preset != "27" && preset != "full") return fail(ErrorCode::option, "no sampling preset " + preset);
        return std::make_unique<testing::FakeSampler>(display.eye_width_px, display.eye_height_px);
    };
    supplies.make_reconstructor = [](const std::string&) { return std::make_unique<testing::FakeReconstructor>(); };
    supplies.make_color_encoder = [](int width_px, int height_px, double) {
        EXPECT_EQ(width_px, 128);
        EXPECT_EQ(height_px, 80);
        return std::make_unique<testing::FakeVideoEncoder>();
    };
    supplies.make_depth_encoder = [](int, int, double) { return std::make_unique<testing::FakeDepthEncoder>(); };
    return supplies;
}

TEST(Authenticate, KnowsTheToken) {
    Hello hello = good_hello();
    EXPECT_TRUE(authenticate(hello, "secret"));
    for (const char* wrong : {"", "secreT", "secret ", "secre"}) {
        hello.token = wrong;
        const auto outcome = authenticate(hello, "secret");
        ASSERT_FALSE(outcome) << wrong;
        EXPECT_EQ(outcome.error().code, ErrorCode::refused);
        EXPECT_NE(outcome.error().message.find("token"), std::string::npos);
    }
}

TEST(Authenticate, VersionComesFirstAndBothAreNamed) {
    Hello hello = good_hello();
    hello.protocol_version = kProtocolVersion + 41;
    hello.token = "wrong";
    const auto outcome = authenticate(hello, "secret");
    ASSERT_FALSE(outcome);
    EXPECT_EQ(outcome.error().code, ErrorCode::refused);
    EXPECT_NE(outcome.error().message.find(std::to_string(kProtocolVersion + 41)), std::string::npos);
    EXPECT_NE(outcome.error().message.find("version " + std::to_string(kProtocolVersion)), std::string::npos);
    EXPECT_EQ(outcome.error().message.find("token"), std::string::npos);
}

TEST(Admit, WelcomeSaysWhatTheClientGets) {
    const auto admission = admit(good_hello(), fake_supplies());
    ASSERT_TRUE(admission) << admission.error().message;
    const Welcome& welcome = admission->welcome;
    EXPECT_EQ(welcome.protocol_version, kProtocolVersion);
    EXPECT_EQ(welcome.scene_name, "scene");
    EXPECT_EQ(welcome.codec, "h264");
    EXPECT_EQ(welcome.sampling, "27");
    EXPECT_EQ(welcome.renderer, "fakes");
    EXPECT_EQ(welcome.rank_tile_size_px, 64);
    ASSERT_EQ(welcome.rank_tile.size(), 64U * 64U);
    EXPECT_EQ(welcome.rank_tile[5], 77);
    EXPECT_EQ(welcome.world_from_start.position_m, glm::vec3(1.0F, 2.0F, 3.0F));
    EXPECT_EQ(admission->parts.refresh_hz, 90.0);
    EXPECT_EQ(admission->parts.frame_pixels, 2U * 64U * 80U);
}

TEST(Admit, ClientMayChooseTheSampling) {
    Hello hello = good_hello();
    hello.sampling = "full";
    const auto admission = admit(hello, fake_supplies());
    ASSERT_TRUE(admission);
    EXPECT_EQ(admission->welcome.sampling, "full");
}

TEST(Admit, ThePhaseIsShiftedForClientsThatAccumulate) {
    for (const bool accumulates : {true, false}) {
        Hello hello = good_hello();
        hello.accumulates = accumulates;
        const auto admission = admit(hello, fake_supplies());
        ASSERT_TRUE(admission);
        Picture first;
        Picture second;
        ASSERT_TRUE(admission->parts.frame_maker->make(Track{}, 0, first));
        ASSERT_TRUE(admission->parts.frame_maker->make(Track{}, 0, second));
        for (const Eye eye : {kLeftEye, kRightEye}) {
            EXPECT_EQ(first.frame.sampling[eye].phase_px != second.frame.sampling[eye].phase_px, accumulates);
        }
    }
}

TEST(Admit, OtherMethodsAreMadeForTheSameDisplay) {
    const auto admission = admit(good_hello(), fake_supplies());
    ASSERT_TRUE(admission);
    EXPECT_TRUE(admission->welcome.can_choose);
    const auto method = admission->parts.make_method("full");
    ASSERT_TRUE(method) << method.error().message;
    ASSERT_TRUE((*method)->reconstructor);
    for (const auto& sampler : (*method)->samplers) {
        SamplePlan plan;
        sampler->plan({}, plan);
        EXPECT_EQ(plan.width_px, 64);
        EXPECT_EQ(plan.height_px, 80);
    }
    const auto unknown = admission->parts.make_method("99");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().message, "no sampling preset 99");
}

TEST(Admit, SaysWhatIsWrong) {
    const auto reason = [](const Hello& hello, const Supplies& supplies = fake_supplies()) {
        const auto admission = admit(hello, supplies);
        EXPECT_FALSE(admission);
        return admission ? std::string() : admission.error().message;
    };
    Hello hello = good_hello();
    hello.codecs = {"av1"};
    EXPECT_NE(reason(hello).find("h264"), std::string::npos);

    hello = good_hello();
    hello.sampling = "99";
    EXPECT_NE(reason(hello).find("99"), std::string::npos);

    hello = good_hello();
    hello.eyes[kRightEye].tangents.left = hello.eyes[kRightEye].tangents.right;
    EXPECT_NE(reason(hello), "");

    Supplies supplies = fake_supplies();
    supplies.make_reconstructor = [](const std::string&) { return fail(ErrorCode::graphics, "no context"); };
    EXPECT_EQ(reason(good_hello(), supplies), "no context");

    supplies = fake_supplies();
    supplies.make_color_encoder = [](int, int, double) { return fail(ErrorCode::option, "no encoder"); };
    EXPECT_EQ(reason(good_hello(), supplies), "no encoder");
}

}  // namespace
}  // namespace macula
