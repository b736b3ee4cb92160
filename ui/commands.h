#pragma once

namespace CLI {
class App;
}

namespace octant::ui {

// Each adds one sub-command whose callback does the work. A callback throws Error when input or
// environment is wrong, and CheckSaidNo when a check that the user asked for fails.

void add_fly_command(CLI::App& program);
void add_report_command(CLI::App& program);
void add_terrain_command(CLI::App& program);
void add_study_command(CLI::App& program);
void add_bench_command(CLI::App& program);

/// Ends the program with exit code 1; what was wrong has been printed.
struct CheckSaidNo {};

} // namespace octant::ui
