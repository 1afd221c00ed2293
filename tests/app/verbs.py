# What the drivers of the editor share: the real window (driver.py) and the recorded screen (recorded.py).
import json
import os
import shutil
import tempfile


class Session:
    """A folder for the editor's log, and a home directory with its preferences."""

    def __init__(self, home=None):
        self.folder = tempfile.mkdtemp(prefix="holomorph-gui-")
        self.home = home or self.folder
        if not home:  # hides the first steps, which would cover what tests click on
            os.makedirs(self.home + "/config/holomorph")
            with open(self.home + "/config/holomorph/preferences.json", "w") as file:
                json.dump({"hints": False}, file)
        self.environment = dict(os.environ, HOME=self.home, XDG_CONFIG_HOME=self.home + "/config",
                                XDG_STATE_HOME=self.home + "/state")
        self.log = open(self.folder + "/log", "w")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.log.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def messages(self):
        self.log.flush()
        with open(self.folder + "/log") as file:
            return file.read()


class Verbs:
    """Gestures at points of the plane and at named items, for a class with state(), xdotool(), move(), press() and item()."""

    def pixel(self, x, y):
        """The window position of a plane point, in pixels, which is also its position on the display."""
        s = self.state()
        return (round(s["left"] + s["width"] / 2 + (x - s["center"][0]) * s["zoom"]),
                round(s["top"] + s["height"] / 2 - (y - s["center"][1]) * s["zoom"]))

    def click(self, x, y, button=1):
        self.press(*self.pixel(x, y), button)

    def press_item(self, name):
        """Clicks a named item, such as a button."""
        self.press(*self.item(name))

    def drag(self, start, end, steps=6):
        self.draw([tuple(a + i / steps * (b - a) for a, b in zip(start, end)) for i in range(steps + 1)])

    def draw(self, line):
        """Moves the pointer along these points with the button down."""
        self.move(*line[0])
        self.xdotool("mousedown", 1)
        for point in line[1:]:
            self.move(*point)
        self.xdotool("mouseup", 1)
