#include "tests/metrics/clip_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "tests/metrics/ssim.h"

namespace macula::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kChannels = 3.0;

/// Mean of squares over the channels of pixels, of values of 0..1.
double mean_square(std::int64_t sum, std::int64_t pixels) {
    if (pixels == 0) return kNan;
    return static_cast<double>(sum) / (255.0 * 255.0 * kChannels * static_cast<double>(pixels));
}

double psnr_db(double mean_square) {
    return -10.0 * std::log10(mean_square);  // infinite for 0
}

template <class PerZone>
std::int64_t sum_of_zones(const PerZone& values, int begin, int end) {
    return std::accumulate(values.begin() + begin, values.begin() + end, std::int64_t{0});
}

}  // namespace

std::vector<float> eccentricity_deg(const Tangents& tangents, int width_px, int height_px, const glm::vec3& gaze_eye) {
    std::vector<float> angles;
    angles.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    const float step_x = (tangents.right - tangents.left) / static_cast<float>(width_px);
    const float step_y = (tangents.top - tangents.bottom) / static_cast<float>(height_px);
    for (int y = 0; y < height_px; ++y) {
        const float tangent_y = tangents.top - (static_cast<float>(y) + 0.5F) * step_y;
        for (int x = 0; x < width_px; ++x) {
            const glm::vec3 direction(tangents.left + (static_cast<float>(x) + 0.5F) * step_x, tangent_y, -1.0F);
            // The arc cosine would lose the angles near 0.
            const float angle = std::atan2(glm::length(glm::cross(direction, gaze_eye)), glm::dot(direction, gaze_eye));
            angles.push_back(glm::degrees(angle));
        }
    }
    return angles;
}

ClipMeter::ClipMeter(const Tangents& tangents, int width_px, int height_px, std::vector<std::uint8_t> hidden)
    : tangents_(tangents),
      width_px_(width_px),
      height_px_(height_px),
      hidden_(std::move(hidden)),
      no_window_(pixels_without_window(width_px, height_px, hidden_)) {}

void ClipMeter::set_zones(const glm::vec3& gaze_eye) {
    if (gaze_eye == gaze_) return;
    gaze_ = gaze_eye;
    const std::vector<float> angles_deg = eccentricity_deg(tangents_, width_px_, height_px_, gaze_eye);
    zone_.resize(angles_deg.size());
    pixels_now_ = {};
    for (std::size_t i = 0; i < zone_.size(); ++i) {
        int zone = kFovea;
        if (!hidden_.empty() && hidden_[i] != 0) {
            zone = kHidden;
        } else if (angles_deg[i] > kFovealRadius_deg) {
            zone = 1;
            for (const double end_deg : kRingEnd_deg) zone += angles_deg[i] > end_deg ? 1 : 0;
        }
        zone_[i] = static_cast<std::uint8_t>(zone);
        ++pixels_now_[zone];
    }
}

void ClipMeter::add(const ColorImage& shown, const ColorImage& reference, const glm::vec3& gaze_eye) {
    set_zones(gaze_eye);
    const bool first = error_before_.empty();
    if (first) error_before_.resize(3 * zone_.size());
    PerZone change{};
    for (std::size_t i = 0; i < zone_.size(); ++i) {
        int error_square = 0;
        int change_square = 0;
        for (int channel = 0; channel < 3; ++channel) {
            const int shift = 8 * channel;
            const int error = static_cast<int>(shown.texels[i] >> shift & 255U) -
                              static_cast<int>(reference.texels[i] >> shift & 255U);
            const int step = error - error_before_[3 * i + channel];
            error_before_[3 * i + channel] = static_cast<std::int16_t>(error);
            error_square += error * error;
            change_square += step * step;
        }
        error_[zone_[i]] += error_square;
        change[zone_[i]] += change_square;
    }
    for (int zone = 0; zone < kZones; ++zone) error_pixels_[zone] += pixels_now_[zone];
    ssim_sum_ += mean_ssim(shown, reference, no_window_);
    ++frames_;
    if (first) return;
    for (int zone = 0; zone < kZones; ++zone) {
        change_[zone] += change[zone];
        change_pixels_[zone] += pixels_now_[zone];
    }
    const std::int64_t pixels = sum_of_zones(pixels_now_, kFovea, kHidden);
    worst_change_ = std::max(worst_change_, mean_square(sum_of_zones(change, kFovea, kHidden), pixels));
}

ClipFigures ClipMeter::figures() const {
    ClipFigures figures;
    figures.frames = frames_;
    figures.psnr_db =
        psnr_db(mean_square(sum_of_zones(error_, kFovea, kHidden), sum_of_zones(error_pixels_, kFovea, kHidden)));
    figures.foveal_psnr_db = psnr_db(mean_square(error_[kFovea], error_pixels_[kFovea]));
    figures.ssim = frames_ > 0 ? ssim_sum_ / frames_ : kNan;
    figures.flicker =
        std::sqrt(mean_square(sum_of_zones(change_, kFovea, kHidden), sum_of_zones(change_pixels_, kFovea, kHidden)));
    for (std::size_t ring = 0; ring < kRingEnd_deg.size(); ++ring) {
        const int begin = ring == 0 ? kFovea : static_cast<int>(ring) + 1;
        const int end = static_cast<int>(ring) + 2;
        figures.ring_flicker[ring] =
            std::sqrt(mean_square(sum_of_zones(change_, begin, end), sum_of_zones(change_pixels_, begin, end)));
    }
    figures.worst_flicker = frames_ > 1 ? std::sqrt(worst_change_) : kNan;
    return figures;
}

}  // namespace macula::test
