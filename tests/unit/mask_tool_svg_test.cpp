// The SVG writer, read back by an XML reader of the tests' own, and pictures in files.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>

#include <OpenImageIO/imageio.h>

#include "masks/tool/grey_picture.h"
#include "masks/tool/output_file.h"
#include "masks/tool/svg.h"
#include "tests/support/program.h"
#include "tests/support/xml.h"

namespace macula {
namespace {

using testing::read_xml;
using testing::TemporaryFolder;
using testing::XmlElement;

std::string content(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

TEST(XmlReader, RefusesWhatIsNotWellFormed) {
    EXPECT_EQ(read_xml("<a b=\"1 &lt; 2\"><c/>d&amp;</a>").front().text, "d&");
    for (const char* wrong : {"", "<a>", "<a></b>", "<a/><b/>", "<a b=c/>", "<a b=\"<\"/>", "<a>&</a>", "<a>&x;</a>",
                              "<a b=\"1\" b=\"2\"/>", "<a b=\"1\"c=\"2\"/>", "text", "<a/>text", "<a", "<1/>"})
        EXPECT_THROW((void)read_xml(wrong), std::runtime_error) << wrong;
}

TEST(SvgNumber, IsShortAndRoundedToAHundredth) {
    EXPECT_EQ(svg_number(0.0), "0");
    EXPECT_EQ(svg_number(-0.001), "0");
    EXPECT_EQ(svg_number(0.1 + 0.2), "0.3");
    EXPECT_EQ(svg_number(-1.5), "-1.5");
    EXPECT_EQ(svg_number(120.0), "120");
    EXPECT_EQ(svg_number(2.0 / 3.0), "0.67");
    EXPECT_EQ(svg_number(10000.25), "10000.25");
}

TEST(SvgWriter, WritesWhatItIsTold) {
    SvgWriter svg(200.0, 100.5, "a < b & \"c\"");
    svg.line({1.0, 2.0}, {3.0, 4.25}, {.stroke = "#ff0000", .stroke_width = 2.0, .dash = "6 3"});
    svg.begin_clip({0.0, 0.0}, {50.0, 50.0});
    svg.begin_clip({10.0, 10.0}, {20.0, 20.0});
    svg.circle({5.0, 6.0}, 7.0, {.fill = "#00ff00", .opacity = 0.5});
    svg.end_clip();
    svg.end_clip();
    const std::vector<glm::dvec2> points = {{0.0, 0.0}, {1.0, 0.5}, {2.0, 1.0}};
    svg.polyline(points, {.stroke = "#000000"});
    svg.polyline(points, {.fill = "#000000"}, true);
    svg.polyline(std::span(points).first(1), {.stroke = "#000000"});
    svg.path("M0 0L1 1", {.stroke = "#000000"});
    svg.text({7.0, 8.0}, "<p> 54 % \x01 \xc2\xb0", {.anchor = SvgText::Anchor::end, .turn_deg = -90.0, .bold = true});
    const std::string document = svg.finish();
    const std::vector<XmlElement> elements = read_xml(document);

    std::map<std::string, std::vector<XmlElement>> by_name;
    for (const XmlElement& element : elements) by_name[element.name].push_back(element);
    EXPECT_EQ(elements.front().name, "svg");
    EXPECT_EQ(elements.front().at("viewBox"), "0 0 200 100.5");
    EXPECT_EQ(elements.front().at("xmlns"), "http://www.w3.org/2000/svg");
    EXPECT_EQ(by_name["title"].at(0).text, "a < b & \"c\"");
    const XmlElement& line = by_name["line"].at(0);
    EXPECT_EQ(line.at("y2"), "4.25");
    EXPECT_EQ(line.at("stroke-dasharray"), "6 3");
    EXPECT_EQ(line.at("fill"), "none");
    const XmlElement& circle = by_name["circle"].at(0);
    EXPECT_EQ(circle.parent, "g");
    EXPECT_EQ(circle.at("opacity"), "0.5");
    EXPECT_FALSE(circle.attributes.contains("stroke"));
    ASSERT_EQ(by_name["clipPath"].size(), 2U);
    EXPECT_NE(by_name["clipPath"][0].at("id"), by_name["clipPath"][1].at("id"));
    ASSERT_EQ(by_name["polyline"].size(), 1U) << "one point is no line";
    EXPECT_EQ(by_name["polyline"][0].at("points"), "0,0 1,0.5 2,1");
    EXPECT_EQ(by_name["polygon"].size(), 1U);
    EXPECT_EQ(by_name["path"].at(0).at("d"), "M0 0L1 1");
    const XmlElement& text = by_name["text"].at(0);
    EXPECT_EQ(text.text, "<p> 54 %  \xc2\xb0");
    EXPECT_EQ(text.at("text-anchor"), "end");
    EXPECT_EQ(text.at("transform"), "rotate(-90 7 8)");
}

/// RFC 4648, section 10.
TEST(SvgWriter, EmbedsPicturesAsBase64) {
    const std::vector<std::pair<std::string, std::string>> cases = {{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, coded] : cases) {
        SvgWriter svg(10.0, 10.0, "");
        const std::vector<std::uint8_t> png(bytes.begin(), bytes.end());
        svg.image({1.0, 2.0}, {3.0, 4.0}, png);
        const XmlElement image = read_xml(svg.finish()).back();
        EXPECT_EQ(image.at("xlink:href"), "data:image/png;base64," + coded);
        EXPECT_EQ(image.at("height"), "4");
    }
}

TEST(GreyPicture, PngHoldsEveryPixel) {
    std::mt19937 random(7);
    GreyPicture picture(37, 21);
    for (std::uint8_t& texel : picture.texels) texel = static_cast<std::uint8_t>(random());
    const auto png = encode_png(picture);
    ASSERT_TRUE(png) << png.error().message;

    const TemporaryFolder folder;
    const std::string path = (folder.path() / "grey.png").string();
    ASSERT_TRUE(write_whole(path, *png));
    const auto input = OIIO::ImageInput::open(path);
    ASSERT_TRUE(input);
    ASSERT_EQ(input->spec().width, 37);
    ASSERT_EQ(input->spec().nchannels, 1);
    std::vector<std::uint8_t> read(picture.texels.size());
    ASSERT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT8, read.data()));
    EXPECT_EQ(read, picture.texels);
}

/// The ink of a line is its length times its width, wherever it lies and whichever way it goes.
TEST(GreyPicture, LinesHaveTheirLengthAndWidth) {
    const unsigned seed = 11;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(5.0, 95.0);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec2 from(place(random), place(random));
        const glm::dvec2 to(place(random), place(random));
        const double width = i % 2 == 0 ? 1.0 : 0.4;
        GreyPicture picture(100, 100, 255);
        draw_line(picture, from, to, width, 0);
        double ink = 0.0;
        for (const std::uint8_t texel : picture.texels) ink += (255.0 - texel) / 255.0;
        const double length = std::hypot(to.x - from.x, to.y - from.y);
        EXPECT_NEAR(ink, length * width, 0.015 * length * width + 0.8) << from.x << ' ' << from.y << ' ' << to.x;
    }
}

TEST(GreyPicture, LinesAreCutOffAtTheEdges) {
    GreyPicture picture(8, 8, 255);
    draw_line(picture, {-100.0, 4.5}, {100.0, 4.5}, 1.0, 0);
    draw_line(picture, {-5.0, -5.0}, {-1.0, -30.0}, 1.0, 0);
    draw_line(picture, {3.0, 3.0}, {3.0, 3.0}, 1.0, 0);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(picture.at(x, y), y == 4 ? 0 : 255) << x << ' ' << y;
}

TEST(OutputFile, AppearsWholeOrNotAtAll) {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "file").string();
    ASSERT_TRUE(write_whole(path, std::string_view("first")));
    ASSERT_TRUE(write_whole(path, std::string_view("second")));
    EXPECT_EQ(content(path), "second");
    EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
    EXPECT_TRUE(check_writable(path));
    EXPECT_TRUE(check_writable("-"));

    // A folder that is in the way is met only at the end.
    const std::string taken = (folder.path() / "taken").string();
    std::filesystem::create_directories(taken + "/inside");
    for (const auto& failed : {write_whole(taken, std::string_view("third")), check_writable(taken),
                               write_whole(path + "/below", std::string_view("")), check_writable(path + "/below")}) {
        ASSERT_FALSE(failed);
        EXPECT_EQ(failed.error().code, ErrorCode::output);
        EXPECT_NE(failed.error().message.find(folder.path().string()), std::string::npos) << failed.error().message;
    }
    EXPECT_FALSE(std::filesystem::exists(taken + ".partial"));
}

}  // namespace
}  // namespace macula
