#include "flightpaths/track_writer.h"
#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/units.h"

#include <catch2/catch.hpp>

using namespace octant;
using namespace octant::flightpaths;

namespace {

sim::Trajectory two_samples() {
    return sim::Trajectory({{0.0, {100, 200, 150}, {0, 250, 0}, body_to_world_from_euler({0, 0.1, -0.5}), 1.0},
        {0.05, {100, 212.5, 150}, {0, 250, 0}, body_to_world_from_euler({2 * pi - 1e-7, -1e-9, 0}), 1.5}});
}

} // namespace

TEST_CASE("a track is written with its columns, and never with a minus zero or 360 degrees") {
    CHECK(track_csv(two_samples()) ==
          "t_s,north_m,east_m,alt_m,roll_deg,pitch_deg,yaw_deg,tas_mps,n_g,v_north_mps,v_east_mps,"
          "v_up_mps\n"
          "0.000000,200.0000,100.0000,150.0000,-28.6479,5.7296,0.0000,250.0000,1.0000,250.0000,"
          "0.0000,0.0000\n"
          "0.050000,212.5000,100.0000,150.0000,0.0000,0.0000,0.0000,250.0000,1.5000,250.0000,"
          "0.0000,0.0000\n");
}

TEST_CASE("a Tacview file has its header, transforms and bookmarks") {
    const octant::TransverseMercator frame({37.5, 127.1});
    CHECK(track_acmi(
              two_samples(), {"Pop-up, dive", &octant::sim::aircraft_kind("f15"), "", &frame, {{0.05, "pull|down"}}}) ==
          "FileType=text/acmi/tacview\n"
          "FileVersion=2.2\n"
          "0,ReferenceTime=2026-01-01T00:00:00Z\n"
          "0,DataSource=Octant\n"
          "0,DataRecorder=Octant\n"
          "0,Title=Pop-up\\, dive\n"
          "0,ReferenceLongitude=127.1000000\n"
          "0,ReferenceLatitude=37.5000000\n"
          "#0.000\n"
          "1,T=0.0011309|0.0018020|150.00|-28.65|5.73|0.00|100.00|200.00|0.00,Type=Air+FixedWing,"
          "Name=F-15C,Color=Blue,TAS=250.0\n"
          "#0.050\n"
          "1,T=0.0011309|0.0019146|150.00|0.00|0.00|0.00|100.00|212.50|0.00,TAS=250.0\n"
          "0,Event=Bookmark|1|pull/down\n");
}

TEST_CASE("a helicopter is a rotorcraft, another aircraft goes by its own name") {
    CHECK_THAT(track_acmi(two_samples(), {"a", &octant::sim::aircraft_kind("500md"), "", nullptr, {}}),
        Catch::Contains(",Type=Air+Rotorcraft,Name=500MD,"));
    CHECK_THAT(track_acmi(two_samples(), {"a", nullptr, "my,own\n", nullptr, {}}),
        Catch::Contains(",Type=Air+FixedWing,Name=my\\,own ,"));
}
