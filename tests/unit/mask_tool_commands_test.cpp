// The commands of macula-mask without its process: users' own pictures, and all that can be wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <OpenImageIO/imageio.h>

#include "masks/make/mask.h"
#include "masks/mesh/mesh_file.h"
#include "masks/tool/commands.h"
#include "tests/support/program.h"

namespace macula {
namespace {

namespace fs = std::filesystem;

/// A Vive with few square pixels, so many that the axis lies near 53, 56.
std::string display_json(int width_px, int height_px) {
    const std::string eye = R"({"tangents": {"left": -1.4, "right": 1.25, "bottom": -1.48, "top": 1.46},
                                "head_from_eye": {"position_m": [0, 0, 0]}})";
    return R"({"name": "small", "refresh_hz": 90, "eye_width_px": )" + std::to_string(width_px) +
           R"(, "eye_height_px": )" + std::to_string(height_px) + R"(, "left": )" + eye + R"(, "right": )" + eye + "}";
}

class MaskCommands : public ::testing::Test {
protected:
    MaskCommands() : display_(folder_.write("small.json", display_json(100, 112))) {}

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

    [[nodiscard]] MakeOptions make(const std::string& name) const {
        MakeOptions options;
        options.recipe.display = display_;
        (name.ends_with(".glb") ? options.mesh : options.mask) = path(name);
        options.no_cache = true;
        options.quiet = true;
        return options;
    }
    [[nodiscard]] MakeOptions make_from(const std::string& png, const std::string& name) const {
        MakeOptions options = make(name);
        options.from = path(png);
        return options;
    }

    /// A PNG that says nothing but black and white: every so many pixels of a row or column one is sampled.
    void write_png(const std::string& name, int width_px, int height_px, int every) const {
        std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width_px) * height_px);
        for (int y = 0; y < height_px; y += every)
            for (int x = 0; x < width_px; x += every) pixels[static_cast<std::size_t>(y * width_px + x)] = 255;
        const auto output = OIIO::ImageOutput::create("png");
        ASSERT_TRUE(output->open(path(name), OIIO::ImageSpec(width_px, height_px, 1, OIIO::TypeDesc::UINT8)));
        ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && output->close());
    }

    /// The names of all files in the folder.
    [[nodiscard]] std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path())) names.push_back(entry.path().filename());
        std::ranges::sort(names);
        return names;
    }

    /// Runs a command, expects this error with `part` in its message, and no file more than before.
    template <class Options>
    void expect_error(const Options& options, ErrorCode code, const std::string& part) const {
        SCOPED_TRACE(part);
        const std::vector<std::string> before = files();
        const auto outcome = run(options);
        ASSERT_FALSE(outcome);
        EXPECT_EQ(outcome.error().code, code);
        EXPECT_NE(outcome.error().message.find(part), std::string::npos) << outcome.error().message;
        EXPECT_EQ(files(), before);
    }

    testing::TemporaryFolder folder_;
    std::string display_;
};

TEST_F(MaskCommands, AnyPngBecomesAMesh) {
    write_png("own.png", 220, 240, 3);
    MakeOptions options = make_from("own.png", "own.glb");
    options.gaze = "109,118";
    const auto outcome = run(options);
    ASSERT_TRUE(outcome) << outcome.error().message;
    const SampleMesh mesh = read_mesh(path("own.glb")).value();
    EXPECT_EQ(mesh.gaze_px, glm::ivec2(109, 118));
    EXPECT_EQ(mesh.width_px, 220);
    EXPECT_TRUE(mesh.recipe.empty());
    const auto sampled = [](const SamplePosition& site) { return site.x_px % 3 == 0 && site.y_px % 3 == 0; };
    EXPECT_EQ(std::ranges::count_if(mesh.site, sampled), 74 * 80);

    // A PNG of ours says itself where its gaze is and how it was made; it comes back the same.
    ASSERT_TRUE(run(make("first.png")));
    ASSERT_TRUE(run(make_from("first.png", "second.png")));
    const Mask first = read_mask_png(path("first.png")).value();
    const Mask second = read_mask_png(path("second.png")).value();
    EXPECT_EQ(first.sampled, second.sampled);
    EXPECT_EQ(first.recipe, second.recipe);
    EXPECT_FALSE(first.recipe.empty());
}

TEST_F(MaskCommands, MasksMustCoverTheWindow) {
    // Room for the gaze on the axis alone, and then not even for that.
    write_png("narrow.png", 112, 116, 3);
    EXPECT_TRUE(run(make_from("narrow.png", "narrow.png.out.png")));
    write_png("low.png", 112, 111, 3);
    expect_error(make_from("low.png", "low.glb"), ErrorCode::input_file, "low.png of 112 x 111");
    MakeOptions off = make_from("narrow.png", "off.png");
    off.gaze = "10,56";
    expect_error(off, ErrorCode::input_file, "10,56");
    for (const char* gaze : {"112,0", "0,-1", "x", "1"}) {
        off.gaze = gaze;
        expect_error(off, ErrorCode::option, gaze);
    }
}

/// Gaps that no pixel can reach across are found now, not when a server starts.
TEST_F(MaskCommands, MasksMustNotHaveGaps) {
    write_png("sparse.png", 640, 640, 319);
    expect_error(make_from("sparse.png", "sparse.glb"), ErrorCode::input_file, "sparse.png");
}

TEST_F(MaskCommands, MakeNamesWhatIsWrong) {
    MakeOptions options = make("a.png");
    options.mask.clear();
    expect_error(options, ErrorCode::option, "--mask");
    expect_error(make("a.jpg"), ErrorCode::option, "a.jpg");
    options = make("a.png");
    options.mesh = path("b.png");
    expect_error(options, ErrorCode::option, "b.png");
    expect_error(make("no/a.png"), ErrorCode::output, "no/a.png");
    options = make("a.glb");
    options.recipe.sampling = "rods";
    expect_error(options, ErrorCode::option, "rods");
    options = make("a.glb");
    options.recipe.display = path("none.json");
    expect_error(options, ErrorCode::input_file, "none.json");
    options = make("a.glb");
    options.recipe.sampling = "1";
    expect_error(options, ErrorCode::option, "'1'");  // below the least that a mask has everywhere
    fs::create_directory(path("taken.png"));
    expect_error(make("taken.png"), ErrorCode::output, "taken.png");
    std::ofstream(path("broken.png")) << "no picture";
    expect_error(make_from("broken.png", "a.png"), ErrorCode::input_file, "broken.png");
}

TEST_F(MaskCommands, InspectNamesWhatIsWrong) {
    ASSERT_TRUE(run(make("mask.png")));
    write_png("own.png", 220, 240, 3);
    std::ofstream(path("broken.glb")) << "no mesh";
    const auto inspect = [this](const std::string& name) {
        InspectOptions options;
        options.file = path(name);
        return options;
    };
    expect_error(inspect("none.png"), ErrorCode::input_file, "none.png");
    expect_error(inspect("broken.glb"), ErrorCode::input_file, "broken.glb");
    expect_error(inspect("small.json"), ErrorCode::input_file, "small.json");
    expect_error(inspect("own.png"), ErrorCode::option, "--display");
    InspectOptions options = inspect("mask.png");
    options.json = path("no/a.json");
    expect_error(options, ErrorCode::output, "no/a.json");
    options = inspect("mask.png");
    options.sampling = "rods";
    expect_error(options, ErrorCode::option, "rods");
    options = inspect("own.png");
    options.display = display_;
    options.geometry = "round";
    expect_error(options, ErrorCode::option, "round");
    for (const char* rings : {"5,3", "5", "0,200", "-1,3", "0,,5", "a,b", "0,0"}) {
        options = inspect("mask.png");
        options.rings = rings;
        expect_error(options, ErrorCode::option, rings);
    }
}

TEST_F(MaskCommands, PlotNamesWhatIsWrong) {
    CutoffPlotOptions cutoff;
    cutoff.recipe.display = display_;
    cutoff.recipe.sampling = "watson,rods";
    cutoff.out = path("a.svg");
    expect_error(cutoff, ErrorCode::option, "rods");
    cutoff.out = path("a.png");
    expect_error(cutoff, ErrorCode::option, "a.png");
    cutoff.out = path("no/a.svg");
    expect_error(cutoff, ErrorCode::output, "no/a.svg");

    MaskPlotOptions mask;
    mask.recipe.display = display_;
    mask.recipe.sampling = "27";
    mask.quiet = true;
    mask.picture.out = path("a.gif");
    expect_error(mask, ErrorCode::option, "a.gif");
    mask.picture.out = path("a.svg");
    mask.picture.crop = "190,0,20,20";
    expect_error(mask, ErrorCode::option, "--crop 190,0,20,20");
    mask.files = {path("none.png")};
    expect_error(mask, ErrorCode::input_file, "none.png");
}

/// Too many lines for a file that anyone can open are refused, with what to do instead.
TEST_F(MaskCommands, LargeMeshesAreNotDrawnAsLines) {
    MakeOptions options = make("large.glb");
    options.recipe.display = folder_.write("large.json", display_json(256, 256));
    options.recipe.sampling = "full";
    ASSERT_TRUE(run(options));
    MeshPlotOptions plot;
    plot.file = path("large.glb");
    plot.quiet = true;
    plot.picture.out = path("a.svg");
    expect_error(plot, ErrorCode::option, "--crop");
    plot.picture.crop = "0,0,64,64";
    EXPECT_TRUE(run(plot));
    EXPECT_LT(fs::file_size(path("a.svg")), std::size_t{1} << 20);
    plot.picture.crop = "window";
    plot.picture.out = path("a.png");
    EXPECT_TRUE(run(plot));
    EXPECT_TRUE(fs::exists(path("a.png")));
}

}  // namespace
}  // namespace macula
