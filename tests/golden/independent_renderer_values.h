#pragma once

#include <array>

#include <glm/vec3.hpp>

// What Mitsuba 3.9.1 (variant scalar_rgb) measured, printed by independent_renderer.py, where the scenes are described;
// each line is one ray. 2^22 paths a ray, in runs of 1024 from whose spread the standard error comes; light from a
// point has no spread.

namespace macula::test {

/// A ray's radiance as measured. `point` is any point on the ray from the scene's eye.
struct Measured {
    glm::vec3 point;
    glm::vec3 radiance;
    float standard_error;  ///< the largest of the three channels
};

// clang-format off

/// A square lamp 2 m above a Lambert floor.
inline constexpr std::array kLampAbove{
    Measured{{0.0F, 0.0F, 0.3F}, {0.353637F, 0.353637F, 0.353637F}, 1.6e-05F},
    Measured{{0.5F, 0.0F, 0.3F}, {0.319009F, 0.319009F, 0.319009F}, 2.3e-05F},
    Measured{{1.0F, 0.0F, 0.3F}, {0.239682F, 0.239682F, 0.239682F}, 2.6e-05F},
    Measured{{2.0F, 0.0F, 0.3F}, {0.0991956F, 0.0991956F, 0.0991956F}, 1.4e-05F},
    Measured{{4.0F, 0.0F, 0.3F}, {0.0161396F, 0.0161396F, 0.0161396F}, 1.8e-06F},
    Measured{{-3.0F, 0.0F, 0.3F}, {0.0381715F, 0.0381715F, 0.0381715F}, 4.9e-06F},
};

/// The lamp at .8 m, tilted by 40 degrees; the last point lies behind it.
inline constexpr std::array kLampNear{
    Measured{{0.0F, 0.0F, 0.3F}, {1.36915F, 1.36915F, 1.36915F}, 0.00043F},
    Measured{{0.5F, 0.0F, 0.3F}, {0.967539F, 0.967539F, 0.967539F}, 0.00016F},
    Measured{{1.0F, 0.0F, 0.3F}, {0.481482F, 0.481482F, 0.481482F}, 9.4e-05F},
    Measured{{2.0F, 0.0F, 0.3F}, {0.111383F, 0.111383F, 0.111383F}, 2.5e-05F},
    Measured{{4.0F, 0.0F, 0.3F}, {0.0151132F, 0.0151132F, 0.0151132F}, 2.9e-06F},
    Measured{{-3.0F, 0.0F, 0.3F}, {0.0F, 0.0F, 0.0F}, 0.0F},
};

/// Along a line across the shadow of a square.
inline constexpr std::array kPenumbra{
    Measured{{-1.4F, 0.0F, 0.15F}, {0.177451F, 0.177451F, 0.177451F}, 2.3e-05F},
    Measured{{-1.2F, 0.0F, 0.15F}, {0.210414F, 0.210414F, 0.210414F}, 2.5e-05F},
    Measured{{-1.0F, 0.0F, 0.15F}, {0.229099F, 0.229099F, 0.229099F}, 4.4e-05F},
    Measured{{-0.8F, 0.0F, 0.15F}, {0.216063F, 0.216063F, 0.216063F}, 7e-05F},
    Measured{{-0.6F, 0.0F, 0.15F}, {0.177014F, 0.177014F, 0.177014F}, 8.7e-05F},
    Measured{{-0.4F, 0.0F, 0.15F}, {0.112986F, 0.112986F, 0.112986F}, 8.4e-05F},
    Measured{{-0.2F, 0.0F, 0.15F}, {0.0367643F, 0.0367643F, 0.0367643F}, 5.2e-05F},
    Measured{{0.0F, 0.0F, 0.15F}, {0.0F, 0.0F, 0.0F}, 0.0F},
    Measured{{0.2F, 0.0F, 0.15F}, {0.0F, 0.0F, 0.0F}, 0.0F},
    Measured{{0.4F, 0.0F, 0.15F}, {0.0F, 0.0F, 0.0F}, 0.0F},
    Measured{{0.6F, 0.0F, 0.15F}, {0.0374147F, 0.0374147F, 0.0374147F}, 5.6e-05F},
    Measured{{0.8F, 0.0F, 0.15F}, {0.102773F, 0.102773F, 0.102773F}, 7.7e-05F},
    Measured{{1.0F, 0.0F, 0.15F}, {0.145928F, 0.145928F, 0.145928F}, 7.2e-05F},
    Measured{{1.2F, 0.0F, 0.15F}, {0.165162F, 0.165162F, 0.165162F}, 5.5e-05F},
    Measured{{1.4F, 0.0F, 0.15F}, {0.166182F, 0.166182F, 0.166182F}, 3.3e-05F},
    Measured{{1.6F, 0.0F, 0.15F}, {0.147924F, 0.147924F, 0.147924F}, 2e-05F},
    Measured{{1.8F, 0.0F, 0.15F}, {0.122394F, 0.122394F, 0.122394F}, 1.7e-05F},
};

/// Gold of roughness .2 under a point light, seen at 45 degrees, highlight first.
inline constexpr std::array kSmootherSteep{
    Measured{{0.0F, 0.0F, 2.0F}, {87.8512F, 67.689F, 29.9944F}, 0.0F},
    Measured{{0.0F, 0.0F, 1.8F}, {15.5232F, 11.9603F, 5.29931F}, 0.0F},
    Measured{{0.0F, 0.0F, 2.3F}, {3.42195F, 2.63649F, 1.16801F}, 0.0F},
    Measured{{0.3F, 0.0F, 2.0F}, {0.402572F, 0.310167F, 0.13741F}, 0.0F},
    Measured{{0.5F, 0.0F, 1.5F}, {0.0560808F, 0.0432014F, 0.0191224F}, 0.0F},
};

/// At 76 degrees.
inline constexpr std::array kSmootherFlat{
    Measured{{0.0F, 0.0F, 2.0F}, {476.43F, 394.175F, 240.393F}, 0.0F},
    Measured{{0.0F, 0.0F, 1.8F}, {347.587F, 287.293F, 174.57F}, 0.0F},
    Measured{{0.0F, 0.0F, 2.3F}, {96.0649F, 79.3026F, 47.9645F}, 0.0F},
    Measured{{0.3F, 0.0F, 2.0F}, {0.0170682F, 0.0139027F, 0.00798448F}, 0.0F},
    Measured{{0.5F, 0.0F, 1.5F}, {0.00933053F, 0.0074326F, 0.00388431F}, 0.0F},
};

/// Gold of roughness .3 at 45 degrees.
inline constexpr std::array kRougherSteep{
    Measured{{0.0F, 0.0F, 2.0F}, {17.2972F, 13.3274F, 5.90566F}, 0.0F},
    Measured{{0.0F, 0.0F, 1.8F}, {11.7626F, 9.06289F, 4.01553F}, 0.0F},
    Measured{{0.0F, 0.0F, 2.3F}, {4.82438F, 3.71701F, 1.6467F}, 0.0F},
    Measured{{0.3F, 0.0F, 2.0F}, {1.25997F, 0.970764F, 0.430067F}, 0.0F},
    Measured{{0.5F, 0.0F, 1.5F}, {0.24249F, 0.1868F, 0.082684F}, 0.0F},
};

/// At 76 degrees.
inline constexpr std::array kRougherFlat{
    Measured{{0.0F, 0.0F, 2.0F}, {89.5933F, 74.1251F, 45.2062F}, 0.0F},
    Measured{{0.0F, 0.0F, 1.8F}, {104.438F, 86.3214F, 52.452F}, 0.0F},
    Measured{{0.0F, 0.0F, 2.3F}, {43.9628F, 36.2918F, 21.9503F}, 0.0F},
    Measured{{0.3F, 0.0F, 2.0F}, {0.0792985F, 0.0645915F, 0.0370957F}, 0.0F},
    Measured{{0.5F, 0.0F, 1.5F}, {0.0441691F, 0.0351846F, 0.0183876F}, 0.0F},
};

/// A glass ball before a chart, from its middle to its edge and beyond; at most one reflection.
inline constexpr std::array kGlass{
    Measured{{0.0F, 0.0F, 0.0F}, {0.476227F, 0.491572F, 0.967799F}, 5.4e-05F},
    Measured{{16.0F, 12.0F, 0.0F}, {0.471013F, 0.487676F, 0.967773F}, 5.4e-05F},
    Measured{{32.0F, 24.0F, 0.0F}, {0.463729F, 0.482321F, 0.967383F}, 5.4e-05F},
    Measured{{48.0F, 36.0F, 0.0F}, {0.450278F, 0.472908F, 0.964839F}, 5.7e-05F},
    Measured{{60.0F, 45.0F, 0.0F}, {0.429249F, 0.459242F, 0.956887F}, 6.2e-05F},
    Measured{{68.0F, 51.0F, 0.0F}, {0.400792F, 0.442067F, 0.940247F}, 7.5e-05F},
    Measured{{74.4F, 55.8F, 0.0F}, {0.438097F, 0.463612F, 0.950267F}, 9e-05F},
    Measured{{80.0F, 60.0F, 0.0F}, {0.389977F, 0.428802F, 0.887888F}, 0.00012F},
    Measured{{96.0F, 72.0F, 0.0F}, {0.596003F, 0.572F, 1.0F}, 0.0F},
};

/// The same with an index of 1.33.
inline constexpr std::array kWater{
    Measured{{0.0F, 0.0F, 0.0F}, {0.488029F, 0.495881F, 0.983909F}, 3.9e-05F},
    Measured{{16.0F, 12.0F, 0.0F}, {0.4879F, 0.495788F, 0.983893F}, 3.9e-05F},
    Measured{{32.0F, 24.0F, 0.0F}, {0.486058F, 0.494482F, 0.983628F}, 3.9e-05F},
    Measured{{48.0F, 36.0F, 0.0F}, {0.479163F, 0.489834F, 0.98184F}, 4.1e-05F},
    Measured{{60.0F, 45.0F, 0.0F}, {0.464978F, 0.480905F, 0.975838F}, 4.8e-05F},
    Measured{{68.0F, 51.0F, 0.0F}, {0.44335F, 0.468267F, 0.962749F}, 5.9e-05F},
    Measured{{74.4F, 55.8F, 0.0F}, {0.464403F, 0.481452F, 0.964492F}, 7.3e-05F},
    Measured{{80.0F, 60.0F, 0.0F}, {0.424172F, 0.455122F, 0.904061F}, 0.00011F},
    Measured{{96.0F, 72.0F, 0.0F}, {0.596003F, 0.572F, 1.0F}, 0.0F},
};

/// The sky itself.
inline constexpr std::array kSky{
    Measured{{504.0F, 0.0F, 3.0F}, {0.302053F, 1.0F, 0.099999F}, 0.0F},
    Measured{{496.0F, 8.0F, 3.0F}, {0.534241F, 1.0F, 0.100136F}, 0.0F},
    Measured{{504.0F, 8.0F, 6.0F}, {2.21606F, 1.0F, 0.099999F}, 0.0F},
    Measured{{492.0F, 4.0F, 6.0F}, {0.388634F, 1.0F, 0.66789F}, 0.0F},
    Measured{{500.0F, -12.0F, 5.0F}, {0.100692F, 1.0F, 0.099999F}, 0.0F},
};

/// A Lambert ball under it.
inline constexpr std::array kMattBall{
    Measured{{-1000.0F, 0.0F, 0.0F}, {0.487773F, 0.49996F, 0.235039F}, 0.0002F},
    Measured{{-999.6F, 0.3F, 0.0F}, {0.601426F, 0.499976F, 0.185604F}, 0.00022F},
    Measured{{-1000.5F, 0.5F, 0.0F}, {0.522386F, 0.500014F, 0.313457F}, 0.00024F},
    Measured{{-999.8F, -0.7F, 0.0F}, {0.272213F, 0.500007F, 0.125011F}, 0.00013F},
    Measured{{-1000.8F, 0.1F, 0.0F}, {0.356448F, 0.499974F, 0.318013F}, 0.00024F},
    Measured{{-999.7F, 0.85F, 0.0F}, {0.695264F, 0.499991F, 0.191323F}, 0.00022F},
};

/// A metal ball of roughness .2.
inline constexpr std::array kSmoothBall{
    Measured{{0.0F, 0.0F, 0.0F}, {0.728288F, 0.79871F, 0.10496F}, 0.00012F},
    Measured{{0.4F, 0.3F, 0.0F}, {2.08094F, 0.798478F, 0.0811132F}, 0.00024F},
    Measured{{-0.5F, 0.5F, 0.0F}, {0.408383F, 0.798428F, 0.348513F}, 0.00013F},
    Measured{{0.2F, -0.7F, 0.0F}, {0.0908233F, 0.798455F, 0.0803161F}, 6.8e-05F},
    Measured{{-0.8F, 0.1F, 0.0F}, {0.260891F, 0.799328F, 0.109017F}, 6.9e-05F},
    Measured{{0.3F, 0.85F, 0.0F}, {0.527023F, 0.804125F, 0.0812896F}, 6.7e-05F},
};

/// Of roughness .4.
inline constexpr std::array kRoughBall{
    Measured{{1000.0F, 0.0F, 0.0F}, {0.754534F, 0.774104F, 0.217072F}, 0.00025F},
    Measured{{1000.4F, 0.3F, 0.0F}, {1.67844F, 0.769618F, 0.0950199F}, 0.00041F},
    Measured{{999.5F, 0.5F, 0.0F}, {0.47763F, 0.762417F, 0.554934F}, 0.00035F},
    Measured{{1000.2F, -0.7F, 0.0F}, {0.113645F, 0.761193F, 0.0827721F}, 0.00012F},
    Measured{{999.2F, 0.1F, 0.0F}, {0.265304F, 0.755612F, 0.25838F}, 0.0002F},
    Measured{{1000.3F, 0.85F, 0.0F}, {0.676882F, 0.744334F, 0.0874318F}, 0.00021F},
};

// clang-format on

}  // namespace macula::test
