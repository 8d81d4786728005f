#include "server/render/reconstructor_choice.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "masks/tile_tables.h"
#include "server/render/reconstructor.h"

namespace macula {

namespace {

/// Levels that fall from full in the middle to the sparsest in the corners; a third of the pixels are sampled.
SamplePlan radial_plan(glm::ivec2 size_px) {
    SamplePlan plan;
    plan.width_px = size_px.x;
    plan.height_px = size_px.y;
    plan.origin_px = glm::ivec2(-kTileEdge_px);
    const glm::ivec2 tiles = (size_px + kTileEdge_px - 1) / kTileEdge_px + 2;
    plan.tiles_x = tiles.x;
    plan.tiles_y = tiles.y;
    plan.offset.push_back(0);
    for (int y = 0; y < tiles.y; ++y)
        for (int x = 0; x < tiles.x; ++x) {
            const float radius = glm::length((glm::vec2(x, y) + 0.5F) / glm::vec2(tiles) * 2.0F - 1.0F);
            const int level = std::clamp(static_cast<int>((1.4F - radius) * 1.1F * kFullLevel), 1, kFullLevel);
            plan.level.push_back(static_cast<std::uint8_t>(level));
            plan.offset.push_back(plan.offset.back() + kLevelCounts[static_cast<std::size_t>(level)]);
        }
    return plan;
}

/// Shortest of a few reconstructions, in milliseconds, after one that warms up.
Expected<double> measure(Reconstructor& reconstructor, const SamplePlan& plan) {
    Samples samples;
    samples.color.assign(plan.address_count(), 0xFF808080U);
    samples.inverse_depth_per_m.assign(plan.address_count(), 0.5F);
    ColorImage color(plan.width_px, plan.height_px);
    InverseDepthImage depth(plan.width_px, plan.height_px);
    const auto width = static_cast<std::size_t>(plan.width_px);
    double shortest_ms = 1e9;
    for (int run = 0; run < 5; ++run) {
        const auto begin = std::chrono::steady_clock::now();
        const auto done =
            reconstructor.reconstruct(plan, samples, {color.texels.data(), width, depth.texels.data(), width});
        if (!done) return tl::unexpected(done.error());
        const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
        if (run > 0) shortest_ms = std::min(shortest_ms, elapsed.count());
    }
    return shortest_ms;
}

std::string timing(const std::string& gl_name, double gl_ms, double cpu_ms, glm::ivec2 size_px) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), " takes %.1f ms for an eye of %dx%d, C++ %.1f ms", gl_ms, size_px.x,
                  size_px.y, cpu_ms);
    return gl_name + text.data();
}

}  // namespace

Expected<ReconstructOn> parse_reconstruct_on(const std::string& text) {
    if (text == "auto") return ReconstructOn::automatic;
    if (text == "gl") return ReconstructOn::gl;
    if (text == "cpu") return ReconstructOn::cpu;
    return fail(ErrorCode::option, "unknown place to reconstruct \"" + text + "\"; use auto, gl or cpu");
}

Expected<ReconstructorChoice> choose_reconstructor(ContextKind kind, ReconstructOn on,
                                                   const std::shared_ptr<const TileTables>& tables,
                                                   glm::ivec2 size_px) {
    ReconstructorChoice choice;
    choice.context = kind;
    if (on == ReconstructOn::cpu) {
        choice.reason = "C++ was asked for";
        return choice;
    }
    auto context = make_gl_context(kind);
    if (!context) {
        if (on == ReconstructOn::gl || kind != ContextKind::automatic) return tl::unexpected(context.error());
        choice.reason = "C++, because there is " + context.error().message;
        return choice;
    }
    const bool software = (*context)->software();
    auto gl = make_gl_reconstructor(std::move(*context), *tables);
    if (!gl) return tl::unexpected(gl.error());
    choice.use_gl = true;
    if (on == ReconstructOn::gl || !software) {
        choice.reason = (*gl)->name() + (on == ReconstructOn::gl ? " was asked for" : " is a GPU");
        return choice;
    }
    const SamplePlan plan = radial_plan(size_px);
    const auto gl_ms = measure(**gl, plan);
    if (!gl_ms) return tl::unexpected(gl_ms.error());
    const auto cpu_ms = measure(*make_cpu_reconstructor(tables), plan);
    if (!cpu_ms) return tl::unexpected(cpu_ms.error());
    choice.gl_ms = *gl_ms;
    choice.cpu_ms = *cpu_ms;
    choice.use_gl = *gl_ms < *cpu_ms;
    choice.reason = timing((*gl)->name(), *gl_ms, *cpu_ms, size_px);
    return choice;
}

}  // namespace macula
