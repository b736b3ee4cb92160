#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace octant::visuals::landscape {

/// A thread that does one piece of work at a time beside its owner.
class Worker {
public:
    Worker() = default;
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    Worker(Worker&&) = delete;
    Worker& operator=(Worker&&) = delete;
    ~Worker() = default; ///< waits

    /// Begins work after waiting for what was begun before. The thread is
    /// made at the first call.
    void begin(std::function<void()> work);

    /// Returns when nothing is being done; throws what the work threw.
    void wait();

private:
    void run(const std::stop_token& stop);

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::function<void()> work_; ///< empty: nothing to do
    std::exception_ptr fault_;
    std::jthread thread_;
};

} // namespace octant::visuals::landscape
