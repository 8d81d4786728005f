#include "server/render/reconstructor_factory.h"

#include <utility>

#include "server/render/reconstructor_choice.h"

namespace macula {

namespace {

Expected<std::unique_ptr<Reconstructor>> make_chosen(const ReconstructorChoice& choice,
                                                     const std::shared_ptr<const TileTables>& tables) {
    if (!choice.use_gl) return make_cpu_reconstructor(tables);
    auto context = make_gl_context(choice.context);
    if (!context) return tl::unexpected(context.error());
    return make_gl_reconstructor(std::move(*context), *tables);
}

class ChosenReconstructorFactory final : public ReconstructorFactory {
public:
    ChosenReconstructorFactory(ReconstructorChoice choice, std::string name, std::shared_ptr<const TileTables> tables)
        : choice_(std::move(choice)), name_(std::move(name)), tables_(std::move(tables)) {}

    [[nodiscard]] Expected<std::unique_ptr<Reconstructor>> make() const override {
        return make_chosen(choice_, tables_);
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
    const auto first = make_chosen(*choice, tables);
    if (!first) return tl::unexpected(first.error());
    return std::make_unique<ChosenReconstructorFactory>(std::move(*choice), (*first)->name(), std::move(tables));
}

}  // namespace macula
