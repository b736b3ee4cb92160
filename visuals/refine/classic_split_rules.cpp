// Two earlier rules of selective refinement, for comparison over one hierarchy: J. C. Xia, A. Varshney, "Dynamic
// View-Dependent Simplification for Polygonal Models", 1996 (the 1-ring at collapse time), and H. Hoppe,
// "View-Dependent Refinement of Progressive Meshes", 1997, section 3 (four faces). Only the study and `octant refine
// --rule` use them, to count the splits that each rule forces.
#include "visuals/refine/classic_split_rules.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::refine {

namespace {

/// The neighbourhoods that the two earlier rules store for each collapse, found by replaying all collapses of the mesh
/// once.
class ClassicSplitRules {
public:
    explicit ClassicSplitRules(const ProgressiveMesh& mesh);

    /// The four original faces fn0 to fn3 of Hoppe 1997: the ones across the remaining edges of the two faces that the
    /// collapse removed; `none` on a boundary. `node` is an inner node.
    const std::array<std::uint32_t, 4>& adjacent_faces(std::uint32_t node) const {
        return adjacent_faces_[node - leaves_];
    }

    /// The 1-ring of Xia & Varshney: the nodes around both children when they were collapsed, ascending.
    std::span<const std::uint32_t> ring(std::uint32_t node) const { return rings_[node - leaves_]; }

    /// The inner node whose split adds an original face to the active mesh; `none` for a face of the base mesh.
    std::uint32_t introducer(std::uint32_t face) const { return introducers_[face]; }

private:
    std::uint32_t leaves_;
    std::vector<std::array<std::uint32_t, 4>> adjacent_faces_;
    std::vector<std::vector<std::uint32_t>> rings_;
    std::vector<std::uint32_t> introducers_;
};

/// The face other than `except` at the edge between two nodes; `none` on a boundary.
std::uint32_t face_across(const FaceLists& faces, std::uint32_t node, std::uint32_t other, std::uint32_t except) {
    std::uint32_t across = none;
    faces.for_each_corner(node, [&](std::uint32_t corner) {
        if (faces.label(corner / 3) != except && (faces.vertex(FaceLists::next_in_face(corner)) == other ||
                                                     faces.vertex(FaceLists::previous_in_face(corner)) == other)) {
            across = faces.label(corner / 3);
        }
    });
    return across;
}

/// The corner of `face` that is neither `node` nor `other`.
std::uint32_t third_vertex(const FaceLists& faces, std::uint32_t node, std::uint32_t other, std::uint32_t face) {
    std::uint32_t third = none;
    faces.for_each_corner(node, [&](std::uint32_t corner) {
        if (faces.label(corner / 3) == face) {
            const std::uint32_t next = faces.vertex(FaceLists::next_in_face(corner));
            third = next == other ? faces.vertex(FaceLists::previous_in_face(corner)) : next;
        }
    });
    return third;
}

/// Starts from the original mesh and performs all collapses, finest first, on a FaceLists whose vertices are nodes.
ClassicSplitRules::ClassicSplitRules(const ProgressiveMesh& mesh)
    : leaves_(static_cast<std::uint32_t>(mesh.leaf_count())), introducers_(mesh.face_count(), none) {
    FaceLists faces(mesh.node_count(), mesh.face_count());
    for (std::uint32_t node = 0; node < mesh.node_count(); ++node) { faces.add_vertex(); }
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) { faces.add(mesh.faces()[face], face); }
    adjacent_faces_.resize(mesh.node_count() - leaves_);
    rings_.resize(adjacent_faces_.size());
    const std::vector<std::uint32_t> order = mesh.coarsest_first();
    for (auto at = order.rbegin(); at != order.rend(); ++at) {
        const std::uint32_t node = *at;
        const VertexSplit split = mesh.split_of(node);
        auto& adjacent = adjacent_faces_[node - leaves_];
        std::size_t k = 0;
        for (const std::uint32_t face : {split.left_face, split.right_face}) {
            adjacent[k] = none;
            adjacent[k + 1] = none;
            if (face != none) {
                introducers_[face] = node;
                const std::uint32_t cut = third_vertex(faces, split.first, split.second, face);
                adjacent[k] = face_across(faces, split.first, cut, face);
                adjacent[k + 1] = face_across(faces, split.second, cut, face);
                faces.remove(faces.find(split.first, face));
            }
            k += 2;
        }
        for (const std::uint32_t child : {split.first, split.second}) {
            faces.move_corners(child, node, [](std::uint32_t) { return true; });
        }
        std::vector<std::uint32_t>& ring = rings_[node - leaves_];
        faces.for_each_corner(node, [&](std::uint32_t corner) {
            ring.push_back(faces.vertex(FaceLists::next_in_face(corner)));
            ring.push_back(faces.vertex(FaceLists::previous_in_face(corner)));
        });
        std::ranges::sort(ring);
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    }
}

/// The introducer of one of the four faces next to the node's edge that is not in the active mesh yet.
std::uint32_t required_by_hoppe(const ClassicSplitRules& rules, const SelectiveRefiner& refiner, std::uint32_t node) {
    for (const std::uint32_t face : rules.adjacent_faces(node)) {
        if (face == none) { continue; }
        const std::uint32_t introducer = rules.introducer(face);
        if (introducer != none && !refiner.is_split(introducer)) { return introducer; }
    }
    return none;
}

/// The unsplit parent of a node of the 1-ring at collapse time.
std::uint32_t required_by_xia(const ClassicSplitRules& rules, const SelectiveRefiner& refiner, std::uint32_t node) {
    for (const std::uint32_t around : rules.ring(node)) {
        const std::uint32_t parent = refiner.mesh().parent(around);
        if (parent != none && !refiner.is_split(parent)) { return parent; }
    }
    return none;
}

} // namespace

RequiredSplit required_split_of(SplitRule rule, const ProgressiveMesh& mesh) {
    if (rule == SplitRule::Selective) { return {}; }
    return [rules = std::make_shared<const ClassicSplitRules>(mesh), rule](
               const SelectiveRefiner& refiner, std::uint32_t node) {
        return rule == SplitRule::Hoppe ? required_by_hoppe(*rules, refiner, node)
                                        : required_by_xia(*rules, refiner, node);
    };
}

} // namespace octant::visuals::refine
