#include "ui/window/view_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

namespace octant::ui::window {

namespace {

constexpr std::array keys{ViewKey{ViewCommand::Cockpit, GLFW_KEY_1, "cockpit", "cockpit view, with head-up display"},
    ViewKey{ViewCommand::Chase, GLFW_KEY_2, "chase", "chase view"},
    ViewKey{ViewCommand::Tower, GLFW_KEY_3, "tower", "tower view"},
    ViewKey{ViewCommand::Orbit, GLFW_KEY_4, "orbit", "orbit view"},
    ViewKey{ViewCommand::Free, GLFW_KEY_5, "free", "free camera"},
    ViewKey{ViewCommand::NextInset, GLFW_KEY_I, "second view", "second view in a corner: next one, or none"},
    ViewKey{ViewCommand::ResetLook, GLFW_KEY_V, "look straight", "look straight again"},
    ViewKey{ViewCommand::PlayOrPause, GLFW_KEY_SPACE, "play", "play or pause"},
    ViewKey{ViewCommand::StepFrame, GLFW_KEY_PERIOD, "one frame", "one frame on", true},
    ViewKey{ViewCommand::Slower, GLFW_KEY_LEFT_BRACKET, "slower", "half as fast", true},
    ViewKey{ViewCommand::Faster, GLFW_KEY_RIGHT_BRACKET, "faster", "twice as fast", true},
    ViewKey{ViewCommand::Loop, GLFW_KEY_L, "loop", "begin again at the path's end, or stop there"},
    ViewKey{ViewCommand::ToBeginning, GLFW_KEY_HOME, "beginning", "back to the beginning"},
    ViewKey{ViewCommand::Back, GLFW_KEY_COMMA, "back", "two seconds back", true},
    ViewKey{ViewCommand::Forward, GLFW_KEY_SLASH, "forward", "two seconds on", true},
    ViewKey{ViewCommand::ManualFlight, GLFW_KEY_H, "by hand", "fly by hand from here, or back to the path"},
    ViewKey{ViewCommand::LevelOff, GLFW_KEY_T, "level off", "by hand: fly it level, until it is or the stick is moved"},
    ViewKey{ViewCommand::Record, GLFW_KEY_F9, "record", "start or stop a recording"},
    ViewKey{ViewCommand::Screenshot, GLFW_KEY_F12, "screenshot", "the picture as PNG, without panels"},
    ViewKey{ViewCommand::ShowMesh, GLFW_KEY_M, "mesh", "the ground's mesh: edges, levels, or none"},
    ViewKey{ViewCommand::FullScreen, GLFW_KEY_F11, "full screen", "full screen, or back"},
    ViewKey{ViewCommand::Panels, GLFW_KEY_TAB, "panels", "hide or show all panels"},
    ViewKey{ViewCommand::FlightPanel, GLFW_KEY_F2, "flight panel", "panel: path, time, recording"},
    ViewKey{ViewCommand::TimingPanel, GLFW_KEY_F3, "timing panel", "panel: frame times"},
    ViewKey{ViewCommand::TerrainPanel, GLFW_KEY_F4, "terrain panel", "panel: terrain"},
    ViewKey{ViewCommand::DrawOrderPanel, GLFW_KEY_F5, "draw order panel", "panel: draw order"},
    ViewKey{ViewCommand::AircraftPanel, GLFW_KEY_F6, "aircraft panel", "panel: aircraft"},
    ViewKey{ViewCommand::ScenePanel, GLFW_KEY_F7, "scene panel", "panel: scene, light, haze"},
    ViewKey{ViewCommand::SettingsPanel, GLFW_KEY_F8, "settings panel", "panel: every setting, save and load"},
    ViewKey{ViewCommand::Help, GLFW_KEY_F1, "keys panel", "this help"},
    ViewKey{ViewCommand::Leave, GLFW_KEY_ESCAPE, "leave", "close the help, or leave"}};

constexpr std::array while_held{HeldKey{HeldAction::Pull, GLFW_KEY_DOWN, "stick back", ""},
    HeldKey{HeldAction::Push, GLFW_KEY_UP, "stick forward", ""},
    HeldKey{HeldAction::RollLeft, GLFW_KEY_LEFT, "stick left", ""},
    HeldKey{HeldAction::RollRight, GLFW_KEY_RIGHT, "stick right", "by hand: stick back, forward, left, right"},
    HeldKey{HeldAction::ThrottleUp, GLFW_KEY_PAGE_UP, "throttle up", ""},
    HeldKey{HeldAction::ThrottleDown, GLFW_KEY_PAGE_DOWN, "throttle down", "by hand: throttle, collective"},
    HeldKey{HeldAction::YawLeft, GLFW_KEY_Z, "rudder left", ""},
    HeldKey{HeldAction::YawRight, GLFW_KEY_X, "rudder right", "by hand: rudder, pedals"},
    HeldKey{HeldAction::CameraAhead, GLFW_KEY_W, "camera ahead", ""},
    HeldKey{HeldAction::CameraBack, GLFW_KEY_S, "camera back", ""},
    HeldKey{HeldAction::CameraLeft, GLFW_KEY_A, "camera left", ""},
    HeldKey{HeldAction::CameraRight, GLFW_KEY_D, "camera right", ""},
    HeldKey{HeldAction::CameraDown, GLFW_KEY_Q, "camera down", ""},
    HeldKey{HeldAction::CameraUp, GLFW_KEY_E, "camera up", ""},
    HeldKey{HeldAction::CameraFast, GLFW_KEY_LEFT_SHIFT, "camera fast",
        "free camera: ahead, back, left, right, down, up; faster"}};

} // namespace

std::span<const ViewKey> view_keys() { return keys; }

std::span<const HeldKey> held_keys() { return while_held; }

} // namespace octant::ui::window
