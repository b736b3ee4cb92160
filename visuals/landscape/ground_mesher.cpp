#include "visuals/landscape/ground_mesher.h"

#include <utility>

namespace octant::visuals::landscape {

BackgroundTask::~BackgroundTask() {
    std::unique_lock lock(mutex_);
    state_changed_.wait(lock, [this] { return !work_; });
}

void BackgroundTask::begin(std::function<void()> work, const IdleThreadRunner& on_idle_thread) {
    wait();
    {
        const std::scoped_lock lock(mutex_);
        work_ = std::move(work);
        runs_on_pool_thread_ = true;
    }
    if (on_idle_thread && on_idle_thread([this] { run_work(); })) { return; }
    if (!thread_.joinable()) {
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
    {
        const std::scoped_lock lock(mutex_);
        runs_on_pool_thread_ = false;
    }
    state_changed_.notify_all();
}

void BackgroundTask::wait() {
    std::unique_lock lock(mutex_);
    state_changed_.wait(lock, [this] { return !work_; });
    if (exception_) { std::rethrow_exception(std::exchange(exception_, nullptr)); }
}

void BackgroundTask::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (state_changed_.wait(lock, stop, [this] { return work_ && !runs_on_pool_thread_; })) {
        lock.unlock();
        run_work();
        lock.lock();
    }
}

void BackgroundTask::run_work() {
    std::exception_ptr exception;
    try {
        work_();
    } catch (...) { exception = std::current_exception(); }
    // Notified under the lock: whoever waits may destroy this one next.
    const std::scoped_lock lock(mutex_);
    exception_ = exception;
    work_ = nullptr;
    state_changed_.notify_all();
}

} // namespace octant::visuals::landscape
