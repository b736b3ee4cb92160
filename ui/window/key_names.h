#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace octant::ui::window {

/// Returns the name that stands on a key, one of GLFW_KEY_..., such as "Page Up"; empty for a key that has none here.
std::string name_of_key(int key);

/// Returns the key of that name, in whatever letters; nothing where there is none.
std::optional<int> key_of_name(std::string_view name);

/// The same for the buttons of a mouse ("left", "right", "middle"), one of GLFW_MOUSE_BUTTON_...
std::string name_of_button(int button);
std::optional<int> button_of_name(std::string_view name);

/// The same for the axes of a gamepad ("left x", "right trigger"), in the order of GLFWgamepadstate.
std::string name_of_axis(int axis);
std::optional<int> axis_of_name(std::string_view name);

/// The same for the buttons of a gamepad ("a", "left bumper", "start"), in the order of GLFWgamepadstate.
std::string name_of_pad_button(int button);
std::optional<int> pad_button_of_name(std::string_view name);

} // namespace octant::ui::window
