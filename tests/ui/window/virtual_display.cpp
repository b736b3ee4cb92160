#include "tests/ui/window/virtual_display.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace octant::tests {

struct VirtualDisplay::Connection {
    ::Display* display = nullptr;

    explicit Connection(const std::string& name) : display(XOpenDisplay(name.c_str())) {
        if (display == nullptr) { throw std::runtime_error("cannot connect to the display " + name); }
    }

    ~Connection() { XCloseDisplay(display); }

    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    Connection(Connection&&) = delete;
    Connection& operator=(Connection&&) = delete;

    KeyCode code_of(const std::string& key) const {
        const KeySym symbol = XStringToKeysym(key.c_str());
        if (symbol == NoSymbol) { throw std::invalid_argument("no such key: " + key); }
        return XKeysymToKeycode(display, symbol);
    }
};

namespace {

/// What the server says of itself on the pipe: its number and a line's end.
std::string number_from(int pipe) {
    std::string number;
    char byte = 0;
    while (read(pipe, &byte, 1) == 1 && byte != '\n') { number += byte; }
    return number;
}

} // namespace

std::unique_ptr<VirtualDisplay> VirtualDisplay::start() {
    int pipe_ends[2];
    if (pipe(pipe_ends) != 0) { throw std::runtime_error("no pipe"); }
    const pid_t process = fork();
    if (process == 0) {
        close(pipe_ends[0]);
        const int nowhere = open("/dev/null", O_WRONLY);
        dup2(nowhere, STDERR_FILENO);
        const std::string told_on = std::to_string(pipe_ends[1]);
        execlp("Xvfb", "Xvfb", "-displayfd", told_on.c_str(), "-screen", "0", "2000x1200x24", "-nolisten", "tcp",
            "-noreset", // a signal that comes while it begins anew would be lost
            nullptr);
        _exit(127);
    }
    close(pipe_ends[1]);
    const std::string number = number_from(pipe_ends[0]);
    close(pipe_ends[0]);
    if (number.empty()) {
        waitpid(process, nullptr, 0);
        return nullptr;
    }
    const std::string name = ":" + number;
    setenv("DISPLAY", name.c_str(), 1);
    return std::unique_ptr<VirtualDisplay>(new VirtualDisplay(process, std::make_unique<Connection>(name)));
}

VirtualDisplay::VirtualDisplay(int process, std::unique_ptr<Connection> connection)
    : process_(process), connection_(std::move(connection)) {}

VirtualDisplay::~VirtualDisplay() {
    connection_.reset();
    kill(process_, SIGTERM);
    for (int tenth = 0; tenth < 50; ++tenth) {
        if (waitpid(process_, nullptr, WNOHANG) != 0) { return; }
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

void VirtualDisplay::focus() {
    Window root = 0;
    Window parent = 0;
    Window* children = nullptr;
    unsigned count = 0;
    XQueryTree(connection_->display, DefaultRootWindow(connection_->display), &root, &parent, &children, &count);
    for (unsigned i = 0; i < count; ++i) {
        XWindowAttributes attributes;
        XGetWindowAttributes(connection_->display, children[i], &attributes);
        if (attributes.map_state == IsViewable) {
            XSetInputFocus(connection_->display, children[i], RevertToPointerRoot, CurrentTime);
        }
    }
    XFree(children);
    XSync(connection_->display, False);
}

void VirtualDisplay::press(const std::string& key) {
    XTestFakeKeyEvent(connection_->display, connection_->code_of(key), True, 0);
    XSync(connection_->display, False);
}

void VirtualDisplay::release(const std::string& key) {
    XTestFakeKeyEvent(connection_->display, connection_->code_of(key), False, 0);
    XSync(connection_->display, False);
}

void VirtualDisplay::move_pointer(const glm::ivec2& to) {
    XTestFakeMotionEvent(connection_->display, 0, to.x, to.y, 0);
    XSync(connection_->display, False);
}

void VirtualDisplay::press_button(int button) {
    XTestFakeButtonEvent(connection_->display, static_cast<unsigned>(button), True, 0);
    XSync(connection_->display, False);
}

void VirtualDisplay::release_button(int button) {
    XTestFakeButtonEvent(connection_->display, static_cast<unsigned>(button), False, 0);
    XSync(connection_->display, False);
}

ui::report::Picture VirtualDisplay::picture(const glm::ivec2& at, const glm::ivec2& size) const {
    XImage* const image = XGetImage(connection_->display, DefaultRootWindow(connection_->display), at.x, at.y,
        static_cast<unsigned>(size.x), static_cast<unsigned>(size.y), AllPlanes, ZPixmap);
    if (image == nullptr) { throw std::runtime_error("no picture of the display"); }
    ui::report::Picture picture{size.x, size.y, 3, {}};
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const unsigned long rgb = XGetPixel(image, x, y);
            for (const unsigned shift : {16U, 8U, 0U}) {
                picture.bytes.push_back(static_cast<std::byte>(rgb >> shift & 0xFFU));
            }
        }
    }
    XDestroyImage(image);
    return picture;
}

void VirtualDisplay::turn_wheel() {
    constexpr int away = 4;
    press_button(away);
    release_button(away);
}

} // namespace octant::tests
