#include "models/meshfile/format_axes.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/turning_model.h"
#include "models/meshfile/xml_tree.h"
#include "models/repair/repair.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <string>
#include <utility>

using namespace octant;
using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::repair;
using namespace octant::models::meshfile::test;

namespace {

/// A BMP of two pixels side by side: red, then blue.
std::string red_and_blue() {
    std::string bytes = "BM";
    const auto add = [&](std::uint32_t number, int size) {
        for (int i = 0; i < size; ++i) {
            bytes += static_cast<char>(number >> (8 * i) & 0xffU);
        }
    };
    for (const auto& [number, size] : std::initializer_list<std::pair<std::uint32_t, int>>{
             {62, 4},
             {0, 4},
             {54, 4},
             {40, 4},
             {2, 4},
             {1, 4},
             {1, 2},
             {24, 2},
             {0, 4},
             {8, 4},
             {2835, 4},
             {2835, 4},
             {0, 4},
             {0, 4},
             {0xff0000, 3},
             {0x0000ff, 3},
             {0, 2}}) {
        add(number, size);
    }
    return bytes;
}

/// A TIFF of one pixel of this opacity.
std::string tiff_of_opacity(std::uint32_t opacity) {
    std::string bytes = "II";
    const auto add = [&](std::uint32_t number, int size) {
        for (int i = 0; i < size; ++i) {
            bytes += static_cast<char>(number >> (8 * i) & 0xffU);
        }
    };
    add(42, 2);
    add(20, 4);                         // where the directory stands
    add(0x00ff00U | opacity << 24U, 4); // the pixel, at byte 8
    add(0x00080008U, 4);                // bits of its parts, at byte 12
    add(0x00080008U, 4);
    constexpr std::uint32_t entries[][3] = {
        {256, 1, 1},
        {257, 1, 1},
        {258, 4, 12},
        {259, 1, 1},
        {262, 1, 2},
        {273, 1, 8},
        {277, 1, 4},
        {278, 1, 1},
        {279, 1, 4},
        {338, 1, 2}};
    add(std::size(entries), 2);
    for (const auto& [tag, count, value] : entries) {
        add(tag, 2);
        add(3, 2); // a short number
        add(count, 4);
        add(value, 4);
    }
    add(0, 4);
    return bytes;
}

/// A square in x and y with a picture over it.
std::string square(const std::string& flags, const std::string& name = "square") {
    return "AC3Db\nMATERIAL \"white\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
           "OBJECT world\nkids 1\nOBJECT poly\nname \"" +
           name +
           "\"\ntexture \"two.bmp\"\nnumvert 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nnumsurf 1\nSURF " +
           flags + "\nmat 0\nrefs 4\n0 0.01 0\n1 0.99 0\n2 0.99 1\n3 0.01 1\nkids 0\n";
}

} // namespace

TEST_CASE("the picture of an AC3D surface colours its vertices, if it is asked for") {
    file_with("two.bmp", red_and_blue());
    const auto file = file_with("square.ac", square("0x0"));
    CHECK(read_mesh(file).colours.empty());
    const TriangleMesh mesh = read_mesh(file, {.pictures = true});
    REQUIRE(mesh.colours.size() == 4);
    CHECK(mesh.colours[0].x > 0.75F);
    CHECK(mesh.colours[3].x > 0.75F);
    CHECK(mesh.colours[0].y == 0.0F);
    CHECK(mesh.colours[1].z > 0.75F);
    CHECK(mesh.colours[2].z > 0.75F);
}

TEST_CASE("what is mostly transparent is left out or glass, unless nothing else is there") {
    const std::string plain = "OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\n"
                              "mat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
    std::string two = square("0x0");
    two.replace(two.find("kids 1"), 6, "kids 2");
    for (const std::uint32_t opacity : {255U, 20U, 5U}) {
        file_with("two.bmp", tiff_of_opacity(opacity));
        const bool is_clear = opacity < 128U;
        const TriangleMesh mesh = read_mesh(file_with("two.ac", two + plain), {.pictures = true});
        CHECK(mesh.triangles.size() == (is_clear ? 1U : 3U));
        CHECK(mesh.notes.size() == (is_clear ? 1U : 0U));
        const auto alone = file_with("alone.ac", square("0x0"));
        CHECK(read_mesh(alone, {.pictures = true}).triangles.size() == 2);
        const MeshParts parts = read_parts(file_with("two.ac", two + plain), {.pictures = true});
        CHECK(parts.body.triangles.size() == (is_clear ? 1U : 3U));
        CHECK(parts.clear.mesh.triangles.size() == (opacity == 20U ? 2U : 0U));
        CHECK(parts.body.notes.size() == (opacity == 5U ? 1U : 0U));
        if (opacity == 20U) {
            CHECK(parts.clear.opacity == Approx(20.0 / 255.0));
        }
        if (is_clear) {
            CHECK(read_parts(alone, {.pictures = true}).body.triangles.empty());
            CHECK(read_turning_model(alone, {.pictures = true}).body.triangles.size() == 2);
        }
    }
}

TEST_CASE("a picture that is missing is told, and the material's colour stays") {
    const auto file = file_with("lonely.ac", square("0x0"));
    std::filesystem::remove(file.parent_path() / "two.bmp");
    const TriangleMesh mesh = read_mesh(file, {.pictures = true});
    CHECK(mesh.colours.empty());
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Catch::Contains("expected a picture 'two.bmp', got none"));
}

TEST_CASE("a two-sided sheet gets a back that welding keeps apart") {
    const auto file = file_with("sheet.ac", square("0x20"));
    CHECK(read_mesh(file).triangles.size() == 2);
    const TriangleMesh mesh = read_mesh(file, {.backs = true});
    REQUIRE(mesh.triangles.size() == 4);
    CHECK(normal_of(mesh, mesh.triangles[0]).z == Approx(1.0));
    CHECK(normal_of(mesh, mesh.triangles[2]).z == Approx(-1.0));
    CHECK(repaired(mesh).counts.shells == 2);
    const auto one_sided = file_with("sheet.ac", square("0x0"));
    CHECK(read_mesh(one_sided, {.backs = true}).triangles.size() == 2);
}

TEST_CASE("FlightGear's models bring their sub-models, moved and turned") {
    file_with("square.ac", square("0x0"));
    file_with(
        "part.xml",
        "<?xml version=\"1.0\"?><!-- one > two --><PropertyList><path>square.ac</path>"
        "<offsets><z-m> 3 </z-m></offsets></PropertyList>");
    const auto file = file_with(
        "plane.xml",
        "<PropertyList>\n <path>square.ac</path>\n <model n=\"1\"><path>part.xml</path><offsets>"
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

TEST_CASE("propellers and rotors of a FlightGear model turn, wheels stay with the body") {
    const auto object = [](const std::string& name, const std::string& kids) {
        return "OBJECT poly\nname \"" + name +
               "\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\nmat 0\nrefs 3\n"
               "0 0 0\n1 0 0\n2 0 0\nkids " +
               kids + "\n";
    };
    file_with(
        "parts.ac",
        "AC3Db\nMATERIAL \"w\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
        "OBJECT world\nkids 5\n" +
            object("hull", "0") + object("wheel", "0") + object("hub", "1") + object("blade", "0") +
            object("blade2", "0") + object("rotor", "0"));
    const auto animation = [](const std::string& kind,
                              const std::string& property,
                              const std::string& objects,
                              const std::string& rest) {
        return "<animation><type>" + kind + "</type><property>" + property + "</property>" +
               objects + rest + "</animation>";
    };
    const auto named = [](const std::string& name) {
        return "<object-name>" + name + "</object-name>";
    };
    const std::string forward = "<factor>-2</factor><center><x-m>1</x-m><z-m>3</z-m></center>"
                                "<axis><x>-4</x><y>0</y><z>0</z></axis>";
    const std::string upwards =
        "<axis><x1-m>5</x1-m><y1-m>0</y1-m><z1-m>1</z1-m><x2-m>5</x2-m><y2-m>0</y2-m>"
        "<z2-m>2</z2-m></axis>";
    const auto file = file_with(
        "parts.xml",
        "<PropertyList><path>parts.ac</path><offsets><y-m>10</y-m></offsets>" +
            animation("spin", "gear/gear/rollspeed-ms", named("wheel"), forward) +
            animation("spin", "engines/engine[0]/rpm", named("hub"), forward) +
            animation("spin", "engines/engine[0]/rpm", named("blade2"), forward) +
            animation("rotate", "rotors/main/blade/position-deg", named("rotor"), upwards) +
            animation("rotate", "rotors/main/blade/flap-deg", named("rotor"), upwards) +
            animation("rotate", "gear/position-norm", named("wheel"), "<factor>1.2.3</factor>") +
            animation("spin", "engines/engine/rpm", named("hull"), "<factor>1,5</factor>") +
            "</PropertyList>");
    const TurningModel model = read_turning_model(file, {});
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
        model.body.notes.front(),
        Catch::Contains("expected a number, got '1,5'; what it turns is left at rest"));
    CHECK(read_mesh(file).triangles.size() == 6); // as one mesh all of it is there
    CHECK(read_turning_model(file.parent_path() / "parts.ac", {}).parts.empty());
}

TEST_CASE("clear materials of AC3D, glTF and FlightGear files come apart") {
    std::string two = square("0x0");
    two.replace(two.find("kids 1"), 6, "kids 2");
    two.insert(
        two.find("OBJECT world"),
        "MATERIAL \"glass\" rgb 0.5 0.5 0.6 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0.7\n");
    const std::string pane = "OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\n"
                             "mat 1\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
    const auto file = file_with("canopy.ac", two + pane);
    const auto check = [](const TurningModel& model) {
        CHECK(model.body.triangles.size() == 2);
        CHECK(model.clear.mesh.triangles.size() == 1);
        CHECK(model.clear.opacity == Approx(0.3F));
    };
    check(read_turning_model(file, {}));
    check(read_turning_model(
        file_with("canopy.xml", "<PropertyList><path>canopy.ac</path></PropertyList>"), {}));
    CHECK(read_mesh(file).triangles.size() == 3); // as one mesh all of it is there

    std::string all = square("0x0");
    all.replace(all.find("trans 0"), 7, "trans 1");
    const TurningModel unseen = read_turning_model(file_with("unseen.ac", all), {});
    CHECK(unseen.body.triangles.size() == 2);
    CHECK(unseen.clear.mesh.triangles.empty());

    const auto gltf = file.parent_path() / "canopy.gltf";
    write_mesh(gltf, read_mesh(file));
    std::string text = read_text_file(gltf);
    const std::size_t at = text.rfind("\"baseColorFactor\"");
    const std::size_t opaque = text.find("1.0", text.find(']', at) - 5);
    text.replace(opaque, 3, "0.3");
    const std::size_t material = text.rfind('{', text.rfind("\"pbrMetallicRoughness\"", at));
    text.insert(material + 1, "\"alphaMode\":\"BLEND\",");
    write_file(gltf, text);
    check(read_turning_model(gltf, {}));
}

TEST_CASE("rotors turn by their names where a property does not say what it is of") {
    file_with("blades.ac", square("0x0", "Blades"));
    const auto rate = [](const std::string& property, const std::string& axis) {
        const auto file = file_with(
            "named.xml",
            "<PropertyList><path>blades.ac</path><model><path>blades.ac</path></model><animation>"
            "<type>spin</type><object-name>Blades</object-name><property>" +
                property + "</property><axis><" + axis + ">1</" + axis +
                "></axis><interpolation><entry><ind>0</ind><dep>0</dep></entry><entry><ind>400"
                "</ind><dep>200</dep></entry></interpolation></animation></PropertyList>");
        const TurningModel model = read_turning_model(file, {});
        return model.parts.empty() ? 0.0 : model.parts[0].about.turns_per_s;
    };
    CHECK(rate("sim/multiplay/generic/float[10]", "z") == Approx(195.0 / 60.0));
    CHECK(rate("sim/multiplay/generic/float[11]", "y") == Approx(200.0 / 60.0));
    CHECK(rate("gear/gear/rollspeed-ms", "y") == 0.0);
}

TEST_CASE("which of nested objects turns does not depend on the order of the animations") {
    const std::string triangle = "numvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\nmat 0\n"
                                 "refs 3\n0 0 0\n1 0 0\n2 0 0\n";
    file_with(
        "nested.ac",
        "AC3Db\nMATERIAL \"w\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
        "OBJECT world\nkids 2\nOBJECT poly\nname \"rotor\"\n" +
            triangle + "kids 1\nOBJECT poly\nname \"blade\"\n" + triangle +
            "kids 0\nOBJECT poly\n" + triangle + "kids 0\n");
    const std::string rotor =
        "<animation><type>spin</type><object-name>rotor</object-name><property>"
        "rotors/main/rpm</property><axis><z>1</z></axis></animation>";
    const std::string blade =
        "<animation><type>spin</type><object-name>blade</object-name><property>"
        "rotors/tail/rpm</property><axis><x>1</x></axis></animation>";
    for (const std::string& both : {rotor + blade, blade + rotor}) {
        const TurningModel model = read_turning_model(
            file_with(
                "nested.xml", "<PropertyList><path>nested.ac</path>" + both + "</PropertyList>"),
            {});
        CHECK(model.body.triangles.size() == 1);
        REQUIRE(model.parts.size() == 1);
        CHECK(model.parts[0].mesh.triangles.size() == 2);
        CHECK(model.parts[0].about.direction == glm::dvec3(0.0, 0.0, 1.0));
    }
}

TEST_CASE("a faulty number in a range costs the range alone") {
    file_with("square.ac", square("0x0", "near"));
    const TurningModel model = read_turning_model(
        file_with(
            "ranges.xml",
            "<PropertyList><path>square.ac</path><animation><type>range</type>"
            "<object-name>near</object-name><min-m>10,5</min-m></animation></PropertyList>"),
        {});
    CHECK(model.body.triangles.size() == 2);
    CHECK_THAT(
        model.body.notes.front(),
        Catch::Contains("expected a number, got '10,5'; what it names is always shown"));
}

TEST_CASE("a FlightGear model includes files and names groups of objects") {
    file_with("square.ac", square("0x0", "blade"));
    file_with(
        "spin.xml",
        "<PropertyList><type>spin</type><property>rotors/tail/rpm</property><axis><y>1</y></axis>"
        "</PropertyList>");
    file_with(
        "common.xml",
        "<PropertyList><model><path>square.ac</path></model><animation><name>all</name>"
        "<object-name>blade</object-name></animation></PropertyList>");
    const auto file = file_with(
        "including.xml",
        "<PropertyList include=\"common.xml\"><path>square.ac</path><animation n='3' include = "
        "'spin.xml'><object-name>all</object-name></animation><animation include='gone.xml'/>"
        "</PropertyList>");
    const TurningModel model = read_turning_model(file, {});
    CHECK(model.body.triangles.size() == 2); // the sub-model
    REQUIRE(model.parts.size() == 1);
    CHECK(model.parts[0].about.direction == glm::dvec3(0.0, 1.0, 0.0));
    CHECK_THROWS_WITH(
        read_mesh(file_with(
            "endless.xml", "<PropertyList include='endless.xml'><path>x.ac</path></PropertyList>")),
        Catch::Contains("expected includes at most 8 deep, got more"));
}

TEST_CASE("includes that multiply are refused, and words in other attributes include nothing") {
    for (int i = 3; i > 0; --i) {
        std::string text = "<PropertyList>";
        for (int k = 0; k < 10; ++k) {
            text += "<a include='many" + std::to_string(i) + ".xml'/>";
        }
        file_with("many" + std::to_string(i - 1) + ".xml", text + "</PropertyList>");
    }
    file_with("many3.xml", "<PropertyList/>");
    CHECK_THROWS_WITH(
        read_mesh(file_with(
            "most.xml", "<PropertyList include='many0.xml'><path>x.ac</path></PropertyList>")),
        Catch::Contains("expected at most 500 includes, got more"));
    const auto quoted =
        file_with("quoted.xml", "<PropertyList note=\"use include='gone.xml'\" n='1'/>");
    CHECK(xml_tree(quoted, "<a note=\"use include='b.xml'\" n='1'/>").include.empty());
    CHECK(xml_tree(quoted, "<a n='1' include = \"b.xml\"/>").include == "b.xml");
}

TEST_CASE("of a mesh whose objects are not told apart nothing turns, and it is there once") {
    file_with("plate.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto file = file_with(
        "plate.xml",
        "<PropertyList><path>plate.obj</path><animation><type>spin</type>"
        "<object-name>Prop</object-name><property>engines/engine/rpm</property>"
        "<axis><x>1</x></axis></animation></PropertyList>");
    const TurningModel model = read_turning_model(file, {});
    CHECK(model.body.triangles.size() == 1);
    CHECK(model.parts.empty());
}

TEST_CASE("a sub-model turns as the model that holds it says by its name") {
    file_with("square.ac", square("0x0"));
    const auto file = file_with(
        "holder.xml",
        "<PropertyList><path>square.ac</path><model><name>fan</name><path>square.ac</path>"
        "</model><animation><type>spin</type><object-name>fan</object-name>"
        "<property>/engines/engine/n1</property><axis><x>1</x></axis></animation></PropertyList>");
    const TurningModel model = read_turning_model(file, {});
    CHECK(model.body.triangles.size() == 2);
    REQUIRE(model.parts.size() == 1);
    CHECK(model.parts[0].mesh.triangles.size() == 2);
    CHECK(model.parts[0].about.turns_per_s == Approx(1.5));
}

TEST_CASE("what a range shows from afar only is left out of a FlightGear model") {
    file_with("square.ac", square("0x0", "far"));
    const auto near_file = file_with("near.ac", square("0x0", "near"));
    const auto file = file_with(
        "ranges.xml",
        "<PropertyList><path>near.ac</path><model><path>far.xml</path></model></PropertyList>");
    file_with(
        "far.xml",
        "<PropertyList><path>square.ac</path><animation><type>range</type><min-m>100</min-m>"
        "<object-name>far</object-name></animation></PropertyList>");
    CHECK(read_mesh(file).triangles.size() == 2);
    CHECK(read_mesh(near_file).triangles.size() == 2);
}

TEST_CASE("what FlightGear shows under a condition is there if it holds at rest") {
    file_with("square.ac", square("0x0", "lamp"));
    const auto shown = [](const std::string& condition) {
        const auto file = file_with(
            "selected.xml",
            "<PropertyList><path>square.ac</path><model><path>square.ac</path></model><animation>"
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
    CHECK(fault("") == "faulty.xml:1: expected an element, got the end of the file");
    CHECK(fault("<a>\n<b>\n</a>") == "faulty.xml:3: expected </b>, got 'a'");
    CHECK(fault("<a>\n<b") == "faulty.xml:2: expected '>', got the end of the file");
    CHECK(fault("<a><!-- x") == "faulty.xml:1: expected '-->', got the end of the file");
    const XmlElement root = xml_tree("x", "<a> 1 &lt; 2<b c='>'/><![CDATA[ <]]></a>");
    CHECK(root.text == "1 < 2 <");
    CHECK(root.find("b") != nullptr);
    CHECK(root.find("c") == nullptr);
}
