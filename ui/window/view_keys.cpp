#include "ui/window/view_keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

namespace octant::ui::window {

namespace {

constexpr std::array keys{
    ViewKey{GLFW_KEY_1, ViewCommand::Cockpit, "1", "cockpit view, with head-up display"},
    ViewKey{GLFW_KEY_2, ViewCommand::Chase, "2", "chase view"},
    ViewKey{GLFW_KEY_3, ViewCommand::Tower, "3", "tower view"},
    ViewKey{GLFW_KEY_4, ViewCommand::Orbit, "4", "orbit view"},
    ViewKey{GLFW_KEY_5, ViewCommand::Free, "5", "free camera"},
    ViewKey{GLFW_KEY_I, ViewCommand::NextInset, "I", "second view in a corner: next one, or none"},
    ViewKey{GLFW_KEY_V, ViewCommand::ResetLook, "V", "look straight again"},
    ViewKey{GLFW_KEY_SPACE, ViewCommand::PlayOrPause, "Space", "play or pause"},
    ViewKey{GLFW_KEY_PERIOD, ViewCommand::StepFrame, ".", "one frame on", true},
    ViewKey{GLFW_KEY_LEFT_BRACKET, ViewCommand::Slower, "[", "half as fast", true},
    ViewKey{GLFW_KEY_RIGHT_BRACKET, ViewCommand::Faster, "]", "twice as fast", true},
    ViewKey{GLFW_KEY_L, ViewCommand::Loop, "L", "begin again at the path's end, or stop there"},
    ViewKey{GLFW_KEY_HOME, ViewCommand::ToBeginning, "Home", "back to the beginning"},
    ViewKey{GLFW_KEY_COMMA, ViewCommand::Back, ",", "two seconds back", true},
    ViewKey{GLFW_KEY_SLASH, ViewCommand::Forward, "/", "two seconds on", true},
    ViewKey{GLFW_KEY_H, ViewCommand::ByHand, "H", "fly by hand from here, or back to the path"},
    ViewKey{GLFW_KEY_T, ViewCommand::LevelOff, "T", "by hand: level and in trim from here"},
    ViewKey{GLFW_KEY_F9, ViewCommand::Record, "F9", "start or stop a recording"},
    ViewKey{GLFW_KEY_F12, ViewCommand::Screenshot, "F12", "the picture as PNG, without panels"},
    ViewKey{GLFW_KEY_M, ViewCommand::ShowMesh, "M", "the ground's mesh: edges, levels, or none"},
    ViewKey{GLFW_KEY_F11, ViewCommand::FullScreen, "F11", "full screen, or back"},
    ViewKey{GLFW_KEY_TAB, ViewCommand::Panels, "Tab", "hide or show all panels"},
    ViewKey{GLFW_KEY_F2, ViewCommand::FlightPanel, "F2", "panel: path, time, recording"},
    ViewKey{GLFW_KEY_F3, ViewCommand::TimingPanel, "F3", "panel: frame times"},
    ViewKey{GLFW_KEY_F4, ViewCommand::TerrainPanel, "F4", "panel: terrain"},
    ViewKey{GLFW_KEY_F5, ViewCommand::DrawOrderPanel, "F5", "panel: draw order"},
    ViewKey{GLFW_KEY_F6, ViewCommand::AircraftPanel, "F6", "panel: aircraft"},
    ViewKey{GLFW_KEY_F7, ViewCommand::ScenePanel, "F7", "panel: scene, light, haze"},
    ViewKey{GLFW_KEY_F8, ViewCommand::SettingsPanel, "F8", "panel: every setting, save and load"},
    ViewKey{GLFW_KEY_F1, ViewCommand::Help, "F1", "this help"},
    ViewKey{GLFW_KEY_ESCAPE, ViewCommand::Leave, "Esc", "close the help, or leave"}};

constexpr std::array held{
    HeldKey{"drag", "turn the look, or around the aircraft"},
    HeldKey{"wheel", "zoom"},
    HeldKey{"arrows", "by hand: stick (down pulls)"},
    HeldKey{"Page Up, Page Down", "by hand: throttle, collective"},
    HeldKey{"Z, X", "by hand: rudder, pedals"},
    HeldKey{"right button", "by hand: the pointer is the stick, from the window's middle"},
    HeldKey{"gamepad", "by hand: left stick; triggers throttle; bumpers or right stick rudder"},
    HeldKey{"joystick", "by hand: stick, twist, lever"},
    HeldKey{"W A S D, Q E", "free camera: move, down and up; Shift is faster"}};

} // namespace

std::span<const ViewKey> view_keys() {
    return keys;
}

std::span<const HeldKey> held_keys() {
    return held;
}

} // namespace octant::ui::window
