#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "protocol/codec/codec.h"
#include "protocol/codec/depth_codec.h"
#include "tests/support/codec_pictures.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace macula {
namespace {

constexpr int kWidth_px = 96;
constexpr int kHeight_px = 64;
constexpr int kUnits = 4;  // the third is a keyframe again
constexpr std::uint32_t kSeed = 1;

using Input = std::vector<std::uint8_t>;

void append_unit(Input& input, const std::vector<std::uint8_t>& unit) {
    input.push_back(static_cast<std::uint8_t>(unit.size() & 255U));
    input.push_back(static_cast<std::uint8_t>(unit.size() >> 8));
    input.insert(input.end(), unit.begin(), unit.end());
}

Input color_stream() {
    const auto e = make_video_encoder({.width_px = kWidth_px, .height_px = kHeight_px, .bit_rate_bps = 500'000});
    Input input{0};
    for (int i = 0; i < kUnits; ++i) {
        append_unit(input, (*e)->encode(text_picture(kWidth_px, kHeight_px, i), i == 2)->bytes);
    }
    return input;
}

Input depth_stream() {
    const auto e = make_depth_encoder({.width_px = 2 * kWidth_px, .height_px = 2 * kHeight_px});
    Input input{1};
    for (int i = 0; i < kUnits; ++i) {
        append_unit(input, (*e)->encode(room_depth(2 * kWidth_px, 2 * kHeight_px, i), 0.5F, i == 2)->bytes);
    }
    return input;
}

Input mutated(Input input, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1)); };
    for (std::size_t edit = 0; edit < 1 + below(4); ++edit) {
        // Headers are few bytes and decide most; the rest of the units gets the other half.
        const std::size_t at = below(random() % 2 == 0 ? std::min<std::size_t>(input.size(), 80) : input.size());
        switch (random() % 5) {
            case 0:
                input[at] = static_cast<std::uint8_t>(input[at] ^ 1U << random() % 8);
                break;
            case 1:
                input[at] = static_cast<std::uint8_t>(random());
                break;
            case 2:
                input.erase(input.begin() + static_cast<std::ptrdiff_t>(at),
                            input.begin() + static_cast<std::ptrdiff_t>(std::min(input.size(), at + 1 + below(40))));
                break;
            case 3: {
                const Input start_code{0, 0, 1, static_cast<std::uint8_t>(random())};
                input.insert(input.begin() + static_cast<std::ptrdiff_t>(at), start_code.begin(), start_code.end());
                break;
            }
            default: {
                const Input copy(input.begin() + static_cast<std::ptrdiff_t>(at),
                                 input.begin() + static_cast<std::ptrdiff_t>(std::min(input.size(), at + below(200))));
                input.insert(input.begin() + static_cast<std::ptrdiff_t>(below(input.size())), copy.begin(),
                             copy.end());
                break;
            }
        }
        if (input.empty()) return input;
    }
    return input;
}

TEST(VideoFuzz, ValidStreamsAndDegenerateInputsPass) {
    for (const Input& input : {color_stream(), depth_stream(), Input{}, Input{0}, Input{1, 0}, Input{0, 0, 0}}) {
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
}

TEST(VideoFuzz, MutatedStreamsNeverBreakAPromise) {
    std::mt19937 random(kSeed);
    const std::vector<Input> corpus{color_stream(), depth_stream()};
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE("seed " + std::to_string(kSeed) + ", mutation " + std::to_string(i));
        const Input input = mutated(corpus[i % corpus.size()], random);
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
}

}  // namespace
}  // namespace macula
