// The real macula-mask: make, inspect, plot, its cache, and which code it ends with.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <nlohmann/json.hpp>

#include "protocol/base/error.h"
#include "tests/support/program.h"
#include "tests/support/xml.h"

namespace macula {
namespace {

namespace fs = std::filesystem;
using testing::Program;
using testing::TemporaryFolder;

constexpr const char* kMask = MACULA_MASK;

/// A Vive with few pixels.
constexpr const char* kDisplay = R"({"name": "small", "eye_width_px": 100, "eye_height_px": 112, "refresh_hz": 90,
"left": {"tangents": {"left": -1.397283, "right": 1.250510, "bottom": -1.477517, "top": 1.464221},
         "head_from_eye": {"position_m": [-0.0315, 0, 0]}},
"right": {"tangents": {"left": -1.247887, "right": 1.394608, "bottom": -1.477517, "top": 1.464221},
          "head_from_eye": {"position_m": [0.0315, 0, 0]}}})";

std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

class MaskProgram : public ::testing::Test {
protected:
    MaskProgram() : display_(folder_.write("small.json", kDisplay)) {}

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    /// Runs it, expects success, and returns what it wrote.
    std::string succeed(const std::vector<std::string>& arguments) {
        Program mask(kMask, arguments, {"XDG_CACHE_HOME=" + path("cache")});
        EXPECT_EQ(mask.wait(), 0) << mask.output();
        return mask.output();
    }
    /// Runs it, and expects an end with this code and a message that has `part` in it.
    void fail(const std::vector<std::string>& arguments, ErrorCode code, const std::string& part) {
        Program mask(kMask, arguments, {"XDG_CACHE_HOME=" + path("cache")});
        EXPECT_EQ(mask.wait(), static_cast<int>(code)) << mask.output();
        EXPECT_NE(mask.output().find(part), std::string::npos) << part << " in: " << mask.output();
    }
    std::string make(const std::string& name, std::vector<std::string> more = {}) {
        more.insert(more.begin(),
                    {"make", "--display", display_, name.ends_with(".glb") ? "--mesh" : "--mask", path(name)});
        return succeed(more);
    }

    TemporaryFolder folder_;
    std::string display_;
};

TEST_F(MaskProgram, HelpAndVersionEndWell) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--version"}, {"plot", "mesh", "--help"}})
        EXPECT_FALSE(succeed(arguments).empty());
}

TEST_F(MaskProgram, PrintedConfigurationReadsBackTheSame) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"make", "--sampling", "law:e2=3,full=1", "--placement", "quincunx", "--seed", "7"},
          std::vector<std::string>{"plot", "mask", "--display", display_, "--out", path("a.svg"), "--sampling",
                                   "27"}}) {
        std::vector<std::string> first = command;
        first.emplace_back("--print-config");
        const std::string printed = succeed(first);
        const std::string file = folder_.write("mask.toml", printed);
        std::vector<std::string> second = {command[0]};
        if (command[0] == "plot") second.push_back(command[1]);
        second.insert(second.end(), {"--config", file});
        std::vector<std::string> third = second;
        third.emplace_back("--print-config");
        EXPECT_EQ(succeed(third), printed);
        if (command[0] == "plot") succeed(second);  // a list of no files reads back as one
    }
}

/// Made once, found the second time: the cache's file is the same, and the program says where it has it from.
TEST_F(MaskProgram, MakesOnceAndFindsItAgain) {
    const std::string first = make("first.glb", {"--sampling", "paper-54", "--mask", path("first.png")});
    EXPECT_NE(first.find("triangulating"), std::string::npos) << first;
    const fs::path cache = fs::path(path("cache")) / "macula" / "meshes";
    std::vector<fs::path> kept;
    for (const auto& entry : fs::directory_iterator(cache)) kept.push_back(entry.path());
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_NE(first.find(kept[0].string()), std::string::npos) << first;
    const auto time = fs::last_write_time(kept[0]);

    const std::string second = make("second.glb", {"--sampling", "paper-54", "--mask", path("second.png")});
    EXPECT_NE(second.find("reading " + kept[0].string()), std::string::npos) << second;
    EXPECT_EQ(second.find("triangulating"), std::string::npos) << second;
    EXPECT_EQ(fs::last_write_time(kept[0]), time);
    EXPECT_EQ(content(path("first.glb")), content(path("second.glb")));
    EXPECT_EQ(content(path("first.png")), content(path("second.png")));

    // Another recipe is another entry; without the cache, or in a folder of one's own, this one stays as it is.
    make("third.glb", {"--sampling", "paper-54", "--seed", "2"});
    EXPECT_EQ(std::distance(fs::directory_iterator(cache), fs::directory_iterator()), 2);
    const std::string fourth = make("fourth.glb", {"--sampling", "paper-54", "--no-cache"});
    EXPECT_EQ(fourth.find(cache.string()), std::string::npos) << fourth;
    EXPECT_EQ(content(path("fourth.glb")), content(path("first.glb")));
    make("fifth.glb", {"--sampling", "paper-54", "--cache", path("own")});
    EXPECT_EQ(std::distance(fs::directory_iterator(path("own")), fs::directory_iterator()), 1);
    EXPECT_EQ(std::distance(fs::directory_iterator(cache), fs::directory_iterator()), 2);
}

TEST_F(MaskProgram, InspectsWhatItMade) {
    make("mask.glb", {"--sampling", "paper-27", "--mask", path("mask.png"), "--quiet"});
    for (const char* name : {"mask.glb", "mask.png"}) {
        const nlohmann::json json = nlohmann::json::parse(succeed({"inspect", path(name), "--json", "-"}));
        EXPECT_NEAR(json["share_in_window"].get<double>(), 0.27, 0.002);
        EXPECT_EQ(json["width_px"], 200);
        EXPECT_EQ(json["recipe"]["sampling"], "paper-27");
        EXPECT_GT(json["triangles"]["count"], 1000);
        for (const nlohmann::json& ring : json["rings"]) {
            if (ring["pixels"] <= 1000 || ring["to_deg"] > 140.0) continue;  // along the border there are more
            EXPECT_NEAR(ring["ratio"].get<double>(), 1.0, 0.08) << ring;
        }
    }
    const std::string table = succeed({"inspect", path("mask.png"), "--json", path("mask.json"), "--rings", "0,5,10"});
    EXPECT_NE(table.find("of the window"), std::string::npos) << table;
    EXPECT_EQ(nlohmann::json::parse(content(path("mask.json")))["rings"].size(), 2U);
}

TEST_F(MaskProgram, PlotsWhatItMade) {
    make("mask.glb", {"--quiet"});
    const auto count = [](const std::string& file, const std::string& name) {
        return std::ranges::count(testing::read_xml(content(file)), name, &testing::XmlElement::name);
    };
    succeed({"plot", "mesh", path("mask.glb"), "--out", path("mesh.svg")});
    EXPECT_EQ(count(path("mesh.svg"), "path"), 1);
    succeed({"plot", "mask", path("mask.glb"), path("mask.glb"), "--out", path("masks.svg")});
    EXPECT_EQ(count(path("masks.svg"), "image"), 2);
    succeed({"plot", "mask", "--display", display_, "--sampling", "27,full", "--crop", "0,0,50,50", "--panel", "100",
             "--out", path("drawn.png")});
    succeed({"plot", "mesh", path("mask.glb"), "--crop", "mask", "--panel", "320", "--out", path("mesh.png")});
    const auto input = OIIO::ImageInput::open(path("mesh.png"));
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().width, 320);
    const std::string chart =
        succeed({"plot", "cutoff", "--display", display_, "--sampling", "paper-54,hvvr", "--log", "--out", "-"});
    EXPECT_GT(testing::read_xml(chart).size(), 20U);
    EXPECT_NE(chart.find("paper-54 (54.0 %)"), std::string::npos);
}

/// Each kind of error ends with its code; the rest of them is tested without a process for each.
TEST_F(MaskProgram, EndsWithTheCodeOfWhatIsWrong) {
    fail({}, ErrorCode::option, "subcommand");
    fail({"make", "--bogus"}, ErrorCode::option, "--bogus");
    fail({"make", "--mask", path("a.png"), "--sampling", "rods"}, ErrorCode::option, "rods");
    fail({"inspect", path("none.png")}, ErrorCode::input_file, "none.png");
    fail({"plot", "cutoff", "--out", path("no/a.svg")}, ErrorCode::output, "no/a.svg");
}

}  // namespace
}  // namespace macula
