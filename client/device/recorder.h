#pragma once

#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "client/device/source.h"

namespace macula {

/// Writes samples in Macula's layout (RECORDING.md). One thread at a time.
class Recorder {
public:
    /// Errors: `output` when the file cannot be created.
    static Expected<std::unique_ptr<Recorder>> open(const std::string& path);

    /// Appends a row; times are written relative to the first.
    void write(const DeviceSample& sample);

    /// Errors: `output` if any row did not reach the file.
    Expected<void> close();

private:
    Recorder(std::string path, std::ofstream file) : path_(std::move(path)), file_(std::move(file)) {}

    std::string path_;
    std::ofstream file_;
    std::optional<std::int64_t> first_ns_;
};

/// Writes what a source delivers in its first `length_ns`, or until it ends, without waiting: the source's own clock
/// is run through. Returns the samples written.
std::uint64_t record(TrackSource& source, Recorder& recorder, std::int64_t length_ns);

/// One row without its end of line: enough digits that every float is read back as it was.
std::string recording_row(const DeviceSample& sample);

/// The header of Macula's layout.
std::string recording_header();

}  // namespace macula
