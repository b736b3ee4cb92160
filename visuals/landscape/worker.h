#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace octant::visuals::landscape {

/// Begins work on a thread that somebody has to spare; false, and nothing is done, where there is
/// none. The work does not throw.
using Beside = std::function<bool(std::function<void()> work)>;

/// Does one piece of work at a time beside its owner.
class Worker {
public:
    Worker() = default;
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    Worker(Worker&&) = delete;
    Worker& operator=(Worker&&) = delete;
    ~Worker(); ///< waits

    /// Begins work after waiting for what was begun before: on a thread that is spared for it, else
    /// on one of its own, which is made when it is first needed.
    void begin(std::function<void()> work, const Beside& beside);

    /// Returns when nothing is being done; throws what the work threw.
    void wait();

private:
    void run(const std::stop_token& stop);
    void do_work();

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::function<void()> work_; ///< empty: nothing to do
    bool is_lent_ = false;       ///< another's thread does it
    std::exception_ptr fault_;
    std::jthread thread_;
};

} // namespace octant::visuals::landscape
