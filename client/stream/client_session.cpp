#include "client/stream/client_session.h"

#include <algorithm>
#include <utility>

#include "client/stream/backoff.h"
#include "protocol/base/clock.h"

namespace macula {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSendTimeout{2'000};
constexpr milliseconds kPollInterval{100};
constexpr std::int64_t kPingInterval_ns = 250'000'000;
constexpr std::size_t kMostAnswers = 256;

/// The server's no, for a person.
Error refusal(const Refused& refused) {
    std::string message = "the server refused: " + refused.reason;
    if (refused.protocol_version != kProtocolVersion) {
        message += " (it speaks protocol version " + std::to_string(refused.protocol_version) +
                   ", this client version " + std::to_string(kProtocolVersion) + ")";
    }
    return {ErrorCode::refused, std::move(message)};
}

/// Whether trying again can help. A server may come back; a wrong token stays wrong.
bool worth_retrying(const Error& error) {
    return error.code == ErrorCode::network || error.code == ErrorCode::timeout || error.code == ErrorCode::protocol;
}

milliseconds until_ns(std::int64_t time_ns) {
    return milliseconds(std::max<std::int64_t>(0, (time_ns - now_ns()) / 1'000'000));
}

}  // namespace

ClientSession::ClientSession(Connect connect, ClientSessionOptions options, Log log)
    : connect_(std::move(connect)), options_(std::move(options)), log_(std::move(log)) {
    thread_ = std::thread([this] { run(); });
}

ClientSession::~ClientSession() {
    stop();
}

void ClientSession::send(Track track) {
    {
        const std::lock_guard lock(mutex_);
        if (!serving_) return;
        track.id = next_track_id_++;
    }
    outbox_.put_track(track);
}

void ClientSession::send(const FrameReport& report) {
    outbox_.put(report);
}

void ClientSession::send(const Choose& choice) {
    outbox_.put(choice);
}

std::vector<Chosen> ClientSession::take_answers() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answers_, {});
}

std::optional<Error> ClientSession::error() const {
    const std::lock_guard lock(mutex_);
    return error_;
}

std::shared_ptr<const Welcome> ClientSession::welcome() const {
    const std::lock_guard lock(mutex_);
    return welcome_;
}

std::optional<ClockOffset> ClientSession::clock_offset() const {
    const std::lock_guard lock(mutex_);
    return clock_filter_.best();
}

ClientSessionCounters ClientSession::counters() const {
    const std::lock_guard lock(mutex_);
    ClientSessionCounters counters = counters_;
    counters.frames_dropped = frames_.dropped();
    counters.tracks_dropped = outbox_.dropped_tracks();
    return counters;
}

void ClientSession::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        outbox_.put(Bye{"the client ends"});
    }
    stopped_.notify_all();
    if (thread_.joinable()) thread_.join();
}

bool ClientSession::stopping() const {
    const std::lock_guard lock(mutex_);
    return stopping_;
}

bool ClientSession::sleep_for(milliseconds time) {
    std::unique_lock lock(mutex_);
    return !stopped_.wait_for(lock, time, [this] { return stopping_; });
}

void ClientSession::give_up(Error error) {
    {
        const std::lock_guard lock(mutex_);
        if (!stopping_) error_ = std::move(error);
    }
    frames_.close();
}

void ClientSession::run() {
    Backoff backoff(options_.first_retry, options_.longest_retry, options_.seed);
    std::int64_t give_up_ns = now_ns() + options_.retry_for.count() * 1'000'000;
    std::uint64_t frames_before = 0;
    while (true) {
        Error problem;
        if (auto channel = connect_(options_.handshake_timeout); !channel) {
            problem = channel.error();
        } else if (auto welcome = shake_hands(**channel); !welcome) {
            problem = welcome.error();
        } else {
            problem = serve(**channel, *welcome);
            log_("the connection to " + (*channel)->peer() + " ended");
            // A server that takes connections but never sends a frame is as good as none.
            if (const std::uint64_t frames = counters().frames_received;
                std::exchange(frames_before, frames) < frames) {
                backoff.reset();
                give_up_ns = now_ns() + options_.retry_for.count() * 1'000'000;
            }
        }
        if (stopping() || !worth_retrying(problem) || now_ns() >= give_up_ns) return give_up(std::move(problem));
        const milliseconds wait = std::min(backoff.next(), until_ns(give_up_ns) + milliseconds(1));
        log_(problem.message + "; trying again in " + std::to_string(wait.count()) + " ms");
        if (!sleep_for(wait)) return give_up({ErrorCode::network, "stopped"});
    }
}

Expected<std::shared_ptr<const Welcome>> ClientSession::shake_hands(Channel& channel) {
    if (auto sent = channel.send(encode_message(options_.hello), kSendTimeout); !sent) {
        return tl::unexpected(sent.error());
    }
    const auto body = receive(channel, options_.handshake_timeout);
    if (!body) return tl::unexpected(body.error());
    auto message = decode_message(*body);
    if (!message) return tl::unexpected(message.error());
    if (const auto* refused = std::get_if<Refused>(&*message)) return tl::unexpected(refusal(*refused));
    auto* welcome = std::get_if<Welcome>(&*message);
    if (welcome == nullptr) {
        return fail(ErrorCode::protocol, channel.peer() + " answered Hello with something else than Welcome");
    }
    if (welcome->protocol_version != kProtocolVersion) {
        return tl::unexpected(refusal({welcome->protocol_version, "it speaks another version of the protocol"}));
    }
    return std::make_shared<const Welcome>(std::move(*welcome));
}

Error ClientSession::serve(Channel& channel, const std::shared_ptr<const Welcome>& welcome) {
    const int width_px = 2 * options_.hello.eye_width_px;
    auto decoder = FrameDecoder::make(welcome->codec, width_px, options_.hello.eye_height_px);
    if (!decoder) return decoder.error();
    outbox_.clear();
    {
        const std::lock_guard lock(mutex_);
        if (stopping_) return {ErrorCode::network, "stopped"};
        welcome_ = welcome;
        clock_filter_ = {};
        answers_.clear();
        ++counters_.connections;
        serving_ = true;
    }
    log_("connected to " + channel.peer() + ": " + welcome->server_name + ", scene " + welcome->scene_name +
         ", sampling " + welcome->sampling + ", " + welcome->renderer);

    std::jthread sender([this, &channel](const std::stop_token& stop) { send_until_closed(channel, stop); });
    Error problem;
    while (true) {
        const auto body = receive(channel, options_.silence_timeout);
        if (!body) {
            problem = body.error();
            break;
        }
        auto message = decode_message(*body);
        if (!message) {
            problem = message.error();
            break;
        }
        if (auto handled = handle(std::move(*message), body->size(), *decoder, welcome); !handled) {
            problem = handled.error();
            break;
        }
    }
    {
        const std::lock_guard lock(mutex_);
        serving_ = false;
    }
    // After stop() the sender says goodbye and closes the channel itself.
    if (!stopping()) channel.close();
    sender.request_stop();
    outbox_.interrupt();
    return problem;
}

Expected<Bytes> ClientSession::receive(Channel& channel, milliseconds timeout) {
    const std::int64_t end_ns = now_ns() + timeout.count() * 1'000'000;
    while (!stopping()) {
        auto body = channel.receive(std::min(kPollInterval, until_ns(end_ns) + milliseconds(1)));
        if (body || body.error().code != ErrorCode::timeout) return body;
        if (now_ns() >= end_ns) return fail(ErrorCode::timeout, channel.peer() + " has been silent for too long");
    }
    return fail(ErrorCode::network, "stopped");
}

void ClientSession::send_until_closed(Channel& channel, const std::stop_token& stop) {
    std::int64_t next_ping_ns = 0;
    while (!stop.stop_requested()) {
        if (now_ns() >= next_ping_ns) {
            next_ping_ns = now_ns() + kPingInterval_ns;
            outbox_.put(Ping{});
        }
        for (Message& message : outbox_.take(until_ns(next_ping_ns) + milliseconds(1))) {
            // The time of a Ping is when it leaves, not when it began to wait.
            if (auto* ping = std::get_if<Ping>(&message)) ping->sent_ns = now_ns();
            if (auto* pong = std::get_if<Pong>(&message)) pong->answered_ns = now_ns();
            const bool last = std::holds_alternative<Bye>(message);
            if (!channel.send(encode_message(message), kSendTimeout) || last) return channel.close();
        }
    }
}

Expected<void> ClientSession::handle(Message message, std::size_t bytes, FrameDecoder& decoder,
                                     const std::shared_ptr<const Welcome>& welcome) {
    if (auto* frame = std::get_if<Frame>(&message)) {
        handle_frame(std::move(*frame), bytes, decoder, welcome);
        return {};
    }
    if (const auto* ping = std::get_if<Ping>(&message)) {
        outbox_.put(Pong{ping->sent_ns, 0});
        return {};
    }
    if (const auto* pong = std::get_if<Pong>(&message)) {
        const std::lock_guard lock(mutex_);
        clock_filter_.add(*pong, now_ns());
        return {};
    }
    if (auto* chosen = std::get_if<Chosen>(&message)) {
        const std::lock_guard lock(mutex_);
        // Answers without questions, and those that nobody fetches, are not collected for ever.
        if (answers_.size() == kMostAnswers) answers_.erase(answers_.begin());
        answers_.push_back(std::move(*chosen));
        return {};
    }
    if (const auto* bye = std::get_if<Bye>(&message)) {
        return fail(ErrorCode::network, "the server said goodbye: " + bye->reason);
    }
    return fail(ErrorCode::protocol, "the server sent a message that only clients send");
}

void ClientSession::handle_frame(Frame frame, std::size_t bytes, FrameDecoder& decoder,
                                 const std::shared_ptr<const Welcome>& welcome) {
    if (decoder.repeats(frame)) {
        const std::lock_guard lock(mutex_);
        ++counters_.frames_repeated;
        return;
    }
    ReceivedFrame received;
    received.received_ns = now_ns();
    received.frame = std::move(frame);
    received.bytes = bytes;
    received.welcome = welcome;
    const Expected<void> decoded = decoder.decode(received);
    received.decoded_ns = now_ns();
    {
        const std::lock_guard lock(mutex_);
        received.connection = counters_.connections;
        ++counters_.frames_received;
        counters_.bytes_received += bytes;
        if (!decoded) ++counters_.frames_undecodable;
    }
    if (!decoded) {
        // Those that only wait for the keyframe ask for it again, quietly.
        if (!std::exchange(undecodable_, true)) log_(decoded.error().message);
        outbox_.put(FrameReport{received.frame.id, received.received_ns, received.decoded_ns, 0, true});
        return;
    }
    undecodable_ = false;
    if (const auto replaced = frames_.put(std::move(received))) {
        outbox_.put(FrameReport{replaced->frame.id, replaced->received_ns, replaced->decoded_ns, 0, false});
    }
}

}  // namespace macula
