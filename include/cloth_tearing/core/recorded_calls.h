// What changes a simulation from outside, as numbers and bytes, and back.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>

#include "cloth_tearing/core/archive.h"
#include "cloth_tearing/core/recorder.h"
#include "cloth_tearing/core/simulation.h"
#include "cloth_tearing/core/transfer.h"

namespace cloth
{

template <class Archive>
void transfer(Archive& archive, GraspRequest& request)
{
  auto& [point, radius, frame, force_limit, followed] = request;
  archive("point", point);
  archive("radius", radius);
  archive("frame", frame);
  archive("force_limit", force_limit);
  archive("followed", followed);
}

template <class Archive>
void transfer(Archive& archive, PullRequest& request)
{
  auto& [grasp, target, stop_force, stop_tears, release] = request;
  archive("grasp", grasp);
  archive("target", target);
  archive("stop_force", stop_force);
  archive("stop_tears", stop_tears);
  archive("release", release);
}

template <class Archive>
void transfer(Archive& archive, PinRequest& request)
{
  auto& [point, radius, particles] = request;
  archive("point", point);
  archive("radius", radius);
  archive("particles", particles);
}

template <class Archive>
void transfer(Archive& archive, ThrowRequest& request)
{
  auto& [center, velocity, radius, mass, lifetime] = request;
  archive("center", center);
  archive("velocity", velocity);
  archive("radius", radius);
  archive("mass", mass);
  archive("lifetime", lifetime);
}

template <class Archive>
void transfer(Archive& archive, Tuning& tuning)
{
  auto& [material, environment, tearing, contact, max_strain, max_substeps] = tuning;
  archive("material", material);
  archive("environment", environment);
  archive("tearing", tearing);
  archive("contact", contact);
  archive("max_strain", max_strain);
  archive("max_substeps", max_substeps);
}

constexpr AfterGrasp lastOf(AfterGrasp /*any*/)
{
  return AfterGrasp::PINNED;
}

constexpr SphereSource lastOf(SphereSource /*any*/)
{
  return SphereSource::THROWN;
}

/// All members of a simulation that change it, but step().
struct Simulation::Calls
{
  static constexpr std::uint8_t NO_CALL = 255;

  template <auto... METHODS>
  struct List
  {
  };

  /// Recordings hold their places in this list: another one is another RECORDING_FORMAT.
  using All = List<&Simulation::reset, &Simulation::restore, &Simulation::grasp, &Simulation::drag,
                   &Simulation::steer, &Simulation::follow, &Simulation::frameLost,
                   &Simulation::frameFound, &Simulation::stopFollowing, &Simulation::pull,
                   &Simulation::cancelPull, &Simulation::release, &Simulation::releaseAll,
                   &Simulation::pin, &Simulation::unpin, &Simulation::setSpheres,
                   &Simulation::moveSphere, &Simulation::throwSphere, &Simulation::holdSphere,
                   &Simulation::letGoOfSphere, &Simulation::throwAtCloth, &Simulation::removeSphere,
                   &Simulation::tune, &Simulation::takeSaved, &Simulation::place>;

  template <class Answer, class... Arguments>
  static std::tuple<std::decay_t<Arguments>...> argumentsOf(Answer (Simulation::*)(Arguments...));

  /// Those of a member, by value.
  template <auto METHOD>
  using ArgumentsOf = decltype(argumentsOf(METHOD));

  template <auto METHOD>
  struct Same
  {
  };

  template <auto... METHODS>
  static constexpr int count(List<METHODS...> /*list*/)
  {
    return sizeof...(METHODS);
  }

  template <auto METHOD, auto... METHODS>
  static constexpr std::uint8_t numberIn(List<METHODS...> /*list*/)
  {
    std::uint8_t number = 0;
    const bool found =
        ((std::is_same<Same<METHOD>, Same<METHODS>>::value || (++number, false)) || ...);
    return found ? number : NO_CALL;
  }

  /// Its place in the list.
  template <auto METHOD>
  static constexpr std::uint8_t numberOf()
  {
    return numberIn<METHOD>(All());
  }

  template <class Archive, class Argument>
  static void transferOne(Archive& archive, Argument& argument)
  {
    if constexpr (std::is_enum<Argument>::value)
    {
      archive.choice("argument", argument, lastOf(argument));
    }
    else
    {
      archive("argument", argument);
    }
  }

  /// The number of a member and its arguments.
  template <auto METHOD>
  static std::string bytesOf(ArgumentsOf<METHOD> arguments)
  {
    ArchiveWriter writer;
    writer("call", numberOf<METHOD>());
    std::apply([&](auto&... each) { (transferOne(writer, each), ...); }, arguments);
    return writer.take();
  }

  template <auto METHOD>
  static void repeatOne(ArchiveReader& reader, Simulation& simulation)
  {
    ArgumentsOf<METHOD> arguments;
    std::apply([&](auto&... each) { (transferOne(reader, each), ...); }, arguments);
    reader.expectEnd();
    std::apply([&](auto&... each) { (simulation.*METHOD)(each...); }, arguments);
  }

  template <auto... METHODS>
  static bool repeatIn(List<METHODS...> /*list*/, std::uint8_t number, ArchiveReader& reader,
                       Simulation& simulation)
  {
    return ((numberOf<METHODS>() == number && (repeatOne<METHODS>(reader, simulation), true)) ||
            ...);
  }

  /// Does again what bytesOf() has written.
  /// @throws Refusal if `bytes` are no call, or it is refused now
  static void repeat(const std::string& bytes, Simulation& simulation);
};

/// Has it recorded that METHOD was called, and did what it does.
template <auto METHOD, class... Arguments>
void Simulation::note(const Arguments&... arguments)
{
  static_assert(Calls::numberOf<METHOD>() != Calls::NO_CALL, "it is not in the list");
  if (recorder_.get() != nullptr)
  {
    recorder_.get()->called(Calls::bytesOf<METHOD>({ arguments... }));
  }
}

}  // namespace cloth
