// The lists of octant cells hold from a distance on. The eyes nearer by are an octahedron: in each octant what is
// behind one of its sides.
#include "visuals/draworder/with_min_distance.h"

#include <glm/geometric.hpp>

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace octant::visuals::draworder {

namespace {

constexpr int axes = 3;

class MinDistanceAdder {
public:
    MinDistanceAdder(const DrawOrder& order, const glm::dvec3& centre_m, double distance_m)
        : order_(order), centre_m_(centre_m), distance_m_(distance_m) {}

    DrawOrder limited() {
        copy(0, glm::dvec3(0.0), 0);
        std::vector<std::vector<std::uint32_t>> lists;
        for (int cell = 0; cell < order_.cell_count(); ++cell) {
            const auto list = order_.polygons_of(cell);
            lists.emplace_back(list.begin(), list.end());
        }
        return {std::move(nodes_), lists};
    }

private:
    /// Copies a child; `signs` are those of the octant as far as the choices above tell.
    int copy(int child, const glm::dvec3& signs, int above) {
        if (above == axes) {
            const int made = add({plane_of(signs), 0, DrawOrder::nothing});
            at(made).front = copy(child, signs, above + 1);
            return made;
        }
        if (child < 0) { return child; }
        const DrawOrder::Node node = order_.nodes()[static_cast<std::size_t>(child)];
        assert(node.kind == DrawOrder::Kind::ViewSplit);
        const bool is_octant = above < axes;
        const glm::dvec3 front = is_octant ? signs + node.plane.normal : signs;
        const glm::dvec3 back = is_octant ? signs - node.plane.normal : signs;
        const int made = add(node);
        at(made).front = copy(node.front, front, above + 1);
        at(made).back = copy(node.back, back, above + 1);
        return made;
    }

    /// The octahedron's side in an octant, its front outside.
    Plane plane_of(const glm::dvec3& signs) const {
        const glm::dvec3 normal = signs / std::sqrt(3.0);
        return {normal, -glm::dot(normal, centre_m_) - distance_m_ / std::sqrt(3.0)};
    }

    int add(const DrawOrder::Node& node) {
        nodes_.push_back(node);
        return static_cast<int>(nodes_.size() - 1);
    }

    DrawOrder::Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }

    const DrawOrder& order_;
    glm::dvec3 centre_m_;
    double distance_m_;
    std::vector<DrawOrder::Node> nodes_;
};

} // namespace

DrawOrder with_min_distance(const DrawOrder& order, const glm::dvec3& centre_m, double distance_m) {
    return MinDistanceAdder(order, centre_m, distance_m).limited();
}

} // namespace octant::visuals::draworder
