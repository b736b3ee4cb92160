// What two earlier rules of selective refinement remember of a collapse: J. C. Xia, A. Varshney,
// "Dynamic View-Dependent Simplification for Polygonal Models", 1996 (the 1-ring), and H. Hoppe,
// "View-Dependent Refinement of Progressive Meshes", 1997, section 3 (four faces).
//
// The constructor starts from the original mesh and performs all collapses, finest first, on a
// FaceLists whose vertices are nodes, and notes the neighbourhood of each collapse. Only the study
// and `octant refine --rule` use this, to count the splits that each rule forces.
#include "visuals/refine/classic_split_rules.h"

#include "visuals/refine/face_lists.h"

#include <algorithm>

namespace octant::visuals::refine {

namespace {

/// The face other than `except` at the edge between two nodes; `none` on a boundary.
std::uint32_t
face_across(const FaceLists& faces, std::uint32_t node, std::uint32_t other, std::uint32_t except) {
    std::uint32_t across = none;
    faces.for_each_corner(node, [&](std::uint32_t corner) {
        if (faces.label(corner / 3) != except &&
            (faces.vertex(FaceLists::next_in_face(corner)) == other ||
             faces.vertex(FaceLists::previous_in_face(corner)) == other)) {
            across = faces.label(corner / 3);
        }
    });
    return across;
}

/// The corner of `face` that is neither `node` nor `other`.
std::uint32_t
third_vertex(const FaceLists& faces, std::uint32_t node, std::uint32_t other, std::uint32_t face) {
    std::uint32_t third = none;
    faces.for_each_corner(node, [&](std::uint32_t corner) {
        if (faces.label(corner / 3) == face) {
            const std::uint32_t next = faces.vertex(FaceLists::next_in_face(corner));
            third = next == other ? faces.vertex(FaceLists::previous_in_face(corner)) : next;
        }
    });
    return third;
}

} // namespace

ClassicSplitRules::ClassicSplitRules(const ProgressiveMesh& mesh)
    : leaves_(static_cast<std::uint32_t>(mesh.leaf_count()))
    , introducers_(mesh.face_count(), none) {
    FaceLists faces(mesh.node_count(), mesh.face_count());
    for (std::uint32_t node = 0; node < mesh.node_count(); ++node) {
        faces.add_vertex();
    }
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        faces.add(mesh.faces()[face], face);
    }
    adjacent_faces_.resize(mesh.node_count() - leaves_);
    rings_.resize(adjacent_faces_.size());
    const std::vector<std::uint32_t> order = mesh.coarsest_first();
    for (auto at = order.rbegin(); at != order.rend(); ++at) {
        const std::uint32_t node = *at;
        const VertexSplit split = mesh.split_of(node);
        auto& beside = adjacent_faces_[node - leaves_];
        std::size_t k = 0;
        for (const std::uint32_t face : {split.left_face, split.right_face}) {
            beside[k] = none;
            beside[k + 1] = none;
            if (face != none) {
                introducers_[face] = node;
                const std::uint32_t cut = third_vertex(faces, split.first, split.second, face);
                beside[k] = face_across(faces, split.first, cut, face);
                beside[k + 1] = face_across(faces, split.second, cut, face);
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

} // namespace octant::visuals::refine
