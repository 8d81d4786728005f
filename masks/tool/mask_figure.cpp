#include "masks/tool/mask_figure.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "masks/tool/svg.h"

namespace macula {
namespace {

constexpr int kGap_px = 12;

/// Sums of samples over the rectangle from the crop's corner, so that the mean over any rectangle is four of them.
class SampleSums {
public:
    SampleSums(const Mask& mask, const MaskCrop& crop)
        : size_px_(crop.size_px), sum_(static_cast<std::size_t>(size_px_.x + 1) * (size_px_.y + 1)) {
        for (int y = 0; y < size_px_.y; ++y) {
            const std::uint8_t* row = mask.sampled.data() +
                                      static_cast<std::ptrdiff_t>(crop.begin_px.y + y) * mask.width_px +
                                      crop.begin_px.x;
            std::uint32_t of_row = 0;
            for (int x = 0; x < size_px_.x; ++x) {
                of_row += row[x] != 0 ? 1U : 0U;
                sum_[index(x + 1, y + 1)] = sum_[index(x + 1, y)] + of_row;
            }
        }
    }

    /// Share 0..1 of a rectangle that lies inside, with corners anywhere, that sampled pixels cover.
    [[nodiscard]] double mean(glm::dvec2 begin, glm::dvec2 end) const {
        return (at(end.x, end.y) - at(begin.x, end.y) - at(end.x, begin.y) + at(begin.x, begin.y)) /
               ((end.x - begin.x) * (end.y - begin.y));
    }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * (size_px_.x + 1) + static_cast<std::size_t>(x);
    }
    /// Between whole pixels the sum is bilinear, for each pixel is of one value.
    [[nodiscard]] double at(double x, double y) const {
        const int x0 = std::min(static_cast<int>(x), size_px_.x - 1);
        const int y0 = std::min(static_cast<int>(y), size_px_.y - 1);
        const double u = x - x0;
        const double v = y - y0;
        const double upper = (1.0 - u) * sum_[index(x0, y0)] + u * sum_[index(x0 + 1, y0)];
        const double lower = (1.0 - u) * sum_[index(x0, y0 + 1)] + u * sum_[index(x0 + 1, y0 + 1)];
        return (1.0 - v) * upper + v * lower;
    }

    glm::ivec2 size_px_;
    std::vector<std::uint32_t> sum_;
};

/// IEC 61966-2-1.
std::uint8_t srgb_code(double light) {
    const double coded = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(coded, 0.0, 1.0)));
}

std::vector<int> whole_numbers(const std::string& text) {
    std::vector<int> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        int number = 0;
        const auto [last, error] = std::from_chars(at, end, number);
        if (error != std::errc()) return {};
        numbers.push_back(number);
        if (last == end) return numbers;
        if (*last != ',') return {};
        at = last + 1;
    }
}

}  // namespace

Expected<MaskCrop> parse_crop(const std::string& text, glm::ivec2 mask_px, glm::ivec2 gaze_px, const Display& display) {
    if (text == "mask") return MaskCrop{glm::ivec2(0), mask_px};
    const auto wrong = [&](const std::string& what) {
        return fail(ErrorCode::option, "--crop " + text + ": " + what + "; the mask has " + std::to_string(mask_px.x) +
                                           " x " + std::to_string(mask_px.y) + " pixels, which --crop mask shows");
    };
    MaskCrop crop;
    if (text == "window") {
        crop = {gaze_px - axis_px(display, kLeftEye), {display.eye_width_px, display.eye_height_px}};
    } else {
        const std::vector<int> numbers = whole_numbers(text);
        if (numbers.size() != 4) return wrong("it must be window, mask, or X,Y,W,H in pixels of the mask");
        crop = {{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
    }
    for (int axis = 0; axis < 2; ++axis) {
        if (crop.begin_px[axis] < 0 || crop.size_px[axis] < 1 ||
            crop.size_px[axis] > mask_px[axis] - crop.begin_px[axis])
            return wrong(text == "window" ? "the mask does not hold the window of display " + display.name
                                          : "it must be a part of the mask");
    }
    return crop;
}

GreyPicture mask_picture(const Mask& mask, const MaskCrop& crop, int width_px) {
    const SampleSums sums(mask, crop);
    const double step = static_cast<double>(crop.size_px.x) / width_px;
    const int height_px = std::max(1, static_cast<int>(std::lround(crop.size_px.y / step)));
    const glm::dvec2 steps(step, static_cast<double>(crop.size_px.y) / height_px);
    GreyPicture picture(width_px, height_px);
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x)
            picture.at(x, y) = srgb_code(sums.mean(steps * glm::dvec2(x, y), steps * glm::dvec2(x + 1, y + 1)));
    }
    return picture;
}

Expected<std::string> panels_svg(std::span<const Panel> panels, double width, const std::string& title) {
    double height = 0.0;
    for (const Panel& panel : panels)
        height = std::max(height, width * panel.picture.height_px / panel.picture.width_px);
    const auto count = static_cast<double>(panels.size());
    SvgWriter svg(count * width + (count + 1.0) * kGap_px, height + kGap_px + 30.0, title);
    glm::dvec2 corner(kGap_px, kGap_px);
    for (const Panel& panel : panels) {
        const auto png = encode_png(panel.picture);
        if (!png) return tl::unexpected(png.error());
        const double panel_height = width * panel.picture.height_px / panel.picture.width_px;
        svg.image(corner, {width, panel_height}, *png);
        svg.text({corner.x + 0.5 * width, kGap_px + height + 19.0}, panel.caption, {.anchor = SvgText::Anchor::middle});
        corner.x += width + kGap_px;
    }
    return svg.finish();
}

GreyPicture panels_picture(std::span<const Panel> panels) {
    int width_px = kGap_px * (static_cast<int>(panels.size()) - 1);
    int height_px = 0;
    for (const Panel& panel : panels) {
        width_px += panel.picture.width_px;
        height_px = std::max(height_px, panel.picture.height_px);
    }
    GreyPicture whole(width_px, height_px, 255);
    int begin = 0;
    for (const Panel& panel : panels) {
        for (int y = 0; y < panel.picture.height_px; ++y)
            std::copy_n(panel.picture.row(y), panel.picture.width_px, whole.row(y) + begin);
        begin += panel.picture.width_px + kGap_px;
    }
    return whole;
}

}  // namespace macula
