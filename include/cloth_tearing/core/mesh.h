// Who is joined to whom: particles, springs, triangles, and the edits that tear them apart.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "cloth_tearing/core/cloth_model.h"
#include "cloth_tearing/core/types.h"

namespace cloth
{

/// A mesh that cannot be built, or an edit that cannot be made. The mesh is unchanged.
class TopologyError : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// A structural spring: an edge of one or two triangles (thesis 3.1).
struct Spring
{
  std::array<ParticleId, 2> particles;
  std::array<TriangleId, 2> triangles;  ///< the second is none on a border

  bool border() const { return !triangles[1].valid(); }
  bool joins(ParticleId p) const { return particles[0] == p || particles[1] == p; }
  ParticleId other(ParticleId p) const { return particles[0] == p ? particles[1] : particles[0]; }
};

/// A face of the cloth with its own texture corners, so a tear cannot smear them (3.1.1, 3.3).
struct Triangle
{
  std::array<ParticleId, 3> particles;  ///< counter-clockwise seen from the front
  std::array<SpringId, 3> springs;  ///< springs[k] joins particles[k] and particles[(k + 1) % 3]
  std::array<Vec2d, 3> uv;  ///< texture position at particles[k], in double: areas must add up

  int cornerOf(ParticleId p) const;  ///< k with particles[k] == p, -1 if there is none
  int sideOf(SpringId s) const;      ///< k with springs[k] == s, -1 if there is none
};

/// Triangles around a particle that hang together through springs, counter-clockwise seen from
/// the front. springs[i] is the clockwise side of triangles[i].
struct Fan
{
  std::vector<TriangleId> triangles;
  std::vector<SpringId> springs;  ///< open: one more than triangles; closed: as many
  bool closed = false;

  int indexOf(SpringId s) const;  ///< place in `springs`, -1 if it is not there
};

/// What an edit added and touched, so that every per-element array can follow it.
struct Edit
{
  template <class Element>
  struct Added
  {
    Element id;
    Element parent;
  };

  /// A split point lies between two parents and starts at the first; a copy has its original twice.
  struct AddedParticle
  {
    ParticleId id;
    std::array<ParticleId, 2> parents;
  };

  std::vector<AddedParticle> particles;
  std::vector<Added<SpringId>> springs;      ///< half or twin first; then two middle springs, which
                                             ///< have no parent, for each of `triangles` (3.2.1)
  std::vector<Added<TriangleId>> triangles;  ///< the other halves of those that were split
  std::vector<TriangleId> touched;  ///< corners, springs or neighbours changed, added ones too

  // Each once, in the order in which the touched triangles name them.
  std::vector<ParticleId> near_particles;  ///< their corners, and the originals of copies
  std::vector<SpringId> near_springs;      ///< their sides

  /// The side of a halved triangle that was a side of the whole one.
  SpringId outerSide(const Triangle& half) const;
};

/// Connectivity of a manifold triangle mesh with borders, in any number of pieces (3.1.1).
///
/// Queries and edits cost O(degree of the particle) (fans() sorts: times its logarithm); nothing is
/// ever renumbered or deleted.
class Mesh
{
public:
  Mesh() = default;

  /// Springs are the edges of the triangles, numbered in the order in which these name them.
  ///
  /// @throws TopologyError if an index is out of range, a triangle repeats a particle, a particle
  ///   has no triangle, two triangles have the same corners, an edge has more than two triangles
  ///   or two that are wound against each other
  Mesh(int particle_count, const std::vector<ModelTriangle>& triangles);

  int particleCount() const { return static_cast<int>(first_corner_.size()); }
  int springCount() const { return static_cast<int>(springs_.size()); }
  int triangleCount() const { return static_cast<int>(triangles_.size()); }

  const Spring& spring(SpringId s) const { return springs_[s.index]; }
  const Triangle& triangle(TriangleId t) const { return triangles_[t.index]; }

  /// Corner opposite spring `s` in the triangle on its side 0 or 1; none where there is no
  /// triangle.
  ParticleId opposite(SpringId s, int side) const;

  /// Triangles at `p`, in no particular but a repeatable order.
  std::vector<TriangleId> trianglesAt(ParticleId p) const;

  /// Calls `visit(TriangleId)` for each triangle at `p`, without allocating.
  template <class Visitor>
  void forEachTriangleAt(ParticleId p, Visitor&& visit) const
  {
    for (int c = first_corner_[p.index]; c >= 0; c = next_corner_[c])
    {
      visit(TriangleId{ c / 3 });
    }
  }

  /// All fans around `p`, the one with the lowest triangle first.
  std::vector<Fan> fans(ParticleId p) const;

  /// The fan around `p` that holds triangle `t`.
  /// An open fan starts at its clockwise border; a closed one at `t`.
  Fan fanAt(ParticleId p, TriangleId t) const;

  /// The number of fans around `p`; two or more make a one-point connection (3.2.3).
  int fanCount(ParticleId p) const;

  /// Whether a border spring ends at `p`.
  bool onBorder(ParticleId p) const;

  /// Basic tear (thesis 3.2.1, figure 3.8): cuts across spring `s`, whose two halves let go of each
  /// other, and halves each of its triangles.
  ///
  /// Adds two particles, the split points: the first ends the half at particles[0], which stays
  /// `s`, the second the new half at particles[1]. Adds a middle spring from each split point to
  /// each opposite corner and a triangle per side: five springs and two triangles inside the cloth,
  /// three and one on a border. The split points get the exact mean of the texture corners, each
  /// side its own (3.3).
  Edit splitSpring(SpringId s);

  /// Weak-point tear (3.2.2, figure 3.12): detaches the two triangles of `s` from one another at
  /// `p`.
  ///
  /// The triangles of p's fan counter-clockwise of `s` move to a copy of `p`; `s` stays with the
  /// rest and gets a twin. Adds one particle and one spring; texture corners are untouched.
  ///
  /// @throws TopologyError if `s` does not end at `p`, is a border, or its fan at `p` is closed
  Edit detachAlong(ParticleId p, SpringId s);

  /// Opens sound cloth along two springs that meet in `p`: what detachAlong() is where the fan is
  /// closed, for cloth that is too fine to split.
  ///
  /// The triangles of p's fan counter-clockwise from `from` to `to` move to a copy of `p`; both
  /// springs get a twin. Adds one particle and two springs; texture corners are untouched.
  ///
  /// @throws TopologyError unless both are springs of one closed fan around `p`
  Edit openAlong(ParticleId p, SpringId from, SpringId to);

  /// Cuts a one-point connection: the fan that holds `t` gets its own copy of `p` (3.2.3).
  ///
  /// Adds one particle and no spring or triangle; texture corners are untouched.
  ///
  /// @throws TopologyError if `p` has fewer than two fans or `t` is not at `p`
  Edit detachFan(ParticleId p, TriangleId t);

  /// Cuts a one-point connection whole: every fan around `p` but the first gets its own copy of
  /// `p` (thesis 3.2.3, figure 3.19).
  ///
  /// Adds fans(p).size() - 1 particles and no spring or triangle.
  ///
  /// @throws TopologyError if `p` has fewer than two fans
  Edit separateFans(ParticleId p);

private:
  friend std::vector<std::string> defects(const Mesh& mesh);
  template <class Archive>
  friend void transfer(Archive& archive, Mesh& mesh);

  ParticleId addParticle();
  SpringId addSpring(ParticleId a, ParticleId b);
  TriangleId addTriangle(const Triangle& triangle);
  void link(TriangleId t, int corner);
  void unlink(TriangleId t, int corner);
  void replaceTriangle(SpringId s, TriangleId from, TriangleId to);
  void moveTriangles(const std::vector<TriangleId>& moved, ParticleId from, ParticleId to);
  void buildSprings();
  Edit withNeighbourhood(Edit edit) const;
  Edit detach(ParticleId p, const std::vector<TriangleId>& moved,
              const std::vector<SpringId>& cuts);

  // The triangles at a particle are a list threaded through their corners; corner 3 t + k is
  // particles[k] of triangle t.
  std::vector<int> first_corner_;  ///< by particle
  std::vector<int> next_corner_;   ///< by corner, -1 ends the list
  std::vector<Spring> springs_;
  std::vector<Triangle> triangles_;
};

/// Everything wrong with `mesh`, one sentence each, derived again from the triangle list alone:
/// references agree both ways, a spring has one or two triangles wound alike, its place among the
/// sides of these, no orphan, no repeated corner, all corners finite. Empty if it is sound.
/// Costs O(mesh); meant for tests and imports.
std::vector<std::string> defects(const Mesh& mesh);

}  // namespace cloth
