// The tracer's kernels in C++ against the same text in GLSL, on random inputs.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "kernel_text/area_light.h"
#include "kernel_text/brdf.h"
#include "kernel_text/camera.h"
#include "kernel_text/color.h"
#include "kernel_text/fresnel.h"
#include "kernel_text/kernel_cases.h"
#include "kernel_text/kernel_cases_main.h"
#include "kernel_text/layers.h"
#include "kernel_text/light.h"
#include "kernel_text/microfacet.h"
#include "kernel_text/powers.h"
#include "kernel_text/shade.h"
#include "kernel_text/sheen.h"
#include "kernel_text/texture.h"
#include "protocol/gl/buffer.h"
#include "tests/differential/kernel_cases.h"

namespace macula {
namespace {

using kernels::KernelCase;
using kernels::KernelResult;

constexpr std::size_t kCases = 20000;

std::vector<KernelCase> random_cases(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    std::vector<KernelCase> cases(kCases);
    for (KernelCase& k : cases) {
        for (glm::vec4* v : {&k.a, &k.b, &k.c, &k.d, &k.e, &k.f})
            *v = glm::vec4(unit(random), unit(random), unit(random), unit(random));
    }
    return cases;
}

/// Largest difference over the four values, relative to 1 or to the value if that is more.
float difference(const glm::vec4& a, const glm::vec4& b) {
    float worst = 0.0F;
    for (int i = 0; i < 4; ++i) {
        const float d = std::abs(a[i] - b[i]) / std::max(1.0F, std::abs(a[i]));
        worst = std::isnan(d) ? 1e9F : std::max(worst, d);
    }
    return worst;
}

class KernelsOnGl : public testing::TestWithParam<ContextKind> {};

TEST_P(KernelsOnGl, AgreeWithCpp) {
    auto context = make_gl_context(GetParam());
    ASSERT_TRUE(context) << context.error().message;
    const auto current = CurrentContext::enter(**context);
    ASSERT_TRUE(current) << current.error().message;
    const auto program = ComputeProgram::build(
        **context, std::array{camera_text, color_text, powers_text, fresnel_text, microfacet_text, brdf_text,
                              sheen_text, layers_text, light_text, area_light_text, shade_text, texture_text,
                              kernel_cases_text, kernel_cases_main_text});
    ASSERT_TRUE(program) << program.error().message;
    constexpr std::uint32_t kSeed = 1;
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    const std::vector<KernelCase> cases = random_cases(kSeed);
    StorageBuffer<KernelCase> input(**context);
    StorageBuffer<KernelResult> output(**context);
    input.write(cases);
    output.resize(cases.size());
    input.bind(0);
    output.bind(1);
    program->dispatch((kCases + 63) / 64);
    const auto read = output.read([&](std::span<const KernelResult> results) {
        KernelResult worst{};
        int lit = 0;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const KernelResult cpp = kernels::run_case(cases[i]);
            lit += cpp.shading.x > 0.0F ? 1 : 0;
            worst.ray.x = std::max(worst.ray.x, difference(cpp.ray, results[i].ray));
            worst.light.x = std::max(worst.light.x, difference(cpp.light, results[i].light));
            worst.shading.x = std::max(worst.shading.x, difference(cpp.shading, results[i].shading));
            worst.surface.x = std::max(worst.surface.x, difference(cpp.surface, results[i].surface));
            worst.layered.x = std::max(worst.layered.x, difference(cpp.layered, results[i].layered));
            worst.soft.x = std::max(worst.soft.x, difference(cpp.soft, results[i].soft));
            worst.rect.x = std::max(worst.rect.x, difference(cpp.rect, results[i].rect));
            worst.refract.x = std::max(worst.refract.x, difference(cpp.refract, results[i].refract));
            worst.normal.x = std::max(worst.normal.x, difference(cpp.normal, results[i].normal));
            worst.texel.x = std::max(worst.texel.x, difference(cpp.texel, results[i].texel));
            const glm::vec4 codes = glm::abs(cpp.display - results[i].display);
            worst.display = glm::max(worst.display, codes);
        }
        EXPECT_GT(lit, 2000);
        EXPECT_LT(worst.ray.x, 1e-5F);
        EXPECT_LT(worst.light.x, 1e-4F);
        EXPECT_LT(worst.shading.x, 1e-3F);
        EXPECT_LT(worst.surface.x, 1e-3F);
        EXPECT_LT(worst.layered.x, 1e-3F);
        EXPECT_LT(worst.soft.x, 1e-3F);
        EXPECT_LT(worst.rect.x, 1e-3F);
        EXPECT_LT(worst.refract.x, 1e-3F);
        EXPECT_LT(worst.normal.x, 1e-4F);
        EXPECT_LT(worst.texel.x, 1e-3F);
        // A value between two codes may round either way.
        for (int c = 0; c < 3; ++c) EXPECT_LE(worst.display[c], 1.0F);
        EXPECT_EQ(worst.display.w, 0.0F);
        std::printf("worst relative differences: ray %.1e light %.1e shading %.1e normal %.1e texel %.1e\n",
                    worst.ray.x, worst.light.x, worst.shading.x, worst.normal.x, worst.texel.x);
        std::printf("  surface %.1e layered %.1e soft %.1e rectangle %.1e refraction %.1e\n", worst.surface.x,
                    worst.layered.x, worst.soft.x, worst.rect.x, worst.refract.x);
    });
    EXPECT_TRUE(read) << read.error().message;
}

INSTANTIATE_TEST_SUITE_P(All, KernelsOnGl, testing::Values(ContextKind::surfaceless, ContextKind::osmesa),
                         [](const auto& kind) {
                             return std::string(kind.param == ContextKind::osmesa ? "osmesa" : "surfaceless");
                         });

}  // namespace
}  // namespace macula
