// Users of a running node, each with a mind of its own: what they do next is drawn at random.
#pragma once

#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "world.h"

namespace soak
{

/// Random numbers whose order depends on nothing but the seed.
class Dice
{
public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  double between(double least, double most)
  {
    return std::uniform_real_distribution<double>(least, most)(engine_);
  }
  int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
  bool oneIn(int count) { return below(count) == 0; }

  template <class T>
  const T& oneOf(const std::vector<T>& values)
  {
    return values[static_cast<std::size_t>(below(static_cast<int>(values.size())))];
  }

private:
  std::mt19937_64 engine_;
};

/// Acts on a thread of its own until the world ends, then leaves.
class User
{
public:
  User(World& world, std::uint64_t seed) : world_(world), dice_(seed) {}
  virtual ~User() = default;

  /// Acts again and again, with pauses, until the end.
  void run();

protected:
  virtual void act() = 0;
  /// Undoes what others would mind.
  virtual void leave() {}

  geometry_msgs::Point somewhere();   ///< around the cloth
  geometry_msgs::Point onTheCloth();  ///< at some particle
  double badNumber();                 ///< neither finite nor in any range

  World& world_;
  Dice dice_;
  double longest_pause_ = 0.05;  ///< between two acts [s]
};

/// One of each kind and some more, all started by the constructor. The destructor waits for their
/// end, which is soon after the world's.
class Crowd
{
public:
  /// @param states folder of saved states of the node, which are looked at there
  Crowd(World& world, std::uint64_t seed, const std::string& states);
  ~Crowd();

private:
  std::vector<std::unique_ptr<User>> users_;
  std::vector<std::thread> threads_;
};

// The kinds, one a file: keeper.cpp, users.cpp, listeners.cpp.
std::unique_ptr<User> makeGripper(World& world, std::uint64_t seed);
std::unique_ptr<User> makePuller(World& world, std::uint64_t seed);
std::unique_ptr<User> makeBallStreamer(World& world, std::uint64_t seed);
std::unique_ptr<User> makeThrower(World& world, std::uint64_t seed);
std::unique_ptr<User> makePinner(World& world, std::uint64_t seed);
std::unique_ptr<User> makeTuner(World& world, std::uint64_t seed);
std::unique_ptr<User> makeFrameMover(World& world, std::uint64_t seed);
std::unique_ptr<User> makeListener(World& world, std::uint64_t seed);
std::unique_ptr<User> makeKeeper(World& world, std::uint64_t seed, const std::string& states);

}  // namespace soak
