#!/usr/bin/env python3
"""The shipped view in a running rviz beside a running cloth, worked with as a person does: what the
pointer does is looked for in the node and in the picture."""
import os
import signal
import threading
import time
import xmlrpc.client

import rosgraph
import rospy
from cloth_tearing.msg import GraspStates, SimulationStatus, TearEvent
from cloth_tearing.srv import GetTearEvents, Grasp, Pin, Release, Step, ThrowSphere
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import Point, Vector3
from rosgraph_msgs.msg import Log
from std_msgs.msg import Header
from std_srvs.srv import Trigger

from rviz_window import ERROR, HEIGHT, PATIENCE, SHIPPED, SOURCE, WARNING, WIDTH, RvizTest, run

PULL, THROW, INTERACT = "l", "t", "i"  # keys of the tools
TORN, TORN_TOLERANCE = (217, 13, 89), 8  # colour of torn edges; handles have some that are like it
# All colours of the shipped image but the light one.
TEXTURE = (*SHIPPED.values(), (168, 34, 34), (33, 110, 80), (95, 45, 115))
STILL = 0.7                              # what does not change for so long stands still [s]
FRAME = "world"
TOP, BOTTOM = 1.5, 0.5                 # of the cloth of config/cloth.yaml, a square about x = 0 [m]

# Widgets of the panel are found by a colour of their own: of the words on buttons, behind the others.
BUTTONS = {"pause": (141, 3, 5), "step": (3, 121, 5), "reset": (3, 5, 161), "save": (141, 101, 3),
           "restore": (3, 101, 131)}
FIELDS = {"speed_value": (215, 235, 255), "tear_strain_slider": (255, 225, 215),
          "weak_strain_slider": (225, 255, 215), "state_name": (255, 250, 220)}
TEXTS = {"reached": (3, 81, 101), "answer": (81, 3, 121)}
PROBLEM = (176, 0, 32)      # the words of a refusal
SCROLL_BAR = (1, 201, 203)  # of the panel, below it
STYLE = "".join(f"QPushButton#{name} {{ color: rgb{color}; }}\n" for name, color in BUTTONS.items())
STYLE += "".join(f"#{name} {{ color: rgb{color}; }}\n" for name, color in TEXTS.items())
STYLE += f"QScrollArea QScrollBar:horizontal {{ background: rgb{SCROLL_BAR}; }}\n"
STYLE += "".join(f"#{name} {{ background-color: rgb{color}; }}\n" for name, color in FIELDS.items())


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

    def end(self, how):
        """Ends the process by a signal; roslaunch starts it again."""
        address = rosgraph.Master(rospy.get_name()).lookupNode(self.NAME)
        pid = xmlrpc.client.ServerProxy(address).getPid(rospy.get_name())[2]
        os.kill(pid, how)


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
        super().setUp()
        self.addCleanup(self.pointer.release)  # whatever happens
        self.node.tell("reset")
        self.node.tell("resume")
        self.node.ask("release", Release)
        self.first_tear = 1 + max((tear.sequence for tear in self.node.tears()), default=0)
        self.wait_for("the cloth", lambda p: p.shows(SHIPPED.values(), self.scene, least=4000) and
                      self.torn(p) == 0)

    def cloth_region(self, lower_end=BOTTOM):
        """A region that the whole cloth fills for the most part."""
        left, top = self.camera.pixel(-0.5, 0.0, TOP)
        right, bottom = self.camera.pixel(0.5, 0.0, lower_end)
        return (left, top, right, bottom)

    def torn(self, picture):
        """So much of torn edges is to be seen [pixels]."""
        return picture.count(TORN, self.scene, TORN_TOLERANCE)

    def textured_beside_tear(self, picture, width=60):
        """Whether there are colours of the texture left and right of all torn edges."""
        if self.torn(picture) < 30:
            return False
        left, top, right, bottom = picture.box(TORN, self.scene, TORN_TOLERANCE)
        return all(max(picture.count(color, beside) for color in TEXTURE) > 100 for beside in
                   ((left - width, top, left, bottom), (right, top, right + width, bottom)))

    def wait_for_stillness(self):
        """The picture that the scene keeps for a while."""
        since, kept = time.monotonic(), self.screen.picture()

        def still(picture):
            nonlocal since, kept
            if picture.changed(kept, self.scene, least=1) > 0:
                since, kept = time.monotonic(), picture
            return time.monotonic() - since > STILL

        return self.wait_for("a still picture", still)

    def tear(self):
        """A hole, without the pointer."""
        header = Header(frame_id=FRAME)
        self.node.ask("throw_sphere", ThrowSphere, header=header, radius=0.06, velocity=Vector3(y=8.0),
                      center=Point(y=-1.0, z=0.5 * (TOP + BOTTOM)))
        self.wait_until("tears", self.new_tears)

    def new_tears(self):
        return self.node.tears(self.first_tear)

    def panels(self):
        """What is on the display but for the scene."""
        return self.screen.picture().without(self.scene)

    def click(self, button):
        """On a button of the panel."""
        left, top, right, bottom = self.widget(BUTTONS[button])
        self.pointer.click((left + right) // 2, (top + bottom) // 2)

    def widget(self, color):
        """The region of a widget of the panel."""
        return self.wait_until(f"a widget in {color}", lambda: self.panels().box(color, tolerance=0))

    def reached_width(self):
        """Of what the panel says of the speed reached; thin lines do not have its full colour [pixels]."""
        box = self.panels().box(TEXTS["reached"], tolerance=0)
        return box[2] - box[0] if box else 0

    def drag_to_the_end(self, slider):
        """Takes a slider's handle at the lower end, where a key puts it, and draws it to the other."""
        left, top, right, bottom = self.widget(FIELDS[slider])
        y = (top + bottom) // 2
        self.pointer.click(left + 8, y)
        self.pointer.key("Home")
        self.pointer.move(left + 5, y)
        self.pointer.press()
        self.pointer.move(right, y)
        self.pointer.release()

    def take_tool(self, key):
        """By its key; the scene has the keys when the pointer was in it."""
        self.pointer.focus("RViz")
        self.pointer.move(self.scene[0] + 30, self.scene[1] + 30)
        self.pointer.key("Escape")  # to the default tool; the key of a tool in use would leave it
        if key != INTERACT:
            self.pointer.key(key)

    def test_01_opens_without_an_error(self):
        picture = self.screen.picture()

        self.keep("opened")
        self.assertFalse(picture.has_sign(ERROR), "a status is red")
        self.assertFalse(picture.has_sign(WARNING), "a status is yellow")
        self.assertEqual(self.errors, [])

    def test_02_a_pull_with_the_pointer_tears_the_cloth(self):
        self.take_tool(PULL)
        before = self.screen.picture()
        x, y = self.camera.pixel(0.0, 0.0, 0.7)
        self.pointer.move(x, y)

        self.pointer.press()
        grasp, = self.wait_until("a grasp", self.node.grasps)
        self.wait_for("what is held", lambda p: p.changed(before, (x - 20, y - 20, x + 20, y + 20)) > 0.2)
        self.keep("held")
        at = grasp.pose.position
        self.assertLess(abs(at.x) + abs(at.y) + abs(at.z - 0.7), 0.02)
        self.pointer.move(x, y + 150)
        self.wait_until("tears", lambda: len(self.new_tears()) >= 5)

        self.wait_for("a tear with the texture on both sides", lambda p: self.textured_beside_tear(p) and
                      p.changed(before, self.cloth_region()) > 0.05)
        self.keep("pulled")
        self.assertEqual(self.new_tears()[0].cause, TearEvent.GRASP)
        self.assertEqual(self.new_tears()[0].cause_id, grasp.grasp_id)
        self.pointer.release()
        self.wait_until("it is let go", lambda: not self.node.grasps())

    def test_03_shift_moves_it_towards_the_camera_and_away(self):
        self.take_tool(PULL)
        x, y = self.camera.pixel(0.0, 0.0, 0.6)
        self.pointer.move(x, y)
        self.pointer.press()
        self.wait_until("a grasp", self.node.grasps)

        self.addCleanup(self.pointer.let_go, "shift")
        self.pointer.hold("shift")
        self.pointer.move(x, y + 40)

        near = self.wait_until("it comes nearer", lambda: [g for g in self.node.grasps()
                                                           if g.pose.position.y < -0.03])
        self.assertLess(abs(near[0].pose.position.x), 0.1)

    def test_04_control_pins_what_is_let_go(self):
        self.take_tool(PULL)
        x, y = self.camera.pixel(-0.4, 0.0, 0.6)
        before = self.screen.picture()
        self.pointer.move(x, y)
        self.pointer.press()
        grasp, = self.wait_until("a grasp", self.node.grasps)
        self.pointer.move(x + 40, y - 40)
        self.wait_until("it is led", lambda: self.node.grasps()[0].pose.position.z > 0.65)

        self.addCleanup(self.pointer.let_go, "ctrl")
        self.pointer.hold("ctrl")
        self.pointer.release()

        self.wait_until("no grasp", lambda: not self.node.grasps())
        self.wait_for("a fold", lambda p: p.changed(before, self.cloth_region()) > 0.01)
        self.keep("pinned")
        place = grasp.pose.position
        unpinned = self.node.ask("unpin", Pin, header=Header(frame_id=FRAME), radius=0.3, point=place)
        self.assertEqual(unpinned.changed, grasp.held_particles)

    def test_05_the_wheel_over_the_cloth_changes_how_much_is_held(self):
        self.take_tool(PULL)
        x, y = self.camera.pixel(0.0, 0.0, 0.8)
        self.pointer.move(x, y)
        before = self.screen.picture()
        self.pointer.wheel(4)
        self.addCleanup(self.pointer.wheel, -4)
        ball = (x - 60, y - 60, x + 60, y + 60)
        self.wait_for("a larger ball", lambda p: p.changed(before, ball) > 0.02)

        self.pointer.press()

        grasp, = self.wait_until("a grasp", self.node.grasps)
        self.keep("larger_radius")
        self.assertGreater(grasp.held_particles, 9)  # 0.07 m instead of 0.04 m

    def test_06_a_thrown_ball_goes_through_the_cloth(self):
        self.take_tool(THROW)
        before = self.screen.picture()

        self.pointer.click(*self.camera.pixel(0.0, 0.0, 0.9))

        self.wait_until("a ball", lambda: self.node.status().spheres > 0)
        self.wait_until("tears", self.new_tears)
        torn = self.wait_for("a hole", lambda p: p.changed(before, self.cloth_region()) > 0.03 and
                             self.torn(p) > 30)
        self.keep("thrown")
        self.assertEqual(self.new_tears()[0].cause, TearEvent.THROWN_SPHERE)

    def test_07_an_interactive_marker_leads_its_grasp(self):
        self.take_tool(INTERACT)
        x, y = self.camera.pixel(-0.25, 0.0, 0.9)
        around = (x - 12, y - 12, x + 12, y + 12)
        before = self.screen.picture()
        grasp_id = self.node.ask("grasp", Grasp, header=Header(frame_id=FRAME), radius=0.05,
                                 point=Point(x=-0.25, z=0.9)).grasp_id
        handle = self.wait_for("its handle", lambda p: p.changed(before, around) > 0.3)
        self.pointer.move(x, y)
        hint = (60, self.scene[3] + 4, WIDTH // 2, HEIGHT)
        self.wait_for("rviz says what can be done with it", lambda p: p.changed(handle, hint) > 0.01)
        self.keep("handle")

        self.pointer.press()
        self.pointer.move(*self.camera.pixel(-0.25, 0.0, 0.7))

        grasp, = self.wait_until("it is led", lambda: [g for g in self.node.grasps()
                                                       if g.pose.position.z < 0.73])
        self.assertEqual(grasp.grasp_id, grasp_id)
        self.assertLess(abs(grasp.pose.position.x + 0.25) + abs(grasp.pose.position.z - 0.7), 0.05)
        self.wait_for("cloth that tears", lambda p: self.torn(p) > 30)
        self.keep("handle_led")

    def test_08_buttons_of_the_panel_pause_step_and_reset(self):
        self.wait_until("a number", lambda: self.reached_width() > 20)
        self.click("pause")
        self.wait_until("a pause", lambda: self.node.status().paused)
        step, epoch = self.node.status().step, self.node.status().epoch
        still = self.wait_for_stillness()

        self.click("step")
        self.wait_until("a step", lambda: self.node.status().step > step)
        self.assertTrue(self.node.status().paused)
        self.wait_until("nothing reached", lambda: self.reached_width() < 12)  # a dash
        self.click("reset")
        self.wait_until("a reset", lambda: self.node.status().epoch > epoch)
        self.assertEqual(self.node.status().step, 0)
        self.wait_for("the cloth of the start", lambda p: p.changed(still, self.scene) > 0.001)

        self.click("pause")
        self.wait_until("it goes on", lambda: not self.node.status().paused and self.node.status().step > 0)

    def test_09_the_panel_tunes_the_node(self):
        tearing = Client("/cloth/tearing", timeout=PATIENCE)
        solver = Client("/cloth", timeout=PATIENCE)
        for name, client in (("tear_strain", tearing), ("weak_tear_strain", tearing), ("speed", solver)):
            self.addCleanup(client.update_configuration, {name: client.get_configuration()[name]})

        self.drag_to_the_end("tear_strain_slider")
        self.wait_until("more strength", lambda: tearing.get_configuration()["tear_strain"] > 1.0)
        self.drag_to_the_end("weak_strain_slider")
        self.wait_until("more at weak points",
                        lambda: tearing.get_configuration()["weak_tear_strain"] > 1.0)
        left, top, right, bottom = self.widget(FIELDS["speed_value"])
        self.pointer.click((left + right) // 2, (top + bottom) // 2)
        self.pointer.focus("RViz")
        self.pointer.key("ctrl+a")
        self.pointer.write("0.5")
        self.pointer.key("Return")
        self.wait_until("half the speed", lambda: self.node.status().speed == 0.5)
        self.keep("tuned")

    def test_10_the_panel_saves_and_restores_torn_and_whole_cloth(self):
        self.take_tool(PULL)  # with it, handles are hidden
        self.node.tell("pause")
        before = self.wait_for_stillness()
        whole = self.node.ask("step", Step, steps=0).state_hash
        self.click("save")
        self.wait_for("the answer", lambda p: p.without(self.scene).changed(before.without(self.scene)) > 0)
        self.node.tell("resume")
        self.tear()
        without_hand = self.cloth_region(lower_end=0.75)
        self.wait_for("a torn cloth", lambda p: p.changed(before, without_hand) > 0.05 and
                      self.torn(p) > 30)
        self.keep("before_restore")
        self.node.tell("pause")

        self.click("restore")

        self.wait_until("the saved state", lambda: self.node.status().state_hash == whole)
        self.wait_for("the picture from before", lambda p: p.changed(before, without_hand) < 0.001)
        self.keep("restored")

    def test_11_shows_the_new_cloth_of_a_node_that_was_killed(self):
        self.tear()
        self.wait_for("a torn cloth", lambda p: self.torn(p) > 30)

        self.node.end(signal.SIGKILL)

        self.wait_for("a warning", lambda p: p.has_sign(WARNING))
        self.keep("node_killed")
        whole = self.wait_for("a whole one", lambda p: self.torn(p) == 0 and
                              p.shows(SHIPPED.values(), self.scene, least=4000))
        self.assertFalse(whole.has_sign(ERROR), "a status is red")
        self.wait_for("no warning", lambda p: not p.has_sign(WARNING))

    def test_12_warns_while_the_node_is_not_there(self):
        self.node.end(signal.SIGINT)
        self.wait_for("a warning", lambda p: p.has_sign(WARNING))
        self.keep("node_gone")

        picture = self.wait_for("its cloth", lambda p: not p.has_sign(WARNING) and
                                p.shows(SHIPPED.values(), self.scene, least=4000))
        self.keep("node_back")
        self.assertFalse(picture.has_sign(ERROR), "a status is red")

    def write_state_name(self, name):
        left, top, right, bottom = self.widget(FIELDS["state_name"])
        self.pointer.click((left + right) // 2, (top + bottom) // 2)
        self.pointer.focus("RViz")
        self.pointer.key("ctrl+a")
        self.pointer.write(name)

    def test_13_a_long_name_is_wrapped_and_the_panel_keeps_its_width(self):
        self.write_state_name(110 * "W")

        self.click("save")

        def lines(panels):
            box = panels.box(TEXTS["answer"], tolerance=0)
            return box is not None and box[3] - box[1] > 25

        panels = self.wait_until("the answer", lambda: lines(self.panels()) and self.panels())
        self.keep("long_name")
        self.assertEqual(panels.count(SCROLL_BAR, tolerance=0), 0)

    def test_14_a_refusal_goes_after_a_while_and_with_a_reset(self):
        def refused():
            return self.panels().count(PROBLEM, tolerance=0) > 0

        self.write_state_name("nothing")
        self.click("restore")
        self.wait_until("a refusal", refused)
        self.keep("refused")
        self.wait_until("it goes", lambda: not refused())

        self.click("restore")
        self.wait_until("a refusal", refused)
        self.node.tell("reset")
        self.wait_until("it goes at once", lambda: not refused(), patience=5.0)


if __name__ == "__main__":
    run("rviz_view", RvizView)
