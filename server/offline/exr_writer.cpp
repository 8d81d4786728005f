#include <bit>

#include "server/offline/picture_file.h"
#include "server/offline/writer.h"

namespace macula {
namespace {

/// Channels of one file, each of four bytes.
struct Channels {
    std::vector<std::string> name;
    std::vector<OIIO::TypeDesc> type;
    std::vector<std::vector<std::uint32_t>> bits;  ///< per channel, per pixel

    /// `value(texel)` is a float or a 32-bit number.
    template <class Texel, class Value>
    void add(const char* channel, const Image<Texel>& image, Value&& value) {
        using Number = decltype(value(image.texels.front()));
        name.emplace_back(channel);
        type.push_back(OIIO::BaseTypeFromC<Number>::value);
        std::vector<std::uint32_t>& to = bits.emplace_back();
        to.reserve(image.texels.size());
        for (const Texel& texel : image.texels) to.push_back(std::bit_cast<std::uint32_t>(value(texel)));
    }

    /// Pixel by pixel, as OpenImageIO takes channels of several types.
    [[nodiscard]] std::vector<std::uint32_t> packed() const {
        std::vector<std::uint32_t> result(bits.size() * bits.front().size());
        for (std::size_t c = 0; c < bits.size(); ++c)
            for (std::size_t i = 0; i < bits[c].size(); ++i) result[i * bits.size() + c] = bits[c][i];
        return result;
    }
};

Channels chosen_channels(const Layers& layers, const LayerChoice& choice) {
    Channels channels;
    if (choice.color) {
        channels.add("R", layers.radiance, [](const glm::vec3& c) { return c.x; });
        channels.add("G", layers.radiance, [](const glm::vec3& c) { return c.y; });
        channels.add("B", layers.radiance, [](const glm::vec3& c) { return c.z; });
    }
    if (choice.depth) channels.add("Z", layers.depth_m, [](float depth_m) { return depth_m; });
    if (choice.object) channels.add("object", layers.object, [](std::uint32_t id) { return id; });
    if (choice.positions)
        channels.add("positions", layers.traced, [](std::uint8_t traced) { return static_cast<float>(traced); });
    if (choice.levels)
        channels.add("levels", layers.tile_samples, [](std::uint16_t samples) { return static_cast<float>(samples); });
    return channels;
}

}  // namespace

Expected<std::vector<WrittenFile>> write_exr_layers(const Layers& layers, const LayerChoice& choice,
                                                    const std::string& stem, float exposure) {
    const Channels channels = chosen_channels(layers, choice);
    OIIO::ImageSpec spec(layers.color.width_px, layers.color.height_px, static_cast<int>(channels.name.size()),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = channels.name;
    spec.channelformats = channels.type;
    spec.attribute("compression", "zip");
    spec.attribute("macula:exposure", exposure);
    WrittenFile file{"all", stem + ".exr"};
    auto written = write_picture(file.path, spec, channels.packed().data());
    if (!written) return tl::unexpected(written.error());
    return std::vector{file};
}

}  // namespace macula
