#include "sim/base/format_once.h"

// The library was compiled by g++. Clang 14 spells this function's type otherwise in its symbol, so that it would be
// missing when programs are linked: it is compiled once, here.
#if defined(__clang__) && FMT_VERSION >= 90000 && FMT_VERSION < 100000
namespace fmt::inline v9::detail {

template void vformat_to<char>(buffer<char>& out, basic_string_view<char> format,
    basic_format_args<buffer_context<char>> arguments, locale_ref locale);

} // namespace fmt::inline v9::detail
#endif
