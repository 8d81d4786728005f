// What a texture lookup costs, by format and by footprint, and what the environment's lookups cost. Lookups lie near
// each other, as a packet's do. Compare the lines of one run.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "server/render/environment.h"
#include "server/render/texture_lookup.h"
#include "tests/support/texture_image.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;

constexpr int kSize_px = 1024;
constexpr int kPlaces = 4096;

TextureImage make(int channels, TexelType type, bool srgb) {
    return test::make_image(
        kSize_px, kSize_px, channels, type,
        [](int x, int y) {
            const float a = 0.5F + 0.4F * std::sin(0.1F * static_cast<float>(x));
            const float b = 0.5F + 0.4F * std::sin(0.13F * static_cast<float>(y));
            return vec4(a, b, 0.9F, 1.0F);
        },
        srgb);
}

/// A walk over the texture in steps of some texels.
std::vector<vec2> places() {
    std::vector<vec2> places;
    for (int i = 0; i < kPlaces; ++i) {
        const auto n = static_cast<float>(i);
        places.push_back(vec2(n * 0.0021F, n * 0.00037F + 0.1F * std::sin(0.3F * n)));
    }
    return places;
}

kernels::UvFootprint footprint(float u_texels, float v_texels) {
    return {vec2(u_texels / kSize_px, 0.0F), vec2(0.0F, v_texels / kSize_px)};
}

struct Format {
    const char* name;
    int channels;
    TexelType type;
    bool srgb;
};
constexpr std::array<Format, 6> kFormats = {{{"u8 RGB sRGB", 3, TexelType::u8, true},
                                             {"u8 RGBA sRGB", 4, TexelType::u8, true},
                                             {"u8 grey", 1, TexelType::u8, false},
                                             {"u16 RGB sRGB", 3, TexelType::u16, true},
                                             {"half RGB", 3, TexelType::f16, false},
                                             {"float RGB", 3, TexelType::f32, false}}};

struct Shape {
    const char* name;
    float u_texels;
    float v_texels;
};
constexpr std::array<Shape, 7> kShapes = {{{"point", 0.0F, 0.0F},
                                           {"magnified", 0.5F, 0.5F},
                                           {"level 2", 4.0F, 4.0F},
                                           {"between levels", 5.7F, 5.7F},
                                           {"2 taps", 11.4F, 5.7F},
                                           {"4 taps", 22.8F, 5.7F},
                                           {"4 taps, coarser", 45.6F, 5.7F}}};

/// Arguments: format, shape.
void look_up_texture(benchmark::State& state) {
    const Format& format = kFormats.at(static_cast<std::size_t>(state.range(0)));
    const Shape& shape = kShapes.at(static_cast<std::size_t>(state.range(1)));
    const TextureImage image = make(format.channels, format.type, format.srgb);
    TextureLibrary library;
    const TextureView view = library.view({.image = 0}, image, TextureContent::values);
    const std::vector<vec2> at = places();
    const kernels::UvFootprint f = footprint(shape.u_texels, shape.v_texels);
    vec4 sum(0.0F);
    for (auto _ : state)
        for (const vec2& uv : at) sum += look_up(view, uv, f);
    benchmark::DoNotOptimize(sum);
    state.SetItemsProcessed(state.iterations() * kPlaces);
    state.SetLabel(std::string(format.name) + ", " + shape.name);
}
BENCHMARK(look_up_texture)->ArgsProduct({{0, 1, 2, 3, 4, 5}, {1, 3}})->ArgsProduct({{0}, {0, 2, 4, 5, 6}});

void look_up_a_normal(benchmark::State& state) {
    const Shape& shape = kShapes.at(static_cast<std::size_t>(state.range(0)));
    const TextureImage image = make(3, TexelType::u8, false);
    TextureLibrary library;
    const TextureView view = library.view({.image = 0}, image, TextureContent::normals);
    const std::vector<vec2> at = places();
    const kernels::UvFootprint f = footprint(shape.u_texels, shape.v_texels);
    vec3 sum(0.0F);
    for (auto _ : state)
        for (const vec2& uv : at) sum += look_up_normal(view, uv, f).normal;
    benchmark::DoNotOptimize(sum);
    state.SetItemsProcessed(state.iterations() * kPlaces);
    state.SetLabel(shape.name);
}
BENCHMARK(look_up_a_normal)->DenseRange(1, 6);

void find_a_footprint(benchmark::State& state) {
    const std::vector<vec2> at = places();
    vec2 sum(0.0F);
    for (auto _ : state)
        for (const vec2& uv : at) {
            const kernels::UvFootprint f = kernels::uv_footprint(0.01F, vec3(0.6F, -0.8F, 0.0F), vec3(uv, 0.1F),
                                                                 vec3(0.0F, uv.x, 1.0F), vec2(0.5F, 0), vec2(0, 0.5F));
            sum += f.across + f.along;
        }
    benchmark::DoNotOptimize(sum);
    state.SetItemsProcessed(state.iterations() * kPlaces);
}
BENCHMARK(find_a_footprint);

void make_levels(benchmark::State& state) {
    const Format& format = kFormats.at(static_cast<std::size_t>(state.range(0)));
    const TextureImage image = make(format.channels, format.type, format.srgb);
    for (auto _ : state) benchmark::DoNotOptimize(TextureLevels(image, TextureContent::values).levels().data());
    state.SetItemsProcessed(state.iterations() * kSize_px * kSize_px);
    state.SetLabel(format.name);
}
BENCHMARK(make_levels)->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

enum class Lookup { radiance, glossy, irradiance };

template <Lookup lookup>
void look_up_environment(benchmark::State& state) {
    const TextureImage image = make(3, TexelType::f16, false);
    const EnvironmentMap map(image, 1.0F, 0.0F);
    const std::vector<vec2> at = places();
    vec3 sum(0.0F);
    for (auto _ : state)
        for (const vec2& uv : at) {
            const vec3 direction = vec3(uv, 1.0F) * (1.0F / std::sqrt(uv.x * uv.x + uv.y * uv.y + 1.0F));
            if constexpr (lookup == Lookup::radiance) sum += map.radiance(direction, 0.02F);
            if constexpr (lookup == Lookup::glossy) sum += map.glossy_radiance(direction, 0.35F);
            if constexpr (lookup == Lookup::irradiance) sum += map.irradiance(direction);
        }
    benchmark::DoNotOptimize(sum);
    state.SetItemsProcessed(state.iterations() * kPlaces);
}
BENCHMARK(look_up_environment<Lookup::radiance>);
BENCHMARK(look_up_environment<Lookup::glossy>);
BENCHMARK(look_up_environment<Lookup::irradiance>);

void make_environment(benchmark::State& state) {
    const TextureImage image = make(3, TexelType::f16, false);
    for (auto _ : state) benchmark::DoNotOptimize(EnvironmentMap(image, 1.0F, 0.0F).memory_bytes());
}
BENCHMARK(make_environment)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
