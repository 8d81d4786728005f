#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "scenes/gltf.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/scene_defect.h"

namespace macula {
namespace {

using Random = std::mt19937;

int random_int(Random& random, int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
}

/// Writes `elements` of `components` integers of type T into views with a random offset, stride and sparse part, in
/// such a way that the reader has to see `elements` again.
template <class T>
int add_scrambled(GltfBuilder& b, Random& random, const std::string& type, const std::vector<T>& elements,
                  bool normalized) {
    const std::size_t components = GltfBuilder::components(type);
    const std::size_t count = elements.size() / components;
    const std::size_t element_bytes = components * sizeof(T);
    // Strides are multiples of 4 (glTF 2.0, 3.6.2.4).
    const std::size_t stride = (element_bytes + 3) / 4 * 4 + 4 * static_cast<std::size_t>(random_int(random, 0, 3));
    const std::size_t offset = sizeof(T) * static_cast<std::size_t>(random_int(random, 0, 5));
    Bytes bytes(offset + (count - 1) * stride + element_bytes);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_int(random, 0, 255));

    std::vector<std::uint16_t> replaced;
    std::vector<T> replacements;
    for (std::size_t i = 0; i < count; ++i) {
        if (random_int(random, 0, 3) == 0) {
            replaced.push_back(static_cast<std::uint16_t>(i));
            replacements.insert(replacements.end(), &elements[i * components], &elements[i * components] + components);
            // What lies below a replacement must not matter, but has to be a number.
            std::memset(&bytes[offset + i * stride], 0, element_bytes);
        } else {
            std::memcpy(&bytes[offset + i * stride], &elements[i * components], element_bytes);
        }
    }
    nlohmann::json accessor = {{"bufferView", b.view(bytes, static_cast<int>(stride))},
                               {"byteOffset", offset},
                               {"componentType", gl_type_of(T())},
                               {"count", count},
                               {"type", type},
                               {"normalized", normalized}};
    if (!replaced.empty())
        accessor["sparse"] = {
            {"count", replaced.size()},
            {"indices", {{"bufferView", b.view(GltfBuilder::bytes_of(replaced))}, {"componentType", 5123}}},
            {"values", {{"bufferView", b.view(GltfBuilder::bytes_of(replacements))}}}};
    return b.push("accessors", accessor);
}

template <class T>
T random_value(Random& random) {
    if constexpr (std::is_same_v<T, float>)
        return std::uniform_real_distribution<float>(-10.0F, 10.0F)(random);
    else
        return static_cast<T>(random());
}

/// Adds an accessor of random values and returns what they mean.
template <class T>
std::vector<float> add_random(GltfBuilder& b, Random& random, const std::string& type, std::size_t count,
                              bool normalized, int& accessor) {
    std::vector<T> elements(count * GltfBuilder::components(type));
    for (T& value : elements) value = random_value<T>(random);
    accessor = add_scrambled(b, random, type, elements, normalized);
    std::vector<float> meant;
    for (const T value : elements) {
        const auto number = static_cast<double>(value);
        const double scaled = std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
        meant.push_back(static_cast<float>(normalized ? scaled : number));
    }
    return meant;
}

std::vector<float> add_random_of_any_type(GltfBuilder& b, Random& random, const std::string& type, std::size_t count,
                                          int& accessor) {
    const bool normalized = random_int(random, 0, 1) == 1;
    switch (random_int(random, 0, 4)) {
        case 0:
            return add_random<std::int8_t>(b, random, type, count, normalized, accessor);
        case 1:
            return add_random<std::uint8_t>(b, random, type, count, normalized, accessor);
        case 2:
            return add_random<std::int16_t>(b, random, type, count, normalized, accessor);
        case 3:
            return add_random<std::uint16_t>(b, random, type, count, normalized, accessor);
        default:
            return add_random<float>(b, random, type, count, false, accessor);
    }
}

TEST(GltfAccessorProperty, AnyEncodingReadsBackAsWritten) {
    const auto seed = static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed());
    for (unsigned round = 0; round < 300; ++round) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round));
        Random random(seed * 1000003U + round);
        const auto vertices = static_cast<std::size_t>(random_int(random, 3, 60));
        GltfBuilder b = GltfBuilder::triangle();
        int position = 0;
        int color = 0;
        const std::vector<float> positions = add_random_of_any_type(b, random, "VEC3", vertices, position);
        const bool rgba = random_int(random, 0, 1) == 1;
        const std::vector<float> colors = add_random_of_any_type(b, random, rgba ? "VEC4" : "VEC3", vertices, color);
        // Normals keep the reader from splitting the vertices.
        std::vector<float> normals;
        for (std::size_t i = 0; i < vertices; ++i) normals.insert(normals.end(), {0, 0, 1});
        b.primitive()["attributes"] = {
            {"POSITION", position}, {"COLOR_0", color}, {"NORMAL", b.accessor<float>("VEC3", normals)}};
        std::vector<std::uint16_t> indices(vertices);
        std::iota(indices.begin(), indices.end(), std::uint16_t{0});
        std::shuffle(indices.begin(), indices.end(), random);
        indices.resize(vertices / 3 * 3);
        b.primitive()["indices"] = b.accessor<std::uint16_t>("SCALAR", indices);

        const Expected<LoadedScene> loaded = b.load();
        if (!loaded) {
            // Coarse integers can happen to have no triangle with an area; nothing else may be wrong.
            EXPECT_NE(loaded.error().message.find("no triangles"), std::string::npos) << loaded.error().message;
            continue;
        }
        EXPECT_EQ(scene_defect(*loaded->scene), "");
        const Mesh& mesh = loaded->scene->meshes.at(0);
        ASSERT_EQ(mesh.position_m.size(), vertices);
        for (std::size_t i = 0; i < vertices; ++i) {
            for (int c = 0; c < 3; ++c)
                EXPECT_FLOAT_EQ(mesh.position_m[i][c], positions[3 * i + static_cast<std::size_t>(c)]);
            for (int c = 0; c < (rgba ? 4 : 3); ++c)
                EXPECT_FLOAT_EQ(mesh.color[i][c],
                                std::max(0.0F, colors[(rgba ? 4 : 3) * i + static_cast<std::size_t>(c)]));
        }
    }
}

}  // namespace
}  // namespace macula
