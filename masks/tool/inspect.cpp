// macula-mask inspect

#include <charconv>
#include <utility>

#include "masks/make/density.h"
#include "masks/make/mesh_store.h"
#include "masks/tool/commands.h"
#include "masks/tool/inspection.h"
#include "masks/tool/mask_input.h"
#include "masks/tool/output_file.h"

namespace macula {
namespace {

/// Edges in degrees, ascending, two at least; none for an empty text.
Expected<std::vector<double>> parse_rings(const std::string& text) {
    std::vector<double> edges;
    const auto wrong = [&text] {
        return fail(ErrorCode::option, "--rings " + text +
                                           ": it must be two or more ascending degrees from 0 to 180, "
                                           "as in 0,5,10,20");
    };
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        double edge = 0.0;
        const auto [last, error] = std::from_chars(text.data() + begin, text.data() + end, edge);
        if (error != std::errc() || last != text.data() + end || !(edge >= 0.0 && edge <= 180.0) ||
            (!edges.empty() && edge <= edges.back()))
            return wrong();
        edges.push_back(edge);
        begin = end + 1;
    }
    if (edges.size() == 1) return wrong();
    return edges;
}

/// The file's recipe with what the options say instead. Nothing without either.
Expected<InspectionBasis> basis_of(const InspectOptions& options, const MaskInput& input) {
    if (!input.recipe && options.display.empty())
        return fail(ErrorCode::option,
                    options.file + " has no recipe that says which display it is for; name it with --display");
    Recipe recipe;
    if (input.recipe) {
        recipe = *input.recipe;
    } else {
        const auto geometry = parse_mask_geometry(options.geometry);
        if (!geometry) return tl::unexpected(geometry.error());
        recipe.geometry = *geometry;
    }
    if (!options.display.empty()) {
        auto display = load_display(options.display);
        if (!display) return tl::unexpected(display.error());
        recipe.display = *std::move(display);
    }
    const bool compared = input.recipe || !options.sampling.empty();
    if (!options.sampling.empty()) {
        auto preset = parse_sampling(options.sampling);
        if (!preset) return tl::unexpected(preset.error());
        recipe.preset = *std::move(preset);
    }
    InspectionBasis basis{recipe.display, recipe.geometry, std::nullopt, compared && recipe.preset.full};
    if (compared && !basis.full) basis.law = mask_law(recipe);
    return basis;
}

}  // namespace

Expected<void> run(const InspectOptions& options) {
    auto edges = parse_rings(options.rings);
    if (!edges) return tl::unexpected(edges.error());
    if (!options.json.empty()) {
        if (auto writable = check_writable(options.json); !writable) return writable;
    }
    const auto input = read_mask_input(options.file);
    if (!input) return tl::unexpected(input.error());
    const auto basis = basis_of(options, *input);
    if (!basis) return tl::unexpected(basis.error());
    const SampleMesh mesh = input->mesh ? *input->mesh : triangulate_mask(input->mask);
    const Inspection inspection = inspect(input->mask, mesh, *basis, *std::move(edges));
    if (!options.json.empty()) {
        auto written = write_whole(options.json, to_json(inspection, options.file, input->mask.recipe));
        if (!written || options.json == "-") return written;
    }
    return write_whole("-", to_table(inspection, options.file, input->mask.recipe));
}

}  // namespace macula
