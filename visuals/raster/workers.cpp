#include "visuals/raster/workers.h"

#include <algorithm>

namespace octant::visuals::raster {

Workers::Workers(int threads) {
    for (int thread = 1; thread < std::max(threads, 1); ++thread) {
        helpers_.emplace_back([this, thread] { help(thread); });
    }
}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    begun_.notify_all();
    for (std::thread& helper : helpers_) {
        helper.join();
    }
}

void Workers::run(int tasks, const std::function<void(int task, int thread)>& work) {
    if (tasks <= 0) {
        return;
    }
    const bool alone = helpers_.empty() || tasks == 1;
    {
        const std::lock_guard lock(mutex_);
        work_ = &work;
        tasks_ = tasks;
        next_ = 0;
        if (!alone) {
            busy_ = static_cast<int>(helpers_.size());
            ++run_;
        }
    }
    if (!alone) {
        begun_.notify_all();
    }
    take_tasks(0);
    if (!alone) {
        std::unique_lock lock(mutex_);
        done_.wait(lock, [&] { return busy_ == 0; });
    }
}

void Workers::take_tasks(int thread) {
    for (int task = next_++; task < tasks_; task = next_++) {
        (*work_)(task, thread);
    }
}

void Workers::help(int thread) {
    unsigned seen = 0;
    std::unique_lock lock(mutex_);
    while (true) {
        begun_.wait(lock, [&] { return ends_ || run_ != seen; });
        if (ends_) {
            return;
        }
        seen = run_;
        lock.unlock();
        take_tasks(thread);
        lock.lock();
        if (--busy_ == 0) {
            done_.notify_one();
        }
    }
}

} // namespace octant::visuals::raster
