// A known delay for trials of octant compare. Preloaded into octant, it makes the plan stage of some frames longer:
//   g++ -shared -fPIC -O1 -fno-builtin tests/evidence/slow_stage.cpp -o slow_stage.so
//   printf '#!/bin/sh\nLD_PRELOAD=$PWD/slow_stage.so exec octant "$@"\n' > slower; chmod +x slower
//   SLOW_US=400 SLOW_FIRST=80 SLOW_LAST=120 octant compare octant ./slower
// The plan stage calls exp2() eight times a frame, and nothing else does (visuals/scene/detail_pattern.cpp). Each call
// spins for an eighth of SLOW_US microseconds of processor time. States and pictures stay the same.
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>

namespace {

constexpr long calls_a_frame = 8;

double variable(const char* name, double otherwise) {
    const char* const text = std::getenv(name);
    return text == nullptr ? otherwise : std::atof(text);
}

double processor_s() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

extern "C" double exp2(double x) {
    static const auto real = reinterpret_cast<double (*)(double)>(dlsym(RTLD_NEXT, "exp2"));
    static const double delay_s = 1e-6 * variable("SLOW_US", 0.0) / calls_a_frame;
    static const auto first = static_cast<long>(variable("SLOW_FIRST", 0.0));
    static const auto last = static_cast<long>(variable("SLOW_LAST", 1e9));
    static long calls = 0;
    const long frame = calls++ / calls_a_frame;
    if (frame >= first && frame <= last) {
        const double end_s = processor_s() + delay_s;
        while (processor_s() < end_s) {}
    }
    return real(x);
}
