#include "masks/make/mesh_store.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "masks/levels.h"
#include "masks/mesh/mesh_file.h"
#include "masks/mesh/mesh_table.h"
#include "masks/sample_order.h"
#include "tests/support/small_display.h"

namespace macula {
namespace {

namespace fs = std::filesystem;

Recipe recipe_of(const std::string& sampling, Placement placement = Placement::void_and_cluster) {
    return {test::small_display(92, 104), parse_sampling(sampling).value(), placement, MaskGeometry::flat, 3};
}

void expect_same(const SampleMesh& a, const SampleMesh& b) {
    EXPECT_EQ(a.width_px, b.width_px);
    EXPECT_EQ(a.height_px, b.height_px);
    EXPECT_EQ(a.gaze_px, b.gaze_px);
    EXPECT_EQ(a.recipe, b.recipe);
    EXPECT_EQ(a.triangle, b.triangle);
    ASSERT_EQ(a.site.size(), b.site.size());
    const auto same = [](SamplePosition p, SamplePosition q) { return p.x_px == q.x_px && p.y_px == q.y_px; };
    EXPECT_TRUE(std::equal(a.site.begin(), a.site.end(), b.site.begin(), same));
}

class MeshStore : public testing::Test {
protected:
    MeshStore() {
        const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
        cache_ = fs::path(testing::TempDir()) / (std::string("macula_mesh_store_") + info->name());
        fs::remove_all(cache_);
    }
    ~MeshStore() override { fs::remove_all(cache_); }

    /// obtain_mesh(), which must not fail, and whether it made the mesh.
    [[nodiscard]] std::pair<SampleMesh, bool> obtain(const Recipe& recipe, const fs::path& cache) const {
        bool made = false;
        auto mesh = obtain_mesh(recipe, cache, [&made](const std::string& stage, double share) {
            EXPECT_TRUE(share >= 0.0 && share <= 1.0) << stage;
            made = made || stage == "triangulating";
        });
        if (!mesh) throw std::runtime_error(mesh.error().message);
        return {*std::move(mesh), made};
    }

    [[nodiscard]] fs::path file_of(const Recipe& recipe) const {
        return cache_ / (recipe_hash(to_json(recipe)) + ".glb");
    }

    fs::path cache_;
};

TEST_F(MeshStore, KeepsWhatWasMade) {
    const Recipe recipe = recipe_of("27");
    const auto [made, was_made] = obtain(recipe, cache_ / "new" / "folder");
    EXPECT_TRUE(was_made);
    EXPECT_EQ(made.recipe, to_json(recipe));
    expect_same(made, triangulate_mask(make_mask(recipe).value()));
    const auto [read, made_again] = obtain(recipe, cache_ / "new" / "folder");
    EXPECT_FALSE(made_again);
    expect_same(read, made);
    EXPECT_TRUE(obtain(recipe_of("28"), cache_ / "new" / "folder").second);
    // Nothing but the two files is left behind.
    EXPECT_EQ(std::distance(fs::directory_iterator(cache_ / "new" / "folder"), fs::directory_iterator()), 2);
}

TEST_F(MeshStore, MakesAnewWhatIsDamagedOrAnothers) {
    const Recipe recipe = recipe_of("27");
    const SampleMesh mesh = obtain(recipe, cache_).first;
    const auto size = fs::file_size(file_of(recipe));
    const auto expect_repaired = [&](const char* what) {
        const auto [repaired, made] = obtain(recipe, cache_);
        EXPECT_TRUE(made) << what;
        expect_same(repaired, mesh);
        EXPECT_FALSE(obtain(recipe, cache_).second) << what;
    };
    fs::resize_file(file_of(recipe), size / 2);
    expect_repaired("cut off");
    fs::resize_file(file_of(recipe), 0);
    expect_repaired("empty");
    std::fstream(file_of(recipe), std::ios::binary | std::ios::in | std::ios::out)
        .seekp(size / 2)
        .write("\xff\xff\xff\xff", 4);
    expect_repaired("overwritten");
    ASSERT_TRUE(write_mesh(obtain(recipe_of("41"), cache_).first, file_of(recipe).string()));
    expect_repaired("of another recipe");
    SampleMesh other = mesh;
    other.recipe.clear();
    ASSERT_TRUE(write_mesh(other, file_of(recipe).string()));
    expect_repaired("without recipe");
}

TEST_F(MeshStore, ThatCannotBeWrittenCostsOnlyTime) {
    std::ofstream(cache_.string()) << "a file where the folder should be";
    const Recipe recipe = recipe_of("27");
    bool told = false;
    const auto mesh = obtain_mesh(recipe, cache_, [&told](const std::string& stage, double) {
        told = told || stage.find("not kept") != std::string::npos;
    });
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(told);
    expect_same(*mesh, triangulate_mask(make_mask(recipe).value()));
}

TEST_F(MeshStore, HandsOnTheErrorsOfTheMaking) {
    const auto mesh = obtain_mesh(recipe_of("1"), cache_);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::option);
    EXPECT_FALSE(fs::exists(file_of(recipe_of("1"))));
}

TEST_F(MeshStore, ServesSeveralThreadsAtOnce) {
    const Recipe recipe = recipe_of("27");
    const SampleMesh expected = triangulate_mask(make_mask(recipe).value());
    std::vector<std::thread> threads;
    std::vector<SampleMesh> meshes(4);
    for (SampleMesh& mesh : meshes) {
        threads.emplace_back([&mesh, &recipe, this] {
            for (int round = 0; round < 3; ++round) mesh = obtain_mesh(recipe, cache_).value();
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const SampleMesh& mesh : meshes) expect_same(mesh, expected);
    EXPECT_FALSE(obtain(recipe, cache_).second);
}

TEST(DefaultMeshCache, FollowsTheEnvironment) {
    const auto saved = [](const char* name) {
        return std::getenv(name) == nullptr ? std::string() : std::getenv(name);
    };
    const std::string home = saved("HOME");
    const std::string cache = saved("XDG_CACHE_HOME");
    setenv("HOME", "/home/someone", 1);
    setenv("XDG_CACHE_HOME", "/var/cache/someone", 1);
    EXPECT_EQ(default_mesh_cache().value(), "/var/cache/someone/macula/meshes");
    setenv("XDG_CACHE_HOME", "not/absolute", 1);
    EXPECT_EQ(default_mesh_cache().value(), "/home/someone/.cache/macula/meshes");
    unsetenv("XDG_CACHE_HOME");
    EXPECT_EQ(default_mesh_cache().value(), "/home/someone/.cache/macula/meshes");
    unsetenv("HOME");
    EXPECT_EQ(default_mesh_cache().error().code, ErrorCode::option);
    if (!home.empty()) setenv("HOME", home.c_str(), 1);
    if (!cache.empty()) setenv("XDG_CACHE_HOME", cache.c_str(), 1);
}

TEST(TriangulateMask, HasTheMasksSitesInTheOrderOfBlocks) {
    const Mask mask = make_mask(recipe_of("27")).value();
    const SampleMesh mesh = triangulate_mask(mask);
    EXPECT_EQ(mesh_defect(mesh), "");
    EXPECT_EQ(mesh.recipe, mask.recipe);
    EXPECT_EQ(mesh.gaze_px, mask.gaze_px);
    EXPECT_EQ(mesh.site.size(), std::count(mask.sampled.begin(), mask.sampled.end(), 1));
    const auto order = [](SamplePosition p) {
        const auto x = static_cast<std::uint32_t>(p.x_px);
        const auto y = static_cast<std::uint32_t>(p.y_px);
        return std::tuple(morton(x / kTileEdge_px, y / kTileEdge_px), y, x);
    };
    for (std::size_t i = 0; i < mesh.site.size(); ++i) {
        ASSERT_EQ(mask.sampled[static_cast<std::size_t>(mesh.site[i].y_px) * mask.width_px + mesh.site[i].x_px], 1);
        if (i > 0) {
            ASSERT_LT(order(mesh.site[i - 1]), order(mesh.site[i]));
        }
    }
}

TEST(TriangulateMask, LeavesNoPixelFarFromItsCorners) {
    for (const char* sampling : {"full", "18"}) {
        for (const Placement placement : {Placement::void_and_cluster, Placement::floyd_steinberg,
                                          Placement::poisson_disk, Placement::white_noise, Placement::quincunx}) {
            const SampleMesh mesh = triangulate_mask(make_mask(recipe_of(sampling, placement)).value());
            int longest_px = 0;
            for (const SampleMesh::Triangle& triangle : mesh.triangle) {
                for (int i = 0; i < 3; ++i) {
                    const SamplePosition a = mesh.site[triangle[i]];
                    const SamplePosition b = mesh.site[triangle[(i + 1) % 3]];
                    longest_px = std::max({longest_px, std::abs(a.x_px - b.x_px), std::abs(a.y_px - b.y_px)});
                }
            }
            EXPECT_LE(longest_px, kMeshReach_px / 2) << sampling << ", " << to_string(placement);
        }
    }
}

TEST(TriangulateMask, ClosesTheBorderOfAUsersMask) {
    Mask mask{150, 90, {75, 45}, std::vector<std::uint8_t>(std::size_t{150} * 90, 0), {}};
    mask.sampled[45 * 150 + 75] = 1;
    const SampleMesh mesh = triangulate_mask(mask);
    EXPECT_EQ(mesh_defect(mesh), "");
    EXPECT_GT(mesh.site.size(), 2 * (150 + 90) / 8U);
}

}  // namespace
}  // namespace macula
