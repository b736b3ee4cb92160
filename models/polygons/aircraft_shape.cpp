// The likeliest axes of an aircraft. Its surface is drawn into a grid of 64 cells along each side of its bounding box,
// so that every axis is seen equally well, and each of the 24 ways to turn it is given a score: a sum of natural
// logarithms, one for each thing that aircraft have in common.
#include "models/polygons/aircraft_shape.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::models::polygons {

namespace {

constexpr int side = 64;

/// A set of cells of the grid.
class CellSet {
public:
    CellSet() : taken_(static_cast<std::size_t>(side) * side * side, false) {}

    static bool is_inside(const glm::ivec3& cell) {
        return std::min({cell.x, cell.y, cell.z}) >= 0 && std::max({cell.x, cell.y, cell.z}) < side;
    }

    bool has(const glm::ivec3& cell) const { return is_inside(cell) && taken_[index(cell)]; }

    void set(const glm::ivec3& cell, bool taken) { taken_[index(cell)] = taken; }

    /// Ascending.
    std::vector<glm::ivec3> cells() const {
        std::vector<glm::ivec3> all;
        for (int z = 0; z < side; ++z) {
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x) {
                    if (taken_[index({x, y, z})]) { all.emplace_back(x, y, z); }
                }
            }
        }
        return all;
    }

private:
    static std::size_t index(const glm::ivec3& cell) {
        return static_cast<std::size_t>((cell.z * side + cell.y) * side + cell.x);
    }

    std::vector<bool> taken_;
};

/// Calls `visit(cell)` for a cell and all others within `reach` cells.
template <typename Visit>
void for_each_near(const glm::ivec3& cell, int reach, const Visit& visit) {
    for (int z = -reach; z <= reach; ++z) {
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) { visit(cell + glm::ivec3(x, y, z)); }
        }
    }
}

/// The cells that a surface touches, and where they lie.
struct CellShape {
    std::vector<glm::ivec3> cells;
    glm::dvec3 first_m{0.0}; ///< the corner of cell 0, 0, 0
    glm::dvec3 cell_m{0.0};  ///< the extent of a cell
};

/// The corners of a triangle, in cells.
using CellCorners = std::array<glm::dvec3, 3>;

/// Into how many steps a side of a triangle is divided so that points lie half a cell apart.
int steps_of(const CellCorners& corners) {
    const auto largest = [](const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    const auto& [a, b, c] = corners;
    const double longest = std::max({largest(a - b), largest(b - c), largest(c - a)});
    return 1 + static_cast<int>(2.0 * std::min(longest, 2.0 * side));
}

/// Touches the cells of points on a triangle.
void touch(const CellCorners& corners, int steps, CellSet& touched) {
    const auto& [a, b, c] = corners;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
            const glm::dvec3 point =
                a + (b - a) * (static_cast<double>(i) / steps) + (c - a) * (static_cast<double>(j) / steps);
            const glm::dvec3 clamped = glm::clamp(point, -1.0, double{side});
            const glm::ivec3 cell(glm::floor(clamped));
            if (CellSet::is_inside(cell)) { touched.set(cell, true); }
        }
    }
}

CellShape cells_of(const TriangleMesh& mesh, const BoundingBox& bounds) {
    constexpr double least_share = 1e-6; // a flat mesh has an extent all the same
    constexpr double most_points = 5e7;
    const glm::dvec3 extent_m = bounds.max_m - bounds.min_m;
    const double longest_m = std::max({extent_m.x, extent_m.y, extent_m.z});
    CellShape shape;
    shape.first_m = bounds.min_m;
    shape.cell_m = glm::max(extent_m, least_share * longest_m) * (1.0 + 1e-9) / double{side};
    const auto in_cells = [&](const Triangle& triangle) {
        CellCorners corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners.at(k) = (mesh.vertices_m[triangle.at(k)] - shape.first_m) / shape.cell_m;
        }
        return corners;
    };
    // Where many triangles are as large as the whole, fewer points of each do.
    double points = 0.0;
    for (const Triangle& triangle : mesh.triangles) {
        const double steps = steps_of(in_cells(triangle));
        points += 0.5 * steps * steps;
    }
    const double share = std::min(1.0, std::sqrt(most_points / std::max(points, 1.0)));
    CellSet touched;
    for (const Triangle& triangle : mesh.triangles) {
        const CellCorners corners = in_cells(triangle);
        touch(corners, std::max(1, static_cast<int>(share * steps_of(corners))), touched);
    }
    shape.cells = touched.cells();
    return shape;
}

/// The groups of cells: in a group each cell is within three of another.
std::vector<std::vector<glm::ivec3>> groups_of(const std::vector<glm::ivec3>& cells) {
    constexpr int reach = 3;
    CellSet left;
    for (const glm::ivec3& cell : cells) { left.set(cell, true); }
    std::vector<std::vector<glm::ivec3>> groups;
    for (const glm::ivec3& seed : cells) {
        if (!left.has(seed)) { continue; }
        std::vector<glm::ivec3>& group = groups.emplace_back(1, seed);
        left.set(seed, false);
        for (std::size_t next = 0; next < group.size(); ++next) {
            for_each_near(glm::ivec3(group[next]), reach, [&](const glm::ivec3& cell) {
                if (left.has(cell)) {
                    left.set(cell, false);
                    group.push_back(cell);
                }
            });
        }
    }
    return groups;
}

/// The cells of those groups that hold at least 3 per cent of all.
std::vector<glm::ivec3> without_strays(const std::vector<glm::ivec3>& cells) {
    constexpr double least_share = 0.03;
    std::vector<glm::ivec3> kept;
    for (const std::vector<glm::ivec3>& group : groups_of(cells)) {
        if (static_cast<double>(group.size()) >= least_share * static_cast<double>(cells.size())) {
            kept.insert(kept.end(), group.begin(), group.end());
        }
    }
    return kept;
}

/// The surface of a mesh, without small parts far from the rest.
CellShape shape_of(const TriangleMesh& mesh) {
    CellShape shape = cells_of(mesh, bounds_of(mesh));
    const std::vector<glm::ivec3> kept = without_strays(shape.cells);
    if (kept.empty() || kept.size() == shape.cells.size()) { return shape; }
    glm::ivec3 least(side);
    glm::ivec3 most(-1);
    for (const glm::ivec3& cell : kept) {
        least = glm::min(least, cell);
        most = glm::max(most, cell);
    }
    return cells_of(
        mesh, {shape.first_m + glm::dvec3(least) * shape.cell_m, shape.first_m + glm::dvec3(most + 1) * shape.cell_m});
}

/// The value that a share of all values are below; reorders them. 0 without values.
double percentile(std::vector<double>& values, double share) {
    if (values.empty()) { return 0.0; }
    const auto at = static_cast<std::ptrdiff_t>(
        std::min(share * static_cast<double>(values.size()), static_cast<double>(values.size() - 1)));
    std::ranges::nth_element(values, values.begin() + at);
    return values[static_cast<std::size_t>(at)];
}

double clipped(double value, double most = 1.0) { return std::clamp(value, -most, most); }

struct CellRange {
    int first = 0;
    int last = 0;
};

CellRange range_along(const std::vector<glm::ivec3>& cells, int axis) {
    CellRange range{side, -1};
    for (const glm::ivec3& cell : cells) {
        range.first = std::min(range.first, cell[axis]);
        range.last = std::max(range.last, cell[axis]);
    }
    return range;
}

/// The share of the cells that have another within a cell of their mirrored place, for the best plane near the middle.
double symmetry(const std::vector<glm::ivec3>& cells, int axis) {
    constexpr int farthest = 6;
    CellSet near;
    for (const glm::ivec3& cell : cells) {
        for_each_near(cell, 1, [&](const glm::ivec3& at) {
            if (CellSet::is_inside(at)) { near.set(at, true); }
        });
    }
    const CellRange range = range_along(cells, axis);
    std::size_t best = 0;
    for (int off = -farthest; off <= farthest; ++off) {
        std::size_t mirrored = 0;
        for (glm::ivec3 cell : cells) {
            cell[axis] = range.first + range.last - cell[axis] + off;
            mirrored += near.has(cell) ? 1U : 0U;
        }
        best = std::max(best, mirrored);
    }
    return cells.empty() ? 0.0 : static_cast<double>(best) / static_cast<double>(cells.size());
}

/// A shape with its top towards one end of an axis: without the rotor on top, where it has one.
struct UprightShape {
    std::vector<glm::ivec3> cells;
    std::optional<glm::dvec3> hub; ///< of the rotor, in cells
    std::array<double, 3> symmetry{};
};

/// The rotor of a shape whose top is towards one end of an axis: as wide as it is long, with hardly anything above it,
/// the largest group of the cells above a share of the height. Empty where there is none.
std::vector<glm::ivec3> rotor_above(const CellShape& shape, int height, bool is_flipped, double share) {
    constexpr double least_spread = 0.45; // of the longest side
    constexpr double least_body = 0.25;   // of all cells
    std::vector<glm::ivec3> highest;
    for (const glm::ivec3& cell : shape.cells) {
        const int above = is_flipped ? side - 1 - cell[height] : cell[height];
        if (above >= share * side) { highest.push_back(cell); }
    }
    const auto groups = groups_of(highest);
    if (groups.empty()) { return {}; }
    const std::vector<glm::ivec3>& top = *std::ranges::max_element(groups, {}, &std::vector<glm::ivec3>::size);
    if (static_cast<double>(shape.cells.size() - top.size()) < least_body * static_cast<double>(shape.cells.size())) {
        return {};
    }
    const glm::dvec3 extent_m = shape.cell_m * double{side};
    const double longest_m = std::max(extent_m[(height + 1) % 3], extent_m[(height + 2) % 3]);
    for (int k = 0; k < 3; ++k) {
        std::vector<double> places;
        for (const glm::ivec3& cell : top) { places.push_back(cell[k] + 0.5); }
        const double spread = percentile(places, 0.97) - percentile(places, 0.03);
        if (k != height && spread * shape.cell_m[k] < least_spread * longest_m) { return {}; }
    }
    return top;
}

UprightShape upright(const CellShape& shape, int height, bool is_flipped) {
    constexpr double rotor_from = 0.85;
    std::vector<glm::ivec3> top = rotor_above(shape, height, is_flipped, rotor_from);
    if (top.empty()) { // a mast may stand above the blades
        constexpr double blades_from = 0.78;
        constexpr double most_mast = 0.1; // of the blades
        top = rotor_above(shape, height, is_flipped, blades_from);
        const auto above = std::ranges::count_if(shape.cells, [&](const glm::ivec3& cell) {
            return (is_flipped ? side - 1 - cell[height] : cell[height]) >= rotor_from * side;
        });
        if (static_cast<double>(above) > most_mast * static_cast<double>(top.size())) { top.clear(); }
    }
    if (top.empty()) { return {shape.cells, std::nullopt, {}}; }
    CellSet rotor;
    glm::dvec3 hub(0.0);
    for (const glm::ivec3& cell : top) {
        rotor.set(cell, true);
        hub += (glm::dvec3(cell) + 0.5) / static_cast<double>(top.size());
    }
    UprightShape body{{}, hub, {}};
    std::ranges::copy_if(
        shape.cells, std::back_inserter(body.cells), [&](const glm::ivec3& cell) { return !rotor.has(cell); });
    return body;
}

/// A point of the surface: metres from the tail, from the mirror plane and from the lowest point.
struct SurfacePoint {
    double along = 0.0;
    double across = 0.0;
    double up = 0.0;
};

/// Which way an aircraft is turned in its file.
struct Turn {
    int length = 0;
    int height = 1;
    int lateral = 2;
    bool is_nose_low = false; ///< the nose is at the axis's negative end
    bool is_upside_down = false;
};

/// An aircraft seen from a turn: its points, and its length, half its span and its height.
class TurnedShape {
public:
    TurnedShape(const CellShape& shape, const UprightShape& body, const Turn& turn)
        : length_m_(extent(shape, body, turn.length)), half_span_m_(0.5 * extent(shape, body, turn.lateral)),
          height_m_(extent(shape, body, turn.height)) {
        const CellRange lengths = range_along(body.cells, turn.length);
        const CellRange spans = range_along(body.cells, turn.lateral);
        const CellRange heights = range_along(body.cells, turn.height);
        const auto place = [&](double cell, int axis, const CellRange& range, bool is_flipped) {
            return shape.cell_m[axis] * (is_flipped ? range.last + 1 - cell : cell - range.first);
        };
        for (const glm::ivec3& cell : body.cells) {
            points_.push_back({place(cell[turn.length] + 0.5, turn.length, lengths, turn.is_nose_low),
                place(cell[turn.lateral] + 0.5, turn.lateral, spans, false) - half_span_m_,
                place(cell[turn.height] + 0.5, turn.height, heights, turn.is_upside_down)});
        }
        if (body.hub) {
            hub_m_ = place((*body.hub)[turn.length], turn.length, lengths, turn.is_nose_low);
        } else {
            level();
        }
    }

    double score() const {
        constexpr double fin = 7.0;
        const double tailplane = hub_m_ ? -1.0 : 3.0; // the tail of a helicopter is narrower than its cabin
        return fin * fin_height() + tailplane * tail_width() + wing_score() + 3.0 * flatness() + 0.5 * front_bulk() +
               rotor_score();
    }

private:
    static double extent(const CellShape& shape, const UprightShape& body, int axis) {
        const CellRange range = range_along(body.cells, axis);
        return shape.cell_m[axis] * std::max(range.last + 1 - range.first, 1);
    }

    /// Aircraft that stand on a tail wheel are levelled, by the line through the middle of the fuselage.
    void level() {
        constexpr int bins = 16;
        constexpr double steepest = 0.25;
        std::array<std::vector<double>, bins> heights;
        for (const SurfacePoint& point : points_) {
            const auto bin = std::min(static_cast<std::size_t>(point.along / length_m_ * bins), std::size_t{bins - 1});
            if (std::abs(point.across) < 0.12 * half_span_m_) { heights.at(bin).push_back(point.up); }
        }
        std::vector<std::pair<double, double>> line;
        for (std::size_t bin = 2; bin + 2 < bins; ++bin) {
            if (heights.at(bin).empty()) { continue; }
            line.emplace_back((static_cast<double>(bin) + 0.5) / bins * length_m_, percentile(heights.at(bin), 0.5));
        }
        const double slope = clipped(slope_of(line), steepest);
        for (SurfacePoint& point : points_) { point.up -= slope * (point.along - 0.5 * length_m_); }
    }

    /// Of the line of least squares; 0 for fewer than four points.
    static double slope_of(const std::vector<std::pair<double, double>>& line) {
        if (line.size() < 4) { return 0.0; }
        const auto count = static_cast<double>(line.size());
        double mean_x = 0.0;
        double mean_y = 0.0;
        for (const auto& [x, y] : line) {
            mean_x += x / count;
            mean_y += y / count;
        }
        double products = 0.0;
        double squares = 0.0;
        for (const auto& [x, y] : line) {
            products += (x - mean_x) * (y - mean_y);
            squares += (x - mean_x) * (x - mean_x);
        }
        return squares > 0.0 ? products / squares : 0.0;
    }

    /// Some value of the points near one end; propellers and probes at the very end do not count.
    template <typename Value>
    std::vector<double> values_near(bool tail, const Value& value) const {
        constexpr double from = 0.05;
        constexpr double to = 0.22;
        std::vector<double> values;
        for (const SurfacePoint& point : points_) {
            const double share = (tail ? point.along : length_m_ - point.along) / length_m_;
            if (share > from && share < to) { values.push_back(value(point)); }
        }
        return values;
    }

    /// How much farther the tail reaches up than the nose does, and than it reaches down.
    double fin_height() const {
        const auto height = [](const SurfacePoint& point) { return point.up; };
        std::vector<double> all;
        for (const SurfacePoint& point : points_) { all.push_back(point.up); }
        const double middle_m = percentile(all, 0.5);
        std::vector<double> tail = values_near(true, height);
        std::vector<double> nose = values_near(false, height);
        if (tail.empty() || nose.empty()) { return 0.0; }
        const double up_m = percentile(tail, 0.98) - middle_m;
        const double down_m = middle_m - percentile(tail, 0.02);
        return clipped((up_m - std::max(percentile(nose, 0.98) - middle_m, down_m)) / height_m_);
    }

    /// How much wider the tail is than the nose.
    double tail_width() const {
        const auto width = [](const SurfacePoint& point) { return std::abs(point.across); };
        std::vector<double> tail = values_near(true, width);
        std::vector<double> nose = values_near(false, width);
        if (tail.empty() || nose.empty()) { return 0.0; }
        return clipped((percentile(tail, 0.97) - percentile(nose, 0.97)) / half_span_m_);
    }

    /// One chord of the wing: where its middle lies, and the wing's height there.
    struct Chord {
        double across = 0.0;
        double along = 0.0;
        double up = 0.0;
    };

    /// The wing, followed from its tip inwards: other surfaces beside it do not count.
    std::vector<Chord> wing() const {
        constexpr int bins = 24;
        constexpr int innermost = 8;
        std::array<std::vector<SurfacePoint>, bins> slices;
        for (const SurfacePoint& point : points_) {
            const auto bin = static_cast<std::size_t>(std::abs(point.across) / half_span_m_ * bins);
            if (bin < bins) { slices.at(bin).push_back(point); }
        }
        std::vector<Chord> chords;
        CellSpan before;
        for (int bin = bins - 2; bin > innermost; --bin) {
            std::vector<SurfacePoint>& slice = slices.at(static_cast<std::size_t>(bin));
            if (slice.empty()) { continue; }
            const CellSpan span = followed(slice, before);
            std::vector<double> heights;
            for (const SurfacePoint& point : slice) {
                if (point.along >= span.first && point.along <= span.last) { heights.push_back(point.up); }
            }
            chords.push_back(
                {(bin + 0.5) / bins * half_span_m_, 0.5 * (span.first + span.last), percentile(heights, 0.5)});
            before = span;
        }
        return chords;
    }

    struct CellSpan {
        double first = 0.0;
        double last = -1.0; ///< below first: none
    };

    /// Of the pieces of a slice that gaps divide, the one that overlaps most with the one before, or else the one with
    /// most points. Sorts the slice.
    CellSpan followed(std::vector<SurfacePoint>& slice, const CellSpan& before) const {
        const double gap_m = 0.035 * length_m_;
        std::ranges::sort(slice, {}, &SurfacePoint::along);
        CellSpan best;
        double best_value = -std::numeric_limits<double>::infinity();
        for (std::size_t first = 0; first < slice.size();) {
            std::size_t last = first;
            while (last + 1 < slice.size() && slice[last + 1].along - slice[last].along <= gap_m) { ++last; }
            const CellSpan span{slice[first].along, slice[last].along};
            const double overlap = std::min(span.last, before.last) - std::max(span.first, before.first);
            const double value = before.last < before.first ? static_cast<double>(last - first) : overlap;
            if (value > best_value) {
                best = span;
                best_value = value;
            }
            first = last + 1;
        }
        return best;
    }

    /// Wings are swept back, bent up and rather ahead of the middle.
    double wing_score() const {
        const std::vector<Chord> chords = hub_m_ ? std::vector<Chord>() : wing(); // of a helicopter they are stubs
        if (chords.empty()) { return 0.0; }
        std::vector<std::pair<double, double>> sweep;
        std::vector<std::pair<double, double>> bend;
        double along_m = 0.0;
        for (const Chord& chord : chords) {
            sweep.emplace_back(chord.across, chord.along);
            bend.emplace_back(chord.across, chord.up);
            along_m += chord.along / static_cast<double>(chords.size());
        }
        const double ahead = clipped((along_m / length_m_ - 0.5) / 0.15);
        return 3.0 * clipped(-slope_of(sweep) / 0.4) + 0.7 * clipped(slope_of(bend) / 0.1) + 1.5 * ahead;
    }

    double flatness() const { return clipped(std::log(length_m_ / height_m_), 1.2); }

    /// What is near the mirror plane lies rather ahead of the middle.
    double front_bulk() const {
        double sum = 0.0;
        double count = 0.0;
        for (const SurfacePoint& point : points_) {
            if (std::abs(point.across) < 0.15 * half_span_m_) {
                sum += point.along;
                count += 1.0;
            }
        }
        return count > 0.0 ? clipped((sum / count / length_m_ - 0.5) / 0.1) : 0.0;
    }

    /// A rotor is on top, above the cabin.
    double rotor_score() const { return hub_m_ ? 0.7 + 2.7 * clipped((*hub_m_ / length_m_ - 0.5) * 4.0) : 0.0; }

    std::vector<SurfacePoint> points_;
    double length_m_;
    double half_span_m_;
    double height_m_;
    std::optional<double> hub_m_;
};

/// Where parts with telling names are: 1 ahead or on top, -1 behind or below, 0: the name does not say.
struct TellingWord {
    std::string_view part_of_name;
    double ahead = 0.0;
    double above = 0.0;
};

constexpr std::array telling_words{TellingWord{"canopy", 1.0, 1.0}, TellingWord{"cockpit", 1.0, 0.0},
    TellingWord{"windshield", 1.0, 1.0}, TellingWord{"windscreen", 1.0, 1.0}, TellingWord{"glass", 1.0, 1.0},
    TellingWord{"spinner", 1.0, 0.0}, TellingWord{"radome", 1.0, 0.0}, TellingWord{"pilot", 1.0, 0.0},
    TellingWord{"nose", 1.0, 0.0}, TellingWord{"rudder", -1.0, 1.0}, TellingWord{"elevator", -1.0, 0.0},
    TellingWord{"exhaust", -1.0, 0.0}, TellingWord{"nozzle", -1.0, 0.0}, TellingWord{"afterburner", -1.0, 0.0},
    TellingWord{"tail", -1.0, 0.0}, TellingWord{"tyre", 0.0, -1.0}, TellingWord{"tire", 0.0, -1.0},
    TellingWord{"wheel", 0.0, -1.0}, TellingWord{"gear", 0.0, -1.0}};

/// A direction in which the names of materials say that nose or top lies: file axes, as long as the mean offset of
/// these materials from the middle, in half extents of the bounding box.
struct NamedDirections {
    glm::dvec3 nose{0.0};
    glm::dvec3 top{0.0};
};

NamedDirections named_directions(const TriangleMesh& mesh, const CellShape& shape) {
    std::vector<glm::dvec3> sums(mesh.materials.size(), glm::dvec3(0.0));
    std::vector<double> areas(mesh.materials.size(), 0.0);
    for (std::size_t t = 0; t < mesh.triangle_materials.size(); ++t) {
        const Triangle& corners = mesh.triangles[t];
        const double area = glm::length(area_vector(mesh, corners));
        const glm::dvec3 middle_m =
            (mesh.vertices_m[corners[0]] + mesh.vertices_m[corners[1]] + mesh.vertices_m[corners[2]]) / 3.0;
        sums[mesh.triangle_materials[t]] += area * middle_m;
        areas[mesh.triangle_materials[t]] += area;
    }
    NamedDirections found;
    double nose_count = 0.0;
    double top_count = 0.0;
    for (std::size_t m = 0; m < sums.size(); ++m) {
        if (!(areas[m] > 0.0)) { continue; }
        std::string name = mesh.materials[m].name;
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        const auto word = std::ranges::find_if(
            telling_words, [&](const TellingWord& one) { return name.find(one.part_of_name) != name.npos; });
        if (word == telling_words.end()) { continue; }
        const glm::dvec3 off =
            glm::clamp(2.0 * (sums[m] / areas[m] - shape.first_m) / (shape.cell_m * double{side}) - 1.0, -1.0, 1.0);
        found.nose += word->ahead * off;
        found.top += word->above * off;
        nose_count += std::abs(word->ahead);
        top_count += std::abs(word->above);
    }
    found.nose /= std::max(nose_count, 1.0);
    found.top /= std::max(top_count, 1.0);
    return found;
}

/// A unit vector along an axis.
glm::dvec3 along(int axis, bool is_negative) {
    glm::dvec3 direction(0.0);
    direction[axis] = is_negative ? -1.0 : 1.0;
    return direction;
}

FileAxes axes_of(const Turn& turn) {
    const glm::dvec3 right = glm::cross(along(turn.length, turn.is_nose_low), along(turn.height, turn.is_upside_down));
    std::array<std::string_view, 3> names;
    names.at(static_cast<std::size_t>(turn.length)) = turn.is_nose_low ? "back" : "forward";
    names.at(static_cast<std::size_t>(turn.height)) = turn.is_upside_down ? "down" : "up";
    names.at(static_cast<std::size_t>(turn.lateral)) = right[turn.lateral] > 0.0 ? "right" : "left";
    return FileAxes::from_text(fmt::format("{},{},{}", names[0], names[1], names[2]));
}

struct ScoredTurn {
    Turn turn;
    double shape = 0.0;
    double hints = 0.0;

    double score() const { return shape + hints; }
};

double score_of(const Turn& turn, std::span<const AxesHint> hints) {
    double sum = 0.0;
    for (const AxesHint& hint : hints) {
        const glm::dvec3 direction = hint.subject == AxesHint::Subject::Top ? along(turn.height, turn.is_upside_down)
                                                                            : along(turn.length, turn.is_nose_low);
        sum += glm::dot(direction, hint.towards) > 0.5 ? hint.weight : 0.0;
    }
    return sum;
}

std::vector<ScoredTurn> scored_turns(
    const CellShape& shape, const NamedDirections& named, std::span<const AxesHint> hints) {
    constexpr double symmetry_weight = 12.0;
    constexpr double name_weight = 4.0;
    std::vector<ScoredTurn> turns;
    for (int height = 0; height < 3; ++height) {
        for (const bool is_upside_down : {false, true}) {
            UprightShape body = upright(shape, height, is_upside_down);
            for (int k = 0; k < 3; ++k) { body.symmetry.at(static_cast<std::size_t>(k)) = symmetry(body.cells, k); }
            for (int number = 0; number < 4; ++number) {
                const int length = (height + 1 + number / 2) % 3;
                const Turn turn{length, height, 3 - height - length, number % 2 == 1, is_upside_down};
                const double nose = glm::dot(along(length, turn.is_nose_low), named.nose);
                const double top = glm::dot(along(height, is_upside_down), named.top);
                ScoredTurn scored{turn, TurnedShape(shape, body, turn).score(), score_of(turn, hints)};
                scored.shape += symmetry_weight * body.symmetry.at(static_cast<std::size_t>(turn.lateral)) +
                                name_weight * (clipped(1.5 * nose) + 0.5 * clipped(1.5 * top));
                turns.push_back(scored);
            }
        }
    }
    return turns;
}

} // namespace

std::optional<AxesGuess> guess_axes(const TriangleMesh& mesh, std::span<const AxesHint> hints) {
    const double diagonal = mesh.triangles.empty() ? 0.0 : diagonal_m(mesh);
    if (!(diagonal > 0.0) || !std::isfinite(diagonal)) { return std::nullopt; }
    const CellShape shape = shape_of(mesh);
    std::vector<ScoredTurn> turns = scored_turns(shape, named_directions(mesh, shape), hints);
    std::ranges::stable_sort(turns, std::ranges::greater(), &ScoredTurn::score);
    const ScoredTurn& best = turns.front();
    const auto turned = std::ranges::find_if(turns, [&](const ScoredTurn& other) {
        return other.turn.length == best.turn.length && other.turn.height == best.turn.height &&
               other.turn.is_upside_down == best.turn.is_upside_down && other.turn.is_nose_low != best.turn.is_nose_low;
    });
    return AxesGuess{axes_of(best.turn), best.score() - turns[1].score(), best.shape - turned->shape};
}

} // namespace octant::models::polygons
