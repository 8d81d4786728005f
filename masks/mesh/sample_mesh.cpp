#include "masks/mesh/sample_mesh.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace macula {
namespace {

constexpr int kMostSide_px = 16384;  ///< triangulate() takes coordinates to 16383
constexpr std::uint32_t kNone = ~std::uint32_t{0};

std::string place(const SamplePosition& site) {
    return std::to_string(site.x_px) + ", " + std::to_string(site.y_px);
}

/// A number for a side of a triangle that is irregular in its ends, and negative (modulo 2^64) in the other direction.
/// The scrambling is splitmix64's finaliser (Steele, Lea & Flood 2014).
std::uint64_t directed_side(std::uint32_t from, std::uint32_t to) {
    const auto [low, high] = std::minmax(from, to);
    std::uint64_t z = (static_cast<std::uint64_t>(low) << 32U | high) + 0x9E3779B97F4A7C15U;
    z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27U) * 0x94D049BB133111EBU;
    z ^= z >> 31U;
    return from < to ? z : 0 - z;
}

/// Walks the sites on the mask's border in Triangle's orientation and adds up the sides between them.
class Border {
public:
    explicit Border(const SampleMesh& mesh)
        : width_(mesh.width_px),
          height_(mesh.height_px),
          top_(static_cast<std::size_t>(width_), kNone),
          bottom_(top_),
          left_(static_cast<std::size_t>(height_), kNone),
          right_(left_) {}

    void add(const SamplePosition& at, std::uint32_t site) {
        if (at.y_px == 0) top_[static_cast<std::size_t>(at.x_px)] = site;
        if (at.y_px == height_ - 1) bottom_[static_cast<std::size_t>(at.x_px)] = site;
        if (at.x_px == 0) left_[static_cast<std::size_t>(at.y_px)] = site;
        if (at.x_px == width_ - 1) right_[static_cast<std::size_t>(at.y_px)] = site;
    }

    [[nodiscard]] bool has_corners() const {
        return top_.front() != kNone && top_.back() != kNone && bottom_.front() != kNone && bottom_.back() != kNone;
    }

    [[nodiscard]] std::uint64_t sum() const {
        std::uint64_t sum = 0;
        std::uint32_t last = top_.back();
        const auto step = [&](std::uint32_t site) {
            if (site == kNone || site == last) return;
            sum += directed_side(last, site);
            last = site;
        };
        for (auto s = top_.rbegin(); s != top_.rend(); ++s) step(*s);
        for (const std::uint32_t s : left_) step(s);
        for (const std::uint32_t s : bottom_) step(s);
        for (auto s = right_.rbegin(); s != right_.rend(); ++s) step(*s);
        return sum;
    }

private:
    int width_;
    int height_;
    std::vector<std::uint32_t> top_;  ///< site by pixel; kNone: none
    std::vector<std::uint32_t> bottom_;
    std::vector<std::uint32_t> left_;
    std::vector<std::uint32_t> right_;
};

std::string site_defect(const SampleMesh& mesh, Border& border) {
    const auto width = static_cast<std::size_t>(mesh.width_px);
    std::vector<bool> taken(width * static_cast<std::size_t>(mesh.height_px));
    for (std::size_t i = 0; i < mesh.site.size(); ++i) {
        const SamplePosition& s = mesh.site[i];
        if (s.x_px < 0 || s.x_px >= mesh.width_px || s.y_px < 0 || s.y_px >= mesh.height_px)
            return "site " + std::to_string(i) + " at " + place(s) + " is not on the mask";
        const std::size_t pixel = static_cast<std::size_t>(s.y_px) * width + static_cast<std::size_t>(s.x_px);
        if (taken[pixel]) return "site " + std::to_string(i) + " at " + place(s) + " repeats another";
        taken[pixel] = true;
        border.add(s, static_cast<std::uint32_t>(i));
    }
    return border.has_corners() ? "" : "a corner of the mask is not a site";
}

std::string triangle_defect(const SampleMesh& mesh, const Border& border) {
    std::vector<bool> used(mesh.site.size());
    std::uint64_t sides = 0;
    for (std::size_t i = 0; i < mesh.triangle.size(); ++i) {
        const SampleMesh::Triangle& t = mesh.triangle[i];
        for (const std::uint32_t corner : t) {
            if (corner >= mesh.site.size())
                return "triangle " + std::to_string(i) + " has the corner " + std::to_string(corner) + " of " +
                       std::to_string(mesh.site.size()) + " sites";
            used[corner] = true;
        }
        const SamplePosition a = mesh.site[t[0]];
        const SamplePosition b = mesh.site[t[1]];
        const SamplePosition c = mesh.site[t[2]];
        if ((b.x_px - a.x_px) * (c.y_px - a.y_px) >= (b.y_px - a.y_px) * (c.x_px - a.x_px))
            return "triangle " + std::to_string(i) + " is degenerate or turns the wrong way";
        for (int k = 0; k < 3; ++k) sides += directed_side(t[k], t[(k + 1) % 3]);
    }
    for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i]) return "site " + std::to_string(i) + " at " + place(mesh.site[i]) + " is in no triangle";
    // Sides within cancel if each is there once in each direction. What is left is the border of what is covered, and
    // as all triangles turn the same way, all of them overlap nowhere if that is the mask's border once.
    return sides == border.sum() ? "" : "the triangles do not cover the mask exactly once";
}

}  // namespace

std::string mesh_defect(const SampleMesh& mesh) {
    if (mesh.width_px < 2 || mesh.height_px < 2 || mesh.width_px > kMostSide_px || mesh.height_px > kMostSide_px)
        return "the mask's sides are not 2 to " + std::to_string(kMostSide_px) + " pixels";
    if (mesh.gaze_px.x < 0 || mesh.gaze_px.x >= mesh.width_px || mesh.gaze_px.y < 0 || mesh.gaze_px.y >= mesh.height_px)
        return "the gaze is not on the mask";
    Border border(mesh);
    std::string defect = site_defect(mesh, border);
    return defect.empty() ? triangle_defect(mesh, border) : defect;
}

}  // namespace macula
