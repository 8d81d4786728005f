// macula-render: one frame of a scene into picture files, by the parts that the server renders with.

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include <oneapi/tbb/global_control.h>

#include "protocol/base/clock.h"
#include "protocol/base/progress.h"
#include "scenes/needs.h"
#include "server/offline/accumulate.h"
#include "server/offline/layers.h"
#include "server/offline/options.h"
#include "server/offline/report.h"
#include "server/offline/shot.h"
#include "server/offline/writer.h"
#include "server/render/reconstructor_factory.h"
#include "server/render/tracer.h"

namespace macula {
namespace {

double ms_since(std::int64_t begin_ns) {
    return static_cast<double>(now_ns() - begin_ns) * 1e-6;
}

Expected<std::shared_ptr<const Scene>> load(const SceneOptions& options, Progress& progress) {
    progress.begin("loading " + options.scene);
    auto loaded =
        load_scene(options, [&progress](const std::string& stage, double share) { progress.tell(share, stage); });
    if (!loaded) return tl::unexpected(loaded.error());
    for (const std::string& warning : loaded->warnings) progress.note("scene: " + warning);
    return loaded->scene;
}

/// Nothing where every pixel has its own sample, or where those without are to stay black.
Expected<std::unique_ptr<Reconstructor>> make_reconstructor(const RenderOptions& options, const ShotPlan& shot_plan,
                                                            const std::shared_ptr<const TileTables>& tables) {
    if (shot_plan.full() || options.reconstruct == "none") return nullptr;
    ReconstructorOptions choice;
    choice.context = options.context;
    choice.reconstruct_on = options.reconstruct;
    const auto factory = make_reconstructor_factory(choice, tables);
    if (!factory) return tl::unexpected(factory.error());
    return (*factory)->make(shot_plan.method().reconstruction);
}

/// One repetition: plan, trace, reconstruct.
Expected<std::vector<Layers>> render(const RenderOptions& options, const Tracer& tracer, Reconstructor* reconstructor,
                                     float exposure, std::vector<Shot>& shots, Progress& progress, RunReport& report) {
    const std::int64_t plan_ns = now_ns();
    for (Shot& shot : shots) shot.sampler->plan({shot.gaze_eye, glm::ivec2(0)}, shot.plan);
    report.times.plan_ms.push_back(ms_since(plan_ns));

    const std::int64_t trace_ns = now_ns();
    report.rays = accumulate(tracer, shots, options.spp, options.time_s, exposure, [&progress](int done, int total) {
        progress.tell(static_cast<double>(done) / total,
                      std::to_string(done) + " of " + std::to_string(total) + " samples of each pixel");
    });
    report.times.trace_ms.push_back(ms_since(trace_ns));

    const std::int64_t reconstruct_ns = now_ns();
    std::vector<Layers> pictures;
    for (const Shot& shot : shots) {
        auto layers = make_layers(shot, reconstructor, exposure);
        if (!layers) return tl::unexpected(layers.error());
        pictures.push_back(*std::move(layers));
    }
    report.times.reconstruct_ms.push_back(ms_since(reconstruct_ns));
    return pictures;
}

Expected<void> write(const RenderOptions& options, const LayerChoice& choice, float exposure,
                     const std::vector<Shot>& shots, const std::vector<Layers>& pictures, RunReport& report) {
    const std::int64_t begin_ns = now_ns();
    for (std::size_t i = 0; i < shots.size(); ++i) {
        const std::string stem = options.out + (shots[i].name.empty() ? "" : "_" + shots[i].name);
        auto files = options.format == "exr" ? write_exr_layers(pictures[i], choice, stem, exposure)
                                             : write_png_layers(pictures[i], choice, stem);
        if (!files) return tl::unexpected(files.error());
        report.files.insert(report.files.end(), files->begin(), files->end());
    }
    report.write_ms = ms_since(begin_ns);
    return {};
}

Expected<void> run(const RenderOptions& options) {
    Progress progress("macula-render", options.quiet);
    // What can be wrong is looked at before the scene is loaded, which may take a while.
    const auto choice = parse_layers(options.write);
    if (!choice) return tl::unexpected(choice.error());
    const auto shot_plan = ShotPlan::parse(options);
    if (!shot_plan) return tl::unexpected(shot_plan.error());
    MeshShelf meshes(options.mesh_cache, [&progress](const std::string& what) { progress.note(what); });
    if (!options.mesh.empty()) {
        if (auto read = meshes.read_own(options.mesh); !read) return read;
    }
    std::optional<oneapi::tbb::global_control> threads;
    if (options.threads > 0)
        threads.emplace(oneapi::tbb::global_control::max_allowed_parallelism,
                        static_cast<std::size_t>(options.threads));

    RunReport report;
    const std::int64_t load_ns = now_ns();
    const auto scene = load(options.scene, progress);
    if (!scene) return tl::unexpected(scene.error());
    report.load_ms = ms_since(load_ns);
    const SceneNeeds needs = scene_needs(**scene);
    if (options.scene.explain) return write_text("-", explain(needs));

    const std::int64_t build_ns = now_ns();
    const auto tracer = make_embree_tracer(*scene, options.scene.tracer);
    if (!tracer) return tl::unexpected(tracer.error());
    report.build_ms = ms_since(build_ns);
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    const auto reconstructor = make_reconstructor(options, *shot_plan, tables);
    if (!reconstructor) return tl::unexpected(reconstructor.error());
    report.scene = (*scene)->name;
    report.triangles = (*scene)->triangle_count();
    report.needs = summary(needs);
    report.renderer = (*tracer)->name();
    report.reconstruction = *reconstructor ? (*reconstructor)->name() : "none";
    report.tracer_bytes = (*tracer)->memory_bytes();

    auto shots = shot_plan->shots((*scene)->world_from_start, tables, meshes);
    if (!shots) return tl::unexpected(shots.error());
    std::vector<Layers> pictures;
    for (int i = 0; i < options.repeat; ++i) {
        progress.begin("tracing");
        auto frame = render(options, **tracer, reconstructor->get(), (*scene)->exposure, *shots, progress, report);
        if (!frame) return tl::unexpected(frame.error());
        pictures = *std::move(frame);
    }
    if (auto written = write(options, *choice, (*scene)->exposure, *shots, pictures, report); !written) return written;
    for (const WrittenFile& file : report.files) progress.note("wrote " + file.path);
    return options.json.empty() ? Expected<void>{} : write_text(options.json, to_json(report, options, *shots));
}

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    const auto parsed = macula::parse_render_options(argc, argv);
    if (const int* exit_code = std::get_if<int>(&parsed)) return *exit_code;
    const auto outcome = macula::run(std::get<macula::RenderOptions>(parsed));
    if (outcome) return 0;
    std::fprintf(stderr, "macula-render: %s\n", outcome.error().message.c_str());
    return static_cast<int>(outcome.error().code);
}
