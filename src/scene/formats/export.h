// Exports matrices, vertices and meshes, and reads points from CSV files.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/scene.h"

namespace holomorph {

/// A NumPy file (.npy, version 1.0) of a complex128 matrix, row-major.
std::string npy_of(const MatrixXc& matrix);

/// A NumPy file of the positions as a float64 matrix, n x 2.
std::string npy_of(std::span<const Complex> positions);

/// A NumPy file of a float32 array, rows x columns x depth, with depth varying fastest.
std::string npy_of(const std::vector<float>& numbers, size_t rows, size_t columns, size_t depth);

/// The deformed mesh as Wavefront OBJ, with positions in pixels of the picture. Texture coordinates
/// refer to the page.
std::string obj_of(const Mesh& mesh, std::span<const Complex> positions, const Box& page);

/// The points in a table: two numbers per line, separated by a semicolon, a tab, a comma or blanks,
/// in UTF-8 or UTF-16. Fields may be quoted, and numbers may have a decimal comma. The first line
/// is skipped as a heading if none of its fields is a number. NaN is an error unless `takes_nan`.
/// Throws Error with the line number.
Points points_of_csv(const std::string& bytes, const std::string& name, bool takes_nan = false);

}  // namespace holomorph
