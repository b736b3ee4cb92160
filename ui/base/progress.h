#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace octant::ui::base {

/// Steps a second as progress tells them: "250", "3.4", "0.062".
std::string rate_text(double per_s);

/// Progress of long work on stderr: one line redrawn in place when stderr is a terminal, else a plain line every few
/// seconds; nothing when quiet.
class Progress {
public:
    /// `steps`: what is counted.
    Progress(std::string what, int total, bool quiet, std::string steps = "frames");

    ~Progress() { finish(); }

    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    Progress(Progress&&) = delete;
    Progress& operator=(Progress&&) = delete;

    /// `done` of the total are finished; `note` is shown behind the numbers.
    void show(int done, const std::string& note = "");

    /// One more is finished. May be called from any thread.
    void tick(const std::string& note = "");

    /// Ends the line that show() has written over again and again.
    void finish();

private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    std::string steps_;
    int total_;
    bool quiet_;
    bool terminal_;
    bool drawn_ = false;
    int ticks_ = 0;
    std::mutex ticking_;
    Clock::time_point start_;
    Clock::time_point last_shown_;
};

/// One line on stderr, unless quiet, with_path_aliases().
void print_note(bool quiet, const std::string& line);

} // namespace octant::ui::base
