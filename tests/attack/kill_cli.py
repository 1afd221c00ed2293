#!/usr/bin/env python3
"""kill -9 while the command line writes: each file is unchanged, complete or absent, and the next write cleans up."""
import json
import os
import random
import shutil
import subprocess
import tempfile
import time

import attack

options = attack.arguments(__doc__, kills=24)
rng = random.Random(options.seed)
folder = tempfile.mkdtemp(prefix="kill-")
shutil.copytree(os.path.join(options.source, "assets"), folder, dirs_exist_ok=True)
path = lambda name: os.path.join(folder, name)
film = json.load(open(path("fern.json")))
film["animation"] = {"frames_per_second": 8}
json.dump(film, open(path("film.json"), "w"))


def content(name):
    with open(path(name), "rb") as file:
        return file.read()


def is_png(name):
    return content(name).startswith(b"\x89PNG") and content(name)[-8:-4] == b"IEND"


def is_json(name):
    return bool(json.loads(content(name)))


def is_gif(name):
    return content(name).startswith(b"GIF8") and content(name).endswith(b";")


def is_webp(name):
    return content(name)[:4] == b"RIFF" and int.from_bytes(content(name)[4:8], "little") + 8 == len(content(name))


def is_svg(name):
    return content(name).endswith(b"</svg>\n")


def is_table(name):
    return content(name).endswith(b"\n") and content(name).count(b"\n") == 40001


with open(path("many.csv"), "w") as points:
    points.write("".join(f"{400 + i % 200},{300 + i // 200}\n" for i in range(40000)))
# The command that writes, the file to check, and the function that tells whether it is complete.
jobs = [(["new", "fish.png", "--force", "--out", "out.json"], "out.json", is_json),
        (["render", "fish.json", "--out", "out.png"], "out.png", is_png),
        (["export", "fish.json", "--format", "svg", "--out", "out.svg"], "out.svg", is_svg),
        (["map", "fish.json", "--points", "many.csv", "--out", "out.csv"], "out.csv", is_table),
        (["render", "film.json", "--frames", "0..9", "--scale", "0.2", "--out", "f.png"], "f-0003.png", is_png),
        (["export", "film.json", "--format", "apng", "--scale", "0.1", "--out", "out.apng"], "out.apng", is_png),
        (["export", "film.json", "--format", "gif", "--scale", "0.1", "--out", "out.gif"], "out.gif", is_gif),
        (["export", "film.json", "--format", "webp", "--scale", "0.1", "--out", "out.webp"], "out.webp", is_webp)]
bad, seconds = [], []
for words, out, whole in jobs:
    start = time.time()
    subprocess.run([options.program, *words], cwd=folder, check=True, capture_output=True)
    seconds.append(time.time() - start)
    if not whole(out):
        bad.append(f"{out} is incomplete although the program was not killed")
known, killed = set(os.listdir(folder)), 0
for number in range(options.kills):
    words, out, whole = jobs[number % len(jobs)]
    if rng.random() < 0.5 and os.path.exists(path(out)):
        os.remove(path(out))
    process = subprocess.Popen([options.program, *words], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    # Kill at any time, but often near the end, when files are written.
    length = seconds[number % len(jobs)]
    time.sleep(max(0.0, rng.uniform(0, length) if rng.random() < 0.5 else rng.gauss(0.93, 0.08) * length))
    killed += process.poll() is None
    process.kill()
    process.wait()
    if os.path.exists(path(out)) and not whole(out):
        bad.append(f"{out} is torn by a kill of {words[0]}")
subprocess.run([options.program, *jobs[0][0]], cwd=folder, check=True, capture_output=True)
left = sorted(set(os.listdir(folder)) - known)
if left:
    bad.append(f"left behind: {left}")
shutil.rmtree(folder)
attack.finish("kill_cli", f"seed {options.seed}, {killed} of {options.kills} runs killed, {len(left)} leftovers", bad)
