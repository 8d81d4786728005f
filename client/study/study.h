#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/study/schedule.h"
#include "client/study/study_log.h"
#include "protocol/base/error.h"
#include "protocol/message/message.h"

namespace macula {

/// One session of the study: has all masks prepared, then shows the reference, and changes masks by the schedule. Time
/// is an argument, so the course can be tested; messages go out and come in through the caller. One thread at a time.
class Study {
public:
    /// The settings are good (check_study).
    Study(StudySettings settings, StudyLog log);

    /// What to ask the server now.
    std::vector<Choose> due(std::int64_t now_ns);

    /// An answer of the server. Errors: `refused`, if it cannot make a mask.
    Expected<void> answered(const Chosen& answer);

    /// A frame was shown, on the connection of this number. Its first after all masks are ready begins the study.
    /// Errors: `network`, if the connection is another one than before: what was shown in between is not known.
    Expected<void> shown(const Frame& frame, std::uint64_t connection, const Welcome& welcome,
                         std::int64_t displayed_ns);

    /// The observer pressed a key; before the beginning it counts for nothing.
    void key(std::int64_t pressed_ns);

    [[nodiscard]] bool begun() const { return begin_ns_.has_value(); }
    [[nodiscard]] bool over(std::int64_t now_ns) const;

    /// Writes the end, wherever it is. Errors: `output`.
    Expected<void> close(std::int64_t now_ns);

private:
    [[nodiscard]] double seconds(std::int64_t time_ns) const;

    StudySettings settings_;
    StudyLog log_;
    std::vector<MaskChange> schedule_;
    std::size_t next_change_ = 0;
    std::uint32_t next_id_ = 1;
    std::vector<std::string> asked_;  ///< by id - 1: method; the first ones are the preparations
    std::size_t prepared_ = 0;
    std::optional<std::int64_t> begin_ns_;
    std::uint64_t connection_ = 0;
    std::uint32_t shown_choice_ = 0;
    std::string shown_;  ///< method on the screen
};

}  // namespace macula
