// What leaves the program besides pictures and curves: matrices, vertices, meshes.
#pragma once

#include "core/mesh/mesh.h"
#include "scene/scene.h"

namespace holomorph {

/// A NumPy file (.npy, version 1.0) of a complex128 matrix, row-major.
std::string npy_of(const MatrixXc& matrix);

/// A NumPy file of the positions as a float64 matrix, n x 2.
std::string npy_of(std::span<const Complex> positions);

/// A NumPy file of numbers in single precision, rows x columns x depth, depth running fastest.
std::string npy_of(const std::vector<float>& numbers, size_t rows, size_t columns, size_t depth);

/// The warped mesh as Wavefront OBJ: positions in image pixels, texture coordinates of the picture.
std::string obj_of(const Mesh& mesh, std::span<const Complex> positions, int image_width,
                   int image_height);

/// The points of a CSV file: two numbers a line, separated by comma, semicolon or blanks; a first
/// line that is no pair of numbers is a heading. Throws Error naming the line.
Points points_of_csv(const std::string& text, const std::string& name, bool takes_nan = false);

}  // namespace holomorph
