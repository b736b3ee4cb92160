#pragma once

#include <span>
#include <string_view>

namespace octant::ui::window {

/// What a key asks of the window.
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

struct ViewKey {
    int key = 0; ///< GLFW_KEY_...
    ViewCommand command = ViewCommand::Leave;
    std::string_view name;    ///< as written on the key
    std::string_view meaning; ///< one line for the help
    bool repeats = false;     ///< again and again while it is held
};

/// All keys that ask for something once, in the order of the help.
std::span<const ViewKey> view_keys();

/// Keys and mouse that act as long as they are held.
struct HeldKey {
    std::string_view name;
    std::string_view meaning;
};

std::span<const HeldKey> held_keys();

} // namespace octant::ui::window
