#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "peers.h"

using namespace octant::tests::peers;

namespace {

struct Method {
    const char* name;
    const char* library;
    PeerResult (*simplify)(const PeerMesh& mesh, std::size_t faces); ///< null: not built in
};

constexpr std::array methods = {
#ifdef OCTANT_PEER_CGAL
    Method{"cgal-lindstrom-turk", "CGAL", cgal_lindstrom_turk},
    Method{"cgal-garland-heckbert", "CGAL", cgal_garland_heckbert},
#else
    Method{"cgal-lindstrom-turk", "CGAL", nullptr},
    Method{"cgal-garland-heckbert", "CGAL", nullptr},
#endif
#ifdef OCTANT_PEER_MESHOPTIMIZER
    Method{"meshoptimizer", "meshoptimizer", meshoptimizer},
#else
    Method{"meshoptimizer", "meshoptimizer", nullptr},
#endif
#ifdef OCTANT_PEER_OPENMESH
    Method{"openmesh-quadric", "OpenMesh", openmesh_quadric},
#else
    Method{"openmesh-quadric", "OpenMesh", nullptr},
#endif
};

constexpr int wrong_input = 2;
constexpr int not_built = 3;

int usage() {
    std::fputs("octant-peers METHOD IN.obj FACES OUT.obj [--repeat N]\n"
               "Simplifies by another library, prints {method, faces, vertices, time_ms}: the median of N "
               "runs.\nMethods:",
        stderr);
    for (const Method& method : methods) { std::fprintf(stderr, " %s", method.name); }
    std::fputs("\nExit code 2: wrong input; 3: built without that library.\n", stderr);
    return wrong_input;
}

int run(const Method& method, const std::array<std::string, 3>& words, int repeat) {
    const PeerMesh input = read_obj(words[0]);
    const std::size_t faces = std::stoul(words[1]);
    PeerResult result;
    std::vector<double> times_ms;
    for (int i = 0; i < repeat; ++i) {
        result = method.simplify(input, faces);
        times_ms.push_back(result.time_ms);
    }
    std::sort(times_ms.begin(), times_ms.end());
    write_obj(words[2], result.mesh);
    std::printf("{\"method\": \"%s\", \"faces\": %zu, \"vertices\": %zu, \"time_ms\": %.3f}\n", method.name,
        result.mesh.triangles.size(), result.mesh.vertices.size(), times_ms[times_ms.size() / 2]);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    const bool repeats = words.size() == 6 && words[4] == "--repeat";
    if (words.size() != 4 && !repeats) { return usage(); }
    const auto* method =
        std::find_if(methods.begin(), methods.end(), [&](const Method& known) { return words[0] == known.name; });
    if (method == methods.end()) { return usage(); }
    if (method->simplify == nullptr) {
        std::printf("not built with %s\n", method->library);
        return not_built;
    }
    try {
        const int repeat = repeats ? std::max(1, std::stoi(words[5])) : 1;
        return run(*method, {words[1], words[2], words[3]}, repeat);
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "octant-peers: %s\n", fault.what());
        return wrong_input;
    }
}
