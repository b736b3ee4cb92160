#include "visuals/terrain/error_coder.h"
#include "visuals/terrain/ground_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "ground_fields.h"

namespace octant::visuals::terrain {

namespace {

struct Point {
    int x;
    int y;
};

/// Errors of every sample of the padded square, straight from their definition.
class PlainErrors {
public:
    explicit PlainErrors(const models::heights::HeightField& field)
        : field_(field)
        , root_edge_(GroundLayout(field.columns(), field.rows()).level(0).edge)
        , errors_m_(static_cast<std::size_t>((root_edge_ + 1) * (root_edge_ + 1))) {
        for (int half = 1; half < root_edge_; half *= 2) {
            for_each(half, false);
            for_each(half, true);
        }
    }

    double error_m(int x, int y) const { return errors_m_[index(x, y)]; }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y * (root_edge_ + 1) + x);
    }

    bool padded(int x, int y) const {
        return x >= 0 && y >= 0 && x <= root_edge_ && y <= root_edge_;
    }

    /// All middles of edges that are two halves long, or all centres of such nodes.
    void for_each(int half, bool centres) {
        for (int y = 0; y <= root_edge_; y += half) {
            for (int x = 0; x <= root_edge_; x += half) {
                const bool odd_x = (x / half) % 2 != 0;
                const bool odd_y = (y / half) % 2 != 0;
                if ((odd_x || odd_y) && (odd_x && odd_y) == centres) {
                    errors_m_[index(x, y)] =
                        centres ? of_centre(x, y, half) : of_edge(x, y, half, odd_x);
                }
            }
        }
    }

    double of_centre(int x, int y, int half) const {
        // The parent's centre has the coordinates that are odd multiples of two halves.
        const int to_x = ((x + half) / (2 * half)) % 2 != 0 ? half : -half;
        const int to_y = ((y + half) / (2 * half)) % 2 != 0 ? half : -half;
        double error = own({x, y}, {to_x, to_y}, half);
        for (const Point step : {Point{half, 0}, {-half, 0}, {0, half}, {0, -half}}) {
            error = std::max(error, error_m(x + step.x, y + step.y));
        }
        return error;
    }

    double of_edge(int x, int y, int half, bool lying) const {
        double error = own({x, y}, lying ? Point{half, 0} : Point{0, half}, half);
        const int quarter = half / 2;
        for (const Point step : {Point{1, 1}, {-1, 1}, {1, -1}, {-1, -1}}) {
            const int child_x = x + step.x * quarter;
            const int child_y = y + step.y * quarter;
            if (quarter > 0 && padded(child_x, child_y) && has_area(child_x, child_y, quarter)) {
                error = std::max(error, error_m(child_x, child_y));
            }
        }
        return error;
    }

    bool has_area(int x, int y, int half) const {
        return x - half < field_.columns() - 1 && y - half < field_.rows() - 1;
    }

    /// `end`: from the middle to one end of the hypotenuse.
    double own(Point middle, Point end, int half) const {
        const Point apex{-end.y, end.x};
        double error = 0.0;
        for (const int side : {1, -1}) {
            const std::array<Point, 3> corners = {
                {{middle.x + end.x, middle.y + end.y},
                 {middle.x - end.x, middle.y - end.y},
                 {middle.x + side * apex.x, middle.y + side * apex.y}}};
            if (padded(corners[2].x, corners[2].y)) {
                error = std::max(error, of_triangle(corners, std::max(1, half / 16)));
            }
        }
        return error;
    }

    double of_triangle(std::array<Point, 3> at, int stride) const {
        for (Point& corner : at) {
            corner.x = std::min(corner.x, field_.columns() - 1);
            corner.y = std::min(corner.y, field_.rows() - 1);
        }
        const auto cross = [](Point a, Point b, Point c) {
            return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        };
        const double area = cross(at[0], at[1], at[2]);
        double error = 0.0;
        for (int y = 0; area != 0.0 && y < field_.rows(); y += stride) {
            for (int x = 0; x < field_.columns(); x += stride) {
                const double a = cross(at[1], at[2], {x, y}) / area;
                const double b = cross(at[2], at[0], {x, y}) / area;
                const double c = cross(at[0], at[1], {x, y}) / area;
                if (a >= 0.0 && b >= 0.0 && c >= 0.0) {
                    const double plane = a * height(at[0]) + b * height(at[1]) + c * height(at[2]);
                    error = std::max(error, std::abs(height({x, y}) - plane));
                }
            }
        }
        return error;
    }

    double height(Point at) const { return static_cast<double>(field_.height_m(at.x, at.y)); }

    const models::heights::HeightField& field_;
    int root_edge_;
    std::vector<double> errors_m_;
};

/// Number of samples whose stored error is not that of the definition. Rounding may make a
/// difference where triangles are shrunk at a padded rim.
int wrong_errors(const models::heights::HeightField& field) {
    const GroundTiles ground = ground_of(field);
    const PlainErrors plain(field);
    int wrong = 0;
    const auto check = [&](int level, NodePart part, Point node, Point sample) {
        const double error_m = plain.error_m(sample.x, sample.y);
        const std::uint8_t code = ground.error_code(level, part, node.x, node.y);
        wrong += code < GroundTiles::error_code_of(static_cast<float>(error_m * (1.0 - 1e-7))) ||
                 code > GroundTiles::error_code_of(static_cast<float>(error_m * (1.0 + 1e-7)));
    };
    for (int level = 0; level < ground.levels(); ++level) {
        const GroundLayout::Level& at = ground.layout().level(level);
        const int half = at.edge / 2;
        for (int y = 0; y <= at.rows; ++y) {
            for (int x = 0; x <= at.columns; ++x) {
                const Point corner{x * at.edge, y * at.edge};
                if (x < at.columns) {
                    check(level, NodePart::South, {x, y}, {corner.x + half, corner.y});
                }
                if (y < at.rows) {
                    check(level, NodePart::West, {x, y}, {corner.x, corner.y + half});
                }
                if (x < at.columns && y < at.rows) {
                    check(level, NodePart::Centre, {x, y}, {corner.x + half, corner.y + half});
                }
            }
        }
    }
    return wrong;
}

} // namespace

TEST_CASE("errors are the largest deviations in the diamonds, saturated, for fields of 2^n + 1") {
    for (const int size : {3, 5, 9, 17, 33, 65, 129}) {
        INFO(size);
        CHECK(wrong_errors(rough_field(size, size, static_cast<unsigned>(size))) == 0);
    }
}

TEST_CASE("errors are the largest deviations in the diamonds, saturated, for odd sizes") {
    constexpr std::array<std::pair<int, int>, 9> sizes = {
        {{2, 2}, {2, 9}, {6, 11}, {11, 6}, {34, 33}, {18, 40}, {100, 65}, {66, 3}, {77, 140}}};
    for (const auto& [columns, rows] : sizes) {
        INFO(columns << " x " << rows);
        CHECK(wrong_errors(rough_field(columns, rows, 5)) == 0);
    }
}

TEST_CASE("a single peak is an error of its own height for whatever leaves it out") {
    std::vector<float> heights_m(25, 0.0F);
    heights_m[2 * 5 + 1] = 64.0F;
    const GroundTiles ground = ground_of({5, 5, 30.0, heights_m});
    const std::uint8_t peak = GroundTiles::error_code_of(64.0F);
    CHECK(ground.error_code(1, NodePart::South, 0, 1) == peak);
    CHECK(ground.error_code(0, NodePart::West, 0, 0) >= peak);
    CHECK(ground.error_code(0, NodePart::Centre, 0, 0) >= peak);
    CHECK(ground.error_code(1, NodePart::South, 1, 1) == 0);
    CHECK(ground.error_code(1, NodePart::West, 2, 0) == 0);
}

TEST_CASE("a plane has no errors") {
    std::vector<float> heights_m;
    for (int row = 0; row < 33; ++row) {
        for (int column = 0; column < 33; ++column) {
            heights_m.push_back(static_cast<float>(3 * column - 2 * row));
        }
    }
    const GroundTiles ground = ground_of({33, 33, 10.0, heights_m});
    CHECK(ground.error_code(0, NodePart::Centre, 0, 0) == 0);
    CHECK(ground.error_code(4, NodePart::Centre, 7, 9) == 0);
}

TEST_CASE("the number of threads changes no byte of a ground") {
    const models::heights::HeightField field = rough_field(700, 300);
    const GroundTiles one = ground_of(field, 1);
    for (const int threads : {2, 3}) {
        const GroundTiles other = ground_of(field, threads);
        REQUIRE(other.memory().size() == one.memory().size());
        CHECK(std::memcmp(other.memory().data(), one.memory().data(), one.memory().size()) == 0);
    }
}

TEST_CASE("ranges contain the samples of their nodes and nothing else") {
    for (const auto& [columns, rows] : {std::pair{5, 5}, {100, 65}, {131, 300}}) {
        const models::heights::HeightField field = rough_field(columns, rows);
        const GroundTiles ground = ground_of(field);
        for (int level = 0; level <= ground.layout().range_level(); ++level) {
            const GroundLayout::Level& at = ground.layout().level(level);
            for (int y = 0; y < at.rows; ++y) {
                for (int x = 0; x < at.columns; ++x) {
                    float lowest_m = 1e9F;
                    float highest_m = -1e9F;
                    for (int row = y * at.edge; row <= std::min((y + 1) * at.edge, rows - 1);
                         ++row) {
                        for (int column = x * at.edge;
                             column <= std::min((x + 1) * at.edge, columns - 1);
                             ++column) {
                            lowest_m = std::min(lowest_m, field.height_m(column, row));
                            highest_m = std::max(highest_m, field.height_m(column, row));
                        }
                    }
                    CHECK(ground.lowest_m(level, x, y) == lowest_m);
                    CHECK(ground.highest_m(level, x, y) == highest_m);
                }
            }
        }
        CHECK(ground.facts().lowest_m == field.lowest_m());
        CHECK(ground.facts().highest_m == field.highest_m());
    }
}

TEST_CASE("fractions of a metre are kept to half a unit") {
    std::vector<float> heights_m;
    for (int i = 0; i < 400; ++i) {
        heights_m.push_back(1000.0F + 700.0F * std::sin(static_cast<float>(i)));
    }
    const models::heights::HeightField field(20, 20, 5.0, heights_m);
    const GroundTiles ground = ground_of(field);
    CHECK(ground.shape().height_unit_m == 0x1p-5);
    for (int i = 0; i < 400; ++i) {
        const float off_m = ground.height_m(i % 20, i / 20) - field.height_m(i % 20, i / 20);
        CHECK(std::abs(off_m) <= 0x1p-6F);
    }
}

TEST_CASE("a ground takes at most 3.02 bytes a sample") {
    const GroundLayout layout(1025, 1025);
    CHECK(static_cast<double>(layout.total_bytes()) <= 3.02 * 1025 * 1025);
}

TEST_CASE("the table of codes agrees with the search") {
    const ErrorCoder coder(0.25);
    CHECK(coder.code_of(0.0F) == 0);
    for (float steps = 1e-3F; steps < 1e6F; steps *= 1.003F) {
        CHECK(coder.code_of(steps) == GroundTiles::error_code_of(0.25F * steps));
    }
    for (int code = 1; code < 256; ++code) {
        const float error_m = GroundTiles::error_m_of(static_cast<std::uint8_t>(code));
        CHECK(coder.code_of(4.0F * error_m) == code);
    }
}

} // namespace octant::visuals::terrain
