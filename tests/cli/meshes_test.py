# Moving meshes: every vertex of every frame is where the map takes it, and the files are whole.
import json
import math
import os
import random
import re
import shutil
import struct
import subprocess
import sys

import numpy
from PIL import Image

from case import SOURCE, Case, seed_of, timed

FERN = os.path.join(SOURCE, "assets/fern.json")


class Glb:
    """A reader of the parts of glTF that matter here, which checks sizes and bounds as it goes."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        magic, version, size = struct.unpack_from("<4sII", data)
        assert (magic, version, size) == (b"glTF", 2, len(data))
        length, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON" and length % 4 == 0
        self.json = json.loads(data[20:20 + length])
        binary, kind = struct.unpack_from("<I4s", data, 20 + length)
        assert kind == b"BIN\0" and binary % 4 == 0
        self.binary = data[28 + length:]
        assert len(self.binary) == binary == self.json["buffers"][0]["byteLength"]

    def view(self, index):
        view = self.json["bufferViews"][index]
        assert view["byteOffset"] % 4 == 0
        return self.binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]

    def accessor(self, index):
        it = self.json["accessors"][index]
        kind = {5125: "<u4", 5126: "<f4"}[it["componentType"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[it["type"]]
        values = numpy.zeros((it["count"], width), kind)
        if "bufferView" in it:
            values = numpy.frombuffer(self.view(it["bufferView"]), kind).reshape(it["count"], width)
        if "sparse" in it:
            indices = numpy.frombuffer(self.view(it["sparse"]["indices"]["bufferView"]), "<u4")
            assert len(indices) == it["sparse"]["count"] and (numpy.diff(indices.astype(int)) > 0).all()
            values = values.copy()
            values[indices] = numpy.frombuffer(self.view(it["sparse"]["values"]["bufferView"]), kind).reshape(-1, width)
        if "min" in it:
            assert (values.min(axis=0) == numpy.float32(it["min"])).all() and (values.max(axis=0) == numpy.float32(it["max"])).all()
        return values

    def node(self, name):
        return next(node for node in self.json["nodes"] if node["name"] == name)

    def frames(self, name):
        """The times and the positions of a node's vertices at its frames, by the animation."""
        index = next(i for i, node in enumerate(self.json["nodes"]) if node["name"] == name)
        primitive, = self.json["meshes"][self.json["nodes"][index]["mesh"]]["primitives"]
        first = self.accessor(primitive["attributes"]["POSITION"]).astype(float)
        targets = [self.accessor(t["POSITION"]).astype(float) for t in primitive.get("targets", [])]
        for animation in self.json.get("animations", []):
            for channel in animation["channels"]:
                if channel["target"]["node"] == index:
                    sampler = animation["samplers"][channel["sampler"]]
                    times = self.accessor(sampler["input"])[:, 0]
                    weights = self.accessor(sampler["output"])[:, 0].reshape(len(times), len(targets))
                    return times, [first + sum((w * t for w, t in zip(row, targets) if w), numpy.zeros_like(first)) for row in weights]
        return [0], [first]


class GodotScene:
    """A reader of text scenes of Godot 3 and 4, in which every name of a resource must lead somewhere."""

    def __init__(self, text, version):
        self.version, self.resources, self.nodes = version, {}, {}
        self.arrays = ({"PackedVector2Array": 2, "PackedFloat32Array": 1, "PackedInt32Array": 0} if version == 4 else
                       {"PoolVector2Array": 2, "PoolRealArray": 1, "PoolIntArray": 0})
        sections = re.split(r"(?m)^\[(\w+)((?: [^\]\n]*)?)\]\n", text)
        assert sections[0] == "" and sections[1] == "gd_scene"
        counted, named = 0, set()
        for kind, head, body in zip(sections[1::3], sections[2::3], sections[3::3]):
            self.text, self.at = head, 0
            attributes = {}
            while self.text[self.at:].strip():
                key = re.compile(r"\s*(\w+)=").match(self.text, self.at)
                self.at = key.end()
                attributes[key[1]] = self.value()
            self.text, self.at = body, 0
            properties = {}
            while self.text[self.at:].strip():
                key = re.compile(r"\s*([\w/]+) = ").match(self.text, self.at)
                assert key[1] not in properties
                self.at = key.end()
                properties[key[1]] = self.value()
            if kind == "gd_scene":
                assert attributes["format"] == version - 1 and not properties
                steps = attributes["load_steps"]
            elif kind in ("ext_resource", "sub_resource"):
                counted += 1
                assert isinstance(attributes["id"], str if version == 4 else int)
                key = (kind, attributes["id"])
                assert key not in self.resources
                self.resources[key] = {**attributes, **properties}
            else:
                assert kind == "node" and attributes["name"] not in self.nodes
                assert ("parent" in attributes) == bool(self.nodes)  # the root comes first
                assert not set(attributes["name"]) & set('.:@/"%')
                self.nodes[attributes["name"]] = properties
        assert steps == counted + 1

    def value(self):
        """The value at the current place, behind which it moves."""
        word = re.compile(r'\s*("(?:[^"\\]|\\.)*"|-?[\d.]+(?:e[+-]?\d+)?|\w+|[\[{])').match(self.text, self.at)
        self.at, token = word.end(), word[1]
        if token[0] == '"':
            return json.loads(token)
        if token == "[":
            return self.items("]", self.value)
        if token == "{":
            return dict(self.items("}", self.pair))
        if token in ("true", "false"):
            return token == "true"
        if not token[0].isalpha():
            return float(token) if re.search("[.e]", token) else int(token)
        assert self.text[self.at] == "("
        self.at += 1
        items = self.items(")", self.value)
        if token in ("ExtResource", "SubResource"):
            return self.resources[({"E": "ext_resource", "S": "sub_resource"}[token[0]], items[0])]
        if token in self.arrays:
            return numpy.array(items, float).reshape(-1, 2) if self.arrays[token] == 2 else items
        assert token in ("NodePath", "Color"), token
        return items[0] if token == "NodePath" else items

    def pair(self):
        key = self.value()
        colon = re.compile(r"\s*:").match(self.text, self.at)
        self.at = colon.end()
        return key, self.value()

    def items(self, end, read):
        found = []
        while True:
            space = re.compile(r"[\s,]*").match(self.text, self.at)
            self.at = space.end()
            if self.text[self.at] == end:
                self.at += 1
                return found
            found.append(read())


class Meshes(Case):
    def positions(self, scene, *words):
        """The vertices of the edited layer's mesh, as `holomorph map` computes them."""
        self.good("export", scene, "--format", "npy", "--out", self.path("v.npy"), "--force", *words)
        return numpy.load(self.path("v.npy"))

    def content(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def moving(self, rng, layers=2):
        """Layers with random poses at random times."""
        w, h = 120, 90
        list = []
        for i in range(layers):
            Image.effect_mandelbrot((w, h), (-2, -1, 1, 1), 20 + i).convert("RGB").save(self.path(f"{i}.png"))
            cage = [[10, 10], [110, 10], [110, 80], [10, 80]]
            keys = [{"time": t, "pose": {"cage": [[[x + rng.uniform(-15, 15), y + rng.uniform(-15, 15)]] for x, y in cage]}}
                    for t in sorted(rng.sample(range(1, 12), 3))]
            for key in keys:
                key["time"] /= 8
            list.append({"name": f"layer {i}", "image": {"file": f"{i}.png"}, "cage": {"rest": [[p] for p in cage]},
                         "method": {"id": rng.choice(["cage", "harmonic", "mean_value"])}, "keyframes": keys,
                         "opacity": [1, 0.5][i % 2]})
        return self.write("moving.json", {"format": "holomorph", "version": 2, "animation": {"frames_per_second": 8}, "layers": list})

    EACH_FRAME = ("--full-mesh", "--rate", "8")  # of moving()

    def times(self, scene):
        scene = json.loads(self.content(scene))
        layers = scene.get("layers", [scene])
        last = max(key["time"] for layer in layers for key in layer.get("keyframes", []))
        return scene["animation"]["frames_per_second"], last

    def test_gltf_has_the_vertices_of_the_map_at_every_frame(self):
        for seed in (1, seed_of("moving meshes", 2)):
            with self.subTest(seed=seed):
                scene = self.moving(random.Random(seed))
                self.good("export", scene, "--format", "glb", *self.EACH_FRAME, "--out", self.path("m.glb"), "--force")
                glb = Glb(self.path("m.glb"))
                times, frames = glb.frames("layer 1")  # the edited one
                rate, _ = self.times(scene)
                numpy.testing.assert_allclose(times, numpy.arange(len(times)) / rate, atol=1e-6)
                for time, frame in zip(times, frames):
                    wanted = self.positions(scene, "--time", time) / 100
                    self.assertLess(numpy.abs(frame[:len(wanted), :2] - wanted).max(), 1e-5, (seed, time))
                    self.assertTrue((frame[:, 2] == 0).all())
                places = [node["translation"] for node in glb.json["nodes"] if node["name"].startswith("layer")]
                self.assertEqual(places, [[0, 0, 0], [0, 0, 0.01]])  # a pixel apart
                material = glb.json["materials"][glb.json["meshes"][1]["primitives"][0]["material"]]
                self.assertEqual(material["pbrMetallicRoughness"]["baseColorFactor"], [1, 1, 1, 0.5])
                self.assertIn("KHR_materials_unlit", material["extensions"])

    def test_what_does_not_move_is_stored_once(self):
        scene = json.loads(self.content(self.moving(random.Random(3))))
        del scene["layers"][0]["keyframes"]
        self.good("export", self.write("half.json", scene), "--format", "glb", "--out", self.path("m.glb"))
        glb = Glb(self.path("m.glb"))
        first, second = glb.json["meshes"]
        self.assertNotIn("targets", first["primitives"][0])
        self.assertEqual(len(second["primitives"][0]["targets"]), len(second["weights"]))

    def test_the_error_that_is_said_is_the_error(self):
        rng = random.Random(seed_of("meshes", 3))
        scene = self.moving(rng, 1)
        for options, step in ((self.EACH_FRAME, 1 / 8), (["--full-mesh", "--rate", "4"], 1 / 4)):
            said = self.good("export", scene, "--format", "glb", "--out", self.path("m.glb"), "--force", *options).stderr
            told = float(re.search(r"at most (\S+) px off between frames", said)[1])
            times, frames = Glb(self.path("m.glb")).frames("layer 0")
            farthest = 0
            for a, b, fa, fb in zip(times, times[1:], frames, frames[1:]):
                self.assertLessEqual(b - a, step + 1e-6)
                wanted = self.positions(scene, "--time", (float(a) + float(b)) / 2)
                between = 50 * (fa + fb)[:len(wanted), :2]
                farthest = max(farthest, numpy.hypot(*(between - wanted).T).max())
            self.assertGreaterEqual(told, farthest * 0.9, options)
            self.assertLessEqual(told, farthest * 1.6 + 0.01, options)

    def test_the_fern_is_precise_between_its_frames(self):
        said = self.good("export", FERN, "--format", "glb", "--out", self.path("f.glb")).stderr
        self.assertLessEqual(float(re.search(r"at most (\S+) px off between frames", said)[1]), 0.25)
        self.assertIn("some programs do not load more than 256 morph targets", said)
        said = self.good("export", FERN, "--format", "glb", "--rate", "12", "--vertices", "500", "--out", self.path("f.glb"), "--force").stderr
        self.assertLess(float(re.search(r"at most (\S+) px off at the frames", said)[1]), 3)
        self.assertIn("more vertices are closer", said)
        said = self.good("export", FERN, "--format", "glb", "--rate", "12", "--out", self.path("f.glb"), "--force").stderr
        self.assertIn("without a rate are closer", said)

    def test_the_fewest_vertices_and_frames_are_as_close_as_is_said(self):
        for seed in (1, seed_of("fewest vertices and frames", 2)):
            with self.subTest(seed=seed):
                rng = random.Random(seed)
                scene = json.loads(self.content(self.moving(rng, 1)))
                scene["layers"][0]["keyframes"][0]["ease"] = rng.choice(["hold", "linear", "smooth"])
                scene = self.write("eased.json", scene)
                said = self.good("export", scene, "--format", "glb", "--out", self.path("few.glb"), "--force").stderr
                told = max(map(float, re.findall(r"at most (\S+) px off", said)))
                self.assertLessEqual(told, 0.25)
                times, few = Glb(self.path("few.glb")).frames("layer 0")
                self.good("export", scene, "--format", "glb", "--full-mesh", "--rate", "8", "--out", self.path("all.glb"), "--force")
                _, every = Glb(self.path("all.glb")).frames("layer 0")
                self.assertLess(len(few[0]), len(every[0]) / 3)
                # The kept vertices, by where they are in the first frame, at times that were not asked for.
                rest = self.positions(scene, "--time", times[0])
                kept = [int(numpy.hypot(*(rest - 100 * v[:2]).T).argmin()) for v in few[0]]
                inner = [i for i, k in enumerate(kept) if numpy.hypot(*(rest[k] - 100 * few[0][i][:2])) < 1e-3]  # not the surroundings
                self.assertGreaterEqual(len(inner), 4)
                for _ in range(12):
                    time = rng.uniform(times[0], times[-1])
                    at = min(int(numpy.searchsorted(times, time)), len(times) - 1)
                    a, b = float(times[at - 1]), float(times[at])
                    if b - a <= 2e-3:
                        continue
                    u = (time - a) / (b - a)
                    drawn = 100 * ((1 - u) * few[at - 1] + u * few[at])[inner, :2]
                    exact = self.positions(scene, "--time", time)[[kept[i] for i in inner]]
                    self.assertLessEqual(numpy.hypot(*(drawn - exact).T).max(), 0.3, time)

    def test_a_short_motion_in_a_long_film_is_kept(self):
        """The vertices are chosen for all frames, also for those between the ones that are looked at first, and where a layer is enlarged."""
        for seed, scale in ((1, 1), (1, 5), (seed_of("short motions", 2), 1)):
            with self.subTest(seed=seed, scale=scale):
                rng = random.Random(seed)
                Image.new("RGBA", (300, 60), (90, 120, 200, 255)).save(self.path("bar.png"))
                start, rest = rng.uniform(4, 15), [{"pose": [x, 30]} for x in (20, 150, 280)]
                raised = rest[:2] + [{"pose": [220, 30 + rng.uniform(60, 90)]}]
                keys = [{"time": time, "pose": {"pins": pins}} for time, pins in
                        ((0, rest), (start, rest), (start + 0.25, raised), (start + 0.5, rest), (20, rest))]
                scene = {"format": "holomorph", "version": 2, "layers": [
                    {"image": {"file": "bar.png"}, "cage": {"rest": [[[x, y]] for x, y in ((0, 0), (300, 0), (300, 60), (0, 60))]},
                     "pins": [{"rest": pin["pose"]} for pin in rest], "method": {"id": "sheet"}, "keyframes": keys,
                     "placement": {"factor": [scale, 0], "shift": [0, 0]}}]}
                said = self.good("export", self.write("wave.json", scene), "--format", "glb", "--out", self.path("w.glb"), "--force").stderr
                error = float(re.search(r"at most ([0-9.e+-]+) px off", said).group(1))
                self.assertLess(error, 0.5, (seed, said))

    def test_held_poses_jump_at_their_ends(self):
        scene = json.loads(self.content(self.moving(random.Random(5), 1)))
        for key in scene["layers"][0]["keyframes"]:
            key["ease"] = "hold"
        for options in ((), ("--keys",)):
            self.good("export", self.write("held.json", scene), "--format", "glb", *options, "--out", self.path("h.glb"), "--force")
            times, _ = Glb(self.path("h.glb")).frames("layer 0")
            for key in scene["layers"][0]["keyframes"][1:]:
                self.assertLess(numpy.abs(times - (key["time"] - 1e-3)).min(), 1e-4, "the last moment before the jump")

    def test_fewer_vertices_are_some_of_all_and_say_their_error(self):
        said = self.good("export", FERN, "--format", "glb", "--out", self.path("f.glb"), "--frames", "0..3", "--vertices", "400").stderr
        told = float(re.search(r"at most (\S+) px off at the frames", said)[1])
        self.assertGreater(told, 0)
        glb = Glb(self.path("f.glb"))
        name = glb.json["nodes"][1]["name"]
        _, frames = glb.frames(name)
        all_vertices = self.positions(FERN, "--time", "0") / 100
        kept = frames[0][:, :2]
        # Except for the faint surroundings, each vertex is one of the whole mesh.
        distance = [numpy.hypot(*(all_vertices - v).T).min() for v in kept[:300]]
        self.assertLess(max(distance), 1e-5)

    def test_keys_alone_are_exported(self):
        scene = self.moving(random.Random(8), 1)
        self.good("export", scene, "--format", "glb", "--out", self.path("k.glb"), "--keys")
        times, _ = Glb(self.path("k.glb")).frames("layer 0")
        keys = [key["time"] for key in json.loads(self.content(scene))["layers"][0]["keyframes"]]
        self.assertLessEqual({round(k, 5) for k in keys}, {round(float(t), 5) for t in times} | {0.0})
        self.assertLessEqual(len(times), len(keys) + 2)

    def test_vertex_caches_have_the_vertices_of_the_map(self):
        scene = self.moving(random.Random(9), 1)
        rate, _ = self.times(scene)
        for kind in ("mdd", "pc2"):
            self.good("export", scene, "--format", kind, "--out", self.path("c." + kind), "--frames", "0..4")
        data = self.content("c.mdd")
        frames, points = struct.unpack_from(">II", data)
        times = numpy.frombuffer(data, ">f4", frames, 8)
        mdd = numpy.frombuffer(data, ">f4", -1, 8 + 4 * frames).reshape(frames, points, 3)
        data = self.content("c.pc2")
        magic, version, count, start, step, samples = struct.unpack_from("<12siiffi", data)
        self.assertEqual((magic, version, count, start, step, samples), (b"POINTCACHE2\0", 1, points, 0, 1, frames))
        pc2 = numpy.frombuffer(data, "<f4", -1, 32).reshape(frames, points, 3)
        self.assertEqual(frames, 5)
        self.assertTrue((mdd == pc2).all())
        for k, time in enumerate(times):
            wanted = self.positions(scene, "--time", k / rate)
            self.assertAlmostEqual(float(time), k / rate, 5)
            self.assertLess(numpy.abs(mdd[k, :, :2] - wanted).max(), 1e-4)

    def test_obj_sequences_share_a_material(self):
        scene = self.moving(random.Random(10), 1)
        rate, _ = self.times(scene)
        self.good("export", scene, "--format", "obj", "--out", self.path("o.obj"), "--frames", "2..4")
        self.assertTrue(os.path.exists(self.path("o.mtl")) and os.path.exists(self.path("o-texture.png")))
        for k in (2, 3, 4):
            lines = self.content(f"o-{k:04}.obj").decode().split("\n")
            self.assertEqual(lines[0], "mtllib o.mtl")
            seen = numpy.array([[float(x) for x in line.split()[1:3]] for line in lines if line.startswith("v ")])
            self.assertLess(numpy.abs(seen - self.positions(scene, "--time", k / rate)).max(), 1e-5)
            if k == 2:
                told = subprocess.run(["assimp", "info", self.path("o-0002.obj")], capture_output=True, text=True)
                self.assertIn(f"Vertices:           {len(seen)}", told.stdout)

    def test_assimp_reads_the_gltf(self):
        scene = self.moving(random.Random(11))
        self.good("export", scene, "--format", "glb", "--out", self.path("a.glb"))
        told = subprocess.run(["assimp", "info", self.path("a.glb")], capture_output=True, text=True)
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
        self.assertRegex(told.stdout, r"Meshes:\s+2\b")
        self.assertRegex(told.stdout, r"Animations:\s+1\b")
        self.assertRegex(told.stdout, r"Textures \(embed\.\):\s+2\b")

    def test_godot_scenes_have_the_frames(self):
        for version, seed in (("godot", 12), ("godot3", 12), ("godot", seed_of("Godot scenes", 13))):
            with self.subTest(version=version, seed=seed):
                scene = self.moving(random.Random(seed), 1)
                rate, length = self.times(scene)
                self.good("export", scene, "--format", version, *self.EACH_FRAME, "--out", self.path("g.tscn"), "--force")
                godot = GodotScene(self.content("g.tscn").decode(), 3 if version == "godot3" else 4)
                mesh, player = godot.nodes["layer 0"], godot.nodes["AnimationPlayer"]
                self.assertEqual(mesh["texture"]["path"], "g-layer 0.png")
                size = Image.open(self.path("g-layer 0.png")).size
                self.assertTrue(((-1e-3 <= mesh["uv"]) & (mesh["uv"] <= numpy.array(size) + 1e-3)).all())
                self.assertEqual(len(mesh["uv"]), len(mesh["polygon"]))
                self.assertEqual(sorted({i for t in mesh["polygons"] for i in t}), list(range(len(mesh["uv"]))))
                self.assertEqual(player["autoplay"], "motion")
                motion = player["anims/motion"] if version == "godot3" else player["libraries"][""]["_data"]["motion"]
                self.assertTrue(motion["loop"] is True if version == "godot3" else motion["loop_mode"] == 1)
                self.assertAlmostEqual(motion["length"], length, places=6)
                self.assertEqual((motion["tracks/0/type"], motion["tracks/0/path"]), ("value", "layer 0:polygon"))
                self.assertEqual((motion["tracks/0/interp"], motion["tracks/0/keys"]["update"]), (1, 0))
                keys = motion["tracks/0/keys"]
                self.assertEqual(len(keys["values"]), round(length * rate) + 1)
                self.assertEqual(len(keys["transitions"]), len(keys["values"]))
                self.assertTrue((keys["values"][0] == mesh["polygon"]).all())
                for k, (time, frame) in enumerate(zip(keys["times"], keys["values"], strict=True)):
                    self.assertAlmostEqual(time, k / rate, places=6)
                    self.assertLess(numpy.abs(frame * [1, -1] - self.positions(scene, "--time", k / rate)).max(), 1e-4)

    def test_nothing_is_smeared_where_the_mesh_is_larger_than_the_picture(self):
        """Engines repeat the outermost pixels of a texture."""
        pixels = numpy.random.default_rng(3).integers(0, 256, (40, 60, 4)).astype(numpy.uint8)
        pixels[..., 3] = 255
        Image.fromarray(pixels, "RGBA").save(self.path("photo.png"))
        for margin, border in ((6, 1), (0, 0)):
            cage = [[[-margin, -margin]], [[60 + margin, -margin]], [[60 + margin, 40 + margin]], [[-margin, 40 + margin]]]
            scene = self.write("loose.json", {"format": "holomorph", "version": 1, "image": {"file": "photo.png"}, "cage": {"rest": cage}})
            self.good("export", scene, "--format", "godot", "--full-mesh", "--out", self.path("l.tscn"), "--force")
            mesh = next(node for node in GodotScene(self.content("l.tscn").decode(), 4).nodes.values() if "polygon" in node)
            texture = numpy.asarray(Image.open(self.path(mesh["texture"]["path"])).convert("RGBA"))
            self.assertEqual(texture.shape, (40 + 2 * border, 60 + 2 * border, 4))
            inner = texture[border:40 + border, border:60 + border]
            self.assertTrue((inner == pixels).all())
            self.assertEqual(texture[..., 3].astype(int).sum(), 255 * 40 * 60)
            self.assertLess(numpy.abs(mesh["uv"] - border - (mesh["polygon"] + [0, 40])).max(), 1e-4)  # nothing is bent

    def test_names_of_layers_can_be_names_of_files_and_nodes(self):
        names = ["Arm", "arm", "AnimationPlayer", "ß" * 300, "ü" + "ß" * 300, "", "a/b:c", "a/b:c"]
        scene = json.loads(self.content(self.moving(random.Random(1), 1)))
        scene["layers"] = [{**scene["layers"][0], "name": name} for name in names]
        path = self.write("names.json", scene)
        for kind, out in (("godot", "n.tscn"), ("godot3", "n.tscn"), ("spine", "n.json")):
            self.good("export", path, "--format", kind, "--time", "0", "--out", self.path(out), "--force")
            pictures = [name for name in os.listdir(self.folder) if name.startswith("n-")]
            self.assertEqual(len({name.lower() for name in pictures}), len(names), pictures)
            for name in pictures:
                os.remove(self.path(name))
            if kind != "spine":
                meshes = [node for node in GodotScene(self.content(out).decode(), 3 if kind == "godot3" else 4).nodes if node != "Holomorph"]
                self.assertEqual(len(meshes), len(names))
                self.assertNotIn("AnimationPlayer", meshes)

    def test_godot_versions_differ_in_words_alone(self):
        scene = self.moving(random.Random(5), 3)
        texts = []
        for version in ("godot", "godot3"):
            self.good("export", scene, "--format", version, "--out", self.path("g.tscn"), "--force")
            text = self.content("g.tscn").decode()
            GodotScene(text, 3 if version == "godot3" else 4)
            texts.append(text)
        four = texts[0]
        for new, old in (("format=3", "format=2"), ("Texture2D", "Texture"), ("PackedVector2Array", "PoolVector2Array"),
                         ("PackedFloat32Array", "PoolRealArray"), ("PackedInt32Array", "PoolIntArray"), ("loop_mode = 1", "loop = true"),
                         ('\n[sub_resource type="AnimationLibrary" id="2"]\n_data = {\n"motion": SubResource("1")\n}\n', ""),
                         ('libraries = {\n"": SubResource("2")\n}', "anims/motion = SubResource(1)")):
            self.assertIn(new, four)
            four = four.replace(new, old)
        four = re.sub(r'(id=|Resource\()"(\d+)"', r"\1\2", four)
        steps = re.compile(r"load_steps=(\d+)")
        self.assertEqual(int(steps.search(four)[1]), int(steps.search(texts[1])[1]) + 1)  # the library
        self.assertEqual(steps.sub("", four), steps.sub("", texts[1]))

    def test_spine_skeletons_are_whole(self):
        scene = self.moving(random.Random(13))
        self.good("export", scene, "--format", "spine", *self.EACH_FRAME, "--out", self.path("s.json"))
        frames = round(self.times(scene)[1] * 8) + 1
        skeleton = json.loads(self.content("s.json"))
        self.assertEqual([slot["name"] for slot in skeleton["slots"]], ["layer 0", "layer 1"])
        for slot in skeleton["slots"]:
            mesh = skeleton["skins"][0]["attachments"][slot["name"]][slot["attachment"]]
            self.assertTrue(os.path.exists(self.path(mesh["path"] + ".png")))
            count = len(mesh["vertices"]) // 2
            self.assertEqual(len(mesh["uvs"]), 2 * count)
            self.assertEqual(sorted(set(mesh["triangles"])), list(range(count)))
            self.assertTrue(3 <= mesh["hull"] <= count)
            # The edges between successive hull vertices are edges of triangles.
            t = numpy.array(mesh["triangles"]).reshape(-1, 3)
            edges = {tuple(e) for e in numpy.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]).tolist()}
            for k in range(mesh["hull"]):
                self.assertIn((k, (k + 1) % mesh["hull"]), edges)
            deform = skeleton["animations"]["motion"]["attachments"]["default"][slot["name"]][slot["attachment"]]["deform"]
            self.assertEqual(len(deform), frames)
            self.assertTrue(all(len(key["vertices"]) == 2 * count for key in deform))
            self.assertTrue(all(math.isfinite(x) for key in deform for x in key["vertices"]))

    def test_still_scenes_and_wrong_options(self):
        still = os.path.join(SOURCE, "assets/gecko.json")
        self.good("export", still, "--format", "glb", "--out", self.path("still.glb"))
        self.assertNotIn("animations", Glb(self.path("still.glb")).json)
        for words, says in ((["--format", "mdd", "--rate", "5"], "--rate cannot be used with mdd"),
                            (["--format", "svg", "--vertices", "50"], "--vertices cannot be used with svg"),
                            (["--format", "glb", "--scale", "2"], "--scale cannot be used with glb")):
            self.bad("export", FERN, "--out", self.path("x"), *words, says=says)
        self.bad("export", FERN, "--out", "-", "--format", "godot", says="several files")
        self.bad("export", still, "--format", "glb", "--keys", "--out", self.path("x.glb"), says="single moment")

    def test_what_engines_cannot_show_is_said(self):
        with open(os.path.join(SOURCE, "assets/gecko.json")) as file:
            layer = {key: value for key, value in json.load(file).items() if key in ("cage", "method", "pins")}
        Image.new("RGBA", (900, 600), (40, 90, 60, 255)).save(self.path("green.png"))
        layer["image"] = {"file": "green.png"}
        layers = [{**layer, "name": "Low"}, {**layer, "name": "High", "blending": "multiply", "clipped": True}]
        both = ["High: its clipping is not kept", "High: its blending mode is not kept"]
        for background, said in (({}, []), ({"background": "#204060"}, ["Background: its color is not kept"]),
                                 ({"background": "original"}, ["Background: the original is not kept"])):
            scene = self.write("said.json", {"format": "holomorph", "version": 2, "layers": layers, **background})
            for kind, out in (("glb", "said.glb"), ("godot", "said.tscn"), ("godot3", "said3.tscn"), ("spine", "spine.json")):
                stderr = self.good("export", scene, "--format", kind, "--out", self.path(out), "--force").stderr
                self.assertEqual(stderr.splitlines()[:-1], ["holomorph: " + text for text in said + both], (kind, background))

    def test_the_scenes_own_picture_is_not_replaced(self):
        for name in ("fern.json", "fern.png"):
            shutil.copy(os.path.join(SOURCE, "assets", name), self.folder)
        with open(self.path("fern.png"), "rb") as file:
            before = file.read()
        self.good("export", self.path("fern.json"), "--format", "obj", "--frames", "0..1", "--out", self.path("fern.obj"))
        self.good("export", self.path("fern.json"), "--format", "godot", "--frames", "0..1", "--out", self.path("fern.tscn"))
        self.assertEqual(self.content("fern.png"), before)
        self.assertFalse(os.path.exists(self.path("x")))


if __name__ == "__main__":
    timed.main(sys.argv[3:])
