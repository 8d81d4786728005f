#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "masks/tile_tables.h"
#include "server/render/reconstructor.h"
#include "tests/support/pictures.h"
#include "tests/support/tile_plans.h"

namespace macula::test {

/// Made once per program: a fraction of a second.
inline std::shared_ptr<const TileTables> shared_tables() {
    static const auto kTables = std::make_shared<const TileTables>(make_rank_tile());
    return kTables;
}

struct Picture {
    ColorImage color;
    InverseDepthImage inverse_depth;
};

/// Runs a reconstructor into rows that are longer than the eye is wide, checks that the rest of them is untouched, and
/// cuts the picture out.
inline Picture reconstruct(Reconstructor& reconstructor, const SamplePlan& plan, const Samples& samples) {
    constexpr int kMargin_px = 3;
    constexpr Rgba8 kUntouchedColor = 0x12345678U;
    constexpr float kUntouchedDepth = -7.0F;
    const int stride = plan.width_px + 2 * kMargin_px;
    ColorImage color(stride, plan.height_px, kUntouchedColor);
    InverseDepthImage depth(stride, plan.height_px, kUntouchedDepth);
    const auto done = reconstructor.reconstruct(plan, samples,
                                                {.color = color.texels.data() + kMargin_px,
                                                 .color_stride_px = static_cast<std::size_t>(stride),
                                                 .inverse_depth_per_m = depth.texels.data() + kMargin_px,
                                                 .depth_stride_px = static_cast<std::size_t>(stride)});
    EXPECT_TRUE(done) << done.error().message;
    Picture picture{ColorImage(plan.width_px, plan.height_px), InverseDepthImage(plan.width_px, plan.height_px)};
    for (int y = 0; y < plan.height_px; ++y) {
        for (int x = 0; x < kMargin_px; ++x)
            for (const int column : {x, stride - 1 - x})
                if (color.at(column, y) != kUntouchedColor || depth.at(column, y) != kUntouchedDepth)
                    ADD_FAILURE() << "wrote outside the eye's columns in row " << y;
        std::copy_n(color.row(y) + kMargin_px, plan.width_px, picture.color.row(y));
        std::copy_n(depth.row(y) + kMargin_px, plan.width_px, picture.inverse_depth.row(y));
    }
    return picture;
}

struct Case {
    SamplePlan plan;
    Samples samples;
};

/// A plan of any size, phase and levels, from smooth to wild, with none to all of its samples untraced, and samples of
/// any colours and depths with misses among them.
inline Case random_case(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto draw = [&random](int first, int last) { return std::uniform_int_distribution(first, last)(random); };
    const glm::ivec2 size(draw(1, 150), draw(1, 150));
    const glm::ivec2 phase(draw(0, 63), draw(0, 63));
    const int sparsest = draw(0, kFullLevel);
    const int densest = draw(sparsest, kFullLevel);
    const int step = draw(1, 3);  // of 3: how many tiles draw their level anew
    int previous = sparsest;
    const auto level = [&](int, int) {
        if (draw(1, 3) <= step) previous = draw(sparsest, densest);
        return previous;
    };
    constexpr std::array kUntracedPercent = {0, 0, 3, 40, 95, 100};
    const int untraced = kUntracedPercent[static_cast<std::size_t>(draw(0, 5))];
    Case result;
    result.plan = tile_plan(shared_tables()->rank_tile(), size.x, size.y, phase, level,
                            [&](int, int) { return draw(0, 99) >= untraced; });
    std::uniform_real_distribution<float> depth(0.01F, 4.0F);
    const int steadiness = draw(0, 3);
    float last_depth = 1.0F;
    result.samples = sample_picture(
        result.plan, [&](int, int) { return static_cast<Rgba8>(random()) | 0xFF000000U; },
        [&](int, int) {
            if (draw(0, 9) == 0) return 0.0F;
            if (draw(0, 3) >= steadiness) last_depth = depth(random);
            return last_depth * (1.0F + 0.1F * depth(random) / 4.0F);
        });
    if (seed % 2 == 0) return result;
    std::vector<std::uint8_t> hidden(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (std::uint8_t& pixel : hidden) pixel = draw(0, 3) == 0 ? 1 : 0;
    result.plan.hidden = std::make_shared<const std::vector<std::uint8_t>>(std::move(hidden));
    return result;
}

/// Writes reference, result and difference of a test that failed; returns where.
inline std::string write_three_pictures(const std::string& name, const ColorImage& reference,
                                        const ColorImage& result) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "macula-failures";
    std::filesystem::create_directories(folder);
    const std::string prefix = (folder / name).string();
    for (const auto& [part, picture] :
         {std::pair{"reference", reference}, {"result", result}, {"difference", compare(reference, result).picture}})
        if (const auto written = write_png(prefix + "-" + part + ".png", picture); !written)
            return written.error().message;
    return prefix + "-{reference,result,difference}.png";
}

}  // namespace macula::test
