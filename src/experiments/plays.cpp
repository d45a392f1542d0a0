// Names the experiments and their moments.
#include "cloth_tearing/experiments/plays.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "cloth_tearing/experiments/ball_experiment.h"
#include "cloth_tearing/experiments/direction_experiment.h"
#include "cloth_tearing/experiments/profile_experiment.h"
#include "cloth_tearing/experiments/texture_experiment.h"
#include "cloth_tearing/experiments/trouser_experiment.h"

namespace cloth
{
namespace
{

/// When each ball is in the cloth, and when what it did can be seen [s].
constexpr std::array<std::array<double, 2>, 5> BALL_MOMENTS = {
  { { 1.60, 3.20 }, { 1.40, 3.60 }, { 1.60, 2.20 }, { 1.50, 3.90 }, { 0.45, 0.75 } }
};

void addBalls(std::vector<Play>& plays)
{
  for (std::size_t i = 0; i < THESIS_THROWS.size(); ++i)
  {
    const BallThrow& thrown = THESIS_THROWS[i];
    Play play;
    play.name = "balls_" + std::to_string(i + 1);
    play.title = std::string("ball ") + thrown.name;
    play.moments = { { "before", 1.0 / thrown.speed },
                     { "during", BALL_MOMENTS[i][0] },
                     { "after", BALL_MOMENTS[i][1] } };
    play.run = [&thrown](const Setting& setting, const Watch& watch)
    {
      Simulation simulation = hungCloth(setting);
      throwBall(simulation, thrown, watch);
    };
    plays.push_back(play);
  }
}

void addThreeBalls(std::vector<Play>& plays)
{
  Play play;
  play.name = "balls_three";
  play.title = "three small balls, figure 4.1";
  play.moments = { { "before", 1.6 }, { "during", 4.1 }, { "after", 8.0 } };
  play.run = [](const Setting& setting, const Watch& watch)
  {
    Simulation simulation = hungCloth(setting);
    throwBalls(simulation, { THREE_BALLS.begin(), THREE_BALLS.end() }, THREE_BALLS_INTERVAL, watch);
  };
  plays.push_back(play);
}

void addTexture(std::vector<Play>& plays)
{
  Play play;
  play.name = "texture";
  play.title = "texture: torn, and put back";
  play.moments = { { "before", 0.05 }, { "torn", 2.75 }, { "put_back", 5.0 } };
  play.run = [](const Setting& setting, const Watch& watch)
  {
    const Simulation hung = hungCloth(setting);
    Simulation simulation = hung;
    tearBadly(simulation, watch);
    putBackSlowly(simulation, hung.cloth(), watch);
  };
  plays.push_back(play);
}

void addProfile(std::vector<Play>& plays)
{
  Play play;
  play.name = "profile";
  play.title = "profile: torn here and there for 34 s";
  play.moments = { { "after_2", 2.0 },
                   { "after_10", 10.0 },
                   { "after_18", 18.0 },
                   { "after_26", 26.0 },
                   { "after_34", 33.9 } };
  play.run = [](const Setting& setting, const Watch& watch)
  {
    Simulation simulation = profileCloth(setting);
    profile(simulation, watch);
  };
  plays.push_back(play);
}

void addDirections(std::vector<Play>& plays)
{
  for (int i = 0; i < 8; ++i)
  {
    const std::string angle = std::to_string(45 * i);
    const DirectionPull pull = framedPull(45.0 * i, Vec2d::Zero());
    Play play;
    play.name = "direction_" + angle;
    play.title = "a disc of framed cloth pulled at " + angle + " degrees";
    play.moments = { { "before", 0.15 }, { "during", 0.6 }, { "after", 2.0 } };
    play.run = [pull](const Setting& setting, const Watch& watch)
    {
      Simulation simulation = framedCloth(setting);
      pullDisc(simulation, pull, watch);
    };
    plays.push_back(play);
  }
  Play play;
  play.name = "direction_down";
  play.title = "a disc of hanging cloth pulled down";
  play.moments = { { "before", 0.2 }, { "during", 0.6 }, { "after", 1.9 } };
  play.run = [](const Setting& setting, const Watch& watch)
  {
    Simulation simulation = hungCloth(setting);
    pullDisc(simulation, downwardPull(Vec2d::Zero()), watch);
  };
  plays.push_back(play);
}

void addTrouser(std::vector<Play>& plays)
{
  Play play;
  play.name = "trouser";
  play.title = "the legs of a cut sheet pulled apart";
  play.moments = { { "before", 3.0 }, { "during", 9.0 }, { "after", 12.5 } };
  play.camera.yaw = -0.8;  // from the side: the legs leave the sheet to its front and back
  play.camera.distance = 20.0;
  play.run = [](const Setting& setting, const Watch& watch)
  {
    Simulation simulation = trousers(setting);
    pullLegs(simulation, Vec2d::Zero(), watch);
  };
  plays.push_back(play);
}

std::vector<Play> makePlays()
{
  std::vector<Play> plays;
  addBalls(plays);
  addThreeBalls(plays);
  addDirections(plays);
  addTrouser(plays);
  addTexture(plays);
  addProfile(plays);
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
