#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "client/device/recording.h"

/// Any bytes: the parser answers with samples that keep their promises, or with an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto recording = macula::parse_recording(text, "fuzz");
    if (!recording) {
        if (recording.error().code != macula::ErrorCode::input_file) std::abort();
        return 0;
    }
    std::int64_t before_ns = -1;
    if (recording->samples.empty() || recording->samples.front().time_ns != 0) std::abort();
    for (const macula::DeviceSample& sample : recording->samples) {
        if (sample.time_ns <= before_ns) std::abort();
        before_ns = sample.time_ns;
        if (!(std::abs(glm::length(sample.start_from_head.orientation) - 1.0F) < 1e-3F)) std::abort();
        for (const macula::GazeSample& gaze : sample.gaze) {
            if (!(std::abs(glm::length(gaze.direction) - 1.0F) < 1e-3F)) std::abort();
            if (!(gaze.confidence >= 0.0F && gaze.confidence <= 1.0F)) std::abort();
        }
    }
    return 0;
}
