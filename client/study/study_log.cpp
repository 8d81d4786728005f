#include "client/study/study_log.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace macula {

Expected<StudyLog> StudyLog::open(const std::string& path) {
    StudyLog log(path);
    log.file_.open(path, std::ios::binary | std::ios::trunc);
    if (!log.file_) return fail(ErrorCode::output, path + ": cannot be written: " + std::strerror(errno));
    log.file_ << "time_s,event,from,to,scene\n" << std::flush;
    return log;
}

void StudyLog::set_scene(std::string scene) {
    std::ranges::replace(scene, ',', ' ');
    scene_ = std::move(scene);
}

void StudyLog::row(double time_s, const std::string& event, const std::string& from, const std::string& to) {
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%.4f", time_s);
    file_ << time.data() << ',' << event << ',' << from << ',' << to << ',' << scene_ << '\n' << std::flush;
}

Expected<void> StudyLog::close() {
    file_.close();
    if (!file_) return fail(ErrorCode::output, path_ + ": writing the table failed; is the disk full?");
    return {};
}

}  // namespace macula
