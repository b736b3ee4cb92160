#include "flightpaths/recorded_track.h"
#include "flightpaths/track_writer.h"
#include "sim/base/output_file.h"
#include "tests/fuzz/formats/target.h"

#include <cmath>

namespace octant::tests::formats::track_format {

namespace {

/// Asks for states between the samples, and writes and reads the track again to the last bit.
void use(const std::filesystem::path& file) {
    const flightpaths::RecordedTrack track = flightpaths::read_recorded_track(file);
    const sim::Trajectory& flight = track.trajectory;
    for (int step = 0; step <= 20; ++step) {
        const double time_s = flight.start_s() + step / 20.0 * (flight.end_s() - flight.start_s());
        const sim::AircraftState state = flight.state_at(time_s);
        for (int part = 0; part < 3; ++part) {
            expect(std::isfinite(state.position_m[part]), "a place");
            expect(std::isfinite(state.velocity_mps[part]), "a velocity");
        }
        expect(std::abs(glm::length(state.body_to_world) - 1.0) < 1e-5, "a unit attitude");
    }
    const std::string text = flightpaths::exact_track_csv(flight);
    const std::filesystem::path written = file.parent_path() / "again.csv";
    write_file(written, text);
    const flightpaths::RecordedTrack again = flightpaths::read_recorded_track(written);
    expect(flightpaths::exact_track_csv(again.trajectory) == text, "the same track again");
}

std::vector<std::string> seeds() {
    return {"t_s,north_m,east_m,alt_m\n0,0,0,300\n0.5,60,0,300\n1,120,2,301\n2,240,9,300\n",
        "t_s,north_m,east_m,alt_m,roll_deg,pitch_deg,yaw_deg,v_north_mps,v_east_mps,v_up_mps,n_g\n"
        "0,0,0,300,0,1,2,100,0,0,1\n0.05,5,0,300,3,1,2,100,0,0,1.1\n0.1,10,0,300,6,1,2,100,0,0,1."
        "2\n",
        "t_s,north_m,east_m,alt_m,v_north_mps,v_east_mps,v_up_mps,n_g,q_w,q_x,q_y,q_z\n"
        "0,0,0,300,100,0,0,1,1,0,0,0\n0.1,10,0,300,100,0,0,1,0.6,0.8,0,0\n",
        "Timestamp,UTC,Callsign,Position,Altitude\n1704180175,2024-01-02T07:22:55Z,A1,\"47.0,8.0\","
        "1000\n1704180177,2024-01-02T07:22:57Z,A1,\"47.001,8.0\",1000\n",
        "#airframe_info\n#yyy-mm-dd, hh:mm:ss, degrees, degrees, ft msl, deg, deg\n  Lcl Date, Lcl "
        "Time, "
        "Latitude, Longitude, AltMSL, Pitch, Roll\n2021-06-13, 23:59:59, 47.0, 8.0, 1000, 4, -20\n"
        "2021-06-14, 00:00:00, 47.001, 8.0, 1000, 4, -20\n",
        "time,lat,lon,hMSL,velN,velE,velD\n,(deg),(deg),(m),(m/s),(m/s),(m/s)\n"
        "2018-08-12T14:25:43.07Z,47.1,15.4,3474.0,24.1,-45.3,-0.8\n"
        "2018-08-12T14:25:43.27Z,47.10001,15.4,3474.0,24.1,-45.3,-0.8\n",
        "AXCS123\r\nHFDTE160701\r\nB2359584700000N00800000EA0048000500120\r\n"
        "B2359594700060N00800000EV0048000500120\r\nB0000004700120N00800000EA-048000500120\r\n",
        "<?xml version=\"1.0\"?>\n<gpx><!-- a --><trk><trkseg><trkpt lat=\"47\" "
        "lon=\"8\"><ele>500</ele>"
        "<time>2024-01-02T23:59:58Z</time></trkpt>\n<trkpt lon='8.0' lat='47.001'><time>2024-01-02T"
        "23:59:59Z</time><ele>500.0</ele></trkpt></trkseg></trk></gpx>\n",
        "Time\tLatitude Geodetic (deg)\tLongitude (deg)\tAltitude ASL (ft)\tPhi (deg)\tTheta "
        "(deg)\t"
        "Psi (deg)\tV_{North} (ft/s)\tV_{East} (ft/s)\tV_{Down} (ft/s)\n"
        "0\t49.3\t-123.1\t1000\t0\t0\t90\t0\t200\t0\n1\t49.3\t-123."
        "0992\t1000\t0\t0\t90\t0\t200\t0\n"};
}

const Registered target({
    .name = "track",
    .file = "input.csv",
    .use = use,
    .seeds = seeds,
    .words = {"t_s,", "q_w,", "n_g,", "<trkpt", "</trkpt>", "<!--", "Time\t", "Longitude (deg)\t", "Latitude (deg)\t",
        ",,", "\r\n", "1e7", "90", "180", "-180"},
});

} // namespace

} // namespace octant::tests::formats::track_format
