#include "ui/flight/flight_cameras.h"

#include "ui/flight/simulation.h"
#include "ui/world/world.h"
#include "visuals/scene/camera_rig.h"

namespace octant::ui::flight {

namespace scene = visuals::scene;

std::vector<FlightCamera> flight_cameras(const settings::RunSettings& settings) {
    const world::World world = world::load_world(settings);
    const world::PictureTimes times = world::picture_times_of(settings, world.flight);
    const GroundHeight ground = [&](double x_m, double y_m) { return world.scene.ground->height_at(x_m, y_m); };
    Simulation simulation(world);
    simulation.begin_at(times.times_s.front());
    scene::Subject subject = world.scene.model_of(0).subject;
    subject.radius_m = simulation.formation().framed_radius_m(subject.radius_m);
    std::vector<FlightCamera> cameras;
    for (const double time_s : times.times_s) {
        simulation.advance_to(time_s);
        const sim::AircraftState& state = simulation.states().front();
        cameras.push_back({scene::camera_of(settings.view, state, simulation.rig(), subject, world.points, ground),
            state.position_m, subject.radius_m});
    }
    return cameras;
}

} // namespace octant::ui::flight
