#include "visuals/scene/ground.h"

namespace octant::visuals::scene {

std::unique_ptr<GroundMesher>
mesher_after(std::unique_ptr<GroundMesher> before, const Ground& ground, const Settings& settings) {
    if (!before || &before->ground() != &ground) {
        return ground.mesher(settings);
    }
    before->follow(settings);
    return before;
}

} // namespace octant::visuals::scene
