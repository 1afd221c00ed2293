# Blender's Python runs our module with the bits of the command line, and its node Map UV warps pictures by our ST-maps.
import json
import math
import os
import re
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


# Straight alpha becomes premultiplied when Blender reads a file, and Map UV interpolates premultiplied pixels.
MAP_UV = """
import bpy, sys
out, picture, st_map = sys.argv[-3:]
scene = bpy.context.scene
scene.use_nodes = True
tree = scene.node_tree
tree.nodes.clear()
def image(path, data):
    node = tree.nodes.new("CompositorNodeImage")
    node.image = bpy.data.images.load(path)
    node.image.colorspace_settings.name = "Non-Color" if data else "Raw"
    return node
source, uv = image(picture, False), image(st_map, True)
warp = tree.nodes.new("CompositorNodeMapUV")
warp.alpha = 0
tree.links.new(source.outputs["Image"], warp.inputs["Image"])
tree.links.new(uv.outputs["Image"], warp.inputs["UV"])
last = tree.nodes.new("CompositorNodeComposite")
tree.links.new(warp.outputs["Image"], last.inputs["Image"])
scene.render.resolution_x, scene.render.resolution_y = uv.image.size
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.image_settings.color_mode = "RGBA"
scene.view_settings.view_transform = "Raw"
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
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

    def test_map_uv_gives_our_pictures(self):
        """The node blurs edges where a picture overlaps itself, so the bound is for all samples together."""
        errors = []
        for scene in SAMPLES:
            with open(scene) as file:
                data = json.load(file)
            if "image" not in data:
                continue
            self.good("export", scene, "--format", "stmap", "--out", self.path("st.exr"), "--force")
            self.good("render", scene, "--crop", "--out", self.path("r.png"), "--force")
            picture = os.path.join(os.path.dirname(scene), data["image"]["file"])
            self.blender(MAP_UV, self.path("w.exr"), picture, self.path("st.exr"))
            subprocess.run(["oiiotool", self.path("r.png"), "--premult", "-d", "float", "-o", self.path("r.exr")], check=True)
            said = subprocess.run(["oiiotool", self.path("w.exr"), self.path("r.exr"), "--diff"], capture_output=True,
                                  text=True).stdout
            decibels = float(re.search(r"Peak SNR = (\S+)", said).group(1))
            print(f"{os.path.basename(scene)}: {decibels:.1f} dB")
            errors.append(10 ** (-decibels / 10))
        together = -10 * math.log10(sum(errors) / len(errors))
        print(f"all samples together: {together:.1f} dB")
        self.assertGreaterEqual(together, 30)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
