#!/usr/bin/env python3
"""The display cloth_tearing/Cloth in a running rviz: what it shows of messages, good and bad."""
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

import rospy
import rostest
from cloth_tearing.msg import ClothSurface
from rosgraph_msgs.msg import Log

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PATIENCE = 25.0  # for anything that has to appear [s]
NEEDED = ("rviz", "Xvfb", "import")
WIDTH, HEIGHT = 1280, 800  # of the window in config/cloth.rviz [pixels]
PANEL = 342                # width of its Displays panel [pixels]
TOP = 88                   # where the panel's lines begin [pixels]
SAMPLING = 2               # one of so many pixels across and down is looked at

# The quarters of an image of our own: left and right above, left and right below.
QUARTERS = {"magenta": (255, 0, 255), "green": (0, 255, 0), "blue": (0, 0, 255), "cyan": (0, 255, 255)}
# What the shipped image has at least.
SHIPPED = {"ochre": (224, 148, 31), "navy": (26, 82, 148)}
# The signs beside the name of a display in the panel.
ERROR, WARNING = (192, 32, 32), (192, 128, 0)

SECOND_DISPLAY = """    - Class: cloth_tearing/Cloth
      Name: Second
      Enabled: true
      Topic: /second/surface
      Coloring:
        Value: Texture
        Texture Image: {image}
      Value: true
"""


def write_quarters(path, size=64):
    """An image in the four colours."""
    colors = [bytes(color) for color in QUARTERS.values()]
    rows = b""
    for y in range(size):
        left, right = colors[:2] if y < size // 2 else colors[2:]
        rows += b"\0" + left * (size // 2) + right * (size // 2)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def square(x, z, frame="world", gap=0.0, behind=False):
    """A square of 0.5 m that faces the camera with its front or its back; torn apart by a gap."""
    message = ClothSurface()
    message.header.frame_id = frame
    message.revision = 1 if gap else 0
    message.origin.x = x
    message.origin.z = z
    halves = [(0.0, 0.25, 0.0), (0.25, 0.5, gap)]  # from u to u, and how far it is moved
    for left, right, shift in halves:
        first = len(message.positions) // 3
        for u, v in ((left, 0.0), (right, 0.0), (right, 0.5), (left, 0.5)):
            message.positions += [u + shift, 0.0, v]
        for corners in ((0, 1, 2), (0, 2, 3)):
            if behind:
                corners = corners[::-1]
            message.triangles += [first + c for c in corners]
            for c in corners:
                message.uv += [2 * (right if c in (1, 2) else left), 1.0 if c > 1 else 0.0]
    particles = len(message.positions) // 3
    message.strain = [0.0] * particles
    message.parents = [p for p in range(particles) for _ in range(2)]
    return message


class Picture:
    """What is on the display."""

    def __init__(self, display):
        ppm = subprocess.run(["import", "-display", display, "-window", "root", "-depth", "8", "ppm:-"],
                             check=True, stdout=subprocess.PIPE, timeout=PATIENCE).stdout
        head, self.pixels = ppm[:15], ppm[-3 * WIDTH * HEIGHT:]
        assert head.split()[1:3] == [str(WIDTH).encode(), str(HEIGHT).encode()], head

    def find(self, color, left=PANEL, right=WIDTH, tolerance=40):
        """Where pixels of about that colour are."""
        found = []
        for y in range(TOP, HEIGHT, SAMPLING):
            row = self.pixels[3 * WIDTH * y:3 * WIDTH * (y + 1)]
            for x in range(left, right, SAMPLING):
                if all(abs(row[3 * x + c] - color[c]) <= tolerance for c in range(3)):
                    found.append((x, y))
        return found

    def middle(self, color):
        found = self.find(color)
        return tuple(sum(p[axis] for p in found) / len(found) for axis in range(2))

    def shows(self, colors, least=200):
        return all(len(self.find(color)) >= least for color in colors.values())

    def panel_has(self, color):
        found = self.find(color, left=0, right=PANEL, tolerance=2)
        return len(found) >= 8  # no other icon has so much of it


@unittest.skipUnless(all(map(shutil.which, NEEDED)), "needs " + ", ".join(NEEDED))
class ClothDisplay(unittest.TestCase):
    """One rviz for all of it, in turn: starting it takes the longest."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        image = pathlib.Path(cls.folder.name) / "quarters.png"
        write_quarters(image)
        cls.xvfb = subprocess.Popen(
            ["Xvfb", "-displayfd", "1", "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nolisten", "tcp"],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        cls.display = ":" + cls.xvfb.stdout.readline().decode().strip()

        shipped = (SOURCE / "config/cloth.rviz").read_text()
        before, marker, after = shipped.partition("    - Class: rviz/MarkerArray\n")
        view = pathlib.Path(cls.folder.name) / "view.rviz"
        view.write_text(before + SECOND_DISPLAY.format(image=image) + marker + after)
        environment = dict(os.environ, DISPLAY=cls.display, LIBGL_ALWAYS_SOFTWARE="1",
                           QT_QPA_PLATFORM="xcb", HOME=cls.folder.name,
                           XDG_RUNTIME_DIR=cls.folder.name)
        cls.rviz = subprocess.Popen(["rviz", "-d", str(view), "__name:=rviz"], env=environment)
        cls.publishers = {}
        cls.said = []
        cls.log = rospy.Subscriber("/rosout", Log, lambda line: cls.said.append(line.msg))

    @classmethod
    def tearDownClass(cls):
        for process in (cls.rviz, cls.xvfb):
            process.kill()
            process.wait(PATIENCE)
        cls.folder.cleanup()

    def publish(self, name, message):
        if name not in self.publishers:
            self.publishers[name] = rospy.Publisher(f"/{name}/surface", ClothSurface, queue_size=10,
                                                    latch=True)
        self.publishers[name].publish(message)

    def wait_for(self, what, condition):
        """The first picture that fulfils the condition."""
        deadline = time.monotonic() + PATIENCE
        while time.monotonic() < deadline:
            self.assertIsNone(self.rviz.poll(), "rviz has died")
            picture = Picture(self.display)
            if condition(picture):
                return picture
        self.keep("failed")
        self.fail("not in time: " + what)

    def keep(self, name):
        """A picture for who wants to look, in a folder that the environment names."""
        folder = os.environ.get("CLOTH_TEARING_PICTURES")
        if folder:
            subprocess.run(["import", "-display", self.display, "-window", "root",
                            os.path.join(folder, f"display_{name}.png")], check=True, timeout=PATIENCE)

    def test_1_shows_the_shipped_image_and_another_on_two_cloths_at_once(self):
        self.publish("cloth", square(-0.55, 0.9))
        self.publish("second", square(0.05, 0.0, frame="shelf", behind=True))

        picture = self.wait_for("both images", lambda p: p.shows(SHIPPED) and p.shows(QUARTERS))

        self.keep("two")
        self.assertFalse(picture.panel_has(ERROR), "a status is red")
        # The image is upright and not mirrored, and the frame of the second is raised by tf.
        middles = {name: picture.middle(color) for name, color in QUARTERS.items()}
        self.assertLess(middles["magenta"][0], middles["green"][0])
        self.assertLess(middles["blue"][0], middles["cyan"][0])
        self.assertLess(middles["magenta"][1], middles["blue"][1])
        self.assertLess(middles["green"][1], middles["cyan"][1])
        height = 0.5 * (middles["magenta"][1] + middles["blue"][1])
        self.assertLess(abs(picture.middle(SHIPPED["ochre"])[1] - height), 60)

    def test_2_keeps_the_texture_on_both_sides_of_a_tear(self):
        before = Picture(self.display)
        self.publish("second", square(0.05, 0.0, frame="shelf", behind=True, gap=0.1))

        def apart(picture):
            return (picture.shows(QUARTERS) and
                    min(x for x, _ in picture.find(QUARTERS["green"])) >
                    max(x for x, _ in picture.find(QUARTERS["magenta"])) + 20)

        after = self.wait_for("the halves apart", apart)

        self.keep("torn")
        for name, color in QUARTERS.items():  # nothing lost
            self.assertGreater(len(after.find(color)), 0.8 * len(before.find(color)), name)

    def test_3_drops_a_malformed_message_with_its_reason(self):
        for field, value in (("positions", math.nan), ("uv", math.inf), ("triangles", 99)):
            bad = square(-0.55, 0.9)
            getattr(bad, field)[4] = value
            self.publish("cloth", bad)

        picture = self.wait_for("a red status", lambda p: p.panel_has(ERROR))

        self.keep("malformed")
        self.assertTrue(picture.shows(SHIPPED), "the cloth before it stays")
        reason = "triangles[4] is 99, must be below 8"
        self.wait_for("the reason", lambda _: any(reason in line for line in self.said))

    def test_4_is_well_again_with_the_next_good_message(self):
        self.publish("cloth", square(-0.55, 0.9))

        self.wait_for("no red status", lambda p: not p.panel_has(ERROR) and p.shows(SHIPPED))

    def test_5_warns_when_the_node_is_gone_and_goes_on_when_it_is_back(self):
        self.publishers.pop("cloth").unregister()
        self.wait_for("a warning", lambda p: p.panel_has(WARNING) and p.shows(SHIPPED))
        self.keep("gone")

        self.publish("cloth", square(-0.55, 0.6))

        lower = self.wait_for("the cloth of the new node", lambda p: not p.panel_has(WARNING) and
                              p.shows(SHIPPED) and
                              p.middle(SHIPPED["ochre"])[1] > p.middle(QUARTERS["green"])[1] + 60)
        self.assertFalse(lower.panel_has(ERROR))


if __name__ == "__main__":
    rospy.init_node("cloth_display_test")
    rostest.rosrun("cloth_tearing", "cloth_display", ClothDisplay, sys.argv)
