#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "protocol/base/error.h"
#include "protocol/base/newest_slot.h"
#include "protocol/message/message.h"
#include "server/service/frame_maker.h"

namespace macula {

/// The methods that a client chooses in the course of a session. They are made one after the other on a thread of their
/// own, which calls make_next(), so that frames go on being made in the old way meanwhile; those asked for last are
/// kept, so that a client can have them prepared and then change between them without a pause. Members without another
/// word may be called from any thread.
class MethodChoices {
public:
    using Make = std::function<Expected<std::unique_ptr<MethodParts>>(const std::string& sampling)>;
    struct Made {
        std::uint32_t choice = 0;  ///< Choose::id
        std::shared_ptr<MethodParts> method;
    };
    static constexpr std::size_t kMostKept = 8;
    static constexpr std::size_t kMostWaiting = 16;

    /// `make` is called on the thread that calls make_next().
    explicit MethodChoices(Make make) : make_(std::move(make)) {}

    /// Puts a choice in the line. Returns the answer at once where the line is full.
    std::optional<Chosen> ask(Choose choice);

    /// Waits for a choice and makes what it names, which may take seconds; empty after `timeout` or when closed. The
    /// answer is for the client. One thread.
    std::optional<Chosen> make_next(std::chrono::milliseconds timeout);

    /// The newest choice that is ready and not only prepared, once.
    std::optional<Made> take() { return ready_.try_take(); }

    /// Ends waits, and forgets what stands in the line. What is being made is made to its end.
    void close();

private:
    std::optional<Choose> next(std::chrono::milliseconds timeout);
    Expected<std::shared_ptr<MethodParts>> find_or_make(const std::string& sampling);

    Make make_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Choose> waiting_;
    bool closed_ = false;
    /// Newest first; only make_next()'s thread's.
    std::list<std::pair<std::string, std::shared_ptr<MethodParts>>> kept_;
    NewestSlot<Made> ready_;
};

}  // namespace macula
