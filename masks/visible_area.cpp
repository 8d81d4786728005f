#include "masks/visible_area.h"

#include <algorithm>

namespace macula {

VisibleArea::VisibleArea(const Display& display, Eye eye)
    : height_px_(display.eye_height_px),
      row_words_((display.eye_width_px + kTileEdge_px - 1) / kTileEdge_px + 3),
      words_(static_cast<std::size_t>(height_px_) * row_words_) {
    const std::vector<std::uint8_t> hidden = hidden_pixels(display, eye);
    for (int y = 0; y < height_px_; ++y) {
        for (int x = 0; x < display.eye_width_px; ++x) {
            if (hidden[static_cast<std::size_t>(y) * display.eye_width_px + x] != 0) continue;
            words_[static_cast<std::size_t>(y) * row_words_ + x / kTileEdge_px + 1] |=
                static_cast<std::uint16_t>(1U << x % kTileEdge_px);
        }
    }
}

void VisibleArea::cover_row(const TileGrid& grid, int tile_row, std::vector<std::uint16_t>& any,
                            std::vector<std::uint16_t>& all) const {
    const int columns = grid.tiles.x;
    any.assign(static_cast<std::size_t>(columns), 0);
    all.assign(static_cast<std::size_t>(columns), 0xFFFF);
    const int first_word = (grid.origin_px.x + kTileEdge_px) / kTileEdge_px;
    const int shift = (grid.origin_px.x + kTileEdge_px) % kTileEdge_px;
    const int top_px = grid.origin_px.y + tile_row * kTileEdge_px;
    for (int y = top_px; y < top_px + kTileEdge_px; ++y) {
        if (y < 0 || y >= height_px_) {
            std::fill(all.begin(), all.end(), std::uint16_t{0});
            continue;
        }
        const std::uint16_t* words = row(y) + first_word;
        std::uint16_t* any_out = any.data();
        std::uint16_t* all_out = all.data();
        for (int i = 0; i < columns; ++i) {
            const auto pixels = static_cast<std::uint16_t>(words[i] >> shift | words[i + 1] << (kTileEdge_px - shift));
            any_out[i] |= pixels;
            all_out[i] &= pixels;
        }
    }
}

TilePixels VisibleArea::tile(int x_px, int y_px) const {
    const int word = (x_px + kTileEdge_px) / kTileEdge_px;
    const int shift = (x_px + kTileEdge_px) % kTileEdge_px;
    TilePixels pixels{};
    for (int y = std::max(0, -y_px); y < std::min(kTileEdge_px, height_px_ - y_px); ++y) {
        const std::uint16_t* words = row(y_px + y) + word;
        pixels[y] = static_cast<std::uint16_t>(words[0] >> shift | words[1] << (kTileEdge_px - shift));
    }
    return pixels;
}

}  // namespace macula
