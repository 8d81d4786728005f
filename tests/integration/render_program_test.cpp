// The real macula-render: what it writes, read back, and which code it ends with.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <nlohmann/json.hpp>

#include "protocol/base/error.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/program.h"

namespace macula {
namespace {

using testing::Program;
using testing::TemporaryFolder;

constexpr const char* kRender = MACULA_RENDER;

/// A picture file as floats; 8- and 16-bit values are divided by their largest.
struct ReadPicture {
    OIIO::ImageSpec spec;
    std::vector<float> values;

    explicit ReadPicture(const std::string& path) {
        const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
        if (!input) throw std::runtime_error(path + ": " + OIIO::geterror());
        spec = input->spec();
        values.resize(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
        if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
            throw std::runtime_error(input->geterror());
    }
    [[nodiscard]] float at(int x, int y, int channel) const {
        return values[static_cast<std::size_t>((y * spec.width + x) * spec.nchannels + channel)];
    }
    [[nodiscard]] float at(int x, int y, const std::string& channel) const {
        return at(x, y, spec.channelindex(channel));
    }
};

/// A wall 4 m before the eye, unlit and orange, that fills the left half of the view.
GltfBuilder half_wall() {
    GltfBuilder b;
    const int positions = b.accessor<float>("VEC3", {-100, -100, -4, 0, -100, -4, 0, 100, -4, -100, 100, -4});
    const int indices = b.accessor<std::uint8_t>("SCALAR", {0, 1, 2, 0, 2, 3});
    b.json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", 0}}}}}};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1.0, 0.5, 0.0, 1.0}}}},
                            {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}}};
    b.json["extensionsUsed"] = {"KHR_materials_unlit"};
    b.json["nodes"] = {{{"mesh", 0}}};
    b.json["scenes"] = {{{"nodes", {0}}}};
    b.json["scene"] = 0;
    return b;
}

class RenderProgram : public ::testing::Test {
protected:
    RenderProgram() {
        const Bytes glb = half_wall().glb();
        scene_ = folder_.write("wall.glb", std::string(glb.begin(), glb.end()));
    }
    /// Arguments that render the wall with a small camera at the origin, but for those that `more` has.
    [[nodiscard]] std::vector<std::string> arguments(std::vector<std::string> more) const {
        const std::vector<std::pair<std::string, std::string>> usual = {{"--scene", scene_},
                                                                        {"--camera-fov", "90"},
                                                                        {"--size", "64x48"},
                                                                        {"--out", path("wall")},
                                                                        {"--position", "0,0,0"}};
        std::vector<std::string> all = {"--quiet"};
        for (const auto& [name, value] : usual)
            if (std::ranges::find(more, name) == more.end()) all.insert(all.end(), {name, value});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void expect_success(const std::vector<std::string>& more) {
        Program render(kRender, arguments(more));
        ASSERT_EQ(render.wait(), 0) << render.output();
    }
    void expect_end(const std::vector<std::string>& more, ErrorCode code, const std::string& text) {
        Program render(kRender, more);
        EXPECT_EQ(render.wait(), static_cast<int>(code)) << render.output();
        EXPECT_NE(render.output().find(text), std::string::npos) << render.output();
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    [[nodiscard]] nlohmann::json read_json(const std::string& name) const {
        return nlohmann::json::parse(std::ifstream(path(name)));
    }

    TemporaryFolder folder_;
    std::string scene_;
};

TEST_F(RenderProgram, HelpAndVersionEndWell) {
    for (const char* option : {"--help", "--version"}) {
        Program render(kRender, {option});
        EXPECT_EQ(render.wait(), 0);
        EXPECT_NE(render.output().find("macula-render"), std::string::npos);
    }
}

TEST_F(RenderProgram, PrintedConfigurationReadsBackTheSame) {
    Program first(kRender, {"--scene", "a.glb", "--spp", "9", "--position", "1,2,3", "--write", "color,depth",
                            "--sampling", "law:e2=3,full=1", "--print-config"});
    ASSERT_EQ(first.wait(), 0) << first.output();
    const std::string file = folder_.write("render.toml", first.output());
    Program second(kRender, {"--config", file, "--print-config"});
    ASSERT_EQ(second.wait(), 0) << second.output();
    EXPECT_EQ(first.output(), second.output());
    EXPECT_NE(second.output().find("law:e2=3,full=1"), std::string::npos) << second.output();
    EXPECT_NE(second.output().find("1,2,3"), std::string::npos) << second.output();
}

TEST_F(RenderProgram, WritesPngLayers) {
    expect_success({"--write", "color,depth,object,positions,levels", "--json", path("wall.json")});
    const nlohmann::json json = read_json("wall.json");
    ASSERT_EQ(json["files"].size(), 5U);
    double m_per_unit = 0.0;
    for (const nlohmann::json& file : json["files"])
        if (file["layer"] == "depth") m_per_unit = file["depth_m_per_unit"];

    const ReadPicture color(path("wall_color.png"));
    const ReadPicture depth(path("wall_depth.png"));
    const ReadPicture object(path("wall_object.png"));
    const ReadPicture positions(path("wall_positions.png"));
    const ReadPicture levels(path("wall_levels.png"));
    EXPECT_EQ(color.spec.width, 64);
    EXPECT_EQ(color.spec.height, 48);
    EXPECT_EQ(depth.spec.format, OIIO::TypeDesc::UINT16);
    const std::string description = depth.spec.get_string_attribute("ImageDescription");
    EXPECT_NE(description.find(" m per unit"), std::string::npos) << description;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool wall = x < 32;
            EXPECT_NEAR(depth.at(x, y, 0) * 65535.0 * m_per_unit, wall ? 4.0 : 0.0, m_per_unit);
            EXPECT_EQ(object.at(x, y, 0) + object.at(x, y, 1) + object.at(x, y, 2) > 0.0F, wall);
            EXPECT_EQ(positions.at(x, y, 0), 1.0F);
            EXPECT_EQ(levels.at(x, y, 0), 1.0F);
            if (!wall) continue;
            EXPECT_EQ(color.at(x, y, 0), 1.0F);
            EXPECT_NEAR(color.at(x, y, 1), 188.0F / 255.0F, 1e-6F);  // sRGB of a half
            EXPECT_EQ(color.at(x, y, 2), 0.0F);
        }
    }
}

TEST_F(RenderProgram, WritesOneExr) {
    expect_success({"--write", "color,depth,object,positions,levels", "--format", "exr", "--spp", "4"});
    const ReadPicture picture(path("wall.exr"));
    EXPECT_EQ(picture.spec.nchannels, 7);
    EXPECT_EQ(picture.spec.channelformat(picture.spec.channelindex("object")), OIIO::TypeDesc::UINT32);
    EXPECT_EQ(picture.spec.get_float_attribute("macula:exposure"), 1.0F);
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool wall = x < 32;
            EXPECT_EQ(picture.at(x, y, "Z"), wall ? 4.0F : INFINITY);
            EXPECT_EQ(picture.at(x, y, "positions"), 1.0F);
            EXPECT_EQ(picture.at(x, y, "levels"), 256.0F);
            if (!wall) continue;
            EXPECT_EQ(picture.at(x, y, "R"), 1.0F);
            EXPECT_EQ(picture.at(x, y, "G"), 0.5F);
            EXPECT_EQ(picture.at(x, y, "B"), 0.0F);
        }
    }
    // OpenImageIO scales integers that are read as floats; read as they are, they are ids.
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path("wall.exr"));
    const int channel = input->spec().channelindex("object");
    std::vector<std::uint32_t> id(64 * 48);
    ASSERT_TRUE(input->read_image(0, 0, channel, channel + 1, OIIO::TypeDesc::UINT32, id.data()));
    for (int i = 0; i < 64 * 48; ++i) EXPECT_EQ(id[static_cast<std::size_t>(i)], i % 64 < 32 ? 1U : 0U);
}

TEST_F(RenderProgram, ADisplayIsReconstructedForBothEyes) {
    expect_success({"--camera-fov", "0", "--display", "desktop", "--sampling", "18", "--write", "color,positions",
                    "--json", path("wall.json"), "--repeat", "2"});
    const nlohmann::json json = read_json("wall.json");
    ASSERT_EQ(json["pictures"].size(), 2U);
    for (const nlohmann::json& picture : json["pictures"]) {
        EXPECT_NEAR(picture["share"].get<double>(), 0.18, 0.01);
        EXPECT_GE(picture["samples"], picture["samples_in_window"]);
    }
    EXPECT_EQ(json["rays"]["primary"],
              json["pictures"][0]["samples"].get<int>() + json["pictures"][1]["samples"].get<int>());
    EXPECT_GT(json["times_ms"]["trace"]["p50"], 0.0);
    EXPECT_GE(json["times_ms"]["trace"]["p99"], json["times_ms"]["trace"]["p50"]);
    for (const char* eye : {"left", "right"}) {
        const ReadPicture color(path(std::string("wall_") + eye + "_color.png"));
        const ReadPicture positions(path(std::string("wall_") + eye + "_positions.png"));
        EXPECT_EQ(color.spec.width, 756);
        double traced = 0.0;
        for (const float value : positions.values) traced += value;
        EXPECT_NEAR(traced / (756.0 * 840.0), 0.18, 0.01);
        // Left of the middle is wall, also where no pixel was traced.
        for (int y = 200; y < 600; ++y) EXPECT_EQ(color.at(200, y, 0), 1.0F);
    }
}

TEST_F(RenderProgram, ExplainsTheScene) {
    Program render(kRender, arguments({"--explain-scene"}));
    EXPECT_EQ(render.wait(), 0);
    EXPECT_NE(render.output().find("textures"), std::string::npos) << render.output();
}

TEST_F(RenderProgram, JsonGoesToStandardOutputAlone) {
    Program render(kRender, arguments({"--json", "-"}));
    ASSERT_EQ(render.wait(), 0) << render.output();
    const nlohmann::json json = nlohmann::json::parse(render.output());
    EXPECT_EQ(json["scene"]["triangles"], 2);
    EXPECT_EQ(json["rays"]["primary"], 64 * 48);
}

TEST_F(RenderProgram, SaysWhatIsWrong) {
    expect_end({"--bogus"}, ErrorCode::option, "--bogus");
    expect_end({"--spp", "0"}, ErrorCode::option, "--spp");
    expect_end({"--eye", "third"}, ErrorCode::option, "--eye");
    expect_end({"--format", "jpeg"}, ErrorCode::option, "--format");
    expect_end({"--write", "colour"}, ErrorCode::option, "colour");
    expect_end({"--camera-fov", "60", "--size", "8x8"}, ErrorCode::option, "--size");
    expect_end({"--display", "monocle"}, ErrorCode::option, "monocle");
    expect_end({"--display", "/no/such/display.json"}, ErrorCode::input_file, "/no/such/display.json");
    expect_end({"--scene", "no-such-scene"}, ErrorCode::option, "no-such-scene");
    expect_end({"--scene", "/no/such/scene.gltf"}, ErrorCode::input_file, "/no/such/scene.gltf");
    expect_end(arguments({"--environment", "/no/such/sky.exr"}), ErrorCode::input_file, "/no/such/sky.exr");
    expect_end(arguments({"--camera", "nobody"}), ErrorCode::option, "nobody");
    expect_end(arguments({"--out", "/no/such/folder/x"}), ErrorCode::output, "/no/such/folder/x_color.png");
    expect_end(arguments({"--json", "/no/such/folder/x.json"}), ErrorCode::output, "/no/such/folder/x.json");
}

}  // namespace
}  // namespace macula
