#pragma once

#include <chrono>
#include <string>

namespace macula {

/// Tells a person on standard error how far a slow stage is: nothing in its first second, then once a second.
class Progress {
public:
    explicit Progress(bool quiet) : quiet_(quiet) {}

    /// A stage begins.
    void begin(const std::string& stage);
    /// `share` of the stage is done, 0..1; `detail` may be empty.
    void tell(double share, const std::string& detail = {});
    /// Something that a person should know whatever the share.
    void note(const std::string& text) const;

private:
    using Clock = std::chrono::steady_clock;

    bool quiet_;
    std::string stage_;
    Clock::time_point begun_;
    Clock::time_point told_;
};

}  // namespace macula
