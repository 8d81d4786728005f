#include "server/options.h"

#include <gtest/gtest.h>

namespace macula {
namespace {

void expect_endpoint(const std::string& text, const std::string& address, std::uint16_t port) {
    const auto endpoint = parse_endpoint(text);
    ASSERT_TRUE(endpoint) << text;
    EXPECT_EQ(endpoint->address, address) << text;
    EXPECT_EQ(endpoint->port, port) << text;
}

TEST(ParseEndpoint, KnowsTheThreeForms) {
    expect_endpoint("127.0.0.1:7470", "127.0.0.1", 7470);
    expect_endpoint("[::1]:65535", "::1", 65535);
    expect_endpoint("*:0", "", 0);
}

TEST(ParseEndpoint, RefusesEverythingElse) {
    for (const char* text : {"", ":", "7470", ":7470", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1",
                             "127.0.0.1:70a", "::1:7470", "[::1]", "[]:1", "[127.0.0.1]:1", "*:port"}) {
        const auto endpoint = parse_endpoint(text);
        ASSERT_FALSE(endpoint) << text;
        EXPECT_EQ(endpoint.error().code, ErrorCode::option);
        EXPECT_NE(endpoint.error().message.find(text), std::string::npos);
    }
}

}  // namespace
}  // namespace macula
