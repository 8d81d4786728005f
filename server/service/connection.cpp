#include "server/service/connection.h"

#include <optional>
#include <utility>

#include <fmt/core.h>
#include <spdlog/logger.h>

#include "server/service/handshake.h"

namespace macula {

namespace {

constexpr std::chrono::milliseconds kAnswerLimit{2'000};

/// One of a limited number of places, kept for as long as it lives.
class Seat {
public:
    static std::optional<Seat> take(std::atomic<int>& taken, int limit) {
        if (taken.fetch_add(1) < limit) return Seat(taken);
        --taken;
        return std::nullopt;
    }
    Seat(Seat&& other) noexcept : taken_(std::exchange(other.taken_, nullptr)) {}
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;
    Seat& operator=(Seat&&) = delete;
    ~Seat() {
        if (taken_ != nullptr) --*taken_;
    }

private:
    explicit Seat(std::atomic<int>& taken) : taken_(&taken) {}
    std::atomic<int>* taken_;
};

}  // namespace

Connection::Connection(std::uint64_t number, std::unique_ptr<Channel> channel, ConnectionShared& shared)
    : name_(fmt::format("client {} ({})", number, channel->peer())), channel_(std::move(channel)), shared_(shared) {}

void Connection::run() {
    ++shared_.counters.connections;
    if (auto outcome = greet_and_serve(); !outcome) {
        if (outcome.error().code == ErrorCode::protocol) ++shared_.counters.malformed;
        shared_.logger->warn("{}: {}", name_, outcome.error().message);
    }
    channel_->close();
    ended_ = true;
}

Expected<void> Connection::greet_and_serve() {
    std::optional<Seat> greeting = Seat::take(shared_.counters.greetings, shared_.options.max_greetings);
    if (!greeting) return fail(ErrorCode::refused, "closed at once: too many clients are in the handshake");
    Expected<Hello> hello = receive_hello();
    if (!hello) return refuse(hello.error());
    if (auto known = authenticate(*hello, shared_.options.token); !known) return refuse(known.error());
    greeting.reset();

    const std::optional<Seat> seat = Seat::take(shared_.counters.sessions, shared_.options.max_sessions);
    if (!seat)
        return refuse({ErrorCode::refused, fmt::format("the server is full: it serves {} clients at once; try again "
                                                       "when one has left",
                                                       shared_.options.max_sessions)});
    Expected<Admission> admission = admit(*hello, shared_.supplies);
    if (!admission) return refuse(admission.error());
    shared_.logger->info(
        "{}: \"{}\" with display {}, {}x{} per eye at {:.0f} Hz, sampling {}, codec {}, reconstruction {}", name_,
        hello->client_name, hello->display_name, hello->eye_width_px, hello->eye_height_px, hello->refresh_hz,
        admission->welcome.sampling, admission->welcome.codec, admission->reconstructor);
    return serve(*std::move(admission));
}

Expected<Hello> Connection::receive_hello() {
    const Expected<Bytes> body = channel_->receive(shared_.options.greeting_limit);
    if (!body) return tl::unexpected(body.error());
    Expected<Message> message = decode_message(*body);
    if (!message) return tl::unexpected(message.error());
    if (auto* hello = std::get_if<Hello>(&*message)) return std::move(*hello);
    return fail(ErrorCode::protocol, "the first message of a client must be Hello");
}

Expected<void> Connection::serve(Admission admission) {
    if (auto sent = channel_->send(encode_message(std::move(admission.welcome)), kAnswerLimit); !sent) return sent;
    const auto session = std::make_shared<Session>(name_, *channel_, std::move(admission.parts),
                                                   shared_.options.session, shared_.logger);
    {
        const std::lock_guard lock(mutex_);
        if (stopped_) return {};
        session_ = session;
    }
    return session->run();
}

void Connection::stop(const std::string& reason) {
    std::shared_ptr<Session> session;
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        session = session_;
    }
    if (session)
        session->stop(reason);
    else
        channel_->close();
}

tl::unexpected<Error> Connection::refuse(const Error& error) {
    if (error.code != ErrorCode::network && error.code != ErrorCode::timeout) {
        ++shared_.counters.refused;
        Refused refused;
        refused.reason = error.message;
        // The client may be gone already; that changes nothing here.
        static_cast<void>(channel_->send(encode_message(refused), kAnswerLimit));
    }
    return tl::unexpected(error);
}

}  // namespace macula
