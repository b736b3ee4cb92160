// Errors as they are stored, against their definition in plain loops.
#include "visuals/terrain/bisection_ground_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "ground_fields.h"

namespace octant::visuals::terrain {

namespace {

struct Point {
    int x;
    int y;
};

enum class Look { AsBuilt, AtAll };

/// The codes of every sample's error in the padded square, straight from their definition. Errors are multiplied by a
/// factor beside 1 before they are coded.
class PlainErrors {
public:
    PlainErrors(const models::heights::HeightField& field, const ErrorCodes& meaning, double factor)
        : field_(field), meaning_(meaning), factor_(factor),
          root_edge_(GroundLayout(field.columns(), field.rows()).level(0).edge) {
        codes_.fill(std::vector<std::uint8_t>(index(root_edge_, root_edge_) + 1));
        for (int half = 1; half < root_edge_; half *= 2) {
            for_each(half, false);
            for_each(half, true);
        }
    }

    std::uint8_t code(int x, int y, MorphMargin morph_margin) const {
        return codes_[static_cast<std::size_t>(morph_margin)][index(x, y)];
    }

    /// The largest deviation of samples from the triangles whose longest edge a sample halves; `half`: from the middle
    /// to a corner or a side of the square around them.
    double own(Point middle, int half, Look look) const {
        const Point end = end_of(middle, half);
        const Point apex{-end.y, end.x};
        double error = 0.0;
        for (const int side : {1, -1}) {
            const std::array<Point, 3> corners = {{{middle.x + end.x, middle.y + end.y},
                {middle.x - end.x, middle.y - end.y}, {middle.x + side * apex.x, middle.y + side * apex.y}}};
            if (!padded(corners[2].x, corners[2].y)) { continue; }
            const int stride = look == Look::AtAll ? 1 : std::max(1, half / 16);
            error = std::max(error, of_triangle(corners, stride));
        }
        return error;
    }

private:
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * (root_edge_ + 1) + x); }

    bool padded(int x, int y) const { return x >= 0 && y >= 0 && x <= root_edge_ && y <= root_edge_; }

    static bool is_odd(int x, int half) { return (x / half) % 2 != 0; }

    /// From the middle to one end of the edge that a sample halves.
    static Point end_of(Point middle, int half) {
        const bool odd_x = is_odd(middle.x, half);
        if (!odd_x || !is_odd(middle.y, half)) { return odd_x ? Point{half, 0} : Point{0, half}; }
        // The parent's centre has the coordinates that are odd multiples of two halves.
        return {is_odd(middle.x + half, 2 * half) ? half : -half, is_odd(middle.y + half, 2 * half) ? half : -half};
    }

    std::uint8_t coded(double error_m) const { return meaning_.code_of(static_cast<float>(error_m * factor_)); }

    /// All middles of edges that are two halves long, or all centres of such nodes.
    void for_each(int half, bool centres) {
        for (int y = 0; y <= root_edge_; y += half) {
            for (int x = 0; x <= root_edge_; x += half) {
                const bool odd_x = is_odd(x, half);
                const bool odd_y = is_odd(y, half);
                if ((odd_x || odd_y) && (odd_x && odd_y) == centres) {
                    const double own_m = own({x, y}, half, Look::AsBuilt) + unseen({x, y}, half);
                    const std::uint8_t below = largest_below({x, y}, half, centres, MorphMargin::Full);
                    codes_[0][index(x, y)] = std::max(coded(own_m), with_margin({x, y}, half, below));
                    codes_[1][index(x, y)] =
                        std::max(coded(own_m), largest_below({x, y}, half, centres, MorphMargin::None));
                }
            }
        }
    }

    std::uint8_t largest_below(Point at, int half, bool centre, MorphMargin morph_margin) const {
        static constexpr std::array<Point, 4> straight = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
        static constexpr std::array<Point, 4> aslant = {{{1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
        const int step = centre ? half : half / 2;
        std::uint8_t largest = 0;
        for (const Point& way : centre ? straight : aslant) {
            const int x = at.x + way.x * step;
            const int y = at.y + way.y * step;
            if (step > 0 && padded(x, y) && (centre || has_area(x, y, step))) {
                largest = std::max(largest, code(x, y, morph_margin));
            }
        }
        return largest;
    }

    std::uint8_t with_margin(Point at, int half, std::uint8_t below) const {
        const Point end = end_of(at, half);
        const double ends_m = height({at.x + end.x, at.y + end.y}) + height({at.x - end.x, at.y - end.y});
        const double move_m = std::abs(height(at) - 0.5 * ends_m);
        const double below_m = static_cast<double>(meaning_.metres(below));
        const double relief_m = static_cast<double>(field_.highest_m() - field_.lowest_m());
        const double ease = std::clamp(1200.0 / relief_m, 1.0, 1.8);
        const double min_m = below_m + move_m / (4.7 * ease);
        const double fastest = ease * std::clamp(2.0 * 512.0 * min_m / relief_m, 1.2, 4.7);
        return below == 0 || move_m == 0.0 ? below : std::max(below, coded(below_m + move_m / fastest));
    }

    /// The largest error of the nodes with an edge of one stride in the large nodes that a sample's triangles touch.
    double unseen(Point at, int half) const {
        const int stride = half / 16;
        if (stride < 2) { return 0.0; }
        const int node = 2 * half;
        const int min_x = (at.x - half / 2) / node * node;
        const int min_y = (at.y - half / 2) / node * node;
        const int end_x = (at.x + half / 2 + node - 1) / node * node;
        const int end_y = (at.y + half / 2 + node - 1) / node * node;
        std::uint8_t largest = 0;
        for (int y = min_y; y < end_y; y += stride) {
            for (int x = min_x; x < end_x; x += stride) {
                const Point centre{x + stride / 2, y + stride / 2};
                if (padded(centre.x, centre.y) && has_area(centre.x, centre.y, stride / 2)) {
                    largest = std::max(largest, code(centre.x, centre.y, MorphMargin::None));
                }
            }
        }
        return static_cast<double>(meaning_.metres(largest));
    }

    bool has_area(int x, int y, int half) const {
        return x - half < field_.columns() - 1 && y - half < field_.rows() - 1;
    }

    static double cross(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

    double plane(const std::array<Point, 3>& at, Point p) const {
        return (cross(at[1], at[2], p) * height(at[0]) + cross(at[2], at[0], p) * height(at[1]) +
                   cross(at[0], at[1], p) * height(at[2])) /
               cross(at[0], at[1], at[2]);
    }

    /// Over every stride-th sample of the triangle, up to the first ones that are not within the field. Corners of a
    /// triangle lie at multiples of the stride.
    double of_triangle(const std::array<Point, 3>& at, int stride) const {
        const auto [min_x, max_x] = std::minmax({at[0].x, at[1].x, at[2].x});
        const auto [min_y, max_y] = std::minmax({at[0].y, at[1].y, at[2].y});
        const double area = cross(at[0], at[1], at[2]);
        double error = 0.0;
        for (int y = std::max(min_y, 0); y <= max_y && y < field_.rows() - 1 + stride; y += stride) {
            for (int x = std::max(min_x, 0); x <= max_x && x < field_.columns() - 1 + stride; x += stride) {
                const Point p{x, y};
                const double a = cross(at[1], at[2], p) / area;
                const double b = cross(at[2], at[0], p) / area;
                const double c = cross(at[0], at[1], p) / area;
                if (a >= 0.0 && b >= 0.0 && c >= 0.0) { error = std::max(error, std::abs(height(p) - plane(at, p))); }
            }
        }
        return error;
    }

    double height(Point at) const { return padded_height_m(field_, at.x, at.y); }

    const models::heights::HeightField& field_;
    const ErrorCodes& meaning_;
    double factor_;
    int root_edge_;
    std::array<std::vector<std::uint8_t>, 2> codes_; ///< By MorphMargin.
};

/// Calls check(code, morph margin, sample, half) for each stored error of a ground.
template <typename Check>
void for_each_error(const GroundTiles& ground, const Check& check) {
    for (int level = 0; level < ground.levels(); ++level) {
        const GroundLayout::Level& at = ground.layout().level(level);
        const int half = at.edge / 2;
        for (int y = 0; y <= at.rows; ++y) {
            for (int x = 0; x <= at.columns; ++x) {
                const Point corner{x * at.edge, y * at.edge};
                const auto check_part = [&](NodePart part, Point sample) {
                    for (const MorphMargin morph_margin : {MorphMargin::Full, MorphMargin::None}) {
                        check(ground.error_code(level, part, x, y, morph_margin), morph_margin, sample, half);
                    }
                };
                if (x < at.columns) { check_part(NodePart::South, {corner.x + half, corner.y}); }
                if (y < at.rows) { check_part(NodePart::West, {corner.x, corner.y + half}); }
                if (x < at.columns && y < at.rows) { check_part(NodePart::Centre, {corner.x + half, corner.y + half}); }
            }
        }
    }
}

/// Number of samples whose stored error is not that of the definition, rounding aside.
int wrong_errors(const models::heights::HeightField& field) {
    const GroundTiles ground = make_ground_tiles(field);
    const PlainErrors min(field, ground.codes(), 1.0 - 1e-6);
    const PlainErrors max(field, ground.codes(), 1.0 + 1e-6);
    int wrong = 0;
    for_each_error(ground, [&](std::uint8_t code, MorphMargin morph_margin, Point sample, int /*half*/) {
        wrong += code < min.code(sample.x, sample.y, morph_margin) || code > max.code(sample.x, sample.y, morph_margin);
    });
    return wrong;
}

/// Number of samples with an error below the distance of some sample, whichever.
int errors_too_small(const models::heights::HeightField& field) {
    const GroundTiles ground = make_ground_tiles(field);
    const PlainErrors plain(field, ground.codes(), 1.0);
    int wrong = 0;
    for_each_error(ground, [&](std::uint8_t code, MorphMargin /*morph_margin*/, Point sample, int half) {
        const double own_m = plain.own(sample, half, Look::AtAll);
        wrong += static_cast<double>(ground.codes().metres(code)) < own_m * (1.0 - 1e-6);
    });
    return wrong;
}

} // namespace

TEST_CASE("errors are the largest deviations in the diamonds, saturated with and without morph margin") {
    for (const int size : {3, 5, 9, 17, 33, 65, 129}) {
        INFO(size);
        CHECK(wrong_errors(rough_metre_field(size, size, static_cast<unsigned>(size))) == 0);
    }
}

TEST_CASE("errors are those deviations for odd sizes, too") {
    constexpr std::array<std::pair<int, int>, 9> sizes = {
        {{2, 2}, {2, 9}, {6, 11}, {11, 6}, {34, 33}, {18, 40}, {100, 65}, {66, 3}, {77, 140}}};
    for (const auto& [columns, rows] : sizes) {
        INFO(columns << " x " << rows);
        CHECK(wrong_errors(rough_metre_field(columns, rows, 5)) == 0);
    }
}

TEST_CASE("no sample lies farther from a triangle than its error says, on no lattice either") {
    for (const auto& [columns, rows] : {std::pair{65, 65}, {50, 33}, {39, 70}}) {
        INFO(columns << " x " << rows);
        CHECK(errors_too_small(rough_metre_field(columns, rows, 7)) == 0);
        // Slopes with a few spikes, most of which are beside the lattice of large diamonds.
        std::vector<float> heights_m;
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns; ++column) {
                const bool spike = (31 * column + 17 * row) % 257 == 0;
                heights_m.push_back(static_cast<float>(2 * column - row + (spike ? 300 : 0)));
            }
        }
        CHECK(errors_too_small({columns, rows, 30.0, heights_m}) == 0);
    }
}

} // namespace octant::visuals::terrain
