// Scenes whose bits must not depend on compiler, optimisation or run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth_tearing/core/mesh_builder.h"
#include "cloth_tearing/core/simulation.h"

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

inline SimulationParams parameters(SolverKind solver)
{
  SimulationParams params;
  params.solver.kind = solver;
  params.solver.max_substeps = 64;
  params.material.areal_density = 0.15;
  params.material.stiffness = 60.0;
  params.material.bend_shear_stiffness = 12.0;
  params.environment.wind = Vec3d(0.3, 1.1, 0.2);
  params.contact.floor = true;
  params.contact.floor_height = -1.1;
  return params;
}

inline Simulation curtain(SolverKind solver)
{
  RectangleParams rectangle_params;
  rectangle_params.columns = 10;
  rectangle_params.rows = 10;
  rectangle_params.pattern = RectanglePattern::IRREGULAR;
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
  return { model, top, parameters(solver) };
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
  target.pose.position = Vec3d(0.5, -0.3, -1.7);
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

}  // namespace determinism

/// Plays all scenes with both solvers, each from the start.
inline std::vector<SceneMoment> playScenes()
{
  struct Scene
  {
    const char* name;
    void (*begin)(Simulation&);
  };
  std::vector<SceneMoment> moments;
  for (SolverKind solver : { SolverKind::XPBD, SolverKind::FORCE_SPRINGS })
  {
    const std::string with = solver == SolverKind::XPBD ? "xpbd" : "force_springs";
    for (const Scene& scene :
         { Scene{ "drape", determinism::drape }, Scene{ "drag", determinism::drag },
           Scene{ "shoot", determinism::shoot } })
    {
      Simulation simulation = determinism::curtain(solver);
      scene.begin(simulation);
      for (int i = 1; i <= 500; ++i)
      {
        const StepReport report = simulation.step();
        if (i % 100 == 0 || !report.fault.empty())
        {
          moments.push_back({ with + " " + scene.name + " step " + std::to_string(i) + report.fault,
                              simulation.revision(), simulation.stateHash() });
        }
      }
    }
  }
  return moments;
}

}  // namespace cloth
