#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "client/device/recorder.h"
#include "client/device/source.h"
#include "client/device/velocity.h"

namespace macula {

/// Reads a source as it delivers, on a thread of its own: every sample is recorded, those within 4 ms of one that
/// was delivered already are kept back (250 a second are enough), and the newest head pose is there for late
/// reprojection.
class DeviceThread {
public:
    /// Called on the thread, for each sample that is delivered.
    using Deliver = std::function<void(const DeviceSample& sample, const HeadVelocity& velocity)>;

    /// The source's time begins now. `recorder` may be null.
    DeviceThread(std::unique_ptr<TrackSource> source, std::unique_ptr<Recorder> recorder, Deliver deliver);
    DeviceThread(const DeviceThread&) = delete;
    DeviceThread& operator=(const DeviceThread&) = delete;
    ~DeviceThread();

    [[nodiscard]] Pose newest_start_from_head() const;

    /// Whether the source came to its end.
    [[nodiscard]] bool ended() const { return ended_; }

    /// Ends the thread and the recording. Errors: `output`, from the recorder.
    Expected<void> stop();

private:
    void run();
    void read_due(std::int64_t now);

    std::unique_ptr<TrackSource> source_;
    std::unique_ptr<Recorder> recorder_;
    Deliver deliver_;
    VelocityEstimator velocity_;
    std::int64_t delivered_ns_ = 0;
    mutable std::mutex mutex_;
    Pose newest_start_from_head_;
    std::atomic<bool> stopping_{false};
    std::atomic<bool> ended_{false};
    std::thread thread_;
};

}  // namespace macula
