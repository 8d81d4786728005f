#pragma once

#include <cstdint>
#include <mutex>

namespace macula {

/// Whether the next frame must be a keyframe. A client reports every frame that it cannot decode, and while the
/// keyframe that it asked for is on its way those are all frames that were sent before; that keyframe answers them too.
/// All members may be called from any thread.
class KeyframeWish {
public:
    /// The client could not decode this frame.
    void failed(std::uint64_t frame_id) {
        const std::lock_guard lock(mutex_);
        if (!coding_ && frame_id >= newest_keyframe_) wanted_ = true;
    }

    /// A frame goes into the encoder: whether it is to be a keyframe. True for the first.
    bool begin() {
        const std::lock_guard lock(mutex_);
        coding_ = wanted_;
        wanted_ = false;
        return coding_;
    }

    /// That frame came out of the encoder and has this id.
    void coded(std::uint64_t frame_id) {
        const std::lock_guard lock(mutex_);
        if (coding_) newest_keyframe_ = frame_id;
        coding_ = false;
    }

private:
    std::mutex mutex_;
    bool wanted_ = true;
    bool coding_ = false;  ///< one is between begin() and coded()
    std::uint64_t newest_keyframe_ = 0;
};

}  // namespace macula
