# Exports of moving meshes, judged by Khronos' validator, Blender and Godot.
import glob
import json
import os
import random
import re
import subprocess
import sys
import unittest

import numpy

SOURCE = sys.argv[2]
sys.path.append(os.path.join(SOURCE, "tests/cli"))
from meshes_test import Meshes  # noqa: E402

SAMPLES = sorted(glob.glob(os.path.join(SOURCE, "assets/*.json")))

VALIDATE = """
const validator = require('gltf-validator'), fs = require('fs');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])), {maxIssues: 0})
  .then(report => console.log(JSON.stringify(report.issues)));
"""

BLENDER = """
import json, sys
import numpy
numpy.bool = bool
import bpy
source, frames, rate, kind = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = int(rate)
if kind == 'glb':
    bpy.ops.import_scene.gltf(filepath=source)
    mesh = next(o for o in bpy.data.objects if o.type == 'MESH')
else:
    bpy.ops.import_scene.obj(filepath=source.replace('.' + kind, '-0000.obj'), axis_forward='Y', axis_up='Z', split_mode='OFF')
    mesh = next(o for o in bpy.data.objects if o.type == 'MESH')
    cache = mesh.modifiers.new('cache', 'MESH_CACHE')
    cache.cache_format, cache.filepath = kind.upper(), source
    cache.frame_start = 0
    mesh.matrix_world.identity()
result = []
for frame in range(int(frames)):
    bpy.context.scene.frame_set(frame)
    posed = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
    result.append([list(posed.matrix_world @ v.co) for v in posed.data.vertices])
print('RESULT' + json.dumps(result))
"""

GODOT = """
extends SceneTree
func _init():
    var scene = load("res://s.tscn").instance()
    get_root().add_child(scene)
    var player = scene.get_node("AnimationPlayer")
    player.play("motion")
    for time in TIMES:
        player.seek(time, true)
        for child in scene.get_children():
            if child is Polygon2D:
                var line = ""
                for p in child.polygon:
                    line += "%.7f %.7f " % [p.x, p.y]
                print("RESULT ", time, "|", child.name, "|", line)
    quit()
"""


class MeshesJudge(Meshes):
    def validator(self, file):
        home = self.path("validator")
        if not os.path.exists(home):
            os.mkdir(home)
            subprocess.run(["npm", "install", "--silent", "gltf-validator"], cwd=home, check=True, timeout=120, capture_output=True)
            with open(os.path.join(home, "validate.js"), "w") as script:
                script.write(VALIDATE)
        return json.loads(subprocess.run(["node", "validate.js", file], cwd=home, check=True, capture_output=True, text=True).stdout)

    def test_the_validator_finds_nothing(self):
        for scene in SAMPLES + [self.moving(random.Random(random.randrange(1 << 30)))]:
            for options in ([], ["--vertices", "300"]):
                self.good("export", scene, "--format", "glb", "--out", self.path("v.glb"), "--force", *options)
                issues = self.validator(self.path("v.glb"))
                print(os.path.basename(scene), options, {k: v for k, v in issues.items() if k.startswith("num")})
                self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), (scene, issues["messages"][:3]))

    def by_blender(self, kind, source, frames, rate):
        with open(self.path("look.py"), "w") as script:
            script.write(BLENDER)
        done = subprocess.run(["blender", "--background", "--factory-startup", "--python", self.path("look.py"), "--",
                               source, str(frames), str(int(rate)), kind], capture_output=True, text=True, timeout=300)
        found = re.search(r"^RESULT(.*)$", done.stdout, re.M)
        self.assertTrue(found, done.stdout[-2000:] + done.stderr[-2000:])
        return numpy.array(json.loads(found[1]))

    def test_blender_sees_every_vertex(self):
        seed = random.randrange(1 << 30)
        scene = self.moving(random.Random(seed), 1)
        rate, _ = self.times(scene)
        self.good("export", scene, "--format", "obj", "--out", self.path("m.obj"), "--frames", "0..5")
        for kind in ("glb", "mdd", "pc2"):
            source = self.path("m." + kind)
            self.good("export", scene, "--format", kind, "--out", source, "--frames", "0..5", *(self.EACH_FRAME if kind == "glb" else ()))
            seen = self.by_blender(kind, source, 6, rate)
            unit = 100 if kind == "glb" else 1
            farthest = 0
            for k, frame in enumerate(seen):
                wanted = self.positions(scene, "--time", k / rate) / unit
                # Blender's z is up in place of glTF's y.
                plane = frame[:, [0, 2]] if kind == "glb" else frame[:, :2]
                farthest = max(farthest, numpy.abs(plane[:len(wanted)] - wanted).max())
            print(f"seed {seed}: Blender's vertices of {kind} differ by at most {farthest:.2g}")
            self.assertLess(farthest, 1e-5 * (100 / unit), kind)

    def test_godot_sees_the_vertices(self):
        seed = random.randrange(1 << 30)
        scene = self.moving(random.Random(seed), 2)
        rate, _ = self.times(scene)
        self.good("export", scene, "--format", "godot3", *self.EACH_FRAME, "--out", self.path("s.tscn"))
        times = [1 / rate, 3 / rate, 5 / rate]
        self.write("project.godot", 'config_version=4\n[application]\nconfig/name="s"\n')
        self.write("look.gd", GODOT.replace("TIMES", str(times)).replace("    ", "\t"))
        done = subprocess.run(["godot3-server", "--path", self.folder, "-s", "look.gd"], capture_output=True, text=True, timeout=120)
        lines = re.findall(r"^RESULT (\S+)\|layer 1\|(.*)$", done.stdout, re.M)
        self.assertEqual(len(lines), 3, done.stdout[-2000:] + done.stderr[-2000:])
        for (_, line), time in zip(lines, times):
            seen = numpy.array([float(x) for x in line.split()]).reshape(-1, 2) * [1, -1]
            wanted = self.positions(scene, "--time", time)
            difference = numpy.abs(seen[:len(wanted)] - wanted).max()
            print(f"seed {seed}: Godot's vertices differ by at most {difference:.2g} px at {time} s")
            self.assertLess(difference, 1e-4)


if __name__ == "__main__":
    names = ["MeshesJudge." + name for name in dir(MeshesJudge)
             if name.startswith("test_") and name not in dir(Meshes)]
    unittest.main(argv=[sys.argv[0], *(sys.argv[3:] or names)], verbosity=2)
