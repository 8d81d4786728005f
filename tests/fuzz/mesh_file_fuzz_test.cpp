#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "masks/mesh/mesh_file.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/triangulated.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace macula {
namespace {

/// A long run: MACULA_FUZZ_MUTATIONS=1000000 MACULA_FUZZ_SEED=2.
unsigned environment_or(const char* name, unsigned otherwise) {
    const char* value = std::getenv(name);
    return value == nullptr ? otherwise : static_cast<unsigned>(std::strtoul(value, nullptr, 10));
}

const unsigned kSeed = environment_or("MACULA_FUZZ_SEED", 1);

std::size_t pick(std::mt19937& random, std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
}

/// A small mask as it is written.
Bytes file_of_a_mesh() {
    std::mt19937 random(7);
    const SampleMesh mesh = testing::triangulated(9, 7, testing::scattered_sites(9, 7, 0.2, random), "{\"seed\": 1}");
    const std::string path =
        (std::filesystem::path(::testing::TempDir()) / ("mesh_fuzz_" + std::to_string(::getpid()) + ".glb")).string();
    EXPECT_TRUE(write_mesh(mesh, path));
    std::ifstream file(path, std::ios::binary);
    Bytes bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    std::filesystem::remove(path);
    return bytes;
}

void run(const Bytes& file, int& read) {
    EXPECT_EQ(LLVMFuzzerTestOneInput(file.data(), file.size()), 0);
    read += read_mesh_from_memory(file, "mutated").has_value() ? 1 : 0;
}

void mutate_bytes(Bytes& bytes, std::mt19937& random) {
    for (std::size_t change = 1 + pick(random, 3); change > 0 && !bytes.empty(); --change) {
        const std::size_t at = pick(random, bytes.size());
        switch (pick(random, 6)) {
            case 0:
                bytes[at] ^= static_cast<std::uint8_t>(1U << pick(random, 8));
                break;
            case 1:
                bytes[at] = static_cast<std::uint8_t>(random());
                break;
            case 2:
            case 3: {  // another digit keeps the JSON valid and makes the meaning wrong
                std::size_t digit = at;
                while (digit < bytes.size() && (bytes[digit] < '0' || bytes[digit] > '9')) ++digit;
                if (digit < bytes.size()) bytes[digit] = static_cast<std::uint8_t>('0' + pick(random, 10));
                break;
            }
            case 4:
                bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                             static_cast<std::uint8_t>("90-.,:[]{}\""[pick(random, 11)]));
                break;
            default:
                bytes.resize(at);
                break;
        }
    }
}

/// Every value below `value`, containers included.
void list_values(nlohmann::json& value, std::vector<nlohmann::json*>& all) {
    if (!value.is_structured()) return;
    for (nlohmann::json& member : value) {
        all.push_back(&member);
        list_values(member, all);
    }
}

/// Replaces, removes or doubles a value: what gets past any parser, and means something else.
void mutate_meaning(nlohmann::json& document, std::mt19937& random) {
    static const nlohmann::json kHostile = nlohmann::json::parse(
        R"([-1, 0, 1, 2, 3, 4, 7, 0.5, 12, 16, 255, 65536, 1e9, -1e9, 1e300, 2147483647, 4294967295,
            18446744073709551615, 5121, 5123, 5125, 5126, "x", "VEC2", "VEC3", "SCALAR", "", null, true, [], {}, [0],
            [3, 3], {"macula": {}}])");
    std::vector<nlohmann::json*> all;
    list_values(document, all);
    nlohmann::json& value = *all[pick(random, all.size())];
    switch (pick(random, 6)) {
        case 0:
            if (value.is_structured() && !value.empty())
                value.erase(std::next(value.begin(), static_cast<std::ptrdiff_t>(pick(random, value.size()))));
            break;
        case 1:
            if (value.is_array() && !value.empty()) value.push_back(nlohmann::json(value[pick(random, value.size())]));
            break;
        case 2:
            value = nlohmann::json(*all[pick(random, all.size())]);
            break;
        default:
            if (!value.is_structured() || pick(random, 8) == 0) value = kHostile[pick(random, kHostile.size())];
            break;
    }
}

/// Positions and corners that are hostile, or another's.
void mutate_buffer(Bytes& buffer, std::mt19937& random) {
    constexpr std::array<std::uint32_t, 10> kBits = {0x00000000, 0x80000000, 0x7F800000, 0x7FC00000, 0x00000001,
                                                     0x3F800000, 0xBF800000, 0x00000007, 0xFFFFFFFF, 0x47000000};
    for (std::size_t change = pick(random, 3); change > 0 && buffer.size() >= 4; --change) {
        const std::uint8_t* source = &buffer[4 * pick(random, buffer.size() / 4)];
        if (pick(random, 2) == 0) source = reinterpret_cast<const std::uint8_t*>(&kBits[pick(random, kBits.size())]);
        std::memmove(&buffer[4 * pick(random, buffer.size() / 4)], source, 4);
    }
}

TEST(MeshFileFuzz, TheCorpusIsRead) {
    int read = 0;
    run(file_of_a_mesh(), read);
    EXPECT_EQ(read, 1);
}

TEST(MeshFileFuzz, DeepNestingIsRefused) {
    for (const char* open : {"[", "{\"a\":"}) {
        std::string deep = R"({"asset": {"version": "2.0", "extras": )";
        for (int i = 0; i < 100'000; ++i) deep += open;
        int read = 0;
        run(GltfBuilder::glb_of(deep, {0, 0, 0, 0}), read);
        EXPECT_EQ(read, 0);
    }
}

TEST(MeshFileFuzz, MutationsOfBytesNeitherCrashNorBreakPromises) {
    std::mt19937 random(kSeed);
    const Bytes whole = file_of_a_mesh();
    int read = 0;
    for (unsigned i = 0; i < environment_or("MACULA_FUZZ_MUTATIONS", 3000); ++i) {
        Bytes file = whole;
        mutate_bytes(file, random);
        run(file, read);
    }
    EXPECT_GT(read, 30) << "mutations have to reach the code behind the parser; seed " << kSeed;
}

TEST(MeshFileFuzz, MutationsOfMeaningNeitherCrashNorBreakPromises) {
    std::mt19937 random(kSeed);
    const Bytes whole = file_of_a_mesh();
    std::uint32_t length = 0;
    std::memcpy(&length, &whole[12], 4);
    const auto text = whole.begin() + 20;
    const nlohmann::json document = nlohmann::json::parse(text, text + length);
    const Bytes buffer(text + length + 8, whole.end());
    int read = 0;
    for (unsigned i = 0; i < environment_or("MACULA_FUZZ_MUTATIONS", 3000); ++i) {
        nlohmann::json mutated = document;
        if (i % 4 != 0) mutate_meaning(mutated, random);
        Bytes data = buffer;
        if (i % 4 != 1) mutate_buffer(data, random);
        run(GltfBuilder::glb_of(mutated.dump(), data), read);
    }
    EXPECT_GT(read, 100) << "mutations have to reach the code behind the parser; seed " << kSeed;
}

}  // namespace
}  // namespace macula
