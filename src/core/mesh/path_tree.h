// Paths inside the domain from one root to several stations, such as pins, closed paths around its
// holes, and a quadrature along all of them.
//
// A map without folds is known by its derivatives. Its values at the stations are integrals along
// these paths.
#pragma once

#include "core/mesh/mesh.h"

namespace holomorph {

/// A tree of straight pieces. Each piece is short compared with its distance from the polygon of a
/// basis, so a Gauss rule integrates functions of the basis along it almost to rounding.
class PathTree {
 public:
  static constexpr int kNodes = 6;  ///< per piece

  struct Piece {
    Complex from, to;
    Index parent = -1;  ///< the piece that ends where this one starts; -1: the root
  };

  PathTree() = default;
  /// Shortest paths over the edges of a mesh, with the stations connected to the corners of their
  /// triangles. Paths pass through boundary vertices only if necessary. Shared parts occur once.
  /// The root is the first station. Each of the `loops`, which are closed, starts without a parent.
  /// Pieces are no longer than 1.5 times the distance of their midpoints from `polygon`, which must
  /// surround the mesh. Where this allows, they are chords of several edges, which saves most of
  /// the nodes. The error of the quadrature is below 1e-10 of the integrand times the length. Cost:
  /// linear in the mesh, plus stations and pieces times polygon vertices.
  PathTree(const Mesh& mesh, PolygonView polygon, const Points& stations,
           const std::vector<Points>& loops = {});

  const std::vector<Piece>& pieces() const { return pieces_; }
  /// For each station, the piece that ends there, or -1 if the station is the root.
  const std::vector<Index>& ends() const { return ends_; }
  /// For each loop, its last piece.
  const std::vector<Index>& loops() const { return loops_; }
  /// The nodes of all pieces, kNodes each, and their complex weights (the rule times dz).
  const Points& nodes() const { return nodes_; }
  const VectorXc& weights() const { return weights_; }

 private:
  void add_paths(const Mesh& mesh, PolygonView polygon, const Points& stations);
  void add_pieces(const Points& line, PolygonView polygon, Index parent);
  void set_nodes();

  std::vector<Piece> pieces_;
  std::vector<Index> ends_, loops_;
  Points nodes_;
  VectorXc weights_;
};

}  // namespace holomorph
