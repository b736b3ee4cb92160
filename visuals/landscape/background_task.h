#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace octant::visuals::landscape {

/// Begins work on a thread that somebody has to spare; false, and nothing is done, where there is none. The work does
/// not throw.
using IdleThreadRunner = std::function<bool(std::function<void()> work)>;

/// Does one piece of work at a time beside its owner.
class BackgroundTask {
public:
    BackgroundTask() = default;
    BackgroundTask(const BackgroundTask&) = delete;
    BackgroundTask& operator=(const BackgroundTask&) = delete;
    BackgroundTask(BackgroundTask&&) = delete;
    BackgroundTask& operator=(BackgroundTask&&) = delete;
    ~BackgroundTask(); ///< waits

    /// Begins work after waiting for what was begun before: on a thread that is spared for it, else on one of its own,
    /// which is made when it is first needed.
    void begin(std::function<void()> work, const IdleThreadRunner& on_idle_thread);

    /// Returns when nothing is being done; throws what the work threw.
    void wait();

private:
    void run(const std::stop_token& stop);
    void run_work();

    std::mutex mutex_;
    std::condition_variable_any state_changed_;
    std::function<void()> work_;       ///< empty: nothing to do
    bool runs_on_pool_thread_ = false; ///< another's thread does it
    std::exception_ptr exception_;
    std::jthread thread_;
};

} // namespace octant::visuals::landscape
