#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "scenes/gltf.h"
#include "scenes/load.h"
#include "tests/support/encoded_image.h"
#include "tests/support/gltf_builder.h"

namespace macula {
namespace {

/// One thing that is wrong with an otherwise good file, and what the message has to say.
struct Refusal {
    const char* what;
    std::function<void(GltfBuilder&)> spoil;
    const char* message;
};

nlohmann::json& position_accessor(GltfBuilder& b) {
    return b.json["accessors"][b.primitive()["attributes"]["POSITION"].get<std::size_t>()];
}

void use_texture(GltfBuilder& b, const Bytes& encoded) {
    b.material()["emissiveTexture"] = {{"index", b.texture(encoded)}};
}

Bytes without_end(Bytes bytes) {
    bytes.resize(bytes.size() * 2 / 3);
    return bytes;
}

const std::vector<Refusal>& refusals() {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    static const std::vector<Refusal> kRefusals = {
        {"accessor out of range", [](auto& b) { b.primitive()["attributes"]["POSITION"] = 99; },
         "accessor 99: does not exist"},
        {"accessor of the wrong type", [](auto& b) { position_accessor(b)["type"] = "VEC2"; },
         "accessor 0: has to have 3"},
        {"accessor of a matrix", [](auto& b) { position_accessor(b)["type"] = "MAT4"; }, "accessor 0: has to have 3"},
        {"component type INT", [](auto& b) { position_accessor(b)["componentType"] = 5124; }, "component type 5124"},
        {"component type DOUBLE", [](auto& b) { position_accessor(b)["componentType"] = 5130; }, "component type 5130"},
        {"accessor beyond its view", [](auto& b) { position_accessor(b)["count"] = 4; },
         "accessor 0: its elements reach beyond"},
        {"offset beyond its view", [](auto& b) { position_accessor(b)["byteOffset"] = 4; },
         "accessor 0: its elements reach beyond"},
        {"offset that overflows", [](auto& b) { position_accessor(b)["byteOffset"] = 18446744073709551612ULL; },
         "accessor 0"},
        {"absurd count", [](auto& b) { position_accessor(b)["count"] = 4000000000U; }, "which is the limit"},
        {"absurd count without data",
         [](auto& b) {
             position_accessor(b).erase("bufferView");
             position_accessor(b)["count"] = 4000000000U;
         },
         "which is the limit"},
        {"many zeros without data",
         [](auto& b) {
             position_accessor(b).erase("bufferView");
             position_accessor(b)["count"] = 5000000;
         },
         "accessor 0: has more than 4194304 elements and no data"},
        {"empty accessor", [](auto& b) { position_accessor(b)["count"] = 0; }, "accessor 0: is empty"},
        {"view out of range", [](auto& b) { position_accessor(b)["bufferView"] = 77; },
         "buffer view 77 does not exist"},
        {"view beyond its buffer", [](auto& b) { b.json["bufferViews"][0]["byteLength"] = 100000; },
         "buffer view 0: reaches beyond"},
        {"view with overflowing offset",
         [](auto& b) { b.json["bufferViews"][0]["byteOffset"] = 18446744073709551612ULL; },
         "buffer view 0: reaches beyond"},
        {"buffer out of range", [](auto& b) { b.json["bufferViews"][0]["buffer"] = 3; }, "buffer 3 does not exist"},
        {"stride below the element", [](auto& b) { b.json["bufferViews"][0]["byteStride"] = 8; }, "stride"},
        {"NaN position",
         [](auto& b) {
             b.primitive()["attributes"]["POSITION"] =
                 b.template accessor<float>("VEC3", {0, kNan, 0, 1, 0, 0, 0, 1, 0});
         },
         "contains NaN or infinity (mesh 0, primitive 0, POSITION)"},
        {"infinite position",
         [](auto& b) {
             b.primitive()["attributes"]["POSITION"] =
                 b.template accessor<float>("VEC3", {0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 0, 1, 0});
         },
         "contains NaN or infinity (mesh 0, primitive 0, POSITION)"},
        {"NaN normal",
         [](auto& b) {
             b.primitive()["attributes"]["NORMAL"] = b.template accessor<float>("VEC3", {0, 0, 1, 0, 0, 1, kNan, 0, 1});
         },
         "contains NaN or infinity (mesh 0, primitive 0, NORMAL)"},
        {"NaN coordinate",
         [](auto& b) {
             use_texture(b, encode_image("png", 1, 1, 3, {1, 2, 3}));
             b.primitive()["attributes"]["TEXCOORD_0"] = b.template accessor<float>("VEC2", {0, 0, kNan, 0, 0, 1});
         },
         "contains NaN or infinity (mesh 0, primitive 0, TEXCOORD_0)"},
        {"coordinate beyond reason",
         [](auto& b) {
             use_texture(b, encode_image("png", 1, 1, 3, {1, 2, 3}));
             b.primitive()["attributes"]["TEXCOORD_0"] = b.template accessor<float>("VEC2", {0, 0, 1e9F, 0, 0, 1});
         },
         "TEXCOORD_0 goes beyond 1e6"},
        {"huge position",
         [](auto& b) {
             b.primitive()["attributes"]["POSITION"] =
                 b.template accessor<float>("VEC3", {0, 3e9F, 0, 1, 0, 0, 0, 1, 0});
         },
         "beyond 1e9"},
        {"index too large",
         [](auto& b) {
             b.primitive()["indices"] = b.template accessor<std::uint8_t>("SCALAR", {0, 1, 3});
         },
         "mesh 0, primitive 0: index 3 is used, but there are 3"},
        {"float indices",
         [](auto& b) {
             b.primitive()["indices"] = b.template accessor<float>("SCALAR", {0, 1, 2});
         },
         "unsigned integers (mesh 0, primitive 0, indices)"},
        {"signed indices",
         [](auto& b) {
             b.primitive()["indices"] = b.template accessor<std::int16_t>("SCALAR", {0, 1, 2});
         },
         "unsigned integers"},
        {"attributes of different length",
         [](auto& b) {
             b.primitive()["attributes"]["NORMAL"] = b.template accessor<float>("VEC3", {0, 0, 1, 0, 0, 1});
         },
         "NORMAL and POSITION differ"},
        {"sparse index too large",
         [](auto& b) {
             const int indices = b.view({3});
             const int values = b.view(Bytes(12, 0));
             position_accessor(b)["sparse"] = {{"count", 1},
                                               {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                               {"values", {{"bufferView", values}}}};
         },
         "accessor 0, sparse: index 3"},
        {"sparse count too large",
         [](auto& b) {
             position_accessor(b)["sparse"] = {{"count", 4},
                                               {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                                               {"values", {{"bufferView", 0}}}};
         },
         "accessor 0, sparse: the count"},
        {"normalised 32-bit integers",
         [](auto& b) {
             b.primitive()["attributes"]["COLOR_0"] =
                 b.template accessor<std::uint32_t>("VEC4", std::vector<std::uint32_t>(12), true);
         },
         "cannot be normalised"},
        {"unknown mode", [](auto& b) { b.primitive()["mode"] = 7; }, "mode 7 is not glTF"},
        {"mesh out of range", [](auto& b) { b.node()["mesh"] = 5; }, "node 0: mesh 5 does not exist"},
        {"material out of range", [](auto& b) { b.primitive()["material"] = 5; }, "material 5: does not exist"},
        {"scene out of range", [](auto& b) { b.json["scene"] = 5; }, "scene 5: does not exist"},
        {"root out of range",
         [](auto& b) {
             b.json["scenes"] = {{{"nodes", {5}}}};
         },
         "node 5: does not exist"},
        {"child out of range", [](auto& b) { b.node()["children"] = {5}; }, "node 5: does not exist"},
        {"node that is its own child", [](auto& b) { b.node()["children"] = {0}; },
         "node 0: has two parents or is its own"},
        {"node cycle",
         [](auto& b) {
             b.json["nodes"].push_back({{"children", {0}}});
             b.node()["children"] = {1};
         },
         "node 0: has two parents or is its own"},
        {"node with two parents",
         [](auto& b) {
             b.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
             b.json["scenes"] = {{{"nodes", {0, 1}}}};
         },
         "node 2: has two parents"},
        {"matrix of 15 numbers", [](auto& b) { b.node()["matrix"] = std::vector<double>(15, 1.0); }, "16 numbers"},
        {"matrix that projects", [](auto& b) { b.node()["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
         "not affine"},
        {"rotation of length zero",
         [](auto& b) {
             b.node()["rotation"] = {0, 0, 0, 0};
         },
         "length zero"},
        {"translation that overflows",
         [](auto& b) {
             b.node()["translation"] = {1e300, 0, 0};
         },
         "not finite"},
        {"transform that leads beyond floats when multiplied",
         [](auto& b) {
             b.node()["scale"] = {1e25, 1e25, 1e25};
         },
         "the transforms lead beyond what a float can hold"},
        {"nothing to show",
         [](auto& b) {
             b.json["scenes"] = {{{"nodes", nlohmann::json::array()}}};
         },
         "no triangles to show"},
        {"texture out of range",
         [](auto& b) {
             b.material()["emissiveTexture"] = {{"index", 5}};
         },
         "texture 5 does not exist"},
        {"image out of range",
         [](auto& b) {
             b.json["textures"] = {{{"source", 4}}};
             b.material()["emissiveTexture"] = {{"index", 0}};
         },
         "image 4: does not exist"},
        {"texture without image",
         [](auto& b) {
             b.json["textures"] = {nlohmann::json::object()};
             b.material()["emissiveTexture"] = {{"index", 0}};
         },
         "texture 0: has no PNG, JPEG or WebP"},
        {"sampler out of range",
         [](auto& b) {
             use_texture(b, encode_image("png", 1, 1, 3, {1, 2, 3}));
             b.json["textures"][0]["sampler"] = 2;
         },
         "sampler 2 does not exist"},
        {"unknown wrap mode",
         [](auto& b) {
             use_texture(b, encode_image("png", 1, 1, 3, {1, 2, 3}));
             b.json["samplers"] = {{{"wrapS", 1}}};
             b.json["textures"][0]["sampler"] = 0;
         },
         "sampler 0: the wrap mode"},
        {"third coordinate set",
         [](auto& b) {
             use_texture(b, encode_image("png", 1, 1, 3, {1, 2, 3}));
             b.material()["emissiveTexture"]["texCoord"] = 2;
         },
         "TEXCOORD_0 and TEXCOORD_1"},
        {"transform of a texture beyond reason",
         [](auto& b) {
             use_texture(b, encode_image("png", 1, 1, 3, {1, 2, 3}));
             b.material()["emissiveTexture"]["extensions"]["KHR_texture_transform"]["scale"] = {1e30, 1};
         },
         "material 0: KHR_texture_transform is malformed or beyond 1e6"},
        {"picture that is none",
         [](auto& b) {
             use_texture(b, {1, 2, 3});
         },
         "image 0: it is neither PNG nor JPEG"},
        {"PNG that is cut off",
         [](auto& b) { use_texture(b, without_end(encode_image("png", 16, 16, 3, Bytes(768, 9)))); },
         "image 0: the PNG data is cut off"},
        {"PNG with a wrong byte",
         [](auto& b) {
             Bytes png = encode_image("png", 16, 16, 3, Bytes(768, 9));
             png[png.size() - 20] ^= 1U;
             use_texture(b, png);
         },
         "image 0: it cannot be decoded"},
        {"JPEG that is cut off",
         [](auto& b) { use_texture(b, without_end(encode_image("jpeg", 16, 16, 3, Bytes(768, 9)))); },
         "image 0: the JPEG data is cut off"},
        {"picture beyond its buffer",
         [](auto& b) {
             use_texture(b, encode_image("png", 1, 1, 3, {1, 2, 3}));
             b.json["bufferViews"].back()["byteLength"] = 1000000;
         },
         "reaches beyond"},
        {"unknown alpha mode", [](auto& b) { b.material()["alphaMode"] = "DITHER"; }, "alphaMode \"DITHER\""},
        {"colour factor of three numbers",
         [](auto& b) {
             b.material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1};
         },
         "baseColorFactor"},
        {"unknown light type",
         [](auto& b) {
             b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "area"}}};
             b.node()["extensions"]["KHR_lights_punctual"]["light"] = 0;
         },
         "light 0: type \"area\""},
        {"light out of range", [](auto& b) { b.node()["extensions"]["KHR_lights_punctual"]["light"] = 3; },
         "light 3: does not exist"},
        {"cone inside out",
         [](auto& b) {
             b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
                 {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.7}, {"outerConeAngle", 0.6}}}}};
             b.node()["extensions"]["KHR_lights_punctual"]["light"] = 0;
         },
         "light 0: cone angles"},
        {"unknown required extension",
         [](auto& b) {
             b.json["extensionsRequired"] = {"KHR_texture_transform", "KHR_draco_mesh_compression"};
             b.json["buffers"] = {{{"byteLength", 4}, {"uri", "missing.bin"}}};
         },
         "requires the glTF extension KHR_draco_mesh_compression"},
        {"version 1", [](auto& b) { b.json["asset"]["version"] = "1.0"; }, "glTF version 1.0"},
        {"no asset", [](auto& b) { b.json.erase("asset"); }, "not valid glTF"},
        {"missing buffer file",
         [](auto& b) {
             b.json["buffers"] = {{{"byteLength", 36}, {"uri", "gone.bin"}}};
         },
         "gone.bin"},
        {"deep JSON",
         [](auto& b) {
             nlohmann::json deep = 1;
             for (int i = 0; i < 200; ++i) deep = nlohmann::json::array({deep});
             b.json["extras"] = deep;
         },
         "nested too deeply"},
    };
    return kRefusals;
}

TEST(GltfRefusal, EachDefectIsNamed) {
    for (const Refusal& refusal : refusals()) {
        GltfBuilder builder = GltfBuilder::textured_triangle();
        ASSERT_TRUE(builder.load()) << "the file is good before it is spoilt";
        refusal.spoil(builder);
        const Expected<LoadedScene> loaded = builder.load();
        ASSERT_FALSE(loaded) << refusal.what;
        EXPECT_EQ(loaded.error().code, ErrorCode::input_file) << refusal.what;
        EXPECT_NE(loaded.error().message.find(refusal.message), std::string::npos)
            << refusal.what << ": " << loaded.error().message;
        EXPECT_EQ(loaded.error().message.rfind("test.glb: ", 0), 0U) << loaded.error().message;
    }
}

TEST(GltfRefusal, EveryTruncationOfAGlb) {
    GltfBuilder builder = GltfBuilder::textured_triangle();
    use_texture(builder, encode_image("png", 4, 4, 3, Bytes(48, 77)));
    const Bytes whole = builder.glb();
    ASSERT_TRUE(load_gltf_from_memory(whole, "whole"));
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_FALSE(load_gltf_from_memory(std::span(whole).first(size), "cut")) << size;
}

TEST(GltfRefusal, ChunkThatEndsWithinItsHeader) {
    // tinygltf forgets the chunk header in its own check and would read 8 bytes beyond the file.
    Bytes glb = GltfBuilder::triangle().glb();
    const std::size_t json_bytes = glb[12] | static_cast<std::size_t>(glb[13]) << 8U;
    const std::size_t length_at = 20 + json_bytes;
    glb[length_at] = static_cast<std::uint8_t>(glb[length_at] + 8);
    const Expected<LoadedScene> loaded = load_gltf_from_memory(glb, "test.glb");
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message.find("binary chunk is cut off"), std::string::npos) << loaded.error().message;
}

TEST(GltfRefusal, LimitsAreKept) {
    GltfBuilder builder = GltfBuilder::textured_triangle();
    use_texture(builder, encode_image("png", 4, 4, 3, Bytes(48, 77)));
    const auto message = [&builder](GltfLimits limits) {
        const Expected<LoadedScene> loaded = builder.load(limits);
        return loaded ? std::string("loaded") : loaded.error().message;
    };
    EXPECT_EQ(message({.elements = 6, .texels = 16, .image_side_px = 4, .instances = 1}), "loaded");
    EXPECT_NE(message({.file_bytes = 100}).find("larger than 100 bytes"), std::string::npos);
    EXPECT_NE(message({.elements = 5}).find("more than 5 vertices"), std::string::npos);
    EXPECT_NE(message({.texels = 15}).find("too large: 4 x 4"), std::string::npos);
    EXPECT_NE(message({.image_side_px = 3}).find("too large: 4 x 4"), std::string::npos);
    EXPECT_NE(message({.instances = 0}).find("more than 0 instances"), std::string::npos);
}

/// A folder that goes away with the test.
class GltfFiles : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "macula-gltf-XXXXXX").string();
        ASSERT_TRUE(mkdtemp(pattern.data()));
        root_ = pattern;
        std::filesystem::create_directories(root_ / "scene/textures");
    }
    void TearDown() override { std::filesystem::remove_all(root_); }

    void write(const std::string& name, const Bytes& bytes) {
        std::ofstream(root_ / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    /// Loads a text file whose buffer and image have these uris.
    Expected<LoadedScene> load(const std::string& buffer_uri, const std::string& image_uri) {
        GltfBuilder b = GltfBuilder::textured_triangle();
        b.json["buffers"] = {{{"byteLength", b.buffer.size()}, {"uri", buffer_uri}}};
        b.json["images"] = {{{"uri", image_uri}}};
        b.json["textures"] = {{{"source", 0}}};
        b.material()["emissiveTexture"] = {{"index", 0}};
        write("scene/scene.gltf", Bytes());
        const std::string text = b.gltf();
        write("scene/scene.gltf", Bytes(text.begin(), text.end()));
        for (const char* place : {"scene/a b.bin", "outside.bin"}) write(place, b.buffer);
        for (const char* place : {"scene/textures/t.png", "outside.png"})
            write(place, encode_image("png", 1, 1, 3, {10, 20, 30}));
        return load_scene((root_ / "scene/scene.gltf").string());
    }
    void expect_refused(const std::string& buffer_uri, const std::string& image_uri, const std::string& message) {
        const Expected<LoadedScene> loaded = load(buffer_uri, image_uri);
        ASSERT_FALSE(loaded) << buffer_uri << " " << image_uri;
        EXPECT_EQ(loaded.error().code, ErrorCode::input_file);
        EXPECT_NE(loaded.error().message.find(message), std::string::npos) << loaded.error().message;
        EXPECT_NE(loaded.error().message.find("scene.gltf"), std::string::npos) << loaded.error().message;
    }

    std::filesystem::path root_;
};

TEST_F(GltfFiles, RelativeUrisBelowTheFolder) {
    const Expected<LoadedScene> loaded = load("a%20b.bin", "textures/t.png");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    EXPECT_EQ(loaded->scene->images.at(0).name, "textures/t.png");
}

TEST_F(GltfFiles, UrisThatLeaveTheFolder) {
    expect_refused("../outside.bin", "textures/t.png", "leaves the folder");
    expect_refused("textures/../../outside.bin", "textures/t.png", "leaves the folder");
    expect_refused("%2e%2e/outside.bin", "textures/t.png", "leaves the folder");
    expect_refused((root_ / "outside.bin").string(), "textures/t.png", "leaves the folder");
    expect_refused("a%20b.bin", "../outside.png", "leaves the folder");
    expect_refused("a%20b.bin", (root_ / "outside.png").string(), "leaves the folder");
}

TEST_F(GltfFiles, MissingFiles) {
    expect_refused("gone.bin", "textures/t.png", "gone.bin");
    expect_refused("a%20b.bin", "textures/gone.png", "image 0 (\"textures/gone.png\"): the image file is missing");
    const Expected<LoadedScene> none = load_scene((root_ / "none.glb").string());
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::input_file);
    EXPECT_NE(none.error().message.find("none.glb"), std::string::npos);
}

TEST_F(GltfFiles, BrokenPicture) {
    write("scene/broken.png", {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 1, 2, 3});
    expect_refused("a%20b.bin", "broken.png", "image 0 (\"broken.png\"): the PNG data is cut off");
}

TEST(LoadScene, UnknownName) {
    const Expected<LoadedScene> loaded = load_scene("bunny");
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().code, ErrorCode::option);
    EXPECT_NE(loaded.error().message.find("bunny-box"), std::string::npos);
}

}  // namespace
}  // namespace macula
