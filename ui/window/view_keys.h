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
    ByHand,
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

/// A key and the command that it gives.
struct ViewKey {
    /// One of GLFW_KEY_...
    int key = 0;
    ViewCommand command = ViewCommand::Leave;
    /// The name as written on the key.
    std::string_view name;
    /// One line for the help.
    std::string_view meaning;
    /// The command is given again and again while the key is held.
    bool repeats = false;
};

/// Returns all keys that give commands, in the order of the help.
std::span<const ViewKey> view_keys();

/// Keys and mouse buttons that act as long as they are held.
struct HeldKey {
    std::string_view name;
    std::string_view meaning;
};

/// Returns all keys and mouse buttons that act while they are held, in the order of the help.
std::span<const HeldKey> held_keys();

} // namespace octant::ui::window
