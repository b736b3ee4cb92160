#pragma once

#include <span>
#include <string_view>

namespace octant::ui::window {

/// The commands that keys give to the window.
enum class ViewCommand {
    Cockpit,
    Chase,
    Tower,
    Orbit,
    Free,
    NextInset,
    ResetLook,
    PlayOrPause,
    StepFrame,
    Slower,
    Faster,
    Loop,
    ToBeginning,
    Back,
    Forward,
    ManualFlight,
    LevelOff,
    Record,
    Screenshot,
    ShowMesh,
    FullScreen,
    Panels,
    FlightPanel,
    TimingPanel,
    TerrainPanel,
    DrawOrderPanel,
    AircraftPanel,
    ScenePanel,
    SettingsPanel,
    Help,
    Leave
};

/// A command, the key that gives it unless a person chose another, and its line in the help.
struct ViewKey {
    ViewCommand command = ViewCommand::Leave;
    /// One of GLFW_KEY_...
    int key = 0;
    /// The command in the file of keys.
    std::string_view id;
    std::string_view meaning;
    /// The command is given again and again while the key is held.
    bool repeats = false;
};

/// Returns all commands, in the order of the help.
std::span<const ViewKey> view_keys();

/// What keys do as long as they are held.
enum class HeldAction {
    Pull,
    Push,
    RollLeft,
    RollRight,
    ThrottleUp,
    ThrottleDown,
    YawLeft,
    YawRight,
    CameraAhead,
    CameraBack,
    CameraLeft,
    CameraRight,
    CameraDown,
    CameraUp,
    CameraFast
};

/// An action and the key that does it unless a person chose another.
struct HeldKey {
    HeldAction chosen_action = HeldAction::Pull;
    int key = 0;
    std::string_view id;
    /// What this key and those before it without one do; empty where the next line tells it.
    std::string_view meaning;
};

/// Returns all actions, in the order of the help.
std::span<const HeldKey> held_keys();

} // namespace octant::ui::window
