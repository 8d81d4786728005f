// Push-pull, cells and nearest in C++ against their rules in other words, and what must hold for any plan.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <tuple>

#include "server/render/sample_image.h"
#include "tests/support/scattered_cases.h"

namespace macula {
namespace {

using test::Case;
using test::kScattered;
using test::Picture;

Picture picture_of(Reconstruction kind, const SamplePlan& plan, const Samples& samples) {
    return test::reconstruct(*make_cpu_scattered_reconstructor(kind), plan, samples);
}

unsigned channel(Rgba8 color, unsigned index) {
    return (color >> (8 * index)) & 255U;
}

/// Plans of tiles and of meshes, dense to nearly empty, some with a hidden border.
std::vector<Case> small_cases() {
    std::vector<Case> cases;
    for (std::uint32_t seed = 1; cases.size() < 16; ++seed) {
        Case random = test::random_case(seed);
        if (random.plan.width_px * random.plan.height_px > 3000) continue;
        if (seed % 3 == 0) test::hide(random.plan, [](int x, int y) { return x < 5 || (x + y) % 7 == 0; });
        cases.push_back(std::move(random));
    }
    for (const double share : {0.9, 0.3, 0.05, 0.004, 0.0}) {
        cases.push_back(test::mesh_case(static_cast<std::uint32_t>(1000.0 * share), {61, 47}, share));
        test::hide(cases.back().plan, [](int x, int y) { return x + y < 20; });
    }
    return cases;
}

struct Found {
    int distance_sq;
    std::uint32_t address;
};

/// The nearest samples by looking at all of them; of equally near ones the nearer column, the left, the upper first.
std::vector<Found> nearest_by_brute_force(const Case& from, int x, int y, std::size_t wanted) {
    std::vector<std::tuple<int, int, int, int, std::uint32_t>> all;
    for (const std::uint32_t address : from.plan.trace_order) {
        const int dx = from.plan.position[address].x_px - x;
        const int dy = from.plan.position[address].y_px - y;
        all.emplace_back(dx * dx + dy * dy, std::abs(dx), dx, dy, address);
    }
    const std::size_t count = std::min(wanted, all.size());
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end());
    std::vector<Found> found;
    for (std::size_t i = 0; i < count; ++i) found.push_back({std::get<0>(all[i]), std::get<4>(all[i])});
    return found;
}

void expect_made_of_nearest(const Case& from, const Picture& picture, std::size_t wanted) {
    for (int y = 0; y < from.plan.height_px; ++y)
        for (int x = 0; x < from.plan.width_px; ++x) {
            SCOPED_TRACE("pixel " + std::to_string(x) + ", " + std::to_string(y));
            const bool hidden = test::is_hidden(from.plan, x, y);
            auto found = hidden ? std::vector<Found>{} : nearest_by_brute_force(from, x, y, wanted);
            if (found.empty()) {
                ASSERT_EQ(picture.color.at(x, y), 0xFF000000U);
                ASSERT_EQ(picture.inverse_depth.at(x, y), 0.0F);
                continue;
            }
            if (found[0].distance_sq == 0) found.resize(1);
            std::array<double, 3> sum = {};
            double total = 0.0;
            double depth = 0.0;
            float near = 0.0F;
            float far = 1e9F;
            for (const Found& f : found) {
                // Weights are rounded to 1/256 of the nearest sample's (server/kernels/nearest_samples.h).
                const double weight =
                    f.distance_sq == 0 ? 1.0 : std::floor(256.0 * found[0].distance_sq / f.distance_sq + 0.5);
                for (unsigned c = 0; c < 3; ++c) sum[c] += weight * channel(from.samples.color[f.address], c);
                const float sample = from.samples.inverse_depth_per_m[f.address];
                depth += weight * sample;
                near = std::max(near, sample);
                far = std::min(far, sample);
                total += weight;
            }
            for (unsigned c = 0; c < 3; ++c)
                ASSERT_EQ(channel(picture.color.at(x, y), c), std::floor(sum[c] / total + 0.5)) << "channel " << c;
            ASSERT_EQ(channel(picture.color.at(x, y), 3), 255U);
            const double expected =
                near <= 1.25F * far ? depth / total : from.samples.inverse_depth_per_m[found[0].address];
            ASSERT_NEAR(picture.inverse_depth.at(x, y), expected, 1e-6 * near);
        }
}

TEST(Nearest, CellsAreTheNearestSampleByBruteForce) {
    for (const Case& random : small_cases()) {
        expect_made_of_nearest(random, picture_of(Reconstruction::cells, random.plan, random.samples), 1);
        if (testing::Test::HasFailure()) return;
    }
}

TEST(Nearest, NearestIsMadeOfTheFourNearestSamplesByBruteForce) {
    for (const Case& random : small_cases()) {
        expect_made_of_nearest(random, picture_of(Reconstruction::nearest, random.plan, random.samples), 4);
        if (testing::Test::HasFailure()) return;
    }
}

/// The rule of server/kernels/push_pull.h, each pixel of each level by itself and in doubles.
class PushPullRule {
public:
    explicit PushPullRule(const Case& from) : guard_(guard_px(from.plan)) {
        Level level;
        level.width = from.plan.width_px + 2 * guard_;
        level.height = from.plan.height_px + 2 * guard_;
        for (const std::uint32_t address : from.plan.trace_order) {
            const SamplePosition at = from.plan.position[address];
            Pixel& pixel = level.pixels[{at.x_px + guard_, at.y_px + guard_}];
            for (unsigned c = 0; c < 3; ++c) pixel.color[c] = channel(from.samples.color[address], c);
            pixel.depth = from.samples.inverse_depth_per_m[address];
            pixel.weight = 1.0;
        }
        levels_.push_back(level);
        while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(pull(levels_.back()));
        for (std::size_t l = levels_.size() - 1; l-- > 1;) push(levels_[l + 1], levels_[l]);
    }

    struct Pixel {
        std::array<double, 3> color = {};
        double depth = 0.0;
        double weight = 0.0;
    };
    /// Of the window; colour is a whole number.
    [[nodiscard]] Pixel at(int x, int y) const {
        const auto own = levels_[0].pixels.find({x + guard_, y + guard_});
        if (own != levels_[0].pixels.end()) return own->second;
        Pixel pixel = between(levels_[1], x + guard_, y + guard_);
        for (double& value : pixel.color) value = std::floor(value + 0.5);
        return pixel;
    }

private:
    struct Level {
        int width = 0;
        int height = 0;
        std::map<std::pair<int, int>, Pixel> pixels;  ///< those with weight
    };

    static bool one_surface(double near, double far) {
        return static_cast<float>(near) <= 1.25F * static_cast<float>(far);
    }
    static double to_sixteenth(double value) { return std::floor(16.0 * value + 0.5) / 16.0; }

    static Level pull(const Level& fine) {
        struct Sums {
            std::array<double, 3> color = {};
            double depth = 0.0;
            double weight = 0.0;
            double near = 0.0;
            double far = 1e9;
        };
        std::map<std::pair<int, int>, Sums> sums;
        Level coarse;
        coarse.width = (fine.width + 1) / 2;
        coarse.height = (fine.height + 1) / 2;
        for (const auto& [place, pixel] : fine.pixels)
            for (int j = place.second / 2; j <= std::min((place.second + 1) / 2, coarse.height - 1); ++j)
                for (int i = place.first / 2; i <= std::min((place.first + 1) / 2, coarse.width - 1); ++i) {
                    const double kernel = (1.0 - 0.5 * std::abs(place.first - 2 * i)) *
                                          (1.0 - 0.5 * std::abs(place.second - 2 * j)) * pixel.weight;
                    Sums& to = sums[{i, j}];
                    for (std::size_t c = 0; c < 3; ++c) to.color[c] += kernel * pixel.color[c];
                    to.depth += kernel * pixel.depth;
                    to.weight += kernel;
                    to.near = std::max(to.near, pixel.depth);
                    to.far = std::min(to.far, pixel.depth);
                }
        for (const auto& [place, sum] : sums) {
            Pixel& pixel = coarse.pixels[place];
            for (std::size_t c = 0; c < 3; ++c) pixel.color[c] = to_sixteenth(sum.color[c] / sum.weight);
            pixel.depth = one_surface(sum.near, sum.far) ? sum.depth / sum.weight : sum.near;
            pixel.weight = std::min(1.0, std::ceil(4.0 * sum.weight) / 4.0);
        }
        return coarse;
    }
    static Pixel between(const Level& coarse, int x, int y) {
        Pixel pixel;
        double near = 0.0;
        double far = 1e9;
        for (const int j : {y / 2, (y + 1) / 2})
            for (const int i : {x / 2, (x + 1) / 2}) {
                const auto found = coarse.pixels.find({std::min(i, coarse.width - 1), std::min(j, coarse.height - 1)});
                const Pixel from = found == coarse.pixels.end() ? Pixel{} : found->second;
                for (std::size_t c = 0; c < 3; ++c) pixel.color[c] += from.color[c] / 4.0;
                pixel.depth += from.depth / 4.0;
                near = std::max(near, from.depth);
                far = std::min(far, from.depth);
            }
        if (!one_surface(near, far)) pixel.depth = far;
        return pixel;
    }
    static void push(const Level& coarse, Level& fine) {
        for (int y = 0; y < fine.height; ++y)
            for (int x = 0; x < fine.width; ++x) {
                const Pixel pushed = between(coarse, x, y);
                Pixel& own = fine.pixels[{x, y}];
                for (std::size_t c = 0; c < 3; ++c)
                    own.color[c] = to_sixteenth(pushed.color[c] * (1.0 - own.weight) + own.color[c] * own.weight);
                if (own.weight == 0.0)
                    own.depth = pushed.depth;
                else if (own.weight < 1.0)
                    own.depth = one_surface(std::max(own.depth, pushed.depth), std::min(own.depth, pushed.depth))
                                    ? pushed.depth * (1.0 - own.weight) + own.depth * own.weight
                                    : std::min(own.depth, pushed.depth);
            }
    }

    int guard_;
    std::vector<Level> levels_;
};

TEST(PushPull, FollowsTheRule) {
    for (const Case& random : small_cases()) {
        const Picture picture = picture_of(Reconstruction::push_pull, random.plan, random.samples);
        const PushPullRule rule(random);
        int other_depths = 0;
        for (int y = 0; y < random.plan.height_px; ++y)
            for (int x = 0; x < random.plan.width_px; ++x) {
                const bool hidden = test::is_hidden(random.plan, x, y);
                const PushPullRule::Pixel expected = hidden ? PushPullRule::Pixel{} : rule.at(x, y);
                for (unsigned c = 0; c < 3; ++c)
                    ASSERT_EQ(channel(picture.color.at(x, y), c), expected.color[c])
                        << "pixel " << x << ", " << y << " channel " << c;
                ASSERT_EQ(channel(picture.color.at(x, y), 3), 255U);
                if (!(std::abs(picture.inverse_depth.at(x, y) - expected.depth) <= 2e-6 * 4.4)) ++other_depths;
            }
        // Averages within a rounding of the ratio between surfaces may be taken for either.
        EXPECT_LE(other_depths, random.plan.width_px * random.plan.height_px / 1000);
    }
}

TEST(Scattered, ConstantPictureStaysConstant) {
    for (const Reconstruction kind : kScattered) {
        Case random = test::mesh_case(3, {90, 70}, 0.1);
        for (const std::uint32_t address : random.plan.trace_order) {
            random.samples.color[address] = 0xFF37C8FEU;
            random.samples.inverse_depth_per_m[address] = 0.371F;
        }
        const Picture picture = picture_of(kind, random.plan, random.samples);
        for (std::size_t i = 0; i < picture.color.texels.size(); ++i) {
            ASSERT_EQ(picture.color.texels[i], 0xFF37C8FEU) << to_string(kind);
            ASSERT_EQ(picture.inverse_depth.texels[i], 0.371F) << to_string(kind);
        }
    }
}

TEST(Scattered, FullSamplingIsACopyToTheBit) {
    const auto hidden = [](int x, int y) { return (x - 40) * (x - 40) + (y - 30) * (y - 30) > 1200; };
    SamplePlan plan = test::tile_plan(
        test::shared_tables()->rank_tile(), 75, 61, {9, 30}, [](int, int) { return kFullLevel; },
        [&](int x, int y) { return x < 0 || y < 0 || x >= 75 || y >= 61 || !hidden(x, y); });
    test::hide(plan, hidden);
    const auto color = [](int x, int y) { return 0xFF000000U | static_cast<Rgba8>(x * 54321 ^ y * 777); };
    const auto depth = [](int x, int y) { return static_cast<float>((x * x + y) % 17) / 3.0F; };
    const Samples samples = test::sample_picture(plan, color, depth);
    for (const Reconstruction kind : kScattered) {
        const Picture picture = picture_of(kind, plan, samples);
        for (int y = 0; y < plan.height_px; ++y)
            for (int x = 0; x < plan.width_px; ++x) {
                ASSERT_EQ(picture.color.at(x, y), hidden(x, y) ? 0xFF000000U : color(x, y)) << to_string(kind);
                ASSERT_EQ(picture.inverse_depth.at(x, y), hidden(x, y) ? 0.0F : depth(x, y)) << to_string(kind);
            }
    }
}

TEST(Scattered, SamplesOutsideOfTheWindowAreUsed) {
    const SamplePlan plan = test::tile_plan(
        test::shared_tables()->rank_tile(), 40, 40, {0, 0}, [](int, int) { return kFullLevel; },
        [](int x, int) { return x < 0 || x >= 40; });
    const Samples samples = test::sample_picture(
        plan, [](int x, int) { return x < 0 ? 0xFF0000FFU : 0xFFFF0000U; },
        [](int x, int) { return x < 0 ? 1.0F : 0.5F; });
    for (const Reconstruction kind : kScattered) {
        const Picture picture = picture_of(kind, plan, samples);
        EXPECT_EQ(picture.color.at(0, 20), 0xFF0000FFU) << to_string(kind);
        EXPECT_EQ(picture.inverse_depth.at(0, 20), 1.0F) << to_string(kind);
        EXPECT_EQ(picture.color.at(39, 20), 0xFFFF0000U) << to_string(kind);
        EXPECT_EQ(picture.inverse_depth.at(39, 20), 0.5F) << to_string(kind);
    }
}

TEST(Scattered, PlansWithoutSamplesAtPixelCentresAreRefused) {
    SamplePlan plan;
    plan.width_px = plan.height_px = 8;
    plan.position.resize(4);
    plan.grids.rectangular.emplace_back();
    for (const Reconstruction kind : kScattered)
        EXPECT_EQ(make_cpu_scattered_reconstructor(kind)->reconstruct(plan, {}, {}).error().code, ErrorCode::option);
}

/// Root mean square error of the green channel, in code values.
double rms_error(const Picture& picture, const ColorImage& truth) {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.texels.size(); ++i) {
        const double difference =
            static_cast<double>(channel(picture.color.texels[i], 1)) - channel(truth.texels[i], 1);
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(truth.texels.size()));
}

// Between samples a distance h apart a smooth signal is wrong by its slope times h where the nearest is taken, and by
// no more where several are averaged; h is the root of the inverse density. Nine times the samples: a third of the
// error.
TEST(Scattered, SmoothSignalConvergesWithDensity) {
    constexpr int kSize_px = 200;
    const auto signal = [](int x, int y) {
        return 127.5 + 60.0 * std::sin(0.03 * x + 0.01 * y) + 60.0 * std::cos(0.04 * y - 0.02 * x);
    };
    ColorImage truth(kSize_px, kSize_px);
    for (int y = 0; y < kSize_px; ++y)
        for (int x = 0; x < kSize_px; ++x)
            truth.at(x, y) = static_cast<Rgba8>(std::lround(signal(x, y))) << 8 | 0xFF000000U;
    for (const Reconstruction kind : kScattered) {
        double before = 1e9;
        for (const double share : {0.005, 0.045, 0.405}) {
            Case random = test::mesh_case(77, {kSize_px, kSize_px}, share);
            for (const std::uint32_t address : random.plan.trace_order) {
                const SamplePosition at = random.plan.position[address];
                random.samples.color[address] =
                    static_cast<Rgba8>(std::lround(signal(at.x_px, at.y_px))) << 8 | 0xFF000000U;
            }
            const double error = rms_error(picture_of(kind, random.plan, random.samples), truth);
            std::printf("%s, share %.3f: rms error %.2f of 255\n", to_string(kind).c_str(), share, error);
            EXPECT_LT(error, before / 2.2) << to_string(kind);
            before = error;
        }
    }
}

double psnr_db(const Picture& picture, const ColorImage& truth) {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.texels.size(); ++i)
        for (unsigned c = 0; c < 3; ++c) {
            const double difference =
                static_cast<double>(channel(picture.color.texels[i], c)) - channel(truth.texels[i], c);
            sum += difference * difference / (3.0 * static_cast<double>(truth.texels.size()));
        }
    return 10.0 * std::log10(255.0 * 255.0 / sum);
}

TEST(Scattered, RenderedPictureAtTwentySevenPercent) {
    const ColorImage rendered = test::read_png(std::string(MACULA_SOURCE_DIR) + "/tests/golden/bunny_box.png").value();
    constexpr int kGuard_px = 32;
    const int width = rendered.width_px - 2 * kGuard_px;
    const int height = rendered.height_px - 2 * kGuard_px;
    const SamplePlan plan = test::tile_plan(
        test::shared_tables()->rank_tile(), width, height, {5, 41},
        [](int x, int y) {
            return std::clamp(kFullLevel + 3 - 3 * (std::abs(x - 7) + std::abs(y - 5)), 11, kFullLevel);
        },
        [](int, int) { return true; });
    ASSERT_NEAR(plan.traced_share(), 0.27, 0.01);
    const auto color = [&](int x, int y) { return rendered.at(x + kGuard_px, y + kGuard_px) | 0xFF000000U; };
    const Samples samples = test::sample_picture(plan, color, [](int, int) { return 1.0F; });
    ColorImage truth(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) truth.at(x, y) = color(x, y);

    const double tiles =
        psnr_db(test::reconstruct(*make_cpu_reconstructor(test::shared_tables()), plan, samples), truth);
    std::map<Reconstruction, double> scattered;
    for (const Reconstruction kind : kScattered) scattered[kind] = psnr_db(picture_of(kind, plan, samples), truth);
    std::printf("PSNR: tiles %.2f dB, push-pull %.2f dB, cells %.2f dB, nearest %.2f dB\n", tiles,
                scattered[Reconstruction::push_pull], scattered[Reconstruction::cells],
                scattered[Reconstruction::nearest]);
    EXPECT_LT(scattered[Reconstruction::cells], tiles - 0.5);
    for (const Reconstruction kind : {Reconstruction::push_pull, Reconstruction::nearest}) {
        EXPECT_GT(scattered[kind], scattered[Reconstruction::cells] + 0.5) << to_string(kind);
        EXPECT_NEAR(scattered[kind], tiles, 2.0) << to_string(kind);
    }
}

}  // namespace
}  // namespace macula
