#include "visuals/gl/shared_picture.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XShm.h>
#include <bit>
#include <cstddef>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <utility>

// GLFW's own header of them asks for more of X than is needed here. A GLFW that was built for Wayland alone has none.
extern "C" {
[[gnu::weak]] Display* glfwGetX11Display();
[[gnu::weak]] ::Window glfwGetX11Window(GLFWwindow* window);
}

namespace octant::visuals::gl {
namespace {

constexpr int bits_of_pixel = 32;
constexpr int bits_of_colour = 24;

/// Hears of faults of the requests made while it lives; without it Xlib ends the program.
class FaultListener {
public:
    explicit FaultListener(Display* display) : display_(display) {
        XSync(display_, False);
        heard_ = false;
        before_ = XSetErrorHandler([](Display*, XErrorEvent*) {
            heard_ = true;
            return 0;
        });
    }

    ~FaultListener() { XSetErrorHandler(before_); }

    FaultListener(const FaultListener&) = delete;
    FaultListener& operator=(const FaultListener&) = delete;
    FaultListener(FaultListener&&) = delete;
    FaultListener& operator=(FaultListener&&) = delete;

    bool heard() const {
        XSync(display_, False);
        return heard_;
    }

private:
    static inline bool heard_ = false;
    Display* display_;
    XErrorHandler before_ = nullptr;
};

class XSharedPicture final : public SharedPicture {
public:
    XSharedPicture(Display* display, ::Window window)
        : display_(display), window_(window), context_(XCreateGC(display, window, 0, nullptr)) {}

    ~XSharedPicture() override {
        if (image_ != nullptr) {
            image_->data = nullptr;
            XDestroyImage(image_);
        }
        if (is_attached_) { XShmDetach(display_, &segment_); }
        if (segment_.shmaddr != nullptr) { shmdt(segment_.shmaddr); }
        XFreeGC(display_, context_);
        XSync(display_, False);
    }

    XSharedPicture(const XSharedPicture&) = delete;
    XSharedPicture& operator=(const XSharedPicture&) = delete;
    XSharedPicture(XSharedPicture&&) = delete;
    XSharedPicture& operator=(XSharedPicture&&) = delete;

    /// Whether there is memory for a picture now.
    bool make_room(const glm::ivec2& size_px) {
        XWindowAttributes seen;
        if (XGetWindowAttributes(display_, window_, &seen) == 0 || seen.depth != bits_of_colour ||
            seen.visual->blue_mask != 0xffU || seen.visual->green_mask != 0xff00U ||
            seen.visual->red_mask != 0xff0000U) {
            return false;
        }
        image_ = XShmCreateImage(display_, seen.visual, static_cast<unsigned>(seen.depth), ZPixmap, nullptr, &segment_,
            static_cast<unsigned>(size_px.x), static_cast<unsigned>(size_px.y));
        if (image_ == nullptr || image_->bits_per_pixel != bits_of_pixel || image_->bytes_per_line != size_px.x * 4 ||
            image_->byte_order != LSBFirst) {
            return false;
        }
        const auto bytes = static_cast<std::size_t>(image_->bytes_per_line) * static_cast<std::size_t>(size_px.y);
        const int id = shmget(IPC_PRIVATE, bytes, IPC_CREAT | 0600);
        if (id < 0) { return false; }
        attach(id);
        shmctl(id, IPC_RMID, nullptr); // goes with the last who has attached it
        return is_attached_;
    }

    std::uint8_t* pixels() override { return reinterpret_cast<std::uint8_t*>(segment_.shmaddr); }

    void put() override {
        XShmPutImage(display_, window_, context_, image_, 0, 0, 0, 0, static_cast<unsigned>(image_->width),
            static_cast<unsigned>(image_->height), False);
        XFlush(display_);
    }

    void wait() override { XSync(display_, False); }

private:
    void attach(int id) {
        void* const at = shmat(id, nullptr, 0);
        if (at == std::bit_cast<void*>(std::intptr_t{-1})) { return; }
        segment_.shmid = id;
        segment_.shmaddr = static_cast<char*>(at);
        segment_.readOnly = True;
        image_->data = segment_.shmaddr;
        const FaultListener faults(display_);
        is_attached_ = XShmAttach(display_, &segment_) != 0 && !faults.heard();
    }

    Display* display_;
    ::Window window_;
    GC context_;
    XImage* image_ = nullptr;
    XShmSegmentInfo segment_{};
    bool is_attached_ = false;
};

} // namespace

std::unique_ptr<SharedPicture> make_shared_picture(GLFWwindow* window, const glm::ivec2& size_px) {
    if (std::endian::native != std::endian::little || glfwGetX11Display == nullptr) { return nullptr; }
    Display* const display = glfwGetX11Display();
    if (display == nullptr || XShmQueryExtension(display) == 0) { return nullptr; }
    auto picture = std::make_unique<XSharedPicture>(display, glfwGetX11Window(window));
    return picture->make_room(size_px) ? std::move(picture) : nullptr;
}

} // namespace octant::visuals::gl
