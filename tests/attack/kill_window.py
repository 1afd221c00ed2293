#!/usr/bin/env python3
"""kill -9 of the editor during edits and saves: no file is torn, at most the last step is lost, nothing is left behind."""
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

import attack

options = attack.arguments(__doc__, kills=5)
sys.path.insert(0, os.path.join(options.source, "tests/app"))
from driver import Editor  # noqa: E402

rng = random.Random(options.seed)
folder = tempfile.mkdtemp(prefix="kill-")
home = os.path.join(folder, "home")
autosaves = os.path.join(home, "state/holomorph/autosave")
os.makedirs(os.path.join(home, "config/holomorph"))
with open(os.path.join(home, "config/holomorph/preferences.json"), "w") as file:
    json.dump({"hints": False, "native_dialogs": False}, file)
shutil.copy(os.path.join(options.source, "assets/fish.png"), folder)
scene = os.path.join(folder, "scene.json")
with open(scene, "w") as file:
    json.dump({"format": "holomorph", "version": 1, "image": {"file": "fish.png"},
               "cage": {"rest": [[[100, 100]], [[1000, 100]], [[1000, 600]], [[100, 600]]]}}, file)


def steps_in(path):
    """The number of steps that the cage of a scene has moved to the right."""
    with open(path) as file:
        cage = json.load(file)["cage"]
    return round(cage.get("pose", cage["rest"])[0][0][0] - cage["rest"][0][0][0])


def autosaved():
    return [os.path.join(autosaves, name) for name in os.listdir(autosaves) if name.endswith(".json")] if os.path.isdir(autosaves) else []


bad, most_lost, offered = [], 0, 0
for number in range(options.kills):
    shutil.rmtree(autosaves, ignore_errors=True)
    with Editor(options.program, [scene], home=home) as editor:
        editor.wait(lambda s: s["pictured"] and s["cage_points"] == 4 and not s["busy"] and not s["asking"], "the scene")
        editor.key("ctrl+a")
        before, taken = steps_in(scene), editor.state()["taken"]
        saves = rng.random() < 0.4
        keys = []
        for _ in range(rng.randint(2, 12)):
            keys += ["Right"] + (["ctrl+s"] if saves and rng.random() < 0.3 else [])
        typing = subprocess.Popen(["xdotool", "key", "--delay", str(rng.choice([5, 30, 80])), *keys],
                                  env=editor.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(rng.uniform(0.02, 0.9))
        seen = editor.state()
        editor.process.kill()
        editor.process.wait()
        typing.wait()
    try:
        reached = max([steps_in(path) for path in [scene, *autosaved()]])
    except (ValueError, KeyError, OSError) as error:
        bad.append(f"kill {number}: torn: {error}")
        continue
    if seen and not saves:  # the key presses that had been processed and drawn when the state was read
        lost = (seen["taken"] - taken + 1) // 2 - (reached - before)
        most_lost = max(most_lost, lost)
        if lost > 1:
            bad.append(f"kill {number}: {lost} steps are lost")
    if autosaved() and rng.random() < 0.3:  # the next start offers to recover it
        with Editor(options.program, [scene], home=home) as editor:
            editor.wait(lambda s: s["question"] == "Unsaved work", "the offer")
            editor.key("Return")
            editor.wait(lambda s: s["modified"] and not s["asking"], "the recovered scene")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "the saved scene")
            editor.key("ctrl+q")
            editor.process.wait(timeout=20)
        offered += 1
        if steps_in(scene) != reached:
            bad.append(f"kill {number}: recovered {steps_in(scene)} of {reached} steps")
with Editor(options.program, [scene], home=home) as editor:  # one more session, which ends normally
    editor.wait(lambda s: s is not None and s["cage_points"] == 4, "the scene")
    if editor.state()["asking"]:
        editor.key("Return")
        editor.wait(lambda s: s["modified"] and not s["asking"], "the recovered scene")
    editor.key("ctrl+a")
    editor.key("Right")
    editor.wait(lambda s: s["modified"], "an edit")
    editor.key("ctrl+s")
    editor.wait(lambda s: not s["modified"], "the saved scene")
    editor.key("ctrl+q")
    editor.process.wait(timeout=20)
left = [os.path.join(at, name) for at, _, names in os.walk(folder) for name in names if name.startswith(".")]
left += [name for name in (os.listdir(autosaves) if os.path.isdir(autosaves) else [])]
if left:
    bad.append(f"left behind: {left}")
shutil.rmtree(folder)
attack.finish("kill_window", f"seed {options.seed}, {options.kills} kills, at most {most_lost} steps lost, {offered} recovered, {len(left)} leftovers", bad)
