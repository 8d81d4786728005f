#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/text_mutation.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace macula {
namespace {

void run(const std::string& text) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

const std::vector<std::string> kCorpus = {
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf -4 -2 -1\n",
    "# all attributes\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/1/1 4/2/1\n",
    "o name\r\nv 1e-3 2 3 1\r\nv 4 5 6\r\nv 7 8 10\r\nvn 0 0 0\r\ns 1\r\nf 1//1 2//1 3//1\r\n",
};

TEST(ObjFuzz, CorpusHoldsTheContract) {
    for (const std::string& text : kCorpus) run(text);
}

TEST(ObjFuzz, MutationsHoldTheContract) {
    constexpr unsigned kSeed = 20261122;
    RecordProperty("seed", static_cast<int>(kSeed));
    std::mt19937 random(kSeed);
    const std::vector<std::string> hostile = {
        "-",  "/",   "//", "1e38", "nan",        "inf",         "\n",
        "f ", "vn ", "v ", "0",    "2147483647", "-2147483648", std::string(1, '\0'),
        " ",  "\xff"};
    for (int i = 0; i < 20'000; ++i) run(testing::mutated(kCorpus[random() % kCorpus.size()], hostile, random));
}

}  // namespace
}  // namespace macula
