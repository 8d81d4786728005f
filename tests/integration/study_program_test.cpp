// The detection experiment with the two real programs, its observer a shell that presses keys.

#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "protocol/base/error.h"
#include "tests/support/program.h"
#include "tests/support/small_headset.h"

namespace macula {
namespace {

using testing::Program;
using testing::TemporaryFolder;

struct Row {
    double time_s = 0.0;
    std::string event;
    std::string from;
    std::string to;
    std::string scene;
};

class StudyProgram : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<TemporaryFolder>();
        headset_ = folder_->write("small.json", test::kSmallHeadset);
        server_ = std::make_unique<Program>(
            MACULA_SERVER, std::vector<std::string>{"--state", file("state"), "--listen", "127.0.0.1:0",
                                                    "--reconstruct-on", "cpu", "--mesh-cache", file("meshes")});
        port_ = server_->wait_for_output("listening on 127\\.0\\.0\\.1:([0-9]+)").value_or("1");
    }
    static void TearDownTestSuite() {
        server_.reset();
        folder_.reset();
    }

    /// The client behind a pipe into which `keys`, a shell command, writes.
    static std::unique_ptr<Program> start(const std::string& keys, const std::string& more) {
        const std::string command = keys + " | '" MACULA_CLIENT "' --connect 127.0.0.1:" + port_ + " --state '" +
                                    file("state") + "' --headset '" + headset_ +
                                    "' --taa-on cpu --gaze sim:3 --study '" + file("study.csv") + "' " + more;
        return std::make_unique<Program>("/bin/sh", std::vector<std::string>{"-c", command});
    }

    static std::vector<Row> table() {
        std::vector<Row> rows;
        std::ifstream in(file("study.csv"));
        std::string line;
        std::getline(in, line);
        EXPECT_EQ(line, "time_s,event,from,to,scene");
        while (std::getline(in, line)) {
            std::istringstream text(line);
            Row row;
            std::string time;
            for (std::string* cell : {&time, &row.event, &row.from, &row.to, &row.scene})
                std::getline(text, *cell, ',');
            row.time_s = std::stod(time);
            rows.push_back(row);
        }
        return rows;
    }

    static std::string file(const std::string& name) { return (folder_->path() / name).string(); }

    static inline std::unique_ptr<TemporaryFolder> folder_;
    static inline std::string headset_;
    static inline std::unique_ptr<Program> server_;
    static inline std::string port_;
};

TEST_F(StudyProgram, MasksReplaceOneAnotherAndKeysAreLogged) {
    const auto client = start("while sleep .2; do echo; done",
                              "--study-masks '54 layers:18 mesh:27/raster' --study-begin 1 --study-interval .8 "
                              "--study-spread .2 --study-length 4.5");
    EXPECT_EQ(client->wait(), 0) << client->output();
    const auto rows = table();
    ASSERT_GT(rows.size(), 6U) << client->output();
    EXPECT_EQ(rows.front().event, "shown");
    EXPECT_EQ(rows.front().time_s, 0.0);
    EXPECT_EQ(rows.front().to, "full");
    EXPECT_EQ(rows.back().event, "end");
    EXPECT_GE(rows.back().time_s, 4.5);
    std::string shown;
    double before_s = 0.0;
    int changes = 0;
    int keys = 0;
    std::set<std::string> masks;
    for (const Row& row : rows) {
        EXPECT_EQ(row.scene, "bunny-box");
        if (row.event == "key") ++keys;
        if (row.event != "shown") continue;
        EXPECT_EQ(row.from, shown);
        EXPECT_NE(row.to, shown);
        EXPECT_GE(row.time_s, before_s);
        before_s = row.time_s;
        shown = row.to;
        if (changes++ == 0) continue;
        EXPECT_GE(row.time_s, 1.0);
        masks.insert(row.to);
    }
    // A busy machine may be late with a frame; the schedule itself has 4 to 6 changes.
    EXPECT_GE(changes, 3);
    EXPECT_GE(masks.size(), 2U);
    EXPECT_GE(keys, 10);
}

TEST_F(StudyProgram, WhatCannotBeHadIsSaid) {
    const auto unknown = start("true", "--study-masks '27 nonsense'");
    EXPECT_EQ(unknown->wait(), static_cast<int>(ErrorCode::refused)) << unknown->output();
    EXPECT_NE(unknown->output().find("nonsense"), std::string::npos) << unknown->output();
    const auto two = start("true", "--sampling 27");
    EXPECT_EQ(two->wait(), static_cast<int>(ErrorCode::option)) << two->output();
    EXPECT_NE(two->output().find("--study-reference"), std::string::npos) << two->output();
    const auto short_one = start("true", "--study-length 5");
    EXPECT_EQ(short_one->wait(), static_cast<int>(ErrorCode::option)) << short_one->output();
}

}  // namespace
}  // namespace macula
