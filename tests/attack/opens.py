#!/usr/bin/env python3
"""Opens scenes one after another in one window: memory use at the end is the same as after the first tenth."""
import glob
import os
import shutil
import sys
import tempfile

import attack

options = attack.arguments(__doc__, opens=30, growth=60)
sys.path.insert(0, os.path.join(options.source, "tests/app"))
from driver import Editor  # noqa: E402

work = tempfile.mkdtemp(prefix="opens-")
for name in glob.glob(os.path.join(options.source, "assets/*.*")):
    shutil.copy(name, work)
scenes = [os.path.join(work, name + ".json") for name in ("fish", "gecko", "giraffe")]


def megabytes(process):
    with open(f"/proc/{process.pid}/statm") as file:
        return int(file.read().split()[1]) * 4096 >> 20


sizes, bad = [], []
with Editor(options.program, [scenes[0]]) as editor:
    editor.wait(lambda s: s["pictured"] and not s["busy"], "the first scene")
    for number in range(options.opens):
        scene = scenes[(number + 1) % len(scenes)]
        before = editor.state()["first_point"]
        editor.drop(scene, 400, 300)
        editor.wait(lambda s: s["asking"] or s["first_point"] != before, "the question of where it goes")
        if editor.state()["asking"]:
            editor.press_item("Open as a new scene")
        editor.wait(lambda s: s["first_point"] != before and s["pictured"] and not s["busy"], "the next scene", 30)
        sizes.append(megabytes(editor.process))
early = sorted(sizes[len(sizes) // 10:][:len(scenes) * 3])
late = sorted(sizes[-len(scenes) * 3:])
grown = late[len(late) // 2] - early[len(early) // 2]
if grown > options.growth:
    bad.append(f"{grown} MB more than at the beginning")
shutil.rmtree(work)
attack.finish("opens", f"{options.opens} scenes, {sizes[0]} MB after the first, {early[len(early) // 2]} MB after a tenth, {sizes[-1]} MB at the end", bad)
