// The architecture's arrows: who may include whom. The table below is the rule; the CMake link edges follow it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = MACULA_SOURCE_DIR;

/// Module (a folder) -> folders, beside itself, whose headers it may include.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"protocol/base", {}},
    {"protocol/message", {"protocol/base"}},
    {"protocol/transport", {"protocol/base", "protocol/message"}},
    {"protocol/codec", {"protocol/base"}},
    {"protocol/gl", {"protocol/base"}},
    {"masks", {"protocol/base"}},
    {"masks/mesh", {"protocol/base", "masks"}},
    {"masks/make", {"protocol/base", "masks", "masks/mesh"}},
    {"masks/rivals", {"protocol/base", "masks"}},
    {"masks/tool", {"protocol/base", "masks", "masks/mesh", "masks/make"}},
    {"scenes", {"protocol/base"}},
    {"server/kernels", {"protocol/gl"}},
    {"server/render", {"protocol/base", "protocol/gl", "masks", "masks/mesh", "scenes", "server/kernels"}},
    {"server/service",
     {"protocol/base", "protocol/message", "protocol/transport", "protocol/codec", "masks", "scenes", "server/render"}},
    {"server/offline", {"protocol/base", "masks", "scenes", "server", "server/kernels", "server/render"}},
    {"server",
     {"protocol/base", "protocol/message", "protocol/transport", "protocol/codec", "protocol/gl", "masks", "masks/mesh",
      "masks/make", "masks/rivals", "scenes", "server/render", "server/service"}},
    {"client/device", {"protocol/base", "protocol/message"}},
    {"client/stream", {"protocol/base", "protocol/message", "protocol/transport", "protocol/codec", "masks"}},
    {"client/present", {"protocol/base", "protocol/message", "protocol/codec", "protocol/gl", "masks"}},
    {"client/study", {"protocol/base", "protocol/message"}},
    {"client",
     {"protocol/base", "protocol/message", "protocol/transport", "protocol/codec", "protocol/gl", "masks",
      "client/device", "client/stream", "client/present", "client/study"}},
};

std::string folder_of(const fs::path& relative) {
    return relative.parent_path().generic_string();
}

TEST(IncludeArrows, EveryIncludeFollowsTheTable) {
    const std::regex include(R"re(^\s*#\s*include\s+"([^"]+)")re");
    int checked = 0;
    for (const char* top : {"protocol", "masks", "scenes", "server", "client"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp") continue;
            const fs::path file = fs::relative(entry.path(), kRoot);
            const auto rule = kMayInclude.find(folder_of(file));
            ASSERT_NE(rule, kMayInclude.end()) << file << " lies in a folder that the table does not know";
            std::ifstream in(entry.path());
            for (std::string line; std::getline(in, line);) {
                std::smatch match;
                if (!std::regex_search(line, match, include)) continue;
                const std::string target = match[1];
                if (!fs::exists(kRoot / target)) continue;  // generated, or a library's own header
                const std::string folder = folder_of(target);
                EXPECT_TRUE(folder == rule->first || rule->second.contains(folder))
                    << file.generic_string() << " includes " << target << ", against the arrows";
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 50) << "the include pattern no longer matches anything";
}

TEST(IncludeArrows, OnlyOneFileIncludesEmbree) {
    std::set<std::string> users;
    for (const char* top : {"protocol", "masks", "scenes", "server", "client"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
            if (!entry.is_regular_file()) continue;
            std::ifstream in(entry.path());
            const std::string text((std::istreambuf_iterator<char>(in)), {});
            if (text.find("<embree") != std::string::npos) users.insert(entry.path().filename().string());
        }
    }
    EXPECT_EQ(users, std::set<std::string>{"embree_calls.h"});
}

TEST(Layout, TopLevelFoldersAreTheFixedOnes) {
    std::set<std::string> folders;
    for (const auto& entry : fs::directory_iterator(kRoot)) {
        const std::string name = entry.path().filename().string();
        if (entry.is_directory() && name.front() != '.' && name != "build" && name != "out") folders.insert(name);
    }
    EXPECT_EQ(folders, (std::set<std::string>{"server", "client", "protocol", "masks", "scenes", "tests", "deploy"}));
}

}  // namespace
