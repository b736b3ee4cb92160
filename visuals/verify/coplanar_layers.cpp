#include "visuals/verify/coplanar_layers.h"

#include <algorithm>

namespace octant::visuals::verify {

namespace {

struct Box {
    Vector least{};
    Vector most{};
    std::uint32_t polygon = 0;
};

Box box_of(const Certificate& certificate, std::uint32_t number) {
    const CertificatePolygon& polygon = certificate.polygons[number];
    Box box;
    box.polygon = number;
    box.least = box.most = certificate.vertices[polygon.corners.front()];
    for (const std::uint32_t corner : polygon.corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            box.least[i] = std::min(box.least[i], certificate.vertices[corner][i]);
            box.most[i] = std::max(box.most[i], certificate.vertices[corner][i]);
        }
    }
    // Polygons that only nearly overlap lie in one plane all the same.
    for (std::size_t i = 0; i < 3; ++i) {
        box.least[i] -= certificate.tolerance;
        box.most[i] += certificate.tolerance;
    }
    return box;
}

bool meet(const Box& a, const Box& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (a.most[i] < b.least[i] || b.most[i] < a.least[i]) {
            return false;
        }
    }
    return true;
}

} // namespace

std::vector<PolygonPair> coplanar_layer_pairs(const Certificate& certificate, const ExactSides& sides) {
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < certificate.polygons.size(); ++i) {
        boxes.push_back(box_of(certificate, i));
    }
    std::ranges::sort(boxes, {}, [](const Box& box) { return box.least[0]; });
    std::vector<PolygonPair> found;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes.size() && boxes[j].least[0] <= boxes[i].most[0];
             ++j) {
            PolygonPair pair{boxes[i].polygon, boxes[j].polygon};
            const CertificatePolygon& a = certificate.polygons[pair.earlier];
            const CertificatePolygon& b = certificate.polygons[pair.later];
            if (a.source != b.source && a.axis == b.axis && meet(boxes[i], boxes[j]) &&
                sides.are_coplanar_layers(pair.earlier, pair.later)) {
                if (a.source > b.source) {
                    std::swap(pair.earlier, pair.later);
                }
                found.push_back(pair);
            }
        }
    }
    return found;
}

} // namespace octant::visuals::verify
