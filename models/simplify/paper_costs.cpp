// The proposed costs of a contraction: Y. Kim, B. U. Lee, "Error measure for vertex
// simplification", 2005, section II.2 (distance to triangles) and the two directions of the
// bidirectional measure. The reading of what is summed over is stated in paper_simplify.cpp.
#include "models/simplify/paper_costs.h"

#include "models/simplify/foot_of_perpendicular.h"

namespace octant::models::simplify {

namespace {

/// The squared distance to a triangle; counts the foot.
double counted_distance2(const Corners& triangle, const Point6& x, FeetCount& feet) {
    const Foot foot = foot_on(triangle, x);
    ++feet.all;
    feet.outside += foot.inside ? 0 : 1;
    return foot.distance2;
}

} // namespace

double cost_there(
    const PaperMesh& mesh, const Contraction& edge, const Point6& candidate, FeetCount& feet) {
    double sum = 0.0;
    for (const std::uint32_t face : edge.faces) {
        sum += counted_distance2(mesh.corners(face), candidate, feet);
    }
    return sum;
}

double cost_back(
    const PaperMesh& mesh, const Contraction& edge, const Point6& candidate, FeetCount& feet) {
    const Point6& first = mesh.point(edge.first);
    const Point6& second = mesh.point(edge.second);
    double sum = 0.0;
    for (const std::uint32_t face : edge.faces) {
        const Triangle& vertices = mesh.face(face);
        Corners moved = mesh.corners(face);
        for (std::size_t i = 0; i < moved.size(); ++i) {
            if (vertices[i] == edge.first || vertices[i] == edge.second) {
                moved[i] = candidate;
            }
        }
        sum += counted_distance2(moved, first, feet);
        sum += counted_distance2(moved, second, feet);
    }
    return sum;
}

} // namespace octant::models::simplify
