#include "tests/ui/library/rays/views.h"

#include "tests/ui/library/rays/vectors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <span>
#include <stdexcept>

namespace octant::tests {

namespace {

constexpr double pi = 3.14159265358979323846;

/// A body of 9,600 triangles, so many that it is refined in each picture.
void write_lumpy_body(const std::string& file) {
    std::ofstream out(file);
    constexpr int around = 80;
    constexpr int along = 61;
    const auto put = [&](double angle, double turn) {
        const double size = 1.0 + 0.12 * std::sin(5.0 * turn) * std::sin(3.0 * angle) + 0.05 * std::sin(11.0 * angle);
        out << fmt::format("v {:.5f} {:.5f} {:.5f}\n", 3.0 * size * std::sin(angle) * std::cos(turn),
            2.0 * size * std::sin(angle) * std::sin(turn), 7.0 * size * std::cos(angle));
    };
    put(0.0, 0.0);
    for (int ring = 1; ring < along; ++ring) {
        for (int i = 0; i < around; ++i) { put(pi * ring / along, 2.0 * pi * i / around); }
    }
    put(pi, 0.0);
    const auto vertex = [&](int ring, int i) { return 2 + (ring - 1) * around + i % around; };
    const int last = 2 + (along - 1) * around;
    for (int i = 0; i < around; ++i) {
        out << fmt::format("f 1 {} {}\n", vertex(1, i), vertex(1, i + 1));
        for (int ring = 1; ring + 1 < along; ++ring) {
            const int a = vertex(ring, i);
            const int b = vertex(ring, i + 1);
            const int c = vertex(ring + 1, i);
            const int d = vertex(ring + 1, i + 1);
            out << fmt::format("f {} {} {}\nf {} {} {}\n", a, c, d, a, d, b);
        }
        out << fmt::format("f {} {} {}\n", last, vertex(along - 1, i + 1), vertex(along - 1, i));
    }
}

/// Hills around a lake whose surface is 20 m high, 50 m from sample to sample.
void write_lake(const std::string& file) {
    std::ofstream out(file);
    constexpr int size = 257;
    out << fmt::format("ncols {0}\nnrows {0}\nxllcorner 0\nyllcorner 0\ncellsize 50\n", size);
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            const double height =
                30.0 * std::sin(0.05 * column) * std::cos(0.04 * row) + 3.0 * std::sin(0.7 * column + 0.3 * row) + 30.0;
            out << fmt::format("{:.2f} ", std::max(height, 20.0));
        }
        out << '\n';
    }
}

void make_map(const std::string& file) {
    const std::string command =
        "\"" OCTANT_PROGRAM "\" terrain make --kind hills --size 513 --seed 7 --out \"" + file + "\" >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0) { throw std::runtime_error("cannot make " + file); }
}

/// Numbers that are the same on every machine.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL + 1) { next(); }

    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(next() >> 11U) * 0x1p-53;
    }

private:
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31U);
    }

    std::uint64_t state_;
};

} // namespace

std::vector<TriedWorld> tried_worlds(const std::string& folder) {
    const std::string body = folder + "/body.obj";
    const std::string lake = folder + "/lake.asc";
    const std::string map = folder + "/made.tif";
    write_lumpy_body(body);
    write_lake(lake);
    make_map(map);
    const auto world = [&](std::string name, std::string terrain, int triangles,
                           std::vector<std::pair<std::string, std::string>> settings) {
        TriedWorld made{std::move(name), {}};
        made.settings.terrain = std::move(terrain);
        made.settings.aircraft = {"f15-detailed", "500md-detailed", body};
        made.settings.triangles = triangles;
        made.settings.settings = std::move(settings);
        made.settings.on_note = [](std::string_view) {};
        return made;
    };
    return {world("hills", "hills", 3000, {}), world("canyon", "canyon", 5000, {}),
        world("lake", lake, 3000, {{"water-level", "20"}, {"terrain-spacing", "50"}}), world("map", map, 2000, {}),
        world("detail", lake, 20000, {{"terrain-spacing", "50"}, {"airfield", "true"}, {"path", "turn"}}),
        world("clouds", "hills", 3000, {{"clouds", "0.6"}, {"cloud-height", "1500"}})};
}

std::vector<Vec3> busy_places(const World& world) {
    constexpr std::size_t candidates = 600;
    constexpr std::size_t wanted = 5;
    constexpr double down_deg = -20.0;
    Camera camera{48, 32, 60.0};
    camera.samples = 1;
    const Intrinsics matrix = camera.matrix();
    const std::vector<Vec3> eyes = world.random_positions(candidates, 30.0, 90.0, 3);
    std::vector<Pose> poses;
    for (const Vec3& eye : eyes) {
        poses.push_back({.eye_m = eye, .attitude = attitude(77.0 * static_cast<double>(poses.size()), down_deg)});
    }
    const Frames frames = world.render(camera, poses, Output::ClassId | Output::Depth);
    const std::size_t pixels = frames.class_id.size() / candidates;
    std::vector<Vec3> busy;
    for (const SurfaceClass surface : {SurfaceClass::Building, SurfaceClass::Road, SurfaceClass::Runway}) {
        std::vector<std::pair<std::ptrdiff_t, std::size_t>> by_count; // the greatest first
        for (std::size_t i = 0; i < candidates; ++i) {
            const auto of_picture = std::span(frames.class_id).subspan(i * pixels, pixels);
            by_count.emplace_back(-std::ranges::count(of_picture, static_cast<std::uint8_t>(surface)), i);
        }
        std::ranges::sort(by_count);
        for (std::size_t i = 0; i < wanted && by_count[i].first < 0; ++i) {
            const std::size_t picture = by_count[i].second;
            for (std::size_t pixel = picture * pixels; pixel < (picture + 1) * pixels; ++pixel) {
                if (frames.class_id[pixel] != static_cast<std::uint8_t>(surface)) { continue; }
                const std::size_t in_picture = pixel - picture * pixels;
                const auto width = static_cast<std::size_t>(camera.width);
                const Vec3 ray{1.0, (static_cast<double>(in_picture % width) - matrix.cx) / matrix.fx,
                    (static_cast<double>(in_picture / width) - matrix.cy) / matrix.fy};
                busy.push_back(plus(eyes[picture], times(frames.depth_m[pixel], turned(poses[picture].attitude, ray))));
                break;
            }
        }
    }
    return busy;
}

View tried_view(const World& world, const TriedWorld& of, const std::vector<Vec3>& busy, std::size_t index) {
    Dice dice(1000 * index + of.name.size() + static_cast<std::size_t>(of.name.front()));
    View view;
    const auto kind = index % 5;
    view.camera.width = 128;
    view.camera.height = 96;
    view.camera.fov_deg = dice.between(25.0, 100.0);
    const auto [east_m, north_m] = world.half_extent_m();
    const auto on_ground = [&](double x_m, double y_m, double above_m) {
        const double height_m = world.height_m(x_m, y_m);
        return Vec3{x_m, y_m, (std::isnan(height_m) ? 0.0 : height_m) + above_m};
    };
    double x_m = dice.between(-0.6, 0.6) * east_m;
    double y_m = dice.between(-0.6, 0.6) * north_m;
    if (index % 2 == 1 && !busy.empty()) {
        const Vec3& place = busy[index / 2 % busy.size()];
        x_m = place.x + dice.between(-60.0, 60.0);
        y_m = place.y + dice.between(-60.0, 60.0);
    }
    // The aircraft, often low, sometimes one in another one or in the ground.
    const double spread_m = kind == 4 ? 60.0 : 12.0;
    const double above_m = kind == 2 ? dice.between(1.0, 8.0) : dice.between(3.0, 250.0);
    for (std::size_t i = 0; i < world.objects().size(); ++i) {
        State state;
        state.position_m = on_ground(x_m, y_m, above_m);
        state.position_m =
            plus(state.position_m, {dice.between(-1.0, 1.0) * spread_m, dice.between(-1.0, 1.0) * spread_m,
                                       dice.between(-0.3, 0.3) * spread_m});
        state.attitude = attitude(dice.between(0.0, 360.0), dice.between(-40.0, 40.0), dice.between(-120.0, 120.0));
        state.time_s = dice.between(0.0, 10.0);
        view.states.push_back(state);
        view.has_moving_parts.push_back(world.objects()[i].kind.starts_with("500md"));
        // A little before: the tail rotor has turned by 3.6 degrees.
        state.time_s -= 0.0002;
        state.position_m =
            plus(state.position_m, {dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), dice.between(-0.5, 0.5)});
        state.attitude = product(state.attitude, attitude(dice.between(-2.0, 2.0), dice.between(-2.0, 2.0), 0.0));
        view.previous_states.push_back(state);
    }
    const State& subject = view.states[index / 5 % view.states.size()];
    const Object& subject_is = world.objects()[index / 5 % view.states.size()];
    const double azimuth = dice.between(0.0, 2.0 * pi);
    const double elevation = dice.between(-0.6, 1.2);
    const Vec3 away{
        std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation)};
    Vec3 eye = subject.position_m;
    Vec3 target = subject.position_m;
    switch (kind) {
    case 0:
        eye = plus(eye, times(dice.between(9.0, 40.0), away));
        break;
    case 1:
        eye = plus(eye, times(60.0 * std::pow(40.0, dice.between(0.0, 1.0)), away));
        break;
    case 2:
        eye = plus(eye, {30.0 * std::cos(azimuth), 30.0 * std::sin(azimuth), 0.0});
        eye = on_ground(eye.x, eye.y, dice.between(1.5, 12.0));
        break;
    case 3: {
        const Vec3 half{0.5 * dice.between(-1.0, 1.0) * subject_is.size_m.x,
            0.5 * dice.between(-1.0, 1.0) * subject_is.size_m.y, 0.5 * dice.between(-1.0, 1.0) * subject_is.size_m.z};
        eye = plus(eye, turned(subject.attitude, plus(subject_is.box_centre_m, half)));
        target = plus(target, {dice.between(-3.0, 3.0), dice.between(-3.0, 3.0), dice.between(-3.0, 3.0)});
        break;
    }
    default:
        eye = on_ground(x_m + dice.between(-900.0, 900.0), y_m + dice.between(-900.0, 900.0),
            30.0 * std::pow(100.0, dice.between(0.0, 1.0)));
        break;
    }
    const double least_m = 1.2; // above the ground
    eye.z = std::max(eye.z, on_ground(eye.x, eye.y, least_m).z);
    view.pose.eye_m = eye;
    view.pose.attitude = product(
        look_at(eye, target), attitude(dice.between(-8.0, 8.0), dice.between(-8.0, 8.0), dice.between(-30.0, 30.0)));
    view.pose.previous_eye_m = plus(eye, {dice.between(-0.5, 0.5), dice.between(-0.5, 0.5), dice.between(-0.2, 0.5)});
    view.pose.previous_attitude = product(
        view.pose.attitude, attitude(dice.between(-1.5, 1.5), dice.between(-1.5, 1.5), dice.between(-1.5, 1.5)));
    for (const auto& [name, value] : of.settings.settings) {
        if (name == "cloud-height") { view.cloud_height_m = std::stod(value); }
    }
    return view;
}

} // namespace octant::tests
