// A wire thinner than the distance of samples: what is left of it after accumulation.

#include <gtest/gtest.h>

#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "tests/support/moving_scene.h"

namespace macula {
namespace {

struct WirePixel {
    int x;
    int y;
    float background;
    float wire;
};

float brightness(Rgba8 color) {
    return static_cast<float>((color & 255U) + (color >> 8 & 255U) + (color >> 16 & 255U)) / 3.0F;
}

class ThinWire : public testing::Test {
protected:
    ThinWire() : display_(*load_display("desktop")) {
        display_.eye_width_px = 376;
        display_.eye_height_px = 420;
    }

    /// Pixels of wires where at most a fifth of the pixels is traced, against an even background.
    std::vector<WirePixel> find_wires(const SamplePlan& plan, const ColorImage& reference) const {
        std::vector<WirePixel> wires;
        const std::vector<std::uint8_t> hidden = hidden_pixels(display_, kLeftEye);
        for (int y = 8; y < display_.eye_height_px - 8; ++y) {
            for (int x = 8; x < display_.eye_width_px - 8; ++x) {
                if (hidden[static_cast<std::size_t>(y * display_.eye_width_px + x)] != 0) continue;
                const int tile = (y - plan.origin_px.y) / 16 * plan.tiles_x + (x - plan.origin_px.x) / 16;
                if (kLevelCounts[plan.level[static_cast<std::size_t>(tile)]] > 48) continue;
                const float left = brightness(reference.at(x - 3, y));
                const float right = brightness(reference.at(x + 3, y));
                const float here = brightness(reference.at(x, y));
                if (std::abs(left - right) > 4.0F || here > 0.8F * left) continue;
                wires.push_back({x, y, 0.5F * (left + right), here});
            }
        }
        return wires;
    }

    /// Mean contrast of the wires after 40 frames at rest; 1 is that of 16 rays a pixel.
    double contrast(const kernels::TaaWeights& weights) {
        test::FoveatedView view(display_, 0.18);
        const auto compositor = make_cpu_compositor(display_, weights);
        for (int i = 0; i < 40; ++i) static_cast<void>(compositor->accumulate(view.frame(i, {})));
        ColorImage picture;
        static_cast<void>(compositor->show({Pose{}, Pose{}}, 0, picture));
        const auto wires = find_wires(view.plan, test::reference_picture(view.view({})));
        EXPECT_GT(wires.size(), 50U);
        double sum = 0.0;
        for (const WirePixel& pixel : wires) {
            sum += static_cast<double>((pixel.background - brightness(picture.at(pixel.x, pixel.y))) /
                                       (pixel.background - pixel.wire));
        }
        return sum / static_cast<double>(wires.size());
    }

    Display display_;
};

TEST_F(ThinWire, SurvivesWhereSamplesAreSparse) {
    const double kept = contrast(default_taa_weights());
    const double of_a_frame = contrast(no_taa_weights());
    RecordProperty("contrast", std::to_string(kept));
    RecordProperty("contrast_of_a_frame", std::to_string(of_a_frame));
    std::printf("contrast of wires: %.2f; of a frame alone: %.2f\n", kept, of_a_frame);
    EXPECT_GT(kept, 0.8);
    EXPECT_LT(of_a_frame, kept - 0.1) << "accumulation that erases wires would pass this test";
}

}  // namespace
}  // namespace macula
