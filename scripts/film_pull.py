#!/usr/bin/env python3
"""Films how a pointer pulls a cloth in rviz until it tears: one picture for each move of the pointer
and step of the cloth, however long the machine takes to draw it. Started by animation.launch."""
import os
import pathlib
import subprocess
import sys
import time

import rospy
import yaml
from cloth_tearing.msg import ClothSurface, GraspStates, GraspTargets
from cloth_tearing.srv import GetTearEvents, Step

SOURCE = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE / "test"))

from rviz_window import BACKGROUND, HEIGHT, SHIPPED, WIDTH, Pointer, Screen  # noqa: E402

PATIENCE = 60.0       # for anything that has to happen [s]
REST = 2.0            # after which a picture that is still the same is taken for that of a cloth at rest [s]
STEPS = 40            # of the cloth from frame to frame
SETTLE = 2000         # steps before the first frame
KEPT = (640, 480)     # size of a frame [pixels]
CROP = (1066, 800)    # what is kept of the display, from its middle [pixels]
LEAST_TEARS = 30

# The way of the pointer: frames that it takes, where it goes [pixels of the display], and how.
START = (330, 300)
WAY = [
    (10, (650, 400), "hover"),
    (3, (650, 400), "press"),
    (32, (610, 520), "pull"),
    (36, (420, 640), "pull"),
    (3, (420, 640), "pull"),
    (1, (420, 640), "release"),
    (17, (340, 560), "hover"),
]

CAMERA = {"Class": "rviz/Orbit", "Name": "Current View", "Distance": 2.5, "Pitch": 0.12,
          "Yaw": 4.25, "Focal Point": {"X": -0.1, "Y": 0.0, "Z": 0.9}, "Field of View": 0.785398,
          "Near Clip Distance": 0.01, "Target Frame": "<Fixed Frame>"}

GRID = {"Color": "110; 114; 122", "Alpha": 0.8}  # to be seen in few colours

# An arrow, and a ring around what it holds.
ARROW = "M 0,0 L 0,33 L 8,26 L 13,38 L 19,35 L 14,24 L 24,24 Z"


def view():
    """The shipped view without its panels, and with nothing but the cloth over the ground."""
    shipped = yaml.safe_load((SOURCE / "config/cloth.rviz").read_text())
    manager = shipped["Visualization Manager"]
    manager["Displays"] = [display for display in manager["Displays"]
                           if display["Class"] in ("rviz/Grid", "cloth_tearing/Cloth")]
    for display in manager["Displays"]:
        if display["Class"] == "rviz/Grid":
            display.update(GRID)
    manager["Views"] = {"Current": CAMERA}
    return {"Panels": [], "Visualization Manager": manager,
            "Window Geometry": {"Width": WIDTH, "Height": HEIGHT, "X": 0, "Y": 0}}


class Film:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.screen = Screen(self.folder)
        self.pointer = Pointer(self.screen.display)
        self.surface = self.grasps = None
        rospy.Subscriber("/cloth/surface", ClothSurface, self.take_surface, queue_size=1)
        self.targets = 0
        rospy.Subscriber("/cloth/grasp_states", GraspStates, self.take_grasps, queue_size=1)
        rospy.Subscriber("/cloth/grasp_targets", GraspTargets, self.count_target, queue_size=10)
        for name in ("step", "get_tear_events"):
            rospy.wait_for_service(f"/cloth/{name}", PATIENCE)
        self.call_step = rospy.ServiceProxy("/cloth/step", Step)
        self.frames = 0

        path = self.folder / "view.rviz"
        path.write_text(yaml.safe_dump(view()))
        self.rviz = subprocess.Popen(
            ["rviz", "--fullscreen", "-d", str(path), "__name:=rviz"],
            env=dict(os.environ, DISPLAY=self.screen.display, LIBGL_ALWAYS_SOFTWARE="1",
                     QT_QPA_PLATFORM="xcb", HOME=str(self.folder), XDG_RUNTIME_DIR=str(self.folder)))

    def take_surface(self, message):
        self.surface = message

    def take_grasps(self, message):
        self.grasps = message.grasps

    def count_target(self, _message):
        self.targets += 1

    def wait_until(self, what, condition, patience=PATIENCE):
        deadline = time.monotonic() + patience
        while not condition():
            if time.monotonic() > deadline or self.rviz.poll() is not None:
                raise RuntimeError("not in time: " + what)
            time.sleep(0.01)

    def steady(self, patience=PATIENCE):
        """The picture when it does not change any more."""
        deadline = time.monotonic() + patience
        before = self.screen.picture()
        since = time.monotonic()
        while time.monotonic() < deadline:
            time.sleep(0.05)
            picture = self.screen.picture()
            if (picture.pixels != before.pixels).any():
                since = time.monotonic()
            elif time.monotonic() > since + 0.25:
                return picture
            before = picture
        raise RuntimeError("rviz never comes to rest")

    def step(self, steps):
        answer = self.call_step(steps)
        if not answer.success:
            raise RuntimeError("~step: " + answer.message)
        self.wait_until("the surface", lambda: self.surface and self.surface.step == answer.step)

    def begin(self):
        self.step(SETTLE)
        self.wait_until("the cloth in rviz",
                        lambda: self.screen.picture().shows([*SHIPPED.values(), BACKGROUND]))
        self.pointer.focus("RViz")
        self.pointer.move(*START)
        self.pointer.key("l")
        self.last = self.steady().pixels

    def shoot(self, at, pressed):
        """Keeps the picture, with the pointer that the display does not show in its pixels."""
        deadline = time.monotonic() + REST
        while time.monotonic() < deadline and (self.screen.picture().pixels == self.last).all():
            time.sleep(0.02)
        picture = self.steady()
        self.last = picture.pixels
        left = (WIDTH - CROP[0]) // 2
        pixels = picture.pixels[:CROP[1], left:left + CROP[0]]
        head = f"P6 {CROP[0]} {CROP[1]} 255\n".encode()
        ring = "circle 0,0 0,17" if pressed else ""
        x, y = at[0] - left, at[1]
        subprocess.run(
            ["convert", "ppm:-", "-stroke", "#ffffff", "-strokewidth", "3", "-fill", "none",
             "-draw", f"translate {x},{y} {ring}" if ring else "point -1,-1",
             "-fill", "#ffffff", "-stroke", "#202020", "-strokewidth", "2.5",
             "-draw", f"translate {x},{y} path '{ARROW}'", "-resize", f"{KEPT[0]}x{KEPT[1]}!",
             str(self.folder / f"frame_{self.frames:03}.png")],
            input=head + pixels.tobytes(), check=True, timeout=PATIENCE)
        self.frames += 1

    def pull_to(self, place):
        """Moves the pointer, and waits until the node knows where to."""
        before = self.targets
        self.pointer.move(*place)
        self.wait_until("the new target", lambda: self.targets > before and
                        any(grasp.moving for grasp in self.grasps))

    def roll(self):
        at = START
        for frames, goal, how in WAY:
            start = at
            for frame in range(1, frames + 1):
                part = frame / frames
                at = tuple(round(a + part * (b - a)) for a, b in zip(start, goal))
                if how == "press" and frame == 1:
                    self.pointer.press()
                    self.wait_until("the grasp", lambda: self.grasps)
                elif how == "release" and frame == 1:
                    self.pointer.release()
                    self.wait_until("the release", lambda: not self.grasps)
                elif at != start and how == "pull":
                    self.pull_to(at)
                else:
                    self.pointer.move(*at)
                self.step(STEPS)
                self.shoot(at, how in ("press", "pull"))
        tears = rospy.ServiceProxy("/cloth/get_tear_events", GetTearEvents)(0, 0).newest
        print(f"film: {self.frames} frames, {tears} tears", flush=True)
        if tears < LEAST_TEARS:
            raise RuntimeError("the cloth did not tear as it has to")

    def close(self):
        self.rviz.kill()
        self.rviz.wait(PATIENCE)
        self.screen.close()


def main():
    rospy.init_node("film")
    film = Film(sys.argv[1])
    try:
        film.begin()
        film.roll()
    finally:
        film.close()
    (film.folder / "done").touch()


if __name__ == "__main__":
    main()
