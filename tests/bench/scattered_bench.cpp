// Push-pull, cells and nearest against the tile reconstructor: one eye of the Vive, 1512x1680, colour and inverse
// depth, of the same tile plan, one frame of each in turn. C++ runs on one core, and GL where GL runs.
//
// The samples alone put at their pixels are what any of the three begins with.
//
// usage: scattered_bench [percent] [rounds] [cpp|gl|both]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/tile_sampler.h"
#include "masks/tile_tables.h"
#include "protocol/gl/context.h"
#include "server/render/sample_image.h"
#include "server/render/scattered_reconstructors.h"
#include "tests/support/stopwatch.h"
#include "tests/support/tile_plans.h"

namespace {

using namespace macula;

struct Contender {
    std::string name;
    std::function<Expected<void>()> run;
    std::vector<double> wall_ms;
    std::vector<double> cpu_ms;
};

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Runs all in turn and prints medians and their ratios to the first.
void race(const char* title, std::vector<Contender>& contenders, int rounds) {
    for (int round = -1; round < rounds; ++round)  // the first is to warm up
        for (Contender& contender : contenders) {
            const test::Stopwatch watch;
            if (const auto done = contender.run(); !done) {
                std::printf("%s: %s\n", contender.name.c_str(), done.error().message.c_str());
                std::exit(static_cast<int>(done.error().code));
            }
            if (round < 0) continue;
            contender.wall_ms.push_back(1e3 * watch.wall_s());
            contender.cpu_ms.push_back(1e3 * watch.cpu_s());
        }
    std::printf("%-32s %10s %8s %10s %8s\n", title, "ms", "ratio", "cpu ms", "ratio");
    for (const Contender& contender : contenders)
        std::printf("%-32s %10.1f %8.2f %10.1f %8.2f\n", contender.name.c_str(), median(contender.wall_ms),
                    median(contender.wall_ms) / median(contenders.front().wall_ms), median(contender.cpu_ms),
                    median(contender.cpu_ms) / median(contenders.front().cpu_ms));
}

Expected<std::unique_ptr<Reconstructor>> make_gl(Reconstruction kind, const TileTables& tables) {
    auto context = make_gl_context(ContextKind::automatic);
    if (!context) return tl::unexpected(context.error());
    if (kind == Reconstruction::tiles) return make_gl_reconstructor(std::move(*context), tables);
    return make_gl_scattered_reconstructor(kind, std::move(*context));
}

}  // namespace

int main(int argc, char** argv) {
    const std::string percent = argc > 1 ? argv[1] : "27";
    const int rounds = argc > 2 ? std::atoi(argv[2]) : 15;
    const std::string where = argc > 3 ? argv[3] : "both";
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    const Display display = load_display("vive").value();
    TileSampler sampler(display, kLeftEye, tile_law(display, kLeftEye, parse_sampling(percent).value()), tables);
    SamplePlan plan;
    sampler.plan({}, plan);
    const Samples samples = test::sample_picture(
        plan, [](int x, int y) { return static_cast<Rgba8>((x * x + 3 * y * y) / 64 * 0x010203 + x) | 0xFF000000U; },
        [](int x, int y) { return (x / 90 + y / 70) % 3 == 0 ? 0.0F : 0.2F + 0.0002F * static_cast<float>(x + y); });
    ColorImage color(plan.width_px, plan.height_px);
    InverseDepthImage depth(plan.width_px, plan.height_px);
    const auto width = static_cast<std::size_t>(plan.width_px);
    const ReconstructTarget target{color.texels.data(), width, depth.texels.data(), width};
    std::printf("%s: %.1f %% of the pixels have a sample\n", percent.c_str(), 100.0 * plan.traced_share());

    std::vector<std::unique_ptr<Reconstructor>> kept;
    const auto contender = [&](const std::string& name, std::unique_ptr<Reconstructor> reconstructor) {
        kept.push_back(std::move(reconstructor));
        return Contender{
            name, [&, made = kept.back().get()] { return made->reconstruct(plan, samples, target); }, {}, {}};
    };
    constexpr std::array kAll = {Reconstruction::tiles, Reconstruction::push_pull, Reconstruction::cells,
                                 Reconstruction::nearest};
    if (where != "gl") {
        const tbb::global_control one_core(tbb::global_control::max_allowed_parallelism, 1);
        std::vector<Contender> contenders;
        contenders.reserve(kAll.size() + 1);
        for (const Reconstruction kind : kAll)
            contenders.push_back(contender(to_string(kind), kind == Reconstruction::tiles
                                                                ? make_cpu_reconstructor(tables)
                                                                : make_cpu_scattered_reconstructor(kind)));
        SampleImage image;
        contenders.push_back({"samples at their pixels",
                              [&]() -> Expected<void> {
                                  image.fill(plan, samples, true);
                                  return {};
                              },
                              {},
                              {}});
        race("C++, one core", contenders, rounds);
    }
    if (where != "cpp") {
        std::vector<Contender> contenders;
        contenders.reserve(kAll.size() + 1);
        for (const Reconstruction kind : kAll) {
            auto made = make_gl(kind, *tables);
            if (!made) {
                std::printf("%s\n", made.error().message.c_str());
                return static_cast<int>(made.error().code);
            }
            contenders.push_back(contender(to_string(kind), std::move(*made)));
        }
        race(kept.back()->name().c_str(), contenders, rounds);
    }
    return 0;
}
