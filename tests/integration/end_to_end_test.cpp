// The two real programs together: what a user runs, and what happens when one of them dies.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/base/error.h"
#include "tests/support/program.h"
#include "tests/support/small_headset.h"

namespace macula {
namespace {

using testing::Program;
using testing::TemporaryFolder;

/// Values of a summary file's lines, name=value.
std::map<std::string, double> read_summary(const std::string& path) {
    std::map<std::string, double> values;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t equals = line.find('=');
        if (equals != std::string::npos) values[line.substr(0, equals)] = std::stod(line.substr(equals + 1));
    }
    return values;
}

/// Rows of a CSV file by the names of its first line.
std::vector<std::map<std::string, std::string>> read_table(const std::string& path) {
    const auto split = [](const std::string& line) {
        std::vector<std::string> cells;
        std::istringstream text(line);
        for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
        return cells;
    };
    std::vector<std::map<std::string, std::string>> rows;
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> names = split(line);
    while (std::getline(file, line)) {
        const std::vector<std::string> cells = split(line);
        std::map<std::string, std::string> row;
        for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) row[names[i]] = cells[i];
        rows.push_back(row);
    }
    return rows;
}

/// Width and height in the header of a PNG file; zeros if it is none.
std::array<unsigned, 2> png_size(const std::filesystem::path& path) {
    std::array<unsigned char, 24> header{};
    std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(header.data()), header.size());
    if (std::string(header.begin() + 1, header.begin() + 4) != "PNG") return {};
    const auto number = [&header](std::size_t at) {
        return (header[at] << 24U) | (header[at + 1] << 16U) | (header[at + 2] << 8U) | unsigned{header[at + 3]};
    };
    return {number(16), number(20)};
}

class EndToEnd : public ::testing::Test {
protected:
    /// A server of this test's state folder; port 0: any.
    std::unique_ptr<Program> start_server(const std::string& port = "0", const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments = {"--state",          state_, "--listen",   "127.0.0.1:" + port,
                                              "--reconstruct-on", "cpu",  "--sampling", "27"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        auto server = std::make_unique<Program>(MACULA_SERVER, arguments);
        const auto listening = server->wait_for_output("listening on 127\\.0\\.0\\.1:([0-9]+)");
        EXPECT_TRUE(listening) << server->output();
        port_ = listening.value_or("1");
        return server;
    }

    [[nodiscard]] std::unique_ptr<Program> start_client(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {
            "--connect", "127.0.0.1:" + port_, "--headset", headset_, "--taa-on", "cpu", "--gaze", "sim:3"};
        if (std::ranges::find(more, "--state") == more.end()) arguments.insert(arguments.end(), {"--state", state_});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return std::make_unique<Program>(MACULA_CLIENT, arguments);
    }

    static void expect_exit(Program& program, int code) {
        const auto exit_code = program.wait();
        ASSERT_TRUE(exit_code) << "still runs: " << program.output();
        EXPECT_EQ(*exit_code, code) << program.output();
    }
    static void expect_exit(Program& program, ErrorCode code) { expect_exit(program, static_cast<int>(code)); }

    [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path() / name).string(); }

    TemporaryFolder folder_;
    std::string state_ = file("state");
    std::string headset_ = folder_.write("small.json", test::kSmallHeadset);
    std::string port_;
};

TEST_F(EndToEnd, AClientChoosesHowItsFramesAreMade) {
    const auto server = start_server("0", {"--mesh-cache", file("meshes")});
    for (const char* method : {"mesh:27/raster", "mesh:27/table", "layers:27", "tiles:18/push-pull"}) {
        const auto client = start_client({"--frames", "5", "--sampling", method, "--summary", file("summary")});
        expect_exit(*client, 0);
        auto summary = read_summary(file("summary"));
        EXPECT_EQ(summary["frames"], 5.0) << method;
        EXPECT_EQ(summary["frames_undecodable"], 0.0) << method;
        EXPECT_GT(summary["traced_share"], 0.1) << method;
        EXPECT_LT(summary["traced_share"], 0.4) << method;
    }
    // Both mesh methods share one mesh, which lies in the cache.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file("meshes")), {}), 1);

    const auto refused = start_client({"--frames", "5", "--sampling", "layers:27/raster"});
    expect_exit(*refused, ErrorCode::refused);
    EXPECT_NE(refused->output().find("only the sampler mesh"), std::string::npos) << refused->output();
    server->signal(SIGTERM);
    expect_exit(*server, 0);
}

TEST_F(EndToEnd, FramesAreShownSavedAndCounted) {
    const auto server = start_server();
    const auto client = start_client({"--frames", "30", "--display", "png:" + file("frames"), "--stats",
                                      file("stats.csv"), "--summary", file("summary")});
    expect_exit(*client, 0);
    server->signal(SIGTERM);
    expect_exit(*server, 0);
    EXPECT_NE(server->output().find("client 1 (127.0.0.1"), std::string::npos) << server->output();

    auto summary = read_summary(file("summary"));
    EXPECT_EQ(summary["frames"], 30.0);
    EXPECT_EQ(summary["connections"], 1.0);
    EXPECT_EQ(summary["frames_undecodable"], 0.0);
    // The simulated eyes look aside at times, where the law needs less.
    EXPECT_GT(summary["traced_share"], 0.15);
    EXPECT_LT(summary["traced_share"], 0.32);
    EXPECT_GT(summary["gaze_to_frame_p50_ms"], 0.0);

    const auto rows = read_table(file("stats.csv"));
    ASSERT_EQ(rows.size(), 30U);
    EXPECT_EQ(rows.front().at("keyframe"), "1");
    for (std::size_t i = 1; i < rows.size(); ++i)
        EXPECT_GT(std::stoll(rows[i].at("track")), std::stoll(rows[i - 1].at("track")));

    std::size_t pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(file("frames"))) {
        EXPECT_EQ(png_size(entry.path()), (std::array<unsigned, 2>{256, 96})) << entry.path();
        ++pictures;
    }
    EXPECT_EQ(pictures, 30U);
}

TEST_F(EndToEnd, WrongTokenAndWrongKeyAreRefused) {
    const auto server = start_server();
    const auto stranger = start_client({"--frames", "1", "--retry-seconds", "0", "--token", "guessed"});
    expect_exit(*stranger, ErrorCode::refused);
    EXPECT_NE(stranger->output().find("token"), std::string::npos) << stranger->output();

    std::string other_key;
    for (int pair = 0; pair < 32; ++pair) other_key += pair == 0 ? "AB" : ":AB";
    const auto misled = start_client({"--frames", "1", "--retry-seconds", "0", "--fingerprint", other_key});
    expect_exit(*misled, ErrorCode::refused);
    EXPECT_NE(misled->output().find(other_key), std::string::npos) << misled->output();

    expect_exit(*start_client({"--frames", "3"}), 0);
}

TEST_F(EndToEnd, NoServerIsAClearEnd) {
    start_server().reset();  // leaves its state, and a port where nobody listens
    const auto client = start_client({"--frames", "1", "--retry-seconds", "0"});
    expect_exit(*client, ErrorCode::network);
    EXPECT_NE(client->output().find(port_), std::string::npos) << client->output();
}

TEST_F(EndToEnd, KilledClientLeavesTheServerFree) {
    const auto server = start_server("0", {"--max-clients", "1"});
    const auto first = start_client({"--stats", file("stats.csv")});
    ASSERT_TRUE(first->wait_for_output("connected to 127.0.0.1:([0-9]+)")) << first->output();
    first->signal(SIGKILL);
    expect_exit(*first, 128 + SIGKILL);
    expect_exit(*start_client({"--frames", "5"}), 0);
    server->signal(SIGINT);
    expect_exit(*server, 0);
}

TEST_F(EndToEnd, SessionSurvivesAServerThatIsKilledAndComesBack) {
    auto server = start_server();
    const auto client = start_client({"--frames", "100", "--summary", file("summary"), "--stats", file("stats.csv")});
    ASSERT_TRUE(client->wait_for_output("connected to 127.0.0.1:([0-9]+)")) << client->output();
    server->signal(SIGKILL);
    expect_exit(*server, 128 + SIGKILL);
    server = start_server(port_);
    expect_exit(*client, 0);
    EXPECT_EQ(read_summary(file("summary"))["connections"], 2.0) << client->output();
    // The new session begins with a frame that can be decoded on its own.
    std::map<std::string, std::string> first_keyframe;
    for (const auto& row : read_table(file("stats.csv")))
        first_keyframe.try_emplace(row.at("connection"), row.at("keyframe"));
    for (const auto& [connection, keyframe] : first_keyframe) EXPECT_EQ(keyframe, "1") << "connection " << connection;
}

TEST_F(EndToEnd, TwoClientsAtOnce) {
    const auto server = start_server();
    const auto one = start_client({"--frames", "20", "--summary", file("one")});
    const auto two = start_client({"--frames", "20", "--summary", file("two"), "--sampling", "full"});
    expect_exit(*one, 0);
    expect_exit(*two, 0);
    EXPECT_LT(read_summary(file("one"))["traced_share"], 0.32);
    EXPECT_EQ(read_summary(file("two"))["traced_share"], 1.0);
}

}  // namespace
}  // namespace macula
