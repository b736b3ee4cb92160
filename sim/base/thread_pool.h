#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace octant {

/// The number of threads that this machine runs at once, at least 1.
inline int core_count() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

/// Threads that share the tasks of one loop after the other, and run single functions in between. They sleep while
/// there is nothing to do: threads that spin would take time from those that work.
class ThreadPool {
public:
    /// The thread that calls run() counts as one of `threads`.
    explicit ThreadPool(int threads);
    /// Ends the functions that were begun, then the threads.
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;
    ThreadPool(ThreadPool&&) = delete;
    ThreadPool& operator=(ThreadPool&&) = delete;

    int threads() const { return static_cast<int>(helpers_.size()) + 1; }

    /// Calls work(task, thread) once for each task 0 .. tasks - 1, each thread taking the next task that is left, and
    /// returns when all are done. Threads that wake up too late are not waited for. The first exception of `work` ends
    /// the loop and is thrown here.
    void run(int tasks, const std::function<void(int task, int thread)>& work);

    /// Runs a function on one of the pool's own threads, before what is left of loops. The pool must have such a
    /// thread; `work` must not throw.
    void begin(std::function<void()> work);

    /// begin(), but only if the pool has as many threads as the machine has cores: then another thread would only take
    /// time from them. Otherwise returns false and does nothing.
    bool begin_on_idle_thread(std::function<void()> work);

private:
    struct Loop;

    void help(int thread);
    static void take_tasks(Loop& loop, int thread);

    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable begun_;
    std::shared_ptr<Loop> loop_; ///< the last one that began
    std::deque<std::function<void()>> functions_;
    bool ends_ = false;
};

/// Calls `work(index, thread)` once for each index below `count`, in any order, on `threads` threads (this one among
/// them, number 0). The first exception ends the loop and is thrown here.
template <typename Work>
void parallel_for(std::size_t count, int threads, const Work& work) {
    ThreadPool pool(static_cast<int>(std::min(count, static_cast<std::size_t>(std::max(threads, 1)))));
    pool.run(static_cast<int>(count),
        [&](int index, int thread) { work(static_cast<std::size_t>(index), static_cast<std::size_t>(thread)); });
}

/// Calls `work(row)` once for each row below `rows`, in any order, on all cores. Rows must not read what others write,
/// so that the result is the same on any number of cores.
template <typename Work>
void parallel_for_rows(int rows, const Work& work) {
    parallel_for(static_cast<std::size_t>(rows), core_count(),
        [&](std::size_t row, std::size_t) { work(static_cast<int>(row)); });
}

/// Calls both functions, the second one on another thread if `on_two_threads`, and returns both results. Neither may
/// write to what the other one uses. If both throw, the exception of the first one is thrown.
template <typename First, typename Second>
auto run_both(bool on_two_threads, const First& first, const Second& second) {
    auto there = std::async(on_two_threads ? std::launch::async : std::launch::deferred, second);
    auto here = first();
    return std::pair(std::move(here), there.get());
}

/// Runs a function on an idle thread of a thread pool. Returns false without running it when no thread is idle. The
/// function must not throw.
using IdleThreadRunner = std::function<bool(std::function<void()> work)>;

/// Runs one function at a time on a thread of its own or of a thread pool, while the owner goes on.
class BackgroundTask {
public:
    BackgroundTask() = default;
    ~BackgroundTask(); ///< waits
    BackgroundTask(const BackgroundTask&) = delete;
    BackgroundTask& operator=(const BackgroundTask&) = delete;
    BackgroundTask(BackgroundTask&&) = delete;
    BackgroundTask& operator=(BackgroundTask&&) = delete;

    /// Waits for the previous function, then begins this one: on an idle thread of the pool, else on a thread of its
    /// own, which is created on first use.
    void begin(std::function<void()> work, const IdleThreadRunner& on_idle_thread = nullptr);

    bool is_running() const;

    /// Returns when no function is running. Rethrows what the function threw.
    void wait();

private:
    void run_work();

    mutable std::mutex mutex_;
    std::condition_variable ended_;
    std::function<void()> work_; ///< empty: nothing is running
    std::exception_ptr exception_;
    std::optional<ThreadPool> own_thread_;
};

} // namespace octant
