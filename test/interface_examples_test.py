#!/usr/bin/env python3
"""Every call that docs/interface.md shows works when pasted; docs/testing.md quotes files as they are."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import rospy
import rostest
from cloth_tearing.msg import SimulationStatus
from cloth_tearing.srv import Step, StepRequest

SOURCE = pathlib.Path(__file__).resolve().parent.parent
PATIENCE = 30.0  # for each call [s]
BLOCK = re.compile(r"^```(sh|python)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
QUOTE = re.compile(r"^\[(?P<path>examples/\S+)\]\(\S+\)\n\n```\w+\n(?P<text>.*?)^```$",
                   re.MULTILINE | re.DOTALL)


class Cloth:
    """The cloth that the page starts, by the same command; stepped, and with what some calls need."""

    def __init__(self, folder):
        parameters = pathlib.Path(folder) / "parameters.yaml"
        parameters.write_text((SOURCE / "config/cloth.yaml").read_text() +
                              f"export_folder: {folder}\nstate_folder: {folder}\n")
        self.process = subprocess.Popen(["roslaunch", "cloth_tearing", "cloth.launch", "pace:=step",
                                         "publish_clock:=true", "handles:=true",
                                         f"config:={parameters}"])

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        self.process.wait(PATIENCE)


class Driver:
    """Steps the cloth as long as it lives, so that it goes on as it does by the wall clock."""

    def __init__(self):
        rospy.wait_for_service("cloth/step", PATIENCE)
        self.step = rospy.ServiceProxy("cloth/step", Step, persistent=True)
        self.stopped = threading.Event()
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        while not self.stopped.wait(0.02):  # leaves time for the programs that are tried
            self.step(StepRequest(steps=20))

    def stop(self):
        self.stopped.set()
        self.thread.join()


def start(language, text):
    """Starts what a block shows, as a shell or python would that it is pasted into."""
    command = ["bash", "-e", "-c", text] if language == "sh" else [sys.executable, "-c", text]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            start_new_session=True)


def complaint(text, process, seconds):
    """What is wrong with what a call said; empty if nothing is."""
    try:
        said, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)  # with all that it started
        return f"{text}said nothing in time: {process.communicate()[0]}"
    if process.returncode != 0:
        return f"{text}ended with {process.returncode}: {said}"
    if "rosservice call" in text and said.count("success: True") != text.count("rosservice call"):
        return f"{text}was refused: {said}"
    return "" if said.strip() or "rostopic pub" in text else f"{text}said nothing"


class PagesTest(unittest.TestCase):
    def test_every_call_of_the_page_works_when_pasted(self):
        blocks = BLOCK.findall((SOURCE / "docs/interface.md").read_text())
        self.assertGreater(len(blocks), 25, "the page has lost its calls")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        cloth = Cloth(folder.name)
        self.addCleanup(cloth.stop)
        driver = Driver()
        self.addCleanup(driver.stop)
        listeners = []
        complaints = []
        for language, text in blocks:
            process = start(language, text)
            if text.startswith("rostopic echo"):
                listeners.append((text, process))  # like one in another terminal
            else:
                complaints.append(complaint(text, process, PATIENCE))
        deadline = time.monotonic() + PATIENCE
        for text, process in listeners:
            complaints.append(complaint(text, process, max(0.0, deadline - time.monotonic())))

        status = rospy.wait_for_message("cloth/status", SimulationStatus, PATIENCE)
        found = list(filter(None, complaints))
        self.assertFalse(found, "\n".join(found))
        self.assertEqual(status.last_refusal, "")

    def test_the_page_names_all_that_there_is(self):
        page = (SOURCE / "docs/interface.md").read_text()
        files = [file for folder in ("msg", "srv", "action") for file in (SOURCE / folder).iterdir()]
        self.assertEqual([file.name for file in files if file.stem not in page], [])
        parameters = re.findall(r"^([a-z_]+):", (SOURCE / "config/cloth.yaml").read_text(), re.MULTILINE)
        self.assertEqual([name for name in parameters if f"`{name}`" not in page], [])

    def test_the_page_on_testing_quotes_files_as_they_are(self):
        quotes = list(QUOTE.finditer((SOURCE / "docs/testing.md").read_text()))
        self.assertGreater(len(quotes), 3, "the page has lost its files")
        for quote in quotes:
            self.assertEqual(quote["text"], (SOURCE / quote["path"]).read_text(), quote["path"])


if __name__ == "__main__":
    rospy.init_node("interface_examples_test")
    rostest.rosrun("cloth_tearing", "interface_examples", PagesTest, sys.argv)
