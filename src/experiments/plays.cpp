// Names the experiments and their moments.
#include "cloth_tearing/experiments/plays.h"

#include <algorithm>
#include <stdexcept>

#include "cloth_tearing/experiments/ball_experiment.h"

namespace cloth
{
namespace
{

void addBalls(std::vector<Play>& plays)
{
  for (std::size_t i = 0; i < THESIS_THROWS.size(); ++i)
  {
    const BallThrow& thrown = THESIS_THROWS[i];
    const double arrival = 3.5 / thrown.speed;
    Play play;
    play.name = "balls_" + std::to_string(i + 1);
    play.title = std::string("ball ") + thrown.name;
    play.moments = { { "before", 0.3 * arrival },
                     { "during", 1.2 * arrival },
                     { "after", 2.0 * arrival + 0.5 } };
    play.run = [&thrown](const Setting& setting, const Watch& watch)
    {
      Simulation simulation = hungCloth(setting);
      throwBall(simulation, thrown, watch);
    };
    plays.push_back(play);
  }
}

std::vector<Play> makePlays()
{
  std::vector<Play> plays;
  addBalls(plays);
  return plays;
}

}  // namespace

const std::vector<Play>& plays()
{
  static const std::vector<Play> PLAYS = makePlays();
  return PLAYS;
}

const Play& findPlay(const std::string& name)
{
  const auto found = std::find_if(plays().begin(), plays().end(),
                                  [&](const Play& play) { return play.name == name; });
  if (found == plays().end())
  {
    std::string known;
    for (const Play& play : plays())
    {
      known += (known.empty() ? "" : ", ") + play.name;
    }
    throw std::invalid_argument("there is no experiment \"" + name + "\"; there are " + known);
  }
  return *found;
}

}  // namespace cloth
