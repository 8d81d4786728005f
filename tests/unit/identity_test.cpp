#include "protocol/transport/identity.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace macula {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, gone afterwards.
class IdentityTest : public testing::Test {
protected:
    IdentityTest() {
        std::string path = fs::temp_directory_path() / "macula-identity-XXXXXX";
        base_ = ::mkdtemp(path.data());
        folder_ = base_ / "state" / "macula";
    }
    ~IdentityTest() override {
        std::error_code ignored;
        fs::remove_all(base_, ignored);
    }

    void write(const char* name, const std::string& content) const { std::ofstream(folder_ / name) << content; }
    [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }
    [[nodiscard]] mode_t mode(const fs::path& file) const {
        struct stat status {};
        EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
        return status.st_mode & 0777U;
    }

    fs::path base_;
    fs::path folder_;
};

void expect_error(const Error& error, ErrorCode code, const std::string& part) {
    EXPECT_EQ(error.code, code);
    EXPECT_NE(error.message.find(part), std::string::npos) << error.message;
}

TEST_F(IdentityTest, IsMadeOnceAndFoundByTheClient) {
    const Expected<Identity> first = load_or_create_identity(folder_);
    ASSERT_TRUE(first) << first.error().message;
    const Expected<Identity> second = load_or_create_identity(folder_);
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_EQ(first->pem, second->pem);
    EXPECT_EQ(first->credentials.token, second->credentials.token);

    const Expected<Credentials> seen = load_credentials(folder_);
    ASSERT_TRUE(seen) << seen.error().message;
    EXPECT_EQ(seen->token, first->credentials.token);
    EXPECT_EQ(seen->fingerprint, first->credentials.fingerprint);
    EXPECT_EQ(seen->fingerprint.size(), 32U * 3 - 1);
}

TEST_F(IdentityTest, SecretsAreForTheOwnerOnly) {
    ASSERT_TRUE(load_or_create_identity(folder_));
    EXPECT_EQ(mode(folder_), 0700U);
    EXPECT_EQ(mode(folder_ / "identity.pem"), 0600U);
    EXPECT_EQ(mode(folder_ / "token"), 0600U);
    EXPECT_EQ(mode(folder_ / "fingerprint"), 0644U);
}

TEST_F(IdentityTest, TwoFoldersHaveNothingInCommon) {
    const Expected<Identity> a = load_or_create_identity(folder_);
    const Expected<Identity> b = load_or_create_identity(base_ / "other");
    ASSERT_TRUE(a && b);
    EXPECT_NE(a->credentials.fingerprint, b->credentials.fingerprint);
    EXPECT_FALSE(same_token(a->credentials.token, b->credentials.token));
}

TEST_F(IdentityTest, ServersThatStartAtOnceAgree) {
    std::vector<Expected<Identity>> results(8);
    std::vector<std::thread> servers;
    for (auto& result : results) servers.emplace_back([&] { result = load_or_create_identity(folder_); });
    for (std::thread& server : servers) server.join();
    for (const auto& result : results) {
        ASSERT_TRUE(result) << result.error().message;
        EXPECT_EQ(result->pem, results[0]->pem);
        EXPECT_EQ(result->credentials.token, results[0]->credentials.token);
    }
    const auto files = std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    EXPECT_EQ(files, 3) << "temporary files stay behind";
}

TEST_F(IdentityTest, BrokenFilesAreNamed) {
    ASSERT_TRUE(load_or_create_identity(folder_));
    write("token", "short\n");
    expect_error(load_or_create_identity(folder_).error(), ErrorCode::input_file, path("token"));
    expect_error(load_credentials(folder_).error(), ErrorCode::input_file, path("token"));
    write("token", "");
    expect_error(load_or_create_identity(folder_).error(), ErrorCode::input_file, path("token"));
    write("token", "my own choice of words");
    expect_error(load_or_create_identity(folder_).error(), ErrorCode::input_file, path("token"));
    write("token", "my-own-choice-of-word\n");
    EXPECT_EQ(load_or_create_identity(folder_)->credentials.token, "my-own-choice-of-word");

    write("fingerprint", "12:34\n");
    expect_error(load_credentials(folder_).error(), ErrorCode::input_file, path("fingerprint"));
    ASSERT_TRUE(load_or_create_identity(folder_));  // derived, so it is repaired
    EXPECT_TRUE(load_credentials(folder_));

    write("identity.pem", "");
    expect_error(load_or_create_identity(folder_).error(), ErrorCode::input_file, path("identity.pem"));
}

TEST_F(IdentityTest, KeyAndCertificateMustBelongTogether) {
    const Expected<Identity> a = load_or_create_identity(folder_);
    const Expected<Identity> b = load_or_create_identity(base_ / "other");
    ASSERT_TRUE(a && b);
    const std::string mark = "-----BEGIN CERTIFICATE-----";
    write("identity.pem", a->pem.substr(0, a->pem.find(mark)) + b->pem.substr(b->pem.find(mark)));
    expect_error(load_or_create_identity(folder_).error(), ErrorCode::input_file, "do not belong together");
    write("identity.pem", a->pem.substr(0, a->pem.find(mark)));
    expect_error(load_or_create_identity(folder_).error(), ErrorCode::input_file, "no certificate");
}

TEST_F(IdentityTest, ClientWithoutServerIsToldWhatToDo) {
    expect_error(load_credentials(folder_).error(), ErrorCode::input_file, path("fingerprint"));
    expect_error(load_credentials(folder_).error(), ErrorCode::input_file, "start the server");
}

TEST_F(IdentityTest, FolderThatCannotBeMadeIsNamed) {
    std::ofstream(base_ / "state") << "a file where a folder should be";
    expect_error(load_or_create_identity(folder_).error(), ErrorCode::output, folder_.string());
}

TEST_F(IdentityTest, FileThatCannotBeReadIsNamed) {
    ASSERT_TRUE(load_or_create_identity(folder_));
    fs::remove(folder_ / "token");
    fs::create_directory(folder_ / "token");  // unreadable even for root
    expect_error(load_or_create_identity(folder_).error(), ErrorCode::input_file, path("token"));
    expect_error(load_credentials(folder_).error(), ErrorCode::input_file, path("token"));
}

TEST(Fingerprint, IsReadInEveryUsualForm) {
    std::string colons = "00";
    std::string plain = "00";
    for (int i = 1; i < 32; ++i) {
        colons += i % 2 == 1 ? ":AB" : ":0C";
        plain += i % 2 == 1 ? "ab" : "0c";
    }
    EXPECT_EQ(parse_fingerprint(colons), colons);
    EXPECT_EQ(parse_fingerprint(plain), colons);
    for (const std::string& bad : {std::string(), plain + "0", plain.substr(1), plain.substr(1) + "x", plain + "\n"}) {
        EXPECT_FALSE(parse_fingerprint(bad)) << bad;
    }
}

TEST(Token, IsComparedWhole) {
    EXPECT_TRUE(same_token("abc", "abc"));
    EXPECT_FALSE(same_token("abc", "abd"));
    EXPECT_FALSE(same_token("abc", "ab"));
    EXPECT_FALSE(same_token("", "abc"));
}

}  // namespace
}  // namespace macula
