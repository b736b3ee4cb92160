#include "visuals/raster/workers.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace octant::visuals::raster {

/// Belongs to all that may still look at it: who comes late finds no task left.
struct Workers::Run {
    const std::function<void(int, int)>* work = nullptr; ///< not to be used when no task is left
    int tasks = 0;
    std::atomic<int> next{0};
    std::atomic<int> unfinished_tasks{0};
};

Workers::Workers(int threads) {
    for (int thread = 1; thread < threads; ++thread) {
        helpers_.emplace_back([this, thread] { help(thread); });
    }
}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    begun_.notify_all();
    for (std::thread& helper : helpers_) { helper.join(); }
}

void Workers::run(int tasks, const std::function<void(int task, int thread)>& work) {
    if (tasks <= 0) { return; }
    const auto run = std::make_shared<Run>();
    run->work = &work;
    run->tasks = tasks;
    run->unfinished_tasks = tasks;
    if (tasks > 1 && !helpers_.empty()) {
        {
            const std::lock_guard lock(mutex_);
            run_ = run;
        }
        begun_.notify_all();
    }
    take_tasks(*run, 0);
    for (int unfinished_tasks = run->unfinished_tasks; unfinished_tasks > 0; unfinished_tasks = run->unfinished_tasks) {
        run->unfinished_tasks.wait(unfinished_tasks);
    }
}

bool Workers::begin_on_idle_thread(std::function<void()> work) {
    if (helpers_.empty() || static_cast<unsigned>(threads()) < std::thread::hardware_concurrency()) { return false; }
    {
        const std::lock_guard lock(mutex_);
        idle_tasks_.push_back(std::move(work));
    }
    begun_.notify_all();
    return true;
}

void Workers::take_tasks(Run& run, int thread) {
    for (int task = run.next++; task < run.tasks; task = run.next++) {
        (*run.work)(task, thread);
        if (--run.unfinished_tasks == 0) { run.unfinished_tasks.notify_all(); }
    }
}

void Workers::help(int thread) {
    std::shared_ptr<Run> seen;
    std::unique_lock lock(mutex_);
    while (true) {
        begun_.wait(lock, [&] { return ends_ || !idle_tasks_.empty() || run_ != seen; });
        if (!idle_tasks_.empty()) {
            const std::function<void()> work = std::move(idle_tasks_.front());
            idle_tasks_.pop_front();
            lock.unlock();
            work();
            lock.lock();
            continue;
        }
        if (ends_) { return; }
        seen = run_;
        lock.unlock();
        take_tasks(*seen, thread);
        lock.lock();
    }
}

} // namespace octant::visuals::raster
