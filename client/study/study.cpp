#include "client/study/study.h"

#include <utility>

namespace macula {

Study::Study(StudySettings settings, StudyLog log)
    : settings_(std::move(settings)), log_(std::move(log)), schedule_(make_schedule(settings_)) {}

double Study::seconds(std::int64_t time_ns) const {
    return 1e-9 * static_cast<double>(time_ns - *begin_ns_);
}

std::vector<Choose> Study::due(std::int64_t now_ns) {
    std::vector<Choose> choices;
    const auto ask = [&](const std::string& method, bool only_prepare) {
        choices.push_back({next_id_++, method, only_prepare});
        asked_.push_back(method);
    };
    if (asked_.empty())
        for (const std::string& mask : settings_.masks) ask(mask, true);
    // One at a time, also after a pause: what should have been shown in it was not.
    std::optional<std::size_t> newest;
    while (begun() && next_change_ < schedule_.size() && seconds(now_ns) >= schedule_[next_change_].at_s)
        newest = schedule_[next_change_++].mask;
    if (newest) ask(settings_.masks[*newest], false);
    return choices;
}

Expected<void> Study::answered(const Chosen& answer) {
    if (answer.id == 0 || answer.id > asked_.size()) return {};
    if (!answer.problem.empty())
        return fail(ErrorCode::refused, "the server cannot show " + asked_[answer.id - 1] + ": " + answer.problem);
    if (answer.id <= settings_.masks.size()) ++prepared_;
    return {};
}

Expected<void> Study::shown(const Frame& frame, std::uint64_t connection, const Welcome& welcome,
                            std::int64_t displayed_ns) {
    if (connection_ == 0) connection_ = connection;
    if (connection != connection_)
        return fail(ErrorCode::network, "the connection was lost in the middle of the study: begin it again");
    if (!begun()) {
        if (prepared_ < settings_.masks.size()) return {};
        begin_ns_ = displayed_ns;
        log_.set_scene(welcome.scene_name);
        log_.row(0.0, "shown", "", settings_.reference);
        shown_ = settings_.reference;
    }
    if (frame.choice == shown_choice_ || frame.choice == 0 || frame.choice > asked_.size()) return {};
    const std::string& method = asked_[frame.choice - 1];
    log_.row(seconds(displayed_ns), "shown", shown_, method);
    shown_choice_ = frame.choice;
    shown_ = method;
    return {};
}

void Study::key(std::int64_t pressed_ns) {
    if (begun() && pressed_ns >= *begin_ns_) log_.row(seconds(pressed_ns), "key", shown_, "");
}

bool Study::over(std::int64_t now_ns) const {
    return begun() && seconds(now_ns) >= settings_.length_s;
}

Expected<void> Study::close(std::int64_t now_ns) {
    if (begun()) log_.row(seconds(now_ns), "end", shown_, "");
    return log_.close();
}

}  // namespace macula
