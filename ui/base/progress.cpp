#include "ui/base/progress.h"

#include "sim/base/text_file.h"
#include "ui/base/data_files.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

namespace octant::ui::base {

std::string rate_text(double per_s) {
    constexpr double min_rate_in_whole_numbers = 10.0;
    return per_s >= min_rate_in_whole_numbers ? fmt::format("{:.0f}", per_s) : fmt::format("{:.2g}", per_s);
}

Progress::Progress(std::string what, int total, bool quiet, std::string steps)
    : what_(std::move(what)), steps_(std::move(steps)), total_(total), quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), last_shown_(start_) {}

void Progress::show(int done, const std::string& note) {
    const auto now = Clock::now();
    const double since_last_s = std::chrono::duration<double>(now - last_shown_).count();
    if (quiet_ || since_last_s < (terminal_ ? 0.1 : 5.0)) { return; }
    last_shown_ = now;
    drawn_ = true;
    const double elapsed_s = std::chrono::duration<double>(now - start_).count();
    const double per_s = done / elapsed_s;
    const double left_s = done > 0 ? (total_ - done) / per_s : 0.0;
    const std::string line = fmt::format("{}: {} of {}, {} {}/s, {:.0f} s left{}{}", one_line(what_), done, total_,
        rate_text(per_s), steps_, left_s, note.empty() ? "" : ", ", note);
    std::fputs(terminal_ ? fmt::format("\r\x1b[K{}", line).c_str() : fmt::format("{}\n", line).c_str(), stderr);
    std::fflush(stderr);
}

void Progress::tick(const std::string& note) {
    const std::scoped_lock lock(ticking_);
    show(++ticks_, note);
}

void Progress::finish() {
    if (terminal_ && drawn_) {
        std::fputs("\r\x1b[K", stderr);
        std::fflush(stderr);
        drawn_ = false;
    }
}

void print_note(bool quiet, const std::string& line) {
    if (!quiet) { std::fputs(fmt::format("{}\n", one_line(with_path_aliases(line))).c_str(), stderr); }
}

} // namespace octant::ui::base
