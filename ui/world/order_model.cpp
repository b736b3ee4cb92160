#include "ui/world/order_model.h"

#include "models/polygons/obj_reader.h"
#include "models/procedural/procedural_models.h"
#include "sim/base/error.h"
#include "sim/base/random_generator.h"
#include "ui/base/data_files.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

namespace octant::ui::world {

namespace draworder = visuals::draworder;
namespace orderfile = visuals::orderfile;

namespace {

constexpr std::size_t max_polygons = 50'000;
constexpr double nearest_radii = 0.05;
constexpr double farthest_radii = 20.0;
constexpr int rays_per_eye = 20;

bool is_file_name(const std::string& name) {
    std::error_code ignored;
    return name.find('/') != std::string::npos || name.find('.') != std::string::npos ||
           std::filesystem::is_regular_file(name, ignored);
}

OrderModel read(const std::string& name, const std::string& axes) {
    const auto file_axes = models::polygons::FileAxes::from_text(axes);
    if (std::ranges::find(base::built_in_models, name) != base::built_in_models.end()) {
        return {models::polygons::read_obj(base::aircraft_file(name)), {}};
    }
    if (name == "torus") { return {models::procedural::torus(), {}}; }
    if (!is_file_name(name)) {
        throw Error(fmt::format("model: expected {}, torus or an OBJ file, got '{}'",
            fmt::join(base::built_in_models, ", "), printable(name)));
    }
    return {models::polygons::read_obj(name, file_axes), file_axes};
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
