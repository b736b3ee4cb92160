# Fails when a file uses a name of the standard library, of fmt or of glm whose header neither it nor
# a header of this project that it includes names. Compilers cannot tell: the common headers are
# precompiled into every file (octant_common_headers in CMakeLists.txt).
cmake_minimum_required(VERSION 3.25)

# declares(header names ...): where the names that the common headers declare come from.
macro(declares header)
  foreach(name ${ARGN})
    list(APPEND headers_of_${name} ${header})
  endforeach()
endmacro()
declares(algorithm std::sort std::stable_sort std::min std::max std::minmax std::clamp std::copy std::copy_n std::fill std::fill_n
  std::find std::find_if std::any_of std::all_of std::none_of std::count std::count_if std::transform std::replace std::reverse
  std::rotate std::unique std::remove_if std::lower_bound std::upper_bound std::binary_search std::equal_range std::nth_element
  std::partial_sort std::min_element std::max_element std::minmax_element std::equal std::for_each std::generate std::merge
  std::partition std::stable_partition std::push_heap std::pop_heap std::make_heap std::sort_heap std::mismatch std::search
  std::set_difference std::is_sorted std::adjacent_find std::inplace_merge)
declares(array std::array)
declares(cmath std::sqrt std::sin std::cos std::tan std::asin std::acos std::atan std::atan2 std::exp std::log std::log2 std::log10
  std::pow std::floor std::ceil std::round std::lround std::llround std::trunc std::fmod std::hypot std::cbrt std::isfinite
  std::isnan std::isinf std::ldexp std::frexp std::remainder std::nextafter std::signbit std::copysign std::fma)
declares(cstdint std::uint8_t std::uint16_t std::uint32_t std::uint64_t std::int8_t std::int16_t std::int32_t std::int64_t
  std::uintptr_t)
declares(filesystem std::filesystem)
declares(functional std::function std::less std::greater std::hash std::invoke std::ref std::cref std::reference_wrapper std::plus)
declares(limits std::numeric_limits)
declares(map std::map std::multimap)
declares(memory std::unique_ptr std::shared_ptr std::weak_ptr std::make_unique std::make_shared std::construct_at)
declares(numeric std::accumulate std::iota std::reduce std::inner_product std::partial_sum std::exclusive_scan std::gcd std::lcm
  std::midpoint)
declares(optional std::optional std::nullopt std::make_optional)
declares(set std::set std::multiset)
declares(span std::span std::as_bytes std::as_writable_bytes)
declares(string std::string std::to_string std::stod std::stoi std::stoul std::getline)
declares(string_view std::string_view)
declares(utility std::move std::forward std::swap std::pair std::exchange std::in_place std::cmp_less std::make_pair)
declares(vector std::vector)
# Forms that the standard lets other headers declare, too.
declares(map std::pair)
declares(algorithm std::swap)
declares(tuple std::swap)
declares(string std::string_view)
declares(memory std::hash)

file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/sim/*.h ${ROOT}/sim/*.cpp ${ROOT}/flightpaths/*.h ${ROOT}/flightpaths/*.cpp
  ${ROOT}/models/*.h ${ROOT}/models/*.cpp ${ROOT}/visuals/*.h ${ROOT}/visuals/*.cpp ${ROOT}/ui/*.h ${ROOT}/ui/*.cpp
  ${ROOT}/tests/*.h ${ROOT}/tests/*.cpp)

# named_<file>: headers from outside that a file or a header of this project that it includes names.
function(find_named file)
  get_property(known GLOBAL PROPERTY known_${file})
  if(known)
    return()
  endif()
  set_property(GLOBAL PROPERTY known_${file} TRUE)
  get_filename_component(folder ${file} DIRECTORY)
  file(STRINGS ${ROOT}/${file} lines REGEX "^#include [<\"]")
  set(named "")
  foreach(line ${lines})
    string(REGEX REPLACE "^#include [<\"]([^>\"]+)[>\"].*" "\\1" target "${line}")
    if(EXISTS ${ROOT}/${folder}/${target} AND line MATCHES "\"")
      set(target ${folder}/${target})
    endif()
    if(line MATCHES "\"" AND EXISTS ${ROOT}/${target})
      find_named(${target})
      get_property(further GLOBAL PROPERTY named_${target})
      list(APPEND named ${target} ${further})
    else()
      list(APPEND named ${target})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES named)
  set_property(GLOBAL PROPERTY named_${file} ${named})
endfunction()

foreach(file ${files})
  if(file MATCHES "^tests/peers/")
    continue()
  endif()
  find_named(${file})
  get_property(named GLOBAL PROPERTY named_${file})
  file(STRINGS ${ROOT}/${file} lines REGEX "std::|fmt::|glm::")
  list(FILTER lines EXCLUDE REGEX "^ *//")
  string(REGEX MATCHALL "std::[a-z_0-9]+" names "${lines}")
  list(REMOVE_DUPLICATES names)
  foreach(name ${names})
    if(NOT headers_of_${name})
      continue()
    endif()
    set(found FALSE)
    foreach(header ${headers_of_${name}})
      if(header IN_LIST named)
        set(found TRUE)
      endif()
    endforeach()
    if(NOT found)
      list(GET headers_of_${name} 0 header)
      message(SEND_ERROR "${file}: uses ${name}, expected #include <${header}>")
    endif()
  endforeach()
  foreach(library fmt glm)
    if("${lines}" MATCHES "${library}::" AND NOT "${named}" MATCHES "(^|;)${library}/")
      message(SEND_ERROR "${file}: uses ${library}, expected one of its headers")
    endif()
  endforeach()
endforeach()
