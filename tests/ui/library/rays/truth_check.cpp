#include "tests/ui/library/rays/truth_check.h"

#include "tests/ui/library/rays/ray_scene.h"
#include "tests/ui/library/rays/vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace octant::tests {

namespace {

constexpr double earth_radius_m = 6371000.0;
/// Nothing nearer to the plane through the eye is drawn.
constexpr double near_m = 0.5;
/// Boxes are cut off here.
constexpr double box_near_m = 0.05;
constexpr double beside_px = 0.05;
constexpr int margin_px = 2;
constexpr double depth_tolerance = 1e-4;
constexpr double flow_tolerance_px = 0.05;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A camera by its matrix.
struct Lens {
    Intrinsics matrix;
    Vec3 eye_m;
    Quaternion look;

    /// Of length 1 along the optical axis, world axes.
    Vec3 ray(double column, double row) const {
        return turned(look, {1.0, (column - matrix.cx) / matrix.fx, (row - matrix.cy) / matrix.fy});
    }

    /// Ahead, column, row. Column and row mean nothing for points that are not ahead.
    Vec3 seen(const Vec3& way_m) const {
        const Vec3 in_camera = turned_back(look, way_m);
        return {in_camera.x, matrix.cx + matrix.fx * in_camera.y / in_camera.x,
            matrix.cy + matrix.fy * in_camera.z / in_camera.x};
    }

    Vec3 seen_point(const Vec3& at_m) const { return seen(minus(at_m, eye_m)); }
};

/// How far a point sinks that is seen from an eye.
double sink_m(const Vec3& at_m, const Vec3& eye_m) {
    const double east = at_m.x - eye_m.x;
    const double north = at_m.y - eye_m.y;
    return (east * east + north * north) / (2.0 * earth_radius_m);
}

double distance(const Vec3& a, const Vec3& b) { return length(minus(a, b)); }

/// The least height of a triangle over one of its sides.
double least_height_m(const SceneTriangle& triangle) {
    const auto& at = triangle.corners_m;
    const double area = length(cross(minus(at[1], at[0]), minus(at[2], at[0])));
    return area / std::max({distance(at[0], at[1]), distance(at[1], at[2]), distance(at[2], at[0])});
}

class Check {
public:
    Check(const World& world, const View& view, const std::string& scratch, std::string name)
        : view_(view), name_(std::move(name)),
          world_(world), lens_{view.camera.matrix(), view.pose.eye_m, view.pose.attitude},
          before_{lens_.matrix, view.pose.previous_eye_m.value_or(view.pose.eye_m),
              view.pose.previous_attitude.value_or(view.pose.attitude)} {
        world_.set_states(view.previous_states);
        for (std::uint32_t object = 1; object <= view.states.size(); ++object) {
            if (view.has_moving_parts[object - 1]) { export_before(object, scratch); }
        }
        world_.set_states(view.states);
        world_.export_scene(scratch, view.camera, view.pose);
        std::vector<SceneTriangle> triangles = read_scene(scratch);
        std::remove(scratch.c_str());
        scene_.emplace(std::move(triangles), lens_.eye_m);
        truth_ = world_.render(view.camera, std::span(&view.pose, 1),
            Output::Depth | Output::ClassId | Output::ObjectId | Output::Normal | Output::Flow);
    }

    Findings run() {
        shoot();
        for (int row = 0; row < view_.camera.height; ++row) {
            for (int column = 0; column < view_.camera.width; ++column) { check_pixel(column, row); }
        }
        check_boxes();
        return found_;
    }

private:
    std::size_t pixel(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(view_.camera.width) +
               static_cast<std::size_t>(column);
    }

    /// The oracle's own picture.
    void shoot() {
        hits_.resize(truth_.class_id.size());
        for (int row = 0; row < view_.camera.height; ++row) {
            for (int column = 0; column < view_.camera.width; ++column) {
                hits_[pixel(column, row)] = scene_->nearest(lens_.ray(column, row), near_m);
            }
        }
    }

    void tell(int column, int row, const std::string& what) {
        constexpr std::size_t most = 6;
        if (found_.examples.size() < most) {
            found_.examples.push_back(fmt::format("{}: column {}, row {}: {}", name_, column, row, what));
        }
    }

    enum class Fault { None, Class, Object, Depth, Normal };

    /// How a pixel differs from a surface that a ray found. `ray` is that of the pixel's middle.
    Fault fault_of(
        std::size_t at, const std::optional<RayScene::Hit>& hit, const Vec3& ray, double depth_margin_m = 0.0) const {
        const auto surface = static_cast<SurfaceClass>(truth_.class_id[at]);
        const float depth = truth_.depth_m[at];
        const float* const normal = &truth_.normal[3 * at];
        if (!hit) {
            if (surface != SurfaceClass::Sky) { return Fault::Class; }
            if (truth_.object_id[at] != 0) { return Fault::Object; }
            if (!std::isinf(depth)) { return Fault::Depth; }
            return normal[0] == 0.0F && normal[1] == 0.0F && normal[2] == 0.0F ? Fault::None : Fault::Normal;
        }
        const SceneTriangle& triangle = scene_->triangles()[hit->triangle];
        if (surface != triangle.surface) { return Fault::Class; }
        if (truth_.object_id[at] != triangle.object) { return Fault::Object; }
        const double way = scene_->way_to_plane(hit->triangle, ray);
        // Corners are float numbers with the eye subtracted: where a plane is seen at a flat angle, their rounding
        // moves the place where it is hit.
        const double slant = length(ray) / std::max(std::abs(dot(triangle.normal, ray)), 1e-9);
        const double rounding_m = 2e-7 * way * slant + depth_margin_m;
        if (!(std::abs(depth - way) <= depth_tolerance * way + rounding_m)) { return Fault::Depth; }
        const double cosine = dot(triangle.normal, {normal[0], normal[1], normal[2]});
        const double allowed = 1e-3 + 1e-6 * way * length(ray) / least_height_m(triangle);
        return cosine > std::cos(std::min(allowed, 1.5)) ? Fault::None : Fault::Normal;
    }

    bool agrees_beside(std::size_t at, int column, int row, const Vec3& ray) const {
        constexpr int steps = 4; // many triangles meet in a corner
        for (int dy = -steps; dy <= steps; ++dy) {
            for (int dx = -steps; dx <= steps; ++dx) {
                const auto hit =
                    scene_->nearest(lens_.ray(column + beside_px * dx / steps, row + beside_px * dy / steps), near_m);
                // A depth beside a triangle may be that of its nearest point.
                const double margin_m = hit ? std::abs(hit->way - scene_->way_to_plane(hit->triangle, ray)) : 0.0;
                if (fault_of(at, hit, ray, margin_m) == Fault::None) { return true; }
            }
        }
        return false;
    }

    /// Whether the oracle's picture has another class, another object, or a step in depth near a pixel.
    bool is_near_edge(int column, int row) const {
        const auto& here = hits_[pixel(column, row)];
        for (int y = std::max(row - margin_px, 0); y <= std::min(row + margin_px, view_.camera.height - 1); ++y) {
            for (int x = std::max(column - margin_px, 0); x <= std::min(column + margin_px, view_.camera.width - 1);
                 ++x) {
                const auto& there = hits_[pixel(x, y)];
                if (here.has_value() != there.has_value()) { return true; }
                if (!here) { continue; }
                const SceneTriangle& a = scene_->triangles()[here->triangle];
                const SceneTriangle& b = scene_->triangles()[there->triangle];
                if (a.surface != b.surface || a.object != b.object) { return true; }
                const double expected = scene_->way_to_plane(here->triangle, lens_.ray(x, y));
                if (!(std::abs(expected - there->way) < 0.01 * there->way)) { return true; }
            }
        }
        return false;
    }

    void check_pixel(int column, int row) {
        const std::size_t at = pixel(column, row);
        const Vec3 ray = lens_.ray(column, row);
        ++found_.pixels;
        ++found_.of_class[std::min<std::size_t>(truth_.class_id[at], surface_class_count - 1)];
        if (static_cast<SurfaceClass>(truth_.class_id[at]) == SurfaceClass::Cloud) {
            check_cloud(column, row, ray);
            return;
        }
        const Fault fault = fault_of(at, hits_[at], ray);
        if (fault == Fault::None) {
            if (hits_[at]) {
                found_.largest_depth_error = std::max(
                    found_.largest_depth_error, std::abs(truth_.depth_m[at] - hits_[at]->way) / hits_[at]->way);
            }
            check_flow(column, row, ray);
            return;
        }
        if (agrees_beside(at, column, row, ray)) {
            ++found_.beside;
            return;
        }
        if (is_near_edge(column, row)) {
            ++found_.near_edges;
        } else {
            found_.wrong_class += fault == Fault::Class ? 1 : 0;
            found_.wrong_object += fault == Fault::Object ? 1 : 0;
            found_.wrong_depth += fault == Fault::Depth ? 1 : 0;
            found_.wrong_normal += fault == Fault::Normal ? 1 : 0;
        }
        constexpr std::array<std::string_view, 5> names{"none", "class", "object", "depth", "normal"};
        const float* const normal = &truth_.normal[3 * at];
        const std::string shown = fmt::format("{}-{} at {:.4f} m, normal {:.3f} {:.3f} {:.3f}",
            name_of(static_cast<SurfaceClass>(truth_.class_id[at])), truth_.object_id[at], truth_.depth_m[at],
            normal[0], normal[1], normal[2]);
        std::string expected = "sky";
        if (hits_[at]) {
            const SceneTriangle& triangle = scene_->triangles()[hits_[at]->triangle];
            expected = fmt::format("{}-{} at {:.4f} m, normal {:.3f} {:.3f} {:.3f}, least height {:.4f} m",
                name_of(triangle.surface), triangle.object, hits_[at]->way, triangle.normal.x, triangle.normal.y,
                triangle.normal.z, least_height_m(triangle));
        }
        tell(column, row,
            fmt::format("{}{}: {} where the ray finds {}", names[static_cast<std::size_t>(fault)],
                is_near_edge(column, row) ? " near an edge" : "", shown, expected));
    }

    /// Clouds are not exported: their layer is a level sheet that sinks, and nothing may lie before it.
    void check_cloud(int column, int row, const Vec3& ray) {
        const std::size_t at = pixel(column, row);
        const double depth = truth_.depth_m[at];
        const double level = std::hypot(ray.x, ray.y);
        const Vec3 there = plus(lens_.eye_m, times(depth, ray));
        const double height_m = there.z + (view_.is_round ? sink_m(there, lens_.eye_m) : 0.0);
        const double above_m = view_.cloud_height_m.value_or(infinite) - height_m;
        const bool is_on_layer = std::abs(above_m) <= 1e-3 * depth * level + 1.0;
        const bool is_hidden = hits_[at] && hits_[at]->way < depth * (1.0 - 1e-3);
        if (is_on_layer && !is_hidden) { return; }
        if (is_on_layer && is_near_edge(column, row)) {
            ++found_.near_edges;
            return;
        }
        ++found_.wrong_cloud;
        tell(column, row,
            fmt::format("cloud at {:.3f} m, {:.2f} m below its layer; the ray finds a surface at {:.3f} m", depth,
                above_m, hits_[at] ? hits_[at]->way : infinite));
    }

    const State& state_of(std::uint32_t object) const { return view_.states[object - 1]; }

    State sunk(State state, const Vec3& eye_m) const {
        if (view_.is_round) { state.position_m.z -= sink_m(state.position_m, eye_m); }
        return state;
    }

    /// Fills in before_in_body_: the triangles of an object in its previous state, in its body axes. They are exported
    /// for an eye that is where the present one is in body axes, as an export has the sides that the eye may see.
    void export_before(std::uint32_t object, const std::string& scratch) {
        const State& then = view_.previous_states[object - 1];
        const State& now = view_.states[object - 1];
        const Vec3 eye =
            plus(then.position_m, turned(then.attitude, turned_back(now.attitude, minus(lens_.eye_m, now.position_m))));
        const Quaternion back{now.attitude.w, -now.attitude.x, -now.attitude.y, -now.attitude.z};
        const Quaternion look = product(product(then.attitude, back), lens_.look);
        world_.export_scene(scratch, view_.camera, Pose{.eye_m = eye, .attitude = look});
        const State drawn = sunk(then, eye);
        for (const SceneTriangle& triangle : read_scene(scratch)) {
            if (triangle.object != object) { continue; }
            std::array<Vec3, 3>& corners = before_in_body_[object].emplace_back();
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = turned_back(drawn.attitude, minus(triangle.corners_m[i], drawn.position_m));
            }
        }
    }

    /// The corners of a triangle of an aircraft in the previous picture, world axes: those of the nearest triangle of
    /// the same shape in body axes. Nothing where none is within a metre.
    std::optional<std::array<Vec3, 3>> corners_before(std::size_t hit) {
        const auto [known, is_new] = before_of_.try_emplace(hit);
        if (!is_new) { return known->second; }
        const SceneTriangle& triangle = scene_->triangles()[hit];
        const State now = sunk(state_of(triangle.object), lens_.eye_m);
        const State then = sunk(view_.previous_states[triangle.object - 1], before_.eye_m);
        std::array<Vec3, 3> in_body;
        for (std::size_t i = 0; i < 3; ++i) {
            in_body[i] = turned_back(now.attitude, minus(plus(triangle.corners_m[i], lens_.eye_m), now.position_m));
        }
        const double rounding_m = 1e-5 + 1e-6 * distance(now.position_m, lens_.eye_m);
        double nearest = 1.0;
        const std::array<Vec3, 3>* found = nullptr;
        for (const std::array<Vec3, 3>& other : before_in_body_[triangle.object]) {
            double moved = 0.0;
            double changed = 0.0;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t next = (i + 1) % 3;
                moved = std::max(moved, distance(in_body[i], other[i]));
                changed =
                    std::max(changed, std::abs(distance(in_body[i], in_body[next]) - distance(other[i], other[next])));
            }
            if (changed < rounding_m && moved < nearest) {
                nearest = moved;
                found = &other;
            }
        }
        if (found != nullptr) {
            known->second.emplace();
            for (std::size_t i = 0; i < 3; ++i) {
                (*known->second)[i] = plus(then.position_m, turned(then.attitude, (*found)[i]));
            }
        }
        return known->second;
    }

    /// Where the point of a triangle was that is now at `at_m`.
    std::optional<Vec3> point_before(std::size_t hit, const Vec3& at_m) {
        const SceneTriangle& triangle = scene_->triangles()[hit];
        if (triangle.object == 0) {
            Vec3 before = at_m;
            if (view_.is_round) { before.z += sink_m(at_m, lens_.eye_m) - sink_m(at_m, before_.eye_m); }
            return before;
        }
        if (!view_.has_moving_parts[triangle.object - 1]) {
            const State now = sunk(state_of(triangle.object), lens_.eye_m);
            const State then = sunk(view_.previous_states[triangle.object - 1], before_.eye_m);
            const Vec3 in_body = turned_back(now.attitude, minus(at_m, now.position_m));
            return plus(then.position_m, turned(then.attitude, in_body));
        }
        const auto corners = corners_before(hit);
        if (!corners) { return std::nullopt; }
        const Vec3 from = minus(at_m, plus(triangle.corners_m[0], lens_.eye_m));
        const Vec3 u = minus(triangle.corners_m[1], triangle.corners_m[0]);
        const Vec3 v = minus(triangle.corners_m[2], triangle.corners_m[0]);
        const double uu = dot(u, u);
        const double uv = dot(u, v);
        const double vv = dot(v, v);
        const double det = uu * vv - uv * uv;
        const double a = (dot(from, u) * vv - dot(from, v) * uv) / det;
        const double b = (dot(from, v) * uu - dot(from, u) * uv) / det;
        return plus((*corners)[0],
            plus(times(a, minus((*corners)[1], (*corners)[0])), times(b, minus((*corners)[2], (*corners)[0]))));
    }

    void check_flow(int column, int row, const Vec3& ray) {
        const std::size_t at = pixel(column, row);
        Vec3 seen;
        if (hits_[at]) {
            const Vec3 at_m = plus(lens_.eye_m, times(hits_[at]->way, ray));
            const std::optional<Vec3> before = point_before(hits_[at]->triangle, at_m);
            if (!before) {
                ++found_.unknown_flows;
                return;
            }
            seen = before_.seen_point(*before);
        } else {
            seen = before_.seen(ray);
        }
        const double ahead = seen.x / (hits_[at] ? hits_[at]->way : 1.0);
        if (std::abs(ahead) < 0.05) { return; } // in the plane of the previous eye: no place in the picture
        ++found_.flows;
        const double right = truth_.flow_px[2 * at];
        const double down = truth_.flow_px[2 * at + 1];
        if (ahead < 0.0) {
            if (std::isnan(right) && std::isnan(down)) { return; }
        } else {
            const double size = std::hypot(column - seen.y, row - seen.z);
            const double error_px = std::hypot(right - (column - seen.y), down - (row - seen.z));
            if (error_px <= flow_tolerance_px + 2e-5 * size) {
                found_.largest_flow_error_px = std::max(found_.largest_flow_error_px, error_px);
                return;
            }
        }
        ++found_.wrong_flow;
        tell(column, row,
            fmt::format("flow {:.3f} {:.3f} where {:.3f} {:.3f} is expected, on {}-{} at {:.3f} m", right, down,
                column - seen.y, row - seen.z, name_of(static_cast<SurfaceClass>(truth_.class_id[at])),
                truth_.object_id[at], truth_.depth_m[at]));
    }

    // Boxes

    struct Counted {
        std::array<int, 4> rectangle{};
        int pixels = 0;
    };

    Counted visible(std::uint32_t object) const {
        Counted counted{{view_.camera.width, view_.camera.height, 0, 0}, 0};
        for (int row = 0; row < view_.camera.height; ++row) {
            for (int column = 0; column < view_.camera.width; ++column) {
                if (truth_.object_id[pixel(column, row)] != object) { continue; }
                ++counted.pixels;
                counted.rectangle = {std::min(counted.rectangle[0], column), std::min(counted.rectangle[1], row),
                    std::max(counted.rectangle[2], column + 1), std::max(counted.rectangle[3], row + 1)};
            }
        }
        if (counted.pixels == 0) { counted.rectangle = {}; }
        return counted;
    }

    std::array<Vec3, 8> corners(std::uint32_t object) const {
        const Object& of = world_.objects()[object - 1];
        const State state = sunk(state_of(object), lens_.eye_m);
        std::array<Vec3, 8> corners;
        for (std::size_t i = 0; i < 8; ++i) {
            const Vec3 half{((i & 1U) != 0 ? 0.5 : -0.5) * of.size_m.x, ((i & 2U) != 0 ? 0.5 : -0.5) * of.size_m.y,
                ((i & 4U) != 0 ? 0.5 : -0.5) * of.size_m.z};
            corners[i] = plus(state.position_m, turned(state.attitude, plus(of.box_centre_m, half)));
        }
        return corners;
    }

    /// The rectangle around a box, cut off in front of the eye; nothing where all of it is behind.
    std::optional<std::array<double, 4>> rectangle(const std::array<Vec3, 8>& corners) const {
        std::array<double, 4> found{infinite, infinite, -infinite, -infinite};
        const auto add = [&](const Vec3& in_camera) {
            const double x = lens_.matrix.cx + 0.5 + lens_.matrix.fx * in_camera.y / in_camera.x;
            const double y = lens_.matrix.cy + 0.5 + lens_.matrix.fy * in_camera.z / in_camera.x;
            found = {std::min(found[0], x), std::min(found[1], y), std::max(found[2], x), std::max(found[3], y)};
        };
        for (std::size_t a = 0; a < 8; ++a) {
            for (const std::size_t side : {1U, 2U, 4U}) {
                const std::size_t b = a ^ side;
                if (b < a) { continue; }
                Vec3 from = turned_back(lens_.look, minus(corners[a], lens_.eye_m));
                Vec3 to = turned_back(lens_.look, minus(corners[b], lens_.eye_m));
                if (from.x < to.x) { std::swap(from, to); }
                if (from.x < box_near_m) { continue; }
                add(from);
                if (to.x < box_near_m) {
                    to = plus(from, times((from.x - box_near_m) / (from.x - to.x), minus(to, from)));
                }
                add(to);
            }
        }
        if (found[0] > found[2]) { return std::nullopt; }
        return found;
    }

    struct Alone {
        double inside = 0.0;
        double all = 0.0;
    };

    /// Counts the pixels of an object that nothing hides, as far as two pictures beyond the picture.
    std::optional<Alone> alone(std::uint32_t object, const std::array<double, 4>& around) const {
        std::vector<SceneTriangle> own;
        for (const SceneTriangle& triangle : scene_->triangles()) {
            if (triangle.object == object) { own.push_back(triangle); }
        }
        const RayScene scene(std::move(own), {});
        const int width = view_.camera.width;
        const int height = view_.camera.height;
        const auto within = [](double at, int size) { return std::clamp(at, -2.0 * size, 3.0 * size); };
        const auto left = static_cast<int>(std::floor(within(around[0] - 1.0, width)));
        const auto top = static_cast<int>(std::floor(within(around[1] - 1.0, height)));
        const auto right = static_cast<int>(std::ceil(within(around[2] + 1.0, width)));
        const auto bottom = static_cast<int>(std::ceil(within(around[3] + 1.0, height)));
        Alone counted;
        for (int row = top; row < bottom; ++row) {
            for (int column = left; column < right; ++column) {
                if (!scene.nearest(lens_.ray(column, row), near_m)) { continue; }
                counted.all += 1.0;
                counted.inside += row >= 0 && row < height && column >= 0 && column < width ? 1.0 : 0.0;
            }
        }
        return counted;
    }

    void wrong_box(std::uint32_t object, const std::string& what) {
        ++found_.wrong_boxes;
        tell(-1, -1, fmt::format("box of object {}: {}", object, what));
    }

    void check_boxes() {
        const std::vector<Box> boxes = world_.boxes(view_.camera, std::span(&view_.pose, 1)).front();
        for (std::uint32_t object = 1; object <= world_.objects().size(); ++object) {
            const auto at = std::ranges::find(boxes, object, &Box::object_id);
            const Counted shown = visible(object);
            const std::array<Vec3, 8> corners_m = corners(object);
            const auto around = rectangle(corners_m);
            if (at == boxes.end()) {
                if (shown.pixels > 0) { wrong_box(object, "none, but it is seen"); }
                if (around) {
                    const std::optional<Alone> counted = alone(object, *around);
                    if (counted->inside > 2.0) {
                        wrong_box(object, fmt::format("none, but {} of its pixels would be seen", counted->inside));
                    }
                }
                continue;
            }
            ++found_.boxes;
            check_box(*at, shown, corners_m, around);
        }
    }

    void check_box(const Box& box, const Counted& shown, const std::array<Vec3, 8>& corners_m,
        const std::optional<std::array<double, 4>>& around) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (box.visible_px[i] != shown.rectangle[i]) {
                return wrong_box(box.object_id,
                    fmt::format("visible_px[{}] is {}, expected {}", i, box.visible_px[i], shown.rectangle[i]));
            }
        }
        if (box.pixels != shown.pixels) {
            return wrong_box(box.object_id, fmt::format("{} pixels, expected {}", box.pixels, shown.pixels));
        }
        for (std::size_t i = 0; i < 8; ++i) {
            if (distance(box.corners_m[i], corners_m[i]) > 1e-6) {
                return wrong_box(
                    box.object_id, fmt::format("corner {} off by {} m", i, distance(box.corners_m[i], corners_m[i])));
            }
        }
        if (!around) { return wrong_box(box.object_id, "one of a thing behind the eye"); }
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::abs(box.whole_px[i] - (*around)[i]) > 1e-6 * (1.0 + std::abs((*around)[i]))) {
                return wrong_box(
                    box.object_id, fmt::format("whole_px[{}] is {}, expected {}", i, box.whole_px[i], (*around)[i]));
            }
        }
        const Vec3 middle = times(0.5, plus(corners_m[0], corners_m[7]));
        if (std::abs(box.distance_m - distance(middle, lens_.eye_m)) > 1e-6) {
            return wrong_box(box.object_id, fmt::format("distance_m is {}", box.distance_m));
        }
        const std::optional<Alone> counted = alone(box.object_id, *around);
        const double all = std::max(counted->all, static_cast<double>(shown.pixels));
        const double allowed = 0.01 + 2.0 / std::max(all, 1.0);
        const double share = shown.pixels / std::max(all, 1.0);
        const double outside = 1.0 - counted->inside / std::max(all, 1.0);
        if (std::abs(box.visible_share - share) > allowed || std::abs(box.truncation - outside) > allowed) {
            wrong_box(box.object_id, fmt::format("visible_share {}, truncation {}, expected {} and {}, of {} pixels",
                                         box.visible_share, box.truncation, share, outside, all));
        }
    }

    const View& view_;
    std::string name_;
    World world_;
    Lens lens_;
    Lens before_;
    std::optional<RayScene> scene_;
    Frames truth_;
    std::vector<std::optional<RayScene::Hit>> hits_;
    std::map<std::uint32_t, std::vector<std::array<Vec3, 3>>> before_in_body_;
    std::map<std::size_t, std::optional<std::array<Vec3, 3>>> before_of_;
    Findings found_;
};

} // namespace

void Findings::add(const Findings& other) {
    pixels += other.pixels;
    for (std::size_t i = 0; i < surface_class_count; ++i) { of_class[i] += other.of_class[i]; }
    beside += other.beside;
    near_edges += other.near_edges;
    wrong_class += other.wrong_class;
    wrong_object += other.wrong_object;
    wrong_depth += other.wrong_depth;
    wrong_normal += other.wrong_normal;
    wrong_cloud += other.wrong_cloud;
    flows += other.flows;
    unknown_flows += other.unknown_flows;
    wrong_flow += other.wrong_flow;
    boxes += other.boxes;
    wrong_boxes += other.wrong_boxes;
    largest_depth_error = std::max(largest_depth_error, other.largest_depth_error);
    largest_flow_error_px = std::max(largest_flow_error_px, other.largest_flow_error_px);
    examples.insert(examples.end(), other.examples.begin(), other.examples.end());
}

Findings check_view(const World& world, const View& view, const std::string& scratch, const std::string& name) {
    return Check(world, view, scratch, name).run();
}

} // namespace octant::tests
