#include <random>

#include "masks/make/placement.h"

namespace macula {

Sites place_white_noise(const DensityMap& density, std::uint32_t seed) {
    std::mt19937 random(seed);
    Sites sites(density.density.size());
    for (std::size_t i = 0; i < sites.size(); ++i)
        sites[i] = static_cast<double>(random()) * 0x1p-32 < density.density[i] ? 1 : 0;
    return sites;
}

}  // namespace macula
