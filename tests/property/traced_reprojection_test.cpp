// From the tracer to what is shown: the frames of a foveated server, accumulated and reprojected, against what should
// be seen. A mirror that shows a checked wall, seen by a head that moves sideways: with the depth of the image behind
// the mirror its pixels are followed, with that of its surface they are not. A checked panel that an animation moves.

#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "masks/law.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/codec/depth_plane.h"
#include "protocol/message/byte_map.h"
#include "server/service/frame_maker.h"
#include "tests/support/law_for_share.h"

namespace macula {
namespace {

constexpr int kEdge_px = 192;
constexpr int kFrames = 16;
constexpr std::int64_t kPeriod_ns = 33'333'333;
constexpr float kMirror_m = 2.0F;  ///< before the eye
constexpr float kWall_m = 3.0F;    ///< behind it: its image lies 7 m ahead

void add_quad(Mesh& mesh, const glm::vec3& corner, const glm::vec3& along, const glm::vec3& up) {
    const auto first = static_cast<std::uint32_t>(mesh.position_m.size());
    for (const glm::vec3& p : {corner, corner + along, corner + along + up, corner + up}) {
        mesh.position_m.push_back(p);
        mesh.normal.push_back(glm::normalize(glm::cross(along, up)));
    }
    mesh.triangle.emplace_back(first, first + 1, first + 2);
    mesh.triangle.emplace_back(first, first + 2, first + 3);
}

/// A square of unlit checks around (0, 0, z_m): two meshes, each with its instance on a node.
void add_checks(Scene& scene, float z_m, float edge_m, int across, const glm::vec3& color, int node) {
    for (const float grey : {0.15F, 0.8F}) {
        Material paint;
        paint.unlit = true;
        paint.double_sided = true;
        paint.base_color = glm::vec4(grey * color, 1.0F);
        Mesh mesh;
        mesh.material = static_cast<int>(scene.materials.size());
        for (int y = -across / 2; y < across / 2; ++y) {
            for (int x = -across / 2; x < across / 2; ++x) {
                if (((x + y) % 2 == 0) != (grey > 0.5F)) continue;
                add_quad(mesh, {edge_m * static_cast<float>(x), edge_m * static_cast<float>(y), z_m},
                         {edge_m, 0.0F, 0.0F}, {0.0F, edge_m, 0.0F});
            }
        }
        Instance instance;
        instance.mesh = static_cast<int>(scene.meshes.size());
        instance.node = node;
        scene.materials.push_back(paint);
        scene.meshes.push_back(std::move(mesh));
        scene.instances.push_back(instance);
    }
}

std::shared_ptr<const Scene> mirror_scene() {
    Scene scene;
    Material mirror;
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    scene.materials.push_back(mirror);
    scene.meshes.resize(1);
    scene.instances.resize(1);
    add_quad(scene.meshes[0], {-3.0F, -3.0F, -kMirror_m}, {6.0F, 0.0F, 0.0F}, {0.0F, 6.0F, 0.0F});
    add_checks(scene, kWall_m, 0.4F, 40, {1.0F, 0.7F, 0.5F}, -1);
    scene.near_m = 0.5F;
    return std::make_shared<const Scene>(std::move(scene));
}

/// A panel 2 m ahead that turns about the line of sight, once in two seconds, while it slides to the right at .9 m/s;
/// behind it a wall.
std::shared_ptr<const Scene> panel_scene() {
    Scene scene;
    AnimationChannel slide;
    slide.time_s = {0.0F, 2.0F};
    slide.value = {{-0.6F, 0.0F, -2.0F, 0.0F}, {1.2F, 0.0F, -2.0F, 0.0F}};
    AnimationChannel turn;
    turn.path = AnimationPath::rotation;
    for (int i = 0; i <= 4; ++i) {
        const float half = static_cast<float>(i) * std::numbers::pi_v<float> / 4.0F;
        turn.time_s.push_back(0.5F * static_cast<float>(i));
        turn.value.emplace_back(0.0F, 0.0F, std::sin(half), std::cos(half));
    }
    slide.period_s = turn.period_s = scene.animation.duration_s = 2.0F;
    scene.animation.channels = {slide, turn};
    scene.animation.nodes.resize(1);
    add_checks(scene, 0.0F, 0.12F, 10, {0.5F, 0.7F, 1.0F}, 0);
    for (Instance& instance : scene.instances) instance.world_from_mesh[3] = glm::vec4(-0.6F, 0.0F, -2.0F, 1.0F);
    add_checks(scene, -4.0F, 0.4F, 40, {1.0F, 0.7F, 0.5F}, -1);
    scene.near_m = 0.5F;
    return std::make_shared<const Scene>(std::move(scene));
}

Display square_display() {
    Display display;
    display.name = "test";
    display.eye_width_px = display.eye_height_px = kEdge_px;
    return display;
}

/// What a still eye sees through the middle of each pixel and 15 places around it.
ColorImage truth(const Tracer& tracer, const Pose& pose, double time_s) {
    SamplePlan plan;
    plan.width_px = plan.height_px = kEdge_px;
    for (int y = 0; y < kEdge_px; ++y) {
        for (int x = 0; x < kEdge_px; ++x) {
            plan.trace_order.push_back(static_cast<std::uint32_t>(plan.position.size()));
            plan.position.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
        }
    }
    plan.offset = {0, static_cast<std::uint32_t>(plan.position.size())};
    const EyeView view{pose, Tangents{}, kEdge_px, kEdge_px};
    std::vector<glm::vec3> sum(plan.position.size(), glm::vec3(0.0F));
    Samples samples;
    for (int i = 0; i < 16; ++i) {
        TraceTask task{&view, &plan, &samples};
        task.sample_px = (glm::vec2(i % 4, i / 4) + 0.5F) / 4.0F;
        tracer.trace({&task, 1}, time_s);
        for (std::size_t j = 0; j < sum.size(); ++j) {
            const Rgba8 color = samples.color[j];
            sum[j] += glm::vec3(color & 255U, color >> 8 & 255U, color >> 16 & 255U);
        }
    }
    ColorImage picture(kEdge_px, kEdge_px);
    for (std::size_t j = 0; j < sum.size(); ++j) {
        const glm::uvec3 mean(sum[j] / 16.0F + 0.5F);
        picture.texels[j] = 0xFF000000U | mean.x | mean.y << 8 | mean.z << 16;
    }
    return picture;
}

/// Without a margin: what comes into view at the edge has no history.
double psnr_db(const ColorImage& picture, const ColorImage& truth, int margin_px) {
    double squares = 0.0;
    double count = 0.0;
    for (int y = margin_px; y < kEdge_px - margin_px; ++y) {
        for (int x = margin_px; x < kEdge_px - margin_px; ++x) {
            for (int shift = 0; shift < 24; shift += 8) {
                const double d = static_cast<double>(picture.at(x, y) >> shift & 255U) -
                                 static_cast<double>(truth.at(x, y) >> shift & 255U);
                squares += d * d;
                count += 1.0;
            }
        }
    }
    return 10.0 * std::log10(255.0 * 255.0 * count / squares);
}

/// What is compared.
struct Way {
    bool image_depth = false;  ///< depth of what is seen in mirrors
    bool motion = false;       ///< frames say what moves
    glm::vec3 step_m{0.0F};    ///< of the head, from frame to frame
    int margin_px = 8;         ///< of the picture that is not judged
};

struct Shown {
    double accumulated_db = 0.0;  ///< the last frame, accumulated
    double late_db = 0.0;         ///< the same, shown 25 ms later from 5 cm further if the head moves
    std::size_t motion_bytes = 0;
};

Shown play(const std::shared_ptr<const Scene>& scene, const std::shared_ptr<const Tracer>& tracer, const Way& way) {
    const Display display = square_display();
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    FrameMaker::Parts parts;
    parts.scene = scene;
    parts.image_depth = way.image_depth;
    parts.tracer = tracer;
    for (const Eye eye : {kLeftEye, kRightEye}) {
        parts.samplers[eye] = std::make_unique<TileSampler>(display, eye, law_for_share(display, eye, 0.27), tables);
    }
    parts.reconstructor = make_cpu_reconstructor(tables);
    FrameMaker maker(display, std::move(parts));
    const auto compositor = make_cpu_compositor(display, default_taa_weights());
    Picture picture;
    InverseDepthImage depth(kEdge_px / 2, kEdge_px / 4);
    std::vector<std::uint8_t> codes(depth.texels.size());
    for (int i = 0; i < kFrames; ++i) {
        Track track;
        track.pose_time_ns = track.display_time_ns = i * kPeriod_ns;
        track.start_from_head.position_m = way.step_m * static_cast<float>(i);
        EXPECT_TRUE(maker.make(track, track.pose_time_ns, picture));
        nearest_depth_codes(picture.inverse_depth, scene->near_m, codes.data(), depth.width_px);
        for (std::size_t j = 0; j < codes.size(); ++j) depth.texels[j] = inverse_depth_of(codes[j], scene->near_m);
        NewFrame frame;
        frame.color = &picture.color;
        frame.depth = &depth;
        frame.world_from_eye = picture.frame.world_from_eye;
        frame.sampling = {&picture.frame.sampling[0], &picture.frame.sampling[1]};
        frame.rank_tile = tables->rank_tile().rank;
        frame.rank_tile_size_px = RankTile::kEdge_px;
        Image<std::uint8_t> map(depth.width_px, depth.height_px);
        if (way.motion && !picture.frame.moving.empty()) {
            frame.display_time_ns = picture.frame.display_time_ns;
            frame.moving = picture.frame.moving;
            map.texels = unpack_map(picture.frame.moving_map, map.texels.size()).value();
            frame.moving_map = &map;
        }
        EXPECT_TRUE(compositor->accumulate(frame));
    }
    ColorImage shown;
    Shown result;
    result.motion_bytes = picture.frame.moving.size() * 100 + picture.frame.moving_map.size();
    constexpr std::int64_t kLast_ns = (kFrames - 1) * kPeriod_ns;
    constexpr std::int64_t kLate_ns = 25'000'000;
    Pose pose = picture.frame.world_from_eye[0];
    EXPECT_TRUE(compositor->show({pose, pose}, kLast_ns, shown));
    result.accumulated_db = psnr_db(shown, truth(*tracer, pose, 1e-9 * static_cast<double>(kLast_ns)), way.margin_px);
    pose.position_m += 2.5F * way.step_m;
    EXPECT_TRUE(compositor->show({pose, pose}, kLast_ns + kLate_ns, shown));
    result.late_db =
        psnr_db(shown, truth(*tracer, pose, 1e-9 * static_cast<double>(kLast_ns + kLate_ns)), way.margin_px);
    return result;
}

void print(const char* way, const Shown& shown) {
    std::printf("             %-24s accumulated %.2f dB, shown late %.2f dB\n", way, shown.accumulated_db,
                shown.late_db);
}

std::shared_ptr<const Tracer> make_tracer(const std::shared_ptr<const Scene>& scene) {
    auto made = make_embree_tracer(scene);
    EXPECT_TRUE(made) << made.error().message;
    return *std::move(made);
}

TEST(TracedReprojection, FollowsTheImageBehindAMirror) {
    const auto scene = mirror_scene();
    const auto tracer = make_tracer(scene);
    const glm::vec3 sideways_m(0.02F, 0.0F, 0.0F);
    const Shown image = play(scene, tracer, {.image_depth = true, .step_m = sideways_m});
    const Shown surface = play(scene, tracer, {.step_m = sideways_m});
    print("depth of the image:", image);
    print("depth of the mirror:", surface);
    EXPECT_EQ(image.motion_bytes, 0U);
    EXPECT_GT(image.accumulated_db, surface.accumulated_db + 2.0);
    EXPECT_GT(image.late_db, surface.late_db + 4.0);
}

TEST(TracedReprojection, FollowsAMovingPanel) {
    const auto scene = panel_scene();
    const auto tracer = make_tracer(scene);
    // Judged is the middle, most of which is the panel.
    for (const glm::vec3& step_m : {glm::vec3(0.0F), glm::vec3(0.01F, 0.0F, 0.0F)}) {
        const Shown with = play(scene, tracer, {.motion = true, .step_m = step_m, .margin_px = 62});
        const Shown without = play(scene, tracer, {.step_m = step_m, .margin_px = 62});
        print("with motion:", with);
        print("without:", without);
        EXPECT_GT(with.accumulated_db, without.accumulated_db + 1.0);
        EXPECT_GT(with.late_db, without.late_db + 2.0);
        EXPECT_GT(with.motion_bytes, 100U);
        EXPECT_LT(with.motion_bytes, 500U);
    }
}

}  // namespace
}  // namespace macula
