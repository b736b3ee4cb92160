#include "ui/terrain/terrain_query.h"

#include "sim/base/column_reader.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/json_value.h"
#include "visuals/terrain/ground_query.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace octant::ui::terrain {

namespace terrain = visuals::terrain;

namespace {

using base::JsonValue;

JsonValue point_results(const std::optional<glm::dvec3>& place) {
    return place ? JsonValue::list({place->x, place->y, place->z}) : JsonValue();
}

/// A column of a coordinate.
template <auto Member>
constexpr auto metres(std::string_view key) {
    auto made = report::column<Member>(key, key, -10);
    made.is_signed = true;
    return made;
}

/// A number as a CSV cell; an empty cell where there is none.
std::string cell(const std::optional<double>& number) { return number ? fmt::format("{:.10g}", *number) : ""; }

std::string cells(const std::optional<glm::dvec3>& place) {
    return place ? fmt::format("{:.10g},{:.10g},{:.10g}", place->x, place->y, place->z) : ",,";
}

std::string csv_text(const QueryResults& answers) {
    std::string text;
    if (!answers.points.empty()) { text += report::csv_rows(query_columns(), answers.points); }
    if (answers.sight) {
        const LineOfSightAnswer& sight = *answers.sight;
        text += fmt::format("visible,clearance_m,lowest_x_m,lowest_y_m,lowest_z_m,hidden_x_m,hidden_y_m,"
                            "hidden_z_m\n{},{},{},{}\n",
            sight.visible ? "yes" : "no", cell(sight.clearance_m), cells(sight.min_clearance_at_m),
            cells(sight.blocked_at_m));
    }
    return text;
}

} // namespace

QueryPointResult answer_of(const QueryPoint& point, const std::optional<double>& ground_m) {
    const auto above_m = point.z_m && ground_m ? std::optional(*point.z_m - *ground_m) : std::nullopt;
    return {point.x_m, point.y_m, point.z_m, ground_m, above_m};
}

std::span<const report::Column<QueryPointResult>> query_columns() {
    using R = QueryPointResult;
    static constexpr std::array columns{metres<&R::x_m>("x_m"), metres<&R::y_m>("y_m"), metres<&R::z_m>("z_m"),
        metres<&R::ground_m>("ground_m"), metres<&R::above_ground_m>("above_ground_m")};
    return columns;
}

std::optional<QueryPoint> point_from_text(std::string_view text) {
    const auto fields = split_fields(text, ',');
    if (fields.size() != 2 && fields.size() != 3) { return std::nullopt; }
    const auto x_m = finite_number(fields[0]);
    const auto y_m = finite_number(fields[1]);
    const auto z_m = fields.size() == 3 ? finite_number(fields[2]) : std::nullopt;
    if (!x_m || !y_m || (fields.size() == 3 && !z_m)) { return std::nullopt; }
    return QueryPoint{*x_m, *y_m, z_m};
}

std::vector<QueryPoint> read_points(const std::filesystem::path& file) {
    ColumnReader table(TextScanner::of_file(file), ',');
    std::vector<QueryPoint> points;
    bool names_may_come = true;
    while (table.next_row()) {
        const auto point = point_from_text(table.row());
        const bool names = names_may_come && table.row().starts_with('x');
        names_may_come = false;
        if (!point && !names) { table.refuse("x,y or x,y,z in metres", in_quotes(table.row())); }
        if (point) { points.push_back(*point); }
    }
    return points;
}

std::vector<QueryPointResult> ground_heights_at(
    const terrain::GroundSamples& ground, std::span<const QueryPoint> points) {
    std::vector<QueryPointResult> answers;
    for (const QueryPoint& point : points) {
        answers.push_back(answer_of(point, terrain::ground_height_m(ground, point.x_m, point.y_m)));
    }
    return answers;
}

std::vector<QueryPointResult> drawn_heights_at(const DrawnMesh& drawn, std::span<const QueryPoint> points) {
    std::vector<QueryPointResult> answers;
    for (const QueryPoint& point : points) {
        auto height_m = drawn.surface.height_at(point.x_m, point.y_m);
        if (height_m) { *height_m += drawn.drop_m({point.x_m, point.y_m}); }
        answers.push_back(answer_of(point, height_m));
    }
    return answers;
}

LineOfSightAnswer line_of_sight_answer(
    const terrain::GroundSamples& ground, const glm::dvec3& from_m, const glm::dvec3& to_m, double radius_m) {
    const terrain::LineOfSight line = terrain::line_of_sight(ground, from_m, to_m, radius_m);
    if (!std::isfinite(line.clearance_m)) { return {}; }
    return {line.visible, line.blocked_at_m, line.clearance_m, line.min_clearance_at_m};
}

LineOfSightAnswer drawn_line_of_sight(const DrawnMesh& drawn, const glm::dvec3& from_m, const glm::dvec3& to_m) {
    const auto sunk = [&](const glm::dvec3& at_m) {
        return glm::dvec3(at_m.x, at_m.y, at_m.z - drawn.drop_m(glm::dvec2(at_m)));
    };
    LineOfSightAnswer sight;
    const glm::dvec3 begin_m = sunk(from_m);
    const glm::dvec3 way_m = sunk(to_m) - begin_m;
    if (const auto share = drawn.surface.first_hit(begin_m, begin_m + way_m)) {
        sight.visible = false;
        glm::dvec3 hit_m = begin_m + way_m * *share;
        hit_m.z += drawn.drop_m(glm::dvec2(hit_m));
        sight.blocked_at_m = hit_m;
    }
    return sight;
}

std::string query_text(const QueryResults& answers, bool json) {
    if (!json) { return csv_text(answers); }
    JsonValue whole;
    whole["points"] = report::json_rows(query_columns(), answers.points);
    if (answers.sight) {
        const LineOfSightAnswer& sight = *answers.sight;
        whole["sight"] = {{"visible", sight.visible}, {"clearance_m", sight.clearance_m},
            {"lowest_at_m", point_results(sight.min_clearance_at_m)},
            {"hidden_at_m", point_results(sight.blocked_at_m)}};
    }
    return base::json_of_results(whole);
}

} // namespace octant::ui::terrain
