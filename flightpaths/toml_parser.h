#pragma once

// toml++ 3.3 asserts, and in a release assumes, what its parser refuses in the next lines: "[[^"
// would end the program, or worse. Without NDEBUG and with this it is refused.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)

#include <toml++/toml.h>

#pragma pop_macro("NDEBUG")
