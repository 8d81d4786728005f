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

void VisibleArea::cover(const TileGrid& grid, std::vector<Cover>& cover) const {
    const int columns = grid.tiles.x;
    cover.resize(static_cast<std::size_t>(columns) * grid.tiles.y);
    const int first_word = (grid.origin_px.x + kTileEdge_px) / kTileEdge_px;
    const int shift = (grid.origin_px.x + kTileEdge_px) % kTileEdge_px;
    std::vector<std::uint16_t> any(static_cast<std::size_t>(columns));
    std::vector<std::uint16_t> all(static_cast<std::size_t>(columns));
    for (int tile_row = 0; tile_row < grid.tiles.y; ++tile_row) {
        const int top_px = grid.origin_px.y + tile_row * kTileEdge_px;
        const bool cut = top_px < 0 || top_px + kTileEdge_px > height_px_;
        std::fill(any.begin(), any.end(), std::uint16_t{0});
        std::fill(all.begin(), all.end(), static_cast<std::uint16_t>(cut ? 0 : 0xFFFF));
        for (int y = std::max(top_px, 0); y < std::min(top_px + kTileEdge_px, height_px_); ++y) {
            const std::uint16_t* words = row(y) + first_word;
            std::uint16_t* any_out = any.data();
            std::uint16_t* all_out = all.data();
            for (int i = 0; i < columns; ++i) {
                const auto pixels =
                    static_cast<std::uint16_t>(words[i] >> shift | words[i + 1] << (kTileEdge_px - shift));
                any_out[i] |= pixels;
                all_out[i] &= pixels;
            }
        }
        Cover* out = &cover[static_cast<std::size_t>(tile_row) * columns];
        for (int i = 0; i < columns; ++i)
            out[i] = all[i] == 0xFFFF ? Cover::all : any[i] != 0 ? Cover::some : Cover::none;
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
