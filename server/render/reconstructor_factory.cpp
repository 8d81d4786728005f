#include "server/render/reconstructor_factory.h"

#include <utility>

#include "masks/tile_tables.h"
#include "server/render/grid_reconstructors.h"
#include "server/render/mesh_reconstructors.h"
#include "server/render/reconstructor_choice.h"
#include "server/render/scattered_reconstructors.h"

namespace macula {

namespace {

using Tables = std::shared_ptr<const TileTables>;

std::unique_ptr<Reconstructor> make_on_cpu(Reconstruction kind, const Tables& tables) {
    switch (kind) {
        case Reconstruction::tiles:
            return make_cpu_reconstructor(tables);
        case Reconstruction::table:
            return make_cpu_table_reconstructor();
        case Reconstruction::raster:
            return make_cpu_raster_reconstructor();
        case Reconstruction::push_pull:
        case Reconstruction::cells:
        case Reconstruction::nearest:
            return make_cpu_scattered_reconstructor(kind);
        case Reconstruction::bilinear:
            return make_cpu_grid_reconstructor();
    }
    return nullptr;
}

Expected<std::unique_ptr<Reconstructor>> make_on_gl(Reconstruction kind, ContextKind context_kind,
                                                    const Tables& tables) {
    auto context = make_gl_context(context_kind);
    if (!context) return tl::unexpected(context.error());
    switch (kind) {
        case Reconstruction::tiles:
            return make_gl_reconstructor(*std::move(context), *tables);
        case Reconstruction::table:
            return make_gl_table_reconstructor(*std::move(context));
        case Reconstruction::raster:
            return make_gl_raster_reconstructor(*std::move(context));
        case Reconstruction::push_pull:
        case Reconstruction::cells:
        case Reconstruction::nearest:
            return make_gl_scattered_reconstructor(kind, *std::move(context));
        case Reconstruction::bilinear:
            return make_gl_grid_reconstructor(*std::move(context));
    }
    return nullptr;
}

Expected<std::unique_ptr<Reconstructor>> make_chosen(Reconstruction kind, const ReconstructorChoice& choice,
                                                     const Tables& tables) {
    if (!choice.use_gl) return make_on_cpu(kind, tables);
    return make_on_gl(kind, choice.context, tables);
}

class ChosenReconstructorFactory final : public ReconstructorFactory {
public:
    ChosenReconstructorFactory(ReconstructorChoice choice, std::string name, std::shared_ptr<const TileTables> tables)
        : choice_(std::move(choice)), name_(std::move(name)), tables_(std::move(tables)) {}

    [[nodiscard]] Expected<std::unique_ptr<Reconstructor>> make(Reconstruction kind) const override {
        return make_chosen(kind, choice_, tables_);
    }
    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] const std::string& reason() const override { return choice_.reason; }

private:
    ReconstructorChoice choice_;
    std::string name_;
    std::shared_ptr<const TileTables> tables_;
};

}  // namespace

Expected<std::unique_ptr<ReconstructorFactory>> make_reconstructor_factory(const ReconstructorOptions& options,
                                                                           std::shared_ptr<const TileTables> tables) {
    const auto context = parse_context_kind(options.context);
    if (!context) return tl::unexpected(context.error());
    const auto on = parse_reconstruct_on(options.reconstruct_on);
    if (!on) return tl::unexpected(on.error());
    auto choice = choose_reconstructor(*context, *on, tables, {options.eye_width_px, options.eye_height_px});
    if (!choice) return tl::unexpected(choice.error());
    const auto first = make_chosen(Reconstruction::tiles, *choice, tables);
    if (!first) return tl::unexpected(first.error());
    return std::make_unique<ChosenReconstructorFactory>(std::move(*choice), (*first)->name(), std::move(tables));
}

}  // namespace macula
