#include "models/polygons/obj_polygons.h"

#include "models/polygons/convex_pieces.h"
#include "models/polygons/polygon_check.h"
#include "models/polygons/polygon_triangulation.h"
#include "sim/base/error.h"

#include <array>
#include <cassert>
#include <fmt/format.h>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::polygons {

namespace {

using CornerVertices = std::vector<std::uint32_t>;

class PolygonCutting {
public:
    PolygonCutting(
        PolygonModel& model, const std::filesystem::path& path, std::span<const int> lines)
        : model_(model)
        , path_(path)
        , lines_(lines)
        , tolerance_m_(flatness_tolerance_m(model)) {}

    void cut() {
        const std::vector<Polygon> polygons = std::exchange(model_.polygons, {});
        const CornerVertices corner_vertices = std::exchange(model_.corner_vertices, {});
        std::vector<std::uint32_t> parents;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const auto corners = std::span(corner_vertices)
                                     .subspan(polygons[i].first_corner, polygons[i].corner_count);
            for (const CornerVertices& piece : pieces_of(corners, lines_[i])) {
                add(polygons[i], piece);
                parents.push_back(static_cast<std::uint32_t>(i));
            }
        }
        if (changed_polygons_ > 0) {
            model_.parents = std::move(parents);
        }
        if (changed_polygons_ > max_notes_of_cuts) {
            model_.notes.push_back(fmt::format(
                "{}: {} more polygons are dented, bent or without an area",
                path_.string(),
                changed_polygons_ - max_notes_of_cuts));
        }
        if (model_.polygons.empty()) {
            throw_error_in(path_, "expected at least one polygon with an area, got none");
        }
    }

private:
    std::vector<CornerVertices> pieces_of(std::span<const std::uint32_t> corners, int line) {
        const CornerVertices outline = different_corners(corners);
        if (outline.size() < 3 || !has_area(outline)) {
            note(line, corners.size(), "has no area: left out");
            return {};
        }
        if (!corners_fault(places_m_, tolerance_m_)) {
            return {outline};
        }
        const bool planar = is_planar(places_m_, tolerance_m_);
        const std::size_t count = outline.size();
        std::vector<CornerVertices> pieces;
        const ConvexPieces convex = convex_pieces(places_m_, tolerance_m_);
        for (const std::vector<std::size_t>& places : convex.pieces) {
            CornerVertices& piece = pieces.emplace_back();
            for (const std::size_t place : places) {
                piece.push_back(outline[place]);
            }
        }
        const std::string_view fault = planar ? "dented" : "bent";
        if (convex.fault.empty()) {
            note(line, count, fmt::format("is {}: cut into {}", fault, pieces.size()));
        } else {
            pieces = triangles_of(outline);
            note(line, count, fmt::format("meets itself: drawn as {} triangles", pieces.size()));
        }
        return pieces;
    }

    /// The corners without those in the place of the one before; their places in places_m_.
    CornerVertices different_corners(std::span<const std::uint32_t> corners) {
        CornerVertices outline;
        places_m_.clear();
        for (const std::uint32_t vertex : corners) {
            const glm::dvec3& place_m = model_.vertices_m[vertex];
            if (places_m_.empty() || places_m_.back() != place_m) {
                outline.push_back(vertex);
                places_m_.push_back(place_m);
            }
        }
        while (places_m_.size() > 1 && places_m_.back() == places_m_.front()) {
            outline.pop_back();
            places_m_.pop_back();
        }
        return outline;
    }

    bool has_area(const CornerVertices& outline) {
        places_m_.clear();
        for (const std::uint32_t vertex : outline) {
            places_m_.push_back(model_.vertices_m[vertex]);
        }
        return !is_line(places_m_);
    }

    /// An outline whose sides meet, such as one that a doubled side leads around a hole: its
    /// triangles that have an area.
    std::vector<CornerVertices> triangles_of(const CornerVertices& outline) {
        std::vector<CornerVertices> triangles;
        for (const auto& [a, b, c] : triangulate_polygon(places_m_)) {
            if (!is_line(std::array{places_m_[a], places_m_[b], places_m_[c]})) {
                triangles.push_back({outline[a], outline[b], outline[c]});
            }
        }
        return triangles;
    }

    void note(int line, std::size_t corners, std::string_view what) {
        if (++changed_polygons_ <= max_notes_of_cuts) {
            model_.notes.push_back(fmt::format(
                "{}:{}: polygon of {} corners {}", path_.string(), line, corners, what));
        }
    }

    void add(Polygon polygon, const CornerVertices& outline) {
        polygon.first_corner = static_cast<std::uint32_t>(model_.corner_vertices.size());
        polygon.corner_count = static_cast<std::uint32_t>(outline.size());
        model_.polygons.push_back(polygon);
        model_.corner_vertices.insert(model_.corner_vertices.end(), outline.begin(), outline.end());
    }

    PolygonModel& model_;
    const std::filesystem::path& path_;
    std::span<const int> lines_;
    double tolerance_m_;
    std::vector<glm::dvec3> places_m_; ///< corners of the polygon at hand
    std::size_t changed_polygons_ = 0;
};

} // namespace

void triangulate_faulty_polygons(
    PolygonModel& model, const std::filesystem::path& path, std::span<const int> lines) {
    assert(lines.size() == model.polygons.size());
    PolygonCutting(model, path, lines).cut();
}

} // namespace octant::models::polygons
