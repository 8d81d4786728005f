#include "tests/support/pictures.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace macula::test {
namespace {

constexpr int kBlockEdge_px = 8;

int channel(Rgba8 color, int index) {
    return static_cast<int>((color >> (8 * index)) & 255U);
}

}  // namespace

Expected<void> write_png(const std::string& path, const ColorImage& image) {
    const auto output = OIIO::ImageOutput::create(path);
    const OIIO::ImageSpec spec(image.width_px, image.height_px, 4, OIIO::TypeDesc::UINT8);
    if (!output || !output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, image.texels.data()) ||
        !output->close())
        return fail(ErrorCode::output, path + ": " + (output ? output->geterror() : OIIO::geterror()));
    return {};
}

Expected<ColorImage> read_png(const std::string& path) {
    const auto input = OIIO::ImageInput::open(path);
    if (!input) return fail(ErrorCode::input_file, path + ": " + OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels != 4) return fail(ErrorCode::input_file, path + ": expected RGBA");
    ColorImage image(spec.width, spec.height);
    if (!input->read_image(0, 0, 0, 4, OIIO::TypeDesc::UINT8, image.texels.data()))
        return fail(ErrorCode::input_file, path + ": " + input->geterror());
    return image;
}

PictureDifference compare(const ColorImage& a, const ColorImage& b) {
    PictureDifference result;
    result.picture = ColorImage(a.width_px, a.height_px);
    std::array<double, 3> total{};
    for (int y0 = 0; y0 < a.height_px; y0 += kBlockEdge_px) {
        for (int x0 = 0; x0 < a.width_px; x0 += kBlockEdge_px) {
            const int x1 = std::min(x0 + kBlockEdge_px, a.width_px);
            const int y1 = std::min(y0 + kBlockEdge_px, a.height_px);
            for (int c = 0; c < 3; ++c) {
                int sum = 0;
                for (int y = y0; y < y1; ++y) {
                    for (int x = x0; x < x1; ++x) {
                        const int difference = channel(a.at(x, y), c) - channel(b.at(x, y), c);
                        sum += difference;
                        const auto shown = static_cast<Rgba8>(std::min(255, 8 * std::abs(difference)));
                        result.picture.at(x, y) |= shown << (8 * c) | 0xFF000000U;
                    }
                }
                total[static_cast<std::size_t>(c)] += sum;
                const double mean = std::abs(static_cast<double>(sum)) / ((x1 - x0) * (y1 - y0));
                result.largest_local = std::max(result.largest_local, mean);
            }
        }
    }
    for (const double sum : total)
        result.signed_mean = std::max(result.signed_mean, std::abs(sum) / static_cast<double>(a.texels.size()));
    return result;
}

}  // namespace macula::test
