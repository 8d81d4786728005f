#include "masks/make/mesh_store.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <vector>

#include "masks/levels.h"
#include "masks/mesh/mesh_file.h"
#include "masks/mesh/triangulate.h"
#include "masks/sample_order.h"

namespace macula {
namespace {

void tell(const MaskProgress& progress, const std::string& stage, double share) {
    if (progress) progress(stage, share);
}

/// Top left pixels of the 16x16 blocks that cover a mask, in Morton order.
std::vector<glm::ivec2> blocks_in_order(glm::ivec2 size_px) {
    std::vector<glm::ivec2> blocks;
    for (int y = 0; y < size_px.y; y += kTileEdge_px)
        for (int x = 0; x < size_px.x; x += kTileEdge_px) blocks.emplace_back(x, y);
    const auto along = [](glm::ivec2 p) {
        return morton(static_cast<std::uint32_t>(p.x / kTileEdge_px), static_cast<std::uint32_t>(p.y / kTileEdge_px));
    };
    std::sort(blocks.begin(), blocks.end(), [&](glm::ivec2 a, glm::ivec2 b) { return along(a) < along(b); });
    return blocks;
}

std::vector<SamplePosition> ordered_sites(const Mask& mask) {
    const glm::ivec2 size_px(mask.width_px, mask.height_px);
    std::vector<SamplePosition> sites;
    for (const glm::ivec2 begin : blocks_in_order(size_px)) {
        const glm::ivec2 end = glm::min(begin + kTileEdge_px, size_px);
        for (int y = begin.y; y < end.y; ++y) {
            for (int x = begin.x; x < end.x; ++x) {
                if (mask.sampled[static_cast<std::size_t>(y) * size_px.x + x] != 0)
                    sites.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
            }
        }
    }
    return sites;
}

}  // namespace

SampleMesh triangulate_mask(const Mask& mask, const MaskProgress& progress) {
    tell(progress, "triangulating", 0.0);
    SampleMesh mesh;
    mesh.width_px = mask.width_px;
    mesh.height_px = mask.height_px;
    mesh.gaze_px = mask.gaze_px;
    Mask closed = mask;
    close_border(closed);
    mesh.site = ordered_sites(closed);
    mesh.triangle = triangulate(mesh.site);
    mesh.recipe = mask.recipe;
    tell(progress, "triangulating", 1.0);
    return mesh;
}

Expected<std::filesystem::path> default_mesh_cache() {
    // Relative paths are to be ignored (XDG Base Directory Specification).
    const char* const cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && std::filesystem::path(cache).is_absolute())
        return std::filesystem::path(cache) / "macula" / "meshes";
    const char* const home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return std::filesystem::path(home) / ".cache" / "macula" / "meshes";
    return fail(ErrorCode::option,
                "no place for made meshes: set XDG_CACHE_HOME or HOME, or name a folder for them in the options");
}

Expected<SampleMesh> obtain_mesh(const Recipe& recipe, const std::filesystem::path& cache,
                                 const MaskProgress& progress) {
    const std::string wanted = to_json(recipe);
    const std::filesystem::path file = cache / (recipe_hash(wanted) + ".glb");
    std::error_code error;
    if (std::filesystem::exists(file, error)) {
        tell(progress, "reading " + file.string(), 0.0);
        Expected<SampleMesh> mesh = read_mesh(file.string());
        if (mesh && mesh->recipe == wanted) {
            tell(progress, "reading " + file.string(), 1.0);
            return mesh;
        }
    }

    Expected<Mask> mask = make_mask(recipe, progress);
    if (!mask) return tl::unexpected(mask.error());
    SampleMesh mesh = triangulate_mask(*mask, progress);
    std::filesystem::create_directories(cache, error);
    const Expected<void> written = write_mesh(mesh, file.string());
    tell(progress, written ? "written to " + file.string() : "not kept: " + written.error().message, 1.0);
    return mesh;
}

}  // namespace macula
