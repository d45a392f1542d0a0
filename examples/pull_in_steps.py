#!/usr/bin/env python3
"""Pulls a cloth until it is about to tear, stops, asks what more would tear, and then tears it.

    roslaunch cloth_tearing cloth.launch     and     rosrun cloth_tearing pull_in_steps.py

Ends with 0 only if the cloth held until it was meant to tear, and then tore.
"""
import sys

import actionlib
import rospy
from cloth_tearing.msg import GraspStates, PullAction, PullGoal, PullResult
from cloth_tearing.srv import Grasp, GraspRequest, Release, ReleaseRequest

ENOUGH = 0.8  # of what the cloth near the gripper can bear [-]; 1 = it tears
STRIDE = 0.02  # [m]
PATIENCE = 60.0  # for each answer [s]


def call(name, service, request):
    """Calls a service of the cloth. A refusal ends the program, with the node's own words."""
    rospy.wait_for_service(name, PATIENCE)
    answer = rospy.ServiceProxy(name, service)(request)
    return answer if answer.success else sys.exit(f"{name}: {answer.message}")


def utilisation(grasp_id):
    """How near the cloth beside the grasp is to tearing [-]."""
    states = rospy.wait_for_message("cloth/grasp_states", GraspStates, PATIENCE)
    return next(state.utilisation for state in states.grasps if state.grasp_id == grasp_id)


def pull_down(action, grasp_id, distance, stop_tears=0):
    """Pulls straight down, or only predicts it, and waits for the end. Returns the result."""
    goal = PullGoal(grasp_id=grasp_id, distance=distance, linear_speed=0.2, stop_tears=stop_tears)
    goal.header.frame_id = "world"
    goal.direction.z = -1.0
    client = actionlib.SimpleActionClient(action, PullAction)
    if not client.wait_for_server(rospy.Duration(PATIENCE)):
        sys.exit(f"nobody serves {action}")
    client.send_goal_and_wait(goal, rospy.Duration(PATIENCE))
    result = client.get_result()
    if result is None or result.outcome not in (PullResult.ARRIVED, PullResult.TEARS):
        sys.exit(f"{action}: {result.message if result else 'not over in time'}")
    return result


def main():
    rospy.init_node("pull_in_steps")
    request = GraspRequest(radius=0.05)
    request.header.frame_id = "world"
    request.point.z = 0.5  # the middle of the lower edge
    grasp_id = call("cloth/grasp", Grasp, request).grasp_id

    too_early, near = 0, utilisation(grasp_id)
    while near < ENOUGH and not too_early:
        too_early = pull_down("cloth/pull", grasp_id, STRIDE).tears
        near = utilisation(grasp_id)
        print(f"utilisation {near:.2f}", flush=True)

    predicted = pull_down("cloth/predict_pull", grasp_id, 0.3).tears
    print(f"0.3 m more would make {predicted} tears", flush=True)

    torn = pull_down("cloth/pull", grasp_id, 0.5, stop_tears=20)
    print(f"{torn.tears} tears, at most {torn.peak_force:.1f} N: {torn.message}")
    call("cloth/release", Release, ReleaseRequest(grasp_id=grasp_id))
    return 0 if torn.tears and not too_early else 1


if __name__ == "__main__":
    sys.exit(main())
