#include "server/offline/report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

namespace macula {
namespace {

using Json = nlohmann::ordered_json;

Json distribution(const std::vector<double>& values_ms) {
    return {{"p50", quantile_of(values_ms, 0.5)}, {"p99", quantile_of(values_ms, 0.99)}};
}

Json pictures(const std::vector<Shot>& shots) {
    Json result = Json::array();
    for (const Shot& shot : shots) {
        result.push_back({{"eye", shot.name.empty() ? "camera" : shot.name},
                          {"width_px", shot.view.width_px},
                          {"height_px", shot.view.height_px},
                          {"samples", shot.plan.trace_order.size()},
                          {"samples_in_window", shot.plan.traced_in_window},
                          {"share", shot.plan.traced_share()}});
    }
    return result;
}

Json files(const std::vector<WrittenFile>& written) {
    Json result = Json::array();
    for (const WrittenFile& file : written) {
        Json entry = {{"layer", file.layer}, {"path", file.path}};
        if (file.depth_m_per_unit > 0.0) entry["depth_m_per_unit"] = file.depth_m_per_unit;
        result.push_back(entry);
    }
    return result;
}

}  // namespace

double quantile_of(std::vector<double> values, double quantile) {
    if (values.empty()) return 0.0;
    const auto count = static_cast<double>(values.size());
    const auto rank = static_cast<std::size_t>(std::clamp(std::ceil(quantile * count), 1.0, count));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank - 1), values.end());
    return values[rank - 1];
}

std::string to_json(const RunReport& report, const RenderOptions& options, const std::vector<Shot>& shots) {
    Json json;
    json["scene"] = {{"name", report.scene}, {"triangles", report.triangles}, {"needs", report.needs}};
    json["renderer"] = report.renderer;
    json["reconstruction"] = report.reconstruction;
    json["sampling"] = options.sampling;
    json["spp"] = options.spp;
    json["repeat"] = options.repeat;
    json["pictures"] = pictures(shots);
    json["rays"] = {{"primary", report.rays.primary},
                    {"shadow", report.rays.shadow},
                    {"reflection", report.rays.reflection},
                    {"transmission", report.rays.transmission},
                    {"skipped_shadow", report.rays.skipped_shadow},
                    {"skipped_bounce", report.rays.skipped_bounce}};
    json["tracer_bytes"] = report.tracer_bytes;
    json["times_ms"] = {{"load", report.load_ms},
                        {"build", report.build_ms},
                        {"plan", distribution(report.times.plan_ms)},
                        {"trace", distribution(report.times.trace_ms)},
                        {"reconstruct", distribution(report.times.reconstruct_ms)},
                        {"write", report.write_ms}};
    json["files"] = files(report.files);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Expected<void> write_text(const std::string& path, const std::string& text) {
    if (path == "-") {
        std::cout << text << std::flush;
        if (!std::cout) return fail(ErrorCode::output, "standard output cannot be written");
        return {};
    }
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (!file) return fail(ErrorCode::output, path + ": it cannot be written");
    return {};
}

}  // namespace macula
