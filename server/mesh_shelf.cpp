#include "server/mesh_shelf.h"

#include <chrono>
#include <utility>

#include <fmt/core.h>

#include "masks/make/mesh_store.h"
#include "masks/mesh/mesh_file.h"

namespace macula {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

Expected<std::shared_ptr<const MeshTable>> make_table(SampleMesh mesh) {
    auto table = MeshTable::make(std::move(mesh));
    if (!table) return tl::unexpected(table.error());
    return std::make_shared<const MeshTable>(*std::move(table));
}

std::string told(const std::string& what, const MeshTable& table, double seconds) {
    const SampleMesh& mesh = table.mesh();
    return fmt::format("mesh {}: {} sites and {} triangles on {}x{} pixels, {:.0f} MB; ready in {:.2f} s", what,
                       mesh.site.size(), mesh.triangle.size(), mesh.width_px, mesh.height_px,
                       1e-6 * static_cast<double>(table.memory_bytes()), seconds);
}

}  // namespace

MeshShelf::MeshShelf(std::filesystem::path cache, Log log) : cache_(std::move(cache)), log_(std::move(log)) {
    if (!cache_.empty()) return;
    if (auto usual = default_mesh_cache()) cache_ = *std::move(usual);
}

Expected<void> MeshShelf::read_own(const std::string& path) {
    const auto begin = Clock::now();
    auto mesh = read_mesh(path);
    if (!mesh) return tl::unexpected(mesh.error());
    auto table = make_table(*std::move(mesh));
    if (!table) return tl::unexpected(table.error());
    own_ = *std::move(table);
    log_(told(path, *own_, seconds_since(begin)));
    return {};
}

Expected<std::shared_ptr<const MeshTable>> MeshShelf::own() const {
    if (own_ == nullptr)
        return fail(ErrorCode::option, "sampling 'mesh:file' needs a mesh file: start the server with --mesh FILE");
    return own_;
}

Expected<std::shared_ptr<const MeshTable>> MeshShelf::mesh(const Display& display, const SamplingPreset& preset) {
    Recipe recipe;
    recipe.display = display;
    recipe.preset = preset;
    const std::string key = to_json(recipe);
    const std::lock_guard lock(mutex_);
    std::weak_ptr<const MeshTable>& place = by_recipe_[key];
    if (auto there = place.lock()) return there;
    const auto begin = Clock::now();
    auto mesh = obtain_mesh(
        recipe, cache_, [this, next = begin + std::chrono::seconds(1)](const std::string& stage, double share) mutable {
            if (Clock::now() < next) return;
            next = Clock::now() + std::chrono::seconds(1);
            log_(fmt::format("making a mesh: {:.0f} %, {}", 100.0 * share, stage));
        });
    if (!mesh) return tl::unexpected(mesh.error());
    auto table = make_table(*std::move(mesh));
    if (!table) return tl::unexpected(table.error());
    place = *table;
    newest_ = *table;
    log_(told(preset.name, **table, seconds_since(begin)));
    return *table;
}

}  // namespace macula
