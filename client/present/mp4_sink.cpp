#include <algorithm>
#include <optional>
#include <utility>

#include "client/present/picture_sink.h"
#include "protocol/codec/av.h"
#include "protocol/codec/color_convert.h"

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

namespace macula {
namespace {

constexpr AVRational kClock = {1, 90'000};
constexpr std::int64_t kTick_ns = 1'000'000'000 / 90'000;

struct FormatDeleter {
    void operator()(AVFormatContext* format) const {
        if (format->pb != nullptr) avio_closep(&format->pb);
        avformat_free_context(format);
    }
};
using Format = std::unique_ptr<AVFormatContext, FormatDeleter>;

class Mp4Sink final : public PictureSink {
public:
    Mp4Sink(std::string path, Format format) : path_(std::move(path)), format_(std::move(format)) {}
    ~Mp4Sink() override { static_cast<void>(Mp4Sink::close()); }

    Expected<void> show(const ColorImage& picture, std::int64_t displayed_ns) override {
        if (!encoder_) {
            if (auto begun = begin(picture.width_px, picture.height_px); !begun) return begun;
            first_ns_ = displayed_ns;
        }
        if (picture.width_px != encoder_->width || picture.height_px != encoder_->height) {
            return fail(ErrorCode::output, path_ + ": the pictures changed their size");
        }
        if (av_frame_make_writable(frame_.get()) < 0) return problem("no memory", AVERROR(ENOMEM));
        yuv420_from_rgba(picture, {frame_->data[0], frame_->data[1], frame_->data[2], frame_->linesize[0],
                                   frame_->linesize[1], frame_->linesize[2]});
        const std::int64_t last_pts = frame_->pts;
        frame_->pts = std::max((displayed_ns - first_ns_) / kTick_ns, shown_ == 0 ? 0 : last_pts + 1);
        if (shown_ > 0) duration_ = frame_->pts - last_pts;
        ++shown_;
        if (const int result = avcodec_send_frame(encoder_.get(), frame_.get()); result < 0) {
            return problem("encoding", result);
        }
        return write_packets();
    }

    Expected<void> close() override {
        if (!format_) return {};
        Expected<void> result;
        if (encoder_) {
            avcodec_send_frame(encoder_.get(), nullptr);
            result = write_packets();
            const int trailer = av_write_trailer(format_.get());
            if (result && trailer < 0) result = problem("the end of the file", trailer);
        }
        const int closed = avio_closep(&format_->pb);
        if (result && closed < 0) result = problem("closing", closed);
        format_.reset();
        return result;
    }

    [[nodiscard]] std::string where() const override { return path_; }

private:
    Expected<void> begin(int width_px, int height_px) {
        const AVCodec* codec = avcodec_find_encoder_by_name("libx264");
        AvContext encoder = make_quiet_context(codec);
        if (codec == nullptr || !encoder) return problem("libavcodec has no libx264", AVERROR_ENCODER_NOT_FOUND);
        encoder->width = width_px;
        encoder->height = height_px;
        encoder->pix_fmt = AV_PIX_FMT_YUV420P;
        encoder->color_range = AVCOL_RANGE_MPEG;
        encoder->colorspace = AVCOL_SPC_BT709;
        encoder->color_primaries = AVCOL_PRI_BT709;
        encoder->color_trc = AVCOL_TRC_IEC61966_2_1;
        encoder->time_base = kClock;
        encoder->gop_size = 120;
        encoder->max_b_frames = 0;
        encoder->thread_count = 1;  // the cores are busy with the session
        if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        av_opt_set(encoder->priv_data, "preset", "ultrafast", 0);
        av_opt_set(encoder->priv_data, "crf", "20", 0);
        if (const int result = avcodec_open2(encoder.get(), codec, nullptr); result < 0) {
            return problem("libx264", result);
        }
        AVStream* stream = avformat_new_stream(format_.get(), nullptr);
        if (stream == nullptr) return problem("no memory", AVERROR(ENOMEM));
        stream->time_base = kClock;
        if (const int result = avcodec_parameters_from_context(stream->codecpar, encoder.get()); result < 0) {
            return problem("the stream's parameters", result);
        }
        if (const int result = avformat_write_header(format_.get(), nullptr); result < 0) {
            return problem("the file's header", result);
        }
        frame_.reset(av_frame_alloc());
        packet_.reset(av_packet_alloc());
        frame_->format = AV_PIX_FMT_YUV420P;
        frame_->width = width_px;
        frame_->height = height_px;
        frame_->pts = 0;
        if (const int result = av_frame_get_buffer(frame_.get(), 0); result < 0) return problem("no memory", result);
        encoder_ = std::move(encoder);
        return {};
    }

    Expected<void> write_packets() {
        while (true) {
            const int received = avcodec_receive_packet(encoder_.get(), packet_.get());
            if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return {};
            if (received < 0) return problem("encoding", received);
            packet_->duration = duration_;
            av_packet_rescale_ts(packet_.get(), kClock, format_->streams[0]->time_base);
            packet_->stream_index = 0;
            const int written = av_interleaved_write_frame(format_.get(), packet_.get());
            if (written < 0) return problem("writing; is the disk full?", written);
        }
    }

    [[nodiscard]] Expected<void> problem(const std::string& what, int result) const {
        return fail(ErrorCode::output, path_ + ": " + what + ": " + av_error_text(result));
    }

    std::string path_;
    Format format_;
    AvContext encoder_;
    AvFrame frame_;
    AvPacket packet_;
    std::int64_t first_ns_ = 0;
    std::int64_t duration_ = 90'000 / 30;  ///< of the last picture, in kClock: as long as the one before
    std::uint64_t shown_ = 0;
};

}  // namespace

Expected<std::unique_ptr<PictureSink>> make_mp4_sink(const std::string& path) {
    AVFormatContext* allocated = nullptr;
    if (avformat_alloc_output_context2(&allocated, nullptr, "mp4", path.c_str()) < 0) {
        return fail(ErrorCode::output, path + ": libavformat cannot write MP4");
    }
    Format format(allocated);
    // A name like "http:..." is a protocol to libavformat; here it is a file.
    const std::string url = "file:" + path;
    if (const int result = avio_open(&format->pb, url.c_str(), AVIO_FLAG_WRITE); result < 0) {
        return fail(ErrorCode::output, path + ": the video cannot be written: " + av_error_text(result));
    }
    return std::make_unique<Mp4Sink>(path, std::move(format));
}

}  // namespace macula
