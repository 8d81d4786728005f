#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "server/offline/picture_file.h"
#include "server/offline/writer.h"

namespace macula {
namespace {

/// `value(texel)` is a std::array of the file's channels.
template <class Channel, std::size_t kChannels, class Texel, class Value>
Expected<WrittenFile> write(const std::string& layer, const std::string& stem, const Image<Texel>& image,
                            OIIO::ImageSpec spec, Value&& value) {
    std::vector<std::array<Channel, kChannels>> pixels(image.texels.size());
    std::transform(image.texels.begin(), image.texels.end(), pixels.begin(), value);
    WrittenFile file{layer, stem + "_" + layer + ".png"};
    spec.width = image.width_px;
    spec.height = image.height_px;
    auto written = write_picture(file.path, spec, pixels.data());
    if (!written) return tl::unexpected(written.error());
    return file;
}

OIIO::ImageSpec spec_of(int channels, const OIIO::TypeDesc& type) {
    return {0, 0, channels, type};
}

std::array<std::uint8_t, 3> rgb(Rgba8 color) {
    return {static_cast<std::uint8_t>(color), static_cast<std::uint8_t>(color >> 8U),
            static_cast<std::uint8_t>(color >> 16U)};
}

Expected<WrittenFile> write_color(const Layers& layers, const std::string& stem) {
    OIIO::ImageSpec spec = spec_of(3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return write<std::uint8_t, 3>("color", stem, layers.color, spec, rgb);
}

/// Linear, so that a step is the same length everywhere: the greatest depth is 65535, and 0 is nothing hit.
Expected<WrittenFile> write_depth(const Layers& layers, const std::string& stem) {
    double farthest_m = 0.0;
    for (const float depth_m : layers.depth_m.texels)
        if (std::isfinite(depth_m)) farthest_m = std::max(farthest_m, static_cast<double>(depth_m));
    const double m_per_unit = farthest_m > 0.0 ? farthest_m / 65535.0 : 1.0;
    OIIO::ImageSpec spec = spec_of(1, OIIO::TypeDesc::UINT16);
    std::array<char, 96> description{};
    std::snprintf(description.data(), description.size(), "depth along -Z of the view: %.9g m per unit, 0 is nothing",
                  m_per_unit);
    spec.attribute("ImageDescription", description.data());
    auto file = write<std::uint16_t, 1>("depth", stem, layers.depth_m, spec, [m_per_unit](float depth_m) {
        // What lies close to the eye must not turn into nothing.
        const double unit = std::isfinite(depth_m) ? std::max(1.0, std::round(depth_m / m_per_unit)) : 0.0;
        return std::array{static_cast<std::uint16_t>(unit)};
    });
    if (file) file->depth_m_per_unit = m_per_unit;
    return file;
}

Expected<WrittenFile> write_object(const Layers& layers, const std::string& stem) {
    return write<std::uint8_t, 3>("object", stem, layers.object, spec_of(3, OIIO::TypeDesc::UINT8),
                                  [](std::uint32_t id) { return rgb(color_of_object(id)); });
}

Expected<WrittenFile> write_positions(const Layers& layers, const std::string& stem) {
    return write<std::uint8_t, 1>(
        "positions", stem, layers.traced, spec_of(1, OIIO::TypeDesc::UINT8),
        [](std::uint8_t traced) { return std::array{static_cast<std::uint8_t>(traced != 0 ? 255 : 0)}; });
}

Expected<WrittenFile> write_levels(const Layers& layers, const std::string& stem) {
    return write<std::uint8_t, 1>(
        "levels", stem, layers.tile_samples, spec_of(1, OIIO::TypeDesc::UINT8),
        [](std::uint16_t samples) { return std::array{static_cast<std::uint8_t>(std::min<int>(samples, 255))}; });
}

}  // namespace

std::uint32_t color_of_object(std::uint32_t id) {
    // An odd factor permutes the numbers below 2^24, and this one spreads neighbours (Knuth's multiplicative hashing).
    return id * 0x9E3779U & 0xFFFFFFU;
}

Expected<std::vector<WrittenFile>> write_png_layers(const Layers& layers, const LayerChoice& choice,
                                                    const std::string& stem) {
    using Write = Expected<WrittenFile> (*)(const Layers&, const std::string&);
    const std::array<std::pair<bool, Write>, 5> all = {{{choice.color, write_color},
                                                        {choice.depth, write_depth},
                                                        {choice.object, write_object},
                                                        {choice.positions, write_positions},
                                                        {choice.levels, write_levels}}};
    std::vector<WrittenFile> files;
    for (const auto& [wanted, write_layer] : all) {
        if (!wanted) continue;
        auto file = write_layer(layers, stem);
        if (!file) return tl::unexpected(file.error());
        files.push_back(*std::move(file));
    }
    return files;
}

}  // namespace macula
