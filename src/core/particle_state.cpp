// Sizes the arrays of motion alike.
#include "cloth_tearing/core/particle_state.h"

namespace cloth
{

void ParticleState::resize(int particles)
{
  position.resize(particles, Vec3::Zero());
  velocity.resize(particles, Vec3::Zero());
  previous.resize(particles, Vec3::Zero());
  inverse_mass.resize(particles, Real(0));
}

}  // namespace cloth
