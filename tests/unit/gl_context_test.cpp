// GL contexts of every kind, several at once, on several threads, and the compute programs that run on them.

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "protocol/gl/buffer.h"
#include "protocol/gl/compute.h"
#include "protocol/gl/context.h"
#include "protocol/gl/context_kinds.h"
#include "protocol/gl/functions.h"

namespace macula {
namespace {

constexpr KernelText kTriple = {"triple", R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Input { uint input_values[]; };
layout(std430, binding = 1) writeonly buffer Output { uint output_values[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(output_values.length())) output_values[i] = 3U * input_values[i] + 1U;
}
)"};

/// Runs a program on the context and says what is wrong with the result; empty if nothing is.
std::string run_triple(GlContext& context, std::uint32_t seed) {
    const auto current = CurrentContext::enter(context);
    if (!current) return current.error().message;
    const auto program = ComputeProgram::build(context, std::array{kTriple});
    if (!program) return program.error().message;
    std::vector<std::uint32_t> values(1000);
    std::iota(values.begin(), values.end(), seed);
    StorageBuffer<std::uint32_t> input(context);
    StorageBuffer<std::uint32_t> output(context);
    input.write(values);
    output.resize(values.size());
    input.bind(0);
    output.bind(1);
    program->dispatch(16);
    std::string wrong;
    const auto read = output.read([&](std::span<const std::uint32_t> result) {
        for (std::size_t i = 0; i < values.size(); ++i)
            if (result[i] != 3 * values[i] + 1) wrong = "wrong value at " + std::to_string(i);
    });
    return read ? wrong : read.error().message;
}

class GlContextKinds : public testing::TestWithParam<ContextKind> {};

TEST_P(GlContextKinds, RunsComputeProgram) {
    auto context = make_gl_context(GetParam());
    ASSERT_TRUE(context) << context.error().message;
    EXPECT_FALSE((*context)->renderer().empty());
    EXPECT_FALSE((*context)->kind_name().empty());
    EXPECT_EQ(run_triple(**context, 7), "");
    EXPECT_FALSE((*context)->current_on_this_thread());
}

TEST_P(GlContextKinds, MovesBetweenThreads) {
    auto context = make_gl_context(GetParam());
    ASSERT_TRUE(context) << context.error().message;
    for (std::uint32_t round = 0; round < 4; ++round) {
        std::string wrong = "did not run";
        std::thread([&] { wrong = run_triple(**context, round); }).join();
        EXPECT_EQ(wrong, "");
        EXPECT_EQ(run_triple(**context, round + 100), "");
    }
}

TEST_P(GlContextKinds, ReportsTheLineThatDoesNotCompile) {
    auto context = make_gl_context(GetParam());
    ASSERT_TRUE(context) << context.error().message;
    const auto current = CurrentContext::enter(**context);
    ASSERT_TRUE(current);
    const KernelText declarations = {"declarations.glsl", "layout(local_size_x = 1) in;\n"};
    const KernelText broken = {"kernels/broken.h", "\n// two\nfloat f() { return undeclared_name; }\nvoid main() {}\n"};
    const auto program = ComputeProgram::build(**context, std::array{declarations, broken});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::graphics);
    EXPECT_NE(program.error().message.find("kernels/broken.h:3: float f() { return undeclared_name; }"),
              std::string::npos)
        << program.error().message;
}

TEST_P(GlContextKinds, ReportsAProgramWithoutMain) {
    auto context = make_gl_context(GetParam());
    ASSERT_TRUE(context) << context.error().message;
    const auto current = CurrentContext::enter(**context);
    ASSERT_TRUE(current);
    const auto program =
        ComputeProgram::build(**context, std::array<KernelText, 1>{{{"empty", "layout(local_size_x = 1) in;\n"}}});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::graphics);
}

TEST_P(GlContextKinds, BuffersKeepTheirContentWhenTheyGrowAndMove) {
    auto context = make_gl_context(GetParam());
    ASSERT_TRUE(context) << context.error().message;
    const auto current = CurrentContext::enter(**context);
    ASSERT_TRUE(current);
    StorageBuffer<float> first(**context);
    for (const std::size_t count : {3U, 5000U, 20U}) {
        std::vector<float> values(count);
        std::iota(values.begin(), values.end(), 0.5F);
        first.write(values);
        StorageBuffer<float> moved = std::move(first);
        std::vector<float> back;
        ASSERT_TRUE(moved.read([&](std::span<const float> content) { back.assign(content.begin(), content.end()); }));
        EXPECT_EQ(back, values);
        first = StorageBuffer<float>(**context);
    }
}

std::string test_name(const testing::TestParamInfo<ContextKind>& info) {
    switch (info.param) {
        case ContextKind::automatic:
            return "Automatic";
        case ContextKind::egl:
            return "EglDevice";
        case ContextKind::surfaceless:
            return "EglSurfaceless";
        case ContextKind::osmesa:
            return "OsMesa";
    }
    return "Unknown";
}
INSTANTIATE_TEST_SUITE_P(Any, GlContextKinds,
                         testing::Values(ContextKind::automatic, ContextKind::surfaceless, ContextKind::osmesa),
                         test_name);

TEST(GlContext, EglAndOsMesaLiveInOneProcess) {
    auto surfaceless = make_gl_context(ContextKind::surfaceless);
    auto osmesa = make_gl_context(ContextKind::osmesa);
    auto second_osmesa = make_gl_context(ContextKind::osmesa);
    ASSERT_TRUE(surfaceless) << surfaceless.error().message;
    ASSERT_TRUE(osmesa) << osmesa.error().message;
    ASSERT_TRUE(second_osmesa) << second_osmesa.error().message;
    for (std::uint32_t round = 0; round < 5; ++round)
        for (GlContext* context : {surfaceless->get(), osmesa->get(), second_osmesa->get()})
            EXPECT_EQ(run_triple(*context, round), "") << context->kind_name();
}

TEST(GlContext, OutlivesContextsMadeAfterIt) {
    auto first = make_gl_context(ContextKind::surfaceless);
    ASSERT_TRUE(first) << first.error().message;
    for (const ContextKind kind : {ContextKind::surfaceless, ContextKind::osmesa}) {
        auto later = make_gl_context(kind);
        ASSERT_TRUE(later) << later.error().message;
        EXPECT_EQ(run_triple(**later, 1), "");
        later->reset();
        EXPECT_EQ(run_triple(**first, 2), "");
    }
}

TEST(GlContext, ThreadsWorkAtOnceEachOnItsOwnContext) {
    constexpr std::array<ContextKind, 4> kKinds = {ContextKind::surfaceless, ContextKind::osmesa,
                                                   ContextKind::surfaceless, ContextKind::osmesa};
    std::array<std::string, kKinds.size()> wrong;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < kKinds.size(); ++i)
        threads.emplace_back([&, i] {
            for (std::uint32_t round = 0; round < 5 && wrong[i].empty(); ++round) {
                auto context = make_gl_context(kKinds[i]);
                wrong[i] = context ? run_triple(**context, round) : context.error().message;
            }
        });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& text : wrong) EXPECT_EQ(text, "");
}

TEST(GlContext, ScopesOfOneContextNest) {
    auto context = make_gl_context(ContextKind::surfaceless);
    ASSERT_TRUE(context) << context.error().message;
    {
        const auto outer = CurrentContext::enter(**context);
        ASSERT_TRUE(outer);
        { ASSERT_TRUE(CurrentContext::enter(**context)); }
        EXPECT_TRUE((*context)->current_on_this_thread());
        bool elsewhere = true;
        std::thread([&] { elsewhere = (*context)->current_on_this_thread(); }).join();
        EXPECT_FALSE(elsewhere);
    }
    EXPECT_FALSE((*context)->current_on_this_thread());
}

// The way through EGL_EXT_platform_device, on the software device that Mesa lists beside the hardware.
TEST(GlContext, EglDeviceRunsOnTheSoftwareDevice) {
    auto context = make_egl_device_context(DeviceChoice::software);
    if (!context) GTEST_SKIP() << "no software EGL device here: " << context.error().message;
    EXPECT_TRUE((*context)->software());
    EXPECT_EQ((*context)->kind_name(), "EGL device");
    EXPECT_EQ(run_triple(**context, 3), "");
}

TEST(GlContext, EglDeviceIsHardwareOrAClearError) {
    auto context = make_gl_context(ContextKind::egl);
    if (context) {
        EXPECT_FALSE((*context)->software());
        return;
    }
    EXPECT_EQ(context.error().code, ErrorCode::graphics);
    EXPECT_NE(context.error().message.find("EGL device: "), std::string::npos) << context.error().message;
    EXPECT_NE(context.error().message.find("--context"), std::string::npos) << context.error().message;
}

TEST(GlContext, KindsAreParsed) {
    EXPECT_EQ(parse_context_kind("auto").value(), ContextKind::automatic);
    EXPECT_EQ(parse_context_kind("egl").value(), ContextKind::egl);
    EXPECT_EQ(parse_context_kind("surfaceless").value(), ContextKind::surfaceless);
    EXPECT_EQ(parse_context_kind("osmesa").value(), ContextKind::osmesa);
    const auto wrong = parse_context_kind("glx");
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().code, ErrorCode::option);
    EXPECT_NE(wrong.error().message.find("\"glx\""), std::string::npos);
}

}  // namespace
}  // namespace macula
