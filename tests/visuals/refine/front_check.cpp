#include "tests/visuals/refine/front_check.h"

#include <algorithm>
#include <map>
#include <set>

namespace octant::visuals::refine::test {

namespace {

std::array<std::uint32_t, 3> turned_to_smallest(std::array<std::uint32_t, 3> face) {
    std::rotate(face.begin(), std::ranges::min_element(face), face.end());
    return face;
}

} // namespace

NamedFaces active_faces(const SelectiveRefiner& refiner) {
    NamedFaces faces;
    const auto indices = refiner.indices();
    for (std::size_t place = 0; 3 * place < indices.size(); ++place) {
        if (refiner.face_at(place) == none) { continue; }
        std::array<std::uint32_t, 3> face{};
        for (std::size_t k = 0; k < 3; ++k) {
            face[k] = refiner.mesh().sequence_number(refiner.node_at(indices[3 * place + k]));
        }
        faces.push_back(turned_to_smallest(face));
    }
    std::ranges::sort(faces);
    return faces;
}

NamedFaces expected_faces(const models::CollapseSequence& sequence, const SelectiveRefiner& refiner) {
    const std::size_t originals = sequence.original.vertices_m.size();
    std::vector<std::uint32_t> ancestors(originals + sequence.collapses.size(), none);
    for (std::uint32_t slot = 0; slot < refiner.vertices().size(); ++slot) {
        if (refiner.node_at(slot) != none) {
            const std::uint32_t number = refiner.mesh().sequence_number(refiner.node_at(slot));
            ancestors[number] = number;
        }
    }
    for (std::size_t i = sequence.collapses.size(); i-- > 0;) {
        for (const std::uint32_t child : {sequence.collapses[i].first, sequence.collapses[i].second}) {
            if (ancestors[originals + i] != none) { ancestors[child] = ancestors[originals + i]; }
        }
    }
    NamedFaces faces;
    for (const auto& [a, b, c] : sequence.original.triangles) {
        const std::array face{ancestors[a], ancestors[b], ancestors[c]};
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
            faces.push_back(turned_to_smallest(face));
        }
    }
    std::ranges::sort(faces);
    return faces;
}

std::string manifold_fault(const SelectiveRefiner& refiner) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::set<Edge> edges;
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> fans;
    for (const auto& face : active_faces(refiner)) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = face[k];
            const std::uint32_t b = face[(k + 1) % 3];
            if (!edges.insert({a, b}).second) { return "an edge is used twice in one direction"; }
            fans[a][b] = face[(k + 2) % 3];
        }
    }
    for (const auto& [vertex, next] : fans) {
        std::set<std::uint32_t> ends;
        for (const auto& [from, to] : next) { ends.insert(to); }
        std::uint32_t at = next.begin()->first;
        for (const auto& [from, to] : next) {
            at = ends.count(from) == 0 ? from : at; // where an open fan begins
        }
        std::size_t walked = 0;
        while (next.count(at) != 0 && walked < next.size()) {
            at = next.at(at);
            ++walked;
        }
        if (walked < next.size()) { return "a vertex has more than one fan"; }
    }
    return {};
}

long euler_characteristic(const NamedFaces& faces) {
    std::set<std::uint32_t> vertices;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& face : faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            vertices.insert(face[k]);
            edges.insert(std::minmax(face[k], face[(k + 1) % 3]));
        }
    }
    return static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + static_cast<long>(faces.size());
}

} // namespace octant::visuals::refine::test
