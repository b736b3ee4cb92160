#include "obj_texts.h"

#include "models/polygons/obj_reader.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "tests/scratch.h"

namespace octant::models::polygons::test {

namespace {

std::string without_folder(const std::string& text) {
    const std::string folder = scratch("").string();
    return text.starts_with(folder) ? text.substr(folder.size()) : text;
}

} // namespace

std::filesystem::path scratch(const std::string& name) { return octant::tests::scratch_folder() / name; }

PolygonModel model_of(const std::string& text, const FileAxes& axes) {
    write_file(scratch("m.obj"), text);
    return read_obj(scratch("m.obj"), axes);
}

std::string message(const std::string& text) {
    try {
        model_of(text);
    } catch (const Error& error) { return without_folder(error.what()); }
    return "accepted";
}

std::vector<std::string> notes_of(const PolygonModel& model) {
    std::vector<std::string> notes;
    for (const std::string& note : model.notes) { notes.push_back(without_folder(note)); }
    return notes;
}

std::vector<std::uint32_t> corners(const PolygonModel& model, std::size_t polygon) {
    const auto span = model.corners(polygon);
    return {span.begin(), span.end()};
}

} // namespace octant::models::polygons::test
