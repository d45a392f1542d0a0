#!/usr/bin/env python3
"""Whether a grip that is weak enough slips before any cloth tears."""
import sys
import unittest

import rospy
import rostest
from cloth_tearing.msg import GraspEvent
from cloth_tearing.srv import Drag, DragRequest, GetGraspEvents, GetGraspEventsRequest, \
    GetTearEvents, GetTearEventsRequest, Grasp, GraspRequest, Step, StepRequest

CLOTHS = ["cloth_1", "cloth_2", "cloth_3"]  # with other seeds


def ask(name, service, request):
    """Calls a service that has to say yes."""
    rospy.wait_for_service(name, 20.0)
    answer = rospy.ServiceProxy(name, service)(request)
    assert answer.success, f"{name}: {answer.message}"
    return answer


def pull_weakly(cloth, force_limit):
    """Stands for the program under test: draws the lower edge down with a limited grip."""
    grasp = GraspRequest(radius=0.04, force_limit=force_limit)
    grasp.header.frame_id = "world"
    grasp.point.z = 0.6
    grasp_id = ask(f"{cloth}/grasp", Grasp, grasp).grasp_id
    drag = DragRequest(grasp_id=grasp_id, linear_speed=0.2)
    drag.header.frame_id = "world"
    drag.target.position.z = 0.4
    ask(f"{cloth}/drag", Drag, drag)
    ask(f"{cloth}/step", Step, StepRequest(steps=2000))


class SlipTest(unittest.TestCase):
    def test_a_grip_of_two_newtons_slips_before_any_cloth_tears(self):
        for cloth in CLOTHS:
            pull_weakly(cloth, force_limit=2.0)

            grasped = ask(f"{cloth}/get_grasp_events", GetGraspEvents, GetGraspEventsRequest())
            torn = ask(f"{cloth}/get_tear_events", GetTearEvents, GetTearEventsRequest())
            self.assertEqual(grasped.events[-1].kind, GraspEvent.SLIPPED, cloth)
            self.assertEqual(torn.events, [], cloth)


if __name__ == "__main__":
    rospy.init_node("slip_test")
    rostest.rosrun("gripper_test", "slip", SlipTest, sys.argv)
