#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "protocol/base/error.h"

namespace macula {

/// The table of one session of the study: columns time_s, event, from, to, scene (tests/study/README.md). Rows are on
/// the disk as soon as they are written, so that a session that breaks off leaves what it had.
class StudyLog {
public:
    /// Errors: `output`.
    static Expected<StudyLog> open(const std::string& path);

    /// What the rows from now on belong to; a comma in the name becomes a space.
    void set_scene(std::string scene);
    /// `time_s` since the reference was first shown; the names hold no comma.
    void row(double time_s, const std::string& event, const std::string& from, const std::string& to);
    /// Errors: `output` if any row did not reach the file.
    Expected<void> close();

private:
    explicit StudyLog(std::string path) : path_(std::move(path)) {}

    std::string path_;
    std::string scene_;
    std::ofstream file_;
};

}  // namespace macula
