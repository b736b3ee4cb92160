#include "models/heights/gdal_functions.h"

namespace octant::models::heights {

constinit LazyLibrary gdal_library(OCTANT_GDAL_FILE);

} // namespace octant::models::heights
