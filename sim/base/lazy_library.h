#pragma once

#include <atomic>
#include <mutex>

namespace octant {

/// A shared library that is opened when the first of its functions is called: a program that calls none starts without
/// it and all that it depends on.
class LazyLibrary {
public:
    /// `file`: as the system's linker finds it, such as "libgdal.so.32".
    explicit constexpr LazyLibrary(const char* file) : file_(file) {}

    /// Of a function. Throws Error where the library or the function is not to be had.
    void* address_of(const char* name);

    /// The same of a function that may be missing, also one of a library below; null where it is.
    void* find(const char* name);

private:
    const char* file_;
    std::once_flag once_;
    void* handle_ = nullptr;
};

/// A function of such a library, called by its name like any other: where it is declared in a namespace, calls from
/// there take it in place of the library's own.
template <class Function>
class LazyFunction {
public:
    constexpr LazyFunction(LazyLibrary& library, const char* name) : library_(library), name_(name) {}

    // NOLINTNEXTLINE(google-explicit-constructor): that is what makes it callable
    operator Function*() const {
        void* at = address_.load(std::memory_order_acquire);
        if (at == nullptr) {
            at = library_.address_of(name_);
            address_.store(at, std::memory_order_release);
        }
        return reinterpret_cast<Function*>(at);
    }

private:
    LazyLibrary& library_;
    const char* name_;
    mutable std::atomic<void*> address_ = nullptr;
};

} // namespace octant
