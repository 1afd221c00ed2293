// Exports other than pictures and curves: matrices, vertices, meshes.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/scene.h"

namespace holomorph {

/// A NumPy file (.npy, version 1.0) of a complex128 matrix, row-major.
std::string npy_of(const MatrixXc& matrix);

/// A NumPy file of the positions as a float64 matrix, n x 2.
std::string npy_of(std::span<const Complex> positions);

/// A NumPy file of single-precision numbers, rows x columns x depth, with depth varying fastest.
std::string npy_of(const std::vector<float>& numbers, size_t rows, size_t columns, size_t depth);

/// The warped mesh as Wavefront OBJ, with positions in image pixels and texture coordinates in the
/// picture.
std::string obj_of(const Mesh& mesh, std::span<const Complex> positions, int image_width,
                   int image_height);

/// The points of a CSV file: two numbers per line, separated by a comma, a semicolon or blanks. A
/// first line that does not start with a number is a heading. NaN is an error unless `takes_nan`.
/// Throws Error naming the line.
Points points_of_csv(const std::string& text, const std::string& name, bool takes_nan = false);

}  // namespace holomorph
