#include "models/polygons/obj_polygons.h"

#include "models/polygons/convex_pieces.h"
#include "models/polygons/polygon_check.h"
#include "sim/base/error.h"

#include <cassert>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace octant::models::polygons {

namespace {

using Outline = std::vector<std::uint32_t>;

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
        const Outline corner_vertices = std::exchange(model_.corner_vertices, {});
        std::vector<std::uint32_t> parents;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const auto corners = std::span(corner_vertices)
                                     .subspan(polygons[i].first_corner, polygons[i].corner_count);
            for (const Outline& piece : pieces_of(corners, lines_[i])) {
                add(polygons[i], piece);
                parents.push_back(static_cast<std::uint32_t>(i));
            }
        }
        if (cut_polygons_ > 0) {
            model_.parents = std::move(parents);
        }
        if (cut_polygons_ > most_notes_of_cuts) {
            model_.notes.push_back(fmt::format(
                "{}: {} more polygons are dented or bent: cut into {}",
                path_.string(),
                cut_polygons_ - most_notes_of_cuts,
                pieces_not_noted_));
        }
    }

private:
    std::vector<Outline> pieces_of(std::span<const std::uint32_t> corners, int line) {
        places_m_.clear();
        for (const std::uint32_t vertex : corners) {
            places_m_.push_back(model_.vertices_m[vertex]);
        }
        if (!corners_fault(places_m_, tolerance_m_)) {
            return {{corners.begin(), corners.end()}};
        }
        const ConvexPieces convex = convex_pieces(places_m_, tolerance_m_);
        if (!convex.fault.empty()) {
            error_at(path_, line, convex.fault);
        }
        std::vector<Outline> pieces;
        for (const std::vector<std::size_t>& places : convex.pieces) {
            Outline& piece = pieces.emplace_back();
            for (const std::size_t place : places) {
                piece.push_back(corners[place]);
            }
        }
        note(line, pieces.size());
        return pieces;
    }

    void note(int line, std::size_t pieces) {
        if (++cut_polygons_ > most_notes_of_cuts) {
            pieces_not_noted_ += pieces;
            return;
        }
        model_.notes.push_back(fmt::format(
            "{}:{}: polygon of {} corners is {}: cut into {}",
            path_.string(),
            line,
            places_m_.size(),
            is_planar(places_m_, tolerance_m_) ? "dented" : "bent",
            pieces));
    }

    void add(Polygon polygon, const Outline& outline) {
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
    std::size_t cut_polygons_ = 0;
    std::size_t pieces_not_noted_ = 0;
};

} // namespace

void cut_faulty_polygons(
    PolygonModel& model, const std::filesystem::path& path, std::span<const int> lines) {
    assert(lines.size() == model.polygons.size());
    PolygonCutting(model, path, lines).cut();
}

} // namespace octant::models::polygons
