#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "client/device/csv.h"
#include "client/device/source.h"

namespace macula {

/// Head and eye movement that was recorded. RECORDING.md documents the layouts that are read.
struct Recording {
    std::vector<DeviceSample> samples;  ///< never empty; times rise strictly from 0
    std::string layout;                 ///< which layout the file had, for logs
    std::size_t skipped_rows = 0;       ///< rows that were broken
    std::string first_problem;          ///< line and reason of the first of them
};

/// Fills a sample from one row; the result is what is wrong with the row, if anything is.
using RowReader =
    std::function<std::optional<std::string>(std::span<const std::string_view> fields, DeviceSample& sample)>;

/// Reader of one layout, chosen by the file's header line.
struct RowLayout {
    std::string name;
    RowReader read;
    bool tracker_space = false;  ///< poses are the tracker's own, held between its updates
};

/// Reader of Macula's own layout; nothing if the header lacks one of its columns.
std::optional<RowLayout> macula_layout(const Columns& columns);

/// Reads the text of a recording. Broken rows are skipped and counted. `name` is the file's, for messages.
/// Errors: `input_file`, naming file and line, for an unknown header and when no row is usable.
Expected<Recording> parse_recording(std::string_view text, const std::string& name);

/// Reads a file of at most 1 GiB. Errors: `input_file`.
Expected<Recording> load_recording(const std::string& path);

}  // namespace macula
