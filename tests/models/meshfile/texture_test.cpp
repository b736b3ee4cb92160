#include "models/meshfile/dds.h"
#include "models/meshfile/mesh_file.h"
#include "models/meshfile/picture_path.h"
#include "models/meshfile/texture_store.h"
#include "models/texture.h"
#include "sim/base/output_file.h"
#include "tests/models/meshfile/mesh_samples.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

using namespace octant;
using namespace octant::models;
using namespace octant::models::meshfile;
using namespace octant::models::meshfile::test;

namespace {

using Bytes = std::vector<std::uint8_t>;

void add_number(std::string& bytes, std::uint32_t number, int size) {
    for (int i = 0; i < size; ++i) { bytes += static_cast<char>(number >> (8 * i) & 0xffU); }
}

/// A TIFF of these pixels, rows from the top; each red, green, blue, alpha.
std::string tiff(int width, int height, const Bytes& rgba) {
    std::string bytes = "II";
    add_number(bytes, 42, 2);
    const auto size = static_cast<std::uint32_t>(rgba.size());
    add_number(bytes, 16 + size, 4);                         // where the directory stands
    for (int i = 0; i < 4; ++i) { add_number(bytes, 8, 2); } // bits of a pixel's parts, at byte 8
    bytes.append(rgba.begin(), rgba.end());                  // at byte 16
    const std::array<std::array<std::uint32_t, 3>, 10> entries{{{256, 1, static_cast<std::uint32_t>(width)},
        {257, 1, static_cast<std::uint32_t>(height)}, {258, 4, 8}, {259, 1, 1}, {262, 1, 2}, {273, 1, 16}, {277, 1, 4},
        {278, 1, static_cast<std::uint32_t>(height)}, {279, 1, size}, {338, 1, 2}}};
    add_number(bytes, entries.size(), 2);
    for (const auto& [tag, count, value] : entries) {
        add_number(bytes, tag, 2);
        add_number(bytes, tag == 279 ? 4 : 3, 2); // a long or a short number
        add_number(bytes, count, 4);
        add_number(bytes, value, 4);
    }
    add_number(bytes, 0, 4);
    return bytes;
}

/// A picture of one colour.
Bytes plain(int width, int height, std::array<std::uint8_t, 4> colour = {10, 20, 30, 255}) {
    Bytes rgba;
    for (int i = 0; i < width * height; ++i) { rgba.insert(rgba.end(), colour.begin(), colour.end()); }
    return rgba;
}

/// A DDS file of 4 x 4 texels with these letters for its format and these bytes of pixels.
std::string dds(const std::string& letters, const std::string& pixels) {
    std::string bytes = "DDS ";
    add_number(bytes, 124, 4);
    add_number(bytes, 0x1007, 4);
    add_number(bytes, 4, 4);
    add_number(bytes, 4, 4);
    bytes.resize(76, '\0');
    add_number(bytes, 32, 4);
    add_number(bytes, 4, 4);
    bytes += letters;
    bytes.resize(128, '\0');
    return bytes + pixels;
}

Bytes texel(const TextureLevel& level, int x, int y) {
    const auto at = level.rgba.begin() + 4 * (y * level.width + x);
    return {at, at + 4};
}

} // namespace

TEST_CASE("a level of a picture has the mean of the texels below each of its own, also where sides are odd") {
    const Bytes row{0, 0, 0, 255, 90, 0, 0, 255, 180, 0, 0, 255};
    const TexturePicture odd = texture_picture("odd", {3, 1, row});
    REQUIRE(odd.levels.size() == 2);
    CHECK(odd.levels[1].rgba == Bytes{90, 0, 0, 255});
    const TexturePicture five = texture_picture("five", {5, 1, plain(5, 1)});
    REQUIRE(five.levels.size() == 3);
    CHECK(five.levels[1].width == 2);
    CHECK(texel(five.levels[1], 1, 0) == Bytes{10, 20, 30, 255});
    Bytes four = plain(2, 2, {100, 0, 0, 255});
    four[0] = 0;
    CHECK(texture_picture("four", {2, 2, four}).levels[1].rgba == Bytes{75, 0, 0, 255});
}

TEST_CASE("what a picture has in its transparent texels does not colour the others") {
    Bytes half = plain(2, 1, {200, 200, 200, 0});
    half[4] = half[5] = half[6] = 40;
    half[7] = 255;
    const TexturePicture picture = texture_picture("half", {2, 1, half});
    CHECK_FALSE(picture.is_opaque);
    CHECK(picture.levels[1].rgba == Bytes{40, 40, 40, 128});
}

TEST_CASE("pictures beyond the budget are halved, the largest first, and that is told once") {
    const auto small = file_with("small.tif", tiff(8, 8, plain(8, 8)));
    const auto large = file_with("large.tif", tiff(64, 64, plain(64, 64)));
    TextureStore store(8'000);
    const auto first = store.picture_in(small);
    const auto second = store.picture_in(large);
    CHECK(store.picture_in(small) == first);
    CHECK(store.count() == 2);
    CHECK(first->levels.front().width == 8);
    CHECK(second->levels.front().width == 32);
    CHECK(store.bytes() == first->bytes() + second->bytes());
    CHECK(store.bytes() <= 8'000);
    CHECK(store.notes().size() == 1);
    TextureStore roomy;
    CHECK(roomy.picture_in(large)->levels.front().width == 64);
    CHECK(roomy.notes() == std::vector<std::string>{"pictures on the aircraft: 1, which take 0.0 MiB"});
    CHECK(TextureStore().notes().empty());
}

TEST_CASE("DDS pictures are read from their blocks, and refused in one line where they end too soon") {
    // Ends red and blue; the first row has the four steps between them.
    std::string block;
    add_number(block, 0xf800, 2);
    add_number(block, 0x001f, 2);
    add_number(block, 0xe4, 4); // 0, 1, 2, 3, then zeros
    const TextureLevel level = dds_level("blocks", dds("DXT1", block));
    CHECK(texel(level, 0, 0) == Bytes{255, 0, 0, 255});
    CHECK(texel(level, 1, 0) == Bytes{0, 0, 255, 255});
    CHECK(texel(level, 2, 0) == Bytes{170, 0, 85, 255});
    CHECK(texel(level, 3, 3) == Bytes{255, 0, 0, 255});
    std::string alpha;
    add_number(alpha, 0x000000ff, 4); // ends 255 and 0, all the first
    add_number(alpha, 0, 4);
    CHECK(texel(dds_level("blocks", dds("DXT5", alpha + block)), 1, 0) == Bytes{0, 0, 255, 255});
    CHECK_THROWS_WITH(dds_level("cut.dds", dds("DXT5", block)), "cut.dds: expected 16 bytes of pixels, got 8");
    CHECK_THROWS_WITH(
        dds_level("new.dds", dds("BC7 ", block)), Catch::StartsWith("new.dds: expected a DDS picture of BC1 to BC5"));
    // Of BC5, red and green: ends of 200 and 100 by the first number, then by the second.
    const std::string ramp = std::string("\xc8\x64\x08", 3) + std::string(5, '\0');
    CHECK(texel(dds_level("blocks", dds("ATI2", ramp + ramp)), 0, 0) == Bytes{200, 200, 0, 255});
    CHECK(texel(dds_level("blocks", dds("BC5U", ramp + ramp)), 1, 0) == Bytes{100, 100, 0, 255});
    // FlightGear's begin with their lowest row.
    const auto file = file_with("turned.dds", dds("DXT1", block));
    TextureStore store;
    CHECK(texel(store.picture_in(file, true)->levels.front(), 1, 3) == Bytes{0, 0, 255, 255});
}

TEST_CASE("a picture is found behind backslashes, in another case and in the folders around a mesh") {
    const auto mesh = file_with("a.ac", "");
    const std::filesystem::path folder = mesh.parent_path() / "Tex";
    std::filesystem::create_directories(folder);
    write_file(folder / "Skin.TIF", tiff(1, 1, plain(1, 1)));
    for (const std::string name : {"tex\\skin.tif", "TEX/SKIN.tif", "C:\\work\\Skin.TIF", "skin.tif"}) {
        CAPTURE(name);
        CHECK(std::filesystem::equivalent(picture_file(mesh, name), folder / "Skin.TIF"));
    }
    CHECK_FALSE(std::filesystem::exists(picture_file(mesh, "other.tif")));
}

TEST_CASE("surfaces keep their pictures where textures are asked for, and vertices the colours") {
    file_with("two.bmp", tiff(2, 1, {255, 0, 0, 255, 0, 0, 255, 255}));
    const auto file = file_with("painted.ac", ac3d_square("0x0"));
    const auto store = std::make_shared<TextureStore>();
    const TriangleMesh mesh = read_mesh(file, {.pictures = true, .textures = store});
    REQUIRE(mesh.triangles.size() == 2);
    const Material& shown = mesh.materials.at(mesh.triangle_materials[0]);
    REQUIRE(shown.texture.picture != nullptr);
    CHECK(shown.texture.alpha == TextureAlpha::Opaque);
    CHECK(shown.texture.picture->levels.size() == 2);
    CHECK(mesh.corner_texture_coordinates.size() == 2);
    CHECK(mesh.colours.size() == 4);
    CHECK(read_mesh(file, {.pictures = true}).materials.at(0).texture.picture == nullptr);
    CHECK(store->count() == 1);
}

TEST_CASE("a picture with holes is a mask; what is mostly holes stays and is not left out") {
    Bytes holes = plain(4, 4, {200, 0, 0, 0});
    for (std::size_t at = 3; at < 16; at += 4) { holes[at] = 255; } // the uppermost row
    file_with("two.bmp", tiff(4, 4, holes));
    const auto file = file_with("lattice.ac", ac3d_square("0x0"));
    const MeshParts parts = read_parts(file, {.pictures = true, .textures = std::make_shared<TextureStore>()});
    REQUIRE(parts.body.triangles.size() == 2);
    CHECK(parts.body.materials.at(parts.body.triangle_materials[0]).texture.alpha == TextureAlpha::Mask);
    CHECK(read_parts(file, {.pictures = true}).body.triangles.empty());
}

TEST_CASE("a damaged picture is reported, and its surfaces have their material's colour") {
    file_with("two.bmp", "BM and then nothing");
    const auto file = file_with("damaged.ac", ac3d_square("0x0"));
    const TriangleMesh mesh = read_mesh(file, {.pictures = true, .textures = std::make_shared<TextureStore>()});
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Catch::EndsWith("its surfaces have their material's colour"));
    CHECK(mesh.materials.at(mesh.triangle_materials[0]).texture.picture == nullptr);
}

namespace {

/// A glTF triangle with the picture Skin.tif; more of its material and of its attributes.
TriangleMesh gltf_with_skin(const std::shared_ptr<TextureStore>& store, const std::string& of_material,
    const std::string& attributes = "", const std::string& more_accessors = "") {
    const std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":60,"uri":")" +
                             std::string("data:application/octet-stream;base64,") +
                             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/" +
                             R"("}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,)" +
                             R"("byteLength":24}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,)" +
                             R"("type":"VEC3"},{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2")" +
                             more_accessors + R"(}],)" +
                             R"("images":[{"uri":"Skin.tif"}],"samplers":[{"wrapS":33071,"wrapT":33648}],)" +
                             R"("textures":[{"source":0,"sampler":0}],"materials":[{"pbrMetallicRoughness":)" +
                             R"({"baseColorTexture":{"index":0}})" + of_material +
                             R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1)" + attributes +
                             R"(},"material":0}]}]})";
    return read_mesh(file_with("skin.gltf", text), {.pictures = store != nullptr, .textures = store});
}

} // namespace

TEST_CASE("glTF says how its pictures wrap and what their alpha does") {
    file_with("skin.tif", tiff(2, 1, {255, 0, 0, 90, 0, 0, 255, 255}));
    const auto store = std::make_shared<TextureStore>();
    const auto texture_of = [&](const std::string& mode) {
        const TriangleMesh mesh = gltf_with_skin(store, mode);
        return mesh.materials.at(mesh.triangle_materials.at(0)).texture;
    };
    const SurfaceTexture plain_one = texture_of("");
    REQUIRE(plain_one.picture != nullptr);
    CHECK(plain_one.wrap_u == TextureWrap::Clamp);
    CHECK(plain_one.wrap_v == TextureWrap::Mirror);
    CHECK(plain_one.alpha == TextureAlpha::Opaque);
    const SurfaceTexture masked = texture_of(R"(,"alphaMode":"MASK","alphaCutoff":0.25)");
    CHECK(masked.alpha == TextureAlpha::Mask);
    CHECK(masked.threshold == 0.25F);
}

TEST_CASE("colours of vertices tint a picture of glTF, in their mean; without pictures they are the vertices'") {
    file_with("skin.tif", tiff(2, 1, {255, 0, 0, 255, 0, 0, 255, 255}));
    const std::string colours = R"(,"COLOR_0":0)"; // the places: black, red and green
    const TriangleMesh mesh = gltf_with_skin(std::make_shared<TextureStore>(), "", colours);
    const Material& shown = mesh.materials.at(mesh.triangle_materials.at(0));
    REQUIRE(shown.texture.picture != nullptr);
    const auto third = static_cast<float>(srgb_from_linear(glm::dvec3(1.0 / 3.0)).x);
    CHECK(shown.colour.x == Approx(third));
    CHECK(shown.colour.y == Approx(third));
    CHECK(shown.colour.z == 0.0F);
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Catch::Contains("1 surfaces with a picture have colours of vertices that vary"));
    CHECK(gltf_with_skin(nullptr, "", colours).colours.at(1) == glm::vec3(1.0F, 0.0F, 0.0F));
}

TEST_CASE("colours that are not one for each place are refused alike with a picture and without") {
    file_with("skin.tif", tiff(2, 1, {255, 0, 0, 255, 0, 0, 255, 255}));
    const std::string two_colours = R"(},{"bufferView":0,"componentType":5126,"count":2,"type":"VEC3")";
    for (const auto& store : {std::make_shared<TextureStore>(), std::shared_ptr<TextureStore>()}) {
        CHECK_THROWS_WITH(gltf_with_skin(store, "", R"(,"COLOR_0":2)", two_colours),
            Catch::Contains("expected a COLOR_0 of 3 or 4 numbers for each of 3 places, got 2 of 3"));
    }
}

TEST_CASE("a picture that is mostly neither clear nor opaque is glass, as a turning propeller's disc") {
    Bytes disc = plain(8, 8, {90, 90, 90, 0});
    for (std::size_t texel = 0; texel < 64; ++texel) {
        disc[4 * texel + 3] = static_cast<std::uint8_t>(40 + 12 * (texel % 8)); // an alpha of 40 to 124
    }
    file_with("two.bmp", tiff(8, 8, disc));
    const auto file = file_with("disc.ac", ac3d_square("0x0"));
    const MeshParts parts = read_parts(file, {.pictures = true, .textures = std::make_shared<TextureStore>()});
    CHECK(parts.body.triangles.empty());
    REQUIRE(parts.clear.triangles.size() == 2);
    CHECK(parts.clear.materials.at(parts.clear.triangle_materials[0]).texture.alpha == TextureAlpha::Blend);
}
