#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "masks/make/mask.h"

namespace macula {
namespace {

namespace fs = std::filesystem;

class MaskPng : public testing::Test {
protected:
    MaskPng() {
        const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::path(testing::TempDir()) / (std::string("macula_mask_png_") + info->name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~MaskPng() override { fs::remove_all(folder_); }

    [[nodiscard]] std::string path(const std::string& name = "mask.png") const { return (folder_ / name).string(); }

    /// A picture by another program's hand.
    template <class Channel>
    void write_picture(int width, int height, int channels, const std::vector<Channel>& texels,
                       const std::vector<std::pair<std::string, std::string>>& texts = {}) const {
        OIIO::ImageSpec spec(width, height, channels, OIIO::BaseTypeFromC<Channel>::value);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        for (const auto& [key, text] : texts) spec.attribute(key, text);
        const auto output = OIIO::ImageOutput::create("png");
        ASSERT_TRUE(output->open(path(), spec) && output->write_image(spec.format, texels.data()) && output->close())
            << output->geterror();
    }

    void expect_refused(const std::string& file, const std::string& hint) const {
        const auto mask = read_mask_png(file);
        ASSERT_FALSE(mask) << hint;
        EXPECT_EQ(mask.error().code, ErrorCode::input_file);
        EXPECT_NE(mask.error().message.find(file), std::string::npos) << mask.error().message;
        EXPECT_NE(mask.error().message.find(hint), std::string::npos) << mask.error().message;
    }

private:
    fs::path folder_;
};

Mask random_mask(int width, int height, unsigned seed) {
    Mask mask{width, height, {width / 3, height - 1}, {}, R"({"made":"here"})"};
    std::mt19937 random(seed);
    for (int i = 0; i < width * height; ++i) mask.sampled.push_back(random() % 3 == 0 ? 1 : 0);
    return mask;
}

std::vector<char> bytes_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// CRC-32 of PNG chunks (ISO 3309).
std::uint32_t crc_of(const char* begin, const char* end) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char* byte = begin; byte != end; ++byte) {
        crc ^= static_cast<std::uint8_t>(*byte);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1U ^ (0xEDB88320U & (0U - (crc & 1U)));
    }
    return ~crc;
}

/// Gives each chunk the checksum of what it holds now, so that readers look at it.
void repair_checksums(std::vector<char>& png) {
    for (std::size_t at = 8; at + 12 <= png.size();) {
        std::uint32_t length = 0;
        for (int i = 0; i < 4; ++i) length = length << 8U | static_cast<std::uint8_t>(png[at + i]);
        if (length > png.size() - at - 12) return;
        const std::size_t end = at + 8 + length;
        const std::uint32_t crc = crc_of(&png[at + 4], &png[0] + end);
        for (unsigned i = 0; i < 4; ++i) png[end + i] = static_cast<char>(crc >> (24U - 8U * i));
        at = end + 4;
    }
}

TEST_F(MaskPng, ReadsBackWhatWasWritten) {
    for (const auto& [width, height] : {std::pair(16, 16), {37, 150}, {401, 65}}) {
        const Mask mask = random_mask(width, height, 7);
        ASSERT_TRUE(write_mask_png(mask, path()));
        const auto read = read_mask_png(path());
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->width_px, width);
        EXPECT_EQ(read->height_px, height);
        EXPECT_EQ(read->gaze_px, mask.gaze_px);
        EXPECT_EQ(read->sampled, mask.sampled);
        EXPECT_EQ(read->recipe, mask.recipe);
    }
    EXPECT_FALSE(fs::exists(path("mask.png.partial")));
}

TEST_F(MaskPng, TakesAnyPictureAndSamplesWhatIsBrighterThanHalf) {
    for (int channels = 1; channels <= 4; ++channels) {
        const int colors = channels < 3 ? 1 : 3;
        std::vector<std::uint8_t> texels8;
        std::vector<std::uint16_t> texels16;
        for (int i = 0; i < 256; ++i) {
            for (int c = 0; c < channels; ++c) {
                const bool alpha = c == colors;
                texels8.push_back(static_cast<std::uint8_t>(alpha ? 255 : i));
                texels16.push_back(static_cast<std::uint16_t>(alpha ? 65535 : 32768 - 128 + i));
            }
        }
        write_picture(16, 16, channels, texels8);
        const auto mask8 = read_mask_png(path());
        write_picture(16, 16, channels, texels16);
        const auto mask16 = read_mask_png(path());
        ASSERT_TRUE(mask8) << mask8.error().message;
        ASSERT_TRUE(mask16) << mask16.error().message;
        EXPECT_EQ(mask8->gaze_px, glm::ivec2(8, 8));
        EXPECT_TRUE(mask8->recipe.empty());
        for (int i = 0; i < 256; ++i) {
            EXPECT_EQ(mask8->sampled[i], i >= 128 ? 1 : 0) << channels << " channels, 8 bit: " << i;
            EXPECT_EQ(mask16->sampled[i], i >= 128 ? 1 : 0) << channels << " channels, 16 bit: " << i;
        }
    }
}

TEST_F(MaskPng, CountsTheMeanOfColoursAndNothingTransparent) {
    std::vector<std::uint8_t> texels;
    const std::array<std::array<std::uint8_t, 4>, 4> colors = {
        {{255, 255, 0, 255}, {255, 0, 0, 255}, {255, 255, 255, 0}, {255, 255, 255, 255}}};
    for (int i = 0; i < 256; ++i) texels.insert(texels.end(), colors[i % 4].begin(), colors[i % 4].end());
    write_picture(16, 16, 4, texels);
    const Mask mask = read_mask_png(path()).value();
    for (int i = 0; i < 256; ++i) EXPECT_EQ(mask.sampled[i], i % 4 == 0 || i % 4 == 3 ? 1 : 0);
}

TEST_F(MaskPng, TakesTheGazeFromItsText) {
    const std::vector<std::uint8_t> texels(std::size_t{32} * 16, 255);
    write_picture(32, 16, 1, texels, {{"macula:gaze", "31,0"}});
    EXPECT_EQ(read_mask_png(path()).value().gaze_px, glm::ivec2(31, 0));
    for (const char* gaze : {"32,0", "0,16", "-1,0", "4", "4,", "4,x", "4, 5", "4,5,6", "99999999999,0", "middle"}) {
        write_picture(32, 16, 1, texels, {{"macula:gaze", gaze}});
        expect_refused(path(), "macula:gaze");
    }
}

TEST_F(MaskPng, RefusesWhatIsNoMask) {
    expect_refused(path("nothing.png"), "cannot be opened");
    std::ofstream(path("text.png")) << "not a picture";
    expect_refused(path("text.png"), "no PNG");
    std::ofstream(path("text.png")) << std::string(1000, 'x');
    expect_refused(path("text.png"), "no PNG");
    std::ofstream(path("text.png")) << "";
    expect_refused(path("text.png"), "no PNG");
    expect_refused(fs::path(path()).parent_path().string(), "cannot be opened");
    write_picture(15, 64, 1, std::vector<std::uint8_t>(15 * 64, 255));
    expect_refused(path(), "15 x 64");
    write_picture(16385, 16, 1, std::vector<std::uint8_t>(16385 * 16, 255));
    expect_refused(path(), "16385 x 16");
    write_picture(16, 16, 1, std::vector<std::uint8_t>(256, 255), {{"macula:recipe", std::string(70'000, 'x')}});
    expect_refused(path(), "macula:recipe");
}

TEST_F(MaskPng, ThatCannotBeWrittenIsAnErrorAndLeavesNothing) {
    const auto written = write_mask_png(random_mask(16, 16, 1), path("no/folder/mask.png"));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::output);
    EXPECT_NE(written.error().message.find("no/folder/mask.png"), std::string::npos) << written.error().message;
    fs::create_directories(path("taken/inside"));
    EXPECT_FALSE(write_mask_png(random_mask(16, 16, 1), path("taken")));
    EXPECT_FALSE(fs::exists(path("taken.partial")));
}

TEST_F(MaskPng, ThatIsHugeIsReadAndOneThatOnlySaysSoIsNot) {
    constexpr int kWidth = 8192;
    constexpr int kHeight = 2000;
    write_picture(kWidth, kHeight, 1, std::vector<std::uint8_t>(std::size_t{kWidth} * kHeight, 255));
    const auto mask = read_mask_png(path());
    ASSERT_TRUE(mask) << mask.error().message;
    EXPECT_EQ(mask->sampled, std::vector<std::uint8_t>(std::size_t{kWidth} * kHeight, 1));

    write_picture(16, 16, 1, std::vector<std::uint8_t>(256, 255));
    std::vector<char> png = bytes_of(path());
    png[18] = png[22] = 0x20;  // 8192 x 8192 pixels, interlaced
    png[19] = png[23] = 0;
    png[28] = 1;
    repair_checksums(png);
    std::ofstream(path(), std::ios::binary).write(png.data(), static_cast<std::streamsize>(png.size()));
    expect_refused(path(), "too short");
}

TEST_F(MaskPng, ThatIsDamagedIsAMaskOrAnError) {
    constexpr unsigned kSeed = 20261122;
    RecordProperty("seed", static_cast<int>(kSeed));
    std::mt19937 random(kSeed);
    ASSERT_TRUE(write_mask_png(random_mask(40, 24, kSeed), path()));
    const std::vector<char> whole = bytes_of(path());
    testing::internal::CaptureStderr();  // the library complains about each
    int read = 0;
    constexpr int kFiles = 500;
    for (int i = 0; i < kFiles; ++i) {
        std::vector<char> png = whole;
        for (auto edits = 1 + random() % 3; edits > 0; --edits) {
            // Half of the edits go to what says what the picture is: header and texts.
            const std::size_t reach = random() % 2 == 0 ? std::min<std::size_t>(png.size(), 200) : png.size();
            png[random() % reach] = static_cast<char>(random() & 0xFFU);
        }
        if (random() % 8 == 0) png.resize(random() % png.size());
        if (random() % 4 != 0) repair_checksums(png);
        std::ofstream(path(), std::ios::binary).write(png.data(), static_cast<std::streamsize>(png.size()));
        const auto mask = read_mask_png(path());
        if (!mask) {
            ASSERT_EQ(mask.error().code, ErrorCode::input_file);
            continue;
        }
        ++read;
        ASSERT_EQ(mask->sampled.size(), static_cast<std::size_t>(mask->width_px) * mask->height_px);
        ASSERT_LE(*std::max_element(mask->sampled.begin(), mask->sampled.end()), 1);
        ASSERT_TRUE(mask->gaze_px.x >= 0 && mask->gaze_px.x < mask->width_px);
        ASSERT_TRUE(mask->gaze_px.y >= 0 && mask->gaze_px.y < mask->height_px);
    }
    testing::internal::GetCapturedStderr();
    EXPECT_GT(read, kFiles / 50);
    EXPECT_LT(read, kFiles);
}

}  // namespace
}  // namespace macula
