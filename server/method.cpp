#include "server/method.h"

#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace macula {
namespace {

constexpr int kLargestStep_px = 64;

struct SamplerName {
    std::string_view name;
    SamplerKind kind;
    Reconstruction own;
};

constexpr std::array<SamplerName, 5> kSamplers = {{{"tiles", SamplerKind::tiles, Reconstruction::tiles},
                                                   {"mesh", SamplerKind::mesh, Reconstruction::table},
                                                   {"uniform", SamplerKind::uniform, Reconstruction::bilinear},
                                                   {"layers", SamplerKind::layers, Reconstruction::bilinear},
                                                   {"log-polar", SamplerKind::log_polar, Reconstruction::bilinear}}};

const SamplerName& named(SamplerKind kind) {
    return kSamplers[static_cast<std::size_t>(kind)];
}

std::string in_quotes(std::string_view text) {
    std::string result = "'";
    result.append(text).append("'");
    return result;
}

/// Reads "mesh-16" into the method. False: it is something else.
bool parse_stepped_mesh(std::string_view text, Method& method) {
    constexpr std::string_view kPrefix = "mesh-";
    if (!text.starts_with(kPrefix)) return false;
    text.remove_prefix(kPrefix.size());
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), method.mesh_step_px);
    method.sampler = SamplerKind::mesh;
    return error == std::errc() && end == text.data() + text.size() && method.mesh_step_px >= 1 &&
           method.mesh_step_px <= kLargestStep_px;
}

Expected<void> parse_sampler(std::string_view text, Method& method) {
    for (const SamplerName& sampler : kSamplers) {
        if (text != sampler.name) continue;
        method.sampler = sampler.kind;
        return {};
    }
    if (parse_stepped_mesh(text, method)) return {};
    return fail(ErrorCode::option, "unknown sampler " + in_quotes(text) +
                                       ": use tiles, mesh, mesh-N (steps of 1 to 64 pixels), uniform, layers or "
                                       "log-polar");
}

/// Whether the reconstruction reads what the sampler's plans have.
Expected<void> check_pair(const Method& method) {
    const bool tiles = method.sampler == SamplerKind::tiles;
    const bool mesh = method.sampler == SamplerKind::mesh;
    switch (method.reconstruction) {
        case Reconstruction::tiles:
            if (tiles) return {};
            return fail(ErrorCode::option,
                        "the reconstruction tiles reads the levels of screen tiles, which only the sampler tiles has");
        case Reconstruction::table:
        case Reconstruction::raster:
            if (mesh) return {};
            return fail(ErrorCode::option,
                        "the reconstructions table and raster need triangles that were made before the frame, which "
                        "only the sampler mesh has");
        case Reconstruction::push_pull:
        case Reconstruction::cells:
        case Reconstruction::nearest:
            if (tiles || mesh) return {};
            return fail(ErrorCode::option,
                        "the reconstructions push-pull, cells and nearest take samples at pixel centres, and those of "
                        "uniform, layers and log-polar lie between");
        case Reconstruction::bilinear:
            if (!tiles && !mesh) return {};
            return fail(ErrorCode::option,
                        "the reconstruction bilinear needs samples in rows and columns, which tiles and mesh have not");
    }
    return {};
}

Expected<void> check_preset(const Method& method) {
    if (method.sampler == SamplerKind::log_polar && method.preset.full)
        return fail(ErrorCode::option,
                    "log-polar samples lie on circles around the gaze and cannot be all pixels: use a percentage");
    return {};
}

std::string name_of(const Method& method) {
    std::string name(named(method.sampler).name);
    if (method.mesh_step_px != 1) name.append("-").append(std::to_string(method.mesh_step_px));
    name.append(":").append(method.mesh_file ? "file" : method.preset.name);
    return name.append("/").append(to_string(method.reconstruction));
}

Expected<Method> parse_parts(std::string_view text) {
    Method method;
    const std::size_t slash = std::min(text.rfind('/'), text.size());
    // A preset "law:..." has a colon of its own.
    const std::size_t colon = text.starts_with("law:") ? std::string_view::npos : text.find(':');
    if (colon < slash) {
        if (auto sampler = parse_sampler(text.substr(0, colon), method); !sampler)
            return tl::unexpected(sampler.error());
    }
    method.reconstruction = named(method.sampler).own;
    if (slash < text.size()) {
        const auto reconstruction = parse_reconstruction(std::string(text.substr(slash + 1)));
        if (!reconstruction) return tl::unexpected(reconstruction.error());
        method.reconstruction = *reconstruction;
    }
    const std::size_t begin = colon < slash ? colon + 1 : 0;
    const std::string preset_text(text.substr(begin, slash - begin));
    method.mesh_file = method.sampler == SamplerKind::mesh && preset_text == "file";
    if (!method.mesh_file) {
        auto preset = parse_sampling(preset_text);
        if (!preset) return tl::unexpected(preset.error());
        method.preset = *std::move(preset);
    }
    if (auto good = check_pair(method); !good) return tl::unexpected(good.error());
    if (auto good = check_preset(method); !good) return tl::unexpected(good.error());
    method.name = name_of(method);
    return method;
}

}  // namespace

Expected<Method> parse_method(const std::string& text) {
    auto method = parse_parts(text);
    if (method) return method;
    std::string message = "sampling " + in_quotes(text) + ": ";
    return fail(method.error().code, message.append(method.error().message));
}

}  // namespace macula
