#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace octant::visuals::raster {

/// Threads that share the tasks of one loop after the other. They sleep in between: waiting threads that spin would
/// take time from those that plan the next frame.
class Workers {
public:
    /// The thread that calls run() counts as one.
    explicit Workers(int threads);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    Workers(Workers&&) = delete;
    Workers& operator=(Workers&&) = delete;

    int threads() const { return static_cast<int>(helpers_.size()) + 1; }

    /// Calls work(task, thread) once for each task 0 .. tasks - 1, each thread taking the next one that is left, and
    /// returns when all are done. Threads that wake up too late are not waited for. `work` must not throw.
    void run(int tasks, const std::function<void(int task, int thread)>& work);

    /// Does other work on one of the threads, before what is left of loops: more threads than cores would push each
    /// other aside, and a loop waits for the last of its tasks. False, and nothing is done, where the caller is alone
    /// or cores are left over. `work` must not throw.
    bool begin_on_idle_thread(std::function<void()> work);

private:
    struct Run;

    void help(int thread);
    static void take_tasks(Run& run, int thread);

    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable begun_;
    std::shared_ptr<Run> run_; ///< the last that began
    std::deque<std::function<void()>> idle_tasks_;
    bool ends_ = false;
};

} // namespace octant::visuals::raster
