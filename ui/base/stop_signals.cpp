#include "ui/base/stop_signals.h"

#include <array>
#include <csignal>
#include <unistd.h>

namespace octant::ui::base {

namespace {

struct HandledSignal {
    int number;
    const char* name;
};

constexpr std::array handled_signals{
    HandledSignal{SIGINT, "SIGINT"}, HandledSignal{SIGTERM, "SIGTERM"}, HandledSignal{SIGHUP, "SIGHUP"}};

volatile std::sig_atomic_t received_signal = 0;
volatile std::sig_atomic_t received_continues = 0;

void count_continue(int /*number*/) { received_continues = received_continues + 1; }

void store_signal(int number) {
    if (received_signal != 0) {
        std::signal(number, SIG_DFL);
        ::raise(number); // acts when this handler returns
        return;
    }
    received_signal = number;
}

void set_handler(int number, void (*handler)(int)) {
    struct sigaction current_action {};

    if (sigaction(number, nullptr, &current_action) != 0 || current_action.sa_handler == SIG_IGN) { return; }

    struct sigaction chosen_action {};

    chosen_action.sa_handler = handler;
    chosen_action.sa_flags = SA_RESTART;
    sigemptyset(&chosen_action.sa_mask);
    sigaction(number, &chosen_action, nullptr);
}

} // namespace

StopSignals::StopSignals() {
    for (const HandledSignal& stop : handled_signals) { set_handler(stop.number, store_signal); }
    set_handler(SIGCONT, count_continue);
}

StopSignals::~StopSignals() {
    for (const HandledSignal& stop : handled_signals) { set_handler(stop.number, SIG_DFL); }
    set_handler(SIGCONT, SIG_DFL);
}

bool StopSignals::received() { return received_signal != 0; }

int StopSignals::pauses() { return received_continues; }

std::string StopSignals::name() {
    for (const HandledSignal& stop : handled_signals) {
        if (stop.number == received_signal) { return stop.name; }
    }
    return {};
}

void exit_by_received_signal() {
    if (received_signal != 0) {
        std::signal(received_signal, SIG_DFL);
        ::raise(received_signal);
    }
}

} // namespace octant::ui::base
