#!/usr/bin/env python3
"""Pulls a cloth until it is about to tear, stops, asks what more would tear, and then tears it.

    roslaunch cloth_tearing cloth.launch     and     rosrun cloth_tearing pull_in_steps.py

Ends with 0 only if the cloth held until it was meant to tear, and then tore.
"""
import sys

import actionlib
import rospy
from cloth_tearing.msg import GraspStates, PullAction, PullGoal
from cloth_tearing.srv import GetTearEvents, GetTearEventsRequest, Grasp, GraspRequest

ENOUGH = 0.8  # of what the cloth near the gripper can bear [-]; 1 = it tears
STRIDE = 0.01  # [m]
PATIENCE = 60.0  # for each answer [s]


def call(name, service, request):
    """Calls a service of the cloth. A refusal ends the program, with the node's own words."""
    rospy.wait_for_service(name, PATIENCE)
    answer = rospy.ServiceProxy(name, service)(request)
    return answer if answer.success else sys.exit(f"{name}: {answer.message}")


def connect(name):
    """A client of ~pull or ~predict_pull."""
    client = actionlib.SimpleActionClient(name, PullAction)
    return client if client.wait_for_server(rospy.Duration(PATIENCE)) else sys.exit(f"no {name}")


def pull_down(client, grasp_id, distance, **more):
    """Pulls straight down, and waits for the end. Returns the result."""
    goal = PullGoal(grasp_id=grasp_id, distance=distance, linear_speed=0.1, **more)
    goal.header.frame_id = "world"
    goal.direction.z = -1.0
    client.send_goal_and_wait(goal, rospy.Duration(PATIENCE))
    return client.get_result() or sys.exit("the pull was not over in time")


def utilisation(grasp_id):
    """How near the cloth beside the grasp is to tearing [-]."""
    states = rospy.wait_for_message("cloth/grasp_states", GraspStates, PATIENCE)
    return next(state.utilisation for state in states.grasps if state.grasp_id == grasp_id)


def newest_tear():
    """The number of the newest tear."""
    return call("cloth/get_tear_events", GetTearEvents, GetTearEventsRequest(max_count=1)).newest


def main():
    rospy.init_node("pull_in_steps")
    pull, predict = connect("cloth/pull"), connect("cloth/predict_pull")
    request = GraspRequest(radius=0.05)
    request.header.frame_id = "world"
    request.point.z = 0.5  # the middle of the lower edge
    before = newest_tear()
    grasp_id = call("cloth/grasp", Grasp, request).grasp_id

    while utilisation(grasp_id) < ENOUGH:
        pull_down(pull, grasp_id, STRIDE)
        print(f"utilisation {utilisation(grasp_id):.2f}", flush=True)

    predicted = pull_down(predict, grasp_id, 0.3).tears
    print(f"0.3 m more would make {predicted} tears", flush=True)
    held = newest_tear() == before
    print("nothing tore yet" if held else "it tore too early", flush=True)

    torn = pull_down(pull, grasp_id, 0.3, stop_tears=5, release=True)
    print(f"{torn.tears} tears, at most {torn.peak_force:.1f} N: {torn.message}")
    return 0 if held and torn.tears >= 5 else 1


if __name__ == "__main__":
    sys.exit(main())
