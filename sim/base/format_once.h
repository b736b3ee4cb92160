#pragma once

#include <fmt/format.h>

// Whoever uses fmt::format_to includes this. fmt 9 compiles all of its formatting, which takes 3 s, in each such file;
// the library has it, too, and this declaration makes files take it from there.
#if FMT_VERSION >= 90000 && FMT_VERSION < 100000 && !defined(FMT_HEADER_ONLY)
namespace fmt::inline v9::detail {

extern template void vformat_to<char>(buffer<char>& out, basic_string_view<char> format,
    basic_format_args<buffer_context<char>> arguments, locale_ref locale);

} // namespace fmt::inline v9::detail
#endif
