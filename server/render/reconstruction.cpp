#include "server/render/reconstruction.h"

#include <array>
#include <cstddef>

namespace macula {

namespace {

struct Named {
    Reconstruction reconstruction;
    const char* name;
};
constexpr std::array kNames = {
    Named{Reconstruction::tiles, "tiles"},      Named{Reconstruction::table, "table"},
    Named{Reconstruction::raster, "raster"},    Named{Reconstruction::push_pull, "push-pull"},
    Named{Reconstruction::cells, "cells"},      Named{Reconstruction::nearest, "nearest"},
    Named{Reconstruction::bilinear, "bilinear"}};

/// "", "a", "a or b", "a, b or c".
std::string list(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
    return text;
}

/// What the plan lacks for a reconstruction; empty: nothing.
std::string lack(Reconstruction reconstruction, const SamplePlan& plan) {
    switch (reconstruction) {
        case Reconstruction::tiles:
            return plan.has_tiles() ? "" : "tiles, which tile samplers make";
        case Reconstruction::table:
        case Reconstruction::raster:
            return plan.has_mesh() ? "" : "a mesh, which mesh samplers make";
        case Reconstruction::bilinear:
            return plan.has_grids() ? "" : "grids, which uniform, layered and log-polar samplers make";
        case Reconstruction::push_pull:
        case Reconstruction::cells:
        case Reconstruction::nearest:
            break;
    }
    const bool at_centres = (plan.has_tiles() || plan.has_mesh()) && plan.place.empty();
    return at_centres ? "" : "samples at pixel centres, which tile samplers and mesh samplers make";
}

}  // namespace

Expected<Reconstruction> parse_reconstruction(const std::string& text) {
    std::vector<std::string> names;
    for (const Named& known : kNames) {
        if (text == known.name) return known.reconstruction;
        names.emplace_back(known.name);
    }
    return fail(ErrorCode::option, "reconstruction must be " + list(names) + ", not \"" + text + "\"");
}

std::string to_string(Reconstruction reconstruction) {
    for (const Named& known : kNames)
        if (known.reconstruction == reconstruction) return known.name;
    return "?";
}

Expected<void> check_fits(Reconstruction reconstruction, const SamplePlan& plan) {
    const std::string lacking = lack(reconstruction, plan);
    if (lacking.empty()) return {};
    std::vector<std::string> fitting;
    for (const Named& known : kNames)
        if (lack(known.reconstruction, plan).empty()) fitting.emplace_back(known.name);
    const std::string advice =
        fitting.empty() ? "no reconstruction fits this sampler" : "for this sampler take " + list(fitting);
    return fail(ErrorCode::option, "reconstruction " + to_string(reconstruction) + " needs " + lacking + "; " + advice);
}

}  // namespace macula
