#include "visuals/terrain/ground_builder.h"
