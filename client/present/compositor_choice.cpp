#include "client/present/compositor_choice.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "client/present/make_compositor.h"
#include "masks/levels.h"
#include "protocol/base/clock.h"

namespace macula {
namespace {

/// A grey frame whose tiles have a quarter of their pixels traced: what a frame contains does not change its cost.
struct MadeUpFrame {
    explicit MadeUpFrame(const Display& display)
        : color(2 * display.eye_width_px, display.eye_height_px, 0xFF808080U),
          depth(color.width_px / 4, color.height_px / 4, 0.5F),
          ranks(kTileArea_px) {
        std::iota(ranks.begin(), ranks.end(), std::uint8_t{0});
        sampling.tiles_x = (display.eye_width_px + kTileEdge_px - 1) / kTileEdge_px;
        sampling.tiles_y = (display.eye_height_px + kTileEdge_px - 1) / kTileEdge_px;
        const std::uint8_t quarter = 13;
        sampling.level.assign(static_cast<std::size_t>(sampling.tiles_x) * static_cast<std::size_t>(sampling.tiles_y),
                              quarter);
        frame.color = &color;
        frame.depth = &depth;
        frame.sampling = {&sampling, &sampling};
        frame.rank_tile = ranks;
        frame.rank_tile_size_px = kTileEdge_px;
    }
    MadeUpFrame(const MadeUpFrame&) = delete;
    MadeUpFrame& operator=(const MadeUpFrame&) = delete;

    ColorImage color;
    InverseDepthImage depth;
    std::vector<std::uint8_t> ranks;
    EyeSamplingMessage sampling;
    NewFrame frame;
};

/// Fastest of a few frames; the first, in which GL compiles for the CPU, does not count.
Expected<double> measure_ms(Compositor& compositor, const NewFrame& frame) {
    double best_ms = std::numeric_limits<double>::max();
    ColorImage picture;
    for (int i = 0; i < 4; ++i) {
        const std::int64_t begin_ns = now_ns();
        if (auto done = compositor.accumulate(frame); !done) return tl::unexpected(done.error());
        if (auto done = compositor.show(frame.world_from_eye, 0, picture); !done) return tl::unexpected(done.error());
        if (i > 0) best_ms = std::min(best_ms, static_cast<double>(now_ns() - begin_ns) * 1e-6);
    }
    return best_ms;
}

std::string milliseconds(double value_ms) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.1f ms", value_ms);
    return text.data();
}

}  // namespace

Expected<std::unique_ptr<Compositor>> choose_compositor(TaaOn on, ContextKind context, const Display& display,
                                                        const kernels::TaaWeights& weights,
                                                        const std::function<void(const std::string&)>& log) {
    if (on == TaaOn::cpu) return make_cpu_compositor(display, weights);
    auto made = make_gl_context(context);
    const bool software = made && (*made)->software();
    auto gl = made ? make_gl_compositor(std::move(*made), display, weights)
                   : Expected<std::unique_ptr<Compositor>>(tl::unexpected(made.error()));
    if (on == TaaOn::gl || (gl && !software)) return gl;
    auto cpu = make_cpu_compositor(display, weights);
    if (!gl) {
        log("no GL for temporal anti-aliasing, C++ does it: " + gl.error().message);
        return cpu;
    }
    const MadeUpFrame made_up(display);
    const auto gl_ms = measure_ms(**gl, made_up.frame);
    const auto cpu_ms = measure_ms(*cpu, made_up.frame);
    if (!gl_ms || !cpu_ms) return cpu;
    log("a picture takes " + milliseconds(*gl_ms) + " on " + (*gl)->name() + ", " + milliseconds(*cpu_ms) + " on " +
        cpu->name());
    // Software GL is destroyed again where it lost: its worker threads would keep memory.
    return *gl_ms < *cpu_ms ? std::move(gl) : Expected<std::unique_ptr<Compositor>>(std::move(cpu));
}

}  // namespace macula
