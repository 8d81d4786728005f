#include "server/method_parts.h"

#include <utility>

#include "masks/law.h"
#include "masks/mesh/mesh_sampler.h"
#include "masks/rivals/layer_sampler.h"
#include "masks/rivals/log_polar_sampler.h"
#include "masks/rivals/uniform_sampler.h"

namespace macula {
namespace {

std::unique_ptr<Sampler> make_tile_sampler(const SamplingPreset& preset, const Display& display, Eye eye,
                                           const std::shared_ptr<const TileTables>& tables,
                                           const TileSamplerOptions& options) {
    return std::make_unique<TileSampler>(display, eye, tile_law(display, eye, preset), tables, options);
}

Expected<std::unique_ptr<Sampler>> make_mesh_sampler(const Method& method, const Display& display, Eye eye,
                                                     MeshShelf& meshes) {
    auto mesh = method.mesh_file ? meshes.own() : meshes.mesh(display, method.preset);
    if (!mesh) return tl::unexpected(mesh.error());
    if (auto covers = check_mask_covers((*mesh)->mesh(), display); !covers) return tl::unexpected(covers.error());
    return std::make_unique<MeshSampler>(display, eye, *std::move(mesh), method.mesh_step_px);
}

/// Share of the buffer that a preset asks for; where it asks for none, as much as tiles would sample by its law, so
/// that the two can be compared.
double share_of(const SamplingPreset& preset, const Display& display, Eye eye) {
    if (preset.full) return 1.0;
    if (preset.free != SamplingPreset::Free::nothing) return preset.share;
    return tile_share(display, eye, preset.law);
}

}  // namespace

Expected<std::unique_ptr<Sampler>> make_sampler(const Method& method, const Display& display, Eye eye,
                                                const std::shared_ptr<const TileTables>& tables, MeshShelf& meshes,
                                                const TileSamplerOptions& tiles) {
    switch (method.sampler) {
        case SamplerKind::tiles:
            return make_tile_sampler(method.preset, display, eye, tables, tiles);
        case SamplerKind::mesh:
            return make_mesh_sampler(method, display, eye, meshes);
        case SamplerKind::uniform:
            return std::make_unique<UniformSampler>(display, eye, share_of(method.preset, display, eye));
        case SamplerKind::layers:
            return std::make_unique<LayerSampler>(display, eye, share_of(method.preset, display, eye));
        case SamplerKind::log_polar:
            return LogPolarSampler::make(display, eye, share_of(method.preset, display, eye));
    }
    return nullptr;
}

}  // namespace macula
