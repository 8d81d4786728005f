#include "client/options.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "client/parts.h"
#include "client/spec.h"

namespace macula {
namespace {

std::variant<ClientOptions, int> parse(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "macula-client");
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    return parse_client_options(static_cast<int>(pointers.size()), pointers.data());
}

TEST(ClientOptions, CommandLineWinsOverFileWinsOverDefaults) {
    const auto path = std::filesystem::path(testing::TempDir()) / "macula_client_options.toml";
    std::ofstream(path) << "headset = \"vive\"\nseconds = 5\ndisplay = [\"null\", \"png:out\"]\n";
    const auto parsed = parse({"--config", path.string(), "--seconds", "7", "--gaze", "sim:3"});
    std::filesystem::remove(path);
    ASSERT_TRUE(std::holds_alternative<ClientOptions>(parsed));
    const auto& options = std::get<ClientOptions>(parsed);
    EXPECT_EQ(options.headset, "vive");
    EXPECT_EQ(options.seconds, 7.0);
    EXPECT_EQ(options.gaze, "sim:3");
    EXPECT_EQ(options.displays, (std::vector<std::string>{"null", "png:out"}));
    EXPECT_EQ(options.taa, "macula");
    EXPECT_EQ(options.taa_on, "auto");
}

TEST(ClientOptions, SeveralDisplays) {
    const auto parsed = parse({"--display", "null", "--display", "mp4:a.mp4"});
    ASSERT_TRUE(std::holds_alternative<ClientOptions>(parsed));
    EXPECT_EQ(std::get<ClientOptions>(parsed).displays.size(), 2U);
}

TEST(ClientOptions, EachWayOfTemporalAntiAliasing) {
    Display display;
    display.eye_width_px = display.eye_height_px = 64;
    for (const char* taa : {"macula", "paper", "off"}) {
        const auto parsed = parse({"--taa", taa, "--taa-on", "cpu"});
        ASSERT_TRUE(std::holds_alternative<ClientOptions>(parsed)) << taa;
        std::string logged;
        const auto compositor =
            make_compositor(std::get<ClientOptions>(parsed), display, [&](const std::string& line) { logged += line; });
        ASSERT_TRUE(compositor) << compositor.error().message;
        EXPECT_NE(logged.find(taa), std::string::npos) << logged;
        EXPECT_NE(logged.find((*compositor)->name()), std::string::npos) << logged;
    }
}

TEST(Parts, HelloSaysWhetherTheClientAccumulates) {
    const Display display = load_display("desktop").value();
    for (const char* taa : {"macula", "paper", "off"}) {
        ClientOptions options;
        options.taa = taa;
        options.sampling = "41";
        const Hello hello = make_hello(display, options, "secret");
        EXPECT_EQ(hello.accumulates, options.taa != "off") << taa;
        EXPECT_EQ(hello.sampling, "41");
        EXPECT_EQ(hello.token, "secret");
    }
}

TEST(ClientOptions, AStudyChoosesTheSampling) {
    const std::string path = (std::filesystem::path(testing::TempDir()) / "macula_options_study.csv").string();
    const auto parsed = parse({"--study", path, "--study-masks", "54 18", "--study-seed", "9", "--study-spread", "1",
                               "--study-reference", "tiles:full"});
    ASSERT_TRUE(std::holds_alternative<ClientOptions>(parsed));
    auto options = std::get<ClientOptions>(parsed);
    EXPECT_EQ(options.study_settings.masks, (std::vector<std::string>{"54", "18"}));
    EXPECT_EQ(options.study_settings.seed, 9U);
    EXPECT_EQ(options.study_settings.spread_s, 1.0);
    EXPECT_EQ(make_hello(load_display("desktop").value(), options, "").sampling, "tiles:full");
    const auto study = make_study(options);
    ASSERT_TRUE(study) << study.error().message;
    EXPECT_NE(*study, nullptr);
    std::filesystem::remove(path);

    options.sampling = "27";
    EXPECT_EQ(make_study(options).error().code, ErrorCode::option);
    options.sampling.clear();
    options.study = "/nonexistent/study.csv";
    EXPECT_EQ(make_study(options).error().code, ErrorCode::output);
    options.study.clear();
    EXPECT_EQ(*make_study(options), nullptr);
}

TEST(ClientOptions, MistakesHaveTheirExitCode) {
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--no-such-option"},
                                                  {"--taa-on", "fpga"},
                                                  {"--taa-on", "off"},
                                                  {"--taa", "cpu"},
                                                  {"--seconds", "-1"},
                                                  {"--frames", "x"},
                                                  {"--config", "/nonexistent.toml"}}) {
        const auto parsed = parse(wrong);
        ASSERT_TRUE(std::holds_alternative<int>(parsed)) << wrong.front();
        EXPECT_EQ(std::get<int>(parsed), static_cast<int>(ErrorCode::option)) << wrong.front();
    }
    for (const char* only : {"--help", "--version", "--print-config"}) {
        const auto parsed = parse({only});
        ASSERT_TRUE(std::holds_alternative<int>(parsed)) << only;
        EXPECT_EQ(std::get<int>(parsed), 0) << only;
    }
}

TEST(ClientOptions, ServerAddresses) {
    using Address = std::pair<std::string, std::uint16_t>;
    EXPECT_EQ(*parse_server_address("host"), Address("host", 7470));
    EXPECT_EQ(*parse_server_address("host:1"), Address("host", 1));
    EXPECT_EQ(*parse_server_address("10.0.0.1:65535"), Address("10.0.0.1", 65535));
    EXPECT_EQ(*parse_server_address("[::1]:80"), Address("::1", 80));
    EXPECT_EQ(*parse_server_address("[::1]"), Address("::1", 7470));
    EXPECT_EQ(*parse_server_address("fe80::1"), Address("fe80::1", 7470));
    for (const char* wrong : {"", ":80", "host:", "host:0", "host:65536", "host:8x", "a b:1", "[::1", "[]:80"}) {
        const auto address = parse_server_address(wrong);
        ASSERT_FALSE(address) << wrong;
        EXPECT_EQ(address.error().code, ErrorCode::option);
    }
}

TEST(Spec, KindTargetAndSettings) {
    const auto spec = parse_spec("png:some/folder?every=30&x", "--display");
    ASSERT_TRUE(spec);
    EXPECT_EQ(spec->kind, "png");
    EXPECT_EQ(spec->target, "some/folder");
    EXPECT_EQ(spec->settings.at("every"), "30");
    EXPECT_EQ(spec->settings.at("x"), "");
    EXPECT_EQ(*positive_setting(*spec, "every", 1), 30);
    EXPECT_EQ(*positive_setting(*spec, "missing", 4), 4);
    EXPECT_FALSE(positive_setting(*spec, "x", 1));
    EXPECT_FALSE(only_settings(*spec, {"every"}));
    EXPECT_TRUE(only_settings(*spec, {"every", "x"}));
    // A file may be called what it likes, unless it looks like settings.
    EXPECT_EQ(parse_spec("replay:a:b?.csv", "--gaze")->target, "a:b?.csv");
    EXPECT_EQ(parse_spec("null", "--display")->target, "");
    EXPECT_FALSE(parse_spec(":x", "--display"));
}

TEST(Parts, WrongSourcesAndDisplaysAreExplained) {
    const auto nothing = [](const std::string&) {};
    for (const char* wrong : {"", "sim:x", "sim:1?loop", "replay:", "tobii:1", "replay:f?speed=2"}) {
        const auto source = make_source(wrong, nothing);
        ASSERT_FALSE(source) << wrong;
        EXPECT_EQ(source.error().code, ErrorCode::option) << wrong;
    }
    EXPECT_EQ(make_source("replay:/nonexistent.csv", nothing).error().code, ErrorCode::input_file);
    EXPECT_TRUE(make_source("sim:12", nothing));
    EXPECT_TRUE(make_source("sim", nothing));
    for (const char* wrong : {"png:", "mp4", "window:0", "null:x", "png:/tmp/x?every=0", "mp4:/tmp/x?every=2"}) {
        const auto sinks = make_sinks({wrong});
        ASSERT_FALSE(sinks) << wrong;
        EXPECT_EQ(sinks.error().code, ErrorCode::option) << wrong;
    }
    EXPECT_EQ(make_sinks({"null", "null"})->size(), 2U);
}

}  // namespace
}  // namespace macula
