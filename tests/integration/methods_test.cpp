// Every way to make frames, through the tracer, against the one that is known: every pixel traced.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "masks/display.h"
#include "masks/tile_tables.h"
#include "scenes/load.h"
#include "server/mesh_shelf.h"
#include "server/method_parts.h"
#include "server/render/reconstructor_factory.h"
#include "server/render/tracer.h"

namespace macula {
namespace {

/// Every pair of sampler and reconstruction that goes together, with a preset between the two.
std::vector<std::string> methods(const std::string& preset) {
    std::vector<std::string> result;
    for (const char* reconstruction : {"tiles", "push-pull", "cells", "nearest"})
        result.push_back("tiles:" + preset + "/" + reconstruction);
    for (const char* mesh : {"mesh", "mesh-16"}) {
        for (const char* reconstruction : {"table", "raster", "push-pull", "cells", "nearest"}) {
            std::string name = mesh;
            result.push_back(name.append(":").append(preset).append("/").append(reconstruction));
        }
    }
    for (const char* rival : {"uniform:", "layers:", "log-polar:"}) {
        if (preset == "full" && std::string(rival) == "log-polar:") continue;
        result.push_back(rival + preset + "/bilinear");
    }
    return result;
}

struct PictureOfEye {
    ColorImage color;
    InverseDepthImage inverse_depth;
    SamplePlan plan;
};

/// What all methods share.
class Studio {
public:
    Studio() {
        auto loaded = load_scene("bunny-box");
        if (!loaded) throw std::runtime_error(loaded.error().message);  // a test that cannot go on
        scene_ = loaded->scene;
        auto tracer = make_embree_tracer(scene_);
        if (!tracer) throw std::runtime_error(tracer.error().message);
        tracer_ = *std::move(tracer);
        display_ = load_display("vive").value();
        // An eighth of the size, with the hidden area and the asymmetry of the whole.
        display_.eye_width_px /= 8;
        display_.eye_height_px /= 8;
    }

    [[nodiscard]] const Display& display() const { return display_; }
    [[nodiscard]] Expected<std::unique_ptr<Sampler>> sampler(const std::string& name, const Display& display) {
        const auto method = parse_method(name);
        if (!method) return tl::unexpected(method.error());
        return make_sampler(*method, display, kLeftEye, tables_, meshes_);
    }
    /// `on`: cpu or gl. `gaze_eye` need not be a unit vector.
    PictureOfEye picture(const std::string& name, const std::string& on, glm::vec3 gaze_eye) {
        auto sampler_made = sampler(name, display_);
        EXPECT_TRUE(sampler_made) << name << ": " << sampler_made.error().message;
        auto reconstructor = factory(on).make(parse_method(name)->reconstruction);
        EXPECT_TRUE(reconstructor) << name << ": " << reconstructor.error().message;
        PictureOfEye result;
        if (!sampler_made || !reconstructor) return result;
        (*sampler_made)->plan({glm::normalize(gaze_eye), glm::ivec2(0)}, result.plan);
        EyeView view;
        view.world_from_eye = scene_->world_from_start * display_.eyes[kLeftEye].head_from_eye;
        view.tangents = display_.eyes[kLeftEye].tangents;
        view.width_px = display_.eye_width_px;
        view.height_px = display_.eye_height_px;
        Samples samples;
        const TraceTask task{&view, &result.plan, &samples};
        tracer_->trace({&task, 1});
        result.color = {view.width_px, view.height_px, 0x12345678U};
        result.inverse_depth = {view.width_px, view.height_px, -7.0F};
        const auto stride = static_cast<std::size_t>(view.width_px);
        const auto done =
            (*reconstructor)
                ->reconstruct(result.plan, samples,
                              {result.color.texels.data(), stride, result.inverse_depth.texels.data(), stride});
        EXPECT_TRUE(done) << name << ": " << done.error().message;
        return result;
    }

private:
    const ReconstructorFactory& factory(const std::string& on) {
        std::unique_ptr<ReconstructorFactory>& made = on == "gl" ? on_gl_ : on_cpu_;
        if (made == nullptr) {
            ReconstructorOptions options;
            options.reconstruct_on = on;
            auto factory = make_reconstructor_factory(options, tables_);
            if (!factory) throw std::runtime_error(factory.error().message);
            made = *std::move(factory);
        }
        return *made;
    }

    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const Tracer> tracer_;
    Display display_;
    std::shared_ptr<const TileTables> tables_ = std::make_shared<const TileTables>(make_rank_tile());
    MeshShelf meshes_{std::filesystem::path(testing::TempDir()) / "macula_methods_test", [](const std::string&) {}};
    std::unique_ptr<ReconstructorFactory> on_cpu_;
    std::unique_ptr<ReconstructorFactory> on_gl_;
};

class Methods : public testing::Test {
protected:
    static void SetUpTestSuite() { studio_ = std::make_unique<Studio>(); }
    static void TearDownTestSuite() { studio_.reset(); }
    static std::unique_ptr<Studio> studio_;
};
std::unique_ptr<Studio> Methods::studio_;

constexpr glm::vec3 kGaze = glm::vec3(0.3F, -0.2F, -1.0F);

/// Mean squared error over the pixels that the lens shows, as a peak signal-to-noise ratio.
double psnr_db(const Display& display, const ColorImage& a, const ColorImage& b) {
    const std::vector<std::uint8_t> hidden = hidden_pixels(display, kLeftEye);
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        if (hidden[i] != 0) continue;
        for (const unsigned shift : {0U, 8U, 16U}) {
            const double difference =
                static_cast<double>(a.texels[i] >> shift & 255U) - static_cast<double>(b.texels[i] >> shift & 255U);
            sum += difference * difference;
            count += 1.0;
        }
    }
    return 10.0 * std::log10(255.0 * 255.0 * count / std::max(sum, 1e-9));
}

/// Rasterisers may evaluate a triangle's plane from the picture's corner, and software GL does: far from there,
/// rounding costs some parts in ten thousand even at the triangle's own corners. Colours are rounded to whole numbers
/// afterwards and show nothing of it.
void expect_same_depth(const InverseDepthImage& result, const InverseDepthImage& expected, bool rounded,
                       const std::string& name) {
    if (!rounded) {
        EXPECT_EQ(result.texels, expected.texels) << name;
        return;
    }
    double largest = 0.0;
    for (std::size_t i = 0; i < result.texels.size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(result.texels[i]) - expected.texels[i]));
    const float nearest = *std::max_element(expected.texels.begin(), expected.texels.end());
    std::printf("%s: inverse depth within %.2g of %.3g per metre\n", name.c_str(), largest, nearest);
    EXPECT_LT(largest, 2e-4 * nearest) << name;
}

TEST_F(Methods, AtFullAllGiveTheSamePictureToTheLastBit) {
    const PictureOfEye expected = studio_->picture("full", "cpu", kGaze);
    for (const char* on : {"cpu", "gl"}) {
        for (const std::string& name : methods("full")) {
            const PictureOfEye picture = studio_->picture(name, on, kGaze);
            const std::string where = name + " on " + on;
            const bool rounded = where.find("/raster on gl") != std::string::npos;
            EXPECT_EQ(picture.color.texels, expected.color.texels) << where;
            expect_same_depth(picture.inverse_depth, expected.inverse_depth, rounded, where);
            EXPECT_EQ(picture.plan.traced_in_window, expected.plan.traced_in_window) << where;
        }
    }
}

/// Least PSNR in dB: some 1 dB below what was measured.
double least_psnr_db(const std::string& name) {
    if (name.starts_with("log-polar")) return 23.0;
    if (name.starts_with("uniform")) return 24.0;
    return name.ends_with("/cells") ? 23.5 : 25.3;
}

TEST_F(Methods, AQuarterOfThePixelsMakeAPictureByAnyMethodAndOnAnyProcessor) {
    const PictureOfEye expected = studio_->picture("full", "cpu", kGaze);
    for (const std::string& name : methods("27")) {
        const PictureOfEye on_cpu = studio_->picture(name, "cpu", kGaze);
        const PictureOfEye on_gl = studio_->picture(name, "gl", kGaze);
        const double quality_db = psnr_db(studio_->display(), on_cpu.color, expected.color);
        std::printf("%-24s %5.2f dB, %5.2f %% traced\n", name.c_str(), quality_db, 100.0 * on_cpu.plan.traced_share());
        EXPECT_GT(quality_db, least_psnr_db(name)) << name;
        EXPECT_GT(psnr_db(studio_->display(), on_gl.color, on_cpu.color), 50.0) << name;
    }
}

/// Of all pixels, hidden ones counted, as presets count; so on a display without a hidden area.
TEST_F(Methods, PresetsTraceTheirShareByAnySampler) {
    Display display = load_display("vive").value();
    for (EyeDisplay& eye : display.eyes) eye.visible_outline.clear();
    Display half = display;
    half.eye_width_px /= 2;  // for meshes, whose masks are four times as large
    half.eye_height_px /= 2;
    for (const std::string& percent : {std::string("54"), std::string("41"), std::string("27"), std::string("18")}) {
        for (const std::string& preset : {percent, "paper-" + percent}) {
            for (const char* kind : {"tiles:", "mesh:", "uniform:", "layers:", "log-polar:"}) {
                const std::string name = kind + preset;
                const auto sampler = studio_->sampler(name, name.starts_with("mesh") ? half : display);
                ASSERT_TRUE(sampler) << name << ": " << sampler.error().message;
                SamplePlan plan;
                (*sampler)->plan({}, plan);
                EXPECT_NEAR(100.0 * plan.traced_share(), std::stod(percent), 0.2) << name;
            }
        }
    }
}

}  // namespace
}  // namespace macula
