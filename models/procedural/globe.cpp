// The coloured globe of the 2005 simplification paper, whose own file is not to be had: its numbers
// of vertices and faces are those of a sphere of 192 meridians, 192 rings and two poles.
//
// Land and sea: Natural Earth, 1:50m countries (public domain, naturalearthdata.com), as packed in
// r-cran-rnaturalearthdata 0.1.0. Made once: a bit is 1 where the vertex lies inside a country's
// outline (even-odd, longitude by longitude along the ring). The colours by latitude are made up.

#include "models/procedural/globe.h"

#include "sim/base/units.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace octant::models::procedural {

namespace {

constexpr std::uint32_t meridians = 192;
constexpr std::uint32_t globe_rings = 192;

/// A line a ring from north to south, four meridians a digit from 180 degrees west on eastward, the
/// westernmost in the highest bit.
constexpr std::array<std::string_view, globe_rings> land_bits = {
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "0000000000000000000f8000000000000000000000000000",
    "00000000000007fe017ff800000000000000000000000000",
    "0000000000007ff8fffff8c0000000000000000000000000",
    "0000000000073bf7ffffff0000000052c000380000000000",
    "000000000007df83fffffe00034e000000001c0000000000",
    "000000000061bf9ffffffc0001f000000000038000000000",
    "000000001c101e3ffffffc00008800000000000000000000",
    "00000000e0047c1ffffffe0000400000080003c000000000",
    "00000000ba710000fffffc0000000000700037f800200000",
    "000000000717fc003ffffa00000000038001fff800398000",
    "00000003c00000003ffffc00000000030009ffe800100000",
    "00000003d1937b001fffd00000000006021fffbf38000000",
    "00000003ff185b001ffff80000000004062ffffffc1f0000",
    "c00000003f827fe00ffff8000000000c0ebffffffdff8000",
    "001f800807c67dd00fffc000000780000efffffffffffc00",
    "003ffc193fcd10f00ffff000003fc00066ffffffffffffce",
    "80fffffff98158f00fffc000007ff883ffffffffffffffff",
    "e07ffffffdfbf93c0ffe0000007ffcbffedfffffffffffff",
    "e83ffffffffff87f0ffc000000ffdcfffbffffffffffffff",
    "fdffffffffffc0720ff80b8001f3e3ffffffffffffffffff",
    "10dffffffffff1f803e00f8001f3ebffffffffffffffffff",
    "001fffffffff343c07e00f0003f7f7ffffffffffffffffff",
    "007fffffffff001c03c000000fcfffffffffffffffffffff",
    "00fffffffffe01c003c000001fcffffffffffffffffffefc",
    "007f7ffffffc01e001c000000fcffffffffffffffffff2f0",
    "017e8ffffffc01e0008000000fccffffffffffffffffe180",
    "003c03fffffc01e2000000000fc7fffffffffffffffa2300",
    "000c007ffffe01f600000002098bfffffffffffffff00600",
    "000800fffffe00ff0000000601abffffffffffffffe00e00",
    "0010003fffffc2fe00000002058fffffffffffffffc00f00",
    "0020003fffffe1ff00000007070fffffffffffffff801e00",
    "0000001ffffffbffc000000d045fffffffffffffff800e00",
    "0100001ffffffbff400000190ffffffffffffffffff00c00",
    "0000000ffffffbffe000001b9ffffffffffffffffff80800",
    "0000000ffffffbffc00000139ffffffffffffffffff80800",
    "00000007ffffffffa0000003ffffffffffffffffffe81000",
    "00000007fffffff8200000007fffffffffffffffffe80000",
    "00000001fffffff470000000ffffffffffffffffffe80000",
    "00000003ffffffe870000003ffffffffffffffffffe80000",
    "00000003fffffffc00000001ffffffffffffffffffc80000",
    "00000003fffffffc80000000ffffa7e7ffffffffffc00000",
    "00000003fffffffb00000000feff3fcfffffffffffc10000",
    "00000003fffffff400000000fe7f07dfffffffffff8a0000",
    "00000003ffffffe00000000fd33e03cfffffffffff0c0000",
    "00000003ffffffe00000000fc73e01c7fffffffffc080000",
    "00000003ffffffe00000000fc19f31e7fffffffffc000000",
    "00000003ffffff800000000f84d8ffe7ffffffffb8100000",
    "00000003ffffff800000000f041bffe7ffffffff58100000",
    "00000001ffffff000000001f8019ffe7fffffffe18100000",
    "00000001ffffff000000000f0189ffe7ffffffff08100000",
    "00000000ffffff00000000062c89fff7ffffffff8c700000",
    "00000000ffffff00000000007c000fffffffffff8c700000",
    "00000000fffffe0000000007fc002fffffffffff09c00000",
    "000000007ffffe0000000007fc001fffffffffff82000000",
    "000000003ffffc000000000ffe001fffffffffff83000000",
    "000000003ffff8000000000fff981fffffffffff82000000",
    "000000002ffff8000000001fff9edfffffffffff80000000",
    "000000000fff98000000001fffffffffffffffff80000000",
    "0000000017fc08000000001fffffffcfffffffffc0000000",
    "0000000007f808000000003fffffffcfffffffff80000000",
    "000000001bf80c000000007fffffdfe7ffffffff80000000",
    "000000000bf806000000007fffffefe1ffffffff00000000",
    "0000000003f804000000007fffffefe3ffffffff00000000",
    "0000000001f000000000007fffffeff20fffffff00000000",
    "0000000004f00000000000ffffffe7fe07fffffe00000000",
    "0000000000f00c00000000fffffff7ff07fffffc00000000",
    "0000000000f01200000001fffffff7ff07fe3ff800000000",
    "0000000000f8c100000000fffffff7ff03fe3fc000000000",
    "0004000000f8c180000000fffffff3fe01fc3f9000000000",
    "000400000078c020000000fffffff3fe01fc3fa000000000",
    "00000000003fc120000000fffffff9fe01f81f8040000000",
    "00000000001f8000000000fffffff9fc00f81fc040000000",
    "00000000000f8000000000fffffff9f000f01fc040000000",
    "000000000001f000000000fffffffdf000e007e080000000",
    "000000000001f000000001ffffffffe000e007e000000000",
    "0000000000007000000000fffffffec000e007e040000000",
    "0000000000003000000000ffffffff0400e005e000000000",
    "0000000000003000000000fffffffe10006005e000000000",
    "00000000000010f00000007fffffff70006004c000000000",
    "00000000000010df0000007ffffffff00060008000000000",
    "0000000000000eff0000003fffffffe00050048010000000",
    "00000000000004ff8000003fffffffe00010040030000000",
    "00000000000001ff8000003fffffffe00010200000000000",
    "00000000000001ffc000001f9fffffe00010020210000000",
    "00000000000001fff000000d1fffffc000001b0300000000",
    "00000000000001fff800000007ffffc000000b0600000000",
    "00000000000001fff800000003ffff8000000d0600000000",
    "00000000000001fff800000003ffff800000050e00000000",
    "00000000000003fffc00000003ffff0000000e1f08000000",
    "00000000000003fffc00000003ffff000000061ee0000000",
    "00000000000003fffe00000007fffe000000031ec8000000",
    "00000000000007fffd00000007fffe000000031ec3000000",
    "00000000000007ffff80000003fffc000000031e80600000",
    "00000000000003fffff0000003fffc000000018ec5784000",
    "00000000000007fffff0000001fffc0000000180c0fc0000",
    "00000000000007fffffc000001fff80000000080c03c4000",
    "00000000000007fffffc000001fffc0000000000003e8000",
    "00000000000003fffffc000001fffc0000000078003e0000",
    "00000000000003fffffc000000fffc000000001c023a0000",
    "00000000000001fffffc000000fffc000000000210090000",
    "00000000000001fffff8000000fffc0000000000a0010000",
    "00000000000001fffff8000000fffc000000000000080000",
    "00000000000001fffff8000000fffc000000000003080040",
    "00000000000000fffff0000000fffc000000000003880000",
    "08000000000000fffff0000001fffc200000000003880000",
    "00000000000000fffff0000001fffc20000000001b8c0000",
    "00000000000000fffff0000001fffc60000000001f8c0040",
    "000000000000007ffff0000001fffce0000000003fcc0000",
    "000000000000003ffff0000001fff8e0000000003fec0000",
    "000000000000001fffe0000001fff0e0000000003ffc0001",
    "000000000000001fffe0000001fff0e0000000007ffe0001",
    "000000000000001fffe0000001ffe0e000000000ffff0000",
    "000000000000001fffe0000000ffe0c000000003ffff0080",
    "000000000000001fffe0000000ffe0c000000003ffff0000",
    "000000000000001fff80000000ffe0c000000007ffff8000",
    "000000000000001fff00000000ffe0c000000007ffff8000",
    "000000000000001ffe00000000ffe0c000000007ffffc000",
    "000000000000001ffe00000000ffc00000000007ffffc000",
    "000000000000001ffe000000007fc00000000007ffffc000",
    "000000000000001ffe000000007fc00000000007ffffc000",
    "000000000000001ffc000000007fc00000000003ffffc000",
    "000000000000003ffc000000003f800000000003ffffc000",
    "000000000000003ff8000000003f800000000003ffffc000",
    "000000000000003ff8000000003f800000000003ffffc000",
    "000000000000003ff8000000003f000000000003f8ffc000",
    "000000000000003ff0000000003e000000000003e0ff8000",
    "000000000000003ff00000000034000000000003003f8000",
    "000000000000003fc00000000000000000000001003f8000",
    "000000000000003fc00000000000000000000000005f8004",
    "000000000000007fc00000000000000000000000001f0000",
    "000000000000007fc00000000000000000000000001f0003",
    "000000000000007f80000000000000000000000000020002",
    "000000000000007e00000000000000000000000000000006",
    "000000000000007e00000000000000000000000000000002",
    "000000000000007c00000000000000000000000000030008",
    "000000000000003e00000000000000000000000000020008",
    "000000000000003c00000000000000000000000000020018",
    "000000000000003c00000000000000000000000000000030",
    "000000000000007800000000000000000000000000000030",
    "000000000000007000000000000000000000000000000060",
    "000000000000007800000000000000000000000000000000",
    "00000000000000f800000000000000000000000000000000",
    "000000000000007800000000000000000400000000000000",
    "000000000000007000000000000000000000000000000000",
    "00000000000000f000000000000000000000000000000000",
    "00000000000000f080000000000000000000000000000000",
    "000000000000007000000000000000000000000000000000",
    "000000000000007000000000000000000000000000000000",
    "000000000000003800000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000040000000000000000000000000000000",
    "000000000000000000000000000000000000000000000000",
    "000000000000000040000000000000000000000000000000",
    "000000000000000300000000000000000000000000000000",
    "000000000000000200000000000000000000000000000000",
    "0000000000000004000000000000001c00007fdc33e00000",
    "000000000000000c000000000000007fe007fffffff80000",
    "000000000000000600000000000003fffc3fffffffff8000",
    "000000000000002f00000000000023fff87ffffffffffc00",
    "000000000000001e0000000005a2fffff9fffffffffffc00",
    "000000000000003f0000001c7ffffffff9ffffffffffffe0",
    "00000000001c00170000003ffffffffff3ffffffffffffe0",
    "000000000038809e000000fffffffffff7ffffffffffff80",
    "00000001103fffff000000ffffffffffffffffffffffff00",
    "000000fff80ffffe000001fffffffffffffffffffffffe00",
    "00003ffffffffff800003ffffffffffffffffffffffffe00",
    "0000bffffffffe000000fffffffffffffffffffffffffe00",
    "000ffffffffffb800103ffffffffffffffffffffffffff00",
    "0047fffffffff0100307ffffffffffffffffffffffffff00",
    "00307fffffffff0007c11ffffffffffffffffffffffffc00",
    "00007fffffffff218c03fffffffffffffffffffffffffc00",
    "0003fffffffffffe003ffffffffffffffffffffffffffe00",
    "0001fffffffffffe1fffffffffffffffffffffffffffff80",
    "03cffffffffffffffffffffffffffffffffffffffffffff0",
    "c0ffffffffffffffffffffffffffffffffffffffffffffff",
    "ffffffffffffffffffffffffffffffffffffffffffffffff",
    "ffffffffffffffffffffffffffffffffffffffffffffffff",
    "ffffffffffffffffffffffffffffffffffffffffffffffff",
    "ffffffffffffffffffffffffffffffffffffffffffffffff",
    "ffffffffffffffffffffffffffffffffffffffffffffffff"};

constexpr glm::vec3 sea(0.05F, 0.16F, 0.42F);
constexpr glm::vec3 ice(0.90F, 0.93F, 0.96F);
constexpr glm::vec3 tundra(0.45F, 0.42F, 0.30F);
constexpr glm::vec3 forest(0.10F, 0.35F, 0.08F);
constexpr glm::vec3 desert(0.72F, 0.58F, 0.30F);

double latitude_rad(std::uint32_t ring) {
    return 0.5 * pi - pi * (ring + 1) / (globe_rings + 1);
}

double longitude_rad(std::uint32_t meridian) {
    return -pi + 2.0 * pi * meridian / meridians;
}

bool is_land(std::uint32_t ring, std::uint32_t meridian) {
    const char digit = land_bits[ring][meridian / 4];
    const int four = digit <= '9' ? digit - '0' : digit - 'a' + 10;
    return (four >> (3 - meridian % 4) & 1) != 0;
}

glm::vec3 land_colour(double latitude_deg) {
    const double away_deg = std::abs(latitude_deg);
    if (latitude_deg < -60.0 || away_deg > 74.0) {
        return ice;
    }
    if (away_deg > 60.0) {
        return tundra;
    }
    return away_deg > 15.0 && away_deg < 33.0 ? desert : forest;
}

void add_vertex(TriangleMesh& mesh, double north_rad, double east_rad, const glm::vec3& colour) {
    mesh.vertices_m.emplace_back(
        std::cos(north_rad) * std::cos(east_rad),
        std::cos(north_rad) * std::sin(east_rad),
        std::sin(north_rad));
    mesh.colours.push_back(colour);
}

void add_vertices(TriangleMesh& mesh) {
    mesh.vertices_m.emplace_back(0.0, 0.0, 1.0);
    mesh.colours.push_back(sea);
    for (std::uint32_t ring = 0; ring < globe_rings; ++ring) {
        const double north_rad = latitude_rad(ring);
        const glm::vec3 land = land_colour(deg_from_rad(north_rad));
        for (std::uint32_t meridian = 0; meridian < meridians; ++meridian) {
            add_vertex(
                mesh, north_rad, longitude_rad(meridian), is_land(ring, meridian) ? land : sea);
        }
    }
    mesh.vertices_m.emplace_back(0.0, 0.0, -1.0);
    mesh.colours.push_back(ice);
}

void add_triangles(TriangleMesh& mesh) {
    constexpr std::uint32_t south_pole = globe_rings * meridians + 1;
    const auto vertex = [](std::uint32_t ring, std::uint32_t meridian) {
        return 1 + ring * meridians + meridian % meridians;
    };
    for (std::uint32_t i = 0; i < meridians; ++i) {
        mesh.triangles.push_back({0, vertex(0, i), vertex(0, i + 1)});
    }
    for (std::uint32_t ring = 0; ring + 1 < globe_rings; ++ring) {
        for (std::uint32_t i = 0; i < meridians; ++i) {
            const std::uint32_t north_west = vertex(ring, i);
            const std::uint32_t south_east = vertex(ring + 1, i + 1);
            mesh.triangles.push_back({north_west, vertex(ring + 1, i), south_east});
            mesh.triangles.push_back({north_west, south_east, vertex(ring, i + 1)});
        }
    }
    for (std::uint32_t i = 0; i < meridians; ++i) {
        mesh.triangles.push_back(
            {south_pole, vertex(globe_rings - 1, i + 1), vertex(globe_rings - 1, i)});
    }
}

} // namespace

TriangleMesh globe() {
    TriangleMesh mesh;
    mesh.name = "globe";
    add_vertices(mesh);
    add_triangles(mesh);
    return mesh;
}

} // namespace octant::models::procedural
