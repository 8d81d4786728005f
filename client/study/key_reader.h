#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

struct termios;

namespace macula {

/// Times of key presses on standard input, taken on a thread of its own. A terminal is put into raw mode, without echo,
/// so that any key counts at once, and gets its mode back at the end; Ctrl-C still ends the program. Of anything else,
/// a pipe for example, each line is a press.
class KeyReader {
public:
    KeyReader();
    ~KeyReader();
    KeyReader(const KeyReader&) = delete;
    KeyReader& operator=(const KeyReader&) = delete;

    /// Times of the presses since the last call, now_ns(), in order. Any thread.
    std::vector<std::int64_t> take();

private:
    void run();

    std::unique_ptr<termios> before_;  ///< null: standard input is no terminal
    std::mutex mutex_;
    std::vector<std::int64_t> presses_ns_;
    std::atomic<bool> stopping_{false};
    std::thread thread_;
};

}  // namespace macula
