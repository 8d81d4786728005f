// macula-server: makes every part and connects them.

#include <chrono>
#include <csignal>
#include <filesystem>
#include <future>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <oneapi/tbb/global_control.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "masks/tile_tables.h"
#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "protocol/message/limits.h"
#include "protocol/transport/tls.h"
#include "scenes/load.h"
#include "scenes/needs.h"
#include "server/mesh_shelf.h"
#include "server/method_parts.h"
#include "server/options.h"
#include "server/render/reconstructor_factory.h"
#include "server/render/tracer.h"
#include "server/service/server.h"

namespace macula {
namespace {

using Logger = std::shared_ptr<spdlog::logger>;

/// The one thing that a signal handler may touch.
volatile std::sig_atomic_t stop_requested = 0;

void request_stop(int /*signal*/) {
    stop_requested = 1;
}

Logger make_logger(const std::string& level) {
    auto logger =
        std::make_shared<spdlog::logger>("macula-server", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    logger->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
    logger->set_level(spdlog::level::from_str(level));
    return logger;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Expected<Identity> load_identity(const std::string& state_option, const Logger& logger) {
    std::filesystem::path folder = state_option;
    if (folder.empty()) {
        auto usual = default_state_folder();
        if (!usual) return tl::unexpected(usual.error());
        folder = *std::move(usual);
    }
    auto identity = load_or_create_identity(folder);
    if (identity)
        logger->info("fingerprint {}, token in {}", identity->credentials.fingerprint, (folder / "token").string());
    return identity;
}

/// Logs how far a slow load is, about every second.
LoadProgress log_progress(const Logger& logger) {
    return [logger, next = std::chrono::steady_clock::now() + std::chrono::seconds(1)](const std::string& stage,
                                                                                       double share) mutable {
        if (std::chrono::steady_clock::now() < next) return;
        next = std::chrono::steady_clock::now() + std::chrono::seconds(1);
        logger->info("loading: {:.0f} %, {}", 100.0 * share, stage);
    };
}

Expected<std::shared_ptr<const Scene>> load(const SceneOptions& options, const Logger& logger) {
    logger->info("loading scene {}", options.scene);
    const auto start = std::chrono::steady_clock::now();
    auto loaded = load_scene(options, log_progress(logger));
    if (!loaded) return tl::unexpected(loaded.error());
    for (const std::string& warning : loaded->warnings) logger->warn("scene: {}", warning);
    const Scene& scene = *loaded->scene;
    std::size_t texture_bytes = 0;
    for (const TextureImage& image : scene.images) texture_bytes += image.texels.size();
    logger->info(
        "scene {}: {} triangles in {} instances of {} meshes, {} materials, {} textures ({:.1f} MB), {} lights; "
        "loaded in {:.2f} s",
        scene.name, scene.triangle_count(), scene.instances.size(), scene.meshes.size(), scene.materials.size(),
        scene.images.size(), 1e-6 * static_cast<double>(texture_bytes), scene.lights.size(), seconds_since(start));
    return loaded->scene;
}

Expected<std::shared_ptr<const Tracer>> make_tracer(std::shared_ptr<const Scene> scene, const TracerOptions& options,
                                                    const Logger& logger) {
    const auto start = std::chrono::steady_clock::now();
    auto tracer = make_embree_tracer(std::move(scene), options);
    if (!tracer) return tl::unexpected(tracer.error());
    logger->info("tracer: {}, ready in {:.2f} s", (*tracer)->name(), seconds_since(start));
    return std::shared_ptr<const Tracer>(*std::move(tracer));
}

Expected<std::shared_ptr<const ReconstructorFactory>> make_reconstructors(
    const Options& options, const std::shared_ptr<const TileTables>& tables, const Logger& logger) {
    ReconstructorOptions choice;
    choice.context = options.context;
    choice.reconstruct_on = options.reconstruct_on;
    auto factory = make_reconstructor_factory(choice, tables);
    if (!factory) return tl::unexpected(factory.error());
    logger->info("reconstruction: {}: {}", (*factory)->name(), (*factory)->reason());
    return std::shared_ptr<const ReconstructorFactory>(*std::move(factory));
}

Expected<std::shared_ptr<MeshShelf>> make_meshes(const Options& options, const Logger& logger) {
    auto meshes = std::make_shared<MeshShelf>(options.mesh_cache,
                                              [logger](const std::string& what) { logger->info("{}", what); });
    if (options.mesh.empty()) return meshes;
    if (auto read = meshes->read_own(options.mesh); !read) return tl::unexpected(read.error());
    return meshes;
}

/// Serves until SIGINT or SIGTERM.
Expected<void> serve(Server& server) {
    std::signal(SIGINT, request_stop);
    std::signal(SIGTERM, request_stop);
    std::future<Expected<void>> outcome = std::async(std::launch::async, [&server] { return server.run(); });
    while (stop_requested == 0 && outcome.wait_for(std::chrono::milliseconds(100)) == std::future_status::timeout) {
    }
    server.stop();
    return outcome.get();
}

/// Prints what the scene needs, and why, on standard output.
Expected<void> explain_scene(const SceneOptions& options, const Logger& logger) {
    const auto loaded = load_scene(options, log_progress(logger));
    if (!loaded) return tl::unexpected(loaded.error());
    for (const std::string& warning : loaded->warnings) logger->warn("scene: {}", warning);
    std::cout << explain(scene_needs(*loaded->scene)) << std::flush;
    return {};
}

Expected<void> run(const Options& options, const Logger& logger) {
    if (options.scene.explain) return explain_scene(options.scene, logger);
    // What can be wrong is looked at before the scene is loaded, which may take a while.
    const auto endpoint = parse_endpoint(options.listen);
    if (!endpoint) return tl::unexpected(endpoint.error());
    const auto method = parse_method(options.sampling);
    if (!method) return tl::unexpected(method.error());
    if (method->name.size() > kMaxName_bytes)
        return fail(ErrorCode::option, "--sampling: clients take names of methods up to " +
                                           std::to_string(kMaxName_bytes) + " bytes, not " + method->name);
    const auto meshes = make_meshes(options, logger);
    if (!meshes) return tl::unexpected(meshes.error());
    if (method->mesh_file) {
        if (auto own = (*meshes)->own(); !own) return tl::unexpected(own.error());
    }
    const auto make_color_encoder = [&options](int width_px, int height_px, double frame_rate_hz) {
        return make_video_encoder({options.encoder, width_px, height_px, frame_rate_hz, options.bit_rate_bps, 0});
    };
    if (auto encoder = make_color_encoder(256, 256, 90.0); !encoder) return tl::unexpected(encoder.error());
    const auto identity = load_identity(options.state, logger);
    if (!identity) return tl::unexpected(identity.error());
    auto listener = listen({endpoint->address, endpoint->port}, *identity);
    if (!listener) return tl::unexpected(listener.error());

    std::optional<oneapi::tbb::global_control> threads;
    if (options.threads > 0)
        threads.emplace(oneapi::tbb::global_control::max_allowed_parallelism,
                        static_cast<std::size_t>(options.threads));

    const auto scene = load(options.scene, logger);
    if (!scene) return tl::unexpected(scene.error());
    const SceneNeeds needs = scene_needs(**scene);
    logger->info("the scene needs: {} (--explain-scene says why)", summary(needs));
    const auto tracer = make_tracer(*scene, options.scene.tracer, logger);
    if (!tracer) return tl::unexpected(tracer.error());
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    const auto reconstructors = make_reconstructors(options, tables, logger);
    if (!reconstructors) return tl::unexpected(reconstructors.error());

    Supplies supplies;
    supplies.scene = *scene;
    supplies.tracer = *tracer;
    supplies.rank_tile = std::shared_ptr<const RankTile>(tables, &tables->rank_tile());
    supplies.renderer = (*tracer)->name() + "; " + (*reconstructors)->name();
    supplies.image_depth = needs.has(kNeedMirrors) || needs.has(kNeedTransmission) || needs.has(kNeedRefraction);
    supplies.default_sampling = method->name;
    supplies.make_sampler = [tables, meshes = *meshes](
                                const Display& display, Eye eye,
                                const std::string& sampling) -> Expected<std::unique_ptr<Sampler>> {
        const auto wanted = parse_method(sampling);
        if (!wanted) return tl::unexpected(wanted.error());
        return make_sampler(*wanted, display, eye, tables, *meshes);
    };
    supplies.make_reconstructor =
        [factory = *reconstructors](const std::string& sampling) -> Expected<std::unique_ptr<Reconstructor>> {
        const auto wanted = parse_method(sampling);
        if (!wanted) return tl::unexpected(wanted.error());
        return factory->make(wanted->reconstruction);
    };
    supplies.make_color_encoder = make_color_encoder;
    supplies.make_depth_encoder = [](int width_px, int height_px, double frame_rate_hz) {
        return make_depth_encoder({width_px, height_px, frame_rate_hz, 0});
    };
    ServerOptions server_options;
    server_options.token = identity->credentials.token;
    server_options.max_sessions = options.max_clients;
    Server server(*std::move(listener), std::move(supplies), server_options, logger);
    logger->info("listening on {}:{}", options.listen.substr(0, options.listen.rfind(':')), server.port());
    return serve(server);
}

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    const auto parsed = macula::parse_options(argc, argv);
    if (const int* exit_code = std::get_if<int>(&parsed)) return *exit_code;
    const auto& options = std::get<macula::Options>(parsed);
    const macula::Logger logger = macula::make_logger(options.log_level);
    const auto outcome = macula::run(options, logger);
    if (!outcome) {
        logger->critical("{}", outcome.error().message);
        return static_cast<int>(outcome.error().code);
    }
    if (!options.scene.explain) logger->info("stopped");
    return 0;
}
