#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "client/stream/clock_offset.h"
#include "client/stream/frame_decoder.h"
#include "client/stream/outbox.h"
#include "protocol/base/newest_slot.h"
#include "protocol/transport/channel.h"

namespace macula {

/// What a session needs to know.
struct ClientSessionOptions {
    Hello hello;
    std::chrono::milliseconds retry_for{30'000};         ///< without a server for this long, the session gives up
    std::chrono::milliseconds handshake_timeout{5'000};  ///< for the connection, and for the answer to Hello
    std::chrono::milliseconds silence_timeout{5'000};    ///< a server that says nothing for this long is lost
    std::chrono::milliseconds first_retry{100};
    std::chrono::milliseconds longest_retry{3'000};
    std::uint32_t seed = 1;  ///< of the jitter between retries
};

/// What happened so far.
struct ClientSessionCounters {
    std::uint64_t connections = 0;
    std::uint64_t frames_received = 0;
    std::uint64_t frames_undecodable = 0;
    std::uint64_t frames_repeated = 0;  ///< came again, or after a newer one: ignored
    std::uint64_t frames_dropped = 0;   ///< replaced by a newer one before they could be shown
    std::uint64_t tracks_dropped = 0;   ///< replaced by a newer one before they could be sent
    std::uint64_t bytes_received = 0;
};

/// A client's side of the protocol: connects, sends Tracks, receives and decodes frames, and does so again when the
/// connection is lost. Two threads of its own: one receives and decodes, one sends. Frames are not dropped between
/// receiving and decoding, because each refers to the one before; a client too slow to decode them slows the server
/// down through TCP, and the server drops pictures before it codes them. All members may be called from any thread.
class ClientSession {
public:
    /// Opens a channel within a time, as macula::connect does.
    using Connect = std::function<Expected<std::unique_ptr<Channel>>(std::chrono::milliseconds timeout)>;
    /// Gets a line for the log.
    using Log = std::function<void(const std::string& line)>;

    ClientSession(Connect connect, ClientSessionOptions options, Log log);
    ClientSession(const ClientSession&) = delete;
    ClientSession& operator=(const ClientSession&) = delete;
    ~ClientSession();

    /// Sends the Track as soon as the channel is free; its id is counted here. Lost while there is no connection.
    void send(Track track);
    void send(const FrameReport& report);
    /// Asks for another method, which servers take whose Welcome says so. Lost when the connection is: the next one
    /// begins with Hello's sampling.
    void send(const Choose& choice);
    /// What the server has answered to those since the last call.
    std::vector<Chosen> take_answers();

    /// The newest frame that was not taken; empty after `timeout`, or when the session has ended.
    std::optional<ReceivedFrame> next_frame(std::chrono::milliseconds timeout) { return frames_.take(timeout); }

    /// Why the session gave up; nothing while it goes on.
    [[nodiscard]] std::optional<Error> error() const;

    /// What the server said about the present or the last connection; null before the first.
    [[nodiscard]] std::shared_ptr<const Welcome> welcome() const;
    [[nodiscard]] std::optional<ClockOffset> clock_offset() const;
    [[nodiscard]] ClientSessionCounters counters() const;

    /// Says goodbye and ends the threads.
    void stop();

private:
    void run();
    Expected<std::shared_ptr<const Welcome>> shake_hands(Channel& channel);
    Error serve(Channel& channel, const std::shared_ptr<const Welcome>& welcome);
    void send_until_closed(Channel& channel, const std::stop_token& stop);
    Expected<void> handle(Message message, std::size_t bytes, FrameDecoder& decoder,
                          const std::shared_ptr<const Welcome>& welcome);
    void handle_frame(Frame frame, std::size_t bytes, FrameDecoder& decoder,
                      const std::shared_ptr<const Welcome>& welcome);
    /// Receives one message while the session is not stopped. Errors: those of Channel::receive.
    Expected<Bytes> receive(Channel& channel, std::chrono::milliseconds timeout);
    [[nodiscard]] bool stopping() const;
    /// False when the session was stopped meanwhile.
    bool sleep_for(std::chrono::milliseconds time);
    void give_up(Error error);

    Connect connect_;
    ClientSessionOptions options_;
    Log log_;
    Outbox outbox_;
    NewestSlot<ReceivedFrame> frames_;

    mutable std::mutex mutex_;
    std::condition_variable stopped_;
    bool stopping_ = false;
    std::optional<Error> error_;
    std::shared_ptr<const Welcome> welcome_;
    ClockFilter clock_filter_;
    ClientSessionCounters counters_;
    std::vector<Chosen> answers_;
    std::uint64_t next_track_id_ = 1;
    bool serving_ = false;

    bool undecodable_ = false;  ///< the last frame was; only the receiving thread's
    std::thread thread_;
};

}  // namespace macula
