// A server and a client that talk over real TLS sockets, through a Link that is late, loses, repeats and swaps, or with
// one of the two pausing. What must hold: frames go on, none is older than the one before, and no more than three are
// under way. Times are those of a busy machine: bounds leave room for it.

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "client/stream/client_session.h"
#include "tests/stability/case.h"
#include "tests/stability/machinery_link.h"
#include "tests/support/small_service.h"

namespace macula::test {
namespace {

using namespace std::chrono_literals;
using macula::testing::RunningServer;
using std::chrono::milliseconds;

constexpr double kMostInFlight = 3.0;

/// Sessions then trace on their own threads: oneTBB's synchronisation is invisible to ThreadSanitizer.
class OneThreadEach : public ::testing::Environment {
    oneapi::tbb::global_control limit_{oneapi::tbb::global_control::max_allowed_parallelism, 1};
};
const auto* const kOneThreadEach = ::testing::AddGlobalTestEnvironment(new OneThreadEach);

double ms(std::int64_t time_ns) {
    return 1e-6 * static_cast<double>(time_ns);
}

/// A client that tracks a still head and shows what comes.
class Visit {
public:
    Visit(const RunningServer& server, const LinkFaults& faults, int width_px = 128, int height_px = 128)
        : width_px_(width_px),
          height_px_(height_px),
          session_(
              [&server, faults, record = record_](milliseconds timeout) -> Expected<std::unique_ptr<Channel>> {
                  auto channel = connect("127.0.0.1", server.port(), server.credentials().fingerprint, timeout);
                  if (!channel) return channel;
                  return std::make_unique<Link>(*std::move(channel), faults, record);
              },
              options(server, width_px, height_px), [](const std::string&) {}) {}

    /// Shows frames for a while; the first comes before it begins.
    void watch(milliseconds time) {
        wait_for_frame();
        const std::int64_t end_ns = now_ns() + time.count() * 1'000'000;
        while (now_ns() < end_ns) show_next();
    }

    /// Until a frame is shown.
    void wait_for_frame() {
        const std::int64_t end_ns = now_ns() + macula::testing::kPatience.count() * 1'000'000;
        while (!show_next() && now_ns() < end_ns) {
        }
    }

    [[nodiscard]] ClientSessionCounters counters() const { return session_.counters(); }
    [[nodiscard]] LinkRecord& record() { return *record_; }

    int shown = 0;
    int steps_back = 0;
    int wrong_size = 0;
    std::int64_t longest_gap_ns = 0;
    std::int64_t last_shown_ns = 0;
    std::vector<std::int64_t> age_ns;  ///< of each frame shown: since its head pose was measured

private:
    static ClientSessionOptions options(const RunningServer& server, int width_px, int height_px) {
        ClientSessionOptions options;
        options.hello = macula::testing::small_hello(server.credentials().token);
        options.hello.refresh_hz = 90.0F;
        options.hello.eye_width_px = width_px;
        options.hello.eye_height_px = height_px;
        return options;
    }

    bool show_next() {
        Track track;
        track.pose_time_ns = track.gaze_time_ns = now_ns();
        track.display_time_ns = track.pose_time_ns + 20'000'000;
        session_.send(track);
        const auto received = session_.next_frame(4ms);
        if (!received) return false;
        const Frame& frame = received->frame;
        const std::int64_t now = now_ns();
        if (shown > 0) longest_gap_ns = std::max(longest_gap_ns, now - last_shown_ns);
        if (frame.pose_time_ns < newest_pose_ns_) ++steps_back;
        if (received->color.width_px != 2 * width_px_ || received->color.height_px != height_px_ ||
            received->depth.width_px != width_px_ / 2 || received->depth.height_px != height_px_ / 4) {
            ++wrong_size;
        }
        newest_pose_ns_ = std::max(newest_pose_ns_, frame.pose_time_ns);
        last_shown_ns = now;
        age_ns.push_back(now - frame.pose_time_ns);
        ++shown;
        session_.send(FrameReport{frame.id, received->received_ns, received->decoded_ns, now, false});
        return true;
    }

    int width_px_;
    int height_px_;
    std::shared_ptr<LinkRecord> record_ = std::make_shared<LinkRecord>();
    std::int64_t newest_pose_ns_ = 0;
    ClientSession session_;
};

/// What must hold whatever happens on the way.
void check_sanity(const std::string& name, Visit& visit, bool reports_arrive = true) {
    check({name, "frames older than the one before", static_cast<double>(visit.steps_back), Side::at_most, 0.0,
           "what is shown never goes back in time"});
    check({name, "connections", static_cast<double>(visit.counters().connections), Side::at_most, 1.0,
           "nothing of this is a reason to begin anew"});
    const std::lock_guard lock(visit.record().mutex);
    if (reports_arrive) {
        check({name, "frames in flight, most", static_cast<double>(visit.record().most_in_flight), Side::at_most,
               kMostInFlight, "SessionOptions::max_in_flight"});
    }
}

TEST(Late, FramesComeAsOftenAsThreeInFlightAllow) {
    const RunningServer server;
    struct Delay {
        const char* name;
        int least_ms;
        int jitter_ms;
        milliseconds watched;
    };
    for (const Delay& delay : {Delay{"50ms", 50, 0, 500ms}, Delay{"200ms", 200, 0, 800ms},
                               Delay{"1000ms", 1000, 0, 3100ms}, Delay{"jitter-0-to-200ms", 0, 200, 900ms}}) {
        if (delay.least_ms >= 1000 && !whole_suite()) continue;
        LinkFaults faults;
        faults.frame = [delay](int frame) {
            const int jitter_ms = delay.jitter_ms == 0 ? 0 : frame * 7919 % (delay.jitter_ms + 1);
            return Fate{.late = milliseconds(delay.least_ms + jitter_ms)};
        };
        Visit visit(server, faults);
        visit.watch(delay.watched);
        const std::string name = std::string("machinery/link-late-") + delay.name;
        check_sanity(name, visit);
        // With a jitter, what is late holds up what follows: the largest of each three counts.
        const double way_ms = delay.least_ms + delay.jitter_ms;
        const double possible = kMostInFlight * static_cast<double>(delay.watched.count()) / way_ms;
        check({name, "frames shown, of those possible", visit.shown / possible, Side::at_least, 0.2,
               "three for each way; the rest is the machine's, which builds and tests beside this"});
        check({name, "frames that could not be decoded", static_cast<double>(visit.counters().frames_undecodable),
               Side::at_most, 0.0, "late is not lost"});
    }
}

TEST(Repeated, FramesAreShownOnce) {
    const RunningServer server;
    LinkFaults faults;
    faults.frame = [](int) { return Fate{.copies = 3}; };
    Visit visit(server, faults);
    visit.watch(500ms);
    const std::string name = "machinery/link-repeated";
    check_sanity(name, visit);
    const ClientSessionCounters counters = visit.counters();
    check({name, "frames that could not be decoded", static_cast<double>(counters.frames_undecodable), Side::at_most,
           0.0, "a repeated frame is not decoded"});
    check({name, "copies that were ignored, of all",
           static_cast<double>(counters.frames_repeated) / static_cast<double>(counters.frames_received),
           Side::at_least, 1.5, "two of three; the last may be under way"});
    const std::lock_guard lock(visit.record().mutex);
    check({name, "keyframes", static_cast<double>(visit.record().keyframes), Side::at_most, 1.0, "nothing is missing"});
}

TEST(Swapped, FramesCostOneKeyframeEach) {
    const RunningServer server;
    LinkFaults faults;
    faults.frame = [](int frame) { return Fate{.after_next = frame % 12 == 7}; };
    Visit visit(server, faults);
    visit.watch(700ms);
    const std::string name = "machinery/link-swapped";
    check_sanity(name, visit);
    const std::lock_guard lock(visit.record().mutex);
    check({name, "keyframes for each exchange",
           static_cast<double>(visit.record().keyframes) / (1.0 + visit.record().frames / 12.0), Side::at_most, 1.5,
           "one, and the first of the stream"});
    check({name, "frames shown, of those sent", static_cast<double>(visit.shown) / visit.record().frames,
           Side::at_least, 0.5, "each exchange costs those that left before its report was back: up to 4 of 12"});
}

TEST(Lost, FramesAreAskedForAgain) {
    const RunningServer server;
    LinkFaults faults;
    faults.frame = [](int frame) { return Fate{.copies = frame == 5 || frame == 20 ? 0 : 1}; };
    Visit visit(server, faults);
    visit.watch(700ms);
    const std::string name = "machinery/link-lost-frames";
    check_sanity(name, visit);
    check({name, "longest pause (ms)", ms(visit.longest_gap_ns), Side::at_most, 1500.0,
           "some frame times on an idle machine; less than the 2 s after which a session gives up reports"});
    const std::lock_guard lock(visit.record().mutex);
    check({name, "keyframes", static_cast<double>(visit.record().keyframes), Side::at_most, 3.0,
           "the first, and one for each loss"});
}

TEST(Lost, AReportIsNotMissed) {
    const RunningServer server;
    LinkFaults faults;
    faults.loses_report = [](int report) { return report % 3 != 2; };
    Visit visit(server, faults);
    visit.watch(700ms);
    const std::string name = "machinery/link-lost-reports-two-of-three";
    check_sanity(name, visit);
    check({name, "longest pause (ms)", ms(visit.longest_gap_ns), Side::at_most, 1500.0,
           "a report stands for all frames before it, so the 2 s of one that gives up are never waited for"});
}

/// Everything in flight, or every report about it, is lost: nothing is left that would tell the server.
TEST(Lost, AllReportsDoNotStopTheSession) {
    const RunningServer server;
    LinkFaults faults;
    faults.loses_report = [](int report) { return report >= 5 && report < 8; };
    Visit visit(server, faults);
    visit.watch(2600ms);
    const std::string name = "machinery/link-lost-reports-all";
    check_sanity(name, visit, false);
    check({name, "longest pause (ms)", ms(visit.longest_gap_ns), Side::at_most, 4000.0,
           "Pacer::kReportLimit, 2 s, and a busy machine; without it the session stood for ever"});
    check({name, "longest pause (ms), at least", ms(visit.longest_gap_ns), Side::at_least, 1900.0,
           "pacing does not flood a slow client"});
}

TEST(Lost, AllFramesInFlightDoNotStopTheSession) {
    MACULA_WHOLE_SUITE_ONLY();
    const RunningServer server;
    LinkFaults faults;
    faults.frame = [](int frame) { return Fate{.copies = frame >= 5 && frame < 15 ? 0 : 1}; };
    Visit visit(server, faults);
    visit.watch(10s);
    const std::string name = "machinery/link-lost-burst-10";
    check_sanity(name, visit, false);
    check({name, "longest pause (ms)", ms(visit.longest_gap_ns), Side::at_most, 9000.0,
           "three frames each 2 s until one arrives: four times Pacer::kReportLimit, and a busy machine"});
    check({name, "pause at the end (ms)", ms(now_ns() - visit.last_shown_ns), Side::at_most, 1500.0,
           "frames come again as before"});
}

TEST(Pause, OfAClientThatDoesNotReadFor2Seconds) {
    const RunningServer server;
    const auto reads_from_ns = std::make_shared<std::atomic<std::int64_t>>(0);
    LinkFaults faults;
    faults.reads_from_ns = [reads_from_ns] { return reads_from_ns->load(); };
    Visit visit(server, faults);
    visit.watch(200ms);
    const std::size_t before = visit.age_ns.size();
    *reads_from_ns = now_ns() + 2'000'000'000;
    visit.watch(2400ms);
    const std::string name = "machinery/client-pauses-2s";
    check_sanity(name, visit);
    const auto old = std::count_if(visit.age_ns.begin() + static_cast<std::ptrdiff_t>(before), visit.age_ns.end(),
                                   [](std::int64_t age_ns) { return age_ns > 1'000'000'000; });
    check({name, "old frames shown after it", static_cast<double>(old), Side::at_most, kMostInFlight,
           "those that were in flight; the server makes no more meanwhile"});
    check({name, "frames shown after it", static_cast<double>(visit.age_ns.size() - before), Side::at_least, 10.0,
           "it goes on: .4 s at 90 Hz, on a busy machine"});
}

/// Pauses once.
class PausingTracer final : public Tracer {
public:
    explicit PausingTracer(std::shared_ptr<const Tracer> tracer) : tracer_(std::move(tracer)) {}
    TraceCounts trace(std::span<const TraceTask> tasks, double time_s) const noexcept override {
        if (pauses.exchange(false)) std::this_thread::sleep_for(2s);
        return tracer_->trace(tasks, time_s);
    }
    [[nodiscard]] std::string name() const override { return tracer_->name(); }
    [[nodiscard]] std::size_t memory_bytes() const override { return tracer_->memory_bytes(); }

    mutable std::atomic<bool> pauses{false};

private:
    std::shared_ptr<const Tracer> tracer_;
};

TEST(Pause, OfAServerThatMakesNoFrameFor2Seconds) {
    MACULA_WHOLE_SUITE_ONLY();
    Supplies supplies = macula::testing::small_supplies();
    const auto tracer = std::make_shared<PausingTracer>(supplies.tracer);
    supplies.tracer = tracer;
    const RunningServer server({}, supplies);
    Visit visit(server, {});
    visit.watch(200ms);
    const std::size_t before = visit.age_ns.size();
    tracer->pauses = true;
    visit.watch(2400ms);
    const std::string name = "machinery/server-pauses-2s";
    check_sanity(name, visit);
    const auto old = std::count_if(visit.age_ns.begin() + static_cast<std::ptrdiff_t>(before), visit.age_ns.end(),
                                   [](std::int64_t age_ns) { return age_ns > 1'000'000'000; });
    check({name, "old frames shown after it", static_cast<double>(old), Side::at_most, 1.0,
           "the one that it paused in; of the Tracks that came meanwhile the newest is taken"});
    check({name, "frames shown after it", static_cast<double>(visit.age_ns.size() - before), Side::at_least, 10.0,
           "it goes on: .4 s at 90 Hz, on a busy machine"});
}

TEST(Resolution, OfAClientThatComesBackWithAnotherDisplay) {
    const RunningServer server;
    for (const auto& [width_px, height_px] : {std::pair(128, 128), std::pair(192, 160), std::pair(64, 64)}) {
        Visit visit(server, {}, width_px, height_px);
        visit.watch(150ms);
        const std::string name = "machinery/display-" + std::to_string(width_px) + "x" + std::to_string(height_px);
        check_sanity(name, visit);
        check({name, "pictures of another size", static_cast<double>(visit.wrong_size), Side::at_most, 0.0,
               "colour has both eyes side by side, depth a value for each 4x4 block"});
        check({name, "frames that could not be decoded", static_cast<double>(visit.counters().frames_undecodable),
               Side::at_most, 0.0, "each connection has encoders and decoders of its own"});
    }
}

}  // namespace
}  // namespace macula::test
