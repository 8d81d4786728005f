#include "tests/metrics/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace macula::test {
namespace {

constexpr int kTaps = 2 * kSsimReach_px + 1;
constexpr float kC1 = 0.01F * 0.01F;
constexpr float kC2 = 0.03F * 0.03F;

std::array<float, kTaps> gaussian() {
    std::array<double, kTaps> weights{};
    double sum = 0.0;
    for (int i = 0; i < kTaps; ++i) {
        const double x = (i - kSsimReach_px) / 1.5;
        weights[i] = std::exp(-0.5 * x * x);
        sum += weights[i];
    }
    std::array<float, kTaps> normalised{};
    for (int i = 0; i < kTaps; ++i) normalised[i] = static_cast<float>(weights[i] / sum);
    return normalised;
}

/// Half is taken off so that the variances, differences of mean squares, lose fewer bits.
constexpr float kLumaOffset = 0.5F;

void luma_of_row(const Rgba8* row, int width_px, float* luma) {
    for (int x = 0; x < width_px; ++x) {
        const Rgba8 c = row[x];
        const float sum = 0.2126F * static_cast<float>(c & 255U) + 0.7152F * static_cast<float>(c >> 8 & 255U) +
                          0.0722F * static_cast<float>(c >> 16 & 255U);
        luma[x] = sum / 255.0F - kLumaOffset;
    }
}

/// What SSIM is made of: local means of both lumas, of the sum of their squares and of their product.
enum Moment { kMeanA, kMeanB, kSquares, kProduct, kMoments };

/// Rows of moments, blurred along the row. Only the last kTaps rows are kept: a picture's would not fit a cache.
class BlurredRows {
public:
    explicit BlurredRows(int width_px)
        : width_px_(width_px), rows_(static_cast<std::size_t>(width_px) * kTaps * kMoments) {}

    [[nodiscard]] float* row(int y, int moment) {
        return rows_.data() + (static_cast<std::size_t>(y % kTaps) * kMoments + moment) * width_px_;
    }

private:
    int width_px_;
    std::vector<float> rows_;
};

}  // namespace

std::vector<std::uint8_t> pixels_without_window(int width_px, int height_px, const std::vector<std::uint8_t>& hidden) {
    // The window is a box: a pixel has one if the box around it is as large as kTaps squared and counts no hidden
    // pixel.
    const auto hidden_at = [&](int x, int y) { return !hidden.empty() && hidden[y * width_px + x] != 0; };
    std::vector<int> above((width_px + 1) * (height_px + 1), 0);  // hidden pixels above and left of each corner
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const int corner = y * (width_px + 1) + x;
            above[corner + width_px + 2] =
                above[corner + width_px + 1] + above[corner + 1] - above[corner] + (hidden_at(x, y) ? 1 : 0);
        }
    }
    std::vector<std::uint8_t> without(static_cast<std::size_t>(width_px) * height_px, 1);
    for (int y = kSsimReach_px; y < height_px - kSsimReach_px; ++y) {
        for (int x = kSsimReach_px; x < width_px - kSsimReach_px; ++x) {
            const int top = (y - kSsimReach_px) * (width_px + 1) + x - kSsimReach_px;
            const int bottom = top + kTaps * (width_px + 1);
            without[y * width_px + x] = above[bottom + kTaps] - above[bottom] - above[top + kTaps] + above[top] > 0;
        }
    }
    return without;
}

double mean_ssim(const ColorImage& a, const ColorImage& b, const std::vector<std::uint8_t>& skipped) {
    static const std::array<float, kTaps> kWeights = gaussian();
    const int width_px = a.width_px;
    BlurredRows blurred(width_px);
    std::array<std::vector<float>, kMoments> sharp;
    std::array<std::vector<float>, kMoments> local;
    for (auto& row : sharp) row.resize(width_px);
    for (auto& row : local) row.resize(width_px);

    double sum = 0.0;
    std::int64_t pixels = 0;
    for (int y = 0; y < a.height_px; ++y) {
        luma_of_row(a.row(y), width_px, sharp[kMeanA].data());
        luma_of_row(b.row(y), width_px, sharp[kMeanB].data());
        for (int x = 0; x < width_px; ++x) {
            const float la = sharp[kMeanA][x];
            const float lb = sharp[kMeanB][x];
            sharp[kSquares][x] = la * la + lb * lb;
            sharp[kProduct][x] = la * lb;
        }
        for (int moment = 0; moment < kMoments; ++moment) {
            const float* in = sharp[moment].data();
            float* out = blurred.row(y, moment);
            for (int x = kSsimReach_px; x < width_px - kSsimReach_px; ++x) {
                float value = 0.0F;
                for (int i = 0; i < kTaps; ++i) value += kWeights[i] * in[x + i - kSsimReach_px];
                out[x] = value;
            }
        }
        if (y < 2 * kSsimReach_px) continue;
        for (int moment = 0; moment < kMoments; ++moment) {
            float* out = local[moment].data();
            std::fill_n(out, width_px, 0.0F);
            for (int i = 0; i < kTaps; ++i) {
                const float* in = blurred.row(y - 2 * kSsimReach_px + i, moment);
                for (int x = 0; x < width_px; ++x) out[x] += kWeights[i] * in[x];
            }
        }
        const std::uint8_t* skip = skipped.data() + static_cast<std::size_t>(y - kSsimReach_px) * width_px;
        float row_sum = 0.0F;  // of at most some thousand values in -1..1
        for (int x = kSsimReach_px; x < width_px - kSsimReach_px; ++x) {
            const float da = local[kMeanA][x];
            const float db = local[kMeanB][x];
            const float covariance = local[kProduct][x] - da * db;
            const float variances = local[kSquares][x] - da * da - db * db;
            const float ma = da + kLumaOffset;
            const float mb = db + kLumaOffset;
            const float similarity =
                (2.0F * ma * mb + kC1) * (2.0F * covariance + kC2) / ((ma * ma + mb * mb + kC1) * (variances + kC2));
            row_sum += skip[x] == 0 ? similarity : 0.0F;
            pixels += skip[x] == 0 ? 1 : 0;
        }
        sum += row_sum;
    }
    return pixels > 0 ? sum / static_cast<double>(pixels) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace macula::test
