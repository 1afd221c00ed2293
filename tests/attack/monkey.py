#!/usr/bin/env python3
"""Random clicks, drags, keys and commands: the window keeps running and responding, and its memory does not grow."""
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

import attack

options = attack.arguments(__doc__, minutes=0.7, growth=250, most=3000)
sys.path.insert(0, os.path.join(options.source, "tests/app"))
from driver import Editor  # noqa: E402

KEYS = list("vpnsuaogxtbrwcik12345,.") + [
    "Tab", "space", "Delete", "Escape", "Return", "F6", "F10", "F1", "F2", "Home", "End", "Left", "Right", "Up", "Down", "Page_Up", "Page_Down",
    "bracketleft", "bracketright", "plus", "minus", "0", "ctrl+z", "ctrl+z", "ctrl+z", "ctrl+shift+z", "ctrl+a", "ctrl+d", "ctrl+c", "ctrl+v",
    "ctrl+s", "ctrl+n", "ctrl+m", "ctrl+Page_Up", "ctrl+Page_Down", "shift+Page_Up", "shift+backslash", "shift+F10", "shift+comma"]
WORDS = ["cage", "pins", "rigid", "no folds", "harmonic", "mean value", "angles", "strokes", "outline", "conformal", "make from", "compare", "light",
         "contrast", "dark", "raise", "lower", "reset", "background", "add", "duplicate", "hide", "lock", "key", "onion", "mirror", "simplify", "fit",
         "checker", "stretch", "surface", "curved", "delete", "select", "box", "timeline", "record"]
STUCK = 60  # seconds without a processed event
rng = random.Random(options.seed)
work = tempfile.mkdtemp(prefix="monkey-")
shutil.copytree(os.path.join(options.source, "assets"), work, dirs_exist_ok=True)
scenes = sorted(os.path.join(work, name) for name in os.listdir(work) if name.endswith(".json"))


class Monkey:
    def __init__(self, editor):
        self.editor, self.events = editor, 0
        self.hand = subprocess.Popen(["xdotool", "-"], env=editor.environment, stdin=subprocess.PIPE, text=True,
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def do(self, *words):
        self.events += 1
        self.hand.stdin.write(" ".join(map(str, words)) + "\n")
        self.hand.stdin.flush()
        time.sleep(0.012)

    def point(self):
        near = rng.random() < 0.8
        return rng.randint(60, 1060) if near else rng.randint(0, 1279), rng.randint(40, 770) if near else rng.randint(0, 799)

    def drag(self, button, *held):
        for key in held:
            self.do("keydown", key)
        self.do("mousemove", *self.point())
        self.do("mousedown", button)
        for _ in range(rng.randint(1, 6)):
            self.do("mousemove", *self.point())
        self.do("mouseup", button)
        for key in held:
            self.do("keyup", key)

    def command(self):
        self.do("key", "Escape")
        self.do("key", "ctrl+shift+p")
        time.sleep(0.1)
        self.do("type", "--delay", 5, f'"{rng.choice(WORDS)}"')
        time.sleep(0.1)
        for _ in range(rng.randint(0, 3)):
            self.do("key", "Down")
        self.do("key", "Return")

    def other_scene(self):
        for key in ("Escape", "Escape", "ctrl+o"):
            self.do("key", key)
        time.sleep(0.3)
        self.do("key", "Tab")
        self.do("key", "Return")
        time.sleep(0.3)
        self.do("key", "ctrl+a")
        self.do("type", "--delay", 3, f'"{rng.choice(scenes)}"')
        self.do("key", "Return")
        time.sleep(0.4)

    def step(self):
        act = rng.random()
        if act < 0.25:
            self.do("mousemove", *self.point())
            self.do("click", rng.choice([1, 1, 1, 1, 3]))
        elif act < 0.5:
            self.drag(1)
        elif act < 0.6:
            self.drag(rng.choice([1, 1, 2]), rng.choice(["shift", "ctrl", "alt"]))
        elif act < 0.65:
            self.do("mousemove", *self.point())
            self.do("click", "--repeat", rng.randint(1, 4), "--delay", 20, rng.choice([4, 5]))
        elif act < 0.9:
            self.do("key", rng.choice(KEYS))
        elif act < 0.95:
            self.command()
        elif act < 0.97:
            self.other_scene()
        else:
            self.do("key", "Escape")

    def settle(self):
        """Waits until all events are processed. Returns False if there is no progress."""
        since, taken = time.time(), -1
        while self.editor.process.poll() is None:
            state = self.editor.state() or {}
            if state and not state["pending"]:
                return True
            if state.get("taken", taken) != taken:
                since, taken = time.time(), state["taken"]
            if time.time() - since > STUCK:
                return False
            time.sleep(0.03)
        return True

    def megabytes(self):
        with open(f"/proc/{self.editor.process.pid}/statm") as file:
            return int(file.read().split()[1]) * 4096 >> 20


bad, events, sizes, quits = [], 0, [], 0
start = time.time()
while time.time() - start < 60 * options.minutes and not bad:
    with Editor(options.program, [rng.choice(scenes)]) as editor:
        monkey = Monkey(editor)
        while time.time() - start < 60 * options.minutes and not bad:
            monkey.step()
            if not monkey.settle():
                bad.append(f"no response for {STUCK} s")
            if editor.process.poll() == 0:  # the monkey has quit the program
                quits += 1
                break
            if editor.process.poll() is not None:
                bad.append(f"ended with {editor.process.returncode}: {editor.messages()[-500:]}")
                break
            size = monkey.megabytes()
            if not sizes or time.time() - start > sizes[-1][0] + 5:
                sizes.append((time.time() - start, size))
            if size > options.most:
                bad.append(f"{size} MB")
        events += monkey.events
        monkey.hand.kill()


def size_at(minute):
    """The median size in the half minute around a time."""
    near = sorted(size for at, size in sizes if abs(at - 60 * minute) < 15) or [sizes[-1][1]]
    return near[len(near) // 2]


marks = [minute for minute in (5, 10, 20) if minute <= options.minutes + 0.01]
if len(marks) > 1 and not quits and size_at(marks[-1]) - size_at(marks[0]) > options.growth:
    bad.append("it grows")
line = ", ".join(f"{size_at(minute)} MB at {minute} min" for minute in marks) or f"{sizes[-1][1]} MB"
shutil.rmtree(work)
attack.finish("monkey", f"seed {options.seed}, {events} events, {line}, most {max(size for _, size in sizes)} MB, {quits} quits", bad)
