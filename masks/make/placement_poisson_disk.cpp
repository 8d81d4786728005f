#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>

#include "masks/make/placement.h"

namespace macula {
namespace {

constexpr int kGreatest_px = 8;  // radius: a density of 1/90, below kLeastDensity
constexpr int kSteps = 4;        // densities measured from one disk to the next

/// Distances between pixels, ascending: the radii that make a difference. Within a disk's radius no other site lies;
/// disk 0 stands for less than the least radius: of the four nearest neighbours one may be a site.
struct Disks {
    std::vector<int> dx;  ///< pixels by distance, the middle first
    std::vector<int> dy;
    std::vector<std::size_t> inside;  ///< how many of them each disk covers: those nearer than its radius
};

Disks make_disks() {
    Disks disks;
    for (int square = 0; square <= kGreatest_px * kGreatest_px; ++square) {
        const std::size_t before = disks.dx.size();
        for (int y = -kGreatest_px; y <= kGreatest_px; ++y) {
            for (int x = -kGreatest_px; x <= kGreatest_px; ++x) {
                if (x * x + y * y != square) continue;
                disks.dx.push_back(x);
                disks.dy.push_back(y);
            }
        }
        if (disks.dx.size() == before || square < 2) continue;
        if (square == 2) disks.inside.push_back(before);
        disks.inside.push_back(before);
    }
    return disks;
}

/// The pixels of a plane and the disks that lie on it.
class Plane {
public:
    Plane(const Disks& disks, int width_px, int height_px)
        : disks_(disks),
          stride_(width_px + 2 * kGreatest_px),
          greatest_(static_cast<std::size_t>(stride_) * (height_px + 2 * kGreatest_px), kAnyDisk),
          covered_(greatest_.size()) {
        for (std::size_t i = 0; i < disks.dx.size(); ++i)
            offset_.push_back(static_cast<std::ptrdiff_t>(disks.dy[i]) * stride_ + disks.dx[i]);
    }

    /// Disks greater than this do not cover the pixel farther than this would: a sparse neighbourhood must not clear
    /// the edge of a dense one.
    void limit(int x, int y, std::size_t disk) { greatest_[index(x, y)] = static_cast<std::uint8_t>(disk); }

    /// Whether a site may lie there.
    [[nodiscard]] bool free(int x, int y) const { return covered_[index(x, y)] < kWhole; }

    void lay(int x, int y, std::size_t disk) {
        const std::size_t middle = index(x, y);
        for (std::size_t i = 1; i < disks_.inside[disk]; ++i) {
            const std::size_t pixel = middle + static_cast<std::size_t>(offset_[i]);
            const std::size_t lesser = std::min<std::size_t>(disk, greatest_[pixel]);
            if (i < disks_.inside[lesser]) cover(pixel, lesser == 0 ? kHalf : kWhole);
        }
        cover(middle, kWhole);
    }

private:
    static constexpr std::uint8_t kAnyDisk = 255;
    static constexpr std::uint8_t kHalf = 1;
    static constexpr std::uint8_t kWhole = 2;

    /// Halves add up.
    void cover(std::size_t pixel, std::uint8_t by) {
        covered_[pixel] = static_cast<std::uint8_t>(std::min(covered_[pixel] + by, int{kWhole}));
    }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y + kGreatest_px) * stride_ + x + kGreatest_px;
    }

    const Disks& disks_;
    int stride_;
    std::vector<std::ptrdiff_t> offset_;
    std::vector<std::uint8_t> greatest_;
    std::vector<std::uint8_t> covered_;
};

/// Fisher-Yates; std::shuffle gives other orders with other libraries.
std::vector<std::uint32_t> random_order(std::size_t count, std::mt19937& random) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t left = count; left > 1; --left) {
        const std::size_t other = std::uint64_t{random()} * left >> 32U;
        std::swap(order[left - 1], order[other]);
    }
    return order;
}

double draw_from(std::mt19937& random) {
    return static_cast<double>(random()) * 0x1p-32;
}

/// One of the two disks of a mixture, by a number that is even in 0..1.
std::size_t disk_of(double mixture, double draw) {
    const double whole = std::floor(mixture);
    return static_cast<std::size_t>(whole) + (draw < mixture - whole ? 1 : 0);
}

/// Share of the pixels of a plane that become sites with one mixture of disks everywhere.
double measure_density(const Disks& disks, double mixture, std::mt19937& random) {
    constexpr int kEdge_px = 256;
    constexpr int kBorder_px = 24;  // where disks that would lie beyond the plane are missed
    Plane plane(disks, kEdge_px, kEdge_px);
    int sites = 0;
    for (const std::uint32_t pixel : random_order(std::size_t{kEdge_px} * kEdge_px, random)) {
        const int x = static_cast<int>(pixel) % kEdge_px;
        const int y = static_cast<int>(pixel) / kEdge_px;
        if (!plane.free(x, y)) continue;
        plane.lay(x, y, disk_of(mixture, draw_from(random)));
        const auto inner = [](int c) { return c >= kBorder_px && c < kEdge_px - kBorder_px; };
        sites += inner(x) && inner(y) ? 1 : 0;
    }
    constexpr int kInner_px = kEdge_px - 2 * kBorder_px;
    return 1.0 * sites / (kInner_px * kInner_px);
}

/// Which disks give a density. On a pixel grid no formula says so: few distances exist, and random packing jams at a
/// density of its own for each: .51 for disk 0, .364 for disk 1; in the plane at .698 / radius^2.
class DisksOfDensity {
public:
    explicit DisksOfDensity(const Disks& disks) {
        constexpr std::uint32_t kAnySeed = 1;
        std::mt19937 random(kAnySeed);
        for (std::size_t i = 0; i <= (disks.inside.size() - 1) * kSteps; ++i) {
            const double measured = measure_density(disks, 1.0 * static_cast<double>(i) / kSteps, random);
            density_.push_back(i == 0 ? measured : std::min(measured, density_.back()));
        }
    }

    /// Of the sparsest disks.
    [[nodiscard]] double least() const { return density_.back(); }

    /// The mixture for a density, or the nearest.
    [[nodiscard]] double mixture(double density) const {
        const auto after =
            std::upper_bound(density_.begin(), density_.end(), density, std::greater<>()) - density_.begin();
        const auto i = static_cast<std::size_t>(after);
        if (i == 0) return 0.0;
        if (i == density_.size()) return static_cast<double>(i - 1) / kSteps;
        return (static_cast<double>(i) - (density - density_[i]) / (density_[i - 1] - density_[i])) / kSteps;
    }

private:
    std::vector<double> density_;  ///< of mixture i / kSteps; falls
};

}  // namespace

Sites place_poisson_disk(const DensityMap& density, std::uint32_t seed) {
    static const Disks kDisks = make_disks();
    static const DisksOfDensity kDisksOf(kDisks);

    std::mt19937 random(seed);
    Sites sites(density.density.size());
    Plane plane(kDisks, density.width_px, density.height_px);
    std::size_t i = 0;
    for (int y = 0; y < density.height_px; ++y) {
        for (int x = 0; x < density.width_px; ++x, ++i) {
            const double wished = density.density[i];
            sites[i] = wished > 0.5 ? 1 : 0;
            plane.limit(x, y, disk_of(kDisksOf.mixture(std::min(wished, 1.0 - wished)), 0.0));
        }
    }
    for (const std::uint32_t pixel : random_order(sites.size(), random)) {
        const int x = static_cast<int>(pixel % static_cast<std::uint32_t>(density.width_px));
        const int y = static_cast<int>(pixel / static_cast<std::uint32_t>(density.width_px));
        const double rarer = std::min(density.density[pixel], 1.0F - density.density[pixel]);
        const double draw = draw_from(random);
        const double other_draw = draw_from(random);
        if (rarer <= 0.0 || !plane.free(x, y)) continue;
        plane.lay(x, y, disk_of(kDisksOf.mixture(rarer), draw));
        // Gaps may be rarer than the sparsest disks: then only some of these become one.
        if (other_draw * kDisksOf.least() < rarer) sites[pixel] ^= 1U;
    }
    return sites;
}

}  // namespace macula
