#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "tests/chart/measure.h"

namespace macula::test {

namespace {

struct StageColumn {
    const char* name;
    double (*of)(const StageMilliseconds&);
};
constexpr std::array<StageColumn, 9> kStages = {{
    {"plan", [](const StageMilliseconds& t) { return t.plan; }},
    {"trace", [](const StageMilliseconds& t) { return t.trace; }},
    {"reconstruct", [](const StageMilliseconds& t) { return t.reconstruct; }},
    {"encode", [](const StageMilliseconds& t) { return t.encode; }},
    {"decode", [](const StageMilliseconds& t) { return t.decode; }},
    {"accumulate", [](const StageMilliseconds& t) { return t.accumulate; }},
    {"show", [](const StageMilliseconds& t) { return t.show; }},
    {"server", [](const StageMilliseconds& t) { return t.server(); }},
    {"all", [](const StageMilliseconds& t) { return t.all(); }},
}};

double quantile(const std::vector<StageMilliseconds>& times, const StageColumn& stage, double p) {
    std::vector<double> values;
    for (const StageMilliseconds& time : times) values.push_back(stage.of(time));
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(std::lround(p * static_cast<double>(values.size() - 1)))];
}

/// Empty where there is no number; infinite where nothing differs.
std::string cell(double value, int digits) {
    return std::isnan(value) ? std::string() : fmt::format("{:.{}f}", value, digits);
}

/// Names and values of all columns.
std::vector<std::pair<std::string, std::string>> columns(const Measurement& m) {
    std::string without;
    for (const std::string& part : m.row.without) without.append(without.empty() ? "" : "+").append(part);
    std::vector<std::pair<std::string, std::string>> result = {
        {"name", m.row.name()},
        {"scene", m.row.scene},
        {"scenario", m.row.scenario},
        {"method", m.row.method},
        {"taa", m.row.taa},
        {"codec", m.row.codec},
        {"display", m.row.display},
        {"frames", std::to_string(m.row.frames)},
        {"warm", std::to_string(m.row.warm)},
        {"seed", std::to_string(m.row.seed)},
        {"latency", std::to_string(m.row.latency)},
        {"mbits", std::to_string(m.row.mbits)},
        {"without", without},
        {"width_px", std::to_string(m.display.eye_width_px)},
        {"height_px", std::to_string(m.display.eye_height_px)},
        {"traced_share", cell(m.traced_share, 4)},
        {"kilobytes", cell(m.kilobytes, 2)},
        {"psnr_db", cell(m.quality.psnr_db, 3)},
        {"foveal_psnr_db", cell(m.quality.foveal_psnr_db, 3)},
        {"ssim", cell(m.quality.ssim, 5)},
        {"flicker", cell(m.quality.flicker, 6)},
    };
    for (std::size_t ring = 0; ring < kRingEnd_deg.size(); ++ring)
        result.emplace_back(fmt::format("flicker_{:.0f}", kRingEnd_deg[ring]), cell(m.quality.ring_flicker[ring], 6));
    result.emplace_back("worst_flicker", cell(m.quality.worst_flicker, 6));
    for (const StageColumn& stage : kStages) {
        for (const int percent : {50, 99}) {
            const double ms = m.times.empty() ? std::nan("") : quantile(m.times, stage, 0.01 * percent);
            result.emplace_back(fmt::format("{}_p{}_ms", stage.name, percent), cell(ms, 3));
        }
    }
    return result;
}

}  // namespace

std::string csv_header() {
    std::string line;
    for (const auto& [name, value] : columns({})) line.append(line.empty() ? "" : ",").append(name);
    return line;
}

std::string csv_line(const Measurement& measurement) {
    std::string line;
    for (const auto& [name, value] : columns(measurement)) {
        line.append(name == "name" ? "" : ",");
        // RFC 4180; laws that are given by their constants have commas between them.
        const char* quote = value.find(',') == std::string::npos ? "" : "\"";
        line.append(quote).append(value).append(quote);
    }
    return line;
}

}  // namespace macula::test
