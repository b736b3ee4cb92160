#include "ui/world/order_model.h"

#include "models/meshfile/level_chain.h"
#include "models/meshfile/mesh_file.h"
#include "models/part_motion.h"
#include "models/polygons/obj_reader.h"
#include "models/polygons/polygon_model.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/error.h"
#include "sim/base/random_generator.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/world/mesh_loader.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::world {

namespace draworder = visuals::draworder;
namespace orderfile = visuals::orderfile;
using models::polygons::PolygonModel;

namespace {

constexpr std::size_t max_polygons = 100'000;
constexpr double nearest_radii = 0.05;
constexpr double farthest_radii = 20.0;
constexpr int rays_per_eye = 20;

bool is_file_name(const std::string& name) {
    std::error_code ignored;
    return name.find('/') != std::string::npos || name.find('.') != std::string::npos ||
           std::filesystem::is_regular_file(name, ignored);
}

/// Without triangles that have no area, which no order needs; they are noted.
PolygonModel leave_out_slivers(PolygonModel model, const std::string& file) {
    const std::size_t before = model.polygons.size();
    std::erase_if(model.polygons, [&](const models::polygons::Polygon& polygon) {
        const auto corner = [&](std::uint32_t k) {
            return model.vertices_m[model.corner_vertices[polygon.first_corner + k]];
        };
        const std::array<glm::dvec3, 3> corners_m{corner(0), corner(1), corner(2)};
        return models::polygons::is_line(corners_m);
    });
    if (const std::size_t gone = before - model.polygons.size(); gone > 0) {
        model.notes.push_back(fmt::format("{}: {} triangles without area are left out", file, gone));
    }
    if (model.polygons.empty()) { throw_error_in(file, "expected triangles with an area, got none"); }
    return model;
}

/// The polygons of a chain of levels, or its coarsest level.
PolygonModel polygons_of_chain(const std::string& file, const models::polygons::FileAxes& axes) {
    models::meshfile::LevelChain chain = models::meshfile::read_chain(file);
    PolygonModel model =
        chain.polygons ? std::move(*chain.polygons) : models::polygons::polygons_from_mesh(chain.levels.back().mesh);
    for (glm::dvec3& vertex_m : model.vertices_m) { vertex_m = axes.body_from_file(vertex_m); }
    for (models::polygons::Pivot& pivot : model.pivots) {
        pivot.point_m = axes.body_from_file(pivot.point_m);
        pivot.axis = axes.body_from_file(pivot.axis);
    }
    return model;
}

/// The triangles of a mesh file as polygons, at rest: its body, then its glass, then each part that moves.
PolygonModel polygons_of_mesh_file(const std::string& file, const models::polygons::FileAxes& axes) {
    if (models::meshfile::is_chain_file(file)) { return polygons_of_chain(file, axes); }
    const models::meshfile::RotatingModel read = load_rotating_model(file, {.backs = true});
    PolygonModel model;
    model.name = std::filesystem::path(file).stem().string();
    model.notes = read.body.notes;
    const auto add = [&](const models::TriangleMesh& mesh, const std::string& part) {
        if (mesh.triangles.empty()) { return; }
        models::polygons::append_polygons(
            model, models::polygons::polygons_from_mesh(mesh), static_cast<std::uint32_t>(model.parts.size()));
        model.parts.push_back(part);
    };
    add(read.body, "body");
    add(read.clear, "glass");
    for (const models::meshfile::RotatingPart& part : read.parts) {
        if (part.mesh.triangles.empty() || !models::is_shown_at_rest(part.moves)) { continue; }
        const auto number = static_cast<std::uint32_t>(model.parts.size());
        const bool turns = part.about.turns_per_s != 0.0;
        add(part.mesh, fmt::format("{}-{}", turns ? "turning" : "moving", number));
        if (!turns) { continue; }
        model.pivots.push_back({number, axes.body_from_file(part.about.point_m),
            axes.body_from_file(part.about.direction), part.about.turns_per_s});
    }
    for (glm::dvec3& vertex_m : model.vertices_m) { vertex_m = axes.body_from_file(vertex_m); }
    return leave_out_slivers(std::move(model), file);
}

OrderModel read(const std::string& name, const std::string& axes) {
    const auto file_axes = models::polygons::FileAxes::from_text(axes);
    if (std::ranges::find(base::built_in_models, name) != base::built_in_models.end()) {
        return {models::polygons::read_obj(base::aircraft_file(name)), {}};
    }
    if (name == "torus") { return {models::procedural::torus(), {}}; }
    if (!is_file_name(name)) {
        throw Error(fmt::format(
            "model: expected {}, torus or a file, got '{}'", fmt::join(base::built_in_models, ", "), printable(name)));
    }
    const bool is_obj = extension_of(name) == ".obj" && !models::meshfile::is_xplane_object(name);
    return {is_obj ? models::polygons::read_obj(name, file_axes) : polygons_of_mesh_file(name, file_axes), file_axes};
}

/// The most planes that any eye is tried against.
int max_tests(const draworder::DrawOrder& order) {
    using Kind = draworder::DrawOrder::Kind;
    const auto nodes = order.nodes();
    std::vector<int> most(nodes.size(), 0);
    for (std::size_t i = nodes.size(); i-- > 0;) { // children are later nodes
        const auto below = [&](int child) { return child >= 0 ? most[static_cast<std::size_t>(child)] : 0; };
        const int front = below(nodes[i].front);
        const int back = below(nodes[i].back);
        const bool one = nodes[i].kind == Kind::ViewSplit;
        most[i] = (nodes[i].kind == Kind::Sequence ? 0 : 1) + (one ? std::max(front, back) : front + back);
    }
    return most.empty() ? 0 : most.front();
}

/// How many planes an eye is tried against. `to_do` is scratch memory.
int tests_of(const draworder::DrawOrder& order, const glm::dvec3& eye_m, std::vector<int>& to_do) {
    using Kind = draworder::DrawOrder::Kind;
    int tests = 0;
    to_do.assign(order.nodes().empty() ? 0 : 1, 0);
    while (!to_do.empty()) {
        const auto& node = order.nodes()[static_cast<std::size_t>(to_do.back())];
        to_do.pop_back();
        tests += node.kind == Kind::Sequence ? 0 : 1;
        const bool in_front = node.kind == Kind::ViewSplit && distance_m(node.plane, eye_m) >= 0.0;
        if (node.front >= 0 && (node.kind != Kind::ViewSplit || in_front)) { to_do.push_back(node.front); }
        if (node.back >= 0 && !in_front) { to_do.push_back(node.back); }
    }
    return tests;
}

} // namespace

OrderModel load_order_model(const std::string& name_or_file, const std::string& axes) {
    OrderModel input = read(name_or_file, axes);
    if (input.model.polygons.size() > max_polygons) {
        throw Error(fmt::format("{}: expected at most {} polygons, got {}", printable(name_or_file), max_polygons,
            input.model.polygons.size()));
    }
    return input;
}

PlaneTests plane_tests(const draworder::OrderedModel& ordered) {
    constexpr std::size_t max_tests_in_all = 20'000'000;
    const std::size_t nodes = ordered.order.nodes().size();
    const int eyes = static_cast<int>(std::clamp<std::size_t>(max_tests_in_all / (nodes + 1), 100, 10'000));
    PlaneTests tests;
    tests.most = max_tests(ordered.order);
    RandomGenerator dice(1989);
    const double radius_m = models::polygons::radius_m(ordered.model);
    std::vector<int> to_do;
    long sum = 0;
    for (int i = 0; i < eyes; ++i) {
        const glm::dvec3 direction = dice.direction();
        const double radii = nearest_radii * std::pow(farthest_radii / nearest_radii, dice.next());
        sum += tests_of(ordered.order, direction * (radii * radius_m), to_do);
    }
    tests.mean = static_cast<double>(sum) / eyes;
    return tests;
}

orderfile::RayTestCounts cast_rays(
    const models::polygons::PolygonModel& model, const orderfile::CellOrders& orders, int rays) {
    std::vector<double> angles_rad = {0.0};
    if (!model.pivots.empty()) { angles_rad = {0.0, 0.7, 2.1, 4.4}; }
    double min_m = orders.cells.empty() ? 0.0 : orders.cells.front().min_m;
    for (const auto& cell : orders.cells) { min_m = std::min(min_m, cell.min_m); }
    const double nearest_m = min_m / std::sqrt(3.0) - glm::length(orders.centre_m);
    orderfile::RayTestCounts count;
    for (std::size_t i = 0; i < angles_rad.size(); ++i) {
        orderfile::RaySampling samples;
        samples.eyes = std::max(1, rays / rays_per_eye / static_cast<int>(angles_rad.size()));
        samples.rays_per_eye = rays_per_eye;
        samples.min_distance_radii = std::max(nearest_radii, nearest_m / models::polygons::radius_m(model));
        samples.max_distance_radii = std::max(farthest_radii, 10.0 * samples.min_distance_radii);
        samples.seed = 1989 + i;
        samples.turn_rad = angles_rad[i];
        count += orderfile::count_wrong_rays(model, orders, samples);
    }
    return count;
}

} // namespace octant::ui::world
