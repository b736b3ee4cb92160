#include "ui/base/stop_signals.h"

#include <array>
#include <csignal>
#include <unistd.h>

namespace octant::ui::base {

namespace {

struct Stop {
    int number;
    const char* name;
};

constexpr std::array stops{
    Stop{SIGINT, "SIGINT"}, Stop{SIGTERM, "SIGTERM"}, Stop{SIGHUP, "SIGHUP"}};

volatile std::sig_atomic_t signal_that_came = 0;

void remember(int number) {
    if (signal_that_came != 0) {
        std::signal(number, SIG_DFL);
        ::raise(number); // acts when this handler returns
        return;
    }
    signal_that_came = number;
}

void handle(int number, void (*handler)(int)) {
    struct sigaction now {};

    if (sigaction(number, nullptr, &now) != 0 || now.sa_handler == SIG_IGN) {
        return;
    }

    struct sigaction action {};

    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
}

} // namespace

StopSignals::StopSignals() {
    for (const Stop& stop : stops) {
        handle(stop.number, remember);
    }
}

StopSignals::~StopSignals() {
    for (const Stop& stop : stops) {
        handle(stop.number, SIG_DFL);
    }
}

bool StopSignals::came() {
    return signal_that_came != 0;
}

std::string StopSignals::name() {
    for (const Stop& stop : stops) {
        if (stop.number == signal_that_came) {
            return stop.name;
        }
    }
    return {};
}

void end_by_signal_that_came() {
    if (signal_that_came != 0) {
        std::signal(signal_that_came, SIG_DFL);
        ::raise(signal_that_came);
    }
}

} // namespace octant::ui::base
