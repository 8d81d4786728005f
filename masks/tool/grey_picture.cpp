#include "masks/tool/grey_picture.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <glm/geometric.hpp>

namespace macula {
namespace {

/// How much of a pixel lies on one side of a straight line: a function of the distance of the pixel's centre from it,
/// positive on that side. It is the integral of the pixel's extent across the line, which is a trapezium.
class HalfPlaneCover {
public:
    explicit HalfPlaneCover(glm::dvec2 normal) {
        const glm::dvec2 extent = glm::abs(normal);
        wide_ = 0.5 * std::max(extent.x, extent.y);
        narrow_ = 0.5 * std::min(extent.x, extent.y);
    }
    [[nodiscard]] double at(double distance) const {
        if (narrow_ < 1e-6) return std::clamp(0.5 + 0.5 * distance / wide_, 0.0, 1.0);
        const auto ramp = [](double x) { return x > 0.0 ? x * x : 0.0; };
        const double sum = ramp(distance + wide_ + narrow_) - ramp(distance + wide_ - narrow_) -
                           ramp(distance - wide_ + narrow_) + ramp(distance - wide_ - narrow_);
        return std::clamp(sum / (8.0 * wide_ * narrow_), 0.0, 1.0);
    }

private:
    double wide_;
    double narrow_;
};

}  // namespace

void draw_line(GreyPicture& picture, glm::dvec2 from, glm::dvec2 to, double width, std::uint8_t grey) {
    const double length = glm::distance(from, to);
    if (!(length > 0.0)) return;
    const glm::dvec2 along = (to - from) / length;
    const HalfPlaneCover cover(glm::dvec2(along.y, -along.x));
    const double reach = 0.5 * width + 1.0;
    const auto first = [reach](double a, double b) {
        return static_cast<int>(std::max(0.0, std::floor(std::min(a, b) - reach)));
    };
    const auto last = [reach](double a, double b, int size) {
        return static_cast<int>(std::min(size - 1.0, std::floor(std::max(a, b) + reach)));
    };
    for (int y = first(from.y, to.y); y <= last(from.y, to.y, picture.height_px); ++y) {
        // Columns that the line comes near in this row; all of them where it is nearly level.
        double low = std::min(from.x, to.x);
        double high = std::max(from.x, to.x);
        if (std::abs(along.y) > 0.05) {
            const double middle = from.x + (y + 0.5 - from.y) / along.y * along.x;
            const double spread = reach / std::abs(along.y);
            low = std::max(low, middle - spread);
            high = std::min(high, middle + spread);
        }
        for (int x = first(low, high); x <= last(low, high, picture.width_px); ++x) {
            const glm::dvec2 offset = glm::dvec2(x + 0.5, y + 0.5) - from;
            const double across = offset.x * along.y - offset.y * along.x;
            const double beyond = std::abs(glm::dot(offset, along) - 0.5 * length) - 0.5 * length;
            const double covered =
                (cover.at(across + 0.5 * width) - cover.at(across - 0.5 * width)) * std::clamp(0.5 - beyond, 0.0, 1.0);
            std::uint8_t& texel = picture.at(x, y);
            texel = static_cast<std::uint8_t>(std::lround(texel + covered * (1.0 * grey - texel)));
        }
    }
}

Expected<std::vector<std::uint8_t>> encode_png(const GreyPicture& picture) {
    const auto failed = [](const std::string& why) { return fail(ErrorCode::internal, "PNG: " + why); };
    try {
        std::vector<unsigned char> bytes;
        OIIO::Filesystem::IOVecOutput memory(bytes);
        const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
        if (!output || !output->supports("ioproxy")) return failed("OpenImageIO has no writer for PNG in memory");
        OIIO::ImageSpec spec(picture.width_px, picture.height_px, 1, OIIO::TypeDesc::UINT8);
        output->set_ioproxy(&memory);
        if (!output->open("picture.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, picture.texels.data()) ||
            !output->close())
            return failed(output->geterror());
        return bytes;
    } catch (const std::exception& exception) {
        return failed(exception.what());
    }
}

}  // namespace macula
