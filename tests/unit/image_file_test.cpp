// Picture files: formats, types, channels, sizes, and files that are not what they say.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "scenes/image_file.h"
#include "scenes/texel.h"
#include "tests/support/encoded_image.h"

namespace macula {
namespace {

using Bytes = std::vector<std::uint8_t>;
using glm::vec4;

constexpr std::size_t kSide = 1024;
constexpr std::size_t kTexels = 1U << 20U;

TEST(ImageFile, IntegersStayAsSmallAsTheyAre) {
    struct Case {
        const char* what;
        Bytes file;
        int channels;
        TexelType type;
        vec4 first;
    };
    const Case cases[] = {
        {"grey", encode_image("png", 2, 1, 1, {7, 200}), 1, TexelType::u8, vec4(7, 7, 7, 255)},
        {"grey and alpha", encode_image("png", 2, 1, 2, {7, 100, 200, 0}), 2, TexelType::u8, vec4(7, 7, 7, 100)},
        {"RGB", encode_image("png", 2, 1, 3, {1, 2, 3, 4, 5, 6}), 3, TexelType::u8, vec4(1, 2, 3, 255)},
        {"RGBA", encode_image("png", 2, 1, 4, {1, 2, 3, 4, 5, 6, 7, 0}), 4, TexelType::u8, vec4(1, 2, 3, 4)},
        {"16 bit", encode_image("png", 2, 1, 3, {1, 2, 3, 4, 5, 6}, 16), 3, TexelType::u16, vec4(1, 2, 3, 255)},
        {"16-bit grey", encode_image("png", 2, 1, 1, {9, 200}, 16), 1, TexelType::u16, vec4(9, 9, 9, 255)},
        {"JPEG", encode_image("jpeg", 8, 8, 3, Bytes(192, 90)), 3, TexelType::u8, vec4(90, 90, 90, 255)},
        {"WebP", encode_image("webp", 8, 8, 3, Bytes(192, 90)), 3, TexelType::u8, vec4(90, 90, 90, 255)},
    };
    for (const Case& c : cases) {
        const Expected<TextureImage> image = decode_image(c.file, kSide, kTexels);
        ASSERT_TRUE(image) << c.what << ": " << image.error().message;
        EXPECT_EQ(image->channels, c.channels) << c.what;
        EXPECT_EQ(image->type, c.type) << c.what;
        EXPECT_FALSE(image->srgb);
        EXPECT_EQ(image->texels.size(), image->texel_count() * image->texel_bytes()) << c.what;
        const bool lossy = c.file[0] == 0xFF || c.file[0] == 'R';
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(stored_texel(*image, 0)[i] * 255.0F, c.first[i], lossy ? 3.0F : 1e-3F) << c.what;
    }
}

TEST(ImageFile, WebPKeepsColoursUnderAlpha) {
    Bytes values;
    for (int i = 0; i < 256; ++i)
        for (const int v : {120, 60, 30, i < 128 ? 128 : 255}) values.push_back(static_cast<std::uint8_t>(v));
    const Expected<TextureImage> image = decode_image(encode_image("webp", 16, 16, 4, values), kSide, kTexels);
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->channels, 4);
    // What OpenImageIO writes is not straight either: only the relation of the two halves' alphas is sure, and that a
    // colour is not darkened by its alpha.
    const vec4 half = stored_texel(*image, 20) * 255.0F;
    const vec4 whole = stored_texel(*image, 200) * 255.0F;
    EXPECT_NEAR(half.w, 128.0F, 2.0F);
    EXPECT_NEAR(whole.w, 255.0F, 2.0F);
    EXPECT_NEAR(whole.x, 120.0F, 6.0F);
    EXPECT_GE(half.x, 110.0F);
}

/// A map of half or float values.
Bytes encode_float_image(const char* format, int channels, const std::vector<float>& values, bool half) {
    return encode_radiance(format, 2, 2, channels, values, half);
}

TEST(ImageFile, EnvironmentsKeepTheirTypeAndLoseTheirAlpha) {
    const std::vector<float> rgba = {0.5F, 1.0F, 2.0F, 0.0F, 100.0F, 3.0F, 4.0F, 0.5F,
                                     0.0F, 0.0F, 0.0F, 1.0F, 1.0F,   1.0F, 1.0F, 1.0F};
    const Expected<TextureImage> half =
        decode_environment(encode_float_image("openexr", 4, rgba, true), kSide, kTexels);
    ASSERT_TRUE(half) << half.error().message;
    EXPECT_EQ(half->type, TexelType::f16);
    EXPECT_EQ(half->channels, 3);
    EXPECT_EQ(stored_texel(*half, 0), vec4(0.5F, 1.0F, 2.0F, 1.0F));
    EXPECT_EQ(stored_texel(*half, 1).x, 100.0F);
    const Expected<TextureImage> full =
        decode_environment(encode_float_image("openexr", 4, rgba, false), kSide, kTexels);
    ASSERT_TRUE(full) << full.error().message;
    EXPECT_EQ(full->type, TexelType::f32);
    const std::vector<float> rgb = {0.5F, 1.0F, 2.0F, 100.0F, 3.0F, 4.0F, 0.0F, 0.0F, 0.0F, 1.0F, 1.0F, 1.0F};
    const Expected<TextureImage> hdr = decode_environment(encode_float_image("hdr", 3, rgb, false), kSide, kTexels);
    ASSERT_TRUE(hdr) << hdr.error().message;
    EXPECT_EQ(hdr->channels, 3);
    EXPECT_NEAR(stored_texel(*hdr, 1).x, 100.0F, 0.5F);
}

TEST(ImageFile, RadianceThatNoLightHasIsRepaired) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> rgb = {-1.0F, nan, inf, -inf, 2.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F};
    for (const bool half : {true, false}) {
        const Expected<TextureImage> image =
            decode_environment(encode_float_image("openexr", 3, rgb, half), kSide, kTexels);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(stored_texel(*image, 0), vec4(0.0F, 0.0F, half ? 65504.0F : kGreatestRadiance, 1.0F));
        EXPECT_EQ(stored_texel(*image, 1), vec4(0.0F, 2.0F, 0.0F, 1.0F));
    }
}

TEST(ImageFile, CutOffFilesAreRefused) {
    const std::vector<float> values(12, 0.3F);
    const Bytes files[] = {encode_image("png", 8, 8, 3, Bytes(192, 90)), encode_image("jpeg", 8, 8, 3, Bytes(192, 90)),
                           encode_image("webp", 8, 8, 3, Bytes(192, 90))};
    for (const Bytes& file : files)
        for (const std::size_t length : {file.size() / 2, file.size() - 4, std::size_t{14}})
            EXPECT_FALSE(decode_image(std::span(file).first(length), kSide, kTexels)) << file[0] << ' ' << length;
    for (const Bytes& file :
         {encode_float_image("openexr", 3, values, true), encode_float_image("hdr", 3, values, false)})
        for (const std::size_t length : {file.size() / 2, file.size() - 4, std::size_t{12}})
            EXPECT_FALSE(decode_environment(std::span(file).first(length), kSide, kTexels)) << file[0] << ' ' << length;
}

TEST(ImageFile, WhatIsTooLargeIsRefusedBeforeItIsDecoded) {
    for (const char* format : {"png", "jpeg", "webp"}) {
        const Bytes file = encode_image(format, 32, 16, 3, Bytes(32 * 16 * 3, 90));
        EXPECT_TRUE(decode_image(file, 32, 512)) << format;
        const auto side = decode_image(file, 31, 512);
        ASSERT_FALSE(side);
        EXPECT_EQ(side.error().message, "it is too large: 32 x 16 pixels");
        EXPECT_FALSE(decode_image(file, 32, 511)) << format;
    }
}

TEST(ImageFile, EachReaderTakesItsOwnFormats) {
    const Bytes exr = encode_float_image("openexr", 3, std::vector<float>(12, 1.0F), true);
    EXPECT_EQ(decode_image(exr, kSide, kTexels).error().message, "it is neither PNG nor JPEG nor WebP");
    const Bytes png = encode_image("png", 2, 1, 1, {7, 200});
    EXPECT_EQ(decode_environment(png, kSide, kTexels).error().message, "it is neither HDR nor EXR");
    EXPECT_FALSE(decode_image(Bytes(), kSide, kTexels));
}

TEST(ImageFile, EnvironmentFilesAreNamedInMessages) {
    const auto missing = load_environment("/nowhere/sky.hdr");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::input_file);
    EXPECT_EQ(missing.error().message.rfind("cannot open /nowhere/sky.hdr", 0), 0U) << missing.error().message;
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "macula_image_file_test.hdr";
    const auto write = [&file](const Bytes& bytes) {
        std::ofstream(file, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    };
    write({'n', 'o'});
    EXPECT_EQ(load_environment(file).error().message, file.string() + ": it is neither HDR nor EXR");
    write(encode_float_image("hdr", 3, std::vector<float>(12, 1.0F), false));
    const auto image = load_environment(file);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->name, file.string());
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace macula
