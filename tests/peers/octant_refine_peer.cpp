#include "models/meshfile/mesh_file.h"
#include "models/repair/repair.h"
#include "models/simplify/simplify.h"

#include <cstdio>
#include <exception>

#include "refine_peers.h"

using namespace octant;
using namespace octant::tests::peers;

namespace {

Hierarchy read_hierarchy(const std::string& path, std::size_t base) {
    models::simplify::SimplifyOptions options;
    options.length_share = 0.03;
    options.goal.vertices = base;
    auto mesh = models::repair::repaired(models::meshfile::read_mesh(path)).mesh;
    return std::make_shared<const visuals::refine::ProgressiveMesh>(
        models::simplify::fast_sequence(std::move(mesh), options));
}

FaceSet original_faces(const visuals::refine::ProgressiveMesh& mesh) {
    FaceSet faces(mesh.faces().begin(), mesh.faces().end());
    sort_faces(faces);
    return faces;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// All of them in turn, again and again: what else the machine does meets all alike.
int compare(const Hierarchy& mesh, std::size_t rounds) {
    std::vector<std::unique_ptr<PeerRefinement>> peers;
    constexpr std::array orders = {SplitOrder::CoarseFirst, SplitOrder::BySubtree};
    for (const SplitOrder order : orders) {
        for (const bool together : {false, true}) { peers.push_back(our_refinement(mesh, order, together)); }
    }
#ifdef OCTANT_PEER_OPENMESH
    try {
        for (const SplitOrder order : orders) { peers.push_back(openmesh_refinement(mesh, order)); }
    } catch (const std::runtime_error& fault) { std::fprintf(stderr, "OpenMesh left out: %s\n", fault.what()); }
#else
    std::fputs("OpenMesh left out: not built with it\n", stderr);
#endif
    const auto vertices = static_cast<double>(mesh->leaf_count());
    const double splits = vertices - static_cast<double>(mesh->roots().size());
    std::vector<std::vector<double>> times_s(peers.size());
    for (std::size_t round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < peers.size(); ++i) {
            peers[i]->restart();
            const double start_s = cpu_s();
            peers[i]->split_all();
            times_s[i].push_back(cpu_s() - start_s);
        }
    }
    const FaceSet expected = original_faces(*mesh);
    bool same = true;
    for (std::size_t i = 0; i < peers.size(); ++i) {
        const bool right = peers[i]->faces() == expected;
        same = same && right;
        std::printf("%-34s %6.2f million splits/s (best %6.2f), %6.1f bytes a vertex, %s\n", peers[i]->name.c_str(),
            1e-6 * splits / median(times_s[i]), 1e-6 * splits / *std::min_element(times_s[i].begin(), times_s[i].end()),
            peers[i]->heap_bytes / vertices, right ? "the original's faces" : "NOT the original's faces");
    }
    return same ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty() || words.size() > 3) {
        std::fputs("octant-refine-peer MESH [BASE-VERTICES [ROUNDS]]\n"
                   "Splits everything from the base mesh to the original, ours and OpenMesh's in turn; "
                   "medians of processor time.\n",
            stderr);
        return 2;
    }
    try {
        const std::size_t base = words.size() > 1 ? std::stoul(words[1]) : 100;
        const std::size_t rounds = words.size() > 2 ? std::stoul(words[2]) : 31;
        const Hierarchy mesh = read_hierarchy(words[0], base);
        std::printf("%s: %zu vertices, base %zu\n", words[0].c_str(), mesh->leaf_count(), mesh->roots().size());
        return compare(mesh, rounds);
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "octant-refine-peer: %s\n", fault.what());
        return 2;
    }
}
