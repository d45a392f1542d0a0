// Sizes the arrays of motion alike.
#include "cloth_tearing/core/particle_state.h"

namespace cloth
{

void ParticleState::resize(int particles)
{
  position.resize(particles);
  velocity.resize(particles);
  previous.resize(particles);
  inverse_mass.resize(particles, Real(0));
}

}  // namespace cloth
