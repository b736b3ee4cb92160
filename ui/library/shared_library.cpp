// The one source of the shared library itself: all else is in the modules that are linked into it.
#include <octant/octant.h>

namespace octant {

static_assert(abi_version >= 0);

} // namespace octant
