"""What tests with a running rviz share: a display of their own, its pictures, a pointer and keys."""
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
import xml.etree.ElementTree as ElementTree
import zlib

import rospkg
import rospy
import rostest
import yaml

try:
    import numpy
except ImportError:  # told by missing()
    numpy = None

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PLUGIN = "libcloth_tearing_rviz.so"
PROGRAMS = ("rviz", "Xvfb", "xdotool")
PATIENCE = 25.0            # for anything that has to appear [s]
POLL = 0.03                # between two looks [s]
WIDTH, HEIGHT = 1280, 800  # of the display and of rviz's window [pixels]
STEP = 8                   # of the pointer on its way [pixels]

BACKGROUND = (232, 234, 238)  # of the shipped view
# What the shipped image has at least.
SHIPPED = {"ochre": (224, 148, 31), "navy": (26, 82, 148)}
# The signs beside the name of a display in the Displays panel.
ERROR, WARNING = (192, 32, 32), (192, 128, 0)
LEAST_SIGN = 32  # so much of the colour has no other icon [pixels]


def start(command, **options):
    """A process that ends with this one, however that ends: rviz would draw on for nobody."""
    return subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *command], **options)


def write_png(path, pixels):
    """Writes rows of pixels with red, green and blue of 8 bits each."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    pathlib.Path(path).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
        chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Picture:
    """What was on a display. A region is (left, top, right, bottom); places are (x, y) [pixels]."""

    def __init__(self, pixels):
        self.pixels = pixels

    def _part(self, region):
        left, top, right, bottom = region or (0, 0, self.pixels.shape[1], self.pixels.shape[0])
        return self.pixels[top:bottom, left:right].astype(numpy.int16), (left, top)

    def find(self, color, region=None, tolerance=40):
        """Where pixels of about that colour are, each a row x, y."""
        part, corner = self._part(region)
        near = (abs(part - numpy.array(color, numpy.int16)) <= tolerance).all(axis=2)
        return numpy.argwhere(near)[:, ::-1] + corner

    def count(self, color, region=None, tolerance=40):
        return len(self.find(color, region, tolerance))

    def middle(self, color, region=None):
        return tuple(self.find(color, region).mean(axis=0))

    def box(self, color, region=None, tolerance=40):
        """The smallest region that has all pixels of about that colour; None if there are none."""
        found = self.find(color, region, tolerance)
        if len(found) == 0:
            return None
        return (*found.min(axis=0), *(found.max(axis=0) + 1))

    def shows(self, colors, region=None, least=800):
        return all(self.count(color, region) >= least for color in colors)

    def changed(self, other, region=None, least=24):
        """Which part of the pixels is another than in the other picture [-]."""
        here, there = self._part(region)[0], other._part(region)[0]
        return (abs(here - there).max(axis=2) >= least).mean()

    def without(self, region):
        """The same picture with a region left black."""
        left, top, right, bottom = region
        pixels = self.pixels.copy()
        pixels[top:bottom, left:right] = 0
        return Picture(pixels)

    def scene(self):
        """The region in which rviz draws, by its background; None if there is none."""
        empty = (self.pixels == numpy.array(BACKGROUND, numpy.uint8)).all(axis=2)
        columns = numpy.flatnonzero(empty.mean(axis=0) > 0.2)  # a swatch in the panel is smaller
        rows = numpy.flatnonzero(empty.mean(axis=1) > 0.1)
        if len(columns) == 0 or len(rows) == 0:
            return None
        return (columns[0], rows[0], columns[-1] + 1, rows[-1] + 1)

    def has_sign(self, color):
        """Whether a panel shows one."""
        return self.without(self.scene()).count(color, tolerance=2) >= LEAST_SIGN

    def save(self, path):
        write_png(path, self.pixels)


class Camera:
    """Where an Orbit view of a .rviz file draws things in its region of a picture."""

    def __init__(self, view, scene):
        orbit = view["Visualization Manager"]["Views"]["Current"]
        yaw, pitch = orbit["Yaw"], orbit["Pitch"]
        focal = numpy.array([orbit["Focal Point"][axis] for axis in "XYZ"])
        backwards = numpy.array([math.cos(yaw) * math.cos(pitch), math.sin(yaw) * math.cos(pitch),
                                 math.sin(pitch)])
        right = numpy.array([-math.sin(yaw), math.cos(yaw), 0.0])
        self._axes = numpy.array([right, numpy.cross(backwards, right), backwards])
        self._eye = focal + orbit["Distance"] * backwards
        left, top, end, bottom = scene
        self._middle = (0.5 * (left + end), 0.5 * (top + bottom))
        self._scale = 0.5 * (bottom - top) / math.tan(0.5 * orbit["Field of View"])

    def pixel(self, x, y, z):
        """Of a place in the fixed frame [m]."""
        across, up, backwards = self._axes @ (numpy.array((x, y, z)) - self._eye)
        scale = self._scale / -backwards
        return (round(self._middle[0] + scale * across), round(self._middle[1] - scale * up))


class Screen:
    """An X display of its own, looked at through the file in which Xvfb keeps its pixels."""

    def __init__(self, folder):
        self._process = start(
            ["Xvfb", "-displayfd", "1", "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nolisten", "tcp",
             "-fbdir", str(folder)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.display = ":" + self._process.stdout.readline().decode().strip()
        self._file = pathlib.Path(folder) / "Xvfb_screen0"

    def picture(self):
        content = self._file.read_bytes()  # an XWD file
        header_size, *_ = header = struct.unpack(">25I", content[:100])
        height, row_size, colors = header[5], header[12], header[19]
        rows = numpy.frombuffer(content, numpy.uint8, height * row_size, header_size + 12 * colors)
        blue_green_red = rows.reshape(height, row_size // 4, 4)[:, :WIDTH, :3]
        return Picture(blue_green_red[:, :, ::-1].copy())

    def close(self):
        self._process.kill()
        self._process.wait(PATIENCE)
        self._process.stdout.close()


class Pointer:
    """The mouse and the keys of a display."""

    def __init__(self, display):
        self._environment = dict(os.environ, DISPLAY=display)
        self._at = (0, 0)

    def _do(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self._environment, check=True,
                       timeout=PATIENCE, stdout=subprocess.DEVNULL)

    def focus(self, window):
        """Gives the keys to the window whose title has that in it: no window manager does."""
        self._do("search", "--onlyvisible", "--name", window, "windowfocus")

    def move(self, x, y, at_each_step=None):
        """Goes straight to a place in small steps; calls the function, if there is one, after each."""
        start, end = numpy.array(self._at), numpy.array((x, y))
        steps = max(1, int(abs(end - start).max()) // STEP)
        way = [tuple((start + (end - start) * (i + 1) // steps).tolist()) for i in range(steps)]
        if at_each_step:
            for place in way:
                self._do("mousemove", *place)
                at_each_step()
        else:
            self._do(*(word for place in way for word in ("mousemove", *place)))
        self._at = way[-1]

    def press(self, button=1):
        self._do("mousedown", button)

    def release(self, button=1):
        self._do("mouseup", button)

    def click(self, x, y, button=1):
        self.move(x, y)
        self.press(button)
        self.release(button)

    def wheel(self, clicks):
        """Up is positive."""
        for _ in range(abs(clicks)):
            self._do("click", 4 if clicks > 0 else 5)

    def key(self, *names):
        self._do("key", *names)

    def hold(self, key):
        self._do("keydown", key)

    def let_go(self, key):
        self._do("keyup", key)

    def write(self, text):
        self._do("type", text)


class RvizTest(unittest.TestCase):
    """One rviz for all tests of a class, in turn: starting it takes the longest."""

    @classmethod
    def open(cls, view, environment=None, style=""):
        """Opens rviz on a view: the path of a file, or what is to be written into one. The
        environment is its own, or else that of the test; the style is one of Qt's style sheets."""
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        home = pathlib.Path(folder.name)
        if isinstance(view, pathlib.Path):
            path, cls.view = view, yaml.safe_load(view.read_text())
        else:
            path, cls.view = home / "view.rviz", view
            path.write_text(yaml.safe_dump(view))
        cls.screen = Screen(home)
        cls.addClassCleanup(cls.screen.close)
        style_sheet = home / "style.qss"
        style_sheet.write_text(style)
        cls.rviz = start(
            ["rviz", "-stylesheet", str(style_sheet), "-d", str(path), "__name:=rviz"],
            env=dict(environment or os.environ, DISPLAY=cls.screen.display, LIBGL_ALWAYS_SOFTWARE="1",
                     QT_QPA_PLATFORM="xcb", HOME=folder.name, XDG_RUNTIME_DIR=folder.name))
        cls.addClassCleanup(cls._close)
        cls.pointer = Pointer(cls.screen.display)
        cls.pictures = pictures_folder()

    @classmethod
    def _close(cls):
        cls.rviz.kill()
        cls.rviz.wait(PATIENCE)

    def wait_until(self, what, condition, patience=PATIENCE):
        """What the condition returned when it was fulfilled."""
        deadline = time.monotonic() + patience
        while time.monotonic() < deadline:
            self.assertIsNone(self.rviz.poll(), "rviz has died")
            fulfilled = condition()
            if fulfilled:
                return fulfilled
            time.sleep(POLL)
        self.keep("failed_" + self.id().rsplit(".", 1)[-1])
        self.fail("not in time: " + what)

    def wait_for(self, what, condition, patience=PATIENCE):
        """The first picture that fulfils the condition."""
        def look():
            picture = self.screen.picture()
            return picture if condition(picture) else None

        return self.wait_until(what, look, patience)

    def setUp(self):
        """Waits until rviz draws, and notes in which region."""
        self.scene = self.wait_for("rviz's window", Picture.scene).scene()
        self.camera = Camera(self.view, self.scene)

    def keep(self, name):
        """Keeps a picture for who wants to look."""
        self.screen.picture().save(self.pictures / f"{self.program}_{name}.png")


def pictures_folder():
    """Where pictures are kept: as the environment says, else beside the results of the tests."""
    folder = pathlib.Path(os.environ.get("CLOTH_TEARING_PICTURES") or
                          results_file().parent / "pictures")
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def results_file():
    """The file that rostest wants the results in; by hand, one where it keeps its own."""
    flag = "--gtest_output=xml:"
    for argument in sys.argv:
        if argument.startswith(flag):
            return pathlib.Path(argument[len(flag):])
    return pathlib.Path(rospkg.get_test_results_dir()) / "cloth_tearing" / "rosunit.xml"


def missing():
    """What has to be there for these tests, and is not."""
    found = [program for program in PROGRAMS if not shutil.which(program)]
    if not any(pathlib.Path(prefix, "lib", PLUGIN).exists()
               for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":")):
        found.append("the plugin: it is built where rviz and Qt are found")
    if numpy is None:
        found.append("numpy for Python")
    return found


def report_skipped(test_case, reason):
    """Writes the results that rosunit would, which knows no skipped ones and calls them passed."""
    names = unittest.TestLoader().getTestCaseNames(test_case)
    suite = ElementTree.Element("testsuite", name=test_case.__name__, tests=str(len(names)),
                                failures="0", errors="0", time="0")
    for name in names:
        case = ElementTree.SubElement(suite, "testcase", classname=test_case.__name__, name=name,
                                      time="0")
        ElementTree.SubElement(case, "skipped", message=reason)
    results_file().parent.mkdir(parents=True, exist_ok=True)
    ElementTree.ElementTree(suite).write(results_file(), encoding="utf-8", xml_declaration=True)
    print(f"{test_case.__name__}: SKIPPED, {reason}")


def run(program, test_case, lacking=()):
    """Runs the tests of a program that rostest started, unless they lack something."""
    test_case.program = program
    lacking = [*missing(), *lacking]
    if lacking:
        report_skipped(test_case, "tests in rviz lack " + ", ".join(lacking))
        return
    rospy.init_node(program + "_test")
    rostest.rosrun("cloth_tearing", program, test_case, sys.argv)
