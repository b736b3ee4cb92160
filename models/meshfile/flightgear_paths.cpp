#include "models/meshfile/flightgear_paths.h"

#include <iterator>
#include <system_error>

namespace octant::models::meshfile {

namespace fs = std::filesystem;

fs::path flightgear_file(const fs::path& model, const std::string& name) {
    std::error_code ignored;
    for (fs::path folder = fs::absolute(model).parent_path();; folder = folder.parent_path()) {
        fs::path named = name;
        // "Aircraft/NAME/Models/..." where the aircraft's own folder is called something else
        for (int less = 0; less < 3 && !named.empty(); ++less) {
            if (fs::is_regular_file(folder / named, ignored)) { return folder / named; }
            fs::path shorter;
            for (auto part = std::next(named.begin()); part != named.end(); ++part) { shorter /= *part; }
            named = shorter;
        }
        if (folder == folder.parent_path()) { return {}; }
    }
}

fs::path flightgear_pictures(const fs::path& model, const std::string& texture_path) {
    const fs::path folder = fs::path(texture_path).relative_path();
    return folder.empty() ? fs::path() : model.parent_path() / folder;
}

} // namespace octant::models::meshfile
