// The written bytes against numpy.lib.format's description of version 1.0.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/metrics/npy.h"

namespace macula::test {
namespace {

TEST(Npy, HasHeaderAndBytesInOrderOfFrameRowColumnChannel) {
    ColorImage first(2, 3);
    for (int i = 0; i < 6; ++i) first.texels[i] = 0xFF000000U | static_cast<Rgba8>(0x030201 + 0x030303 * i);
    const ColorImage second(2, 3, 0xFFAABBCCU);
    const std::string path = testing::TempDir() + "npy_test.npy";
    ASSERT_TRUE(write_npy(path, {first, second}));
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(path);

    ASSERT_EQ(bytes.size(), 128U + 2 * 3 * 2 * 3);
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    EXPECT_EQ(bytes[8], 118);  // 128 - 10, little endian
    EXPECT_EQ(bytes[9], 0);
    const std::string fields = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 2, 3), }";
    EXPECT_EQ(bytes.substr(10, fields.size()), fields);
    EXPECT_EQ(bytes.find_first_not_of(' ', 10 + fields.size()), 127U);
    EXPECT_EQ(bytes[127], '\n');
    for (int i = 0; i < 18; ++i) EXPECT_EQ(bytes[128 + i], static_cast<char>(i + 1));
    for (int i = 0; i < 6; ++i) EXPECT_EQ(bytes.substr(128 + 18 + 3 * i, 3), "\xCC\xBB\xAA");
}

TEST(Npy, SaysWhichFileCannotBeWritten) {
    const auto written = write_npy("/no-such-folder/clip.npy", {ColorImage(2, 2)});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::output);
    EXPECT_NE(written.error().message.find("/no-such-folder/clip.npy"), std::string::npos);
}

}  // namespace
}  // namespace macula::test
