#pragma once

#include "models/planar/planar_model.h"
#include "models/polygons/polygon_model.h"
#include "sim/base/plane.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace octant::visuals::bsp {

/// Lengths below this are rounding, in the unit of PolygonPieces: about the radius of the model. A point within this
/// distance of a plane lies on it.
inline constexpr double tolerance = models::planar::planar_tolerance;

/// A polygon, a piece of one, or what a turning polygon sweeps.
struct PolygonPiece {
    std::vector<std::uint32_t> corners; ///< Vertices of PolygonPieces; of a body in any order.
    /// That of the whole polygon, its front where it is seen from; a body has none.
    std::optional<Plane> plane;
    std::optional<std::uint32_t> pivot; ///< What turns it. It is never cut then.
    std::uint32_t source = 0;           ///< The polygon of the model.
    glm::dvec3 middle{0.0};             ///< The centre of a bounding sphere.
    double radius = 0.0;
};

/// Where a piece reaches: beyond the tolerance before a plane, behind it, or both; neither when it lies in the plane.
struct PlaneSideFlags {
    bool before = false;
    bool behind = false;
};

/// The polygons of a model while they are cut into pieces. Pieces keep the planes of their polygons, so that thin ones
/// are as exact as large ones, and vertices on one edge of the model are shared by all pieces along it. The unit is
/// half the diagonal of the model's bounding box, and its centre is the origin.
class PolygonPieces {
public:
    /// Piece i is polygon i. A polygon that is not planar becomes triangles unless it turns: the first keeps the
    /// number, the others follow behind all polygons.
    explicit PolygonPieces(const models::polygons::PolygonModel& model);

    std::size_t count() const { return pieces_.size(); }

    const PolygonPiece& operator[](std::size_t piece) const { return pieces_[piece]; }

    const glm::dvec3& at(std::uint32_t vertex) const { return vertices_[vertex].at; }

    /// How many pieces were added since the start.
    std::size_t added() const { return pieces_.size() - first_count_; }

    /// Which pieces those from number `first` on, which were added, were cut from. They share their planes.
    std::span<const std::uint32_t> cut_from(std::size_t first) const {
        return std::span(cut_from_).subspan(first - first_count_);
    }

    /// Makes a piece stand for what its polygon sweeps: corners in body axes, metres. A body (`is_body`) has no plane.
    void set_swept_hull(std::uint32_t piece, std::uint32_t pivot, std::span<const glm::dvec3> corners_m, bool is_body);

    /// Gives a piece another plane, in body axes, metres: that of the polygon of which it is a sliver.
    void set_plane(std::uint32_t piece, const Plane& in_model);

    /// States that a piece hides part of another one of the same pivot at some angle. Other pieces of one pivot do not
    /// hide one another.
    void add_rigid(std::uint32_t occluder, std::uint32_t occluded);

    bool is_rigid(std::uint32_t occluder, std::uint32_t occluded) const;

    /// Cuts a piece that reaches to both sides of a plane (asserted), in this unit. The part in front keeps the number;
    /// that of the part behind is returned.
    std::uint32_t cut(std::uint32_t piece, const Plane& plane);

    PlaneSideFlags sides_reached(std::uint32_t piece, const Plane& plane) const;

    /// Writes the pieces into the model that they were made of: polygon i becomes piece i, the others are appended, and
    /// vertices on an edge become corners of all polygons along it, so that no crack opens. Nothing changes where
    /// nothing was cut.
    void write_to(models::polygons::PolygonModel& model) const;

    /// Converts a plane to body axes, metres.
    Plane in_model(const Plane& plane) const;

private:
    static constexpr std::uint32_t no_edge = ~std::uint32_t{0};

    /// A vertex of the model, or one that a cut has made on an edge.
    struct Vertex {
        glm::dvec3 at{0.0};
        std::uint32_t edge = no_edge;
        double share = 0.0; ///< Of the way along the edge.
        std::uint32_t in_model = 0;
    };

    /// A line between two vertices, and the vertices on it that cuts have made.
    struct Edge {
        std::uint32_t from = 0;
        std::uint32_t to = 0;
        std::vector<std::uint32_t> between;
    };

    Plane plane_of(const PolygonPiece& piece) const;
    void add_triangles(std::uint32_t polygon);
    void find_bounding_sphere(PolygonPiece& piece) const;
    /// The edge that two neighbouring corners lie on.
    std::uint32_t edge_of(std::uint32_t a, std::uint32_t b);
    std::optional<std::uint32_t> find_edge(std::uint32_t a, std::uint32_t b) const;
    double share_of(std::uint32_t vertex, const Edge& edge) const;
    /// The vertex where a plane crosses the edge between two corners.
    std::uint32_t crossing(std::uint32_t a, std::uint32_t b, const Plane& plane);
    /// The corners of a piece, with the vertices between them that cuts have made.
    std::vector<std::uint32_t> full_outline(const PolygonPiece& piece) const;

    glm::dvec3 middle_m_{0.0};
    double unit_m_ = 1.0;
    std::vector<PolygonPiece> pieces_;
    std::size_t first_count_ = 0;
    std::vector<std::uint32_t> cut_from_; ///< For each piece added.
    std::vector<Vertex> vertices_;
    std::vector<Edge> edges_;
    std::unordered_map<std::uint64_t, std::uint32_t> edge_of_ends_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> rigid_;
};

} // namespace octant::visuals::bsp
