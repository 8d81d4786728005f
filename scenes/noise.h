#pragma once

#include <vector>

namespace macula {

/// Integer hash (the finaliser of MurmurHash3) as a number in [0, 1).
float hash01(int x, int y, int seed);

/// Smoothly interpolated lattice noise in [0, 1); repeats every `period` cells along each axis.
float value_noise(float x, float y, int period, int seed);

/// Five octaves of value noise with `cells` cells in the first, about 0.5 in the mean; repeats over [0, 1)^2.
float fractal_noise(float u, float v, int cells, int seed);

/// Fractal noise that is sampled once and then read many times: reading costs a bilinear lookup instead of five
/// octaves of hashes. Repeats over [0, 1)^2; stretched to fill [0, 1].
class NoiseField {
public:
    /// `size` is a power of two; `cells_u` and `cells_v` are those of the first octave.
    NoiseField(int size, int cells_u, int cells_v, int octaves, int seed);

    [[nodiscard]] float at(float u, float v) const;

private:
    int mask_;
    float size_;
    std::vector<float> value_;
};

}  // namespace macula
