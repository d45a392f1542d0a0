// Carries grasps and spheres along with the tf frames that they follow.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/node/frames.h"
#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// A sphere that is fixed to a frame.
struct FramedSphere
{
  std::uint64_t id = 0;
  std::string frame;
  cloth::Vec3d center = cloth::Vec3d::Zero();  ///< in the frame [m]
};

/// Looks at each frame before every step. What follows it gets to where its newest transform says
/// in the time that lies between the stamps of that and the one before, so that it moves as fast as
/// the robot does, not in jerks.
class FrameFollower
{
public:
  FrameFollower(const Frames& frames, const NodeParams& params);

  /// For the loop's thread, before each step.
  void beforeStep(cloth::Simulation& simulation);

  /// The spheres that follow frames from now on; those that did and are not among them are
  /// forgotten. For the loop's thread.
  void setSpheres(const std::vector<FramedSphere>& spheres);

private:
  /// The newest transform of a frame.
  struct Way
  {
    Frames::Latest latest;
    double interval = 0.0;     ///< between its stamp and that of the one before [s]
    bool fresh = false;        ///< it came since the last step
    std::uint64_t looked = 0;  ///< number of the last look at it
  };

  const Way& look(const std::string& frame);
  std::string lossOf(const Way& way) const;
  void moveGrasp(cloth::Simulation& simulation, std::uint64_t id, const std::string& frame,
                 bool was_lost);
  void moveSphere(cloth::Simulation& simulation, const FramedSphere& sphere);

  const Frames& frames_;
  double timeout_;
  LostFrame lost_frame_;
  std::vector<FramedSphere> spheres_;
  std::map<std::string, Way> ways_;
  std::uint64_t look_ = 0;  ///< number of the step
};

}  // namespace cloth_tearing
