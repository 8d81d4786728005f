#include <algorithm>
#include <array>
#include <charconv>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include <OpenImageIO/imageio.h>

#include "masks/make/mask.h"

namespace macula {
namespace {

constexpr const char* kGazeKey = "macula:gaze";
constexpr const char* kRecipeKey = "macula:recipe";
constexpr int kLeastSide_px = 16;
constexpr int kGreatestSide_px = 16384;
constexpr std::int64_t kGreatestArea_px = std::int64_t{8192} * 8192;  // the mask of the largest display
constexpr std::size_t kGreatestRecipe_bytes = 65536;
constexpr int kRowsAtOnce = 64;
/// Bytes of an image that a byte of its file can hold: deflate packs at most 1032 into one, and the reader makes up to
/// 32 of one where a bit is an index into a palette.
constexpr std::uintmax_t kGreatestRatio = std::uintmax_t{1032} * 32;

/// "X,Y" of a pixel of an image of that size.
std::optional<glm::ivec2> parse_gaze(const std::string& text, glm::ivec2 size_px) {
    glm::ivec2 gaze(-1);
    const char* const end = text.data() + text.size();
    const auto [comma, error_x] = std::from_chars(text.data(), end, gaze.x);
    if (error_x != std::errc() || comma == end || *comma != ',') return std::nullopt;
    const auto [last, error_y] = std::from_chars(comma + 1, end, gaze.y);
    if (error_y != std::errc() || last != end) return std::nullopt;
    const bool inside = gaze.x >= 0 && gaze.y >= 0 && gaze.x < size_px.x && gaze.y < size_px.y;
    return inside ? std::optional(gaze) : std::nullopt;
}

tl::unexpected<Error> wrong(const std::string& what) {
    return fail(ErrorCode::input_file, what);
}

/// That the chunks follow each other to the last one within the file. libpng allocates what a chunk says, and
/// OpenImageIO loses the message of an end of file that comes too early.
Expected<void> check_chunks(const std::string& path) {
    constexpr std::int64_t kSignature_bytes = 8;
    constexpr std::int64_t kAround_bytes = 12;  // length, type and checksum
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::int64_t size = file ? static_cast<std::int64_t>(file.tellg()) : -1;
    if (size < 0 || std::filesystem::is_directory(path)) return wrong("it cannot be opened: is there such a file?");
    std::array<char, 8> head{};  // length and type
    for (std::int64_t at = kSignature_bytes; at + kAround_bytes <= size;) {
        if (!file.seekg(at).read(head.data(), head.size())) return wrong("it cannot be read");
        std::int64_t length = 0;
        for (int i = 0; i < 4; ++i) length = length * 256 + static_cast<std::uint8_t>(head[i]);
        if (length > size - at - kAround_bytes) break;
        if (std::string_view(head.data() + 4, 4) == "IEND") return {};
        at += length + kAround_bytes;
    }
    return wrong("it is no PNG, or a damaged or shortened one");
}

Expected<void> check_shape(const OIIO::ImageSpec& spec, std::uintmax_t file_bytes) {
    const auto [low, high] = std::minmax(spec.width, spec.height);
    const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
    if (low < kLeastSide_px || high > kGreatestSide_px || std::int64_t{low} * high > kGreatestArea_px)
        return wrong("it has " + size + "; a mask has 16 to 16384 a side and at most 67108864 in all");
    if (spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > 4)
        return wrong("it has " + std::to_string(spec.nchannels) + " channels; a mask has 1 to 4");
    // The reader allocates a whole image of some kinds before it decodes any of it.
    if (spec.image_bytes() / kGreatestRatio > file_bytes) return wrong("it is too short to hold " + size);
    return {};
}

/// The colour channels' mean of each pixel, brighter than half or not. Transparent pixels count as black: the reader
/// multiplies colours by alpha.
Expected<std::vector<std::uint8_t>> read_pixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec) {
    const int channels = spec.nchannels;
    const int colors = channels < 3 ? 1 : 3;
    std::vector<std::uint8_t> sampled;
    sampled.reserve(static_cast<std::size_t>(spec.width) * spec.height);
    std::vector<std::uint16_t> rows(static_cast<std::size_t>(spec.width) * channels * kRowsAtOnce);
    for (int y = 0; y < spec.height; y += kRowsAtOnce) {
        const int end = std::min(y + kRowsAtOnce, spec.height);
        if (!input.read_scanlines(0, 0, y, end, 0, 0, channels, OIIO::TypeDesc::UINT16, rows.data()))
            return wrong("it cannot be decoded: " + input.geterror());
        const std::uint16_t* texel = rows.data();
        for (int i = 0; i < spec.width * (end - y); ++i, texel += channels) {
            int sum = 0;
            for (int c = 0; c < colors; ++c) sum += texel[c];
            sampled.push_back(2 * sum > colors * 65535 ? 1 : 0);
        }
    }
    return sampled;
}

Expected<Mask> read(const std::string& path) {
    if (const auto whole = check_chunks(path); !whole) return tl::unexpected(whole.error());
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("png");
    if (!input) return wrong("OpenImageIO has no reader for PNG");
    OIIO::ImageSpec spec;
    if (!input->open(path, spec)) return wrong("it is no PNG: " + input->geterror());
    std::error_code error;
    if (const auto fits = check_shape(spec, std::filesystem::file_size(path, error)); !fits)
        return tl::unexpected(fits.error());

    const glm::ivec2 size_px(spec.width, spec.height);
    Mask mask{size_px.x, size_px.y, size_px / 2, {}, spec.get_string_attribute(kRecipeKey)};
    if (mask.recipe.size() > kGreatestRecipe_bytes) return wrong("its text macula:recipe is longer than 65536 bytes");
    if (spec.find_attribute(kGazeKey) != nullptr) {
        const std::string text(spec.get_string_attribute(kGazeKey));
        const auto gaze_px = parse_gaze(text, size_px);
        if (!gaze_px)
            return wrong("its text macula:gaze is '" + text.substr(0, 40) + "', not X,Y of one of its pixels");
        mask.gaze_px = *gaze_px;
    }
    auto sampled = read_pixels(*input, spec);
    if (!sampled) return tl::unexpected(sampled.error());
    mask.sampled = *std::move(sampled);
    return mask;
}

/// What went wrong; empty if nothing did.
std::string write(const Mask& mask, const std::string& path) {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
    if (!output) return "OpenImageIO has no writer for PNG";
    OIIO::ImageSpec spec(mask.width_px, mask.height_px, 1, OIIO::TypeDesc::UINT8);
    spec.attribute(kGazeKey, std::to_string(mask.gaze_px.x) + "," + std::to_string(mask.gaze_px.y));
    if (!mask.recipe.empty()) spec.attribute(kRecipeKey, mask.recipe);
    std::vector<std::uint8_t> pixels(mask.sampled.size());
    std::transform(mask.sampled.begin(), mask.sampled.end(), pixels.begin(),
                   [](std::uint8_t sampled) { return static_cast<std::uint8_t>(sampled != 0 ? 255 : 0); });
    if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close())
        return output->geterror();
    return {};
}

}  // namespace

Expected<Mask> read_mask_png(const std::string& path) {
    try {
        Expected<Mask> mask = read(path);
        if (!mask) mask.error().message = "mask " + path + ": " + mask.error().message;
        return mask;
    } catch (const std::exception& exception) {
        return wrong("mask " + path + ": it cannot be decoded: " + exception.what());
    }
}

Expected<void> write_mask_png(const Mask& mask, const std::string& path) {
    const std::string partial = path + ".partial";
    std::string problem;
    try {
        problem = write(mask, partial);
    } catch (const std::exception& exception) {
        problem = exception.what();
    }
    std::error_code error;
    if (problem.empty()) {
        std::filesystem::rename(partial, path, error);
        if (!error) return {};
        problem = error.message();
    }
    std::filesystem::remove(partial, error);
    return fail(ErrorCode::output, "mask " + path + ": it cannot be written: " + problem);
}

}  // namespace macula
