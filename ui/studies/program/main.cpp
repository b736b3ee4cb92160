// octant-study: repeats the experiments of the five papers, and benchmarks. `octant study` and `octant bench` start it.
#include "ui/command_line/command_line.h"
#include "ui/studies/program/study_program.h"
#include "visuals/gl/platform_tuning.h"

int main(int argc, char** argv) {
    octant::visuals::gl::tune_allocator();
    return octant::ui::command_line::run_program(
        "octant-study", octant::ui::studies::program::study_program, argc, argv);
}
