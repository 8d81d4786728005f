#include "masks/display.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <numeric>
#include <sstream>

#include <gtest/gtest.h>

#include "masks/display_file.h"

namespace macula {
namespace {

double hidden_share(const Display& display, Eye eye) {
    const std::vector<std::uint8_t> hidden = hidden_pixels(display, eye);
    EXPECT_EQ(hidden.size(), static_cast<std::size_t>(display.eye_width_px) * display.eye_height_px);
    return std::accumulate(hidden.begin(), hidden.end(), 0.0) / static_cast<double>(hidden.size());
}

TEST(BuiltInDisplay, ViveHasThePublishedGeometry) {
    const Display vive = load_display("vive").value();
    EXPECT_EQ(vive.eye_width_px, 1512);
    EXPECT_EQ(vive.eye_height_px, 1680);
    EXPECT_EQ(vive.refresh_hz, 90.0F);
    const Tangents& left = vive.eyes[kLeftEye].tangents;
    const Tangents& right = vive.eyes[kRightEye].tangents;
    const auto degrees = [](float from, float to) {
        return (std::atan(to) - std::atan(from)) * 180.0 / std::numbers::pi;
    };
    EXPECT_NEAR(degrees(left.left, left.right), 105.8, 0.2);
    EXPECT_NEAR(degrees(left.bottom, left.top), 111.6, 0.1);
    EXPECT_NEAR(degrees(left.left, right.right), 108.8, 0.1);    // both eyes
    EXPECT_NEAR(1512 / (left.right - left.left), 571.04, 0.01);  // px per unit tangent
    const glm::vec3 between =
        vive.eyes[kRightEye].head_from_eye.position_m - vive.eyes[kLeftEye].head_from_eye.position_m;
    EXPECT_NEAR(between.x, 0.063, 1e-6);
    EXPECT_EQ(between.y, 0.0F);
    EXPECT_EQ(between.z, 0.0F);
}

TEST(BuiltInDisplay, HidesThePublishedShare) {
    for (const char* name : {"vive", "desktop"}) {
        const Display display = load_display(name).value();
        for (const Eye eye : {kLeftEye, kRightEye}) EXPECT_NEAR(hidden_share(display, eye), 0.191, 0.0005) << name;
    }
}

TEST(BuiltInDisplay, DesktopHasTheSameOptics) {
    const Display vive = load_display("vive").value();
    const Display desktop = load_display("desktop").value();
    EXPECT_EQ(desktop.eye_width_px * 2, vive.eye_width_px);
    EXPECT_EQ(desktop.eye_height_px * 2, vive.eye_height_px);
    for (const Eye eye : {kLeftEye, kRightEye}) {
        EXPECT_EQ(desktop.eyes[eye].tangents.left, vive.eyes[eye].tangents.left);
        EXPECT_EQ(desktop.eyes[eye].visible_outline, vive.eyes[eye].visible_outline);
    }
}

TEST(BuiltInDisplay, UnknownNamesAreRefusedWithTheChoice) {
    const auto loaded = load_display("rift");
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().code, ErrorCode::option);
    EXPECT_NE(loaded.error().message.find("vive, desktop"), std::string::npos) << loaded.error().message;
}

/// Whether a point is inside a polygon, by the winding of a ray to the right.
bool inside(const std::vector<glm::vec2>& polygon, const glm::dvec2& p) {
    bool odd = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a(polygon[i]);
        const glm::dvec2 b(polygon[(i + 1) % polygon.size()]);
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
    }
    return odd;
}

TEST(HiddenPixels, AreThoseWhoseCentresLieOutsideTheOutline) {
    Display display{"star", 100, 64, 90.0F, {}};
    EyeDisplay& eye = display.eyes[kRightEye];
    eye.tangents = {-1.0F, 1.5F, -0.8F, 0.7F};
    for (int i = 0; i < 5; ++i) {  // a star: concave and with a hole by the even-odd rule
        const float angle = 4.0F * std::numbers::pi_v<float> * static_cast<float>(i) / 5.0F + 0.3F;
        eye.visible_outline.emplace_back(1.2F * std::cos(angle), 0.9F * std::sin(angle));
    }
    const std::vector<std::uint8_t> hidden = hidden_pixels(display, kRightEye);
    int visible = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 100; ++x) {
            const glm::dvec2 centre(-1.0 + (x + 0.5) / 100 * 2.5,
                                    double{0.7F} - (y + 0.5) / 64 * (double{0.7F} + 0.8F));
            EXPECT_EQ(hidden[y * 100 + x] == 0, inside(eye.visible_outline, centre)) << x << ", " << y;
            visible += hidden[y * 100 + x] == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(visible, 1000);
    EXPECT_EQ(hidden_share(display, kLeftEye), 0.0) << "no outline hides nothing";
}

std::string read(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// The JSON example of masks/display.md.
std::string documented_example() {
    const std::string text = read(std::filesystem::path(MACULA_SOURCE_DIR) / "masks/display.md");
    const std::size_t begin = text.find("```json\n") + 8;
    return text.substr(begin, text.find("```", begin) - begin);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(DisplayFile, TheDocumentedExampleIsRead) {
    const auto path = std::filesystem::path(testing::TempDir()) / "macula_display_test.json";
    std::ofstream(path) << documented_example();
    const auto display = load_display(path.string());
    std::filesystem::remove(path);
    ASSERT_TRUE(display) << display.error().message;
    EXPECT_EQ(display->name, "example");
    EXPECT_EQ(display->eye_width_px, 1440);
    EXPECT_EQ(display->eyes[kLeftEye].tangents.right, 1.05F);
    EXPECT_EQ(display->eyes[kLeftEye].head_from_eye.orientation.w, 0.9990482F);
    EXPECT_EQ(display->eyes[kRightEye].head_from_eye.orientation.y, -0.0436194F);
    ASSERT_EQ(display->eyes[kRightEye].visible_outline.size(), 8U);
    EXPECT_EQ(display->eyes[kRightEye].visible_outline[1], glm::vec2(0.7F, -1.3F));
}

TEST(DisplayFile, WrongFieldsAreNamedWithTheFile) {
    const std::string good = documented_example();
    ASSERT_TRUE(parse_display(good, "good.json"));
    const std::vector<std::tuple<std::string, std::string, std::string>> cases = {
        {"\"name\": \"example\"", "\"name\": 5", "name"},
        {"\"eye_width_px\": 1440,", "", "eye_width_px"},
        {"1440", "1441", "eye_width_px"},
        {"1440", "1e300", "eye_width_px"},
        {"1440", "99999999999999999999", "eye_width_px"},
        {"1440", "-1440", "eye_width_px"},
        {"\"refresh_hz\": 90", "\"refresh_hz\": 0", "refresh_hz"},
        {"\"refresh_hz\"", "\"refresh\"", "refresh"},
        {"\"bottom\": -1.3", "\"bottom\": null", "left.tangents.bottom"},
        {"\"bottom\": -1.3", "\"bottom\": 1.3", "left tangents"},
        {"\"left\": -1.25", "\"left\": -1e999", ""},  // no number at all to the parser
        {"[-0.0315, 0, 0]", "[-0.0315, 0]", "left.head_from_eye.position_m"},
        {"[-0.0315, 0, 0]", "[-31.5, 0, 0]", "left head_from_eye position"},
        {"[0, 0.0436194, 0, 0.9990482]", "[0, 1, 0, 1]", "left head_from_eye orientation"},
        {"[1.25, -0.7]", "[1.25, -0.7, 0]", "right.visible_outline[0]"},
        {"[1.25, -0.7]", "[1.25, \"a\"]", "right.visible_outline[0][1]"},
        {"[1.25, -0.7]", "[1.25, 1e9]", "right visible_outline"},
        {"\"right\": {\n", "\"right\": {\"extra\": 1,\n", "right.extra"},
    };
    for (const auto& [from, to, field] : cases) {
        const auto display = parse_display(replaced(good, from, to), "my.json");
        ASSERT_FALSE(display) << to;
        EXPECT_EQ(display.error().code, ErrorCode::input_file);
        EXPECT_NE(display.error().message.find("my.json"), std::string::npos) << display.error().message;
        EXPECT_NE(display.error().message.find(field), std::string::npos) << display.error().message;
    }
}

TEST(DisplayFile, OtherFilesAreRefused) {
    for (const char* text : {"", "{", "[]", "null", "{}", "\xff\xfe", "{\"left\": {\"tangents\": []}}"}) {
        const auto display = parse_display(text, "odd.json");
        ASSERT_FALSE(display) << text;
        EXPECT_NE(display.error().message.find("odd.json"), std::string::npos);
    }
    for (const std::string& path : {std::string("/nonexistent/display.json"), testing::TempDir()}) {
        const auto display = load_display(path);
        ASSERT_FALSE(display);
        EXPECT_EQ(display.error().code, ErrorCode::input_file);
        EXPECT_NE(display.error().message.find(path), std::string::npos) << display.error().message;
    }
}

TEST(ValidateDisplay, NamesTheFieldOfAMessage) {
    const Display good = load_display("desktop").value();
    EXPECT_TRUE(validate_display(good));
    const auto expect_fault = [&good](const std::string& field, auto spoil) {
        Display display = good;
        spoil(display);
        const auto valid = validate_display(display);
        ASSERT_FALSE(valid) << field;
        EXPECT_EQ(valid.error().code, ErrorCode::protocol);
        EXPECT_NE(valid.error().message.find(field), std::string::npos) << valid.error().message;
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    expect_fault("eye_height_px", [](Display& d) { d.eye_height_px = 8192; });
    expect_fault("refresh_hz", [](Display& d) { d.refresh_hz = kNan; });
    expect_fault("left tangents", [](Display& d) { d.eyes[kLeftEye].tangents.top = kNan; });
    expect_fault("right tangents", [](Display& d) { d.eyes[kRightEye].tangents.left = 1.394608F; });
    expect_fault("right head_from_eye position",
                 [](Display& d) { d.eyes[kRightEye].head_from_eye.position_m.z = kNan; });
    expect_fault("left head_from_eye orientation",
                 [](Display& d) { d.eyes[kLeftEye].head_from_eye.orientation.w = 2; });
    expect_fault("left visible_outline", [](Display& d) { d.eyes[kLeftEye].visible_outline.resize(2); });
    expect_fault("left visible_outline", [](Display& d) { d.eyes[kLeftEye].visible_outline.resize(1025); });
    expect_fault("left visible_outline", [](Display& d) { d.eyes[kLeftEye].visible_outline[3].y = kNan; });
}

}  // namespace
}  // namespace macula
