// Finds overstretched springs and tears them, worst first (3.2).
#pragma once

#include <functional>
#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/patch_strain.h"
#include "cloth_tearing/core/pieces.h"
#include "cloth_tearing/core/tear_event.h"
#include "cloth_tearing/core/tear_path.h"
#include "cloth_tearing/core/tear_rules.h"

namespace cloth
{

/// What tearing reads in one spring.
struct TearReading
{
  SpringId spring;
  TearKind kind = TearKind::BASIC;  ///< BASIC, WEAK_POINT or ONE_POINT: which threshold counts
  double strain = 0.0;              ///< the patch strain for BASIC, else its own [-]
  double threshold = 0.0;           ///< [-]

  double utilisation() const { return strain / threshold; }
};

/// Of the springs that carry load [-]; NaN if one has it.
double largestStrain(const Cloth& cloth);

/// Reads strains and edits the mesh. Knows nothing of solvers: both serve. Not for two threads at a
/// time, even to read.
class Tearing
{
public:
  /// Whether a particle must not be moved to this place, because something is there.
  using Blocked = std::function<bool(const Vec3&)>;

  explicit Tearing(const TearRules& rules) : rules_(rules) {}

  /// Collects the springs that are over a threshold, worst first.
  /// @return the largest strain of a spring that carries load [-]
  double scan(const Cloth& cloth);

  /// The same, if only `springs`, which carry load, can be over a threshold; the rest is not read.
  double scan(const Cloth& cloth, const std::vector<int>& springs);

  /// Whether scan() found any.
  bool found() const { return !found_.empty(); }

  /// Nothing in this cloth tears at a smaller strain [-].
  double leastThreshold(const Cloth& cloth) const;

  /// Tears what scan() found. Looks at each again first, since an earlier tear may have relieved
  /// it; what touches a particle of an earlier tear waits for the next step.
  ///
  /// Events lack sequence, epoch, step, time and cause, which the caller knows. Grasps follow: a
  /// held particle that is doubled stays held on the side of the gripper, on both if the tear runs
  /// through its patch.
  ///
  /// @param[out] postponed springs that wait
  std::vector<TearEvent> tear(Cloth& cloth, std::vector<Grasp>& grasps, const Blocked& blocked,
                              int& postponed);

  /// The reading of the spring that is nearest to tearing; spring none if nothing is stretched.
  TearReading worst(const Cloth& cloth) const;

  /// The same among `springs`.
  TearReading worst(const Cloth& cloth, const std::vector<SpringId>& springs) const;

private:
  /// A weak or one-point end at which a spring may tear, in order of preference.
  struct Option
  {
    TearKind kind;
    ParticleId at;
    double threshold;
    double resistance;
  };

  double leastRule() const;
  double strength(const Cloth& cloth, SpringId s) const;
  double crackBand(const Cloth& cloth, SpringId s) const;
  std::vector<Option> options(const Cloth& cloth, SpringId s) const;
  TearReading unread(const Cloth& cloth, SpringId s) const;
  TearReading read(const Cloth& cloth, SpringId s, double own) const;
  void look(const Cloth& cloth, SpringId s, double& most);
  void beginScan();
  void concludeScan(const Cloth& cloth);

  bool touched(const Cloth& cloth, SpringId s) const;
  bool tearSpring(Cloth& cloth, std::vector<Grasp>& grasps, const TearReading& reading,
                  const Blocked& blocked, TearEvent& event);
  bool tearSound(Cloth& cloth, std::vector<Grasp>& grasps, SpringId s, double patch,
                 TearEvent& event);
  void tearAcross(Cloth& cloth, SpringId s, TearEvent& event);
  void tearAlong(Cloth& cloth, std::vector<Grasp>& grasps, ParticleId p, const TearPath& path,
                 TearEvent& event);
  void tearOnePoint(Cloth& cloth, std::vector<Grasp>& grasps, SpringId s, ParticleId p,
                    const Blocked& blocked, TearEvent& event);
  void release(Cloth& cloth, SpringId s, TearEvent& event);

  bool canSplit(const Cloth& cloth, SpringId s) const;
  void relieve(Cloth& cloth, SpringId s, ParticleId copy, const Blocked& blocked) const;
  void conclude(Cloth& cloth, const Edit& edit, TearEvent& event);

  TearRules rules_;
  mutable PatchStrain patch_;  ///< reading needs scratch
  Pieces pieces_;
  std::vector<TearReading> found_;
  std::uint64_t read_at_ = 0;      ///< tears of the cloth when found_ was read
  std::vector<unsigned> touched_;  ///< by particle: the number of the pass that touched it last
  unsigned pass_ = 0;
};

}  // namespace cloth
