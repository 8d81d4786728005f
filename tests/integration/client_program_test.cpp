// The real macula-client: what it says, which code it ends with, and what it is made of.

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/base/error.h"
#include "tests/support/program.h"

namespace macula {
namespace {

using testing::Program;
using testing::TemporaryFolder;

constexpr const char* kClient = MACULA_CLIENT;
/// A client that finds nobody: no test machine listens on the port of "discard".
std::vector<std::string> arguments(const std::vector<std::string>& more = {}) {
    const std::vector<std::pair<std::string, std::string>> usual = {
        {"--connect", "127.0.0.1:9"},
        {"--retry-seconds", "0"},
        {"--taa-on", "cpu"},
        {"--token", std::string(32, 't')},
        {"--fingerprint",
         "00:11:22:33:44:55:66:77:88:99:AA:BB:CC:DD:EE:FF:00:11:22:33:44:55:66:77:88:99:AA:BB:CC:DD:EE:FF"}};
    std::vector<std::string> all = more;
    for (const auto& [name, value] : usual) {
        if (std::ranges::find(more, name) == more.end()) all.insert(all.end(), {name, value});
    }
    return all;
}

class ClientProgram : public ::testing::Test {
protected:
    void expect_end(const std::vector<std::string>& more, ErrorCode code, const std::string& text) const {
        Program client(kClient, arguments(more));
        const auto exit_code = client.wait();
        ASSERT_TRUE(exit_code) << "still runs: " << client.output();
        EXPECT_EQ(*exit_code, static_cast<int>(code)) << client.output();
        EXPECT_NE(client.output().find(text), std::string::npos) << client.output();
    }
    TemporaryFolder folder_;
};

TEST_F(ClientProgram, RecordsWithoutAServer) {
    const std::string path = (folder_.path() / "sim.csv").string();
    expect_end({"--connect", "none"}, ErrorCode::option, "--record");
    Program client(kClient, {"--connect", "none", "--gaze", "sim:3", "--seconds", "2", "--record", path});
    EXPECT_EQ(client.wait(), 0) << client.output();
    // What it wrote is a recording: a client without a server reads it and then finds nobody.
    expect_end({"--gaze", "replay:" + path}, ErrorCode::network, "recording");
    std::ifstream file(path);
    EXPECT_GT(std::count(std::istreambuf_iterator<char>(file), {}, '\n'), 200);
}

TEST_F(ClientProgram, SaysWhatIsWrong) {
    expect_end({}, ErrorCode::network, "127.0.0.1");
    expect_end({"--gaze", "replay:/nonexistent.csv"}, ErrorCode::input_file, "/nonexistent.csv");
    expect_end({"--gaze", "replay:" + folder_.write("r.csv", "time_ns\n1\n")}, ErrorCode::input_file, "r.csv:1");
    expect_end({"--gaze", "telepathy"}, ErrorCode::option, "telepathy");
    expect_end({"--headset", "/nonexistent.json"}, ErrorCode::input_file, "/nonexistent.json");
    expect_end({"--headset", "monocle"}, ErrorCode::option, "monocle");
    expect_end({"--display", "png:/proc/macula"}, ErrorCode::output, "/proc/macula");
    expect_end({"--display", "mp4:/nonexistent/v.mp4"}, ErrorCode::output, "/nonexistent/v.mp4");
    expect_end({"--record", "/nonexistent/r.csv"}, ErrorCode::output, "/nonexistent/r.csv");
    expect_end({"--stats", "/nonexistent/s.csv"}, ErrorCode::output, "/nonexistent/s.csv");
    expect_end({"--connect", "host:99999"}, ErrorCode::option, "host:99999");
    expect_end({"--fingerprint", "00"}, ErrorCode::option, "fingerprint");
}

TEST_F(ClientProgram, WithoutCredentialsSaysWhereTheyComeFrom) {
    Program client(kClient, {"--state", (folder_.path() / "none").string(), "--taa-on", "cpu"});
    const auto exit_code = client.wait();
    ASSERT_TRUE(exit_code);
    EXPECT_EQ(*exit_code, static_cast<int>(ErrorCode::input_file)) << client.output();
    EXPECT_NE(client.output().find("--fingerprint"), std::string::npos) << client.output();
}

TEST_F(ClientProgram, ASignalEndsItWithItsSummary) {
    Program client(kClient, arguments({"--retry-seconds", "600"}));
    ASSERT_TRUE(client.wait_for_output("(trying again)")) << client.output();
    client.signal(SIGTERM);
    const auto exit_code = client.wait();
    ASSERT_TRUE(exit_code) << client.output();
    EXPECT_EQ(*exit_code, 0) << client.output();
    EXPECT_NE(client.output().find("frames shown"), std::string::npos) << client.output();
}

TEST_F(ClientProgram, PrintsAConfigurationThatItReads) {
    Program print(kClient, {"--gaze", "sim:77", "--print-config"});
    ASSERT_EQ(print.wait(), 0);
    const std::string file = folder_.write("client.toml", print.output());
    Program again(kClient, {"--config", file, "--print-config"});
    ASSERT_EQ(again.wait(), 0) << again.output();
    EXPECT_EQ(again.output(), print.output());
    EXPECT_NE(again.output().find("sim:77"), std::string::npos);
}

TEST_F(ClientProgram, IsMadeWithoutTracerAndScenes) {
    Program libraries("/usr/bin/ldd", {kClient});
    ASSERT_EQ(libraries.wait(), 0) << libraries.output();
    for (const char* foreign : {"embree", "OpenImageIO"}) {
        EXPECT_EQ(libraries.output().find(foreign), std::string::npos) << foreign;
    }
    EXPECT_NE(libraries.output().find("libavcodec"), std::string::npos) << "ldd says something else";
    // Static libraries leave no trace in ldd, but their types do.
    Program symbols("/usr/bin/nm", {"--demangle", kClient});
    ASSERT_EQ(symbols.wait(), 0);
    for (const char* foreign : {"tinygltf", "make_embree_tracer", "load_scene", "make_bunny_box"}) {
        EXPECT_EQ(symbols.output().find(foreign), std::string::npos) << foreign;
    }
    EXPECT_NE(symbols.output().find("macula::make_cpu_compositor"), std::string::npos) << "nm says something else";
}

}  // namespace
}  // namespace macula
