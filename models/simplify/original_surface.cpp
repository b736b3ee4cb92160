// Nearest points near a known one. The nearest point of a triangle is found by the regions of
// C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
#include "models/simplify/original_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace octant::models::simplify {

namespace {

/// Where the squared share of its sides' rectangle that a triangle covers is below this, rounding
/// hides on which side of it a point lies; the nearest point of its sides is taken then.
constexpr double min_area_share2 = 1e-12;

} // namespace

OriginalSurface::OriginalSurface(const WorkingSurface& surface)
    : places_(surface.places) {
    const CollapsibleMesh& mesh = surface.mesh;
    triangles_.reserve(mesh.face_slots());
    beyond_.reserve(mesh.face_slots());
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        triangles_.push_back(mesh.corners(face));
        std::array<std::uint32_t, 3>& beyond = beyond_.emplace_back();
        for (std::uint32_t side = 0; side < 3; ++side) {
            const HalfEdge twin = mesh.twin(3 * face + side);
            beyond[side] = twin == none ? none : face_of(twin);
        }
    }
}

glm::dvec3 OriginalSurface::normal(std::uint32_t triangle) const {
    const auto [a, b, c] = triangles_[triangle];
    return area_vector({places_[a], places_[b], places_[c]});
}

OriginalSurface::OnTriangle
OriginalSurface::nearest_on(std::uint32_t triangle, const glm::dvec3& point) const {
    const Triangle& t = triangles_[triangle];
    const glm::dvec3& a = places_[t[0]];
    const glm::dvec3 ab = places_[t[1]] - a;
    const glm::dvec3 ac = places_[t[2]] - a;
    const glm::dvec3 ap = point - a;
    const double d1 = glm::dot(ab, ap);
    const double d2 = glm::dot(ac, ap);
    const auto made = [&](const glm::dvec3& from_a, std::uint32_t side, std::uint32_t corner) {
        const glm::dvec3 off = ap - from_a;
        return OnTriangle{a + from_a, glm::dot(off, off), side, corner};
    };
    if (d1 <= 0.0 && d2 <= 0.0) {
        return made(glm::dvec3(0.0), none, 0);
    }
    const double bb = glm::dot(ab, ab);
    const double bc = glm::dot(ab, ac);
    const double cc = glm::dot(ac, ac);
    const double d3 = d1 - bb;
    const double d4 = d2 - bc;
    if (d3 >= 0.0 && d4 <= d3) {
        return made(ab, none, 1);
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        return made((bb > 0.0 ? d1 / bb : 0.0) * ab, 0, none);
    }
    const double d5 = d1 - bc;
    const double d6 = d2 - cc;
    if (d6 >= 0.0 && d5 <= d6) {
        return made(ac, none, 2);
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        return made((cc > 0.0 ? d2 / cc : 0.0) * ac, 2, none);
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double length = (d4 - d3) + (d5 - d6);
        const double along = length > 0.0 ? (d4 - d3) / length : 0.0;
        return made(ab + along * (ac - ab), 1, none);
    }
    const double sum = va + vb + vc;
    if (!(sum > min_area_share2 * bb * cc)) {
        const auto on_side = [&](std::uint32_t side, const glm::dvec3& from, const glm::dvec3& way) {
            const double length2 = glm::dot(way, way);
            const double along = glm::dot(ap - from, way);
            const bool ends = !(along > 0.0 && along < length2);
            const std::uint32_t corner = along > 0.0 ? (side + 1) % 3 : side;
            const double share = ends ? (along > 0.0 ? 1.0 : 0.0) : along / length2;
            return made(from + share * way, ends ? none : side, ends ? corner : none);
        };
        const OnTriangle sides[] = {
            on_side(0, glm::dvec3(0.0), ab), on_side(1, ab, ac - ab), on_side(2, ac, -ac)};
        return *std::ranges::min_element(sides, {}, &OnTriangle::distance2);
    }
    return made((vb / sum) * ab + (vc / sum) * ac, none, none);
}

OriginalPoint OriginalSurface::nearest_from(
    std::uint32_t start, const glm::dvec3& point, double& distance2) const {
    std::uint32_t at = start;
    OnTriangle best = nearest_on(at, point);
    while (true) {
        std::uint32_t next = none;
        OnTriangle nearer;
        const auto look = [&](std::uint32_t triangle) {
            const OnTriangle here = nearest_on(triangle, point);
            const double least2 = next == none ? best.distance2 : nearer.distance2;
            if (here.distance2 < least2) {
                nearer = here;
                next = triangle;
            }
        };
        if (best.side != none && beyond_[at][best.side] != none) {
            look(beyond_[at][best.side]);
        } else if (best.corner != none) {
            // Around the corner, first one way and at a boundary then the other way.
            const std::uint32_t corner = triangles_[at][best.corner];
            for (const bool forward : {true, false}) {
                std::uint32_t triangle = at;
                do {
                    std::uint32_t i = 0;
                    while (triangles_[triangle][i] != corner) {
                        ++i;
                    }
                    triangle = beyond_[triangle][forward ? (i + 2) % 3 : i];
                    if (triangle != none && triangle != at) {
                        look(triangle);
                    }
                } while (triangle != none && triangle != at);
                if (triangle == at) {
                    break;
                }
            }
        }
        if (next == none) {
            distance2 = best.distance2;
            return {measure::narrow(best.place), at};
        }
        best = nearer;
        at = next;
    }
}

} // namespace octant::models::simplify
