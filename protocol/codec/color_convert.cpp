#include "protocol/codec/color_convert.h"

#include <algorithm>

namespace macula {
namespace {

// BT.709 (ITU-R BT.709-6, item 3.2) and its limited range (item 4.6), in steps of 2^-16. The loops are this plain so
// that the compiler vectorises them: libswscale takes eight times as long for the way there.
constexpr double kRed = 0.2126;
constexpr double kBlue = 0.0722;
constexpr double kGreen = 1.0 - kRed - kBlue;
constexpr double kLumaRange = 219.0 / 255.0;
constexpr double kChromaRange = 224.0 / 255.0;

constexpr int fixed(double x) {
    return static_cast<int>(x * 65536.0 + (x < 0.0 ? -0.5 : 0.5));
}
constexpr int kHalf = 1 << 15;

constexpr int kYFromR = fixed(kLumaRange * kRed);
constexpr int kYFromG = fixed(kLumaRange * kGreen);
constexpr int kYFromB = fixed(kLumaRange * kBlue);
constexpr int kUFromR = fixed(-kChromaRange * 0.5 * kRed / (1.0 - kBlue));
constexpr int kUFromB = fixed(kChromaRange * 0.5);
constexpr int kUFromG = -kUFromR - kUFromB;  // greys have no chroma, exactly
constexpr int kVFromR = fixed(kChromaRange * 0.5);
constexpr int kVFromB = fixed(-kChromaRange * 0.5 * kBlue / (1.0 - kRed));
constexpr int kVFromG = -kVFromR - kVFromB;

constexpr int kRgbFromY = fixed(1.0 / kLumaRange);
constexpr int kRFromV = fixed(2.0 * (1.0 - kRed) / kChromaRange);
constexpr int kGFromU = fixed(-2.0 * (1.0 - kBlue) * kBlue / kGreen / kChromaRange);
constexpr int kGFromV = fixed(-2.0 * (1.0 - kRed) * kRed / kGreen / kChromaRange);
constexpr int kBFromU = fixed(2.0 * (1.0 - kBlue) / kChromaRange);

void luma_row(const Rgba8* rgba, int width, std::uint8_t* y) {
    for (int x = 0; x < width; ++x) {
        const int r = static_cast<int>(rgba[x] & 255U);
        const int g = static_cast<int>(rgba[x] >> 8 & 255U);
        const int b = static_cast<int>(rgba[x] >> 16 & 255U);
        y[x] = static_cast<std::uint8_t>((kYFromR * r + kYFromG * g + kYFromB * b + (16 << 16) + kHalf) >> 16);
    }
}

void chroma_row(const Rgba8* above, const Rgba8* below, int width, std::uint8_t* u, std::uint8_t* v) {
    constexpr Rgba8 kRedBlue = 0xff00ffU;
    constexpr int kZero = (128 << 18) + (1 << 17);  // sums of four pixels: two more bits
    for (int x = 0; x < width; ++x) {
        const Rgba8 p00 = above[2 * x];
        const Rgba8 p10 = above[2 * x + 1];
        const Rgba8 p01 = below[2 * x];
        const Rgba8 p11 = below[2 * x + 1];
        const Rgba8 red_blue = (p00 & kRedBlue) + (p10 & kRedBlue) + (p01 & kRedBlue) + (p11 & kRedBlue);
        const int r = static_cast<int>(red_blue & 0xffffU);
        const int b = static_cast<int>(red_blue >> 16);
        const int g = static_cast<int>((p00 >> 8 & 255U) + (p10 >> 8 & 255U) + (p01 >> 8 & 255U) + (p11 >> 8 & 255U));
        u[x] = static_cast<std::uint8_t>((kUFromR * r + kUFromG * g + kUFromB * b + kZero) >> 18);
        v[x] = static_cast<std::uint8_t>((kVFromR * r + kVFromG * g + kVFromB * b + kZero) >> 18);
    }
}

Rgba8 byte(int fixed_point) {
    return static_cast<Rgba8>(std::clamp(fixed_point >> 16, 0, 255));
}

void rgba_row(const std::uint8_t* y, const std::uint8_t* u, const std::uint8_t* v, int chroma_width, Rgba8* rgba) {
    for (int x = 0; x < chroma_width; ++x) {
        const int cb = u[x] - 128;
        const int cr = v[x] - 128;
        const int r = kRFromV * cr + kHalf;
        const int g = kGFromU * cb + kGFromV * cr + kHalf;
        const int b = kBFromU * cb + kHalf;
        const int y0 = kRgbFromY * (y[2 * x] - 16);
        const int y1 = kRgbFromY * (y[2 * x + 1] - 16);
        rgba[2 * x] = byte(y0 + r) | byte(y0 + g) << 8 | byte(y0 + b) << 16 | 0xff000000U;
        rgba[2 * x + 1] = byte(y1 + r) | byte(y1 + g) << 8 | byte(y1 + b) << 16 | 0xff000000U;
    }
}

}  // namespace

void yuv420_from_rgba(const ColorImage& picture, const Yuv420Planes<std::uint8_t>& out) {
    for (int y = 0; y < picture.height_px; y += 2) {
        luma_row(picture.row(y), picture.width_px, out.y + y * out.y_stride);
        luma_row(picture.row(y + 1), picture.width_px, out.y + (y + 1) * out.y_stride);
        chroma_row(picture.row(y), picture.row(y + 1), picture.width_px / 2, out.u + y / 2 * out.u_stride,
                   out.v + y / 2 * out.v_stride);
    }
}

void rgba_from_yuv420(const Yuv420Planes<const std::uint8_t>& in, ColorImage& picture) {
    for (int y = 0; y < picture.height_px; ++y) {
        rgba_row(in.y + y * in.y_stride, in.u + y / 2 * in.u_stride, in.v + y / 2 * in.v_stride, picture.width_px / 2,
                 picture.row(y));
    }
}

}  // namespace macula
