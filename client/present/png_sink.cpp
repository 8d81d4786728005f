#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "client/present/picture_sink.h"
#include "protocol/codec/av.h"

namespace macula {
namespace {

/// libavcodec's PNG encoder for pictures of one size.
Expected<AvContext> open_png_encoder(int width_px, int height_px) {
    const AVCodec* codec = avcodec_find_encoder(AV_CODEC_ID_PNG);
    AvContext context = make_quiet_context(codec);
    if (codec == nullptr || !context) return fail(ErrorCode::output, "libavcodec has no PNG encoder");
    context->width = width_px;
    context->height = height_px;
    context->pix_fmt = AV_PIX_FMT_RGB24;
    context->time_base = {1, 1};
    context->compression_level = 1;  // higher levels take a multiple of the time for a few per cent of the size
    if (const int result = avcodec_open2(context.get(), codec, nullptr); result < 0) {
        return fail(ErrorCode::output, "libavcodec's PNG encoder: " + av_error_text(result));
    }
    return context;
}

class PngSink final : public PictureSink {
public:
    PngSink(std::string folder, int every) : folder_(std::move(folder)), every_(every) {}

    Expected<void> show(const ColorImage& picture, std::int64_t /*displayed_ns*/) override {
        const std::uint64_t number = ++shown_;
        if ((number - 1) % static_cast<std::uint64_t>(every_) != 0) return {};
        if (auto encoded = encode(picture); !encoded) return encoded;
        char name[32];
        std::snprintf(name, sizeof name, "frame_%06llu.png", static_cast<unsigned long long>(number));
        const std::filesystem::path path = std::filesystem::path(folder_) / name;
        std::ofstream file(path, std::ios::binary | std::ios::trunc);
        file.write(reinterpret_cast<const char*>(packet_->data), packet_->size);
        file.close();
        if (!file) return fail(ErrorCode::output, path.string() + ": cannot be written; is the disk full?");
        return {};
    }

    Expected<void> close() override { return {}; }
    [[nodiscard]] std::string where() const override { return folder_ + "/frame_*.png"; }

private:
    Expected<void> encode(const ColorImage& picture) {
        if (!context_ || context_->width != picture.width_px || context_->height != picture.height_px) {
            auto context = open_png_encoder(picture.width_px, picture.height_px);
            if (!context) return tl::unexpected(context.error());
            context_ = std::move(*context);
            packet_.reset(av_packet_alloc());
            frame_.reset(av_frame_alloc());
            frame_->format = AV_PIX_FMT_RGB24;
            frame_->width = picture.width_px;
            frame_->height = picture.height_px;
            if (av_frame_get_buffer(frame_.get(), 0) < 0) return fail(ErrorCode::output, "no memory for a PNG picture");
        }
        if (av_frame_make_writable(frame_.get()) < 0) return fail(ErrorCode::output, "no memory for a PNG picture");
        for (int y = 0; y < picture.height_px; ++y) {
            const Rgba8* in = picture.row(y);
            std::uint8_t* out = frame_->data[0] + static_cast<std::ptrdiff_t>(y) * frame_->linesize[0];
            for (int x = 0; x < picture.width_px; ++x) {
                out[3 * x] = static_cast<std::uint8_t>(in[x]);
                out[3 * x + 1] = static_cast<std::uint8_t>(in[x] >> 8);
                out[3 * x + 2] = static_cast<std::uint8_t>(in[x] >> 16);
            }
        }
        av_packet_unref(packet_.get());
        int result = avcodec_send_frame(context_.get(), frame_.get());
        if (result >= 0) result = avcodec_receive_packet(context_.get(), packet_.get());
        if (result < 0) return fail(ErrorCode::output, "libavcodec's PNG encoder: " + av_error_text(result));
        return {};
    }

    std::string folder_;
    int every_;
    std::uint64_t shown_ = 0;
    AvContext context_;
    AvFrame frame_;
    AvPacket packet_;
};

}  // namespace

Expected<std::unique_ptr<PictureSink>> make_png_sink(const std::string& folder, int every) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem) return fail(ErrorCode::output, folder + ": the folder cannot be made: " + problem.message());
    const std::filesystem::path probe = std::filesystem::path(folder) / ".macula-write-test";
    const bool writable = std::ofstream(probe).is_open();
    std::filesystem::remove(probe, problem);
    if (!writable) return fail(ErrorCode::output, folder + ": no file can be written in this folder");
    return std::make_unique<PngSink>(folder, every);
}

}  // namespace macula
