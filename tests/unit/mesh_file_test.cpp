#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "masks/mesh/mesh_file.h"
#include "scenes/gltf.h"
#include "scenes/scene.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/triangulated.h"

namespace macula {
namespace {

namespace fs = std::filesystem;

class MeshFile : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(::testing::TempDir()) / ("mesh_file_test_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string path(const std::string& name = "mesh.glb") const { return (folder_ / name).string(); }
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

private:
    fs::path folder_;
};

SampleMesh mask(const std::string& recipe) {
    std::mt19937 random(20261122);
    SampleMesh mesh = testing::triangulated(50, 40, testing::scattered_sites(50, 40, 0.2, random), recipe);
    mesh.gaze_px = {13, 29};
    return mesh;
}

Bytes content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void expect_same(const SampleMesh& a, const SampleMesh& b) {
    EXPECT_EQ(a.width_px, b.width_px);
    EXPECT_EQ(a.height_px, b.height_px);
    EXPECT_EQ(a.gaze_px, b.gaze_px);
    EXPECT_EQ(a.recipe, b.recipe);
    EXPECT_EQ(a.triangle, b.triangle);
    ASSERT_EQ(a.site.size(), b.site.size());
    for (std::size_t i = 0; i < a.site.size(); ++i) {
        EXPECT_EQ(a.site[i].x_px, b.site[i].x_px);
        EXPECT_EQ(a.site[i].y_px, b.site[i].y_px);
    }
}

TEST_F(MeshFile, ComesBackAsItWas) {
    for (const char* recipe : {"", R"({"law": "Geisler-Perry", "note": "\"Größe\"\n"})"}) {
        const SampleMesh mesh = mask(recipe);
        const Expected<void> written = write_mesh(mesh, path());
        ASSERT_TRUE(written) << written.error().message;
        const Expected<SampleMesh> read = read_mesh(path());
        ASSERT_TRUE(read) << read.error().message;
        expect_same(mesh, *read);
        EXPECT_EQ(files(), 1U) << "nothing is left beside the file";
    }
}

TEST_F(MeshFile, ViewersSeeTheMaskUprightAndFromTheFront) {
    const SampleMesh mesh = mask("");
    ASSERT_TRUE(write_mesh(mesh, path()));
    const Expected<LoadedScene> loaded = load_gltf(path());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_TRUE(loaded->warnings.empty());
    ASSERT_EQ(loaded->scene->meshes.size(), 1U);
    const Mesh& seen = loaded->scene->meshes[0];
    ASSERT_EQ(seen.triangle.size(), mesh.triangle.size());
    float area = 0.0F;
    for (std::size_t i = 0; i < mesh.triangle.size(); ++i) {
        glm::vec3 corner[3];
        for (int k = 0; k < 3; ++k) {
            const SamplePosition s = mesh.site[mesh.triangle[i][k]];
            corner[k] = seen.position_m[seen.triangle[i][k]];
            EXPECT_EQ(corner[k], glm::vec3(s.x_px, -s.y_px, 0));
        }
        const glm::vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        EXPECT_GT(normal.z, 0.0F) << "counter-clockwise is the front in glTF";
        area += normal.z / 2.0F;
    }
    EXPECT_EQ(area, 49.0F * 39.0F);
}

TEST_F(MeshFile, NamesWhatCannotBeRead) {
    for (const std::string& name : {path("none.glb"), path(".")}) {
        const Expected<SampleMesh> read = read_mesh(name);
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().code, ErrorCode::input_file);
        EXPECT_NE(read.error().message.find(name), std::string::npos) << read.error().message;
    }
}

TEST_F(MeshFile, RefusesEveryFileThatIsCutOff) {
    ASSERT_TRUE(write_mesh(mask("{}"), path()));
    const Bytes whole = content(path());
    ASSERT_TRUE(read_mesh_from_memory(whole, "whole"));
    for (std::size_t size = 0; size < whole.size(); size += size < 2000 ? 1 : 97) {
        const auto read = read_mesh_from_memory(std::span(whole).first(size), "cut");
        ASSERT_FALSE(read) << size;
        EXPECT_EQ(read.error().code, ErrorCode::input_file);
    }
}

TEST_F(MeshFile, AFailedWriteLeavesNothingAndHarmsNothing) {
    const Expected<void> nowhere = write_mesh(mask(""), path("no/such/folder.glb"));
    ASSERT_FALSE(nowhere);
    EXPECT_EQ(nowhere.error().code, ErrorCode::output);
    EXPECT_NE(nowhere.error().message.find("folder.glb"), std::string::npos);

    ASSERT_TRUE(write_mesh(mask("good"), path()));
    const Expected<void> bad_text = write_mesh(mask("\xff\xfe"), path());
    ASSERT_FALSE(bad_text);
    EXPECT_EQ(bad_text.error().code, ErrorCode::output);
    EXPECT_EQ(read_mesh(path()).value().recipe, "good");
    EXPECT_EQ(files(), 1U);

    fs::create_directories(path("folder/inside"));
    EXPECT_FALSE(write_mesh(mask(""), path("folder"))) << "a folder is not replaced";
    EXPECT_EQ(files(), 2U);
}

/// A file whose JSON and buffer a test can change.
struct OpenFile {
    nlohmann::json json;
    Bytes buffer;

    explicit OpenFile(const Bytes& glb) {
        std::uint32_t length = 0;
        std::memcpy(&length, &glb[12], 4);
        const auto text = glb.begin() + 20;
        json = nlohmann::json::parse(text, text + length);
        buffer.assign(text + length + 8, glb.end());
    }
    [[nodiscard]] Bytes glb() const { return GltfBuilder::glb_of(json.dump(), buffer); }
    void set_position(std::size_t index, int component, float value) {
        std::memcpy(&buffer[12 * index + 4 * static_cast<std::size_t>(component)], &value, 4);
    }
};

TEST_F(MeshFile, RefusesWhatIsNotAMesh) {
    struct Case {
        const char* message;
        std::function<void(OpenFile&)> damage;
    };
    const std::vector<Case> cases = {
        {"no asset.extras.macula", [](OpenFile& f) { f.json["asset"].erase("extras"); }},
        {"no asset.extras.macula", [](OpenFile& f) { f.json["asset"]["extras"]["macula"] = 1; }},
        {"width_px is missing", [](OpenFile& f) { f.json["asset"]["extras"]["macula"].erase("width_px"); }},
        {"height_px is missing", [](OpenFile& f) { f.json["asset"]["extras"]["macula"]["height_px"] = 40.5; }},
        {"gaze_px is not two",
         [](OpenFile& f) {
             f.json["asset"]["extras"]["macula"]["gaze_px"] = {1, 2, 3};
         }},
        {"recipe is missing", [](OpenFile& f) { f.json["asset"]["extras"]["macula"]["recipe"] = 7; }},
        {"one mesh", [](OpenFile& f) { f.json["meshes"][0]["primitives"][0]["mode"] = 1; }},
        {"one mesh", [](OpenFile& f) { f.json["meshes"].push_back(nlohmann::json(f.json["meshes"][0])); }},
        {"no positions",
         [](OpenFile& f) {
             f.json["meshes"][0]["primitives"][0]["attributes"] = {{"NORMAL", 0}};
         }},
        {"no indices", [](OpenFile& f) { f.json["meshes"][0]["primitives"][0].erase("indices"); }},
        {"indices are not laid out", [](OpenFile& f) { f.json["accessors"][1]["componentType"] = 5123; }},
        {"positions are not laid out", [](OpenFile& f) { f.json["bufferViews"][0]["byteStride"] = 16; }},
        {"positions reach beyond", [](OpenFile& f) { f.json["bufferViews"][0]["byteLength"] = 1000000; }},
        {"multiple of 3",
         [](OpenFile& f) { f.json["accessors"][1]["count"] = f.json["accessors"][1]["count"].get<int>() - 1; }},
        {"position 3 is not", [](OpenFile& f) { f.set_position(3, 0, 1.5F); }},
        {"position 3 is not", [](OpenFile& f) { f.set_position(3, 1, 1.0F); }},
        {"position 3 is not", [](OpenFile& f) { f.set_position(3, 1, NAN); }},
        {"position 3 is not", [](OpenFile& f) { f.set_position(3, 0, 1e30F); }},
        {"position 3 is not", [](OpenFile& f) { f.set_position(3, 2, 1.0F); }},
        {"is not on the mask", [](OpenFile& f) { f.set_position(3, 0, 50.0F); }},
        {"sides are not", [](OpenFile& f) { f.json["asset"]["extras"]["macula"]["width_px"] = 1000000; }},
        {"refers to no other file", [](OpenFile& f) { f.json["buffers"][0]["uri"] = "/etc/passwd"; }},
    };
    ASSERT_TRUE(write_mesh(mask("{}"), path()));
    const OpenFile good(content(path()));
    ASSERT_TRUE(read_mesh_from_memory(good.glb(), "good"));
    for (const Case& c : cases) {
        OpenFile file = good;
        c.damage(file);
        const auto read = read_mesh_from_memory(file.glb(), "bad.glb");
        ASSERT_FALSE(read) << c.message;
        EXPECT_EQ(read.error().code, ErrorCode::input_file);
        EXPECT_EQ(read.error().message.rfind("bad.glb: ", 0), 0U) << read.error().message;
        EXPECT_NE(read.error().message.find(c.message), std::string::npos) << c.message << "; " << read.error().message;
    }
}

}  // namespace
}  // namespace macula
