#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "masks/mesh/mesh_table.h"

namespace macula {

/// What was made of the two meshes that were used last, one for each eye: copies in GL memory, sorted triangles.
template <class Made>
class RecentMeshes {
public:
    /// Calls `make()` where nothing was made of the mesh yet. The result lasts until the next call.
    template <class Make>
    Made& get(const std::shared_ptr<const MeshTable>& mesh, Make&& make) {
        if (entries_[0].mesh != mesh) std::swap(entries_[0], entries_[1]);
        if (entries_[0].mesh != mesh) {
            entries_[0] = {};
            entries_[0].made.emplace(make());
            entries_[0].mesh = mesh;
        }
        return *entries_[0].made;
    }

private:
    struct Entry {
        std::shared_ptr<const MeshTable> mesh;  ///< kept, so that no other mesh gets its address
        std::optional<Made> made;
    };
    std::array<Entry, 2> entries_;
};

}  // namespace macula
