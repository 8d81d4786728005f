// Several samples of each pixel: where they lie, what becomes of them, and that their mean converges to closed forms.

#include "server/offline/accumulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "masks/tile_sampler.h"
#include "server/kernels/color.h"
#include "tests/support/trace_scene.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;

TEST(SamplePosition, OneIsThePixelsCentre) {
    EXPECT_EQ(sample_position(0, 1), vec2(0.5F));
}

TEST(SamplePosition, EachColumnRowAndCellHasItsShare) {
    for (const int count : {2, 3, 4, 7, 16, 60, 64, 256, 1000}) {
        SCOPED_TRACE(count);
        const bool power_of_two = (count & (count - 1)) == 0;
        std::set<int> columns;
        std::set<int> rows;
        std::set<std::pair<int, int>> cells;
        vec2 sum(0.0F);
        for (int i = 0; i < count; ++i) {
            const vec2 p = sample_position(i, count);
            ASSERT_GT(std::min(p.x, p.y), 0.0F);
            ASSERT_LT(p.x, 1.0F);
            columns.insert(static_cast<int>(p.x * static_cast<float>(count)));
            rows.insert(static_cast<int>(p.y * static_cast<float>(count)));
            cells.insert({static_cast<int>(p.x * 4.0F), static_cast<int>(p.y * 4.0F)});
            sum += p;
        }
        EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
        EXPECT_NEAR(sum.x / static_cast<float>(count), 0.5F, 1e-5F);
        if (!power_of_two) continue;
        EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
        EXPECT_NEAR(sum.y / static_cast<float>(count), 0.5F, 1e-5F);
        if (count >= 16) {
            EXPECT_EQ(cells.size(), 16U);
        }
    }
}

/// A plain camera with tangents -1..1.
std::vector<Shot> one_shot(int size_px) {
    std::vector<Shot> shots(1);
    shots[0].view = test::square_view(size_px);
    shots[0].plan = test::full_plan(size_px, size_px);
    return shots;
}

/// Finds the pass's number in everything that it is asked for.
class NumberedTracer final : public Tracer {
public:
    TraceCounts trace(std::span<const TraceTask> tasks, double time_s) const noexcept override {
        EXPECT_EQ(time_s, 2.5);
        for (const TraceTask& task : tasks) {
            EXPECT_TRUE(task.samples->keep_radiance);
            position.push_back(task.sample_px);
            footprint.push_back(task.footprint_scale);
            const std::size_t count = task.plan->address_count();
            task.samples->radiance.assign(count, vec3(static_cast<float>(pass)));
            task.samples->color.assign(count, 0);
            task.samples->inverse_depth_per_m.assign(count, static_cast<float>(pass));
            task.samples->object_id.assign(count, static_cast<std::uint32_t>(pass));
        }
        ++pass;
        return {.primary = 3, .shadow = 5};
    }
    [[nodiscard]] std::string name() const override { return "numbered"; }
    [[nodiscard]] std::size_t memory_bytes() const override { return 0; }

    mutable int pass = 0;
    mutable std::vector<vec2> position;
    mutable std::vector<float> footprint;
};

TEST(Accumulate, AveragesRadianceAndKeepsWhatIsNearestTheCentre) {
    const NumberedTracer tracer;
    std::vector<Shot> shots = one_shot(8);
    std::vector<int> told;
    const TraceCounts counts =
        accumulate(tracer, shots, 16, 2.5, 0.1F, [&told](int done, int total) { told.push_back(done * 100 + total); });
    EXPECT_EQ(counts.primary, 48U);
    EXPECT_EQ(counts.shadow, 80U);
    ASSERT_EQ(told.size(), 16U);
    EXPECT_EQ(told.front(), 116);
    EXPECT_EQ(told.back(), 1616);
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(tracer.position[i], sample_position(static_cast<int>(i), 16));
        EXPECT_EQ(tracer.footprint[i], 0.25F);
        if (glm::length(tracer.position[i] - 0.5F) < glm::length(tracer.position[nearest] - 0.5F)) nearest = i;
    }
    const Samples& samples = shots[0].samples;
    EXPECT_EQ(samples.radiance[5], vec3(7.5F));
    EXPECT_EQ(samples.color[5], kernels::srgb8_from_linear(vec3(0.75F)));
    EXPECT_EQ(samples.object_id[5], nearest);
    EXPECT_EQ(samples.inverse_depth_per_m[5], static_cast<float>(nearest));
}

TEST(Accumulate, OneSampleIsThePlainTrace) {
    Scene scene;
    scene.background_radiance = vec3(0.1F, 0.2F, 0.3F);
    scene.lights.push_back({.direction = vec3(0.0F, 0.0F, -1.0F)});
    test::add(scene, make_sphere(1.0F, 24), test::white(), glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -2, 1));
    std::vector<Shot> shots = one_shot(32);
    const test::Traced plain = test::trace(scene, shots[0].view);
    accumulate(*test::tracer_of(scene), shots, 1, 0.0, scene.exposure, {});
    EXPECT_EQ(shots[0].samples.color, plain.samples.color);
    EXPECT_EQ(shots[0].samples.radiance, plain.samples.radiance);
    EXPECT_EQ(shots[0].samples.object_id, plain.samples.object_id);
}

/// Picture edge and edge of a checkerboard's squares, in pixels: squares and pixels have no common grid.
constexpr int kBoardSize_px = 24;
constexpr double kSquare_px = 2.7;

bool is_white(int column, int row) {
    return (column + row) % 2 == 0;
}

/// White squares at z = -1 before black, their grid at the image's top left.
Scene checkerboard() {
    Scene scene;
    const double tangent_per_px = 2.0 / kBoardSize_px;
    const int squares = static_cast<int>(kBoardSize_px / kSquare_px) + 1;
    const auto edge = static_cast<float>(kSquare_px * tangent_per_px);
    for (int row = 0; row < squares; ++row) {
        for (int column = 0; column < squares; ++column) {
            if (!is_white(column, row)) continue;
            const vec3 top_left(-1.0F + edge * static_cast<float>(column), 1.0F - edge * static_cast<float>(row),
                                -1.0F);
            test::add(scene, make_quad(top_left, {edge, 0.0F, 0.0F}, {0.0F, -edge, 0.0F}), test::unlit());
        }
    }
    return scene;
}

/// White share of a pixel: for each square that it touches, width times height of what they have in common.
double white_share(int x, int y) {
    double share = 0.0;
    const auto common = [](int square, int pixel) {
        return std::max(0.0, std::min((square + 1) * kSquare_px, pixel + 1.0) -
                                 std::max(square * kSquare_px, static_cast<double>(pixel)));
    };
    const auto first = [](int pixel) { return static_cast<int>(pixel / kSquare_px); };
    for (int row = first(y); row <= first(y) + 1; ++row)
        for (int column = first(x); column <= first(x) + 1; ++column)
            if (is_white(column, row)) share += common(column, x) * common(row, y);
    return share;
}

// The discrepancy of a Hammersley set of N = 2^k points is below (k / 2 + 3 / 2) / N, and a pixel's white is the sum of
// two boxes at its corners: no pixel is off by more than twice that. In the mean the errors are far smaller.
TEST(Accumulate, ACheckerboardsMeanIsItsClosedForm) {
    const auto tracer = test::tracer_of(checkerboard());
    for (const int log_spp : {2, 4, 6, 8}) {
        const int spp = 1 << log_spp;
        std::vector<Shot> shots = one_shot(kBoardSize_px);
        accumulate(*tracer, shots, spp, 0.0, 1.0F, {});
        const double bound = 2.0 * (0.5 * log_spp + 1.5) / spp;
        double mean_error = 0.0;
        double largest_error = 0.0;
        for (int y = 0; y < kBoardSize_px; ++y) {
            for (int x = 0; x < kBoardSize_px; ++x) {
                const double error =
                    shots[0].samples.radiance[static_cast<std::size_t>(y * kBoardSize_px + x)].x - white_share(x, y);
                largest_error = std::max(largest_error, std::abs(error));
                mean_error += error / (kBoardSize_px * kBoardSize_px);
            }
        }
        std::printf("[  FIGURE  ] %d samples: largest error %.4f, mean %.5f\n", spp, largest_error, mean_error);
        EXPECT_LT(largest_error, bound);
        EXPECT_LT(std::abs(mean_error), 0.1 / spp);
    }
}

/// A ball on a striped floor with its shadow: edges, shading and texture.
Scene still_life() {
    Scene scene;
    scene.ambient_radiance = vec3(0.1F);
    scene.background_radiance = vec3(0.5F, 0.6F, 0.8F);
    scene.lights.push_back({.direction = glm::normalize(vec3(0.5F, -0.8F, -0.3F)), .intensity = vec3(2.0F)});
    test::add(scene, make_sphere(0.6F, 48), test::white(),
              glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -2.2F, 1));
    Material stripes = test::white();
    stripes.base_color_texture.image = test::add_image(scene, 2, 1, {255, 255, 255, 255, 10, 10, 10, 255});
    stripes.base_color_texture.filter = TextureFilter::nearest;
    stripes.base_color_texture.uv_scale_rotation = glm::vec4(7.0F, 0.0F, 3.0F, 1.0F);
    test::add(scene, make_quad({-3.0F, -0.6F, -5.0F}, {6.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 5.0F}), stripes);
    return scene;
}

double psnr_db(const std::vector<vec3>& a, const std::vector<vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]) / 3.0;
    return -10.0 * std::log10(sum / static_cast<double>(a.size()));
}

// Random samples would gain 6 dB for each fourfold number, stratified ones gain up to 9 dB where edges cross pixels
// (the variance of N strata falls with N^-3/2).
TEST(Accumulate, ConvergesFasterThanRandomSamples) {
    const auto tracer = test::tracer_of(still_life());
    const auto render = [&](int spp) {
        std::vector<Shot> shots = one_shot(40);
        accumulate(*tracer, shots, spp, 0.0, 1.0F, {});
        return shots[0].samples.radiance;
    };
    const std::vector<vec3> truth = render(2048);
    double last_db = psnr_db(render(1), truth);
    for (const int spp : {4, 16, 64}) {
        const double db = psnr_db(render(spp), truth);
        std::printf("[  FIGURE  ] %d samples: %.1f dB, %+.1f\n", spp, db, db - last_db);
        EXPECT_GT(db, last_db + 6.0);
        last_db = db;
    }
}

}  // namespace
}  // namespace macula
