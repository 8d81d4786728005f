#include "masks/rivals/bit_rows.h"

namespace macula {
namespace {

/// Bits of word `i` of a row that belong to columns first..last - 1.
std::uint64_t part_of(int i, int first, int last) {
    constexpr std::uint64_t kAll = ~std::uint64_t{0};
    std::uint64_t bits = kAll;
    if (first > 64 * i) bits &= first - 64 * i < 64 ? kAll << (first - 64 * i) : 0;
    if (last < 64 * i + 64) bits &= last > 64 * i ? kAll >> (64 * i + 64 - last) : 0;
    return bits;
}

}  // namespace

void BitRows::insert_range(int y, int first, int last) {
    if (first >= last) return;
    const std::span<std::uint64_t> words = row(y);
    for (int i = first / 64; i <= (last - 1) / 64; ++i) words[static_cast<std::size_t>(i)] |= part_of(i, first, last);
}

std::uint32_t BitRows::count_range(int y, int first, int last) const {
    if (first >= last) return 0;
    const std::span<const std::uint64_t> words = row(y);
    int total = 0;
    for (int i = first / 64; i <= (last - 1) / 64; ++i)
        total += std::popcount(words[static_cast<std::size_t>(i)] & part_of(i, first, last));
    return static_cast<std::uint32_t>(total);
}

std::uint32_t BitRows::count() const {
    int total = 0;
    for (const std::uint64_t word : words_) total += std::popcount(word);
    return static_cast<std::uint32_t>(total);
}

BitRows visible_pixels(const Display& display, Eye eye) {
    const std::vector<std::uint8_t> hidden = hidden_pixels(display, eye);
    BitRows visible;
    visible.reset(display.eye_width_px, display.eye_height_px);
    std::size_t i = 0;
    for (int y = 0; y < display.eye_height_px; ++y)
        for (int x = 0; x < display.eye_width_px; ++x)
            if (hidden[i++] == 0) visible.insert(x, y);
    return visible;
}

BitRows all_pixels(int width_px, int height_px) {
    BitRows all;
    all.reset(width_px, height_px);
    for (int y = 0; y < height_px; ++y) all.insert_range(y, 0, width_px);
    return all;
}

}  // namespace macula
