#include "models/meshfile/format_axes.h"

#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace octant::models::meshfile {

std::optional<polygons::FileAxes> axes_of_format(const std::filesystem::path& file) {
    const std::string ending = extension_of(file);
    if (ending == ".ac") { return polygons::FileAxes::from_text("back,up,left"); }
    if (ending == ".gltf" || ending == ".glb") { return polygons::FileAxes::from_text("left,up,forward"); }
    if (ending == ".xml") { return polygons::FileAxes::from_text("back,right,up"); }
    return std::nullopt;
}

std::optional<polygons::FileAxes> default_axes_of_format(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 5> scenes{".flt", ".ive", ".osg", ".osgb", ".osgt"};
    return std::ranges::find(scenes, extension_of(file)) == scenes.end()
               ? std::nullopt
               : std::optional(polygons::FileAxes::from_text("right,forward,up"));
}

} // namespace octant::models::meshfile
