#include "client/study/key_reader.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "protocol/base/clock.h"

namespace macula {
namespace {

/// Bounds the time that the end takes.
constexpr int kWake_ms = 50;

}  // namespace

KeyReader::KeyReader() {
    termios mode{};
    if (::isatty(STDIN_FILENO) == 1 && ::tcgetattr(STDIN_FILENO, &mode) == 0) {
        before_ = std::make_unique<termios>(mode);
        mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        mode.c_cc[VMIN] = 1;
        mode.c_cc[VTIME] = 0;
        ::tcsetattr(STDIN_FILENO, TCSANOW, &mode);
    }
    thread_ = std::thread([this] { run(); });
}

KeyReader::~KeyReader() {
    stopping_ = true;
    thread_.join();
    if (before_) ::tcsetattr(STDIN_FILENO, TCSANOW, before_.get());
}

std::vector<std::int64_t> KeyReader::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(presses_ns_, {});
}

void KeyReader::run() {
    std::array<char, 256> bytes{};
    while (!stopping_) {
        pollfd input{STDIN_FILENO, POLLIN, 0};
        if (::poll(&input, 1, kWake_ms) <= 0) continue;
        const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
        const std::int64_t now = now_ns();
        if (count <= 0) return;  // the end of a pipe, or a terminal that has gone: no more keys
        // A key that sends several bytes, such as an arrow, is one press.
        const auto presses = before_ ? 1 : std::count(bytes.begin(), bytes.begin() + count, '\n');
        const std::lock_guard lock(mutex_);
        presses_ns_.insert(presses_ns_.end(), static_cast<std::size_t>(presses), now);
    }
}

}  // namespace macula
