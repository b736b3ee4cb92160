#include "sim/base/thread_pool.h"

#include <atomic>

namespace octant {

/// Shared by all threads that may still look at it: a thread that comes late finds no task left.
struct ThreadPool::Loop {
    const std::function<void(int, int)>* work = nullptr; ///< not to be used when no task is left
    int tasks = 0;
    std::atomic<int> next{0};
    std::atomic<int> unfinished_tasks{0};
    std::atomic<bool> has_failed = false;
    std::exception_ptr exception; ///< of the task that set has_failed
};

ThreadPool::ThreadPool(int threads) {
    for (int thread = 1; thread < threads; ++thread) {
        helpers_.emplace_back([this, thread] { help(thread); });
    }
}

ThreadPool::~ThreadPool() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    begun_.notify_all();
    for (std::thread& helper : helpers_) { helper.join(); }
}

void ThreadPool::run(int tasks, const std::function<void(int task, int thread)>& work) {
    if (tasks <= 0) { return; }
    const auto loop = std::make_shared<Loop>();
    loop->work = &work;
    loop->tasks = tasks;
    loop->unfinished_tasks = tasks;
    if (tasks > 1 && !helpers_.empty()) {
        {
            const std::lock_guard lock(mutex_);
            loop_ = loop;
        }
        begun_.notify_all();
    }
    take_tasks(*loop, 0);
    for (int unfinished = loop->unfinished_tasks; unfinished > 0; unfinished = loop->unfinished_tasks) {
        loop->unfinished_tasks.wait(unfinished);
    }
    if (loop->exception) { std::rethrow_exception(loop->exception); }
}

void ThreadPool::take_tasks(Loop& loop, int thread) {
    for (int task = loop.next++; task < loop.tasks; task = loop.next++) {
        try {
            if (!loop.has_failed) { (*loop.work)(task, thread); }
        } catch (...) {
            if (!loop.has_failed.exchange(true)) { loop.exception = std::current_exception(); }
        }
        if (--loop.unfinished_tasks == 0) { loop.unfinished_tasks.notify_all(); }
    }
}

void ThreadPool::begin(std::function<void()> work) {
    {
        const std::lock_guard lock(mutex_);
        functions_.push_back(std::move(work));
    }
    begun_.notify_all();
}

bool ThreadPool::begin_on_idle_thread(std::function<void()> work) {
    if (helpers_.empty() || threads() < core_count()) { return false; }
    begin(std::move(work));
    return true;
}

void ThreadPool::help(int thread) {
    std::shared_ptr<Loop> seen;
    std::unique_lock lock(mutex_);
    while (true) {
        begun_.wait(lock, [&] { return ends_ || !functions_.empty() || loop_ != seen; });
        if (!functions_.empty()) {
            const std::function<void()> work = std::move(functions_.front());
            functions_.pop_front();
            lock.unlock();
            work();
            lock.lock();
            continue;
        }
        if (ends_) { return; }
        seen = loop_;
        lock.unlock();
        take_tasks(*seen, thread);
        lock.lock();
    }
}

BackgroundTask::~BackgroundTask() {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return !work_; });
}

void BackgroundTask::begin(std::function<void()> work, const IdleThreadRunner& on_idle_thread) {
    wait();
    {
        const std::scoped_lock lock(mutex_);
        work_ = std::move(work);
    }
    if (on_idle_thread && on_idle_thread([this] { run_work(); })) { return; }
    if (!own_thread_) { own_thread_.emplace(2); }
    own_thread_->begin([this] { run_work(); });
}

bool BackgroundTask::is_running() const {
    const std::scoped_lock lock(mutex_);
    return static_cast<bool>(work_);
}

void BackgroundTask::wait() {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return !work_; });
    if (exception_) { std::rethrow_exception(std::exchange(exception_, nullptr)); }
}

void BackgroundTask::run_work() {
    std::exception_ptr exception;
    try {
        work_();
    } catch (...) { exception = std::current_exception(); }
    // Notified under the lock: the owner may destroy this object next.
    const std::scoped_lock lock(mutex_);
    exception_ = std::move(exception); // the last reference, so that the waiting thread alone destroys it
    work_ = nullptr;
    ended_.notify_all();
}

} // namespace octant
