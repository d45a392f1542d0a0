#!/usr/bin/env python3
"""The shipped view in a running rviz beside a running cloth, worked with as a person does: what the
pointer does is looked for in the node and in the picture."""
import os
import signal
import threading
import xmlrpc.client

import rosgraph
import rospy
from cloth_tearing.msg import GraspStates, SimulationStatus, TearEvent
from cloth_tearing.srv import GetTearEvents, Grasp, GraspRequest, Release, Step
from rosgraph_msgs.msg import Log
from std_srvs.srv import Trigger

from rviz_window import ERROR, HEIGHT, PATIENCE, SHIPPED, SOURCE, WARNING, WIDTH, RvizTest, run

PULL, THROW, INTERACT = "l", "t", "i"  # keys of the tools
TORN = (217, 13, 89)                   # colour of torn edges
TOP, BOTTOM = 1.5, 0.5                 # of the cloth of config/cloth.yaml, a square about x = 0 [m]

# The words on buttons of the panel get colours of their own, by which they are found.
WIDGETS = {"pause": (150, 0, 0), "step": (0, 130, 0), "reset": (0, 0, 170), "save": (150, 110, 0),
           "restore": (0, 110, 140)}
STYLE = "\n".join(f"QPushButton#{name} {{ color: rgb{color}; }}" for name, color in WIDGETS.items())


class Node:
    """The cloth's node: its services, and the last that it said of itself."""

    NAME = "/cloth"

    def __init__(self):
        self._lock = threading.Lock()
        self._last = {}
        for name, kind in (("status", SimulationStatus), ("grasp_states", GraspStates)):
            rospy.Subscriber(f"{self.NAME}/{name}", kind, self._take, name)

    def _take(self, message, name):
        with self._lock:
            self._last[name] = message

    def last(self, name):
        with self._lock:
            return self._last.get(name)

    def status(self):
        return self.last("status")

    def grasps(self):
        states = self.last("grasp_states")
        return states.grasps if states else []

    def ask(self, name, service, **request):
        rospy.wait_for_service(f"{self.NAME}/{name}", PATIENCE)
        answer = rospy.ServiceProxy(f"{self.NAME}/{name}", service)(**request)
        assert answer.success, f"{name}: {answer.message}"
        return answer

    def tell(self, name):
        self.ask(name, Trigger)

    def tears(self, since=0):
        return self.ask("get_tear_events", GetTearEvents, since=since).events

    def kill(self):
        address = rosgraph.Master(rospy.get_name()).lookupNode(self.NAME)
        pid = xmlrpc.client.ServerProxy(address).getPid(rospy.get_name())[2]
        os.kill(pid, signal.SIGKILL)


class RvizView(RvizTest):
    @classmethod
    def setUpClass(cls):
        cls.errors = []
        cls.log = rospy.Subscriber("/rosout", Log, cls.hear)
        cls.node = Node()
        cls.open(SOURCE / "config/cloth.rviz", style=STYLE)

    @classmethod
    def hear(cls, line):
        if line.level >= Log.ERROR:
            cls.errors.append(f"{line.name}: {line.msg}")

    def setUp(self):
        """A whole cloth, running and to be seen."""
        self.scene = self.wait_for_scene()
        self.node.tell("reset")
        self.node.tell("resume")
        self.node.ask("release", Release)
        self.first_tear = 1 + max((tear.sequence for tear in self.node.tears()), default=0)
        self.wait_for("the cloth", lambda p: p.shows(SHIPPED.values(), self.scene, least=4000) and
                      p.count(TORN, self.scene) == 0)

    def panel_has(self, picture, sign):
        return (picture.has_sign(sign, (0, 0, self.scene[0], HEIGHT)) or
                picture.has_sign(sign, (self.scene[2], 0, WIDTH, HEIGHT)))

    def cloth(self, picture):
        """The region that the whole cloth fills."""
        boxes = [picture.box(color, self.scene) for color in SHIPPED.values()]
        return (min(b[0] for b in boxes), min(b[1] for b in boxes),
                max(b[2] for b in boxes), max(b[3] for b in boxes))

    def place(self, across, down):
        """A pixel of the whole cloth by its part of the width and of the height."""
        left, top, right, bottom = self.cloth(self.screen.picture())
        return (round(left + across * (right - left)), round(top + down * (bottom - top)))

    def new_tears(self):
        return self.node.tears(self.first_tear)

    def take_tool(self, key):
        """By its key; the scene has the keys when the pointer was in it."""
        self.pointer.focus("RViz")
        self.pointer.move(self.scene[0] + 30, self.scene[1] + 30)
        self.pointer.key(key)

    def test_01_opens_without_an_error(self):
        picture = self.screen.picture()

        self.keep("opened")
        self.assertFalse(self.panel_has(picture, ERROR), "a status is red")
        self.assertFalse(self.panel_has(picture, WARNING), "a status is yellow")
        self.assertEqual(self.errors, [])

    def test_02_a_pull_with_the_pointer_tears_the_cloth(self):
        self.take_tool(PULL)
        before = self.screen.picture()
        x, y = self.place(0.5, 0.8)
        self.pointer.move(x, y)

        self.pointer.press()
        grasp, = self.wait_until("a grasp", self.node.grasps)
        self.keep("held")
        at = grasp.pose.position
        self.assertLess(abs(at.x), 0.1)
        self.assertLess(abs(at.z - (TOP - 0.8 * (TOP - BOTTOM))), 0.1)
        self.pointer.move(x, y + 150)
        self.wait_until("tears", lambda: len(self.new_tears()) >= 5)

        torn = self.wait_for("torn edges", lambda p: p.count(TORN, self.scene) > 30)
        self.keep("pulled")
        self.assertEqual(self.new_tears()[0].cause, TearEvent.GRASP)
        self.assertEqual(self.new_tears()[0].cause_id, grasp.grasp_id)
        self.assertGreater(torn.changed(before, self.cloth(before)), 0.05)
        left, top, right, bottom = torn.box(TORN, self.scene)
        for beside in ((left - 40, top, left, bottom), (right, top, right + 40, bottom)):
            self.assertTrue(any(torn.count(color, beside) > 50 for color in SHIPPED.values()),
                            "texture on both sides of the tear")
        self.pointer.release()
        self.wait_until("it is let go", lambda: not self.node.grasps())

    def test_03_a_thrown_ball_goes_through_the_cloth(self):
        self.take_tool(THROW)
        before = self.screen.picture()
        region = self.cloth(before)

        self.pointer.click(*self.place(0.5, 0.6))

        self.wait_until("a ball", lambda: self.node.status().spheres > 0)
        self.wait_until("tears", self.new_tears)
        torn = self.wait_for("a hole", lambda p: p.changed(before, region) > 0.03 and
                             p.count(TORN, self.scene) > 30)
        self.keep("thrown")
        self.assertEqual(self.new_tears()[0].cause, TearEvent.THROWN_SPHERE)

    def test_09_goes_on_with_a_node_that_was_killed_and_started_again(self):
        time_before = self.node.status().time
        self.node.kill()
        self.wait_for("a warning", lambda p: self.panel_has(p, WARNING))
        self.keep("node_gone")

        self.wait_until("a new node", lambda: self.node.status().time < time_before)

        picture = self.wait_for("its cloth", lambda p: not self.panel_has(p, WARNING) and
                                p.shows(SHIPPED.values(), self.scene, least=4000))
        self.keep("node_back")
        self.assertFalse(self.panel_has(picture, ERROR), "a status is red")


if __name__ == "__main__":
    run("rviz_view", RvizView)
