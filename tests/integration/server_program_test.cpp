// The real macula-server: what it says and which code it ends with.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "protocol/base/error.h"
#include "tests/support/peer.h"
#include "tests/support/program.h"

namespace macula {
namespace {

using testing::Program;
using testing::TemporaryFolder;

constexpr const char* kServer = MACULA_SERVER;

/// One triangle, its buffer inside the file.
constexpr const char* kTriangle = R"({
  "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

class ServerProgram : public ::testing::Test {
protected:
    /// Arguments that start a server quickly, and then `more`.
    [[nodiscard]] std::vector<std::string> arguments(std::vector<std::string> more = {}) const {
        const std::vector<std::pair<std::string, std::string>> usual = {
            {"--state", state_}, {"--reconstruct-on", "cpu"}, {"--listen", "127.0.0.1:0"}, {"--scene", scene_}};
        std::vector<std::string> all;
        for (const auto& [name, value] : usual)
            if (std::ranges::find(more, name) == more.end()) all.insert(all.end(), {name, value});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    /// The program ends with this code and says something that matches.
    void expect_end(const std::vector<std::string>& more, ErrorCode code, const std::string& text,
                    const std::vector<std::string>& environment = {}) {
        Program server(kServer, arguments(more), environment);
        const auto exit_code = server.wait();
        ASSERT_TRUE(exit_code) << "still runs: " << server.output();
        EXPECT_EQ(*exit_code, static_cast<int>(code)) << server.output();
        EXPECT_NE(server.output().find(text), std::string::npos) << server.output();
    }

    TemporaryFolder folder_;
    std::string state_ = (folder_.path() / "state").string();
    std::string scene_ = folder_.write("triangle.gltf", kTriangle);
};

TEST_F(ServerProgram, HelpAndVersionEndWell) {
    for (const char* option : {"--help", "--version"}) {
        Program server(kServer, {option});
        EXPECT_EQ(server.wait(), 0);
        EXPECT_NE(server.output().find("macula-server"), std::string::npos);
    }
}

TEST_F(ServerProgram, PrintedConfigurationReadsBackTheSame) {
    Program first(kServer, {"--scene", "a.glb", "--bit-rate", "5M", "--max-clients", "2", "--print-config"});
    ASSERT_EQ(first.wait(), 0) << first.output();
    EXPECT_NE(first.output().find("bit-rate=5000000"), std::string::npos) << first.output();
    const std::string file = folder_.write("server.toml", first.output());
    Program second(kServer, {"--config", file, "--print-config"});
    ASSERT_EQ(second.wait(), 0) << second.output();
    EXPECT_EQ(first.output(), second.output());
    Program third(kServer, {"--config", file, "--max-clients", "3", "--print-config"});
    ASSERT_EQ(third.wait(), 0) << third.output();
    EXPECT_NE(third.output().find("max-clients=3"), std::string::npos) << third.output();
    EXPECT_NE(third.output().find("scene=\"a.glb\""), std::string::npos) << third.output();
}

TEST_F(ServerProgram, WrongOptions) {
    expect_end({"--bogus"}, ErrorCode::option, "--bogus");
    expect_end({"--max-clients", "0"}, ErrorCode::option, "--max-clients");
    expect_end({"--context", "glx"}, ErrorCode::option, "--context");
    expect_end({"--bit-rate", "fast"}, ErrorCode::option, "--bit-rate");
    expect_end({"--sampling", "150"}, ErrorCode::option, "150");
    expect_end({"--sampling", "layers:27/raster"}, ErrorCode::option, "only the sampler mesh");
    expect_end({"--sampling", "mesh:file"}, ErrorCode::option, "--mesh FILE");
    // A method whose name no message can carry.
    expect_end({"--sampling", "law:alpha=0.1060,e2=2.3000,contrast=0.0156,exponent=2,full=0"}, ErrorCode::option, "64");
    expect_end({"--encoder", "nothing"}, ErrorCode::option, "nothing");
    expect_end({"--listen", "7470"}, ErrorCode::option, "ADDRESS:PORT");
    expect_end({"--listen", "127.0.0.1:99999"}, ErrorCode::option, "ADDRESS:PORT");
    expect_end({"--scene", "no-such-scene"}, ErrorCode::option, "no-such-scene");
    expect_end({"--config", "/no/such/file.toml"}, ErrorCode::option, "/no/such/file.toml");
    expect_end({"--config", folder_.write("wrong.toml", "colour = \"blue\"\n")}, ErrorCode::option, "colour");
}

TEST_F(ServerProgram, MissingOrBrokenScene) {
    expect_end({"--scene", "/no/such/scene.gltf"}, ErrorCode::input_file, "/no/such/scene.gltf");
    expect_end({"--scene", folder_.write("broken.gltf", "{\"asset\": ")}, ErrorCode::input_file, "broken.gltf");
    expect_end({"--scene", folder_.write("broken.glb", "glTF")}, ErrorCode::input_file, "broken.glb");
}

TEST_F(ServerProgram, PortInUse) {
    Program first(kServer, arguments());
    const auto port = first.wait_for_output("listening on 127\\.0\\.0\\.1:([0-9]+)");
    ASSERT_TRUE(port) << first.output();
    expect_end({"--listen", "127.0.0.1:" + *port}, ErrorCode::network, *port);
}

TEST_F(ServerProgram, NoGlContext) {
    expect_end({"--reconstruct-on", "gl", "--context", "surfaceless"}, ErrorCode::graphics, "surfaceless",
               {"__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere.json"});
}

TEST_F(ServerProgram, StateFolderThatCannotBe) {
    expect_end({"--state", folder_.write("file", "")}, ErrorCode::output, "file");
}

TEST_F(ServerProgram, ServesAndStopsWhenAsked) {
    for (const int number : {SIGINT, SIGTERM}) {
        Program server(kServer, arguments());
        const auto port = server.wait_for_output("listening on 127\\.0\\.0\\.1:([0-9]+)");
        ASSERT_TRUE(port) << server.output();
        const auto credentials = load_credentials(state_);
        ASSERT_TRUE(credentials) << credentials.error().message;
        EXPECT_NE(server.output().find(credentials->fingerprint), std::string::npos) << server.output();
        EXPECT_EQ(server.output().find(credentials->token), std::string::npos) << "the token must not be logged";

        testing::Peer peer(static_cast<std::uint16_t>(std::stoi(*port)), *credentials);
        ASSERT_TRUE(peer.greet());
        ASSERT_TRUE(peer.next_frame());
        server.signal(number);
        EXPECT_TRUE(peer.expect<Bye>());
        EXPECT_TRUE(peer.wait_for_end());
        EXPECT_EQ(server.wait(), 0) << server.output();
        EXPECT_NE(server.output().find("1 frames"), std::string::npos) << server.output();
    }
}

}  // namespace
}  // namespace macula
