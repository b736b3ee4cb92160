#include "flightpaths/acmi_recording.h"
#include "sim/base/text_file.h"
#include "tests/fuzz/formats/target.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace octant::tests::formats::acmi_format {

namespace {

void use(const std::filesystem::path& file) {
    const flightpaths::AcmiRecording tape = flightpaths::parse_acmi(read_text_file(file), file);
    expect(!tape.aircraft.empty(), "an aircraft");
    expect(tape.aircraft.size() <= flightpaths::max_taped_aircraft, "no more than so many");
    expect(std::isfinite(tape.origin.latitude_deg), "an origin");
    for (const flightpaths::RecordedAircraft& aircraft : tape.aircraft) {
        const auto samples = aircraft.trajectory.samples();
        expect(samples.size() >= 2, "two samples");
        for (const sim::AircraftState& state : samples) {
            expect(state.time_s >= 0.0 && state.time_s <= 2.0 * 86400.0, "a time");
            for (int part = 0; part < 3; ++part) {
                expect(std::isfinite(state.position_m[part]), "a place");
                expect(std::isfinite(state.velocity_mps[part]), "a velocity");
            }
            expect(std::abs(glm::length(state.body_to_world) - 1.0) < 1e-6, "a unit attitude");
        }
    }
}

constexpr const char* all_forms = "\xef\xbb\xbf"
                                  R"(FileType=text/acmi/tacview
FileVersion=2.2
0,ReferenceTime=2026-01-01T00:00:00Z,ReferenceLongitude=120,ReferenceLatitude=35
0,Title=one\, two
// a remark
#0.00
1,T=7.1|2.5|150|1.2|-3|88,Type=Air+FixedWing,Name=F-15C,Color=Blue
2,T=7.2|2.5|150,Type=Air+Rotorcraft,Name=OH\-6
3,T=7.2|2.6|20|-1000|2000,Type=Sea+Watercraft
a4,T=7.2|2.6|900|0|0|10|-1000|2000|10,Name=broken \
over two lines
#0.50
1,T=|2.5001||||
2,T=7.2001||
a4,T=|2.6001|||||||
#1.00
1,T=|2.5002|||2|
2,T=7.2002||
-a4
0,Event=Bookmark|1|pull-down
#0.75
2,T=7.20015||
)";

constexpr const char* without_attitude = R"(FileType=text/acmi/tacview
FileVersion=2.1
#10
1,T=8|47|900
#11
1,T=8|47.001|900
#12
1,T=8|47.002|901
-1
#13
1,T=8|47.1|900,Type=Air
#14
1,T=8|47.101|900
)";

const Registered target({
    .name = "acmi",
    .file = "input.acmi",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{all_forms, without_attitude};
        },
    .words = {"#", "-", "T=", "|", "||", "|||||||", ",", "\\,", "\\\n", "//", "0,", "1,", "ffffffffffffffff,",
        "Type=Air+FixedWing", "Type=Weapon+Missile",
        "Name=", "ReferenceLongitude=", "ReferenceLatitude=", "FileVersion=2.", "1e300", "nan", "-90"},
});

} // namespace

} // namespace octant::tests::formats::acmi_format
