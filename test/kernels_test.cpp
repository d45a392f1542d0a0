// Claims of the loops: each instruction set gives the same bits, and a wish is told that is
// ignored.
#include "cloth_tearing/core/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace cloth
{
namespace kernels
{
namespace
{

constexpr int BLOCKS = 6;
constexpr int PARTICLES = 2 * LANES * (BLOCKS + 1);
constexpr int TILES = PARTICLES / TILE;

/// Numbers of particles and springs without any meaning, some held, some springs overlong.
struct World
{
  World()
  {
    for (auto* axes : { &position, &velocity, &start, &way, &force, &held, &change })
    {
      for (std::vector<float>& axis : *axes)
      {
        axis = some(PARTICLES, -1.0F, 1.0F);
      }
    }
    for (int i = 0; i < TILE; ++i)
    {
      start[1][i] = position[1][i] = 5.0F;  // a tile that is far from all others
    }
    inverse_mass = some(PARTICLES, 0.5F, 2.0F);
    limit = some(PARTICLES, 0.5F, 2.0F);
    for (int i = 0; i < PARTICLES; i += 5)
    {
      inverse_mass[i] = 0.0F;
    }
    for (int block = 0; block < BLOCKS; ++block)
    {
      const int first = 2 * LANES * block;
      run_ends.push_back({ first, first + LANES + 3 });
      triangle_runs.push_back({ first, first + 7, first + LANES + 1 });
      addBlock(first);
    }
    for (int i = 0; i < PARTICLES; ++i)
    {
      particle.push_back(i - 1);
      way_records.push_back({ way[0][i], way[1][i], way[2][i], i > 0 ? inverse_mass[i - 1] : 0 });
      start_records.push_back({ start[0][i], start[1][i], start[2][i], 0 });
      force_records.push_back({ force[0][i], force[1][i], force[2][i], 0 });
    }
    notes.resize(BLOCKS, Note{ -1, 0 });
    sides.resize(TILES);
    particle_sides.resize(TILE);
    landed.resize(TILES);
  }

  std::vector<float> some(int count, float least, float most)
  {
    std::vector<float> values(count);
    for (float& value : values)
    {
      value = least + (most - least) * static_cast<float>(random_() % 65536) / 65536.0F;
    }
    return values;
  }

  /// All that a loop may have written, as it lies in memory.
  std::string bytes() const
  {
    std::string all;
    const auto add = [&](const auto& values)
    {
      all.append(reinterpret_cast<const char*>(values.data()),
                 values.size() * sizeof(values.front()));
    };
    for (const auto* axes : { &position, &velocity, &start, &way, &force, &held, &change })
    {
      for (const std::vector<float>& axis : *axes)
      {
        add(axis);
      }
    }
    for (const auto* records : { &way_records, &start_records, &force_records })
    {
      add(*records);
    }
    add(notes);
    add(sides);
    add(particle_sides);
    add(landed);
    return all + std::to_string(result);
  }

  Particles particles()
  {
    return { { way[0].data(), way[1].data(), way[2].data() },
             { start[0].data(), start[1].data(), start[2].data() },
             inverse_mass.data(),
             { held[0].data(), held[1].data(), held[2].data() } };
  }

  Air air()
  {
    return { { position[0].data(), position[1].data(), position[2].data() },
             { velocity[0].data(), velocity[1].data(), velocity[2].data() },
             { force[0].data(), force[1].data(), force[2].data() },
             { 0.5F, -2.0F, 0.25F },
             0.75F };
  }

  std::vector<float> position[3], velocity[3], start[3], way[3], force[3], held[3], change[3];
  std::vector<float> inverse_mass, limit;
  std::vector<RunEnds> run_ends;
  std::vector<RecordEnds> record_ends;
  std::vector<TriangleRun> triangle_runs;
  std::vector<TriangleEnds> triangle_ends;
  std::vector<Lanes> lanes;
  std::vector<Areas> areas;
  std::vector<int> particle;
  std::vector<Record> way_records, start_records, force_records;
  std::vector<Note> notes;
  std::vector<unsigned char> sides;
  std::vector<unsigned> particle_sides;
  std::vector<unsigned> landed;
  int result = 0;

private:
  void addBlock(int first)
  {
    RecordEnds ends;
    TriangleEnds corners;
    Lanes block;
    Areas area;
    for (int lane = 0; lane < LANES; ++lane)
    {
      // No two lanes share one.
      const int shuffled = 1 + first + (7 * lane) % LANES;  // 0 is nobody
      ends.a[lane] = shuffled;
      ends.b[lane] = shuffled + LANES;
      corners.a[lane] = shuffled;
      corners.b[lane] = shuffled + LANES;
      corners.c[lane] = 1 + first + 2 * LANES + lane;
      const bool empty = lane == 5;
      block.rest[lane] = 0.5F + 0.05F * static_cast<float>(lane);
      block.stiffness[lane] = empty ? 0.0F : 30.0F;
      block.damping[lane] = empty ? 0.0F : 0.25F;
      block.limit[lane] = 2.0F;
      area.area[lane] = empty ? 0.0F : 0.25F;
    }
    record_ends.push_back(ends);
    triangle_ends.push_back(corners);
    lanes.push_back(block);
    areas.push_back(area);
  }

  std::mt19937_64 random_{ 20131 };
};

using Axes3 = float* [3];

const Ball BALL = {
  { -0.4F, -0.3F, -0.5F }, { 0.5F, 0.4F, 0.3F }, { 0.0F, 0.0F, 0.0F }, { 0.1F, 0.1F, 0.1F }, 0.3F
};

struct Loop
{
  std::string name;
  std::function<void(const Set&, World&)> run;
};

const std::vector<Loop>& loops()
{
  static const std::vector<Loop> all = {
    { "sweep_runs",
      [](const Set& set, World& w)
      {
        w.result = set.sweep_runs(w.particles(), w.run_ends.data(), w.lanes.data(), BLOCKS, 0.01F,
                                  w.notes.data());
      } },
    { "sweep_records",
      [](const Set& set, World& w)
      {
        const Particles particles = w.particles();
        w.result = set.sweep_records(
            { w.way_records.data(), w.start_records.data(), w.particle.data() }, particles.held,
            w.record_ends.data(), w.lanes.data(), BLOCKS, 0.01F, w.notes.data());
      } },
    { "pull_runs",
      [](const Set& set, World& w)
      {
        const Air air = w.air();
        w.result = set.pull_runs({ { air.position[0], air.position[1], air.position[2] },
                                   { air.velocity[0], air.velocity[1], air.velocity[2] },
                                   { air.force[0], air.force[1], air.force[2] } },
                                 w.run_ends.data(), w.lanes.data(), BLOCKS, w.notes.data());
      } },
    { "pull_records",
      [](const Set& set, World& w)
      {
        w.result = set.pull_records(
            { w.start_records.data(), w.way_records.data(), w.force_records.data() },
            w.record_ends.data(), w.lanes.data(), BLOCKS, w.notes.data());
      } },
    { "blow_runs", [](const Set& set, World& w)
      { set.blow_runs(w.air(), w.triangle_runs.data(), w.areas.data(), BLOCKS); } },
    { "blow_ends", [](const Set& set, World& w)
      { set.blow_ends(w.air(), w.triangle_ends.data(), w.areas.data(), BLOCKS); } },
    { "accelerate", [](const Set& set, World& w)
      { set.accelerate(w.force[0].data(), w.velocity[0].data(), -9.81F, 0.4F, PARTICLES); } },
    { "add_force", [](const Set& set, World& w)
      { set.add_force(w.way[0].data(), w.force[0].data(), w.inverse_mass.data(), PARTICLES); } },
    { "tile_sides", [](const Set& set, World& w)
      { set.tile_sides(w.particles().start, w.air().position, BALL, w.sides.data(), TILES); } },
    { "particle_sides",
      [](const Set& set, World& w) {
        set.particle_sides(w.particles().start, w.air().position, BALL, w.particle_sides.data());
      } },
    { "land",
      [](const Set& set, World& w)
      {
        Axes3 position = { w.position[0].data(), w.position[1].data(), w.position[2].data() };
        Axes3 velocity = { w.velocity[0].data(), w.velocity[1].data(), w.velocity[2].data() };
        Axes3 change = { w.change[0].data(), w.change[1].data(), w.change[2].data() };
        set.land(position, velocity, w.particles().start, w.inverse_mass.data(),
                 { -0.1F, 0.5F, 0.05F, 0.01F }, change, w.landed.data(), TILES);
        for (int i = 0; i < PARTICLES; ++i)  // of the others it says nothing
        {
          if ((w.landed[i / TILE] >> (i % TILE) & 1U) == 0)
          {
            change[0][i] = change[1][i] = change[2][i] = 0.0F;
          }
        }
      } },
    { "calm", [](const Set& set, World& w)
      { w.result = set.calm(w.air().position, w.air().velocity, 3.0F, PARTICLES) ? 1 : 2; } },
    { "predict",
      [](const Set& set, World& w)
      {
        set.predict(w.way[0].data(), w.velocity[0].data(), w.force[0].data(), w.inverse_mass.data(),
                    w.start[0].data(), w.position[0].data(), 0.01F, PARTICLES);
      } },
    { "finish",
      [](const Set& set, World& w)
      {
        set.finish(w.way[0].data(), w.start[0].data(), w.inverse_mass.data(), 0.01F,
                   w.position[0].data(), w.velocity[0].data(), PARTICLES);
      } },
    { "above", [](const Set& set, World& w)
      { w.result = set.above(w.inverse_mass.data(), w.limit.data(), PARTICLES) ? 1 : 2; } },
    { "integrate",
      [](const Set& set, World& w)
      {
        set.integrate(w.position[0].data(), w.velocity[0].data(), w.way[0].data(),
                      w.force[0].data(), w.inverse_mass.data(), w.limit.data(), w.held[0].data(),
                      0.01F, PARTICLES);
      } },
  };
  return all;
}

TEST(Kernels, OfEachInstructionSetGiveTheBitsOfThePlainest)
{
  const Set* const* sets = nullptr;
  const std::size_t count = available(sets);
  const World untouched;
  for (const Loop& loop : loops())
  {
    World plain;
    loop.run(*sets[0], plain);
    EXPECT_FALSE(plain.bytes() == untouched.bytes()) << loop.name << " does nothing here";
    for (std::size_t i = 1; i < count; ++i)
    {
      World world;
      loop.run(*sets[i], world);
      EXPECT_TRUE(world.bytes() == plain.bytes()) << loop.name << " of " << sets[i]->name;
    }
  }
}

TEST(Kernels, CallNothingCalmThatHoldsANumberWhichIsNone)
{
  const Set* const* sets = nullptr;
  const std::size_t count = available(sets);
  for (float wrong : { std::nanf(""), HUGE_VALF, -HUGE_VALF })
  {
    for (int at = 0; at < 6 * PARTICLES; ++at)
    {
      std::vector<float> values(6 * PARTICLES, 0.5F);
      const float* axes[6];
      for (int k = 0; k < 6; ++k)
      {
        axes[k] = values.data() + k * PARTICLES;
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        values[at] = 0.5F;
        EXPECT_TRUE(sets[i]->calm(axes, axes + 3, 1.0F, PARTICLES)) << sets[i]->name;
        values[at] = wrong;
        EXPECT_FALSE(sets[i]->calm(axes, axes + 3, 1.0F, PARTICLES))
            << sets[i]->name << ", axis " << at / PARTICLES << ", " << wrong;
      }
    }
  }
}

TEST(Kernels, TellAWishThatTheyIgnore)
{
  unsetenv("CLOTH_TEARING_SIMD");
  EXPECT_EQ(ignoredWish(), nullptr);
  setenv("CLOTH_TEARING_SIMD", "plain", 1);
  EXPECT_EQ(ignoredWish(), nullptr);
  setenv("CLOTH_TEARING_SIMD", "abacus", 1);
  EXPECT_STREQ(ignoredWish(), "abacus");
}

}  // namespace
}  // namespace kernels
}  // namespace cloth
