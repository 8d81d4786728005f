#include "client/present/picture_sink.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/codec/av.h"

extern "C" {
#include <libavformat/avformat.h>
}

namespace macula {
namespace {

namespace fs = std::filesystem;

class PictureSinks : public testing::Test {
protected:
    PictureSinks() : folder_(fs::path(testing::TempDir()) / ("macula_sinks_" + name())) { fs::remove_all(folder_); }
    ~PictureSinks() override { fs::remove_all(folder_); }
    static std::string name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

    static ColorImage picture(int number) {
        ColorImage picture(96, 64);
        for (int y = 0; y < picture.height_px; ++y) {
            for (int x = 0; x < picture.width_px; ++x) {
                picture.at(x, y) = 0xFF000000U | static_cast<Rgba8>(2 * x) | static_cast<Rgba8>(3 * y) << 8 |
                                   static_cast<Rgba8>(number * 20) << 16;
            }
        }
        return picture;
    }

    const fs::path folder_;
};

/// Decodes a PNG file with libavcodec.
ColorImage read_png(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    const std::size_t size = bytes.size();
    bytes.resize(size + AV_INPUT_BUFFER_PADDING_SIZE);
    const AVCodec* codec = avcodec_find_decoder(AV_CODEC_ID_PNG);
    const AvContext context = make_quiet_context(codec);
    const AvPacket packet(av_packet_alloc());
    const AvFrame frame(av_frame_alloc());
    packet->data = bytes.data();
    packet->size = static_cast<int>(size);
    if (avcodec_open2(context.get(), codec, nullptr) < 0 || avcodec_send_packet(context.get(), packet.get()) < 0 ||
        avcodec_receive_frame(context.get(), frame.get()) < 0 || frame->format != AV_PIX_FMT_RGB24) {
        return {};
    }
    ColorImage picture(frame->width, frame->height);
    for (int y = 0; y < picture.height_px; ++y) {
        const std::uint8_t* row = frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0];
        for (int x = 0; x < picture.width_px; ++x) {
            picture.at(x, y) = 0xFF000000U | static_cast<Rgba8>(row[3 * x]) | static_cast<Rgba8>(row[3 * x + 1]) << 8 |
                               static_cast<Rgba8>(row[3 * x + 2]) << 16;
        }
    }
    return picture;
}

TEST_F(PictureSinks, PngKeepsEveryBitOfEveryThirdPicture) {
    auto sink = make_png_sink(folder_.string(), 3);
    ASSERT_TRUE(sink) << sink.error().message;
    for (int i = 0; i < 7; ++i) ASSERT_TRUE((*sink)->show(picture(i), i));
    ASSERT_TRUE((*sink)->close());
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) ++files;
    EXPECT_EQ(files, 3U);
    EXPECT_EQ(read_png(folder_ / "frame_000001.png").texels, picture(0).texels);
    EXPECT_EQ(read_png(folder_ / "frame_000007.png").texels, picture(6).texels);
}

TEST_F(PictureSinks, Mp4KeepsTheTimes) {
    fs::create_directories(folder_);
    const std::string path = (folder_ / "v.mp4").string();
    auto sink = make_mp4_sink(path);
    ASSERT_TRUE(sink) << sink.error().message;
    const std::vector<std::int64_t> times_ms = {0, 11, 40, 41, 100, 1000};
    for (std::size_t i = 0; i < times_ms.size(); ++i) {
        ASSERT_TRUE((*sink)->show(picture(static_cast<int>(i)), 7'000'000'000 + times_ms[i] * 1'000'000));
    }
    const auto closed = (*sink)->close();
    ASSERT_TRUE(closed) << closed.error().message;

    AVFormatContext* format = nullptr;
    ASSERT_EQ(avformat_open_input(&format, path.c_str(), nullptr, nullptr), 0);
    ASSERT_EQ(format->nb_streams, 1U);
    EXPECT_EQ(format->streams[0]->codecpar->width, 96);
    EXPECT_EQ(format->streams[0]->codecpar->codec_id, AV_CODEC_ID_H264);
    const AvPacket packet(av_packet_alloc());
    std::size_t count = 0;
    while (av_read_frame(format, packet.get()) == 0) {
        ASSERT_LT(count, times_ms.size());
        const double ms = 1e3 * static_cast<double>(packet->pts) * av_q2d(format->streams[0]->time_base);
        EXPECT_NEAR(ms, static_cast<double>(times_ms[count]), 0.1);
        ++count;
        av_packet_unref(packet.get());
    }
    EXPECT_EQ(count, times_ms.size());
    avformat_close_input(&format);
}

TEST_F(PictureSinks, WhatCannotBeWrittenIsAnOutputError) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "file") << "in the way";
    for (const auto& folder : {(folder_ / "file" / "x").string(), std::string("/proc/macula")}) {
        const auto png = make_png_sink(folder, 1);
        ASSERT_FALSE(png) << folder;
        EXPECT_EQ(png.error().code, ErrorCode::output);
        EXPECT_NE(png.error().message.find(folder), std::string::npos);
    }
    const auto mp4 = make_mp4_sink((folder_ / "missing" / "v.mp4").string());
    ASSERT_FALSE(mp4);
    EXPECT_EQ(mp4.error().code, ErrorCode::output);
    // A folder that goes away, and a disk that is full.
    auto png = make_png_sink((folder_ / "pngs").string(), 1);
    ASSERT_TRUE(png);
    fs::remove_all(folder_ / "pngs");
    const auto shown = (*png)->show(picture(0), 0);
    ASSERT_FALSE(shown);
    EXPECT_EQ(shown.error().code, ErrorCode::output);
    auto full = make_mp4_sink("/dev/full");
    if (full) {
        Expected<void> result = (*full)->show(picture(0), 0);
        if (result) result = (*full)->close();
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::output);
    }
}

TEST_F(PictureSinks, Mp4RefusesAnotherSize) {
    fs::create_directories(folder_);
    auto sink = make_mp4_sink((folder_ / "v.mp4").string());
    ASSERT_TRUE(sink);
    ASSERT_TRUE((*sink)->show(picture(0), 0));
    EXPECT_FALSE((*sink)->show(ColorImage(64, 64), 1));
}

}  // namespace
}  // namespace macula
