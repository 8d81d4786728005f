#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/gltf_corpus.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scene_defect.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace macula {
namespace {

/// A long run: MACULA_FUZZ_MUTATIONS=1000000 MACULA_FUZZ_SEED=2.
unsigned environment_or(const char* name, unsigned otherwise) {
    const char* value = std::getenv(name);
    return value == nullptr ? otherwise : static_cast<unsigned>(std::strtoul(value, nullptr, 10));
}

unsigned seed() {
    return environment_or("MACULA_FUZZ_SEED", 1);
}

unsigned mutations(unsigned otherwise) {
    return environment_or("MACULA_FUZZ_MUTATIONS", otherwise);
}

std::vector<Bytes> corpus() {
    const GltfBuilder all = gltf_with_everything();
    const std::string text = all.gltf();
    const std::string small = GltfBuilder::triangle().gltf();
    return {all.glb(), Bytes(text.begin(), text.end()), GltfBuilder::triangle().glb(),
            Bytes(small.begin(), small.end())};
}

std::size_t pick(std::mt19937& random, std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
}

/// A few changes of the kinds that parsers fall over: bits, bytes, numbers, lengths, blocks.
Bytes mutate(Bytes bytes, std::mt19937& random) {
    for (std::size_t change = 1 + pick(random, 4); change > 0 && !bytes.empty(); --change) {
        const std::size_t at = pick(random, bytes.size());
        switch (pick(random, 8)) {
            case 0:
                bytes[at] ^= static_cast<std::uint8_t>(1U << pick(random, 8));
                break;
            case 1:
                bytes[at] = static_cast<std::uint8_t>(random());
                break;
            case 2:
            case 3:
            case 4: {  // most often: another digit keeps the JSON valid and makes the meaning wrong
                std::size_t digit = at;
                while (digit < bytes.size() && (bytes[digit] < '0' || bytes[digit] > '9')) ++digit;
                if (digit < bytes.size()) bytes[digit] = static_cast<std::uint8_t>('0' + pick(random, 10));
                break;
            }
            case 5:
                bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                             static_cast<std::uint8_t>("90-.,:[]{}\""[pick(random, 11)]));
                break;
            case 6:
                bytes.erase(
                    bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), at + 1 + pick(random, 8))));
                break;
            default:
                bytes.resize(at);
                break;
        }
    }
    return bytes;
}

/// Every value below `value`, containers included.
void list_values(nlohmann::json& value, std::vector<nlohmann::json*>& all) {
    if (!value.is_structured()) return;
    for (nlohmann::json& member : value) {
        all.push_back(&member);
        list_values(member, all);
    }
}

/// Replaces, removes or doubles values: what gets past any parser, and means something else.
void mutate(nlohmann::json& document, std::mt19937& random) {
    static const nlohmann::json kHostile = nlohmann::json::parse(
        R"([-1, 0, 1, 2, 3, 4, 5, 7, 0.5, -0.5, 255, 65536, 1e9, -1e9, 1e30, 1e300, -1e300, 2147483647, 4294967295,
            18446744073709551615, 5120, 5121, 5123, 5125, 5126, "x", "VEC2", "VEC4", "SCALAR", "STEP", "CUBICSPLINE",
            "scale", "rotation", "BLEND", "", null, true, [], {}, [0], [0, 0, 0], [0, 0, 0, 0], [1e30, 0, 0]])");
    for (std::size_t change = 1 + pick(random, 3); change > 0; --change) {
        std::vector<nlohmann::json*> all;
        list_values(document, all);
        if (all.empty()) return;
        nlohmann::json& value = *all[pick(random, all.size())];
        switch (pick(random, 8)) {
            case 0:
                if (value.is_structured() && !value.empty())
                    value.erase(std::next(value.begin(), static_cast<std::ptrdiff_t>(pick(random, value.size()))));
                break;
            case 1:
                if (value.is_array() && !value.empty())
                    value.push_back(nlohmann::json(value[pick(random, value.size())]));
                break;
            case 2:
                value = nlohmann::json(*all[pick(random, all.size())]);
                break;
            default:
                if (!value.is_structured() || pick(random, 8) == 0) value = kHostile[pick(random, kHostile.size())];
                break;
        }
    }
}

/// Floats of the buffer that are hostile, too.
void mutate_buffer(Bytes& buffer, std::mt19937& random) {
    constexpr std::array<std::uint32_t, 10> kBits = {0x00000000, 0x80000000, 0x7F800000, 0xFF800000, 0x7FC00000,
                                                     0x7F7FFFFF, 0x00000001, 0x3F800000, 0xBF800000, 0x501502F9};
    for (std::size_t change = pick(random, 3); change > 0 && buffer.size() >= 4; --change)
        std::memcpy(&buffer[4 * pick(random, buffer.size() / 4)], &kBits[pick(random, kBits.size())], 4);
}

bool loads(const Bytes& file) {
    return load_gltf_from_memory(file, "mutated", {.elements = 65536, .texels = 262144}).has_value();
}

TEST(GltfFuzz, TheCorpusLoads) {
    for (const Bytes& file : corpus()) {
        const Expected<LoadedScene> loaded = load_gltf_from_memory(file, "corpus");
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(LLVMFuzzerTestOneInput(file.data(), file.size()), 0);
    }
}

TEST(GltfFuzz, TheCorpusReachesEverything) {
    const Expected<LoadedScene> loaded = gltf_with_everything().load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Scene& scene = *loaded->scene;
    EXPECT_EQ(scene_defect(scene), "");
    EXPECT_TRUE(scene.animation.present());
    EXPECT_EQ(scene.cameras.size(), 2U);
    ASSERT_EQ(scene.materials.size(), 3U);
    EXPECT_EQ(scene.images.size(), 3U) << "PNG and WebP as data, JPEG as colour";
    std::size_t textures = 0;
    for (const TextureUse* use : texture_uses(scene.materials[1])) textures += use->present() ? 1U : 0U;
    EXPECT_EQ(textures, 9U) << "all that the extensions have";
}

TEST(GltfFuzz, MutationsOfBytesNeitherCrashNorBreakPromises) {
    std::mt19937 random(seed());
    int loaded = 0;
    for (const Bytes& file : corpus())
        for (unsigned i = 0; i < mutations(500); ++i) {
            const Bytes mutated = mutate(file, random);
            EXPECT_EQ(LLVMFuzzerTestOneInput(mutated.data(), mutated.size()), 0);
            if (i % 10 == 0) loaded += loads(mutated) ? 1 : 0;
        }
    EXPECT_GT(loaded, 10) << "mutations have to reach the code behind the parser";
}

TEST(GltfFuzz, MutationsOfMeaningNeitherCrashNorBreakPromises) {
    std::mt19937 random(seed());
    const GltfBuilder all = gltf_with_everything();
    int loaded = 0;
    for (unsigned i = 0; i < mutations(700); ++i) {
        GltfBuilder mutated = all;
        mutate(mutated.json, random);
        mutate_buffer(mutated.buffer, random);
        const Bytes file = mutated.glb();
        EXPECT_EQ(LLVMFuzzerTestOneInput(file.data(), file.size()), 0);
        if (i % 10 == 0) loaded += loads(file) ? 1 : 0;
    }
    EXPECT_GT(loaded, 10) << "mutations have to reach the code behind the parser";
}

}  // namespace
}  // namespace macula
