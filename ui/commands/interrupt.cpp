#include "ui/commands/interrupt.h"

#include <csignal>

namespace octant::ui::commands {

namespace {

volatile std::sig_atomic_t noted = 0;

void note(int number) {
    noted = 1;
    std::signal(number, SIG_DFL);
}

} // namespace

Interrupt::Interrupt() {
    noted = 0;
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
}

Interrupt::~Interrupt() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool Interrupt::came() const {
    return noted != 0;
}

} // namespace octant::ui::commands
