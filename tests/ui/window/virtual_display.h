#pragma once

#include "ui/report/png_file.h"

#include <glm/vec2.hpp>

#include <memory>
#include <string>

namespace octant::tests {

/// A display of its own in memory, with a keyboard and a pointer that are worked as a person's are: through the
/// display's server. Ends with the object.
class VirtualDisplay {
public:
    /// Starts it, 2000 x 1200 pixels, and makes it the process's display. Nothing where the server's program (Xvfb) is
    /// not installed.
    static std::unique_ptr<VirtualDisplay> start();

    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;
    VirtualDisplay(VirtualDisplay&&) = delete;
    VirtualDisplay& operator=(VirtualDisplay&&) = delete;

    /// Gives the keyboard to the one window on the display.
    void focus();

    /// A key by its X name: "space", "1", "F9", "Down".
    void press(const std::string& key);
    void release(const std::string& key);

    void strike(const std::string& key) {
        press(key);
        release(key);
    }

    /// Place on the display, pixels from the upper left corner.
    void move_pointer(const glm::ivec2& to);
    void press_button(int button);
    void release_button(int button);

    /// What a person sees of the part that begins at `at`.
    ui::report::Picture picture(const glm::ivec2& at, const glm::ivec2& size) const;

    /// One click of the wheel, away from the person.
    void turn_wheel();

private:
    struct Connection;
    VirtualDisplay(int process, std::unique_ptr<Connection> connection);
    int process_;
    std::unique_ptr<Connection> connection_;
};

} // namespace octant::tests
