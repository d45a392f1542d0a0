// The loops that take a step's time, written for vector registers: plain numbers and pointers, so
// that they can be compiled for several instruction sets side by side.
#pragma once

#include <cstddef>

namespace cloth
{
namespace kernels
{

/// So many springs make a block, whatever the width of a register. No two springs of a block share
/// a particle, so that no result depends on that width.
constexpr int LANES = 16;

/// What the springs of a block are, each array by lane. A lane without a spring has no stiffness
/// and no damping. Those that are no structural springs have an infinite limit.
struct alignas(64) Lanes
{
  float rest[LANES];       ///< rest length [m]
  float stiffness[LANES];  ///< [N/m]
  float damping[LANES];    ///< [N s/m]
  float limit[LANES];      ///< squared length above which the spring is noted [m^2]
};

/// A block whose springs join particles `a`, `a` + 1, ... to `b`, `b` + 1, ...: lane by lane.
struct RunEnds
{
  int a;
  int b;
};

/// A block whose springs join any particles: indices of their records. A lane without a spring has
/// that of a record that is no particle's twice.
struct RecordEnds
{
  int a[LANES];
  int b[LANES];
};

/// What springs that lie in no run read of a particle and write to it, in one piece.
struct alignas(16) Record
{
  float x;
  float y;
  float z;
  float w;
};

/// The particles as the sweep sees them. `way` is how far each has moved since the step began.
struct Particles
{
  float* way[3];              ///< x, y, z [m]
  const float* start[3];      ///< where the step began [m]
  const float* inverse_mass;  ///< [1/kg]
  float* held[3];             ///< sums up the pulls on those of inverse mass 0 [kg m]
};

/// A block of which some springs are longer than their limits; a bit for each lane.
struct Note
{
  int block;
  unsigned lanes;
};

struct Records
{
  Record* way;  ///< w: inverse mass
  const Record* start;
  const int* particle;  ///< of each record
};

/// Lines of springs, one in each lane: the spring of rung k joins what lies at `first` + k `step`
/// and `first` + (k + 1) `step`, plus the lane. Lanes without a spring part lines. All places are
/// of different particles.
struct Ladder
{
  int first;
  int step;
  int rungs;
  const Lanes* lanes;   ///< by rung
  const int* particle;  ///< what `held` has each place as, by node and lane; null: as the place
};

/// What is known of a rung's springs on the way up: the pull of each, over its length, is `pull` +
/// `share` that of the next.
struct alignas(64) Rung
{
  float pull[LANES];
  float share[LANES];
};

/// Which particles belong to the nodes of a ladder.
struct NodeList
{
  const int* particle;  ///< by node and lane; -1: none
  const char* in_rows;  ///< by four nodes: whether lanes, four at a time, have four that follow one
                        ///< another there
  int count;            ///< of nodes
  int lanes;            ///< the others have none
};

/// Copies of the particles of a node.
struct alignas(64) Node
{
  float way[3][LANES];
  float start[3][LANES];
  float inverse_mass[LANES];
};

/// The particles as forces see them.
struct Bodies
{
  const float* position[3];  ///< x, y, z [m]
  const float* velocity[3];  ///< [m/s]
  float* force[3];           ///< sums up [N]
};

struct BodyRecords
{
  const Record* position;
  const Record* velocity;
  Record* force;
};

/// Triangles of particles `a`, `b` and `c`, of `a` + 1, `b` + 1 and `c` + 1, ...: lane by lane.
struct TriangleRun
{
  int a;
  int b;
  int c;
};

/// Triangles of any particles.
struct TriangleEnds
{
  int a[LANES];
  int b[LANES];
  int c[LANES];
};

/// Rest areas of the triangles in the lanes [m^2]; 0: none there.
struct alignas(64) Areas
{
  float area[LANES];
};

/// The particles as the wind sees them.
struct Air
{
  const float* position[3];  ///< x, y, z [m]
  const float* velocity[3];  ///< [m/s]
  float* force[3];           ///< sums up [N]
  float wind[3];             ///< [m/s]
  float drag;                ///< pressure per normal speed [N s/m^3]
};

/// So many particles, neighbours in memory, make a tile.
constexpr int TILE = LANES;

/// A ball's way through a step.
struct Ball
{
  float low[3];    ///< of the box round all of it, its reach included [m]
  float high[3];   ///< [m]
  float start[3];  ///< its centre when the step begins [m]
  float end[3];    ///< and when it ends [m]
  float reach;     ///< [m]
};

/// The floor, and how it takes up what comes to lie on it.
struct Floor
{
  float height;    ///< [m]
  float friction;  ///< [-]
  float push;      ///< how far it lifts in this step what was below it [m]
  float dt;        ///< [s]
};

/// The loops for one instruction set.
struct Set
{
  const char* name;

  /// Solves blocks one after the other (Macklin et al. 2016, eq. 26, one sweep).
  /// @param notes has room for one of each block
  /// @return how many were written
  int (*sweep_runs)(const Particles& particles, const RunEnds* ends, const Lanes* lanes, int count,
                    float dt, Note* notes);
  int (*sweep_records)(const Records& records, float* const held[3], const RecordEnds* ends,
                       const Lanes* lanes, int count, float dt, Note* notes);

  /// Solves the lines of a ladder, each as a whole: all that its springs do to each other is in one
  /// tridiagonal system of the same equations (Thomas), up the rungs and down again.
  /// @param rungs, notes have room for one of each
  /// @return how many notes were written
  int (*sweep_ladder)(const Ladder& ladder, const Particles& particles, float dt, Rung* rungs,
                      Note* notes);

  /// Copies particles to nodes, and their ways back.
  void (*pack_nodes)(const Particles& particles, const NodeList& list, Node* nodes);
  void (*unpack_nodes)(const Particles& particles, const NodeList& list, const Node* nodes);

  /// Adds the forces of damped springs to their ends (thesis 2.1.1).
  /// @param notes as above, of lengths when the loop comes to them
  int (*pull_runs)(const Bodies& bodies, const RunEnds* ends, const Lanes* lanes, int count,
                   Note* notes);
  int (*pull_records)(const BodyRecords& records, const RecordEnds* ends, const Lanes* lanes,
                      int count, Note* notes);

  /// Adds what the wind does to triangles to their corners (Provot 1995).
  void (*blow_runs)(const Air& air, const TriangleRun* runs, const Areas* areas, int count);
  void (*blow_ends)(const Air& air, const TriangleEnds* ends, const Areas* areas, int count);

  /// acceleration = outer - friction * velocity for `count` numbers of one axis.
  void (*accelerate)(float* acceleration, const float* velocity, float outer, float friction,
                     int count);

  /// acceleration += force inverse_mass for `count` numbers of one axis.
  void (*add_force)(float* acceleration, const float* force, const float* inverse_mass, int count);

  /// Of each tile on which sides of the ball's box all its particles stay, from `start` to
  /// `position`: a bit for each of the six.
  void (*tile_sides)(const float* const start[3], const float* const position[3], const Ball& ball,
                     unsigned char* sides, int tiles);

  /// Of each particle of a tile the same in the lowest six bits. Above them, a bit for each of 26
  /// directions: it stays further that way from the ball's centre than its reach.
  void (*particle_sides)(const float* const start[3], const float* const position[3],
                         const Ball& ball, unsigned* sides);

  /// Puts particles below the floor onto it, but for those of inverse mass 0, and rubs.
  /// @param[out] change of the velocities of those that landed [m/s]
  /// @param[out] landed by tile: a bit for each of its particles that was put there
  void (*land)(float* const position[3], float* const velocity[3], const float* const start[3],
               const float* inverse_mass, const Floor& floor, float* const change[3],
               unsigned* landed, int tiles);

  /// Whether all particles have places that are numbers and squared speeds of at most `limit`.
  bool (*calm)(const float* const position[3], const float* const velocity[3], float limit,
               int count);

  /// way = dt (velocity + dt acceleration) for `count` numbers of one axis, where inverse mass is
  /// above 0; the others have moved from `start` to `position`.
  void (*predict)(float* way, const float* velocity, const float* acceleration,
                  const float* inverse_mass, const float* start, const float* position, float dt,
                  int count);
  /// position = start + way, velocity = way / dt where inverse mass is above 0.
  void (*finish)(const float* way, const float* start, const float* inverse_mass, float dt,
                 float* position, float* velocity, int count);
  /// Whether any of `count` values is above its limit.
  bool (*above)(const float* values, const float* limits, int count);

  /// One substep of symplectic Euler for `count` numbers of one axis: velocity += dt (acceleration
  /// + force w), position += dt velocity, where w is the inverse mass, but not above its limit.
  /// Adds the force to `held` where inverse mass is 0, and moves nothing there.
  void (*integrate)(float* position, float* velocity, const float* acceleration, const float* force,
                    const float* inverse_mass, const float* limit, float* held, float dt,
                    int count);
};

/// The fastest that this processor runs. The environment variable CLOTH_TEARING_SIMD may name a
/// plainer one.
const Set& best();

/// All that this processor runs, the plainest first.
std::size_t available(const Set* const*& sets);

/// What CLOTH_TEARING_SIMD names, if this processor has no such loops; else nullptr.
const char* ignoredWish();

}  // namespace kernels
}  // namespace cloth
