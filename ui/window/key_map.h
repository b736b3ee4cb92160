#pragma once

#include "ui/window/pilot_input.h"

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

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

/// Returns all commands, in the order of the help and of ViewCommand.
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
    HeldAction action = HeldAction::Pull;
    int key = 0;
    std::string_view id;
    /// What this key and those before it without one do; empty where the next line tells it.
    std::string_view meaning;
};

/// Returns all actions, in the order of the help and of HeldAction.
std::span<const HeldKey> held_keys();

/// Returns the key, one of GLFW_KEY_..., that has this name, such as "Page Up", in whatever letters; nothing where
/// there is none.
std::optional<int> key_of_name(std::string_view name);

/// Returns the name of a button of a mouse ("left", "right", "middle"), one of GLFW_MOUSE_BUTTON_...
std::string name_of_button(int button);

/// Returns the name of a button of a gamepad ("a", "left bumper", "start"), in the order of GLFWgamepadstate.
std::string name_of_pad_button(int button);

/// An axis of a device, and whether it counts the other way round.
struct AxisBinding {
    int axis = 0;
    bool reversed = false;
};

/// What moves the controls in a flight by hand: axes of a gamepad; its buttons or axes open and close the throttle.
struct GamepadAxes {
    AxisBinding roll;
    AxisBinding pitch;
    AxisBinding rudder;
    AxisBinding throttle_up;
    AxisBinding throttle_down;
};

struct JoystickAxes {
    AxisBinding roll{0};
    AxisBinding pitch{1};
    AxisBinding rudder{2};
    AxisBinding throttle{3};
};

/// Which keys, mouse buttons and axes do what. Made as the program has it; a person's file changes some of it.
class KeyMap {
public:
    KeyMap();

    /// Returns what the key commands, when it is pressed or, for some, while it repeats.
    std::optional<ViewCommand> command_of(int key, bool repeats) const;

    /// Returns the name of the key that gives a command, such as "Space"; "none" where none does.
    std::string name_of(ViewCommand command) const;

    int key_of(HeldAction action) const;
    std::string name_of(HeldAction action) const;

    /// Changes what the line "id = input" of a file says. Returns nothing, or what was expected and what came; then
    /// nothing is changed.
    std::optional<std::string> bind(std::string_view id, std::string_view input);

    /// The buttons of the mouse, GLFW_MOUSE_BUTTON_..., that turn the look and that make the pointer the stick.
    int look_button = 0;
    int stick_button = 1;
    GamepadAxes gamepad;
    /// Unset where the joystick's axes are those that its kind usually has.
    std::optional<JoystickAxes> joystick;
    /// What a button of the gamepad commands when it is pressed; nothing for most.
    std::array<std::optional<ViewCommand>, std::tuple_size_v<GamepadButtons>> pad_commands;

private:
    std::optional<std::string> bind_key(int& chosen, std::string_view input);
    std::optional<std::string> bind_pad_button(int button, std::string_view input);

    /// Keys, in the order of view_keys(), which is that of ViewCommand.
    std::vector<int> commands_;
    /// Keys, in the order of held_keys(), which is that of HeldAction.
    std::vector<int> held_;
};

/// What a file of keys says.
struct KeyMapFile {
    KeyMap keys;
    /// "file:line: expected ..., got ...", for lines that were left out.
    std::vector<std::string> errors;
};

/// Reads a file of keys; where there is none, keys are as the program has them.
KeyMapFile read_key_map(const std::filesystem::path& file);

/// Returns the axes of a gamepad, in the order of GLFWgamepadstate, where the usual ones stand: roll, pitch, rudder,
/// nothing, throttle down, throttle up.
std::array<float, 6> gamepad_axes(const KeyMap& keys, std::span<const float, 6> axes);

/// Returns the commands of the buttons that are pressed `now` and were not `before`.
std::vector<ViewCommand> pad_commands(const KeyMap& keys, const GamepadButtons& before, const GamepadButtons& now);

/// Returns the buttons without those that have a command: what is left to fly with.
GamepadButtons flying_buttons(const KeyMap& keys, GamepadButtons buttons);

/// Returns the axes of a joystick where the usual ones stand. An axis that it does not have is 0.
JoystickState mapped_joystick(const KeyMap& keys, std::span<const float> axes);

/// Returns the text of a file that says what `keys` say, with a line for everything.
std::string text_of_key_map(const KeyMap& keys);

} // namespace octant::ui::window
