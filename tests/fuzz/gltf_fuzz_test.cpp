#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/support/encoded_image.h"
#include "tests/support/gltf_builder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace macula {
namespace {

constexpr unsigned kSeed = 1;
constexpr int kMutationsPerFile = 1500;

/// A file that uses everything the loader knows.
GltfBuilder everything() {
    GltfBuilder b = GltfBuilder::textured_triangle();
    b.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform", "KHR_materials_unlit", "EXT_none"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 10}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}, {"color", {1, 0.5, 0.25}}}};
    b.json["nodes"] = {{{"children", {1, 2, 3}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {1, 2, -3}}},
                       {{"mesh", 0}, {"translation", {1, 2, 3}}},
                       {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 4, 5, 6, 1}}},
                       {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    auto& attributes = b.primitive()["attributes"];
    attributes["NORMAL"] = b.accessor<std::int8_t>("VEC4", {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, true);
    b.json["accessors"].back()["type"] = "VEC3";
    b.json["bufferViews"].back()["byteStride"] = 4;
    attributes["COLOR_0"] = b.accessor<std::uint16_t>("VEC4", std::vector<std::uint16_t>(12, 30000), true);
    attributes["TEXCOORD_1"] = b.accessor<std::uint8_t>("VEC2", {0, 9, 200, 30, 100, 255, 7, 8}, true);
    b.json["accessors"].back()["count"] = 3;
    b.primitive()["indices"] = b.accessor<std::uint16_t>("SCALAR", {0, 1, 2, 1, 0});
    b.primitive()["mode"] = 5;
    const int indices = b.view({1});
    const int values = b.view(GltfBuilder::bytes_of<float>({2, 0, 0}));
    b.json["accessors"][0]["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", values}}}};
    const int png = b.texture(encode_image("png", 3, 2, 3, Bytes(18, 100)));
    const int jpeg = b.texture(encode_image("jpeg", 8, 8, 3, Bytes(192, 90)));
    b.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    b.json["textures"][0]["sampler"] = 0;
    b.material() = {
        {"pbrMetallicRoughness",
         {{"baseColorTexture", {{"index", jpeg}, {"texCoord", 1}}}, {"baseColorFactor", {1, 0.5, 1, 1}}}},
        {"normalTexture",
         {{"index", png}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 3}}, {"rotation", 1}}}}}}},
        {"alphaMode", "MASK"},
        {"doubleSided", true}};
    return b;
}

std::vector<Bytes> corpus() {
    const GltfBuilder all = everything();
    const std::string text = all.gltf();
    const std::string small = GltfBuilder::triangle().gltf();
    return {all.glb(), Bytes(text.begin(), text.end()), GltfBuilder::triangle().glb(),
            Bytes(small.begin(), small.end())};
}

/// A few changes of the kinds that parsers fall over: bits, bytes, numbers, lengths, blocks.
Bytes mutate(Bytes bytes, std::mt19937& random) {
    const auto pick = [&random](std::size_t n) {
        return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
    };
    for (std::size_t change = 0; change < 1 + pick(4) && !bytes.empty(); ++change) {
        const std::size_t at = pick(bytes.size());
        switch (pick(8)) {
            case 0:
                bytes[at] ^= static_cast<std::uint8_t>(1U << pick(8));
                break;
            case 1:
                bytes[at] = static_cast<std::uint8_t>(random());
                break;
            case 2:
            case 3:
            case 4: {  // most often: another digit keeps the JSON valid and makes the meaning wrong
                std::size_t digit = at;
                while (digit < bytes.size() && (bytes[digit] < '0' || bytes[digit] > '9')) ++digit;
                if (digit < bytes.size()) bytes[digit] = static_cast<std::uint8_t>('0' + pick(10));
                break;
            }
            case 5:
                bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                             static_cast<std::uint8_t>("90-.,:[]{}\""[pick(11)]));
                break;
            case 6:
                bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                            bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), at + 1 + pick(8))));
                break;
            default:
                bytes.resize(at);
                break;
        }
    }
    return bytes;
}

TEST(GltfFuzz, TheCorpusLoads) {
    for (const Bytes& file : corpus()) {
        const Expected<LoadedScene> loaded = load_gltf_from_memory(file, "corpus");
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(LLVMFuzzerTestOneInput(file.data(), file.size()), 0);
    }
}

TEST(GltfFuzz, MutationsNeitherCrashNorBreakPromises) {
    std::mt19937 random(kSeed);
    int loaded = 0;
    for (const Bytes& file : corpus())
        for (int i = 0; i < kMutationsPerFile; ++i) {
            const Bytes mutated = mutate(file, random);
            EXPECT_EQ(LLVMFuzzerTestOneInput(mutated.data(), mutated.size()), 0);
            if (i % 10 == 0)
                loaded += load_gltf_from_memory(mutated, "mutated", {.elements = 65536, .texels = 262144}) ? 1 : 0;
        }
    EXPECT_GT(loaded, 40) << "mutations have to reach the code behind the parser";
}

}  // namespace
}  // namespace macula
