#pragma once

#include <string>
#include <vector>

#include "server/offline/shot.h"
#include "server/offline/writer.h"
#include "server/render/tracer.h"

namespace macula {

/// Times of the stages that are repeated, one entry for each repetition, in milliseconds.
struct RepeatedTimes {
    std::vector<double> plan_ms;
    std::vector<double> trace_ms;
    std::vector<double> reconstruct_ms;
};

/// What one run did, for --json.
struct RunReport {
    std::string scene;
    std::size_t triangles = 0;
    std::string needs;
    std::string renderer;
    std::string reconstruction;
    std::size_t tracer_bytes = 0;
    TraceCounts rays;  ///< of one repetition
    double load_ms = 0.0;
    double build_ms = 0.0;
    RepeatedTimes times;
    double write_ms = 0.0;
    std::vector<WrittenFile> files;
};

/// The `quantile` in 0..1 of values in any order, by nearest rank; 0 without any.
double quantile_of(std::vector<double> values, double quantile);

/// The report as JSON (server/offline/README.md documents it).
std::string to_json(const RunReport& report, const RenderOptions& options, const std::vector<Shot>& shots);

/// Writes a text to a file, or with "-" to standard output. Errors: `output`.
Expected<void> write_text(const std::string& path, const std::string& text);

}  // namespace macula
