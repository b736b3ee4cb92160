#pragma once

#include <atomic>
#include <mutex>

namespace octant {

/// A shared library that is opened when the first of its functions is called: a program that calls none loads neither
/// the library nor its dependencies.
class LazyLibrary {
public:
    /// `file`: as the system's linker finds it, such as "libgdal.so.32".
    explicit constexpr LazyLibrary(const char* file) : file_(file) {}

    /// The address of a function. Throws Error if the library or the function is missing.
    void* address_of(const char* name);

    /// The address of a function of the library or of its dependencies; null if there is none.
    void* find(const char* name);

private:
    const char* file_;
    std::once_flag once_;
    void* handle_ = nullptr;
};

/// A function of such a library, called like any other. Calls from the namespace in which it is declared use it instead
/// of the library's own declaration.
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
