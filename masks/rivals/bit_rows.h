#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "masks/display.h"

namespace macula {

/// A set of places (x, y), as one bit each: pixels of the window, or samples of a grid.
class BitRows {
public:
    /// Empty, of this size; the memory is reused.
    void reset(int width, int height) {
        width_ = width;
        height_ = height;
        row_words_ = (width + 63) / 64;
        words_.assign(static_cast<std::size_t>(row_words_) * static_cast<std::size_t>(height), 0);
    }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Bit x % 64 of word x / 64; bits beyond the width are 0.
    [[nodiscard]] std::span<std::uint64_t> row(int y) {
        return {words_.data() + static_cast<std::ptrdiff_t>(y) * row_words_, static_cast<std::size_t>(row_words_)};
    }
    [[nodiscard]] std::span<const std::uint64_t> row(int y) const {
        return {words_.data() + static_cast<std::ptrdiff_t>(y) * row_words_, static_cast<std::size_t>(row_words_)};
    }
    /// False for places outside.
    [[nodiscard]] bool has(int x, int y) const {
        if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
        return (words_[static_cast<std::size_t>(y) * row_words_ + x / 64] >> x % 64 & 1U) != 0;
    }
    void insert(int x, int y) {
        words_[static_cast<std::size_t>(y) * row_words_ + x / 64] |= std::uint64_t{1} << x % 64;
    }
    /// Columns first..last - 1 of a row, all inside.
    void insert_range(int y, int first, int last);
    /// Of columns first..last - 1 of a row, all inside.
    [[nodiscard]] std::uint32_t count_range(int y, int first, int last) const;
    [[nodiscard]] std::uint32_t count() const;

private:
    int width_ = 0;
    int height_ = 0;
    int row_words_ = 0;
    std::vector<std::uint64_t> words_;
};

/// Calls use(first, last) for each run first..last - 1 of set bits, in order.
template <class Use>
void for_each_run(std::span<const std::uint64_t> words, Use&& use) {
    int first = -1;  // of a run that goes on
    for (int i = 0; i < static_cast<int>(words.size()); ++i) {
        const std::uint64_t word = words[static_cast<std::size_t>(i)];
        for (int bit = 0; bit < 64;) {
            const std::uint64_t rest = (first < 0 ? word : ~word) >> bit;
            if (rest == 0) break;
            bit += std::countr_zero(rest);
            if (first < 0) {
                first = 64 * i + bit;
            } else {
                use(first, 64 * i + bit);
                first = -1;
            }
        }
    }
    if (first >= 0) use(first, 64 * static_cast<int>(words.size()));
}

/// The pixels of the eye's window that the lens shows.
BitRows visible_pixels(const Display& display, Eye eye);
/// All pixels of a window.
BitRows all_pixels(int width_px, int height_px);

}  // namespace macula
