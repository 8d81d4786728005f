#pragma once

#include <thread>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

namespace macula {

/// An io_context and the one thread that runs it, so that nothing on it needs a lock or strand of its own.
class IoThread {
public:
    IoThread() : context_(1), work_(context_.get_executor()) {}
    /// Waits until everything under way has ended: whoever starts an operation bounds its time. Not to be called
    /// on the thread itself, so handlers never own an IoThread.
    ~IoThread() {
        work_.reset();
        if (thread_.joinable()) thread_.join();
    }
    IoThread(const IoThread&) = delete;
    IoThread& operator=(const IoThread&) = delete;

    /// Until then the context may be run on the calling thread.
    void start() {
        thread_ = std::thread([this] { context_.run(); });
    }

    [[nodiscard]] boost::asio::io_context& context() { return context_; }

private:
    boost::asio::io_context context_;
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;
    std::thread thread_;
};

}  // namespace macula
