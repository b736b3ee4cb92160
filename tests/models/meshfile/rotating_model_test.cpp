#include "models/meshfile/mesh_file.h"
#include "models/meshfile/rotating_model.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/vec3.hpp>

#include <string>

using namespace octant;
using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;

TEST_CASE("propellers and rotors of a FlightGear model turn, wheels stay with the body") {
    const auto object = [](const std::string& name, const std::string& kids) {
        return "OBJECT poly\nname \"" + name +
               "\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\nmat 0\nrefs 3\n"
               "0 0 0\n1 0 0\n2 0 0\nkids " +
               kids + "\n";
    };
    file_with("parts.ac", "AC3Db\nMATERIAL \"w\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
                          "OBJECT world\nkids 5\n" +
                              object("hull", "0") + object("wheel", "0") + object("hub", "1") + object("blade", "0") +
                              object("blade2", "0") + object("rotor", "0"));
    const auto animation = [](const std::string& kind, const std::string& property, const std::string& objects,
                               const std::string& rest) {
        return "<animation><type>" + kind + "</type><property>" + property + "</property>" + objects + rest +
               "</animation>";
    };
    const auto named = [](const std::string& name) { return "<object-name>" + name + "</object-name>"; };
    const std::string forward = "<factor>-2</factor><center><x-m>1</x-m><z-m>3</z-m></center>"
                                "<axis><x>-4</x><y>0</y><z>0</z></axis>";
    const std::string upwards = "<axis><x1-m>5</x1-m><y1-m>0</y1-m><z1-m>1</z1-m><x2-m>5</x2-m><y2-m>0</y2-m>"
                                "<z2-m>2</z2-m></axis>";
    const auto file = file_with("parts.xml",
        "<PropertyList><path>parts.ac</path><offsets><y-m>10</y-m></offsets>" +
            animation("spin", "gear/gear/rollspeed-ms", named("wheel"), forward) +
            animation("spin", "engines/engine[0]/rpm", named("hub"), forward) +
            animation("spin", "engines/engine[0]/rpm", named("blade2"), forward) +
            animation("rotate", "rotors/main/blade/position-deg", named("rotor"), upwards) +
            animation("rotate", "rotors/main/blade/flap-deg", named("rotor"), upwards) +
            animation("rotate", "gear/position-norm", named("wheel"), "<factor>1.2.3</factor>") +
            animation("spin", "engines/engine/rpm", named("hull"), "<factor>1,5</factor>") + "</PropertyList>");
    const RotatingModel model = read_rotating_model(file, {});
    CHECK(model.body.triangles.size() == 2); // hull and wheel
    REQUIRE(model.parts.size() == 2);
    CHECK(model.parts[0].mesh.triangles.size() == 3); // the hub, what hangs on it, blade2
    CHECK(model.parts[0].about.turns_per_s == Approx(-80.0));
    CHECK(model.parts[0].about.direction == glm::dvec3(-1.0, 0.0, 0.0));
    CHECK(model.parts[0].about.point_m == glm::dvec3(1.0, 10.0, 3.0));
    CHECK(model.parts[1].mesh.triangles.size() == 1);
    CHECK(model.parts[1].about.turns_per_s == Approx(6.5));
    CHECK(model.parts[1].about.direction == glm::dvec3(0.0, 0.0, 1.0));
    CHECK_THAT(model.body.notes.back(), Catch::Contains("left at rest: 2 rotate, 2 spin"));
    CHECK_THAT(
        model.body.notes.front(), Catch::Contains("expected a number, got '1,5'; what it moves is left at rest"));
    CHECK(read_mesh(file).triangles.size() == 6); // as one mesh all of it is there
    CHECK(read_rotating_model(file.parent_path() / "parts.ac", {}).parts.empty());
}

TEST_CASE("rotors turn by their names where a property does not say what it is of") {
    file_with("blades.ac", ac3d_square("0x0", "Blades"));
    const auto rate = [](const std::string& property, const std::string& axis) {
        const auto file = file_with(
            "named.xml", "<PropertyList><path>blades.ac</path><model><path>blades.ac</path></model><animation>"
                         "<type>spin</type><object-name>Blades</object-name><property>" +
                             property + "</property><axis><" + axis + ">1</" + axis +
                             "></axis><interpolation><entry><ind>0</ind><dep>0</dep></entry><entry><ind>400"
                             "</ind><dep>200</dep></entry></interpolation></animation></PropertyList>");
        const RotatingModel model = read_rotating_model(file, {});
        return model.parts.empty() ? 0.0 : model.parts[0].about.turns_per_s;
    };
    CHECK(rate("sim/multiplay/generic/float[10]", "z") == Approx(195.0 / 60.0));
    CHECK(rate("sim/multiplay/generic/float[11]", "y") == Approx(200.0 / 60.0));
    CHECK(rate("gear/gear/rollspeed-ms", "y") == 0.0);
}

TEST_CASE("which of nested objects turns does not depend on the order of the animations") {
    const std::string triangle = "numvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\nmat 0\n"
                                 "refs 3\n0 0 0\n1 0 0\n2 0 0\n";
    file_with("nested.ac", "AC3Db\nMATERIAL \"w\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
                           "OBJECT world\nkids 2\nOBJECT poly\nname \"rotor\"\n" +
                               triangle + "kids 1\nOBJECT poly\nname \"blade\"\n" + triangle + "kids 0\nOBJECT poly\n" +
                               triangle + "kids 0\n");
    const std::string rotor = "<animation><type>spin</type><object-name>rotor</object-name><property>"
                              "rotors/main/rpm</property><axis><z>1</z></axis></animation>";
    const std::string blade = "<animation><type>spin</type><object-name>blade</object-name><property>"
                              "rotors/tail/rpm</property><axis><x>1</x></axis></animation>";
    for (const std::string& both : {rotor + blade, blade + rotor}) {
        const RotatingModel model = read_rotating_model(
            file_with("nested.xml", "<PropertyList><path>nested.ac</path>" + both + "</PropertyList>"), {});
        CHECK(model.body.triangles.size() == 1);
        REQUIRE(model.parts.size() == 1);
        CHECK(model.parts[0].mesh.triangles.size() == 2);
        CHECK(model.parts[0].about.direction == glm::dvec3(0.0, 0.0, 1.0));
    }
}

TEST_CASE("of a mesh whose objects are not told apart nothing turns, and it is there once") {
    file_with("plate.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto file = file_with("plate.xml", "<PropertyList><path>plate.obj</path><animation><type>spin</type>"
                                             "<object-name>Prop</object-name><property>engines/engine/rpm</property>"
                                             "<axis><x>1</x></axis></animation></PropertyList>");
    const RotatingModel model = read_rotating_model(file, {});
    CHECK(model.body.triangles.size() == 1);
    CHECK(model.parts.empty());
}

TEST_CASE("an AC3D aircraft alone shows its blades, not what stands for discs, light and shadows") {
    const auto objects_left = [](const std::string& first, const std::string& second) {
        const std::string object = "\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\n"
                                   "mat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
        const auto file = file_with("alone.ac", "\xef\xbb\xbf"
                                                "AC3Db\nMATERIAL \"w\" rgb 1 1 1\nOBJECT world\nkids 2\n"
                                                "OBJECT poly\nname \"" +
                                                    first + object + "OBJECT poly\nname \"" + second + object);
        CHECK(read_mesh(file).triangles.size() == 2);
        return read_rotating_model(file, {}).body.triangles.size();
    };
    CHECK(objects_left("heliceG", "propdiscG") == 1);
    CHECK(objects_left("PropBlurFastL", "wing") == 1);
    CHECK(objects_left("taxi-light-cone", "light") == 1);
    CHECK(objects_left("Fastprop", "Slowprop") == 1);
    CHECK(objects_left("Rotor-Disc_M-Pale", "shadow") == 2); // there is nothing else
    CHECK(objects_left("noshadow.glass", "disk") == 2);
}

TEST_CASE("a sub-model turns as the model that holds it says by its name") {
    file_with("square.ac", ac3d_square("0x0"));
    const auto file = file_with("holder.xml",
        "<PropertyList><path>square.ac</path><model><name>fan</name><path>square.ac</path>"
        "</model><animation><type>spin</type><object-name>fan</object-name>"
        "<property>/engines/engine/n1</property><axis><x>1</x></axis></animation></PropertyList>");
    const RotatingModel model = read_rotating_model(file, {});
    CHECK(model.body.triangles.size() == 2);
    REQUIRE(model.parts.size() == 1);
    CHECK(model.parts[0].mesh.triangles.size() == 2);
    CHECK(model.parts[0].about.turns_per_s == Approx(1.5));
}
