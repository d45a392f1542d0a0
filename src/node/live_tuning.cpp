// Serves each group of parameters to clients of dynamic_reconfigure.
#include "cloth_tearing/node/live_tuning.h"

#include <cloth_tearing/BoundsMaxConfig.h>
#include <cloth_tearing/BoundsMinConfig.h>
#include <cloth_tearing/ContactConfig.h>
#include <cloth_tearing/EnvironmentConfig.h>
#include <cloth_tearing/GravityConfig.h>
#include <cloth_tearing/MaterialConfig.h>
#include <cloth_tearing/SolverConfig.h>
#include <cloth_tearing/TearingConfig.h>
#include <cloth_tearing/WindConfig.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/console.h>
#include <ros/publisher.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cloth_tearing/core/refusal.h"
#include "cloth_tearing/node/node_params.h"
#include "cloth_tearing/node/params_loader.h"

namespace cloth_tearing
{

namespace
{

// Where clients of dynamic_reconfigure look.
const std::string DESCRIPTIONS = "parameter_descriptions";
const std::string UPDATES = "parameter_updates";

// -- which shown value is which value of the core: `copy(shown, value)` goes either way -----------

template <class Copy>
void match(MaterialConfig& shown, cloth::Tuning& tuning, const Copy& copy)
{
  cloth::Material& material = tuning.material;
  copy(shown.areal_density, material.areal_density);
  copy(shown.stiffness_law, material.stiffness_law);
  copy(shown.stiffness, material.stiffness);
  copy(shown.bend_shear_stiffness, material.bend_shear_stiffness);
  copy(shown.damping, material.damping);
}

template <class Copy>
void match(EnvironmentConfig& shown, cloth::Tuning& tuning, const Copy& copy)
{
  copy(shown.air_friction, tuning.environment.air_friction);
  copy(shown.wind_drag, tuning.environment.wind_drag);
}

template <class Config, class Copy>
void matchAxes(Config& shown, cloth::Vec3d& vector, const Copy& copy)
{
  copy(shown.x, vector.x());
  copy(shown.y, vector.y());
  copy(shown.z, vector.z());
}

template <class Copy>
void match(GravityConfig& shown, cloth::Tuning& tuning, const Copy& copy)
{
  matchAxes(shown, tuning.environment.gravity, copy);
}

template <class Copy>
void match(WindConfig& shown, cloth::Tuning& tuning, const Copy& copy)
{
  matchAxes(shown, tuning.environment.wind, copy);
}

template <class Copy>
void match(TearingConfig& shown, cloth::Tuning& tuning, const Copy& copy)
{
  cloth::TearRules& rules = tuning.tearing;
  copy(shown.enabled, rules.enabled);
  copy(shown.tear_strain, rules.tear_strain);
  copy(shown.weak_tear_strain, rules.weak_tear_strain);
  copy(shown.one_point_tear_strain, rules.one_point_tear_strain);
  copy(shown.tear_radius, rules.tear_radius);
  copy(shown.crack_length, rules.crack_length);
  copy(shown.hem_factor, rules.hem_factor);
  copy(shown.hem_width, rules.hem_width);
  copy(shown.max_tears_per_step, rules.max_tears_per_step);
  copy(shown.min_length, rules.min_length);
  copy(shown.min_altitude, rules.min_altitude);
}

template <class Copy>
void match(ContactConfig& shown, cloth::Tuning& tuning, const Copy& copy)
{
  cloth::ContactParams& contact = tuning.contact;
  copy(shown.friction, contact.friction);
  copy(shown.thickness, contact.thickness);
  copy(shown.push_speed, contact.push_speed);
  copy(shown.floor, contact.floor);
  copy.height(contact.floor, shown.floor_height, contact.floor_height);
  copy(shown.floor_friction, contact.floor_friction);
  copy(shown.max_sphere_speed, contact.max_sphere_speed);
  copy(shown.sphere_timeout, contact.sphere_timeout);
}

template <class Copy>
void match(BoundsMinConfig& shown, cloth::Tuning& tuning, const Copy& copy)
{
  matchAxes(shown, tuning.contact.bounds_min, copy);
}

template <class Copy>
void match(BoundsMaxConfig& shown, cloth::Tuning& tuning, const Copy& copy)
{
  matchAxes(shown, tuning.contact.bounds_max, copy);
}

template <class Copy>
void match(SolverConfig& shown, cloth::LoopTuning& tuning, const Copy& copy)
{
  copy(shown.speed, tuning.speed);
  copy(shown.max_strain, tuning.max_strain);
  copy(shown.max_substeps, tuning.max_substeps);
}

/// From what is shown into the core.
struct ToCore
{
  double origin;  ///< height of the cloth frame's origin in frame_id [m]

  template <class Value>
  void operator()(const Value& shown, Value& value) const
  {
    value = shown;
  }
  /// @throws Refusal of an unknown name
  void operator()(const std::string& shown, cloth::StiffnessLaw& law) const
  {
    const auto found = stiffnessLaws().find(shown);
    if (found == stiffnessLaws().end())
    {
      std::string names;
      for (const auto& known : stiffnessLaws())
      {
        names += (names.empty() ? "" : ", ") + known.first;
      }
      throw cloth::Refusal("stiffness_law is \"" + shown + "\", must be one of " + names);
    }
    law = found->second;
  }
  void height(bool floor, double shown, double& value) const
  {
    value = floorInClothFrame(floor, shown, origin);
  }
};

/// From the core into what is shown.
struct ToShown
{
  double origin;  ///< height of the cloth frame's origin in frame_id [m]

  template <class Value>
  void operator()(Value& shown, const Value& value) const
  {
    shown = value;
  }
  void operator()(std::string& shown, cloth::StiffnessLaw law) const
  {
    for (const auto& known : stiffnessLaws())
    {
      shown = known.second == law ? known.first : shown;
    }
  }
  void height(bool floor, double& shown, double value) const
  {
    if (floorInClothFrame(floor, shown, origin) != value)  // else it stays as it was given
    {
      shown = floorInClothFrame(floor, value, -origin);
    }
  }
};

template <class Values>
void noteStrangers(std::vector<std::string>& found, const Values& wanted, const Values& known)
{
  for (const auto& value : wanted)
  {
    const auto same = [&value](const auto& other) { return other.name == value.name; };
    if (std::none_of(known.begin(), known.end(), same))
    {
      found.push_back("there is no parameter \"" + value.name.substr(0, 100) + "\" of this type");
    }
  }
}

/// What is wrong with the names of what is wanted.
std::vector<std::string> strangersOf(const dynamic_reconfigure::Config& wanted,
                                     const dynamic_reconfigure::Config& known)
{
  std::vector<std::string> found;
  noteStrangers(found, wanted.bools, known.bools);
  noteStrangers(found, wanted.ints, known.ints);
  noteStrangers(found, wanted.strs, known.strs);
  noteStrangers(found, wanted.doubles, known.doubles);
  return found;
}

}  // namespace

class LiveTuning::Group
{
public:
  virtual ~Group() = default;
  virtual void show(cloth::LoopTuning& tuning) = 0;
};

template <class Config>
class LiveTuning::GroupOf : public LiveTuning::Group
{
public:
  /// @param name of the group; empty for none
  GroupOf(LiveTuning& host, const std::string& name, cloth::LoopTuning tuning)
      : context_(host.context_)
      , mutex_(host.mutex_)
      , node_(context_.node, name)
      , request_(name.empty() ? "set_parameters" : name + "/set_parameters")
      , descriptions_(
            node_.advertise<dynamic_reconfigure::ConfigDescription>(DESCRIPTIONS, 1, true))
      , updates_(node_.advertise<dynamic_reconfigure::Config>(UPDATES, 1, true))
  {
    match(in_force_, tuning, ToShown{ 0.0 });
    descriptions_.publish(Config::__getDescriptionMessage__());
    tell();
    context_.requests.answer<dynamic_reconfigure::Reconfigure>(
        context_.node, request_, [this](auto& q, auto& a) { set(q.config, a.config); });
  }

  void show(cloth::LoopTuning& tuning) override
  {
    match(in_force_, tuning, ToShown{ context_.placement.origin.z() });
    tell();
  }

private:
  /// @param wanted some or all values
  void set(dynamic_reconfigure::Config& wanted, dynamic_reconfigure::Config& in_force)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Config config = in_force_;
    in_force_.__toMessage__(in_force);
    config.__fromMessage__(wanted);
    const std::vector<std::string> strangers = strangersOf(wanted, in_force);
    if (in_force_.__level__(config) != 0 || !strangers.empty())  // else nothing changes
    {
      change(config, strangers);
    }
    tell();
    in_force_.__toMessage__(in_force);
  }

  void change(Config& wanted, const std::vector<std::string>& problems)
  {
    const auto work = [&]
    {
      cloth::refuseIf(problems);
      tune(wanted);
    };
    if (!context_.requests.hear(request_, work).empty())
    {
      return;
    }
    in_force_ = wanted;
    context_.publisher.touch();
  }

  void tune(Config& wanted)
  {
    const double origin = context_.placement.origin.z();
    const std::vector<std::string> notes = context_.loop.tune(
        [&](cloth::LoopTuning& tuning) { match(wanted, tuning, ToCore{ origin }); });
    for (const std::string& note : notes)
    {
      ROS_WARN_STREAM(note);
    }
  }

  /// To those who listen, and to the parameter server.
  void tell() const
  {
    in_force_.__toServer__(node_);
    dynamic_reconfigure::Config message;
    in_force_.__toMessage__(message);
    updates_.publish(message);
  }

  NodeContext context_;
  std::mutex& mutex_;
  ros::NodeHandle node_;
  std::string request_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  Config in_force_ = Config::__getDefault__();  ///< guarded by mutex_
};

LiveTuning::LiveTuning(const NodeContext& context, const cloth::LoopTuning& start)
    : context_(context)
{
  open<MaterialConfig>("material", start);
  open<EnvironmentConfig>("environment", start);
  open<GravityConfig>("environment/gravity", start);
  open<WindConfig>("environment/wind", start);
  open<TearingConfig>("tearing", start);
  open<ContactConfig>("contact", start);
  open<BoundsMinConfig>("contact/bounds_min", start);
  open<BoundsMaxConfig>("contact/bounds_max", start);
  open<SolverConfig>("", start);
}

LiveTuning::~LiveTuning() = default;

template <class Config>
void LiveTuning::open(const std::string& name, const cloth::LoopTuning& start)
{
  groups_.push_back(std::make_unique<GroupOf<Config>>(*this, name, start));
}

void LiveTuning::show()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  try
  {
    cloth::LoopTuning tuning = context_.loop.tuning();
    for (const auto& group : groups_)
    {
      group->show(tuning);
    }
  }
  catch (const cloth::Busy& busy)
  {
    ROS_WARN_STREAM("dynamic_reconfigure shows values that may be old: " << busy.what());
  }
}

}  // namespace cloth_tearing
