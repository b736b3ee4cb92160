#include "models/polygons/file_axes.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace octant::models::polygons {

// The shape of an aircraft as the cells of a grid that its surface touches.

namespace {

constexpr int cells_along = 64; ///< the longest side
/// Shares of the cells that have one in their mirrored place: at least so many, and so many more than for the next
/// plane.
constexpr double min_symmetry = 0.85;
constexpr double symmetry_lead = 0.04;
/// Of an aircraft's length: its height at most, and its span at least.
constexpr double max_height = 0.8;
constexpr double min_span = 0.4;
/// The ends at which a fin is looked for, as a share of the length.
constexpr double end_share = 0.2;
/// By how much the evidence must be stronger than that for any other answer.
constexpr double clear_lead = 1.12;

class Cells {
public:
    explicit Cells(const TriangleMesh& mesh) {
        const BoundingBox bounds = bounds_of(mesh);
        const glm::dvec3 extent_m = bounds.max_m - bounds.min_m;
        size_m_ = std::max({extent_m.x, extent_m.y, extent_m.z}) / (cells_along - 2);
        for (int k = 0; k < 3; ++k) { counts_[k] = static_cast<int>(std::ceil(extent_m[k] / size_m_)) + 2; }
        first_m_ = 0.5 * (bounds.min_m + bounds.max_m) - 0.5 * size_m_ * glm::dvec3(counts_);
        touched_.assign(static_cast<std::size_t>(counts_.x) * static_cast<std::size_t>(counts_.y) *
                            static_cast<std::size_t>(counts_.z),
            false);
        for (const Triangle& triangle : mesh.triangles) {
            touch(mesh.vertices_m[triangle[0]], mesh.vertices_m[triangle[1]], mesh.vertices_m[triangle[2]]);
        }
    }

    const glm::ivec3& counts() const { return counts_; }

    template <typename Take>
    void each(Take&& take) const {
        for (int z = 0; z < counts_.z; ++z) {
            for (int y = 0; y < counts_.y; ++y) {
                for (int x = 0; x < counts_.x; ++x) {
                    if (touched_[index({x, y, z})]) { take(glm::ivec3(x, y, z)); }
                }
            }
        }
    }

    /// The share of the cells whose mirror cell along an axis, or a neighbour of it, is occupied.
    double symmetry(int axis) const {
        std::size_t all = 0;
        std::size_t mirrored = 0;
        each([&](glm::ivec3 cell) {
            cell[axis] = counts_[axis] - 1 - cell[axis];
            ++all;
            mirrored += has_near(cell) ? 1U : 0U;
        });
        return all > 0 ? static_cast<double>(mirrored) / static_cast<double>(all) : 0.0;
    }

private:
    std::size_t index(const glm::ivec3& cell) const {
        return static_cast<std::size_t>((cell.z * counts_.y + cell.y) * counts_.x + cell.x);
    }

    bool has_near(const glm::ivec3& cell) const {
        const glm::ivec3 least = glm::max(cell - 1, glm::ivec3(0));
        const glm::ivec3 most = glm::min(cell + 1, counts_ - 1);
        for (int z = least.z; z <= most.z; ++z) {
            for (int y = least.y; y <= most.y; ++y) {
                for (int x = least.x; x <= most.x; ++x) {
                    if (touched_[index({x, y, z})]) { return true; }
                }
            }
        }
        return false;
    }

    /// Touches the cells of points on a triangle that lie half a cell apart.
    void touch(const glm::dvec3& a_m, const glm::dvec3& b_m, const glm::dvec3& c_m) {
        const double longest_m = std::max({glm::distance(a_m, b_m), glm::distance(b_m, c_m), glm::distance(c_m, a_m)});
        const int steps = 1 + static_cast<int>(2.0 * longest_m / size_m_);
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const glm::dvec3 point_m = a_m + (b_m - a_m) * (static_cast<double>(i) / steps) +
                                           (c_m - a_m) * (static_cast<double>(j) / steps);
                const glm::ivec3 cell((point_m - first_m_) / size_m_);
                touched_[index(glm::clamp(cell, glm::ivec3(0), counts_ - 1))] = true;
            }
        }
    }

    double size_m_ = 1.0;
    glm::dvec3 first_m_{0.0};
    glm::ivec3 counts_{1};
    std::vector<bool> touched_;
};

/// The axis across which a shape is the same left and right; nothing if several or none are.
std::optional<int> lateral_axis(const Cells& cells) {
    const std::array<double, 3> symmetry{cells.symmetry(0), cells.symmetry(1), cells.symmetry(2)};
    const auto best = static_cast<int>(std::ranges::max_element(symmetry) - symmetry.begin());
    for (int k = 0; k < 3; ++k) {
        const double lead = symmetry[static_cast<std::size_t>(best)] - symmetry[static_cast<std::size_t>(k)];
        if (k != best && lead < symmetry_lead) { return std::nullopt; }
    }
    return symmetry[static_cast<std::size_t>(best)] >= min_symmetry ? std::optional(best) : std::nullopt;
}

/// Along the length, 1 or -1: the fin at the tail reaches farther above the mean height than anything at the nose.
std::optional<int> nose_by_fin(const Cells& cells, int length, int height) {
    double sum = 0.0;
    double count = 0.0;
    cells.each([&](const glm::ivec3& cell) {
        sum += cell[height];
        count += 1.0;
    });
    const double mean = sum / std::max(count, 1.0);
    double low = 0.0;
    double high = 0.0;
    const int zone = std::max(2, static_cast<int>(end_share * cells.counts()[length]));
    cells.each([&](const glm::ivec3& cell) {
        const double above = cell[height] - mean;
        if (cell[length] < zone) {
            low = std::max(low, above);
        } else if (cell[length] >= cells.counts()[length] - zone) {
            high = std::max(high, above);
        }
    });
    if (std::max(low, high) < clear_lead * std::min(low, high)) { return std::nullopt; }
    return low > high ? 1 : -1;
}

/// Unit vector along an axis.
glm::dvec3 along(int axis, int sign) {
    glm::dvec3 direction(0.0);
    direction[axis] = sign;
    return direction;
}

} // namespace

std::optional<FileAxes> guess_axes(const TriangleMesh& mesh) {
    if (mesh.triangles.empty() || !(diagonal_m(mesh) > 0.0)) { return std::nullopt; }
    const Cells cells(mesh);
    const std::optional<int> lateral = lateral_axis(cells);
    if (!lateral) { return std::nullopt; }
    int length = (*lateral + 1) % 3;
    int height = (*lateral + 2) % 3;
    if (cells.counts()[length] < cells.counts()[height]) { std::swap(length, height); }
    if (cells.counts()[height] > max_height * cells.counts()[length] ||
        cells.counts()[*lateral] < min_span * cells.counts()[length]) {
        return std::nullopt;
    }
    if (height == 0) { // files have their top towards +y or +z
        return std::nullopt;
    }
    const std::optional<int> nose = nose_by_fin(cells, length, height);
    if (!nose) { return std::nullopt; }
    const glm::dvec3 right = glm::cross(along(length, *nose), along(height, 1));
    std::array<std::string_view, 3> names;
    names.at(static_cast<std::size_t>(length)) = *nose > 0 ? "forward" : "back";
    names.at(static_cast<std::size_t>(height)) = "up";
    names.at(static_cast<std::size_t>(*lateral)) = right[*lateral] > 0.0 ? "right" : "left";
    return FileAxes::from_text(fmt::format("{},{},{}", names[0], names[1], names[2]));
}

namespace {

struct Direction {
    std::string_view name;
    glm::dvec3 in_body;
};

const std::array<Direction, 6> directions{Direction{"right", glm::dvec3(0, 1, 0)},
    Direction{"left", glm::dvec3(0, -1, 0)}, Direction{"up", glm::dvec3(0, 0, -1)},
    Direction{"down", glm::dvec3(0, 0, 1)}, Direction{"forward", glm::dvec3(1, 0, 0)},
    Direction{"back", glm::dvec3(-1, 0, 0)}};

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
    throw_error_in(
        "axes", fmt::format("expected where x, y and z point, such as right,up,back (of right, left, up, down, "
                            "forward, back), got '{}'{}",
                    printable(std::string(text)), why));
}

} // namespace

FileAxes FileAxes::from_text(std::string_view text) {
    const auto names = split_fields(text, ',');
    if (names.size() != 3) { refuse(text, ""); }
    FileAxes axes;
    for (std::size_t i = 0; i < 3; ++i) {
        bool known = false;
        for (const Direction& direction : directions) {
            if (direction.name == names[i]) {
                axes.axes_[i] = direction.in_body;
                known = true;
            }
        }
        if (!known) { refuse(text, ""); }
    }
    const double volume = glm::dot(glm::cross(axes.axes_[0], axes.axes_[1]), axes.axes_[2]);
    if (volume == 0.0) { refuse(text, ", where two axes lie on one line"); }
    if (volume < 0.0) { refuse(text, ", which is left-handed"); }
    return axes;
}

// Adding zero turns a negative zero into a plain one.
glm::dvec3 FileAxes::body_from_file(const glm::dvec3& in_file) const {
    return axes_[0] * in_file.x + axes_[1] * in_file.y + axes_[2] * in_file.z + 0.0;
}

glm::dvec3 FileAxes::file_from_body(const glm::dvec3& in_body) const {
    return glm::dvec3(glm::dot(axes_[0], in_body), glm::dot(axes_[1], in_body), glm::dot(axes_[2], in_body)) + 0.0;
}

std::string FileAxes::text() const {
    std::string text;
    for (const glm::dvec3& axis : axes_) {
        for (const Direction& direction : directions) {
            if (direction.in_body == axis) {
                text += text.empty() ? "" : ",";
                text += direction.name;
            }
        }
    }
    return text;
}

} // namespace octant::models::polygons
