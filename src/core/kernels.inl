// The loops of kernels.h. Included once for each instruction set, into a namespace of its own.

#include "kernels/registers.inl"
#include "kernels/records.inl"
#include "kernels/sweep.inl"
#include "kernels/lines.inl"
#include "kernels/forces.inl"
#include "kernels/wind.inl"
#include "kernels/particles.inl"
#include "kernels/contact.inl"

constexpr Set SET = { NAME,          sweepRuns, sweepRecords, sweepLadder, packNodes,
                      unpackNodes,   pullRuns,  pullRecords,  blowRuns,    blowEnds,
                      accelerate,    addForce,  tileSides,    particleSides, land,
                      calm,          predict,   finish,       above,       integrate };
