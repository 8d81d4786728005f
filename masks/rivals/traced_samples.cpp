#include "masks/rivals/traced_samples.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "masks/sample_order.h"

namespace macula {
namespace {

constexpr int kBlock = 16;
constexpr std::size_t kBlockArea = std::size_t{kBlock} * kBlock;
constexpr std::uint64_t kBlockBits = 0xFFFF;

struct InBlock {
    std::uint8_t x = 0;
    std::uint8_t y = 0;
};

/// The samples of a block along the Morton curve.
const std::array<InBlock, kBlockArea>& morton_order() {
    static const auto kOrder = [] {
        std::array<InBlock, kBlockArea> order{};
        for (std::uint32_t y = 0; y < kBlock; ++y)
            for (std::uint32_t x = 0; x < kBlock; ++x)
                order[morton(x, y)] = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y)};
        return order;
    }();
    return kOrder;
}

std::uint32_t* write_block(const BitRows& traced, int block_x, int first_y, std::uint32_t first, std::uint32_t* next,
                           const std::array<std::uint32_t, kBlockArea>& from_first) {
    std::array<std::uint32_t, kBlock> rows{};
    std::uint32_t any = 0;
    std::uint32_t all = kBlockBits;
    for (int y = 0; y < kBlock; ++y) {
        const std::uint64_t word =
            first_y + y < traced.height() ? traced.row(first_y + y)[static_cast<std::size_t>(block_x / 4)] : 0;
        rows[static_cast<std::size_t>(y)] = static_cast<std::uint32_t>(word >> kBlock * (block_x % 4) & kBlockBits);
        any |= rows[static_cast<std::size_t>(y)];
        all &= rows[static_cast<std::size_t>(y)];
    }
    if (any == 0) return next;
    if (all == kBlockBits) {
        for (std::size_t i = 0; i < kBlockArea; ++i) next[i] = first + from_first[i];
        return next + kBlockArea;
    }
    const auto& order = morton_order();
    for (std::size_t i = 0; i < kBlockArea; ++i)
        if ((rows[order[i].y] >> order[i].x & 1U) != 0) *next++ = first + from_first[i];
    return next;
}

}  // namespace

void append_samples(const BitRows& traced, std::uint32_t offset, SamplePlan& plan) {
    const auto width = static_cast<std::uint32_t>(traced.width());
    std::array<std::uint32_t, kBlockArea> from_first{};
    for (std::size_t i = 0; i < kBlockArea; ++i) from_first[i] = morton_order()[i].y * width + morton_order()[i].x;
    const std::size_t before = plan.trace_order.size();
    plan.trace_order.resize(before + traced.count());
    std::uint32_t* next = plan.trace_order.data() + before;
    for (int y = 0; y < traced.height(); y += kBlock)
        for (int x = 0; x < traced.width(); x += kBlock)
            next = write_block(traced, x / kBlock, y, offset + static_cast<std::uint32_t>(y) * width + x, next,
                               from_first);

    const auto append_untraced = [&plan](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t address = first; address < last; ++address) plan.untraced.push_back(address);
    };
    for (int y = 0; y < traced.height(); ++y) {
        const std::uint32_t row = offset + static_cast<std::uint32_t>(y) * width;
        std::uint32_t done = 0;
        for_each_run(traced.row(y), [&](int first, int last) {
            append_untraced(row + done, row + static_cast<std::uint32_t>(first));
            done = static_cast<std::uint32_t>(last);
        });
        append_untraced(row + done, row + width);
    }
}

void clear_plan(SamplePlan& plan) {
    plan.trace_order.clear();
    plan.untraced.clear();
    plan.traced_in_window = 0;
    plan.level.clear();
    plan.offset.clear();
    plan.incomplete.clear();
    plan.tiles_x = 0;
    plan.tiles_y = 0;
    plan.mesh.reset();
}

}  // namespace macula
