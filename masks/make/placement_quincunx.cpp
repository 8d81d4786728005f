#include <array>
#include <cmath>
#include <random>

#include "masks/make/placement.h"

namespace macula {
namespace {

constexpr int kSparsest = 6;                    // density 1/64
constexpr int kPeriod_px = 1 << kSparsest / 2;  // of all lattices together

/// Sparsest lattice that a pixel lies on. Lattice 2k holds the multiples of 2^k in x and in y, lattice 2k + 1 every
/// second of them, as the black fields of a chessboard.
int sparsest_lattice(int x, int y) {
    for (int half = 0; half < kSparsest / 2; ++half, x /= 2, y /= 2) {
        if ((x + y) % 2 != 0) return 2 * half;
        if (x % 2 != 0) return 2 * half + 1;
    }
    return kSparsest;
}

}  // namespace

Sites place_quincunx(const DensityMap& density, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto shift = [&random] { return static_cast<int>(random() % kPeriod_px); };
    const int shift_x = shift();
    const int shift_y = shift();
    std::array<float, kSparsest> least{};  // density from which a pixel of each lattice is a site
    for (int lattice = 0; lattice < kSparsest; ++lattice)
        least[lattice] = std::exp2(-(static_cast<float>(lattice) + 0.5F));

    Sites sites(density.density.size());
    std::size_t i = 0;
    for (int y = 0; y < density.height_px; ++y) {
        for (int x = 0; x < density.width_px; ++x, ++i) {
            const int lattice = sparsest_lattice((x + shift_x) % kPeriod_px, (y + shift_y) % kPeriod_px);
            sites[i] = lattice == kSparsest || density.density[i] > least[lattice] ? 1 : 0;
        }
    }
    return sites;
}

}  // namespace macula
