#include "visuals/landscape/worker.h"

#include <utility>

namespace octant::visuals::landscape {

Worker::~Worker() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !work_; });
}

void Worker::begin(std::function<void()> work, const Beside& beside) {
    wait();
    {
        const std::scoped_lock lock(mutex_);
        work_ = std::move(work);
        is_lent_ = true;
    }
    if (beside && beside([this] { do_work(); })) {
        return;
    }
    if (!thread_.joinable()) {
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
    {
        const std::scoped_lock lock(mutex_);
        is_lent_ = false;
    }
    changed_.notify_all();
}

void Worker::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !work_; });
    if (fault_) {
        std::rethrow_exception(std::exchange(fault_, nullptr));
    }
}

void Worker::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return work_ && !is_lent_; })) {
        lock.unlock();
        do_work();
        lock.lock();
    }
}

void Worker::do_work() {
    std::exception_ptr fault;
    try {
        work_();
    } catch (...) {
        fault = std::current_exception();
    }
    // Notified under the lock: whoever waits may destroy this one next.
    const std::scoped_lock lock(mutex_);
    fault_ = fault;
    work_ = nullptr;
    changed_.notify_all();
}

} // namespace octant::visuals::landscape
