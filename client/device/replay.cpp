#include "client/device/replay.h"

#include <utility>

namespace macula {
namespace {

constexpr std::int64_t kLoneSamplePeriod_ns = 10'000'000;

class Replay final : public TrackSource {
public:
    Replay(Recording recording, bool loop) : recording_(std::move(recording)), loop_(loop) {
        const auto& samples = recording_.samples;
        const std::int64_t length_ns = samples.back().time_ns;
        const auto intervals = static_cast<std::int64_t>(samples.size()) - 1;
        period_ns_ = intervals > 0 ? length_ns + length_ns / intervals : kLoneSamplePeriod_ns;
    }

    void begin(std::int64_t now_ns) override { begin_ns_ = now_ns; }

    [[nodiscard]] std::optional<std::int64_t> due_ns() const override {
        if (index_ == recording_.samples.size()) return std::nullopt;
        return begin_ns_ + recording_.samples[index_].time_ns;
    }

    std::optional<DeviceSample> next(std::int64_t now_ns) override {
        const auto due = due_ns();
        if (!due || *due > now_ns) return std::nullopt;
        DeviceSample sample = recording_.samples[index_];
        sample.time_ns = *due;
        sample.discontinuity = index_ == 0;
        if (++index_ == recording_.samples.size() && loop_) {
            index_ = 0;
            begin_ns_ += period_ns_;
        }
        return sample;
    }

    [[nodiscard]] std::string name() const override {
        return recording_.layout + " recording of " + std::to_string(recording_.samples.size()) + " samples, " +
               std::to_string(recording_.samples.back().time_ns / 1'000'000) + " ms";
    }

private:
    Recording recording_;
    bool loop_;
    std::int64_t period_ns_ = 0;
    std::int64_t begin_ns_ = 0;
    std::size_t index_ = 0;
};

}  // namespace

std::unique_ptr<TrackSource> make_replay(Recording recording, bool loop) {
    return std::make_unique<Replay>(std::move(recording), loop);
}

}  // namespace macula
