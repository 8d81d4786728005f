// What macula-render's options mean: displays, cameras, poses, gazes, laws, layers.

#include "server/offline/shot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "server/offline/report.h"
#include "server/offline/writer.h"

namespace macula {
namespace {

using glm::vec3;

/// Tables are of no interest here, but samplers want some.
const std::shared_ptr<const TileTables>& tables() {
    static const auto kTables = std::make_shared<const TileTables>(make_rank_tile());
    return kTables;
}

std::vector<Shot> shots_of(const RenderOptions& options, const Pose& start = {}) {
    const auto plan = ShotPlan::parse(options);
    EXPECT_TRUE(plan) << plan.error().message;
    if (!plan) return {};
    MeshShelf meshes({}, [](const std::string&) {});
    auto shots = plan->shots(start, tables(), meshes);
    EXPECT_TRUE(shots) << shots.error().message;
    return shots ? *std::move(shots) : std::vector<Shot>{};
}

void expect_near(const vec3& a, const vec3& b) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-6F);
}

RenderOptions camera(double fov_deg, const std::string& size) {
    RenderOptions options;
    options.camera_fov_deg = fov_deg;
    options.size = size;
    return options;
}

TEST(Shot, AnEyeOfADisplay) {
    RenderOptions options;
    options.display = "desktop";
    options.eye = "right";
    const std::vector<Shot> shots = shots_of(options);
    ASSERT_EQ(shots.size(), 1U);
    const Display desktop = *load_display("desktop");
    EXPECT_EQ(shots[0].name, "right");
    EXPECT_EQ(shots[0].view.width_px, desktop.eye_width_px);
    EXPECT_EQ(shots[0].view.tangents.left, desktop.eyes[kRightEye].tangents.left);
    expect_near(shots[0].view.world_from_eye.position_m, desktop.eyes[kRightEye].head_from_eye.position_m);
    options.eye = "both";
    EXPECT_EQ(shots_of(options).size(), 2U);
}

TEST(Shot, ACameraHasSquarePixelsAndTheVerticalField) {
    const std::vector<Shot> shots = shots_of(camera(90.0, "320x160"));
    ASSERT_EQ(shots.size(), 1U);
    EXPECT_EQ(shots[0].name, "");
    EXPECT_EQ(shots[0].view.width_px, 320);
    EXPECT_EQ(shots[0].view.height_px, 160);
    EXPECT_FLOAT_EQ(shots[0].view.tangents.top, 1.0F);
    EXPECT_FLOAT_EQ(shots[0].view.tangents.left, -2.0F);
    expect_near(shots[0].view.world_from_eye.position_m, vec3(0.0F));
}

TEST(Shot, PositionReplacesAndTurnsAddToTheStartPose) {
    RenderOptions options = camera(60.0, "32x32");
    options.position = "1,-2.5,3e1";
    options.yaw_deg = 90.0;
    options.pitch_deg = 30.0;
    const vec3 ahead(0.0F, 0.0F, -1.0F);
    const Pose eye = shots_of(options)[0].view.world_from_eye;
    expect_near(eye.position_m, {1.0F, -2.5F, 30.0F});
    expect_near(eye.direction(ahead), {-std::sqrt(0.75F), 0.5F, 0.0F});
    const Pose start{glm::angleAxis(glm::radians(90.0F), vec3(0.0F, 1.0F, 0.0F)), {7.0F, 8.0F, 9.0F}};
    options.position = "";
    const Pose turned = shots_of(options, start)[0].view.world_from_eye;
    expect_near(turned.position_m, {7.0F, 8.0F, 9.0F});
    expect_near(turned.direction(ahead), {0.0F, 0.5F, std::sqrt(0.75F)});
}

TEST(Shot, GazeGoesLeftAndUp) {
    RenderOptions options = camera(60.0, "32x32");
    options.gaze = "30,0";
    expect_near(shots_of(options)[0].gaze_eye, {-0.5F, 0.0F, -std::sqrt(0.75F)});
    options.gaze = "0,30";
    expect_near(shots_of(options)[0].gaze_eye, {0.0F, 0.5F, -std::sqrt(0.75F)});
}

TEST(Shot, SamplingSetsTheShare) {
    RenderOptions options = camera(80.0, "256x256");
    for (const auto& [sampling, share] : {std::pair{"full", 1.0}, std::pair{"54", 0.54}, std::pair{"18", 0.18}}) {
        options.sampling = sampling;
        std::vector<Shot> shots = shots_of(options);
        shots[0].sampler->plan({shots[0].gaze_eye, glm::ivec2(0)}, shots[0].plan);
        EXPECT_NEAR(shots[0].plan.traced_share(), share, 0.02) << sampling;
        EXPECT_EQ(ShotPlan::parse(options)->full(), share == 1.0);
    }
    // A law that needs every pixel everywhere.
    options.sampling = "law:e2=1000,exponent=1";
    std::vector<Shot> shots = shots_of(options);
    shots[0].sampler->plan({shots[0].gaze_eye, glm::ivec2(0)}, shots[0].plan);
    EXPECT_EQ(shots[0].plan.traced_share(), 1.0);
    EXPECT_FALSE(ShotPlan::parse(options)->full());
}

TEST(Shot, OddSizesAreCoveredWhole) {
    std::vector<Shot> shots = shots_of(camera(50.0, "37x21"));
    shots[0].sampler->plan({shots[0].gaze_eye, glm::ivec2(0)}, shots[0].plan);
    EXPECT_EQ(shots[0].plan.traced_in_window, 37U * 21U);
}

void expect_option_error(const std::function<void(RenderOptions&)>& spoil, const std::string& named) {
    RenderOptions options = camera(60.0, "32x32");
    spoil(options);
    const auto plan = ShotPlan::parse(options);
    ASSERT_FALSE(plan) << named;
    EXPECT_EQ(plan.error().code, ErrorCode::option);
    EXPECT_NE(plan.error().message.find(named), std::string::npos) << plan.error().message;
}

TEST(Shot, NamesTheOptionThatIsWrong) {
    for (const char* size : {"", "32", "32x", "x32", "32x32x32", "15x32", "32x8193", "32.5x32", "nanxinf"})
        expect_option_error([&](RenderOptions& o) { o.size = size; }, "--size");
    for (const char* position : {"1", "1,2", "1,2,", "1,2,3,4", "a,b,c", "1,2,inf", "1;2;3"})
        expect_option_error([&](RenderOptions& o) { o.position = position; }, "--position");
    for (const char* gaze : {"", "1", "1,2,3", "left,up"})
        expect_option_error([&](RenderOptions& o) { o.gaze = gaze; }, "--gaze");
    for (const char* law : {"law:", "law:e2", "law:e2=0", "law:e3=1", "law:contrast=1", "law:e2=1,", "law:e2=nan"})
        expect_option_error([&](RenderOptions& o) { o.sampling = law; }, law);
    expect_option_error([](RenderOptions& o) { o.sampling = "all"; }, "all");
    expect_option_error(
        [](RenderOptions& o) {
            o.camera_fov_deg = 0.0;
            o.display = "monocle";
        },
        "monocle");
}

TEST(ParseLayers, KnowsAllAndRefusesOthers) {
    const auto layers = parse_layers("levels,color");
    ASSERT_TRUE(layers);
    EXPECT_TRUE(layers->color && layers->levels);
    EXPECT_FALSE(layers->depth || layers->object || layers->positions);
    for (const char* text : {"", "colour", "color,", ",color", "color depth"}) EXPECT_FALSE(parse_layers(text)) << text;
}

TEST(QuantileOf, IsTheNearestRank) {
    EXPECT_EQ(quantile_of({}, 0.5), 0.0);
    EXPECT_EQ(quantile_of({3.0}, 0.99), 3.0);
    EXPECT_EQ(quantile_of({4.0, 1.0, 3.0, 2.0}, 0.5), 2.0);
    EXPECT_EQ(quantile_of({4.0, 1.0, 3.0, 2.0}, 0.99), 4.0);
}

}  // namespace
}  // namespace macula
