#include "server/render/gl_picture.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>

namespace macula {

namespace {

/// Copies rows without gaps to rows that may be longer.
template <class T>
void copy_rows(std::span<const T> from, int width, T* to, std::size_t stride) {
    for (; !from.empty(); from = from.subspan(static_cast<std::size_t>(width)), to += stride)
        std::copy_n(from.begin(), width, to);
}

}  // namespace

void GlPicture::resize(int width_px, int height_px) {
    width_px_ = width_px;
    const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    colors_.resize(pixels);
    inverse_depths_.resize(pixels);
}

void GlPicture::bind(unsigned color_index, unsigned inverse_depth_index) const {
    colors_.bind(color_index);
    inverse_depths_.bind(inverse_depth_index);
}

Expected<void> GlPicture::copy_to(const ReconstructTarget& target) const {
    auto color = colors_.read(
        [&](std::span<const Rgba8> pixels) { copy_rows(pixels, width_px_, target.color, target.color_stride_px); });
    if (!color) return color;
    return inverse_depths_.read([&](std::span<const float> pixels) {
        copy_rows(pixels, width_px_, target.inverse_depth_per_m, target.depth_stride_px);
    });
}

void GlHiddenPixels::update(const SamplePlan& plan) {
    const std::size_t words =
        (static_cast<std::size_t>(plan.width_px) * static_cast<std::size_t>(plan.height_px) + 3) / 4;
    if (words_.size() == words && uploaded_ == plan.hidden) return;
    std::vector<std::uint32_t> packed(words);
    if (plan.hidden) std::memcpy(packed.data(), plan.hidden->data(), plan.hidden->size());
    words_.write(packed);
    uploaded_ = plan.hidden;
}

}  // namespace macula
