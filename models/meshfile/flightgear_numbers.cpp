#include "models/meshfile/flightgear_numbers.h"

#include "models/meshfile/mesh_builder.h"
#include "models/meshfile/word_scanner.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <cmath>

namespace octant::models::meshfile {

double number_in(
    const std::filesystem::path& file,
    const XmlElement& parent,
    std::string_view name,
    double without) {
    const XmlElement* found = parent.find(name);
    if (found == nullptr || found->text.empty()) {
        return without;
    }
    const auto value = finite_number(found->text);
    if (!value || std::abs(*value) > most_coordinate) {
        error_at(file, found->line, "expected a number, got " + in_quotes(found->text));
    }
    return *value;
}

} // namespace octant::models::meshfile
