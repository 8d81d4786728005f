#include "client/stream/frame_decoder.h"

#include <algorithm>
#include <utility>

#include "protocol/message/byte_map.h"

namespace macula {

Expected<FrameDecoder> FrameDecoder::make(const std::string& codec, int width_px, int height_px) {
    auto color = make_video_decoder(codec);
    if (!color) return tl::unexpected(color.error());
    auto depth = make_depth_decoder();
    if (!depth) return tl::unexpected(depth.error());
    return FrameDecoder(std::move(*color), std::move(*depth), width_px, height_px);
}

Expected<void> FrameDecoder::decode(ReceivedFrame& frame) {
    Frame& coded = frame.frame;
    const std::uint64_t missing = coded.id - std::exchange(newest_id_, coded.id) - 1;
    if (!coded.keyframe && needs_keyframe_) {
        return fail(ErrorCode::protocol, "frame " + std::to_string(coded.id) + " is not the keyframe that is needed");
    }
    needs_keyframe_ = true;
    if (!coded.keyframe && missing > 0) {
        return fail(ErrorCode::protocol, std::to_string(missing) + " frames are missing before frame " +
                                             std::to_string(coded.id) + "; a keyframe is needed");
    }
    if (auto color = color_->decode(coded.color, frame.color); !color) return color;
    if (auto depth = depth_->decode(coded.depth, coded.near_m, frame.depth); !depth) return depth;
    if (frame.color.width_px != width_px_ || frame.color.height_px != height_px_ ||
        frame.depth.width_px != width_px_ / 4 || frame.depth.height_px != height_px_ / 4) {
        return fail(ErrorCode::protocol, "a picture of " + std::to_string(frame.color.width_px) + "x" +
                                             std::to_string(frame.color.height_px) + " came where " +
                                             std::to_string(width_px_) + "x" + std::to_string(height_px_) +
                                             " was asked for");
    }
    if (auto moving_map = decode_moving_map(frame); !moving_map) return moving_map;
    needs_keyframe_ = false;
    coded.color.clear();
    coded.depth.clear();
    coded.moving_map.clear();
    return {};
}

Expected<void> FrameDecoder::decode_moving_map(ReceivedFrame& frame) const {
    frame.moving_map = {};
    if (frame.frame.moving.empty()) return {};
    auto map = unpack_map(frame.frame.moving_map, frame.depth.texels.size());
    if (!map) return fail(ErrorCode::protocol, "Frame.moving_map: " + map.error().message);
    const int largest = *std::ranges::max_element(*map);
    if (static_cast<std::size_t>(largest) > frame.frame.moving.size()) {
        return fail(ErrorCode::protocol, "Frame.moving_map: names object " + std::to_string(largest) + " of " +
                                             std::to_string(frame.frame.moving.size()));
    }
    frame.moving_map.width_px = frame.depth.width_px;
    frame.moving_map.height_px = frame.depth.height_px;
    frame.moving_map.texels = std::move(*map);
    return {};
}

}  // namespace macula
