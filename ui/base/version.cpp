#include "ui/base/version.h"

#include <octant_version.h>

namespace octant::ui::base {

std::string program_version() {
    return OCTANT_VERSION;
}

std::string program_commit() {
    return OCTANT_COMMIT;
}

} // namespace octant::ui::base
