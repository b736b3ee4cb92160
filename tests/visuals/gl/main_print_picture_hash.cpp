#include "tests/visuals/gl/small_scene.h"

#include <cstdio>

// Prints the hash of a small scene, for same_on_any_threads.cmake.
int main() {
    octant::tests::Studio studio(octant::visuals::gl::make_osmesa_context(), 1, 320, 240);
    std::printf("%016llx\n", static_cast<unsigned long long>(octant::tests::hash_of_full_scene(studio)));
    return 0;
}
