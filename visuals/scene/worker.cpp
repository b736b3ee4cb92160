#include "visuals/scene/worker.h"

#include <utility>

namespace octant::visuals::scene {

Worker::~Worker() {
    wait();
}

void Worker::begin(std::function<void()> work) {
    wait();
    {
        const std::scoped_lock lock(mutex_);
        work_ = std::move(work);
    }
    changed_.notify_all();
    if (!thread_.joinable()) {
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
}

void Worker::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !work_; });
}

void Worker::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return static_cast<bool>(work_); })) {
        lock.unlock();
        work_();
        lock.lock();
        work_ = nullptr;
        changed_.notify_all();
    }
}

} // namespace octant::visuals::scene
