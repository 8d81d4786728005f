#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "protocol/base/geometry.h"
#include "protocol/base/image.h"

namespace macula::test {

/// Rings of angles from the gaze that flicker is told apart by: each ends here, in degrees, and begins where the one
/// before ends; the first begins at 0.
inline constexpr std::array<double, 5> kRingEnd_deg = {5.0, 15.0, 25.0, 40.0, 90.0};
/// Pixels this near to the gaze are the foveal window, 5 degrees wide.
inline constexpr double kFovealRadius_deg = 2.5;

/// What one eye's clip is judged by. Values are those of sRGB-coded channels, of 0..1; pixels that the lens hides do
/// not count.
struct ClipFigures {
    int frames = 0;
    /// Peak signal to noise of all pixels of all frames together, decibels; infinite where nothing differs.
    double psnr_db = 0.0;
    double foveal_psnr_db = 0.0;  ///< of the foveal window of each frame; NaN if it never has a pixel
    /// Structural similarity of luma, mean over pixels and frames (Wang et al. 2004: Gaussian window with a standard
    /// deviation of 1.5 px over 11x11 px, K1 .01, K2 .03), of those whose window is on the picture and holds no hidden
    /// pixel; NaN if there is none. Luma has the weights of Rec.709.
    double ssim = 0.0;
    /// rms over pixels and steps from frame to frame of the change of the error, (I' - R') - (I - R): what moves
    /// without cause. A reference that moves with the head compensates motion. NaN for a single frame, as what follows.
    double flicker = 0.0;
    std::array<double, kRingEnd_deg.size()> ring_flicker{};  ///< by kRingEnd_deg; NaN where a ring has no pixel
    double worst_flicker = 0.0;                              ///< of the step that changes most: what pops
};

/// Angle of each pixel's centre from the gaze, degrees, row-major. The direction of a pixel follows from the frustum
/// (protocol/CONVENTIONS.md). `gaze_eye` is a unit vector in eye space.
std::vector<float> eccentricity_deg(const Tangents& tangents, int width_px, int height_px, const glm::vec3& gaze_eye);

/// Judges a clip frame by frame against references of the same size. One thread at a time.
class ClipMeter {
public:
    /// `hidden`: 1 for each pixel that the lens never shows, row-major, or empty.
    ClipMeter(const Tangents& tangents, int width_px, int height_px, std::vector<std::uint8_t> hidden);

    /// Takes the next frame of the clip and its reference, with the true gaze of its time: a unit vector in eye space.
    /// Flicker from one frame to the next belongs to the rings around the later one's gaze.
    void add(const ColorImage& shown, const ColorImage& reference, const glm::vec3& gaze_eye);
    [[nodiscard]] ClipFigures figures() const;

private:
    /// Classes of pixels by angle from the gaze: the foveal window, what is left of the first ring, the other rings,
    /// what is beyond them all, and what is hidden.
    enum Zone : std::uint8_t { kFovea = 0, kBeyond = kRingEnd_deg.size() + 1, kHidden, kZones };
    using PerZone = std::array<std::int64_t, kZones>;

    void set_zones(const glm::vec3& gaze_eye);

    Tangents tangents_;
    int width_px_;
    int height_px_;
    std::vector<std::uint8_t> hidden_;
    std::vector<std::uint8_t> no_window_;  ///< 1 where the window of SSIM leaves the picture or holds a hidden pixel
    std::vector<std::uint8_t> zone_;       ///< of each pixel, for gaze_
    glm::vec3 gaze_ = glm::vec3(0.0F);
    PerZone pixels_now_{};  ///< how many pixels each zone has, for gaze_
    int frames_ = 0;
    // Sums of squares over the three channels, in units of a byte's step, exact; pixels that they are of.
    PerZone error_{};
    PerZone error_pixels_{};
    PerZone change_{};
    PerZone change_pixels_{};
    double ssim_sum_ = 0.0;
    double worst_change_ = 0.0;               ///< mean square of a step, in the same unit
    std::vector<std::int16_t> error_before_;  ///< shown - reference of the last frame, three channels a pixel
};

}  // namespace macula::test
