#include "visuals/terrain/ground_tiles.h"
