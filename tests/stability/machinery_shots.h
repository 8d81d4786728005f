#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "client/present/compositor.h"
#include "client/stream/frame_decoder.h"
#include "masks/display.h"
#include "masks/rank_tile.h"
#include "protocol/base/image.h"
#include "server/service/frame_maker.h"

namespace macula::test {

/// A frame of a moving head as the server makes it, and what it should have shown.
struct Shot {
    Picture picture;       ///< foveated, before coding; its times are those of a 90 Hz display
    ColorImage reference;  ///< every visible pixel traced; both eyes side by side
};

/// Shots that the cases of codecs and clients share: Bunny Box on a small `vive`, 18 % of the pixels traced, while the
/// head sways by up to 25 deg/s.
struct Shots {
    Display display;
    std::shared_ptr<const RankTile> rank_tile;
    std::vector<Shot> shot;
    std::vector<std::uint8_t> hidden;  ///< 1 for each pixel of both eyes that the lens never shows, row-major
    [[nodiscard]] int width_px() const { return kEyeCount * display.eye_width_px; }
    [[nodiscard]] int height_px() const { return display.eye_height_px; }
};

inline constexpr int kShots = 56;

/// Made at the first call.
const Shots& bunny_box_shots();

/// A bit rate for a small display: the server's default for `vive`, in proportion to the edges. A picture of the same
/// field with fewer pixels holds more detail in each, so that in proportion to the pixels it would starve.
std::int64_t fair_bit_rate_bps(const Display& display);

/// A frame as the compositor takes it; refers to all that is passed in.
NewFrame new_frame(const ReceivedFrame& received, const RankTile& rank_tile, bool continues);

/// PSNR over pixels that the lens shows, decibels; 99 for equal pictures.
double visible_psnr_db(const ColorImage& shown, const ColorImage& reference, const std::vector<std::uint8_t>& hidden);

}  // namespace macula::test
