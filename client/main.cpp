// macula-client: makes every part and connects them.

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "client/device_thread.h"
#include "client/parts.h"
#include "client/report.h"
#include "client/study/key_reader.h"
#include "protocol/base/clock.h"
#include "protocol/transport/tls.h"

namespace {

using namespace macula;
using Logger = std::shared_ptr<spdlog::logger>;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// After the recording's end, frames made from it may still be on their way.
constexpr std::int64_t kLastFrames_ns = kSecond_ns / 2;

/// SIGINT and SIGTERM as values: blocked in every thread, asked for when it suits.
class Signals {
public:
    Signals() {
        sigemptyset(&set_);
        sigaddset(&set_, SIGINT);
        sigaddset(&set_, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &set_, nullptr);
        std::signal(SIGPIPE, SIG_IGN);
    }
    /// Whether one has come since the last call.
    [[nodiscard]] bool raised() const {
        const timespec none{};
        return sigtimedwait(&set_, nullptr, &none) > 0;
    }

private:
    sigset_t set_{};
};

/// --seconds; 0: no limit.
std::int64_t length_ns(const ClientOptions& options) {
    return static_cast<std::int64_t>(options.seconds * static_cast<double>(kSecond_ns));
}

/// What one run of the client consists of.
struct Client {
    ClientOptions options;
    Display headset;
    std::unique_ptr<TrackSource> source;
    std::unique_ptr<Recorder> recorder;
    std::vector<std::unique_ptr<PictureSink>> sinks;
    std::unique_ptr<Compositor> compositor;
    Report report;
    std::unique_ptr<Study> study;  ///< null: none
    Logger logger;
};

PerEye<Pose> eye_poses(const Display& headset, const Pose& world_from_head) {
    PerEye<Pose> poses;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) poses[eye] = world_from_head * headset.eyes[eye].head_from_eye;
    return poses;
}

/// Accumulates, reprojects to the newest head pose, displays and reports one frame.
Expected<void> present(Client& client, ClientSession& session, const DeviceThread& devices, ReceivedFrame& received,
                       std::uint64_t& connection_before, ColorImage& picture) {
    PresentTimes times;
    times.taken_ns = now_ns();
    const Frame& frame = received.frame;
    NewFrame input;
    input.color = &received.color;
    input.depth = &received.depth;
    input.world_from_eye = frame.world_from_eye;
    input.display_time_ns = frame.display_time_ns;
    input.moving = frame.moving;
    input.moving_map = &received.moving_map;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) input.sampling[eye] = &frame.sampling[eye];
    input.rank_tile = received.welcome->rank_tile;
    input.rank_tile_size_px = received.welcome->rank_tile_size_px;
    input.continues = std::exchange(connection_before, received.connection) == received.connection;
    if (auto done = client.compositor->accumulate(input); !done) return done;
    times.accumulated_ns = now_ns();
    const Pose world_from_head = received.welcome->world_from_start * devices.newest_start_from_head();
    if (auto done = client.compositor->show(eye_poses(client.headset, world_from_head), now_ns(), picture); !done) {
        return done;
    }
    times.reprojected_ns = times.displayed_ns = now_ns();
    session.send(FrameReport{frame.id, received.received_ns, received.decoded_ns, times.displayed_ns, false});
    for (const auto& sink : client.sinks) {
        if (auto shown = sink->show(picture, times.displayed_ns); !shown) return shown;
    }
    times.written_ns = now_ns();
    client.report.add(received, times, session.clock_offset(), session.counters());
    if (!client.study) return {};
    const bool begun = client.study->begun();
    auto shown = client.study->shown(frame, received.connection, *received.welcome, times.displayed_ns);
    if (!begun && client.study->begun()) client.logger->info("the study begins: press a key when the picture changes");
    return shown;
}

/// What is due in the study: questions to the server, its answers, and keys.
Expected<void> go_on(Study& study, ClientSession& session, KeyReader& keys, const Logger& logger) {
    const auto welcome = session.welcome();
    if (!welcome) return {};
    if (!welcome->can_choose)
        return fail(ErrorCode::refused, "the study needs a server that changes the sampling while it runs, and " +
                                            welcome->server_name + " is too old for that");
    for (const Choose& choice : study.due(now_ns())) {
        logger->debug("study: {}{}", choice.sampling, choice.only_prepare ? " is to be prepared" : "");
        session.send(choice);
    }
    for (const Chosen& answer : session.take_answers()) {
        if (auto good = study.answered(answer); !good) return good;
    }
    for (const std::int64_t pressed_ns : keys.take()) study.key(pressed_ns);
    return {};
}

/// Shows frames until the time, the frames or the recording are over, a signal comes, or the session gives up.
Expected<void> show_frames(Client& client, ClientSession& session, const Signals& signals) {
    std::atomic<std::int64_t> pipeline_ns{client.report.pipeline_ns()};
    const auto deliver = [&](const DeviceSample& sample, const HeadVelocity& velocity) {
        Track track;
        track.pose_time_ns = track.gaze_time_ns = sample.time_ns;
        track.display_time_ns = sample.time_ns + pipeline_ns;
        track.start_from_head = sample.start_from_head;
        track.linear_velocity_m_s = velocity.linear_m_s;
        track.angular_velocity_rad_s = velocity.angular_rad_s;
        track.gaze = sample.gaze;
        session.send(track);
    };
    std::optional<DeviceThread> devices;  // begins with the first connection: a recording is not played to nobody
    std::int64_t begin_ns = 0;
    std::optional<std::int64_t> ended_ns;
    std::uint64_t connection = 0;
    ColorImage picture;
    const std::int64_t limit_ns = length_ns(client.options);
    const auto frame_limit = static_cast<std::uint64_t>(client.options.frames);
    std::optional<KeyReader> keys;
    if (client.study) keys.emplace();
    Expected<void> result;
    while (result && !signals.raised()) {
        const std::int64_t now = now_ns();
        if (client.study) {
            if (client.study->over(now)) break;
            result = go_on(*client.study, session, *keys, client.logger);
            if (!result) break;
        }
        if (!devices && session.welcome()) {
            devices.emplace(std::move(client.source), std::move(client.recorder), deliver);
            begin_ns = now;
        }
        if (limit_ns > 0 && devices && now - begin_ns >= limit_ns) break;
        if (frame_limit > 0 && client.report.frames() >= frame_limit) break;
        if (devices && devices->ended() && !ended_ns) ended_ns = now;
        if (ended_ns && now - *ended_ns >= kLastFrames_ns) break;
        auto received = session.next_frame(std::chrono::milliseconds(devices ? 50 : 5));
        if (received && devices) {
            result = present(client, session, *devices, *received, connection, picture);
            pipeline_ns = client.report.pipeline_ns();
        } else if (const auto error = session.error()) {
            result = tl::unexpected(*error);
        }
    }
    if (client.study) {
        for (const std::int64_t pressed_ns : keys->take()) client.study->key(pressed_ns);
        if (auto closed = client.study->close(now_ns()); !closed && result) result = closed;
    }
    if (devices) {
        if (auto recorded = devices->stop(); !recorded && result) result = recorded;
    }
    return result;
}

Expected<void> write_summary(const std::string& path, const std::string& text) {
    if (path.empty()) return {};
    std::ofstream file(path, std::ios::trunc);
    file << text;
    file.close();
    if (!file) return fail(ErrorCode::output, path + ": the summary cannot be written");
    return {};
}

/// Everything that can fail before the session begins.
Expected<Client> make_client(const ClientOptions& options, const Logger& logger) {
    auto headset = load_display(options.headset);
    if (!headset) return tl::unexpected(headset.error());
    auto source = make_source(options.gaze, [&](const std::string& line) { logger->warn(line); });
    if (!source) return tl::unexpected(source.error());
    std::unique_ptr<Recorder> recorder;
    if (!options.record.empty()) {
        auto opened = Recorder::open(options.record);
        if (!opened) return tl::unexpected(opened.error());
        recorder = std::move(*opened);
    }
    auto sinks = make_sinks(options.displays);
    if (!sinks) return tl::unexpected(sinks.error());
    auto compositor = make_compositor(options, *headset, [&](const std::string& line) { logger->info(line); });
    if (!compositor) return tl::unexpected(compositor.error());
    const auto pixels = std::uint64_t{2} * static_cast<std::uint64_t>(headset->eye_width_px) *
                        static_cast<std::uint64_t>(headset->eye_height_px);
    auto report = Report::open(options.stats, pixels);
    if (!report) return tl::unexpected(report.error());
    auto study = make_study(options);
    if (!study) return tl::unexpected(study.error());
    logger->info("{}; {} at {}x{} per eye", (*source)->name(), headset->name, headset->eye_width_px,
                 headset->eye_height_px);
    return Client{options,
                  std::move(*headset),
                  std::move(*source),
                  std::move(recorder),
                  std::move(*sinks),
                  std::move(*compositor),
                  std::move(*report),
                  std::move(*study),
                  logger};
}

/// --connect none: the recording that a session would have made, without the session.
Expected<void> record_only(const ClientOptions& options, const Logger& logger) {
    if (options.record.empty() || options.seconds <= 0)
        return fail(ErrorCode::option, "--connect none only records: it needs --record FILE and --seconds above 0");
    auto source = make_source(options.gaze, [&](const std::string& line) { logger->warn(line); });
    if (!source) return tl::unexpected(source.error());
    auto recorder = Recorder::open(options.record);
    if (!recorder) return tl::unexpected(recorder.error());
    const std::uint64_t count = record(**source, **recorder, length_ns(options));
    if (auto closed = (*recorder)->close(); !closed) return closed;
    logger->info("{}: {} samples in {}", (*source)->name(), count, options.record);
    return {};
}

Expected<void> run(const ClientOptions& options, const Logger& logger, const Signals& signals) {
    if (options.connect == "none") return record_only(options, logger);
    auto client = make_client(options, logger);
    if (!client) return tl::unexpected(client.error());
    const auto server = parse_server_address(options.connect);
    if (!server) return tl::unexpected(server.error());
    const auto credentials = find_credentials(options);
    if (!credentials) return tl::unexpected(credentials.error());

    ClientSessionOptions session_options;
    session_options.hello = make_hello(client->headset, options, credentials->token);
    session_options.retry_for = std::chrono::milliseconds(static_cast<std::int64_t>(options.retry_seconds * 1e3));
    session_options.seed = static_cast<std::uint32_t>(now_ns());
    ClientSession session(
        [&](std::chrono::milliseconds timeout) {
            return connect(server->first, server->second, credentials->fingerprint, timeout);
        },
        session_options, [&](const std::string& line) { logger->info(line); });

    Expected<void> result = show_frames(*client, session, signals);
    session.stop();
    for (const auto& sink : client->sinks) {
        if (auto closed = sink->close(); !closed && result) result = closed;
    }
    if (auto closed = client->report.close(); !closed && result) result = closed;
    std::fputs(client->report.summary(session.counters()).c_str(), stdout);
    for (const auto& sink : client->sinks) std::printf("pictures              %s\n", sink->where().c_str());
    if (auto written = write_summary(options.summary, client->report.summary_values(session.counters()));
        !written && result) {
        result = written;
    }
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    const auto parsed = parse_client_options(argc, argv);
    if (const int* code = std::get_if<int>(&parsed)) return *code;
    const auto& options = std::get<ClientOptions>(parsed);
    const Logger logger = spdlog::stderr_color_mt("macula-client");
    logger->set_level(spdlog::level::from_str(options.log_level));
    const Signals signals;
    const auto result = run(options, logger, signals);
    if (result) return 0;
    logger->error(result.error().message);
    return static_cast<int>(result.error().code);
}
