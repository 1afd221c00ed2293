# Times Python against C++: a million new points through a cage of 32 edges, with derivatives. The
# arrays of points are made before the clock starts; the time includes making the arrays of results.
import json
import math
import os
import subprocess
import sys
import time

import numpy

PROGRAM = sys.argv[1]
sys.path.insert(0, os.path.join(os.path.dirname(PROGRAM), "python"))
import holomorph  # noqa: E402

ROUNDS, LIMIT = 5, 1.05


def cpp():
    """The median time of the benchmark, in ms."""
    words = [PROGRAM, "bench", "--json", "--filter", "10^6 new points"]
    rows = json.loads(subprocess.run(words, capture_output=True, text=True, check=True).stdout)
    return rows["rows"][0]["median"]


def python(random):
    scene = holomorph.Scene()
    angle = numpy.arange(32) * 2 * math.pi / 32
    rest = 500 + 500j + 350 * (1 + 0.25 * numpy.sin(5 * angle)) * numpy.exp(1j * angle)
    scene.set_cage(rest)
    scene.method = "cage"
    scene.pose = rest + 20 * numpy.sin(rest.imag / 100)
    times = []
    for _ in range(9):
        points = random.uniform(0, 1000, 1_000_000) + 1j * random.uniform(0, 1000, 1_000_000)
        start = time.perf_counter()
        scene.derivatives(points)
        times.append(1000 * (time.perf_counter() - start))
    return float(numpy.median(times))


random = numpy.random.default_rng()
pairs = [(cpp(), python(random)) for _ in range(ROUNDS)]
for a, b in pairs:
    print(f"C++ {a:.0f} ms, Python {b:.0f} ms")
ratio = float(numpy.median([b / a for a, b in pairs]))
print(f"Python takes {ratio:.3f} times as long as C++; the limit is {LIMIT}")
sys.exit(ratio > LIMIT)
