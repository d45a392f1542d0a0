// Scenes whose bits must not depend on compiler, optimisation, registers, threads or run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/simulation.h"
#include "float_traps.h"

namespace cloth
{

/// What a scene was like at one moment.
struct SceneMoment
{
  std::string name;
  std::uint64_t tears = 0;
  std::uint64_t hash = 0;

  std::string line() const
  {
    return name + " " + std::to_string(tears) + " tears " + std::to_string(hash);
  }
};

namespace determinism
{

/// A solver, or XPBD with lines.
struct Choice
{
  SolverKind kind;
  bool lines;

  Choice(SolverKind solver, bool in_lines = false)  // NOLINT(google-explicit-constructor): a kind
      : kind(solver), lines(in_lines)               // says it all
  {
  }

  std::string name() const
  {
    return kind == SolverKind::FORCE_SPRINGS ? "force_springs" : lines ? "xpbd_lines" : "xpbd";
  }
};

inline std::vector<Choice> allSolvers()
{
  return { { SolverKind::XPBD }, { SolverKind::FORCE_SPRINGS }, { SolverKind::XPBD, true } };
}

inline SimulationParams parameters(const Choice& solver)
{
  SimulationParams params;
  params.solver.kind = solver.kind;
  params.solver.lines = solver.lines;
  params.solver.max_substeps = 64;
  params.material.areal_density = 0.15;
  params.material.stiffness = 60.0;
  params.material.bend_shear_stiffness = 12.0;
  params.environment.wind = Vec3d(0.3, 1.1, 0.2);
  params.contact.floor = true;
  params.contact.floor_height = -1.1;
  return params;
}

/// Hangs by its upper edge.
inline Simulation hung(const RectangleParams& rectangle_params, const SimulationParams& params)
{
  ClothModel model = rectangle(rectangle_params);
  std::vector<int> top;
  for (std::size_t i = 0; i < model.positions.size(); ++i)
  {
    Vec3d& x = model.positions[i];
    if (x.y() == 0.0)
    {
      top.push_back(static_cast<int>(i));
    }
    x = Vec3d(x.x(), 0.0, x.y());
  }
  return { model, top, params };
}

inline Simulation curtain(const Choice& solver)
{
  RectangleParams rectangle_params;
  rectangle_params.columns = 10;
  rectangle_params.rows = 10;
  rectangle_params.pattern = RectanglePattern::IRREGULAR;
  return hung(rectangle_params, parameters(solver));
}

/// So large that many threads share a step.
inline Simulation largeCurtain(const Choice& solver, RectanglePattern pattern, int threads)
{
  RectangleParams rectangle_params;
  rectangle_params.width = 4.0;
  rectangle_params.height = 4.0;
  rectangle_params.columns = 120;
  rectangle_params.rows = 120;
  rectangle_params.pattern = pattern;
  SimulationParams params = parameters(solver);
  params.contact.floor_height = -3.8;
  params.threads = threads;
  return hung(rectangle_params, params);
}

/// A sphere pushes in, streamed.
inline void drape(Simulation& simulation)
{
  Sphere sphere;
  sphere.center = Vec3d(0.1, -0.4, -0.6);
  sphere.radius = 0.3;
  sphere.velocity = Vec3d(0.0, 0.5, 0.0);
  simulation.setSpheres({ sphere });
}

/// A gripper pulls and turns.
inline void drag(Simulation& simulation)
{
  GraspRequest request;
  request.point = Vec3d(0.1, 0.0, -0.9);
  request.radius = 0.2;
  request.frame.position = request.point;
  DragTarget target;
  target.pose.position = Vec3d(0.3, -0.3, -1.3);
  target.pose.rotation = Quatd(0.8, 0.0, 0.6, 0.0);
  target.linear_speed = 2.0;
  target.angular_speed = 3.0;
  simulation.drag(simulation.grasp(request).id, target);
}

/// Two balls are thrown, one of them heavy.
inline void shoot(Simulation& simulation)
{
  ThrowRequest thrown;
  thrown.center = Vec3d(0.03, -0.3, -0.4);
  thrown.velocity = Vec3d(0.2, 7.0, 0.1);
  thrown.radius = 0.1;
  simulation.throwSphere(thrown);
  thrown.center = Vec3d(-0.3, -0.3, -0.7);
  thrown.mass = 0.4;
  simulation.throwSphere(thrown);
}

/// All at once, on a large cloth: balls, one of them heavy, and a gripper that pulls and turns.
inline void storm(Simulation& simulation)
{
  ThrowRequest thrown;
  thrown.center = Vec3d(0.03, -0.5, -1.5);
  thrown.velocity = Vec3d(0.2, 20.0, 0.1);
  thrown.radius = 0.3;
  simulation.throwSphere(thrown);
  thrown.center = Vec3d(-1.0, -0.5, -2.5);
  thrown.mass = 2.0;
  simulation.throwSphere(thrown);

  GraspRequest request;
  request.point = Vec3d(1.5, 0.0, -2.0);
  request.radius = 0.3;
  request.frame.position = request.point;
  DragTarget target;
  target.pose.position = Vec3d(2.5, -1.0, -4.0);
  target.pose.rotation = Quatd(0.8, 0.0, 0.6, 0.0);
  target.linear_speed = 6.0;
  target.angular_speed = 3.0;
  simulation.drag(simulation.grasp(request).id, target);
}

/// Adds what it was like five times on the way; a fault ends it.
inline void play(const std::string& name, Simulation simulation, int steps,
                 std::vector<SceneMoment>& moments)
{
  const FloatTraps traps;
  std::string fault;
  for (int i = 1; i <= steps && fault.empty(); ++i)
  {
    fault = simulation.step().fault;
    if (i % (steps / 5) == 0 || !fault.empty())
    {
      moments.push_back({ name + " step " + std::to_string(i) + fault, simulation.revision(),
                          simulation.stateHash() });
    }
  }
}

}  // namespace determinism

/// So many threads share a step of the large scenes, if they may.
constexpr int MOST_SCENE_THREADS = 7;

/// Plays all small scenes with all solvers, each from the start.
inline std::vector<SceneMoment> playScenes()
{
  struct Scene
  {
    const char* name;
    void (*begin)(Simulation&);
  };
  std::vector<SceneMoment> moments;
  for (const determinism::Choice& solver : determinism::allSolvers())
  {
    for (const Scene& scene :
         { Scene{ "drape", determinism::drape }, Scene{ "drag", determinism::drag },
           Scene{ "shoot", determinism::shoot } })
    {
      Simulation simulation = determinism::curtain(solver);
      scene.begin(simulation);
      determinism::play(solver.name() + " " + scene.name, simulation, 500, moments);
    }
  }
  return moments;
}

/// Plays a large scene with all solvers, on cloth of rows and on irregular cloth.
inline std::vector<SceneMoment> playLargeScenes(int threads)
{
  std::vector<SceneMoment> moments;
  for (const determinism::Choice& solver : determinism::allSolvers())
  {
    for (RectanglePattern pattern : { RectanglePattern::ALTERNATING, RectanglePattern::IRREGULAR })
    {
      const std::string mesh = pattern == RectanglePattern::IRREGULAR ? "irregular" : "rows";
      Simulation simulation = determinism::largeCurtain(solver, pattern, threads);
      determinism::storm(simulation);
      determinism::play("large " + solver.name() + " " + mesh, simulation, 120, moments);
    }
  }
  return moments;
}

}  // namespace cloth
