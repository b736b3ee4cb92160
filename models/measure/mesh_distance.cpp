#include "models/measure/mesh_distance.h"

#include <algorithm>

namespace octant::models::measure {

double MeshDistance::least_hausdorff_m() const {
    return std::max(there.least_hausdorff_m, back.least_hausdorff_m);
}

double MeshDistance::most_hausdorff_m() const {
    return std::max(there.most_hausdorff_m, back.most_hausdorff_m);
}

double MeshDistance::rms_m() const {
    return std::max(there.rms_m, back.rms_m);
}

double MeshDistance::mean_m() const {
    return std::max(there.mean_m, back.mean_m);
}

double MeshDistance::colour_rms() const {
    return std::max(there.colour_rms, back.colour_rms);
}

} // namespace octant::models::measure
