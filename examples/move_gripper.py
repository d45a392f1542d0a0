#!/usr/bin/env python3
"""Moves the gripper of urdf/gripper.urdf: it takes hold of a cloth, pulls until it tears, lets go.

    roslaunch cloth_tearing gripper_demo.launch

Tells the joints' positions on joint_states; robot_state_publisher makes frames of them, which the
cloth follows: its grasp the frame "gripper", two balls the frames of the fingers. Ends with 0 only if
the cloth tore by this grasp. Parameter ~stay: go on publishing afterwards, for those who watch.
"""
import sys

import rospy
from cloth_tearing.msg import CollisionSphere, CollisionSpheres, TearEvent, TearEvents
from cloth_tearing.srv import Grasp, GraspRequest, Release, ReleaseRequest
from sensor_msgs.msg import JointState

RATE = 100.0  # of the joints' positions [Hz]
PATIENCE = 60.0  # for the cloth to be there [s]
PAD = 0.018  # radius of a finger's pad [m]
OPEN, CLOSED = 0.06, 0.022  # distance of the pads' centres from the middle [m]

# The way: x, y, z of the gripper, opening [m], and how long it takes to get there [s].
BELOW = (0.2, -0.02, 0.75, OPEN, 2.0)
ROUND_THE_EDGE = (0.2, -0.02, 0.94, OPEN, 1.0)
SHUT = (0.2, -0.02, 0.94, CLOSED, 0.6)
TAUT = (0.22, -0.3, 0.9, CLOSED, 1.5)
TORN = (0.3, -0.62, 0.95, CLOSED, 3.0)
LET_GO = (0.3, -0.62, 0.95, OPEN, 0.6)
AWAY = (0.3, -0.62, 0.7, OPEN, 1.5)


def call(name, service, request):
    """Calls a service of the cloth. A refusal ends the program, with the node's own words."""
    rospy.wait_for_service(name, PATIENCE)
    answer = rospy.ServiceProxy(name, service)(request)
    return answer if answer.success else sys.exit(f"{name}: {answer.message}")


class Mover:
    """The gripper's joints, and the tears that its grasp caused."""

    def __init__(self):
        self.joints = rospy.Publisher("joint_states", JointState, queue_size=10)
        self.fingers = rospy.Publisher("cloth/spheres", CollisionSpheres, queue_size=1, latch=True)
        self.place = (0.2, -0.45, 0.66, OPEN)
        self.rate = rospy.Rate(RATE)
        self.grasp_id = 0
        self.tears = 0
        rospy.Subscriber("cloth/tear_events", TearEvents, self.on_tears)

    def on_tears(self, message):
        """Counts the tears whose cause is this grasp."""
        for event in message.events:
            if event.cause == TearEvent.GRASP and event.cause_id == self.grasp_id:
                self.tears += 1

    def publish(self):
        """Tells where the joints are now, and waits for the next time to do so."""
        x, y, z, opening = self.place
        names = ["along_x", "along_y", "along_z", "left_finger", "right_finger"]
        joints = JointState(name=names, position=[x, y, z, opening, opening])
        joints.header.stamp = rospy.Time.now()
        self.joints.publish(joints)
        self.rate.sleep()

    def go(self, target):
        """Moves to a point of the way, gently off and gently to a stop, and tells of the fingers again:
        a cloth that does not know their frames yet has refused them before."""
        start, *end, duration = self.place, *target
        count = round(duration * RATE)
        for i in range(1, count + 1):
            part = i / count
            part = part * part * (3.0 - 2.0 * part)
            self.place = [a + part * (b - a) for a, b in zip(start, end)]
            self.publish()
        self.show_fingers()

    def wait_until(self, is_true, what):
        """Stands still until something is true."""
        deadline = rospy.Time.now() + rospy.Duration(PATIENCE)
        while not is_true():
            if rospy.Time.now() > deadline:
                sys.exit(f"waited in vain for {what}")
            self.publish()

    def show_fingers(self):
        """Makes obstacles of the fingers: balls that follow their frames."""
        message = CollisionSpheres()
        message.header.frame_id = "world"
        for number, frame in enumerate(("left_finger", "right_finger")):
            message.spheres.append(CollisionSphere(id=number, frame=frame, radius=PAD))
        self.fingers.publish(message)

    def take_hold(self):
        """Grasps the cloth between the fingers; from then on it follows the gripper."""
        request = GraspRequest(radius=0.05, gripper_frame="gripper")
        request.header.frame_id = "gripper"  # the point is its origin
        self.grasp_id = call("cloth/grasp", Grasp, request).grasp_id

    def tear(self):
        """The whole of it."""
        rospy.wait_for_service("cloth/grasp", PATIENCE)
        self.wait_until(lambda: self.joints.get_num_connections() > 0, "robot_state_publisher")
        self.wait_until(lambda: self.fingers.get_num_connections() > 0, "the cloth")
        for point in (BELOW, ROUND_THE_EDGE, SHUT):
            self.go(point)
        self.take_hold()
        print("scene: the gripper holds the cloth", flush=True)
        for point in (TAUT, TORN):
            self.go(point)
        print(f"tears: {self.tears} by the gripper", flush=True)
        self.go(LET_GO)
        call("cloth/release", Release, ReleaseRequest(grasp_id=self.grasp_id))
        self.go(AWAY)


def main():
    rospy.init_node("move_gripper")
    mover = Mover()
    mover.tear()
    while rospy.get_param("~stay", False) and not rospy.is_shutdown():
        mover.publish()
    return 0 if mover.tears else 1


if __name__ == "__main__":
    sys.exit(main())
