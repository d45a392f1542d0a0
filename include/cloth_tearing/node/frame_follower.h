// Carries grasps and spheres along with the tf frames that they follow.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/node/frames.h"
#include "cloth_tearing/node/node_params.h"

namespace cloth_tearing
{

/// Looks at each frame before every step. What follows it gets to where its newest transform says
/// in the time that lies between the stamps of that and the one before, so that it moves as fast as
/// the robot does, not in jerks.
class FrameFollower
{
public:
  FrameFollower(const Frames& frames, const NodeParams& params);

  /// For the loop's thread, before each step.
  void beforeStep(cloth::Simulation& simulation);

  /// Why a frame cannot be followed now; empty if it can. For any thread.
  std::string lossOf(const Frames::Latest& latest) const;

private:
  /// The newest transform of a frame.
  struct Sighting
  {
    Frames::Latest latest;
    double interval = 0.0;     ///< between its stamp and that of the one before [s]
    bool fresh = false;        ///< it came since the last step
    std::uint64_t looked = 0;  ///< number of the last look at it
  };

  const Sighting& look(const std::string& frame);
  void moveGrasp(cloth::Simulation& simulation, std::uint64_t id, const std::string& frame,
                 bool was_lost);
  void moveSphere(cloth::Simulation& simulation, const cloth::Sphere& sphere);

  const Frames& frames_;
  double timeout_;
  LostFrame lost_frame_;
  std::map<std::string, Sighting> sightings_;
  std::uint64_t look_ = 0;   ///< number of the step
  std::uint32_t epoch_ = 0;  ///< of the last look
};

}  // namespace cloth_tearing
