#include "ui/flight_cameras.h"

#include "sim/fixed_step.h"
#include "ui/world.h"
#include "visuals/scene/camera_rig.h"

#include <algorithm>
#include <cmath>

namespace octant::ui {

namespace scene = visuals::scene;

std::vector<FlightCamera> flight_cameras(const scene::Settings& settings) {
    const World world = load_world(settings);
    const sim::Trajectory& path = world.flight.trajectory;
    const scene::GroundHeight ground = [&](double x_m, double y_m) {
        return world.scene.ground->height_at(x_m, y_m);
    };
    scene::Subject subject = world.scene.models[world.scene.aircraft.front()].subject;
    subject.radius_m = formation_of(world.scene).framed_radius_m(subject.radius_m);
    const double length_s = std::min(path.end_s() - path.start_s(), settings.seconds.value_or(1e9));
    long count = static_cast<long>(std::floor(length_s * settings.rate_hz + 1e-6)) + 1;
    count = std::min(count, static_cast<long>(settings.frames.value_or(1000000000)));
    scene::RigMemory rig = scene::advanced({}, path.state_at(path.start_s()));
    long next_step = sim::step_at(path.start_s());
    std::vector<FlightCamera> cameras;
    for (long frame = 0; frame < count; ++frame) {
        const double time_s = path.start_s() + static_cast<double>(frame) / settings.rate_hz;
        for (; next_step <= sim::step_at(time_s); ++next_step) {
            rig = scene::advanced(rig, path.state_at(sim::time_of_step(next_step)));
        }
        const sim::AircraftState state = path.state_at(time_s);
        cameras.push_back(
            {scene::camera_of(settings, state, rig, subject, world.points, ground),
             state.position_m,
             subject.radius_m});
    }
    return cameras;
}

} // namespace octant::ui
