#include "models/polygons/obj_reader.h"
#include "tests/fuzz/formats/target.h"

namespace octant::tests::formats::mtl_format {

namespace {

void use(const std::filesystem::path& file) {
    for (const models::Material& material : models::polygons::read_mtl(file)) {
        expect(!material.name.empty(), "a name");
        for (int part = 0; part < 3; ++part) {
            expect(material.colour[part] >= 0.0F && material.colour[part] <= 1.0F, "0 to 1");
        }
    }
}

const Registered target({
    .name = "mtl",
    .file = "input.mtl",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{"# c\nnewmtl grey\nKd 0.5 0.5 0.5\nKa 1 1 1\nmap_Kd "
                                            "x.png\n\nnewmtl a b\nKd 1 0 1e-3\r\n"
                                            "newmtl plain\n"};
        },
    .words = {"newmtl ", "Kd ", "Kd 0 0 0\n", "newmtl grey\n", "\r\n", "\t"},
});

} // namespace

} // namespace octant::tests::formats::mtl_format
