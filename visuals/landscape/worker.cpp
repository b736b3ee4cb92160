#include "visuals/landscape/worker.h"

#include <utility>

namespace octant::visuals::landscape {

void Worker::begin(std::function<void()> work) {
    wait();
    if (!thread_.joinable()) {
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
    {
        const std::scoped_lock lock(mutex_);
        work_ = std::move(work);
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
    while (changed_.wait(lock, stop, [this] { return static_cast<bool>(work_); })) {
        lock.unlock();
        std::exception_ptr fault;
        try {
            work_();
        } catch (...) {
            fault = std::current_exception();
        }
        lock.lock();
        fault_ = fault;
        work_ = nullptr;
        changed_.notify_all();
    }
}

} // namespace octant::visuals::landscape
