#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/mesh/mesh_table.h"
#include "protocol/base/error.h"

namespace macula {

/// The meshes that sessions use: each is made or read once and shared while anybody holds it; the newest one stays. May
/// be called from several threads; who asks for a mesh that is not there yet waits for it, some seconds if it is not in
/// the cache.
class MeshShelf {
public:
    /// Told what is being done, at most about every second.
    using Log = std::function<void(const std::string&)>;

    /// `cache`: folder of finished meshes; empty: default_mesh_cache(), or none where there is no home.
    MeshShelf(std::filesystem::path cache, Log log);

    /// Reads the mesh file of --mesh and keeps it. Errors: `input_file`.
    Expected<void> read_own(const std::string& path);
    /// What read_own() read. Errors: `option`, if nothing was.
    [[nodiscard]] Expected<std::shared_ptr<const MeshTable>> own() const;

    /// Void-and-cluster mask in flat geometry for the display and the preset. One for both eyes, which are mirror
    /// images of each other. Errors: those of obtain_mesh().
    Expected<std::shared_ptr<const MeshTable>> mesh(const Display& display, const SamplingPreset& preset);

private:
    std::filesystem::path cache_;
    Log log_;
    std::shared_ptr<const MeshTable> own_;
    std::mutex mutex_;
    std::map<std::string, std::weak_ptr<const MeshTable>> by_recipe_;
    std::shared_ptr<const MeshTable> newest_;  ///< for a client that gave up waiting and comes again
};

}  // namespace macula
