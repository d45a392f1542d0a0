// One sheet of cloth: connectivity, rest shape, motion, damage and who holds it, kept in step.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth_tearing/core/grasp.h"
#include "cloth_tearing/core/material.h"
#include "cloth_tearing/core/mesh.h"
#include "cloth_tearing/core/particle_state.h"
#include "cloth_tearing/core/rest_shape.h"
#include "cloth_tearing/core/spring_table.h"
#include "cloth_tearing/core/strength.h"

namespace cloth
{

/// What tearing knows of each element.
struct Damage
{
  std::vector<char> weak;        ///< by particle: a tear ends here and may run on (3.2.2)
  std::vector<char> hinge;       ///< by particle: a one-point connection (3.2.3)
  std::vector<char> at_rest;     ///< by particle: its piece was put to rest
  std::vector<char> hem;         ///< by particle: within the hem of a pin
  std::vector<double> strength;  ///< by spring: its thresholds are multiplied by this [-]
  double least_strength = 1.0;   ///< no spring's strength, ever, is below this [-], <= 1
  std::vector<char> outer;       ///< by spring: on the border of the untorn cloth
  std::vector<char> released;    ///< by spring: carries no load any more
  std::vector<std::array<int, 2>> parents;  ///< by particle; itself twice if it was there first
  std::uint64_t tears = 0;                  ///< edits so far: the revision of the topology
  int pieces = 0;
  int pieces_at_rest = 0;
};

/// Every array follows every edit through follow().
struct Cloth
{
  Material material;
  Mesh mesh;
  RestShape rest;
  ParticleState state;
  SpringTable springs;
  Damage damage;
  std::vector<Attachment> attachments;  ///< by particle

  /// Extends and refreshes everything per element after an edit of `mesh`. New particles get the
  /// position, velocity and (for copies) attachment NONE of their first parent; callers move them.
  void follow(const Edit& edit);

  /// A structural spring carries no load any more. Nor do those bend-shear springs whose ends then
  /// no load-bearing sides of their two triangles hold together: nothing else limits their length.
  void release(SpringId s);

  /// Makes the cloth of another material: springs and masses anew, torn, held and at rest as it is.
  void setMaterial(const Material& other);

  /// Marks the hem [m] (see TearRules) of cloth that is where and as it was built.
  void markHem(double width);

  /// Takes over the hem of the cloth that this one was torn from.
  void takeHem(const Cloth& untorn);

  /// Sets who holds a particle, and its inverse mass with it.
  void attach(ParticleId p, const Attachment& attachment);

  /// Inverse of the true mass, 0 for a particle that is held or at rest.
  void refreshInverseMass(ParticleId p);

  /// Length over rest length - 1 of a structural spring [-].
  double strain(SpringId s) const;

  /// Of mass, without the pieces at rest [m]. @throws Refusal if there is nothing else
  Vec3d center() const;

  /// Vector from one end to the other [m], from `from`.
  Vec3 direction(SpringId s, ParticleId from) const;
};

/// @param pinned particles that stand still
/// @param hem_width see TearRules [m]
/// @param strength in the coordinates of `model`
/// @throws TopologyError, or Refusal of a model beyond MAX_COORDINATE or without lengths and areas,
/// or of a strength map that touches none of it
Cloth makeCloth(const ClothModel& model, const std::vector<int>& pinned, const Material& material,
                RestShapeSource rest_shape, double hem_width, const StrengthParams& strength = {});

}  // namespace cloth
