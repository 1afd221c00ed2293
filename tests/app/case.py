# Helpers for the stories of the window.
import json
import os
import shutil
import sys
import tempfile
import time
import unittest

import numpy
from PIL import Image

PROGRAM, SOURCE, EDITORS = (os.path.abspath(path) for path in sys.argv[1:4])
# Stories are told on a recorded screen, which takes milliseconds. With --real, those that need a real window are told
# in one, and with --all the others, too.
REAL, ALL = "--real" in sys.argv, "--all" in sys.argv
sys.path.append(os.path.join(SOURCE, "tests/support"))
from old_samples import old_sample  # noqa: E402, F401
import timed  # noqa: E402
from seeds import few_or_many, seed_of, soak  # noqa: E402, F401
sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import driver  # noqa: E402
import recorded  # noqa: E402
OUT = os.path.join(os.path.dirname(PROGRAM), "screenshots")


def load(path):
    with open(path) as file:
        return json.load(file)


def Editor(arguments=(), **options):
    if REAL:
        return driver.Editor(os.path.join(EDITORS, "real_editor"), arguments, **options)
    return recorded.RecordedEditor(os.path.join(EDITORS, "recorded_editor"), arguments, **options)


def real(test):
    """Marks a story that needs a real window: pixels, other programs, sleep."""
    test.needs_window = True
    return test


def real_in_soak(test):
    """Marks one that scripts/soak tells, because others like it are told in each run."""
    return real(soak(test))


def recorded_only(test):
    """Marks a story that sends events between two frames, as only the recorded screen can."""
    test.is_recorded_only = True
    return test


class WindowCase(unittest.TestCase):
    def setUp(self):
        if REAL and hasattr(getattr(self, self._testMethodName), "is_recorded_only"):
            self.skipTest("needs a recorded screen")
        needs_window = hasattr(getattr(self, self._testMethodName), "needs_window")
        if needs_window != REAL and not (REAL and ALL):
            self.skipTest("runs in a real window" if needs_window else "runs on a recorded screen")
        self.work = tempfile.mkdtemp(prefix="holomorph-work-")
        self.picture = os.path.join(self.work, "gecko.png")
        shutil.copy(os.path.join(SOURCE, "assets/gecko.png"), self.picture)
        os.makedirs(OUT, exist_ok=True)

    def tearDown(self):
        shutil.rmtree(self.work)

    def screenshot(self, editor, name):
        """What the window shows, as an array of colors; None on a recorded screen."""
        if not REAL:
            return None
        path = os.path.join(OUT, name + ".png")
        editor.screenshot(path)
        return numpy.asarray(Image.open(path).convert("RGB")).astype(int)

    def caged(self, size, cage):
        """Writes a scene file with a picture of this size and a cage."""
        Image.effect_mandelbrot(size, (-2, -1, 1, 1), 40).convert("RGBA").save(os.path.join(self.work, "caged.png"))
        path = os.path.join(self.work, "caged.json")
        with open(path, "w") as file:
            json.dump({"format": "holomorph", "version": 1, "image": {"file": "caged.png"},
                       "cage": {"rest": [[p] for p in cage]}}, file)
        return path

    def save_as(self, editor, path):
        self.ask(editor, "ctrl+shift+s")
        editor.key("ctrl+a")
        editor.type(path)
        editor.key("Return")
        editor.wait(lambda s: not s["modified"] and os.path.exists(path), "the saved scene")

    def ask(self, editor, key):
        """Opens a dialog by its key. Tries again if something in progress has swallowed the key."""
        for _ in range(5):
            editor.wait(lambda s: not s["exporting"] and not s["asking"], "the end of the work in progress")
            editor.key(key)
            end = time.time() + 3
            while time.time() < end and not editor.state()["asking"]:
                editor.pause(0.05)
            if editor.state()["asking"]:
                return editor.pause(0.8)
        self.fail(f"no dialog appears after {key}")

    def type_into_inspector(self, editor, number, text):
        """Types into one of the inspector's number fields; the first one is number 1."""
        editor.key("F6")
        editor.wait(lambda s: s["in_panel"], "a panel with the keyboard focus")
        for _ in range(number):
            editor.key("Tab")
        editor.key("ctrl+a")
        editor.type(text)
        editor.key("Return")
        editor.pause(0.3)
        editor.key("Escape")
        editor.wait(lambda s: not s["in_panel"], "the canvas with the keyboard focus")

    def type_into(self, editor, name, text):
        """Types into a number field, given by the name of its item."""
        editor.press_item(name)
        editor.pause(0.3)
        editor.key("ctrl+a")
        editor.type(text)
        editor.key("Return")
        editor.pause(0.3)

    def by_palette(self, editor, words):
        """Runs an action by name from the command palette."""
        self.ask(editor, "ctrl+shift+p")
        editor.type(words)
        editor.key("Return")
        editor.pause(0.4)


def run_tests():
    timed.main([word for word in sys.argv[4:] if word not in ("--real", "--all")])
