#include "sim/base/lazy_library.h"

#include "sim/base/error.h"

#include <dlfcn.h>
#include <string>

namespace octant {

void* LazyLibrary::address_of(const char* name) {
    void* const at = find(name);
    if (at == nullptr) {
        throw Error(std::string("expected ") + file_ + (handle_ == nullptr ? "" : std::string(" with ") + name) +
                    " on this system, got none");
    }
    return at;
}

void* LazyLibrary::find(const char* name) {
    std::call_once(once_, [this] { handle_ = ::dlopen(file_, RTLD_LAZY | RTLD_LOCAL); });
    return handle_ == nullptr ? nullptr : ::dlsym(handle_, name);
}

} // namespace octant
