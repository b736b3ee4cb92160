#pragma once

#include "visuals/gl/object.h"

#include <cstddef>

namespace octant::visuals::gl {

// Places of the inputs in visuals/gl/shaders/*.vert.
constexpr GLuint position_input = 0;
constexpr GLuint colour_input = 1;
constexpr GLuint normal_input = 2;
constexpr GLuint part_input = 3;
constexpr GLuint first_part_input = 4;
constexpr GLuint face_normal_input = 5;
constexpr GLuint polygon_input = 6;
constexpr GLuint first_smooth_input = 7;
constexpr GLuint face_colour_input = 8;
constexpr GLuint smooth_tint_input = 9;
constexpr GLuint flat_tint_input = 10;

/// Three floats at `offset` of each vertex of the array's buffer 0.
void add_vector_input(const Functions& gl, const Object& array, GLuint input, std::size_t offset);

/// Two floats at `offset` of each vertex of the array's buffer 0.
void add_place_input(const Functions& gl, const Object& array, GLuint input, std::size_t offset);

/// Four bytes at `offset` of each element of the array's buffer `binding`, 255 read as 1.
void add_colour_input(
    const Functions& gl, const Object& array, std::size_t offset, GLuint input = colour_input, GLuint binding = 0);

/// A 32-bit number at `offset` of each element of the array's buffer `binding`.
void add_number_input(const Functions& gl, const Object& array, GLuint input, GLuint binding, std::size_t offset);

} // namespace octant::visuals::gl
