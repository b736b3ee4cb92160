#include "models/meshfile/format_axes.h"

#include "sim/base/text_file.h"

namespace octant::models::meshfile {

std::optional<polygons::FileAxes> axes_of_format(const std::filesystem::path& file) {
    const std::string ending = ending_of(file);
    if (ending == ".ac") {
        return polygons::FileAxes::from_text("back,up,left");
    }
    if (ending == ".gltf" || ending == ".glb") {
        return polygons::FileAxes::from_text("left,up,forward");
    }
    if (ending == ".xml") {
        return polygons::FileAxes::from_text("back,right,up");
    }
    return std::nullopt;
}

} // namespace octant::models::meshfile
