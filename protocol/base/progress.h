#pragma once

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

namespace macula {

/// Tells a person on standard error how far a slow stage is: nothing in its first second, then once a second.
/// One thread.
class Progress {
public:
    /// `program` begins every line.
    Progress(std::string program, bool quiet) : program_(std::move(program)), quiet_(quiet) {}

    /// A stage begins.
    void begin(const std::string& stage) {
        stage_ = stage;
        begun_ = told_ = Clock::now();
    }

    /// `share` of the stage is done, 0..1; `detail` may be empty.
    void tell(double share, const std::string& detail = {}) {
        const Clock::time_point now = Clock::now();
        if (quiet_ || now - told_ < std::chrono::seconds(1)) return;
        told_ = now;
        const double elapsed_s = std::chrono::duration<double>(now - begun_).count();
        std::string text = stage_ + ": " + std::to_string(static_cast<int>(100.0 * share)) + " %";
        if (share > 0.0) text += ", " + std::to_string(std::lround(elapsed_s * (1.0 - share) / share)) + " s left";
        if (!detail.empty()) text += ", " + detail;
        note(text);
    }

    /// Something that a person should know whatever the share.
    void note(const std::string& text) const {
        if (!quiet_) std::fprintf(stderr, "%s: %s\n", program_.c_str(), text.c_str());
    }

private:
    using Clock = std::chrono::steady_clock;

    std::string program_;
    bool quiet_;
    std::string stage_;
    Clock::time_point begun_;
    Clock::time_point told_;
};

}  // namespace macula
