#include "server/service/session.h"

#include <thread>
#include <utility>

#include <fmt/core.h>
#include <spdlog/logger.h>

#include "protocol/base/clock.h"

namespace macula {

namespace {

/// How long a Bye may hold up the end of a session.
constexpr std::chrono::milliseconds kByeLimit{200};
/// How often a waiting thread looks whether a log line is due.
constexpr std::chrono::milliseconds kWake{100};

std::int64_t nanoseconds(std::chrono::milliseconds duration) {
    return std::chrono::nanoseconds(duration).count();
}

template <class... Handlers>
struct Overloaded : Handlers... {
    using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

Session::Session(std::string name, Channel& channel, Parts parts, const SessionOptions& options,
                 std::shared_ptr<spdlog::logger> logger)
    : name_(std::move(name)),
      channel_(channel),
      parts_(std::move(parts)),
      options_(options),
      logger_(std::move(logger)),
      choices_(std::move(parts_.make_method)),
      pacer_(parts_.refresh_hz, options.max_in_flight),
      statistics_(now_ns(), parts_.frame_pixels) {}

Expected<void> Session::run() {
    {
        const std::jthread render([this] { render_loop(); });
        const std::jthread encode([this] { encode_loop(); });
        const std::jthread choose([this] { choose_loop(); });
        read_loop();
    }
    logger_->info("{}: ended after {}; {} tracks replaced by newer ones", name_, statistics_.summary_line(now_ns()),
                  tracks_.dropped());
    const std::lock_guard lock(finish_mutex_);
    return outcome_;
}

void Session::stop(const std::string& reason) {
    finish({}, reason);
}

void Session::finish(Expected<void> outcome, const std::string& bye) {
    {
        const std::lock_guard lock(finish_mutex_);
        if (finished_.exchange(true)) return;
        outcome_ = std::move(outcome);
    }
    tracks_.close();
    pictures_.close();
    choices_.close();
    pacer_.close();
    // A client that does not read its Bye sees the connection close, which is enough.
    if (!bye.empty()) static_cast<void>(channel_.send(encode_message(Bye{bye}), kByeLimit));
    channel_.close();
}

void Session::fail_with(const Error& error) {
    // A Bye says that the end is meant. A client that was lost to the network, or asleep, had better come back.
    const bool lost = error.code == ErrorCode::network || error.code == ErrorCode::timeout;
    finish(tl::unexpected(error), lost ? std::string() : error.message);
}

void Session::read_loop() {
    while (!finished_) {
        const Expected<Bytes> body = channel_.receive(options_.silence_limit);
        if (!body && body.error().code == ErrorCode::timeout)
            return fail_with(
                {ErrorCode::timeout, fmt::format("the client sent nothing for {:.1f} s",
                                                 1e-3 * static_cast<double>(options_.silence_limit.count()))});
        if (!body) return fail_with(body.error());
        const Expected<Message> message = decode_message(*body);
        if (!message) return fail_with(message.error());
        if (auto handled = handle(*message); !handled) return fail_with(handled.error());
    }
}

Expected<void> Session::handle(const Message& message) {
    return std::visit(
        Overloaded{[this](const Track& track) -> Expected<void> {
                       tracks_.put({track, now_ns()});
                       return {};
                   },
                   [this](const FrameReport& report) -> Expected<void> {
                       if (report.decode_failed) keyframe_wish_.failed(report.frame_id);
                       statistics_.add_report(report);
                       pacer_.update([&report](PacingState& state) { state.reported(report.frame_id); });
                       return {};
                   },
                   [this](const Ping& ping) {
                       return channel_.send(encode_message(Pong{ping.sent_ns, now_ns()}), options_.send_limit);
                   },
                   [this](const Bye& bye) -> Expected<void> {
                       logger_->info("{}: the client says bye: {}", name_, bye.reason);
                       finish({}, "");
                       return {};
                   },
                   [this](const Choose& choice) -> Expected<void> {
                       const auto answer = choices_.ask(choice);
                       return answer ? channel_.send(encode_message(*answer), options_.send_limit) : Expected<void>();
                   },
                   [](const auto&) -> Expected<void> {
                       return fail(ErrorCode::protocol,
                                   "unexpected message: after the handshake a client sends Track, FrameReport, Ping, "
                                   "Choose and Bye");
                   }},
        message);
}

void Session::render_loop() {
    while (pacer_.wait_for_room()) {
        const auto received = tracks_.take(kWake);
        if (!received) continue;
        if (auto made = choices_.take()) parts_.frame_maker->use(std::move(made->method), made->choice);
        Picture picture = spare_pictures_.try_take().value_or(Picture{});
        pacer_.update([](PacingState& state) { state.begin(now_ns()); });
        if (auto made = parts_.frame_maker->make(received->track, received->received_ns, picture); !made)
            return fail_with(made.error());
        pacer_.update([](PacingState& state) { state.rendered(); });
        pictures_.put(std::move(picture));
    }
}

void Session::choose_loop() {
    while (!finished_) {
        const auto answer = choices_.make_next(kWake);
        if (!answer) continue;
        if (answer->problem.empty())
            logger_->debug("{}: choice {} is ready", name_, answer->id);
        else
            logger_->warn("{}: choice {}: {}", name_, answer->id, answer->problem);
        if (auto sent = channel_.send(encode_message(*answer), options_.send_limit); !sent)
            return fail_with(sent.error());
    }
}

void Session::encode_loop() {
    std::int64_t next_log_ns = now_ns() + nanoseconds(options_.log_interval);
    while (!finished_) {
        if (auto picture = pictures_.take(kWake)) {
            pacer_.update([](PacingState& state) { state.taken(); });
            if (auto sent = encode_and_send(*picture); !sent) return fail_with(sent.error());
            spare_pictures_.put(*std::move(picture));
        }
        if (now_ns() >= next_log_ns) {
            logger_->info("{}: {}", name_, statistics_.interval_line(now_ns()));
            next_log_ns = now_ns() + nanoseconds(options_.log_interval);
        }
    }
}

Expected<void> Session::encode_and_send(Picture& picture) {
    const bool keyframe = keyframe_wish_.begin();
    Expected<EncodedFrame> color = parts_.color_encoder->encode(picture.color, keyframe);
    if (!color) return tl::unexpected(color.error());
    Expected<EncodedFrame> depth = parts_.depth_encoder->encode(picture.inverse_depth, picture.frame.near_m, keyframe);
    if (!depth) return tl::unexpected(depth.error());

    Frame frame = std::move(picture.frame);
    frame.keyframe = color->keyframe && depth->keyframe;
    frame.color = std::move(color->bytes);
    frame.depth = std::move(depth->bytes);
    frame.id = pacer_.update([](PacingState& state) { return state.encoded(); });
    keyframe_wish_.coded(frame.id);
    frame.times.encode_ns = now_ns();
    frame.times.send_ns = frame.times.encode_ns;

    const StageTimes times = frame.times;
    const std::uint32_t traced = frame.traced;
    const Bytes body = encode_message(std::move(frame));
    if (auto sent = channel_.send(body, options_.send_limit); !sent) return sent;
    statistics_.add_frame(times, traced, body.size(), now_ns());
    return {};
}

}  // namespace macula
