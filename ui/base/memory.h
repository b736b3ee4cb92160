#pragma once

namespace octant::ui::base {

/// Gives freed memory back to the system at once, where main keeps it for the next picture
/// (visuals/gl/platform_tuning.h): for commands that draw nothing and need large arrays one after the other. Does
/// nothing on other C libraries than glibc.
void release_free_memory();

} // namespace octant::ui::base
