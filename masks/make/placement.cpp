#include "masks/make/placement.h"

#include <cmath>

namespace macula {

Sites place(Placement placement, const DensityMap& density, std::uint32_t seed) {
    switch (placement) {
        case Placement::void_and_cluster:
            return place_by_rank(density, seed);
        case Placement::floyd_steinberg:
            return place_floyd_steinberg(density, seed);
        case Placement::poisson_disk:
            return place_poisson_disk(density, seed);
        case Placement::white_noise:
            return place_white_noise(density, seed);
        case Placement::quincunx:
            return place_quincunx(density, seed);
    }
    return {};
}

double placed_density(Placement placement, double density) {
    if (placement == Placement::void_and_cluster) return std::floor(kTileArea_px * density + 0.5) / kTileArea_px;
    if (placement == Placement::quincunx) return std::exp2(-std::floor(0.5 - std::log2(density)));
    return density;
}

}  // namespace macula
