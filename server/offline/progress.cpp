#include "server/offline/progress.h"

#include <cmath>
#include <cstdio>

namespace macula {

void Progress::begin(const std::string& stage) {
    stage_ = stage;
    begun_ = told_ = Clock::now();
}

void Progress::tell(double share, const std::string& detail) {
    const Clock::time_point now = Clock::now();
    if (quiet_ || now - told_ < std::chrono::seconds(1)) return;
    told_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - begun_).count();
    std::string text = "macula-render: " + stage_ + ": " + std::to_string(static_cast<int>(100.0 * share)) + " %";
    if (share > 0.0) text += ", " + std::to_string(std::lround(elapsed_s * (1.0 - share) / share)) + " s left";
    if (!detail.empty()) text += ", " + detail;
    std::fprintf(stderr, "%s\n", text.c_str());
}

void Progress::note(const std::string& text) const {
    if (!quiet_) std::fprintf(stderr, "macula-render: %s\n", text.c_str());
}

}  // namespace macula
