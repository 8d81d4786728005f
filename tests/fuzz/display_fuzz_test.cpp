#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
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

std::vector<std::string> corpus() {
    std::vector<std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator(MACULA_SOURCE_DIR "/tests/fuzz/corpus/display")) {
        std::ifstream file(entry.path(), std::ios::binary);
        texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return texts;
}

TEST(DisplayFuzz, CorpusHoldsTheContract) {
    ASSERT_GE(corpus().size(), 3U);
    for (const std::string& text : corpus()) run(text);
}

TEST(DisplayFuzz, DeepNestingHoldsTheContract) {
    for (const char* open : {"[", "{\"left\":", "[{\"\":"}) {
        std::string text;
        while (text.size() < 400'000) text += open;
        run(text);
        run("{\"left\": " + text + "}");
    }
    run("{\"left\": " + std::string(200'000, '[') + std::string(200'000, ']') + "}");
}

TEST(DisplayFuzz, MutationsHoldTheContract) {
    constexpr unsigned kSeed = 20261122;
    RecordProperty("seed", static_cast<int>(kSeed));
    std::mt19937 random(kSeed);
    const std::vector<std::string> pieces = {"-", "1e999", "NaN",  "null", "[]",   "{}",   "\"",     "\\u0000",
                                             ",", "0.001", "4096", "-20",  "1e-9", "true", "[0, 0]", "\xff"};
    const std::vector<std::string> texts = corpus();
    for (int i = 0; i < 10'000; ++i) {
        run(testing::mutated(texts[random() % texts.size()], pieces, random));
    }
}

}  // namespace
}  // namespace macula
