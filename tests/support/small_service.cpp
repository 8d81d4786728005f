#include "tests/support/small_service.h"

#include <gtest/gtest.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/null_sink.h>

#include "masks/law.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/codec/depth_codec.h"
#include "protocol/transport/tls.h"

namespace macula::testing {

namespace {

std::shared_ptr<const Scene> wall_scene() {
    Scene scene;
    scene.name = "wall";
    Material material;
    material.unlit = true;
    material.double_sided = true;
    material.base_color = {0.5F, 0.5F, 0.0F, 1.0F};
    scene.materials.push_back(material);
    Mesh mesh;
    const float half_m = 50.0F;
    const float z_m = -kWallDistance_m;
    mesh.position_m = {{-half_m, -half_m, z_m}, {half_m, -half_m, z_m}, {half_m, half_m, z_m}, {-half_m, half_m, z_m}};
    mesh.normal.assign(4, {0.0F, 0.0F, 1.0F});
    mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"wall", 0, glm::mat4(1.0F)});
    return std::make_shared<const Scene>(std::move(scene));
}

Supplies make_supplies() {
    Supplies supplies;
    supplies.scene = wall_scene();
    auto tracer = make_embree_tracer(supplies.scene);
    EXPECT_TRUE(tracer) << tracer.error().message;
    supplies.tracer = *std::move(tracer);
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    supplies.rank_tile = std::shared_ptr<const RankTile>(tables, &tables->rank_tile());
    supplies.renderer = supplies.tracer->name();
    supplies.default_sampling = "27";
    supplies.make_sampler = [tables](const Display& display, Eye eye,
                                     const std::string& name) -> Expected<std::unique_ptr<Sampler>> {
        const auto preset = parse_sampling(name);
        if (!preset) return tl::unexpected(preset.error());
        return std::make_unique<TileSampler>(display, eye, tile_law(display, eye, *preset), tables);
    };
    supplies.make_reconstructor = [tables](const std::string&) { return make_cpu_reconstructor(tables); };
    supplies.make_color_encoder = [](int width_px, int height_px, double frame_rate_hz) {
        return make_video_encoder({"libx264", width_px, height_px, frame_rate_hz, 25'000'000, 1});
    };
    supplies.make_depth_encoder = [](int width_px, int height_px, double frame_rate_hz) {
        return make_depth_encoder({width_px, height_px, frame_rate_hz, 1});
    };
    return supplies;
}

}  // namespace

const Supplies& small_supplies() {
    static const Supplies supplies = make_supplies();
    return supplies;
}

RunningServer::RunningServer(ServerOptions options, const Supplies& supplies) {
    auto pem = make_certificate();
    EXPECT_TRUE(pem) << pem.error().message;
    identity_.pem = *std::move(pem);
    identity_.credentials = {check_certificate(identity_.pem).value(), make_token().value()};
    auto listener = listen({"127.0.0.1", 0}, identity_);
    EXPECT_TRUE(listener) << listener.error().message;
    options.token = identity_.credentials.token;
    server_ = std::make_unique<Server>(
        *std::move(listener), supplies, std::move(options),
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::null_sink_mt>()));
    outcome_ = std::async(std::launch::async, [this] { return server_->run(); });
}

RunningServer::~RunningServer() {
    server_->stop();
    const auto outcome = outcome_.get();
    EXPECT_TRUE(outcome) << outcome.error().message;
}

}  // namespace macula::testing
