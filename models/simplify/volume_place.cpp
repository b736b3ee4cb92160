// The place and the cost of a collapse after P. Lindstrom, G. Turk, "Fast and Memory Efficient
// Polygonal Simplification", 1998, sections 4.1 to 4.5: the boundary's area and the volume are
// kept, then squared volumes and areas that triangles and boundary edges sweep are least, then the
// vertex lies amid its neighbours; each step has the freedom that those before left. Borders of
// materials sweep areas too.
//
// Deviation: the steps are minima of quadratic forms along their principal axes, instead of three
// linear constraints whose angles are compared.
#include "models/simplify/volume_place.h"

#include "models/simplify/quadric.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace octant::models::simplify {

namespace {

/// A form decides along an axis only where its curvature is more than this share of its trace: the
/// squared sine of one degree.
constexpr double least_curvature = 3.0e-4;

Quadric scaled(const Quadric& q, double by) {
    return {by * q.xx, by * q.xy, by * q.xz, by * q.yy, by * q.yz, by * q.zz, by * q.b, by * q.c};
}

/// |moment + edge x p|^2: four times the squared area of the triangle between an edge of the
/// boundary and p, where `moment` is the cross product of the edge's ends.
Quadric swept_area(const glm::dvec3& edge, const glm::dvec3& moment) {
    Quadric q;
    const double length2 = glm::dot(edge, edge);
    q.xx = length2 - edge.x * edge.x;
    q.yy = length2 - edge.y * edge.y;
    q.zz = length2 - edge.z * edge.z;
    q.xy = -edge.x * edge.y;
    q.xz = -edge.x * edge.z;
    q.yz = -edge.y * edge.z;
    q.b = -glm::cross(edge, moment);
    q.c = glm::dot(moment, moment);
    return q;
}

/// A place, and the axes along which it may still move.
class Freedom {
public:
    const glm::dvec3& place() const { return place_; }

    /// Moves the place to where a form is least, along the axes on which it has a say, and takes
    /// those away.
    void lessen(const Quadric& form) {
        turn_axes_to(form);
        const double least = least_curvature * form.trace();
        std::size_t left = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const glm::dvec3 axis = axes_[i];
            const double curvature = glm::dot(axis, product(form, axis));
            if (curvature > least) {
                place_ -= glm::dot(axis, product(form, place_) + form.b) / curvature * axis;
            } else {
                axes_[left++] = axis;
            }
        }
        count_ = left;
    }

private:
    /// Turns the axes into each other until the form couples none of them (Jacobi's method).
    void turn_axes_to(const Quadric& form) {
        constexpr int most_sweeps = 8;
        const double nothing = 1e-14 * form.trace();
        bool coupled = true;
        for (int sweep = 0; sweep < most_sweeps && coupled; ++sweep) {
            coupled = false;
            for (std::size_t i = 0; i + 1 < count_; ++i) {
                for (std::size_t j = i + 1; j < count_; ++j) {
                    coupled = turn(form, axes_[i], axes_[j], nothing) || coupled;
                }
            }
        }
    }

    static bool turn(const Quadric& form, glm::dvec3& one, glm::dvec3& other, double nothing) {
        const glm::dvec3 of_one = product(form, one);
        const double coupling = glm::dot(other, of_one);
        if (!(std::abs(coupling) > nothing)) {
            return false;
        }
        const double apart =
            (glm::dot(other, product(form, other)) - glm::dot(one, of_one)) / (2.0 * coupling);
        const double tangent =
            std::copysign(1.0 / (std::abs(apart) + std::sqrt(apart * apart + 1.0)), apart);
        const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0);
        const double sine = tangent * cosine;
        const glm::dvec3 turned = cosine * one - sine * other;
        other = sine * one + cosine * other;
        one = turned;
        return true;
    }

    glm::dvec3 place_{0.0};
    std::array<glm::dvec3, 3> axes_{
        glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1.0)};
    std::size_t count_ = 3;
};

/// What the triangles around an edge say about the place, relative to the edge's middle.
class Around {
public:
    Around(const WorkingSurface& surface, HalfEdge edge)
        : surface_(surface)
        , ends_{surface.mesh.origin(edge), surface.mesh.target(edge)}
        , middle_(0.5 * (surface.places[ends_[0]] + surface.places[ends_[1]])) {
        const glm::dvec3 along = surface.places[ends_[1]] - surface.places[ends_[0]];
        length2_ = glm::dot(along, along);
    }

    void add(std::uint32_t face) {
        std::array<glm::dvec3, 3> corners = surface_.corner_places(face);
        for (glm::dvec3& corner : corners) {
            corner -= middle_;
        }
        const glm::dvec3 normal = area_vector(corners);
        const double offset = -glm::dot(normal, corners[0]);
        volumes_.add_plane(normal, offset, 1.0);
        normal_ += normal;
        offset_ += offset;
        for (std::size_t i = 0; i < 3; ++i) {
            const HalfEdge h = 3 * face + static_cast<HalfEdge>(i);
            if (!is_end(surface_.mesh.origin(h)) && !is_end(surface_.mesh.target(h))) {
                continue;
            }
            const glm::dvec3& from = corners.at(i);
            const glm::dvec3& to = corners.at((i + 1) % 3);
            if (surface_.mesh.twin(h) == none) {
                add_boundary(from, to);
            } else if (surface_.is_material_border(h)) {
                areas_ += swept_area(to - from, glm::cross(from, to));
            }
        }
    }

    /// Adds a neighbour of the new vertex.
    void add_neighbour(std::uint32_t vertex) {
        amid_.xx += 1.0;
        amid_.yy += 1.0;
        amid_.zz += 1.0;
        amid_.b -= surface_.places[vertex] - middle_;
    }

    Placement placement() const {
        const Quadric swept = swept_by_all();
        Freedom freedom;
        if (on_boundary_) {
            freedom.lessen(swept_area(boundary_edge_, boundary_moment_));
        }
        Quadric volume;
        volume.add_plane(normal_, offset_, 1.0);
        freedom.lessen(volume);
        freedom.lessen(swept);
        freedom.lessen(amid_);
        Placement found;
        found.place = middle_ + freedom.place();
        found.cost = std::max(swept.at(freedom.place()), 0.0);
        found.weight = swept.trace();
        return found;
    }

private:
    bool is_end(std::uint32_t vertex) const { return vertex == ends_[0] || vertex == ends_[1]; }

    void add_boundary(const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 edge = to - from;
        const glm::dvec3 moment = glm::cross(from, to);
        areas_ += swept_area(edge, moment);
        boundary_edge_ += edge;
        boundary_moment_ += moment;
        on_boundary_ = true;
    }

    /// Squared volumes of tetrahedra, and squared areas at the boundary times the squared length of
    /// the edge, which gives them the same dimension; half of each (section 4.5).
    Quadric swept_by_all() const {
        constexpr double of_volumes = 0.5 / 36.0;
        constexpr double of_areas = 0.5 / 4.0;
        Quadric sum = scaled(volumes_, of_volumes);
        sum += scaled(areas_, of_areas * length2_);
        return sum;
    }

    const WorkingSurface& surface_;
    std::array<std::uint32_t, 2> ends_;
    glm::dvec3 middle_;
    double length2_ = 0.0;
    Quadric volumes_; ///< Squares of six times the volumes that triangles sweep.
    Quadric areas_;   ///< Squares of twice the areas that edges of the boundary sweep.
    Quadric amid_;    ///< Squared distances to the neighbours.
    glm::dvec3 normal_{0.0};
    double offset_ = 0.0;
    glm::dvec3 boundary_edge_{0.0};
    glm::dvec3 boundary_moment_{0.0};
    bool on_boundary_ = false;
};

} // namespace

Placement
volume_placement(const WorkingSurface& surface, HalfEdge edge, std::span<const RingFace> ring) {
    Around around(surface, edge);
    around.add(face_of(edge));
    if (surface.mesh.twin(edge) != none) {
        around.add(face_of(surface.mesh.twin(edge)));
    }
    for (const RingFace& face : ring) {
        around.add(face.face);
        around.add_neighbour(surface.mesh.target(face.half_edge));
    }
    return around.placement();
}

} // namespace octant::models::simplify
