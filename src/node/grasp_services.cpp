// Takes hold of the cloth, drags it and lets go, as requested.
#include "cloth_tearing/node/grasp_services.h"

#include "cloth_tearing/core/refusal.h"

namespace cloth_tearing
{

GraspServices::GraspServices(const NodeContext& context) : context_(context)
{
  RequestServer& requests = context_.requests;
  ros::NodeHandle& node = context_.node;
  requests.serve<Grasp>(node, "grasp", [this](auto& q, auto& a) { onGrasp(q, a); });
  requests.serve<Drag>(node, "drag", [this](auto& q, auto&) { onDrag(q); });
  requests.serve<Release>(node, "release", [this](auto& q, auto& a) { onRelease(q, a); });
}

void GraspServices::onGrasp(const Grasp::Request& request, Grasp::Response& response)
{
  cloth::refuseIf(problems(request));
  const cloth::GraspRequest wish = toCore(request, context_.frames.toCloth(request.header));
  const cloth::GraspTaken taken =
      context_.loop.call([&wish](cloth::Simulation& simulation) { return simulation.grasp(wish); });
  response.grasp_id = taken.id;
  response.held_particles = static_cast<std::uint32_t>(taken.held_particles);
  response.distance = taken.distance;
}

void GraspServices::onDrag(const Drag::Request& request)
{
  cloth::refuseIf(problems(request));
  Destination destination = toCore(request, context_.frames.toCloth(request.header));
  const std::uint64_t id = request.grasp_id;
  context_.loop.call(
      [&destination, id](cloth::Simulation& simulation)
      {
        for (const cloth::Grasp& grasp : simulation.grasps())
        {
          if (grasp.id == id && destination.keeps_rotation)
          {
            destination.target.pose.rotation = grasp.pose.rotation;
          }
        }
        simulation.drag(id, destination.target);
      });
}

void GraspServices::onRelease(const Release::Request& request, Release::Response& response)
{
  const std::uint64_t id = request.grasp_id;
  response.released = static_cast<std::uint32_t>(context_.loop.call(
      [id](cloth::Simulation& simulation)
      {
        if (id == 0)
        {
          return simulation.releaseAll();
        }
        simulation.release(id);
        return 1;
      }));
}

}  // namespace cloth_tearing
