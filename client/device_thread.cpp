#include "client/device_thread.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "protocol/base/clock.h"

namespace macula {
namespace {

constexpr std::int64_t kLeastInterval_ns = 3'900'000;  // 250 Hz, with room for jitter
constexpr std::int64_t kLongestSleep_ns = 20'000'000;  // bounds the time that stop() takes

}  // namespace

DeviceThread::DeviceThread(std::unique_ptr<TrackSource> source, std::unique_ptr<Recorder> recorder, Deliver deliver)
    : source_(std::move(source)), recorder_(std::move(recorder)), deliver_(std::move(deliver)) {
    source_->begin(now_ns());
    thread_ = std::thread([this] { run(); });
}

DeviceThread::~DeviceThread() {
    static_cast<void>(stop());
}

Pose DeviceThread::newest_start_from_head() const {
    const std::lock_guard lock(mutex_);
    return newest_start_from_head_;
}

Expected<void> DeviceThread::stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
    if (auto recorder = std::exchange(recorder_, nullptr)) return recorder->close();
    return {};
}

void DeviceThread::run() {
    while (!stopping_) {
        const std::optional<std::int64_t> due_ns = source_->due_ns();
        if (!due_ns) {
            ended_ = true;
            return;
        }
        const std::int64_t wait_ns = std::min(*due_ns - now_ns(), kLongestSleep_ns);
        if (wait_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(wait_ns));
        read_due(now_ns());
    }
}

void DeviceThread::read_due(std::int64_t now) {
    std::optional<DeviceSample> newest;
    HeadVelocity velocity;
    while (const std::optional<DeviceSample> sample = source_->next(now)) {
        velocity = velocity_.update(*sample);
        if (recorder_) recorder_->write(*sample);
        newest = sample;
    }
    if (!newest) return;
    {
        const std::lock_guard lock(mutex_);
        newest_start_from_head_ = newest->start_from_head;
    }
    if (newest->time_ns - delivered_ns_ < kLeastInterval_ns) return;
    delivered_ns_ = newest->time_ns;
    deliver_(*newest, velocity);
}

}  // namespace macula
