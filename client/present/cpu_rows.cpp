#include "client/present/cpu_rows.h"

#include <algorithm>
#include <cstring>

namespace macula {
namespace {

using namespace kernels;

constexpr int kChunk = 64;
template <class T>
using Lanes = std::array<T, kChunk>;

/// Where the pixels of a chunk land, and what is loaded from there.
struct Landings {
    alignas(64) Lanes<float> x;
    alignas(64) Lanes<float> y;
    alignas(64) Lanes<std::int32_t> block;
    alignas(64) Lanes<std::int32_t> at;
    alignas(64) Lanes<float> right;
    alignas(64) Lanes<float> lower;
    alignas(64) Lanes<float> depth;
};

/// Loads the depth block of each place.
void load_depth(Landings& to, const EyeDepth& depth, int width, int height) {
    for (int i = 0; i < kChunk; ++i) to.block[i] = depth_block(to.x[i], to.y[i], width, height, depth.stride);
    for (int i = 0; i < kChunk; ++i) to.depth[i] = depth.blocks[to.block[i]];
}

/// The chunks of a row: the last one begins early enough to be whole, and repeats pixels, unless the row is shorter.
template <class Chunk>
void for_chunks(int width, Chunk&& chunk) {
    for (int begin = 0; begin < width; begin += kChunk) chunk(std::max(0, std::min(begin, width - kChunk)));
}

/// Where the pixels of a chunk lie in the view before. `warp_of` gives the warp of each.
template <class WarpOf>
void land_before(const AccumulateRow& row, int begin, WarpOf&& warp_of, const Lanes<float>& depth, Landings& to,
                 Lanes<float>& trust) {
    const TaaWeights weights = row.weights;
    const int width = row.width;
    const int height = row.height;
    const float py = static_cast<float>(row.y) + 0.5F;
    for (int i = 0; i < kChunk; ++i) {
        const Landing landing = land(warp_of(i), static_cast<float>(begin + i) + 0.5F, py, depth[i]);
        to.x[i] = landing.x;
        to.y[i] = landing.y;
    }
    load_depth(to, row.depth_before, width, height);
    for (int i = 0; i < kChunk; ++i) {
        const Landing landing = land(warp_of(i), static_cast<float>(begin + i) + 0.5F, py, depth[i]);
        const Footprint taps = footprint(landing.x, landing.y, width, height);
        trust[i] = row.continues * history_trust(weights, landing, taps, to.depth[i], width, height);
        to.at[i] = taps.y * width + taps.x;
        to.right[i] = taps.right;
        to.lower[i] = taps.lower;
    }
}

/// The same where objects move, each pixel by the warp of what it shows; it is not believed where another surface was
/// seen that would have come from elsewhere.
void land_moved(const AccumulateRow& row, int begin, const Lanes<float>& depth, Landings& to, Lanes<float>& trust) {
    const float py = static_cast<float>(row.y) + 0.5F;
    const ViewWarp* warps = row.now.warps;
    const std::uint8_t* slots_of_row = row.now.blocks + row.y / kBlock_px * row.now.stride;
    alignas(64) Lanes<std::uint8_t> slot;
    alignas(64) Lanes<std::uint8_t> seen;
    int any = 0;
    for (int i = 0; i < kChunk; ++i) slot[i] = slots_of_row[(begin + i) / kBlock_px];
    for (int i = 0; i < kChunk; ++i) any |= slot[i];
    if (any == 0)
        land_before(
            row, begin, [warp = row.warp](int) { return warp; }, depth, to, trust);
    else
        land_before(
            row, begin, [&](int i) { return warps[slot[i]]; }, depth, to, trust);
    for (int i = 0; i < kChunk; ++i) seen[i] = row.before.blocks[to.block[i]];
    int different = 0;
    for (int i = 0; i < kChunk; ++i) different |= seen[i] ^ slot[i];
    if (different == 0) return;
    for (int i = 0; i < kChunk; ++i) {
        if (seen[i] == slot[i]) continue;
        const Landing as_seen = land(warps[seen[i]], static_cast<float>(begin + i) + 0.5F, py, depth[i]);
        trust[i] *= same_place(seen[i], to.x[i], to.y[i], as_seen);
    }
}

}  // namespace

void accumulate_row(const AccumulateRow& row) {
    const TaaWeights weights = row.weights;
    const int width = row.width;
    Landings to;
    alignas(64) Lanes<float> trust;
    alignas(64) std::array<HistoryTexel, 2 * kChunk> upper;
    alignas(64) std::array<HistoryTexel, 2 * kChunk> lower;
    alignas(64) Lanes<float> depth;
    for_chunks(width, [&](int begin) {
        for (int i = 0; i < kChunk; ++i) depth[i] = row.depth[(begin + i) / kBlock_px];
        if (row.moves)
            land_moved(row, begin, depth, to, trust);
        else
            land_before(
                row, begin, [warp = row.warp](int) { return warp; }, depth, to, trust);
        for (int i = 0; i < kChunk; ++i) {
            std::memcpy(&upper[2 * i], row.history + to.at[i], 2 * sizeof(HistoryTexel));
            std::memcpy(&lower[2 * i], row.history + to.at[i] + width, 2 * sizeof(HistoryTexel));
        }
        const Rgba8* __restrict color = row.color + begin;
        const float* __restrict precision = row.precision + begin;
        HistoryTexel* __restrict history_out = row.history_out + begin;
        Rgba8* __restrict color_out = row.color_out + begin;
        for (int i = 0; i < kChunk; ++i) {
            const vec4 history = history_between(
                unpack_history(upper[2 * i].red_green, upper[2 * i].blue_precision),
                unpack_history(upper[2 * i + 1].red_green, upper[2 * i + 1].blue_precision),
                unpack_history(lower[2 * i].red_green, lower[2 * i].blue_precision),
                unpack_history(lower[2 * i + 1].red_green, lower[2 * i + 1].blue_precision), to.right[i], to.lower[i]);
            vec4 now = unpack_color(color[i]);
            now.w = precision[i];
            const vec4 result = accumulate(weights, now, history, trust[i]);
            history_out[i].red_green = pack_red_green(result);
            history_out[i].blue_precision = pack_blue_precision(result);
            color_out[i] = pack_color(result);
        }
    });
}

namespace {

/// Where a pixel of what is shown lies in the frame, among objects that move. `still` is its landing if what is seen
/// there is still, in a block of slot `slot_there`; `depth` is the inverse depth that led to it.
Landing find_moved(const ShowRow& row, float px, float py, const Landing& still, int slot_there, float depth) {
    const auto block_at = [&](const Landing& at) {
        return depth_block(at.x, at.y, row.width, row.height, row.depth.stride);
    };
    const int block_here = depth_block(px, py, row.width, row.height, row.shown.stride);
    const int candidate = row.shown.blocks[block_here];
    if (candidate != 0) {
        const ViewWarp& warp = row.now.warps[candidate];
        Landing moved = land(warp, px, py, row.shown_depth[block_here]);
        const float here = inverse_depth_here(warp, px, py, row.depth.blocks[block_at(moved)]);
        moved = land(warp, px, py, here);
        const bool seen = row.now.blocks[block_at(moved)] == candidate;
        if (seen && in_sight(here, slot_there, inverse_depth_here(row.warp, px, py, depth))) return moved;
    }
    if (slot_there == 0) return still;
    const ViewWarp& warp = row.now.warps[slot_there];
    return land(warp, px, py, inverse_depth_here(warp, px, py, depth));
}

/// Moves on those pixels of a chunk that show a moving object, or showed one in the frame.
void show_moved(const ShowRow& row, int begin, Landings& to, Lanes<float>& visible) {
    const std::uint8_t* shown_of_row = row.shown.blocks + row.y / kBlock_px * row.shown.stride;
    alignas(64) Lanes<std::uint8_t> slot_there;
    alignas(64) Lanes<std::uint8_t> concerned;
    for (int i = 0; i < kChunk; ++i) to.block[i] = depth_block(to.x[i], to.y[i], row.width, row.height, row.now.stride);
    for (int i = 0; i < kChunk; ++i) slot_there[i] = row.now.blocks[to.block[i]];
    int any = 0;
    for (int i = 0; i < kChunk; ++i) concerned[i] = slot_there[i] | shown_of_row[(begin + i) / kBlock_px];
    for (int i = 0; i < kChunk; ++i) any |= concerned[i];
    if (any == 0) return;
    const float py = static_cast<float>(row.y) + 0.5F;
    for (int i = 0; i < kChunk; ++i) {
        if (concerned[i] == 0) continue;
        const float px = static_cast<float>(begin + i) + 0.5F;
        const Landing still = land(row.warp, px, py, inverse_depth_here(row.warp, px, py, to.depth[i]));
        const Landing landing = find_moved(row, px, py, still, slot_there[i], to.depth[i]);
        to.x[i] = landing.x;
        to.y[i] = landing.y;
        visible[i] = inside(landing, row.width, row.height);
    }
}

}  // namespace

void show_row(const ShowRow& row) {
    const ViewWarp warp = row.warp;
    const int width = row.width;
    const int height = row.height;
    const float py = static_cast<float>(row.y) + 0.5F;
    Landings to;
    alignas(64) Lanes<float> visible;
    alignas(64) std::array<Rgba8, 2 * kChunk> upper;
    alignas(64) std::array<Rgba8, 2 * kChunk> lower;
    for_chunks(width, [&](int begin) {
        to.depth = {};
        // Which surface lands here is only known there: look, correct, look again.
        for (int step = 0; step < 3; ++step) {
            for (int i = 0; i < kChunk; ++i) {
                const float px = static_cast<float>(begin + i) + 0.5F;
                const Landing landing = land(warp, px, py, inverse_depth_here(warp, px, py, to.depth[i]));
                to.x[i] = landing.x;
                to.y[i] = landing.y;
                visible[i] = inside(landing, width, height);
            }
            if (step < 2) load_depth(to, row.depth, width, height);
        }
        if (row.moves) show_moved(row, begin, to, visible);
        for (int i = 0; i < kChunk; ++i) {
            const Footprint taps = footprint(to.x[i], to.y[i], width, height);
            to.at[i] = taps.y * row.color.stride + taps.x;
            to.right[i] = taps.right;
            to.lower[i] = taps.lower;
        }
        for (int i = 0; i < kChunk; ++i) {
            std::memcpy(&upper[2 * i], row.color.pixels + to.at[i], 2 * sizeof(Rgba8));
            std::memcpy(&lower[2 * i], row.color.pixels + to.at[i] + row.color.stride, 2 * sizeof(Rgba8));
        }
        const std::uint8_t* __restrict hidden = row.hidden + begin;
        Rgba8* __restrict out = row.out + begin;
        for (int i = 0; i < kChunk; ++i) {
            const vec4 color =
                bilinear(unpack_color(upper[2 * i]), unpack_color(upper[2 * i + 1]), unpack_color(lower[2 * i]),
                         unpack_color(lower[2 * i + 1]), to.right[i], to.lower[i]);
            out[i] = pack_color(color * (hidden[i] != 0 ? 0.0F : visible[i]));
        }
    });
}

}  // namespace macula
