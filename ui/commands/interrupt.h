#pragma once

namespace octant::ui::commands {

/// While it lives, Ctrl-C and a request to terminate are noted in place of ending the program; the
/// second one ends it. One at a time.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;
    Interrupt(Interrupt&&) = delete;
    Interrupt& operator=(Interrupt&&) = delete;

    bool came() const;
};

} // namespace octant::ui::commands
