// Time of the reflectance kernels for sixteen lanes at a time, as the tracer calls them. Each function is one loop over
// the lanes; its ns divided by those of `plain_single_scattering` in the same run tells what the rest costs.

#include <algorithm>
#include <array>
#include <random>

#include <benchmark/benchmark.h>

#include "server/kernels/area_light.h"
#include "server/kernels/shade.h"
#include "server/render/lanes.h"

namespace macula {
namespace {

using glm::vec2;
using glm::vec3;

/// Random surfaces with a view and a light each.
struct Packet {
    Lanes3 position;
    Lanes3 normal;
    Lanes3 view;
    Lanes3 base_color;
    Lanes<float> metallic;
    Lanes<float> roughness;
    Lanes3 radiance;
};

/// A Surface for each lane, value by value.
struct SurfaceLanes {
    Lanes3 f0;
    Lanes<float> f90;
    std::array<Lanes<float>, 11> curves;
    Lanes3 scatter;
    Lanes3 base;
    Lanes3 entry;

    void set(int i, const kernels::Surface& s) {
        f0.set(i, s.f0);
        f90[i] = s.f90;
        const kernels::AlbedoCurves& c = s.curves;
        const std::array<float, 11> values{c.alpha, c.p0, c.p1, c.p2, c.p3, c.p4, c.q0, c.q1, c.q2, c.q3, c.q4};
        for (std::size_t k = 0; k < values.size(); ++k) curves[k][i] = values[k];
        scatter.set(i, s.scatter);
        base.set(i, s.base);
        entry.set(i, s.entry);
    }
    [[nodiscard]] kernels::Surface at(int i) const {
        kernels::Surface s{};
        s.f0 = f0[i];
        s.f90 = f90[i];
        s.curves = {curves[0][i], curves[1][i], curves[2][i], curves[3][i], curves[4][i], curves[5][i],
                    curves[6][i], curves[7][i], curves[8][i], curves[9][i], curves[10][i]};
        s.scatter = scatter[i];
        s.base = base[i];
        s.entry = entry[i];
        return s;
    }
};

Packet random_packet() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    const auto towards_z = [&] {
        return glm::normalize(vec3(unit(random) - 0.5F, unit(random) - 0.5F, 0.2F + unit(random)));
    };
    Packet p{};
    for (int i = 0; i < kLaneCount; ++i) {
        p.position.set(i, vec3(unit(random), unit(random), 0.0F));
        p.normal.set(i, towards_z());
        p.view.set(i, towards_z());
        p.base_color.set(i, vec3(unit(random), unit(random), unit(random)));
        p.metallic[i] = unit(random);
        p.roughness[i] = unit(random);
    }
    return p;
}

kernels::Light lamp() {
    kernels::Light light{};
    light.position = glm::vec4(0.3F, 0.4F, 2.0F, 1.0F);
    light.direction = vec3(0.0F, 0.0F, -1.0F);
    light.intensity = vec3(3.0F, 2.0F, 1.0F);
    light.spot_offset = 1.0F;
    light.radius = 0.1F;
    return light;
}

/// Runs `shade(light, lane)`, which returns radiance, on all lanes.
template <class Shade>
void run(benchmark::State& state, Packet& p, Shade&& shade) {
    kernels::Light light = lamp();
    for (auto _ : state) {
        benchmark::DoNotOptimize(&light);
        benchmark::DoNotOptimize(&p);
        benchmark::ClobberMemory();
        MACULA_LANE_LOOP
        for (int i = 0; i < kLaneCount; ++i) p.radiance.set(i, shade(light, i));
        benchmark::ClobberMemory();
    }
}

/// What glTF 2.0 asks for at the least: one GGX lobe and Lambert's.
vec3 single_scattering(const Packet& p, int i, const kernels::LightSample& sample) {
    const kernels::Bounce b = kernels::bounce_angles(p.normal[i], p.view[i], sample.direction);
    const vec3 f0 = vec3(0.04F * (1.0F - p.metallic[i])) + p.base_color[i] * p.metallic[i];
    const vec3 diffuse = p.base_color[i] * ((1.0F - p.metallic[i]) / kernels::kPi);
    const float r = std::max(p.roughness[i], kernels::kMinRoughness);
    const vec3 f = kernels::schlick_fresnel(f0, b.v_dot_h);
    return (diffuse * (vec3(1.0F) - f) + f * kernels::ggx_lobe(b, r * r)) * sample.irradiance * b.n_dot_l;
}

void plain_single_scattering(benchmark::State& state) {
    Packet p = random_packet();
    run(state, p, [&](const kernels::Light& light, int i) {
        return single_scattering(p, i, kernels::sample_light(light, p.position[i]));
    });
}

kernels::Surface surface_of(const Packet& p, int i) {
    return kernels::make_surface(p.base_color[i], p.metallic[i], p.roughness[i], glm::dot(p.normal[i], p.view[i]));
}

void prepare_surface(benchmark::State& state) {
    Packet p = random_packet();
    SurfaceLanes surfaces{};
    for (auto _ : state) {
        benchmark::DoNotOptimize(&p);
        benchmark::ClobberMemory();
        MACULA_LANE_LOOP
        for (int i = 0; i < kLaneCount; ++i) {
            surfaces.set(i, kernels::make_surface(p.base_color[i], p.metallic[i], p.roughness[i],
                                                  glm::dot(p.normal[i], p.view[i])));
        }
        benchmark::DoNotOptimize(&surfaces);
        benchmark::ClobberMemory();
    }
}

void plain_prepared(benchmark::State& state) {
    Packet p = random_packet();
    SurfaceLanes surfaces{};
    for (int i = 0; i < kLaneCount; ++i) surfaces.set(i, surface_of(p, i));
    benchmark::DoNotOptimize(&surfaces);
    run(state, p, [&](const kernels::Light& light, int i) {
        const auto sample = kernels::sample_light(light, p.position[i]);
        return kernels::shade_light(surfaces.at(i), p.normal[i], p.normal[i], p.view[i], sample);
    });
}

void plain_prepared_for_each_light(benchmark::State& state) {
    Packet p = random_packet();
    run(state, p, [&](const kernels::Light& light, int i) {
        const auto surface =
            kernels::make_surface(p.base_color[i], p.metallic[i], p.roughness[i], glm::dot(p.normal[i], p.view[i]));
        const auto sample = kernels::sample_light(light, p.position[i]);
        return kernels::shade_light(surface, p.normal[i], p.normal[i], p.view[i], sample);
    });
}

void plain_prepared_soft_light(benchmark::State& state) {
    Packet p = random_packet();
    SurfaceLanes surfaces{};
    for (int i = 0; i < kLaneCount; ++i) surfaces.set(i, surface_of(p, i));
    benchmark::DoNotOptimize(&surfaces);
    run(state, p, [&](const kernels::Light& light, int i) {
        const vec2 place = vec2(p.metallic[i], p.roughness[i]);
        const auto sample = kernels::sample_light(light, p.position[i], place);
        return kernels::shade_light(surfaces.at(i), p.normal[i], p.normal[i], p.view[i], sample);
    });
}

void plain_prepared_rectangle(benchmark::State& state) {
    Packet p = random_packet();
    SurfaceLanes surfaces{};
    for (int i = 0; i < kLaneCount; ++i) surfaces.set(i, surface_of(p, i));
    const kernels::RectangleLight panel{vec3(0.3F, 0.4F, 2.0F), vec3(0.0F, 0.5F, 0.0F), vec3(0.5F, 0.0F, 0.0F),
                                        vec3(3.0F)};
    benchmark::DoNotOptimize(&surfaces);
    run(state, p, [&](const kernels::Light& light, int i) {
        static_cast<void>(light);
        const vec2 place = vec2(p.metallic[i], p.roughness[i]);
        const auto sample = kernels::sample_light(panel, p.position[i], place);
        return kernels::shade_light(surfaces.at(i), p.normal[i], p.normal[i], p.view[i], sample);
    });
}

void layered_for_each_light(benchmark::State& state) {
    Packet p = random_packet();
    run(state, p, [&](const kernels::Light& light, int i) {
        const float n_dot_v = glm::dot(p.normal[i], p.view[i]);
        const auto surface = kernels::make_surface(p.base_color[i], p.metallic[i], p.roughness[i], n_dot_v);
        const auto layers = kernels::make_layers(surface, n_dot_v, 1.0F, 0.1F, n_dot_v, p.base_color[i], 0.5F);
        const auto sample = kernels::sample_light(light, p.position[i]);
        return kernels::shade_light(surface, layers, p.normal[i], p.normal[i], p.normal[i], p.view[i], sample);
    });
}

BENCHMARK(plain_single_scattering);
BENCHMARK(prepare_surface);
BENCHMARK(plain_prepared);
BENCHMARK(plain_prepared_for_each_light);
BENCHMARK(plain_prepared_soft_light);
BENCHMARK(plain_prepared_rectangle);
BENCHMARK(layered_for_each_light);

}  // namespace
}  // namespace macula

BENCHMARK_MAIN();
