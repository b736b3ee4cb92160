#include "models/meshfile/flightgear_xml.h"
#include "models/meshfile/mesh_file.h"
#include "models/part_motion.h"
#include "sim/base/units.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <string>
#include <utility>

using namespace octant;
using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;

TEST_CASE("FlightGear's models bring their sub-models, moved and turned") {
    file_with("square.ac", ac3d_square("0x0"));
    file_with("part.xml", "<?xml version=\"1.0\"?><!-- one > two --><PropertyList><path>square.ac</path>"
                          "<offsets><z-m> 3 </z-m></offsets></PropertyList>");
    const auto file =
        file_with("plane.xml", "<PropertyList>\n <path>square.ac</path>\n <model n=\"1\"><path>part.xml</path><offsets>"
                               "<x-m>10</x-m><heading-deg>90</heading-deg></offsets></model>\n"
                               "<animation><type>spin</type><property>gear/rollspeed-ms</property></animation>"
                               "</PropertyList>");
    const TriangleMesh mesh = read_mesh(file);
    REQUIRE(mesh.vertices_m.size() == 8);
    CHECK(mesh.vertices_m[2].x == Approx(1.0)); // AC3D's y is up
    CHECK(mesh.vertices_m[2].z == Approx(1.0));
    CHECK(mesh.vertices_m[6].x == Approx(10.0)); // x is turned to y
    CHECK(mesh.vertices_m[6].y == Approx(1.0));
    CHECK(mesh.vertices_m[6].z == Approx(4.0));
    CHECK_THAT(mesh.notes.back(), Catch::Contains("left at rest: 1 spin"));
    CHECK(axes_of_format(file)->text() == "back,right,up");
}

TEST_CASE("an aircraft of FlightGear is read by its own file, which names its model") {
    file_with("square.ac", ac3d_square("0x0"));
    file_with("flier.xml", "<PropertyList><path>square.ac</path></PropertyList>");
    file_with("base.xml", "<PropertyList><sim><model><path>flier.xml</path></model></sim></PropertyList>");
    const auto read_set = [](const std::string& sim) {
        return file_with("flier-set.xml", "<PropertyList include='base.xml'>" + sim + "</PropertyList>");
    };
    CHECK(read_mesh(read_set("<sim><aero>x</aero></sim>")).triangles.size() == 2);
    CHECK(read_mesh(read_set("<sim><model><path>Aircraft/F/square.ac</path></model></sim>")).triangles.size() == 2);
    CHECK_THAT(read_mesh(file_with("first.xml", "<PropertyList><model><path>none.xml</path></model>"
                                                "<model><path>square.ac</path></model></PropertyList>"))
                   .notes.front(),
        Catch::Contains("no file of path 'none.xml'"));
    CHECK_THAT(error_of("first.xml", "<PropertyList><path>none.ac</path></PropertyList>"),
        Catch::Contains("first.xml:1: expected a file of its path, got none called 'none.ac'"));
    CHECK_THAT(error_of("none-set.xml", "<PropertyList><sim><model><path>none.xml</path></model></sim></PropertyList>"),
        Catch::Contains("none-set.xml:1: expected a file of its sim/model/path, got none called 'none.xml'"));
    CHECK_THAT(error_of("void-set.xml", "<PropertyList><sim/></PropertyList>"),
        Catch::Contains("expected a model's path in sim/model, got none"));
}

TEST_CASE("a faulty number in a range costs the range alone") {
    file_with("square.ac", ac3d_square("0x0", "near"));
    const RotatingModel model = read_rotating_model(
        file_with("ranges.xml", "<PropertyList><path>square.ac</path><animation><type>range</type>"
                                "<object-name>near</object-name><min-m>10,5</min-m></animation></PropertyList>"),
        {});
    CHECK(model.body.triangles.size() == 2);
    CHECK_THAT(
        model.body.notes.front(), Catch::Contains("expected a number, got '10,5'; what it names is always shown"));
}

TEST_CASE("a fault in an expression costs its animation alone, be it in a condition or not") {
    file_with("square.ac", ac3d_square("0x0", "flap"));
    const auto note_on = [](const std::string& animation) {
        const TriangleMesh mesh = read_mesh(file_with("faulty.xml",
            "<PropertyList><path>square.ac</path><animation>\n<object-name>flap</object-name>" + animation +
                "</animation><animation><type>translate</type><object-name>flap</object-name><offset-m>2</offset-m>"
                "<axis><x>1</x></axis></animation></PropertyList>"));
        REQUIRE(mesh.vertices_m.size() == 4);
        CHECK(mesh.vertices_m[2].x == 3.0); // the other animation's shift alone
        return mesh.notes.empty() ? std::string() : mesh.notes.front();
    };
    const auto of_shift = [&](const std::string& expression) {
        return note_on("<type>translate</type><axis><x>1</x></axis><expression>\n" + expression + "</expression>");
    };
    const auto under_condition = [&](const std::string& type, const std::string& expression) {
        return note_on("<type>" + type +
                       "</type><texture>a.png</texture><condition><equals><value>1</value><expression>\n" + expression +
                       "</expression></equals></condition>");
    };
    const std::string clip = "<clip><clipMin>abc</clipMin><value>7</value></clip>";
    const std::string shown = "faulty.xml:3: expected a number, got 'abc'; what it names is always shown";
    CHECK_THAT(under_condition("select", clip), Catch::EndsWith(shown));
    CHECK_THAT(under_condition("blend", clip), Catch::EndsWith(shown));
    const std::string at_rest = "faulty.xml:3: expected a number, got 'abc'; what it changes is left at rest";
    CHECK_THAT(under_condition("material", clip), Catch::EndsWith(at_rest));
    CHECK_THAT(under_condition("rotate", clip), Catch::EndsWith(at_rest));
    CHECK_THAT(of_shift(clip), Catch::EndsWith(at_rest));
    CHECK_THAT(of_shift("<value>abc</value>"), Catch::EndsWith(at_rest));
    CHECK_THAT(of_shift("<squash><value>1</value></squash>"),
        Catch::EndsWith("faulty.xml:3: expected a known function, got 'squash'; what it changes is left at rest"));
    CHECK_THAT(of_shift("<pow><value>1</value></pow>"), Catch::Contains(":3: expected 2 terms in pow, got 1;"));
    CHECK_THAT(of_shift("<clip/>"), Catch::Contains(":3: expected 1 or more terms in clip, got 0;"));
    CHECK_THAT(
        of_shift("<value>1</value><value>2</value>"), Catch::Contains(":2: expected 1 term in an expression, got 2;"));
    CHECK_THAT(
        read_mesh(file_with("holder.xml", "<PropertyList><path>square.ac</path><model><path>square.ac</path>"
                                          "<condition><equals><value>1</value>\n<expression>" +
                                              clip + "</expression></equals></condition></model></PropertyList>"))
            .notes.front(),
        Catch::EndsWith("holder.xml:2: expected a number, got 'abc'; this sub-model is always shown"));
}

TEST_CASE("a FlightGear model includes files and names groups of objects") {
    file_with("square.ac", ac3d_square("0x0", "blade"));
    file_with("other.ac", ac3d_square("0x0", "wing"));
    file_with("spin.xml", "<PropertyList><type>spin</type><property>rotors/tail/rpm</property><axis><y>1</y></axis>"
                          "</PropertyList>");
    file_with("common.xml", "<PropertyList><model><path>other.ac</path></model><animation><name>all</name>"
                            "<object-name>blade</object-name></animation></PropertyList>");
    const auto file = file_with("including.xml",
        "<PropertyList include=\"common.xml\"><path>square.ac</path><animation n='3' include = "
        "'spin.xml'><object-name>all</object-name></animation><animation include='gone.xml'/>"
        "</PropertyList>");
    const RotatingModel model = read_rotating_model(file, {});
    CHECK(model.body.triangles.size() == 2); // the sub-model
    REQUIRE(model.parts.size() == 1);
    CHECK(model.parts[0].about.direction == glm::dvec3(0.0, 1.0, 0.0));
    file_with("faulty-spin.xml", "<PropertyList>\n<type>range</type>\n<min-m>1,5</min-m></PropertyList>");
    CHECK_THAT(read_mesh(file_with("spinning.xml", "<PropertyList><path>square.ac</path><animation include="
                                                   "'faulty-spin.xml'/></PropertyList>"))
                   .notes.front(),
        Catch::Contains("faulty-spin.xml:3: expected a number, got '1,5'"));
    CHECK_THROWS_WITH(
        read_mesh(file_with("endless.xml", "<PropertyList include='endless.xml'><path>x.ac</path></PropertyList>")),
        Catch::Contains("expected includes at most 8 deep, got more"));
}

TEST_CASE("includes that multiply are refused, and words in other attributes include nothing") {
    for (int i = 3; i > 0; --i) {
        std::string text = "<PropertyList>";
        for (int k = 0; k < 10; ++k) { text += "<a include='many" + std::to_string(i) + ".xml'/>"; }
        file_with("many" + std::to_string(i - 1) + ".xml", text + "</PropertyList>");
    }
    file_with("many3.xml", "<PropertyList/>");
    CHECK_THROWS_WITH(
        read_mesh(file_with("most.xml", "<PropertyList include='many0.xml'><path>x.ac</path></PropertyList>")),
        Catch::Contains("expected at most 500 includes, got more"));
    CHECK(read_xml(file_with("quoted.xml", "<a note=\"use include='b.xml'\" n='1'/>")).include.empty());
    CHECK(read_xml(file_with("quoted.xml", "<a n='1' include = \"b.xml\"/>")).include == "b.xml");
}

TEST_CASE("what a range shows from afar only is left out of a FlightGear model") {
    file_with("square.ac", ac3d_square("0x0", "far"));
    const auto near_file = file_with("near.ac", ac3d_square("0x0", "near"));
    const auto file =
        file_with("ranges.xml", "<PropertyList><path>near.ac</path><model><path>far.xml</path></model></PropertyList>");
    file_with("far.xml", "<PropertyList><path>square.ac</path><animation><type>range</type><min-m>100</min-m>"
                         "<object-name>far</object-name></animation></PropertyList>");
    CHECK(read_mesh(file).triangles.size() == 2);
    CHECK(read_mesh(near_file).triangles.size() == 2);
}

TEST_CASE("ranges, lights and views of a FlightGear model show what is seen from outside") {
    file_with("square.ac", ac3d_square("0x0", "pilot"));
    file_with("other.ac", ac3d_square("0x0", "wing"));
    const auto shown = [](const std::string& animation) {
        const auto file = file_with(
            "outside.xml", "<PropertyList><path>square.ac</path><model><path>other.ac</path></model><animation>"
                           "<object-name>pilot</object-name>" +
                               animation + "</animation></PropertyList>");
        return read_mesh(file).triangles.size() == 4; // else the sub-model's two alone
    };
    CHECK(shown("<type>range</type><min-m>1</min-m><max-m>500</max-m>")); // not from his own eye
    CHECK(shown("<type>range</type><max-property>level/detailed</max-property>"));
    CHECK_FALSE(shown("<type>range</type><min-property>level/detailed</min-property>"));
    CHECK_FALSE(shown("<type>light</type><light-type>point</light-type>"));
    const auto in_view = [](const std::string& relation, const std::string& number) {
        return "<type>select</type><condition><" + relation +
               "><property>sim/current-view/view-number</property><value>" + number + "</value></" + relation +
               "></condition>";
    };
    CHECK_FALSE(shown(in_view("equals", "0")));
    CHECK(shown(in_view("not-equals", "0")));
    CHECK(shown(in_view("greater-than", "0")));
}

TEST_CASE("what animations move stands where it is at rest: landing gear up") {
    file_with("square.ac", ac3d_square("0x0", "leg"));
    file_with("round.ac", ac3d_square("0x0", "tyre"));
    const auto corner_m = [](const std::string& animations) {
        const TriangleMesh mesh = read_mesh(
            file_with("gear.xml", "<PropertyList><path>square.ac</path><model><name>wheel</name><path>round.ac</path>"
                                  "</model>" +
                                      animations + "</PropertyList>"));
        REQUIRE(mesh.vertices_m.size() == 8);
        // What is left at rest is told: not the gear, which moves in flight.
        CHECK(mesh.notes.size() ==
              (animations.find("offset-m") != animations.npos || animations.find("canopy") != animations.npos ? 1 : 0));
        return std::pair(mesh.vertices_m[2], mesh.vertices_m[6]);
    };
    const auto is_at = [](const glm::dvec3& place_m, double x_m, double z_m) {
        return glm::distance(place_m, glm::dvec3(x_m, 0.0, z_m)) < 1e-9;
    };
    const std::string turned = "<animation><type>rotate</type><object-name>leg</object-name><object-name>wheel</"
                               "object-name>"
                               "<property>gear/gear/position-norm</property><interpolation><entry><ind>0</ind><dep>90</"
                               "dep>"
                               "</entry><entry><ind>1</ind><dep>0</dep></entry></interpolation><axis><y>2</y></axis>"
                               "<center><x-m>1</x-m></center></animation>";
    const std::string shifted = "<animation><type>translate</type><object-name>leg</object-name><offset-m>2</offset-m>"
                                "<axis><x>1</x></axis></animation>";
    const auto [leg_m, wheel_m] = corner_m(turned); // from x = 1, z = 1
    CHECK(is_at(leg_m, 2.0, 0.0));
    CHECK(is_at(wheel_m, 2.0, 0.0));
    CHECK(is_at(corner_m(turned + shifted).first, 2.0, -2.0)); // shifted, then turned
    CHECK(is_at(corner_m(shifted + turned).first, 4.0, 0.0));
    CHECK(is_at(corner_m(turned + shifted).second, 2.0, 0.0));
    const std::string limited = "<animation><type>rotate</type><property>canopy</property><offset-deg>400</offset-deg>"
                                "<max-deg>180</max-deg><axis><x1-m>0</x1-m><y1-m>-1</y1-m><y2-m>1</y2-m></axis></"
                                "animation>";
    CHECK(is_at(corner_m("<animation><type>rotate</type><property>canopy</property><factor>7</factor>"
                         "<axis><y>1</y></axis></animation>")
                    .first,
        1.0, 1.0));
    file_with("whole.xml", "<PropertyList><path>square.ac</path>" + limited + "</PropertyList>");
    const TriangleMesh whole =
        read_mesh(file_with("holder.xml", "<PropertyList><model><path>whole.xml</path></model></PropertyList>"));
    CHECK(is_at(whole.vertices_m.at(2), -1.0, -1.0));
}

TEST_CASE("what is said of a FlightGear model's many parts ends with a count") {
    std::string models;
    for (int i = 0; i < 30; ++i) { models += "<model><path>none" + std::to_string(i) + ".ac</path></model>"; }
    file_with("square.ac", ac3d_square("0x0"));
    const TriangleMesh mesh =
        read_mesh(file_with("many.xml", "<PropertyList><path>square.ac</path>" + models + "</PropertyList>"));
    REQUIRE(mesh.notes.size() == 21);
    CHECK_THAT(mesh.notes.front(), Catch::Contains("no file of path 'none0.ac'"));
    CHECK_THAT(mesh.notes.back(), Catch::Contains("10 more notes on its sub-models"));
}

TEST_CASE("what FlightGear shows under a condition is there if it holds at rest") {
    file_with("square.ac", ac3d_square("0x0", "lamp"));
    file_with("other.ac", ac3d_square("0x0", "wing"));
    const auto shown = [](const std::string& condition) {
        const auto file = file_with(
            "selected.xml", "<PropertyList><path>square.ac</path><model><path>other.ac</path></model><animation>"
                            "<type>select</type><object-name>lamp</object-name><condition>" +
                                condition + "</condition></animation></PropertyList>");
        return read_mesh(file).triangles.size() == 4; // else the sub-model's two alone
    };
    CHECK_FALSE(shown("<property>on</property>"));
    CHECK(shown("<not><property>on</property></not>"));
    CHECK(shown("<or><property>on</property><equals><property>gear</property><value>0</value>"
                "</equals></or>"));
    CHECK_FALSE(shown("<greater-than><property>gear</property><value>0.1</value></greater-than>"));
    CHECK_FALSE(shown("<equals><property>name</property><value>red</value></equals>"));
}

TEST_CASE("faulty XML is refused in one line that says where") {
    const auto fault = [](const std::string& text) { return error_of("faulty.xml", text); };
    CHECK(fault("") == "faulty.xml:1: expected XML, got the end of the file (No document element found)");
    CHECK(fault("<a>\n<b>\n</a>") == "faulty.xml:3: expected XML, got 'a>' (Start-end tags mismatch)");
    CHECK(fault("<a>\n<b") == "faulty.xml:2: expected XML, got the end of the file (Error parsing start element tag)");
    CHECK(fault("<a><!-- x") == "faulty.xml:1: expected XML, got the end of the file (Error parsing comment)");
    CHECK(fault("<a n=1/>") == "faulty.xml:1: expected XML, got '1/>' (Error parsing element attribute)");
    std::string deep;
    for (int i = 0; i < 200'000; ++i) { deep += i == 101 ? "\n<a>" : "<a>"; }
    CHECK_THAT(fault(deep), Catch::StartsWith("faulty.xml:2: expected XML, got the end of the file"));
    for (int i = 0; i < 200'000; ++i) { deep += "</a>"; }
    CHECK(fault(deep) == "faulty.xml:2: expected elements at most 100 deep, got a deeper one");
    const XmlElement root = read_xml(file_with("good.xml", "\xef\xbb\xbf<!DOCTYPE a [<!ENTITY c 'x'>]>\n"
                                                           "<a> 1 &lt; 2 &c;\xe9<b c='>'/>\n<![CDATA[ <]]></a>"));
    CHECK(root.text == "1 < 2 &c;\xe9 <");
    CHECK(root.line == 2);
    CHECK(root.find("b") != nullptr);
    CHECK(root.find("c") == nullptr);
}

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
        model.body.notes.front(), Catch::Contains("expected a number, got '1,5'; what it changes is left at rest"));
    CHECK(read_mesh(file).triangles.size() == 6); // as one mesh all of it is there
    CHECK(read_rotating_model(file.parent_path() / "parts.ac", {}).parts.empty());
}

TEST_CASE("rotors turn by their names where a property does not say what it is of") {
    file_with("blades.ac", ac3d_square("0x0", "Blades"));
    file_with("other.ac", ac3d_square("0x0", "wing"));
    const auto rate = [](const std::string& property, const std::string& axis) {
        const auto file = file_with(
            "named.xml", "<PropertyList><path>blades.ac</path><model><path>other.ac</path></model><animation>"
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

TEST_CASE(
    "control surfaces and gear of FlightGear models move by their properties, with the sub-models that they hold") {
    file_with("flap.ac", ac3d_square("0x0", "flap"));
    file_with("tyre.ac", ac3d_square("0x0", "tyre"));
    file_with("wheel.xml", "<PropertyList><path>tyre.ac</path></PropertyList>");
    const std::string axis = "<axis><x>0</x><y>1</y><z>0</z></axis>";
    const auto file = file_with("surfaces.xml",
        "<PropertyList><path>flap.ac</path><offsets><z-m>3</z-m></offsets>"
        "<model><name>gear</name><path>wheel.xml</path></model><model><path>wheel.xml</path></model>"
        "<animation><type>rotate</type><object-name>flap</object-name>"
        "<property>surface-positions/right-aileron-pos-norm</property><factor>-10</factor>" +
            axis +
            "</animation>"
            "<animation><type>translate</type><object-name>gear</object-name><property>gear/gear[1]/position-norm</"
            "property>"
            "<interpolation><entry><ind>0</ind><dep>0.5</dep></entry><entry><ind>0.5</ind><dep>0.5</dep></entry>"
            "<entry><ind>1</ind><dep>-1.5</dep></entry></interpolation><axis><x>0</x><y>0</y><z>1</z></axis></"
            "animation>"
            "<animation><type>select</type><object-name>gear</object-name><condition><greater-than><property>"
            "gear/gear[1]/position-norm</property><value>0.2</value></greater-than></condition></animation></"
            "PropertyList>");
    const RotatingModel model = read_rotating_model(file, {});
    CHECK(model.body.triangles.size() == 2); // the second wheel
    REQUIRE(model.parts.size() == 2);
    const auto at = [](const RotatingPart& part, FlightControl control, double position, const glm::dvec3& point_m) {
        ControlPositions positions{};
        positions[static_cast<std::size_t>(control)] = position;
        return glm::dvec3(placement_by(part.moves, positions) * glm::dvec4(point_m, 1.0));
    };
    // The right aileron's value is the left one's with the other sign: 10 degrees about +y at z = 3.
    const glm::dvec3 down = at(model.parts[0], FlightControl::Roll, 1.0, {1.0, 0.0, 3.0});
    CHECK(down.z == Approx(3.0 - std::sin(octant::rad_from_deg(10.0))));
    CHECK(at(model.parts[0], FlightControl::Gear, 1.0, {1.0, 0.0, 3.0}) == glm::dvec3(1.0, 0.0, 3.0));
    const RotatingPart& gear = model.parts[1];
    CHECK_FALSE(is_shown_at_rest(gear.moves));
    CHECK(at(gear, FlightControl::Gear, 0.0, {1.0, 0.0, 0.0}).x == 0.0);
    CHECK(at(gear, FlightControl::Gear, 1.0, {1.0, 0.0, 0.0}) == glm::dvec3(1.0, 0.0, -2.0));
    CHECK(bounds_of(gear.mesh).max_m.z == Approx(4.5)); // with the offset, where it rests
    CHECK(read_mesh(file).triangles.size() == 4);       // the gear is up
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

TEST_CASE("animations of a FlightGear model hold for the objects of all models within it, at their places") {
    file_with("blade.ac", ac3d_square("0x0", "blade"));
    file_with("base.xml", "<PropertyList><path>blade.ac</path></PropertyList>");
    const auto holder = [](const std::string& animation, const std::string& offsets) {
        file_with("inner.xml", "<PropertyList><model><name>rotor</name><path>base.xml</path>" + offsets + "</model>" +
                                   animation + "</PropertyList>");
        return file_with("outer.xml",
            "<PropertyList><model><path>inner.xml</path><offsets><z-m>5</z-m></offsets></model>"
            "<model><path>body.ac</path></model></PropertyList>");
    };
    file_with("body.ac", ac3d_square("0x0", "body"));
    const RotatingModel turning = read_rotating_model(
        holder("<animation><type>rotate</type><object-name>blade</object-name>"
               "<property>rotors/main/blade[1]/position-deg</property><axis><z>1</z></axis></animation>",
            ""),
        {});
    CHECK(turning.body.triangles.size() == 2);
    REQUIRE(turning.parts.size() == 1);
    CHECK(turning.parts[0].about.point_m == glm::dvec3(0.0, 0.0, 5.0));
    const std::string shift = "<animation><type>translate</type><object-name>blade</object-name>"
                              "<offset-m>2</offset-m><axis><x>1</x></axis></animation>";
    const std::string turned_offsets = "<offsets><x-m>10</x-m><heading-deg>90</heading-deg></offsets>";
    const TriangleMesh moved = read_mesh(holder(shift, turned_offsets));
    const TriangleMesh still = read_mesh(holder("", turned_offsets));
    REQUIRE(moved.vertices_m.size() == 8);
    CHECK(glm::distance(moved.vertices_m[2], still.vertices_m[2] + glm::dvec3(2.0, 0.0, 0.0)) < 1e-9);
    CHECK(read_mesh(holder("<animation><type>select</type><object-name>blade</object-name><condition>"
                           "<property>on</property></condition></animation>",
                        ""))
              .triangles.size() == 2);
    std::string unquoted = ac3d_square("0x0", "blade");
    unquoted.replace(unquoted.find("\"blade\""), 7, "blade");
    file_with("blade.ac", unquoted); // as AC3D has it, too
    CHECK(read_mesh(holder(shift, turned_offsets)).vertices_m == moved.vertices_m);
}

TEST_CASE("expressions of FlightGear's animations are worth what their properties are at rest, and follow controls") {
    file_with("square.ac", ac3d_square("0x0", "flap"));
    file_with("other.ac", ac3d_square("0x0", "wing"));
    const auto corner_m = [](const std::string& expression) {
        const TriangleMesh mesh = read_mesh(file_with("plane.xml",
            "<PropertyList><path>square.ac</path><animation><type>translate</type><object-name>flap</object-name>"
            "<expression>" +
                expression + "</expression><axis><x>1</x></axis></animation></PropertyList>"));
        return mesh.vertices_m[2].x; // 1 where it is not moved
    };
    CHECK(corner_m("<value>3</value>") == Approx(4.0));
    CHECK(corner_m("<sum><value>3</value><product><value>2</value><value>-4</value></product>"
                   "<property>nothing</property></sum>") == Approx(-4.0));
    CHECK(corner_m("<clip><clipMin>0.5</clipMin><clipMax>2</clipMax><value>7</value></clip>") == Approx(3.0));
    CHECK(corner_m("<max><sin><deg2rad><value>90</value></deg2rad></sin><difference><value>5</value><value>3</value>"
                   "</difference></max>") == Approx(3.0));
    CHECK(corner_m("<table><property>x</property><entry><ind>-1</ind><dep>0</dep></entry>"
                   "<entry><ind>1</ind><dep>8</dep></entry></table>") == Approx(5.0));
    CHECK(corner_m("<div><value>1</value><property>nothing</property></div>") == 1.0); // not finite
    CHECK(corner_m("<noise><value>1</value></noise>") == 1.0);
    const RotatingModel elevon = read_rotating_model(
        file_with("elevon.xml",
            "<PropertyList><path>square.ac</path><model><path>other.ac</path></model><animation><type>rotate</type>"
            "<object-name>flap</object-name><expression><sum>"
            "<product><property>surface-positions/left-aileron-pos-norm</property><value>10</value></product>"
            "<product><property>/surface-positions/elevator-pos-norm</property><value>20</value></product>"
            "</sum></expression><axis><y>1</y></axis></animation></PropertyList>"),
        {});
    const auto turn_deg = [&](double roll, double pitch) {
        ControlPositions positions{};
        positions[static_cast<std::size_t>(FlightControl::Roll)] = roll;
        positions[static_cast<std::size_t>(FlightControl::Pitch)] = pitch;
        const auto& part = elevon.parts.empty() ? RotatingPart{} : elevon.parts[0];
        const glm::dvec4 tip = placement_by(part.moves, positions) * glm::dvec4(1.0, 0.0, 0.0, 1.0);
        return std::atan2(-tip.z, tip.x) / rad_from_deg(1.0);
    };
    CHECK(turn_deg(1.0, 0.0) == Approx(10.0));
    CHECK(turn_deg(0.0, 1.0) == Approx(-20.0));
    CHECK(turn_deg(-1.0, 1.0) == Approx(-30.0));
}

TEST_CASE("what a blend makes clear at rest is left out of a FlightGear model") {
    file_with("square.ac", ac3d_square("0x0", "beam"));
    file_with("other.ac", ac3d_square("0x0", "wing"));
    const auto triangles = [](const std::string& value) {
        return read_mesh(
            file_with("beams.xml", "<PropertyList><path>square.ac</path><model><path>other.ac</path></model><animation>"
                                   "<type>blend</type><object-name>beam</object-name>" +
                                       value + "</animation></PropertyList>"))
            .triangles.size();
    };
    CHECK(
        triangles("<expression><difference><value>1</value><property>light</property></difference></expression>") == 2);
    CHECK(triangles("<property>light</property><factor>-1</factor><offset>1</offset>") == 2);
    CHECK(triangles("<property>light</property>") == 4);
}
