#!/usr/bin/env python3
"""The display cloth_tearing/Cloth in a running rviz: what it shows of messages, good and bad."""
import math
import pathlib
import tempfile

import rospy
import yaml
from cloth_tearing.msg import ClothSurface, GraspState, GraspStates, HeldParticle, SimulationStatus
from geometry_msgs.msg import TransformStamped
from rosgraph_msgs.msg import Log
from tf2_msgs.msg import TFMessage

from rviz_window import ERROR, HEIGHT, SHIPPED, SOURCE, WARNING, WIDTH, RvizTest, run, \
    write_png
import rviz_window

# The quarters of an image of our own: left and right above, left and right below.
QUARTERS = {"magenta": (255, 0, 255), "green": (0, 255, 0), "blue": (0, 0, 255), "cyan": (0, 255, 255)}
SIZE = 0.5  # of each cloth [m]
HIGH_UP, LOWER = (-1.1, 1.1), (-1.1, 0.8)  # where the first cloth is, x and z [m]

# Looks along y: x is to the right, z is up.
CAMERA = {"Class": "rviz/Orbit", "Name": "Current View", "Distance": 2.4, "Field of View": 0.785398,
          "Focal Point": {"X": 0.0, "Y": 0.0, "Z": 0.9}, "Pitch": 0.0, "Yaw": -0.5 * math.pi,
          "Target Frame": "<Fixed Frame>"}

# The ends of the colours of strain, and what they stand for.
LOW, MIDDLE, HIGH = (26, 64, 217), (255, 255, 255), (217, 26, 26)
PLAIN, WIRES = (250, 240, 200), (10, 120, 60)
TORN, WEAK, HELD, PINNED = (217, 13, 89), (255, 217, 0), (26, 166, 64), (60, 70, 90)
ARROW = (225, 95, 20)


def words(color):
    """A colour as rviz writes it."""
    return "; ".join(map(str, color))


def mark(shown, color, name="Size", size=0.06):
    return {"Value": shown, "Color": words(color), name: size}


def display(name, **properties):
    return {"Class": "cloth_tearing/Cloth", "Name": name, "Enabled": True, "Value": True,
            "Topic": f"/{name.lower()}/surface", **properties}


def displays(image):
    """Beside the shipped display, one for each way of drawing."""
    plain = {"Value": "Plain", "Plain Color": words(PLAIN)}

    def marks(shown):
        return {"Coloring": plain,
                "Torn Edges": mark(shown, TORN, "Width", 0.02),
                "Weak Points": mark(shown, WEAK),
                "Held Patches": dict(mark(shown, HELD), **{"Pinned Color": words(PINNED)})}

    return [
        display("Second", Coloring={"Value": "Texture", "Texture Image": str(image)}),
        display("Strain", Coloring={"Value": "Strain", "Lowest Strain": 0.1, "Highest Strain": 0.2}),
        display("Wires", Coloring=plain, Wireframe={"Value": True, "Color": words(WIRES), "Alpha": 1.0}),
        display("Faint", Coloring=plain, Wireframe={"Value": True, "Color": words(WIRES)}),
        display("Marked", **marks(True)),
        display("Bare", **marks(False)),
        display("Pulled", Coloring=plain, Forces={"Value": True, "Color": words(ARROW), "Scale": 0.1}),
    ]


def make_view(image):
    """The shipped view with the shipped display first and open, others after it, and a camera that
    looks at all of them."""
    view = yaml.safe_load((SOURCE / "config/cloth.rviz").read_text())
    manager = view["Visualization Manager"]
    shipped = next(d for d in manager["Displays"] if d["Class"] == "cloth_tearing/Cloth")
    manager["Displays"] = [shipped] + displays(image)
    manager["Views"]["Current"] = CAMERA
    panel = next(p for p in view["Panels"] if p["Class"] == "rviz/Displays")
    panel["Property Tree Widget"] = {"Expanded": [f"/{shipped['Name']}1"], "Splitter Ratio": 0.5}
    view["Panels"] = [panel]
    view["Window Geometry"] = {"Width": WIDTH, "Height": HEIGHT, "X": 0, "Y": 0}
    return view


def write_quarters(path, size=64):
    """An image in the four colours."""
    colors = rviz_window.numpy.array(list(QUARTERS.values()), "uint8").reshape(2, 2, 3)
    write_png(path, colors.repeat(size // 2, axis=0).repeat(size // 2, axis=1))


def square(x, z, frame="world", gap=0.0, behind=False):
    """A cloth that faces the camera with its front or its back; torn apart by a gap. Its particles
    0 to 3 are the corners of its left half, 4 to 7 those of its right half, each from below on the
    left counter-clockwise."""
    message = ClothSurface()
    message.header.frame_id = frame
    message.revision = 1 if gap else 0
    message.origin.x = x
    message.origin.z = z
    halves = [(0.0, 0.5, 0.0), (0.5, 1.0, gap)]  # from u to u, and how far it is moved
    for left, right, shift in halves:
        first = len(message.positions) // 3
        for u, v in ((left, 0.0), (right, 0.0), (right, 1.0), (left, 1.0)):
            message.positions += [SIZE * u + shift, 0.0, SIZE * v]
        for corners in ((0, 1, 2), (0, 2, 3)):
            if behind:
                corners = corners[::-1]
            message.triangles += [first + c for c in corners]
            for c in corners:
                message.uv += [right if c in (1, 2) else left, 1.0 if c > 1 else 0.0]
    particles = len(message.positions) // 3
    message.strain = [0.0] * particles
    message.parents = [p for p in range(particles) for _ in range(2)]
    return message


def strained_square(x, z):
    """One with more strain from left to right, beyond the range of the display on both sides."""
    message = square(x, z)
    message.strain = [0.0, 0.15, 0.15, 0.1, 0.15, 0.2, 9.0, 0.15]
    return message


def marked_square(x, z):
    """One with a torn edge in its middle and a weak, a grasped and a pinned corner."""
    message = square(x, z)
    message.torn_edges = [1, 2]
    message.weak_points = [3]
    message.held = [HeldParticle(particle=0, grasp=1), HeldParticle(particle=6, grasp=0)]
    return message


def pull(x, z, force):
    """A gripper at a place, with the force of the cloth on it [N]."""
    grasp = GraspState(grasp_id=1)
    grasp.pose.position.x, grasp.pose.position.z = x, z
    grasp.pose.orientation.w = 1.0
    grasp.wrench.force.x, grasp.wrench.force.z = force
    message = GraspStates(grasps=[grasp])
    message.header.frame_id = "world"
    return message


class Listener(rospy.SubscribeListener):
    """Counts who subscribes."""

    def __init__(self):
        self.count = 0

    def peer_subscribe(self, *_):
        self.count += 1


class ClothDisplay(RvizTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        image = pathlib.Path(folder.name) / "quarters.png"
        write_quarters(image)
        cls.open(make_view(image))
        cls.publishers = {}
        cls.said = []
        cls.log = rospy.Subscriber("/rosout", Log, lambda line: cls.said.append(line.msg))
        cls.publish("cloth", square(*HIGH_UP))
        cls.publish("second", square(-0.5, 0.2, frame="shelf", behind=True))
        cls.publish("strain", strained_square(0.3, 0.1))
        cls.publish("wires", square(-0.3, 0.1))
        cls.publish("faint", square(0.82, 0.1))
        cls.publish("marked", marked_square(0.3, 0.75))
        cls.publish("bare", marked_square(-0.9, 0.1))
        cls.publish("pulled", square(0.0, -5.0))  # out of sight

    @classmethod
    def publish(cls, name, message, topic="surface", listener=None):
        key = f"/{name}/{topic}"
        if key not in cls.publishers:
            cls.publishers[key] = rospy.Publisher(key, type(message), listener, queue_size=10, latch=True)
        cls.publishers[key].publish(message)

    @classmethod
    def publish_anew(cls, name, message, listener=None):
        """As a node does that was started again."""
        cls.publishers.pop(f"/{name}/surface").unregister()
        cls.publish(name, message, listener=listener)

    def reset_rviz(self):
        """By the button below the panel."""
        self.pointer.click(28, HEIGHT - 14)

    def region(self, x, z, width=SIZE, height=SIZE, margin=0.03):
        """Where a part of the plane y = 0 is drawn, with a margin [m]."""
        left, top = self.camera.pixel(x - margin, 0.0, z + height + margin)
        right, bottom = self.camera.pixel(x + width + margin, 0.0, z - margin)
        return (left, top, right, bottom)

    def cloth_is_at(self, picture, place):
        """Whether the shipped image is drawn there and not at the other of its two places."""
        parts = {HIGH_UP: self.region(-1.1, 1.35, height=0.25, margin=0.0),
                 LOWER: self.region(-1.1, 0.8, height=0.25, margin=0.0)}
        part = parts.pop(place)
        other, = parts.values()
        return (picture.shows(SHIPPED.values(), part) and
                not any(picture.count(color, other) for color in SHIPPED.values()))

    def test_01_shows_the_shipped_image_and_another_on_two_cloths_at_once(self):
        picture = self.wait_for("both images", lambda p: self.cloth_is_at(p, HIGH_UP) and
                                p.shows(QUARTERS.values(), self.region(-0.5, 1.1)))

        self.keep("two")
        self.assertFalse(picture.has_sign(ERROR), "a status is red")
        # The image is upright and not mirrored, and the frame of the second is raised by tf.
        middles = {name: picture.middle(color, self.scene) for name, color in QUARTERS.items()}
        self.assertLess(middles["magenta"][0], middles["green"][0])
        self.assertLess(middles["blue"][0], middles["cyan"][0])
        self.assertLess(middles["magenta"][1], middles["blue"][1])
        self.assertLess(middles["green"][1], middles["cyan"][1])

    def test_02_keeps_the_texture_on_both_sides_of_a_tear(self):
        before = self.screen.picture()
        self.publish("second", square(-0.5, 0.2, frame="shelf", behind=True, gap=0.1))

        def apart(picture):
            return (picture.shows(QUARTERS.values(), self.scene) and
                    picture.box(QUARTERS["green"], self.scene)[0] >
                    picture.box(QUARTERS["magenta"], self.scene)[2] + 20)

        after = self.wait_for("the halves apart", apart)

        self.keep("torn")
        for name, color in QUARTERS.items():  # nothing lost
            self.assertGreater(after.count(color, self.scene), 0.8 * before.count(color, self.scene), name)

    def test_03_drops_a_malformed_message_with_its_reason(self):
        for field, value in (("positions", math.nan), ("uv", math.inf), ("triangles", 99)):
            bad = square(*HIGH_UP)
            getattr(bad, field)[4] = value
            self.publish("cloth", bad)

        picture = self.wait_for("a red status", lambda p: p.has_sign(ERROR))

        self.keep("malformed")
        self.assertTrue(self.cloth_is_at(picture, HIGH_UP), "the cloth before it stays")
        reason = "triangles[4] is 99, must be below 8"
        self.wait_until("the reason", lambda: any(reason in line for line in self.said))

    def test_04_is_well_again_with_the_next_good_message(self):
        self.publish("cloth", square(*HIGH_UP))

        self.wait_for("no red status",
                      lambda p: not p.has_sign(ERROR) and self.cloth_is_at(p, HIGH_UP))

    def test_05_warns_when_the_node_is_gone_and_goes_on_when_it_is_back(self):
        self.publishers.pop("/cloth/surface").unregister()
        self.wait_for("a warning",
                      lambda p: p.has_sign(WARNING) and self.cloth_is_at(p, HIGH_UP))
        self.keep("gone")

        self.publish("cloth", square(*LOWER))

        picture = self.wait_for("the cloth of the new node", lambda p: not p.has_sign(WARNING) and
                                self.cloth_is_at(p, LOWER))
        self.assertFalse(picture.has_sign(ERROR))

    def test_05_warns_when_the_status_of_a_node_stays_away_though_it_seems_to_publish(self):
        def tell_status():
            self.publish("cloth", SimulationStatus(), "status")  # as a node does ten times a second

        picture = self.wait_for("listening", lambda _: tell_status() or
                                self.publishers["/cloth/status"].get_num_connections() > 0)
        self.assertFalse(picture.has_sign(WARNING))
        self.wait_for("a warning", lambda p: p.has_sign(WARNING) and self.cloth_is_at(p, LOWER))
        self.keep("killed")

        picture = self.wait_for("no warning", lambda p: tell_status() or not p.has_sign(WARNING))

        self.assertFalse(picture.has_sign(ERROR))
        self.publishers.pop("/cloth/status").unregister()
        self.reset_rviz()

    def test_06_colours_by_strain_between_the_ends_of_the_range(self):
        ends = {LOW: 0.3, MIDDLE: 0.3 + 0.5 * SIZE, HIGH: 0.3 + SIZE}  # where on x they have to be [m]
        strips = {color: self.region(x - 0.01, 0.1, width=0.02, margin=0.0) for color, x in ends.items()}

        def fill(picture):
            """Half of the strip for the colours at the borders."""
            return all(picture.count(color, (left, top, right, bottom)) > 0.4 * (right - left) * (bottom - top)
                       for color, (left, top, right, bottom) in strips.items())

        self.wait_for("blue, white and red from left to right", fill)

    def test_07_draws_the_wireframe_over_the_cloth(self):
        where = self.region(-0.3, 0.1)

        picture = self.wait_for("wires", lambda p: p.shows((WIRES,), where, least=300))

        self.assertTrue(picture.shows((PLAIN,), where, least=5000), "cloth between them")
        box = picture.box(WIRES, where)
        self.assertGreater(box[2] - box[0], 0.8 * (where[2] - where[0]))
        self.assertGreater(box[3] - box[1], 0.8 * (where[3] - where[1]))

    def test_07_lets_the_cloth_show_through_the_wires_unless_told_otherwise(self):
        where = self.region(0.82, 0.1)
        twice = tuple(round(plain + (wire - plain) * (1.0 - 0.65 ** 2)) for wire, plain in zip(WIRES, PLAIN))

        picture = self.wait_for("faint wires", lambda p: p.count(twice, where, tolerance=20) > 100)

        self.keep("faint_wires")
        self.assertLess(picture.count(WIRES, where), 20)

    def test_08_draws_torn_edges_weak_points_and_held_particles_only_where_they_are_wanted(self):
        marked, bare = self.region(0.3, 0.75), self.region(-0.9, 0.1)
        marks = (TORN, WEAK, HELD, PINNED)

        picture = self.wait_for("all marks", lambda p: p.shows(marks, marked, least=60) and
                                p.shows((PLAIN,), bare, least=5000))

        self.keep("styles")
        for color in marks:
            self.assertEqual(picture.count(color, bare), 0, color)
        self.assertLess(picture.middle(HELD, marked)[0], picture.middle(TORN, marked)[0])
        self.assertLess(picture.middle(WEAK, marked)[1], picture.middle(TORN, marked)[1])

    def test_09_draws_the_force_on_a_gripper_as_long_as_it_is_large(self):
        self.publish("pulled", pull(0.5, 1.4, force=(3.0, 0.0)), "grasp_states")
        around = self.region(0.4, 1.3, 0.5, 0.2)

        def width(picture):
            box = picture.box(ARROW, around, tolerance=60)
            return box[2] - box[0] if box else 0

        metre = (around[2] - around[0]) / 0.56
        picture = self.wait_for("an arrow of 0.3 m", lambda p: abs(width(p) - 0.3 * metre) < 0.05 * metre)
        self.keep("force")
        self.assertLess(abs(picture.box(ARROW, around, tolerance=60)[0] - (around[0] + 0.13 * metre)),
                        0.03 * metre, "it begins at the gripper")
        self.publish("pulled", pull(0.5, 1.4, force=(1.0, 0.0)), "grasp_states")
        self.wait_for("a third of it", lambda p: abs(width(p) - 0.1 * metre) < 0.03 * metre)
        self.publish("pulled", GraspStates(header=pull(0, 0, (0, 0)).header), "grasp_states")
        self.wait_for("none", lambda p: width(p) == 0)

    def test_10_keeps_a_cloth_at_rest_through_a_reset_of_rviz(self):
        listener = Listener()
        self.publish_anew("cloth", square(*HIGH_UP), listener)
        self.wait_for("the cloth", lambda p: self.cloth_is_at(p, HIGH_UP))
        before = listener.count

        self.reset_rviz()

        self.wait_until("it has subscribed anew", lambda: listener.count > before)
        picture = self.wait_for("the cloth", lambda p: self.cloth_is_at(p, HIGH_UP) and
                                not p.has_sign(WARNING))
        self.assertFalse(picture.has_sign(ERROR))

    def test_11_goes_to_another_topic(self):
        self.publish("other", square(*LOWER))
        self.pointer.focus("RViz")
        self.pointer.click(self.scene[0] // 4, 94)  # into the tree
        self.pointer.key("Home", *4 * ["Down"], "F2")  # Global Options, Global Status, Cloth, Status, Topic
        self.pointer.key("ctrl+a")
        self.pointer.write("/other/surface")
        self.pointer.key("Return")

        picture = self.wait_for("the other cloth alone", lambda p: self.cloth_is_at(p, LOWER))

        self.keep("other_topic")
        self.assertFalse(picture.has_sign(ERROR))

    def test_12_goes_with_a_frame_that_becomes_known_and_moves_though_no_message_comes(self):
        self.publish("second", square(-0.5, 0.2, frame="cart"))
        self.wait_for("a red status and no cloth", lambda p: p.has_sign(ERROR) and
                      p.count(QUARTERS["magenta"], self.scene) == 0)
        frames = rospy.Publisher("/tf", TFMessage, queue_size=10)

        def middle(picture):
            found = picture.count(QUARTERS["magenta"], self.scene) > 500
            return picture.middle(QUARTERS["magenta"], self.scene)[0] if found else None

        def drive(x):
            transform = TransformStamped()
            transform.header.frame_id, transform.child_frame_id = "world", "cart"
            transform.header.stamp = rospy.Time.now()
            transform.transform.translation.x, transform.transform.translation.z = x, 0.9
            transform.transform.rotation.w = 1.0
            frames.publish(TFMessage([transform]))

        def stands(picture, x):
            drive(x)  # again: rviz may not have listened yet
            left = self.camera.pixel(x - 0.5, 0.0, 1.35)[0]
            right = self.camera.pixel(x - 0.25, 0.0, 1.35)[0]
            return middle(picture) is not None and abs(middle(picture) - 0.5 * (left + right)) < 12

        self.wait_for("the cloth on the cart", lambda p: stands(p, 0.0) and not p.has_sign(ERROR))

        self.wait_for("the cloth where the cart has gone", lambda p: stands(p, 0.4))


if __name__ == "__main__":
    run("cloth_display", ClothDisplay)
