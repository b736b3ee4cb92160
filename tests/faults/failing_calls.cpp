// Preloaded into the program that is tried: the N-th allocation of its own code throws, the N-th write of any code to a
// regular file fails as on a full disk. What libraries in C allocate, and programs that it starts, are left alone.
#include "tests/faults/fault_counters.h"

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <new>
#include <string_view>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

using octant::tests::faults::counters_variable;
using octant::tests::faults::FaultCounters;

FaultCounters* counters = nullptr;
bool is_counting = false;

/// The machine code of the program and of libstdc++, which allocates for it.
struct OwnCode {
    static constexpr std::size_t most = 8;

    struct Range {
        std::uintptr_t first = 0;
        std::uintptr_t end = 0;
    };

    Range ranges[most];
    std::size_t count = 0;

    bool holds(const void* address) const {
        const auto at = reinterpret_cast<std::uintptr_t>(address);
        for (std::size_t i = 0; i < count; ++i) {
            if (at >= ranges[i].first && at < ranges[i].end) { return true; }
        }
        return false;
    }
};

OwnCode own_code;

int note_own_code(dl_phdr_info* object, std::size_t /*size*/, void* /*unused*/) {
    const std::string_view name = object->dlpi_name;
    if (!name.empty() && name.find("libstdc++") == name.npos && name.find("libfmt") == name.npos) { return 0; }
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const ElfW(Phdr)& part = object->dlpi_phdr[i];
        if (part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0 && own_code.count < OwnCode::most) {
            const std::uintptr_t first = object->dlpi_addr + part.p_vaddr;
            own_code.ranges[own_code.count++] = {first, first + part.p_memsz};
        }
    }
    return 0;
}

void map_counters() {
    const char* const file = std::getenv(counters_variable);
    if (file == nullptr) { return; }
    const int descriptor = ::open(file, O_RDWR | O_CLOEXEC);
    if (descriptor < 0) { return; }
    void* const mapped = ::mmap(nullptr, sizeof(FaultCounters), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    ::close(descriptor);
    ::unsetenv("LD_PRELOAD");
    ::unsetenv(counters_variable);
    dl_iterate_phdr(note_own_code, nullptr);
    counters = mapped == MAP_FAILED ? nullptr : static_cast<FaultCounters*>(mapped);
}

bool is_due(std::uint64_t point, std::uint64_t failing) {
    return failing != 0 && (point == failing || (point > failing && counters->goes_on != 0));
}

bool allocation_fails(const void* caller) {
    return is_counting && own_code.holds(caller) && is_due(++counters->allocations, counters->failing_allocation);
}

bool point_fails() {
    const bool fails = is_counting && is_due(++counters->writes, counters->failing_write);
    if (fails) { errno = ENOSPC; }
    return fails;
}

bool write_fails(int descriptor) {
    struct stat facts {};

    return ::fstat(descriptor, &facts) == 0 && S_ISREG(facts.st_mode) && point_fails();
}

template <typename Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

void* allocated(std::size_t bytes, const void* caller) {
    void* const memory = allocation_fails(caller) ? nullptr : std::malloc(bytes == 0 ? 1 : bytes);
    if (memory == nullptr) { throw std::bad_alloc(); }
    return memory;
}

void* allocated(std::size_t bytes, std::align_val_t alignment, const void* caller) {
    void* memory = nullptr;
    if (allocation_fails(caller) ||
        ::posix_memalign(&memory, static_cast<std::size_t>(alignment), bytes == 0 ? 1 : bytes) != 0) {
        throw std::bad_alloc();
    }
    return memory;
}

} // namespace

void* operator new(std::size_t bytes) { return allocated(bytes, __builtin_return_address(0)); }

void* operator new[](std::size_t bytes) { return allocated(bytes, __builtin_return_address(0)); }

void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return allocated(bytes, alignment, __builtin_return_address(0));
}

void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    return allocated(bytes, alignment, __builtin_return_address(0));
}

void operator delete(void* memory) noexcept { std::free(memory); }

void operator delete[](void* memory) noexcept { std::free(memory); }

void operator delete(void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }

void operator delete[](void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }

void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }

void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }

void operator delete(void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}

void operator delete[](void* memory, std::size_t /*bytes*/, std::align_val_t /*alignment*/) noexcept {
    std::free(memory);
}

// The names that the program calls have to be seen: all other code is compiled with hidden ones.
#pragma GCC visibility push(default)
extern "C" {

using Main = int (*)(int, char**, char**);

/// Counting begins with main(): nobody could catch what fails before.
// NOLINTNEXTLINE: the C library's own name
int __libc_start_main(
    Main program, int argc, char** argv, void (*init)(), void (*fini)(), void (*rtld_fini)(), void* stack) {
    static Main own = nullptr;
    own = program;
    map_counters();
    static auto* const real = next<decltype(__libc_start_main)>("__libc_start_main");
    const auto counted = [](int count, char** words, char** variables) {
        is_counting = counters != nullptr;
        return own(count, words, variables);
    };
    return real(counted, argc, argv, init, fini, rtld_fini, stack);
}

ssize_t write(int descriptor, const void* bytes, std::size_t count) {
    static auto* const real = next<decltype(write)>("write");
    return write_fails(descriptor) ? -1 : real(descriptor, bytes, count);
}

ssize_t writev(int descriptor, const iovec* pieces, int count) {
    static auto* const real = next<decltype(writev)>("writev");
    return write_fails(descriptor) ? -1 : real(descriptor, pieces, count);
}

ssize_t pwrite64(int descriptor, const void* bytes, std::size_t count, off64_t at) {
    static auto* const real = next<decltype(pwrite64)>("pwrite64");
    return write_fails(descriptor) ? -1 : real(descriptor, bytes, count, at);
}

ssize_t pwrite(int descriptor, const void* bytes, std::size_t count, off_t at) {
    static auto* const real = next<decltype(pwrite)>("pwrite");
    return write_fails(descriptor) ? -1 : real(descriptor, bytes, count, at);
}

std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, std::FILE* file) {
    static auto* const real = next<decltype(fwrite)>("fwrite");
    return write_fails(::fileno(file)) ? 0 : real(bytes, size, count, file);
}

int ftruncate(int descriptor, off_t size) {
    static auto* const real = next<decltype(ftruncate)>("ftruncate");
    return write_fails(descriptor) ? -1 : real(descriptor, size);
}

int ftruncate64(int descriptor, off64_t size) {
    static auto* const real = next<decltype(ftruncate64)>("ftruncate64");
    return write_fails(descriptor) ? -1 : real(descriptor, size);
}

int posix_fallocate(int descriptor, off_t at, off_t size) {
    static auto* const real = next<decltype(posix_fallocate)>("posix_fallocate");
    return write_fails(descriptor) ? ENOSPC : real(descriptor, at, size);
}

int posix_fallocate64(int descriptor, off64_t at, off64_t size) {
    static auto* const real = next<decltype(posix_fallocate64)>("posix_fallocate64");
    return write_fails(descriptor) ? ENOSPC : real(descriptor, at, size);
}

int fallocate(int descriptor, int mode, off_t at, off_t size) {
    static auto* const real = next<decltype(fallocate)>("fallocate");
    return write_fails(descriptor) ? -1 : real(descriptor, mode, at, size);
}

int fallocate64(int descriptor, int mode, off64_t at, off64_t size) {
    static auto* const real = next<decltype(fallocate64)>("fallocate64");
    return write_fails(descriptor) ? -1 : real(descriptor, mode, at, size);
}

int rename(const char* from, const char* to) {
    static auto* const real = next<decltype(rename)>("rename");
    return point_fails() ? -1 : real(from, to);
}

int fsync(int descriptor) {
    static auto* const real = next<decltype(fsync)>("fsync");
    return write_fails(descriptor) ? -1 : real(descriptor);
}

} // extern "C"
#pragma GCC visibility pop
