#include "ui/base/memory.h"

#include <malloc.h>

namespace octant::ui::base {

void release_free_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
    mallopt(M_TOP_PAD, 1 << 17);
#endif
}

} // namespace octant::ui::base
