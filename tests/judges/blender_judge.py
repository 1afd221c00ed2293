# Blender's Python runs our module with the bits of the command line.
import os
import subprocess
import sys
import unittest

import numpy
from PIL import Image

sys.path.append(os.path.join(sys.argv[2], "tests/cli"))
from case import PROGRAM, SOURCE, Case  # noqa: E402

MODULE = os.path.join(os.path.dirname(PROGRAM), "python")
SAMPLES = [os.path.join(SOURCE, "assets", name) for name in sorted(os.listdir(os.path.join(SOURCE, "assets"))) if name.endswith(".json")]

MAPS = """
import sys, json, numpy, holomorph
scene = holomorph.load(sys.argv[-1])
mesh = scene.mesh()
points = numpy.mean(mesh.vertices[mesh.triangles], axis=1)[::7]
numpy.savetxt(sys.argv[-2] + ".csv", numpy.stack([points.real, points.imag], 1), "%.17g", ",")
numpy.save(sys.argv[-2] + ".npy", scene.map(points))
numpy.save(sys.argv[-2] + "-picture.npy", scene.render())
"""


class Blender(Case):
    def blender(self, script, *words):
        with open(self.path("script.py"), "w") as file:
            file.write(script)
        done = subprocess.run(["blender", "--background", "--factory-startup", "--python-use-system-env", "--python",
                               self.path("script.py"), "--", *words], capture_output=True, text=True, timeout=600,
                              env=dict(os.environ, PYTHONPATH=MODULE))
        self.assertNotIn("Error", done.stdout + done.stderr)

    def test_maps_and_pictures_in_blender_have_the_bits_of_the_command(self):
        for scene in SAMPLES:
            self.blender(MAPS, self.path("b"), scene)
            self.good("map", scene, "--points", self.path("b.csv"), "--out", self.path("c.csv"), "--force")
            rows = numpy.genfromtxt(self.path("c.csv"), delimiter=",", names=True)
            seen = numpy.load(self.path("b.npy"))
            self.good("render", scene, "--out", self.path("p.png"), "--force")
            picture = numpy.asarray(Image.open(self.path("p.png")).convert("RGBA"))
            self.assertTrue((numpy.load(self.path("b-picture.npy")) == picture).all(), scene)
            names = rows.dtype.names
            self.assertTrue((rows[names[0]] == seen.real).all() and (rows[names[1]] == seen.imag).all(), scene)
            print(os.path.basename(scene), len(seen), "points and the picture are the same")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
