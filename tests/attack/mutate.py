#!/usr/bin/env python3
"""Sample scenes with a changed structure: extreme numbers, repeated, shuffled and emptied lists, swapped types."""
import json
import os
import random
import shutil
import tempfile

import attack

options = attack.arguments(__doc__, runs=attack.few_or_many(25, 60), keep="")
MOST_SECONDS, MOST_MEGABYTES = 20, 4096
NUMBERS = [0, -0.0, 1, -1, 5e-324, 1e-308, 1e308, -1e308, 1e8, -1e8, 1e-9, 2**31, -2**31 - 1, 2**53 + 1, 0.5, 3600, 240, 1e-3]
METHODS = ["cage", "pins", "arap", "har_arap", "outline", "strokes", "angles", "harmonic", "mean_value", "bounded",
           "puppet", "sheet"]
COMMANDS = [["info"], ["info", "--json"], ["render", "--scale", "0.1", "--out", "o.png"],
            ["render", "--time", "0.5", "--scale", "0.1", "--out", "o.png"], ["map", "--points", "p.csv"],
            ["inverse", "--points", "p.csv"], ["coordinates", "--points", "p.csv", "--out", "o.npy"],
            ["export", "--format", "svg", "--out", "o.svg"], ["export", "--format", "obj", "--out", "o.obj"]]


def places(value, found):
    """All lists and objects in a value."""
    if isinstance(value, (dict, list)):
        found.append(value)
        for part in value.values() if isinstance(value, dict) else value:
            places(part, found)
    return found


def change(scene, rng):
    inside = rng.choice(places(scene, []))
    keys = list(inside) if isinstance(inside, dict) else list(range(len(inside)))
    if not keys:
        return
    key = rng.choice(keys)
    value = inside[key]
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    kind = rng.random()
    if number and rng.random() < 0.6:  # a small change, so that it may still be a valid scene
        inside[key] = value + rng.gauss(0, 0.02) * (abs(value) + 1)
    elif number and kind < 0.6:
        inside[key] = rng.choice(NUMBERS + [10 * value, -value, value * 1e-6, value + 1, value * (1 + 1e-15)])
    elif isinstance(inside, list) and kind < 0.7:
        inside.insert(rng.randint(0, len(inside)), json.loads(json.dumps(value)))
    elif isinstance(inside, list) and kind < 0.76:
        inside[:] = inside * rng.choice([2, 3, 30])
    elif isinstance(inside, list) and kind < 0.84:
        rng.shuffle(inside)
    elif kind < 0.9:
        del inside[key]
    elif kind < 0.95:
        inside[key] = rng.choice([None, True, "x", [], {}, [[]], 1e308])
    else:
        scene["method"] = {"id": rng.choice(METHODS)}


rng = random.Random(options.seed)
folder = tempfile.mkdtemp(prefix="mutate-")
assets = os.path.join(options.source, "assets")
shutil.copytree(assets, folder, dirs_exist_ok=True)
samples = [json.load(open(os.path.join(assets, name))) for name in sorted(os.listdir(assets)) if name.endswith(".json")]
with open(os.path.join(folder, "p.csv"), "w") as file:
    file.write("x,y\n500,350\n0,0\n1e8,-1e8\n")
tally = attack.Tally(MOST_SECONDS, MOST_MEGABYTES)
for number in range(options.runs):
    scene = json.loads(json.dumps(rng.choice(samples)))
    for _ in range(rng.randint(1, 4)):
        change(scene, rng)
    with open(os.path.join(folder, "m.json"), "w") as file:
        json.dump(scene, file)
    command, *words = rng.choice(COMMANDS)
    outcome = attack.run([options.program, command, "m.json", *words], folder, MOST_SECONDS)
    if tally.add(f"scene {number}, {command} {' '.join(words)}", outcome) and options.keep:
        os.makedirs(options.keep, exist_ok=True)
        shutil.copy(os.path.join(folder, "m.json"), os.path.join(options.keep, f"{options.seed}-{number}.json"))
shutil.rmtree(folder)
tally.finish("mutate", f"seed {options.seed}, {options.runs} scenes")
