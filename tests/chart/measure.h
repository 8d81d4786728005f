#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/error.h"
#include "tests/metrics/clip_meter.h"
#include "tests/pipeline/pipeline.h"
#include "tests/pipeline/row.h"

namespace macula::test {

/// What one row was found to be.
struct Measurement {
    Row row;
    Display display;
    ClipFigures quality;
    double traced_share = 0.0;             ///< mean over the judged frames, of both eyes' pixels
    double kilobytes = 0.0;                ///< of both streams, mean of a judged frame
    std::vector<StageMilliseconds> times;  ///< of the judged frames
};

/// Runs rows, one after another; keeps scenes and references from row to row, since both take long to make. One thread
/// at a time.
class Measurer {
public:
    /// With a folder, the last row's clip lies there as files (README.md) once measure() has returned.
    explicit Measurer(std::string clips) : clips_(std::move(clips)) {}

    /// Errors: `option` for a row that cannot be, `input_file` for scenes and recordings, `output` for clips.
    Expected<Measurement> measure(const Row& row);

private:
    /// References of the judged frames; a single one where neither head nor scene moves.
    struct References {
        std::string key;
        std::vector<ColorImage> pictures;
    };

    Expected<const Stage*> stage(const Row& row);
    void make_references(const Row& row, const Display& display, const Scenario& scenario);
    [[nodiscard]] Expected<void> write_clips(const std::vector<ColorImage>& shown, const Display& display,
                                             const std::vector<glm::vec3>& gaze_eye) const;

    std::string clips_;
    std::string scene_name_;
    std::optional<Stage> stage_;  ///< with nothing switched off: what references are made with
    std::set<std::string> ablated_;
    std::optional<Stage> ablated_stage_;
    References references_;
};

/// First line of the table, and a row of it; columns as README.md lists them.
std::string csv_header();
std::string csv_line(const Measurement& measurement);

}  // namespace macula::test
