# The command line: exact numbers, the published schema, and errors for bad input.
import copy
import csv
import io
import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
import zipfile

import jsonschema
import numpy
from PIL import Image, ImageOps

from case import PROGRAM, SOURCE, Case, old_sample, run, timed

SCHEMA = json.load(open(os.path.join(SOURCE, "schema/scene.schema.json")))
SAMPLES = ["giraffe", "gecko", "sunflower", "fish", "octopus", "snake", "heart", "tiger", "fern"]


class CommandLine(Case):
    # ---- numbers -----------------------------------------------------------------------------

    def golden_scene(self, name):
        data = json.load(open(os.path.join(SOURCE, "tests/data", name + ".json")))
        flat = data["polygon"]
        polygon = flat if isinstance(flat[0], list) else [flat[2 * i:2 * i + 2] for i in range(len(flat) // 2)]
        pose = []
        for e, degree in enumerate(data["degrees"]):
            controls = data["target"][e]
            pose.append([controls[2 * m:2 * m + 2] for m in range(degree)])
        return data, {"format": "holomorph", "version": 1, "cage": {"rest": [[p] for p in polygon], "pose": pose}}

    def test_map_and_coordinates_equal_the_golden_values(self):
        for name in ["convex_hex", "star5", "concave_L", "notch_ratio1e4", "sliver"]:
            data, scene = self.golden_scene(name)
            path = self.write("s.json", scene)
            inside = [q for q in data["queries"] if q["kind"] in ("interior", "near_vertex", "far_from_short_edge")]
            outside = [q for q in data["queries"] if q["kind"] == "exterior"]
            points = self.write("p.csv", "".join("%r,%r\n" % tuple(q["z"]) for q in inside + outside))
            rows = list(csv.DictReader(io.StringIO(self.good("map", path, "--points", points).stdout)))
            self.assertEqual(list(rows[0]), ["u", "v", "fz_re", "fz_im", "fzbar_re", "fzbar_im"])
            for query, row in zip(inside, rows):
                for order, (re, im) in enumerate((("u", "v"), ("fz_re", "fz_im"))):
                    exact = complex(*query["map"][order])
                    scale = sum(abs(complex(*pair)) for edge in query["bezier"][str(order)]
                                for pair in zip(edge[::2], edge[1::2])) * 3
                    got = complex(float(row[re]), float(row[im]))
                    self.assertLessEqual(abs(got - exact), 1e-12 * max(scale, abs(exact)), (name, query["kind"], order))
                self.assertEqual(float(row["fzbar_re"]), 0)
            for row in rows[len(inside):]:
                self.assertEqual(set(row.values()), {"nan"})
            self.good("coordinates", path, "--points", points, "--out", self.path("m.npy"))
            matrix = numpy.load(self.path("m.npy"))
            self.assertEqual(matrix.dtype, numpy.complex128)
            self.assertEqual(matrix.shape, (len(inside) + len(outside), sum(data["degrees"])))
            numpy.testing.assert_allclose(matrix.sum(axis=1)[:len(inside)], 1, atol=1e-11)
            numpy.testing.assert_allclose(matrix.sum(axis=1)[len(inside):], 0, atol=1e-11)
            pose = numpy.array([complex(*c) for segment in scene["cage"]["pose"] for c in segment])
            mapped = matrix @ pose
            numpy.testing.assert_allclose(mapped[:len(inside)], [complex(float(r["u"]), float(r["v"])) for r in rows[:len(inside)]], atol=1e-9)

    def test_a_clockwise_cage_is_the_same_map(self):
        data, scene = self.golden_scene("concave_L")
        scene["cage"]["pose"] = [[[p[0][0] * 1.5 + 0.2 * p[0][1], p[0][1]]] for p in scene["cage"]["rest"]]
        points = self.write("p.csv", "".join("%r,%r\n" % tuple(q["z"]) for q in data["queries"] if q["kind"] == "interior"))
        one = self.good("map", self.write("a.json", scene), "--points", points).stdout
        for shape in ("rest", "pose"):
            loop = scene["cage"][shape]
            scene["cage"][shape] = [loop[0]] + loop[:0:-1]
        two = self.good("map", self.write("b.json", scene), "--points", points).stdout
        a, b = (numpy.array([[float(x) for x in line.split(",")] for line in text.split()[1:]]) for text in (one, two))
        numpy.testing.assert_allclose(a, b, atol=1e-12)

    def test_derivatives_of_higher_order(self):
        data, scene = self.golden_scene("convex_hex")
        query = next(q for q in data["queries"] if q["kind"] == "interior")
        points = self.write("p.csv", "%r,%r\n" % tuple(query["z"]))
        pose = numpy.array([complex(*c) for segment in scene["cage"]["pose"] for c in segment])
        for order in range(len(query["map"])):
            self.good("coordinates", self.write("s.json", scene), "--points", points, "--order", order, "--out", self.path("m.npy"))
            got = (numpy.load(self.path("m.npy")) @ pose)[0]
            exact = complex(*query["map"][order])
            self.assertLessEqual(abs(got - exact), 1e-11 * max(1, abs(exact)))

    # ---- scenes and pictures -----------------------------------------------------------------

    def test_samples_and_new_scenes_fulfil_the_schema(self):
        scenes = [name for name in os.listdir(os.path.join(SOURCE, "assets")) if name.endswith(".json")]
        self.assertEqual(sorted(scenes), sorted(name + ".json" for name in SAMPLES))
        self.assertEqual(len(SAMPLES), 9)
        for name in SAMPLES:
            sample = json.load(open(os.path.join(SOURCE, "assets", name + ".json")))
            jsonschema.validate(sample, SCHEMA)
            picture = os.path.join(SOURCE, "assets", sample["image"]["file"])
            out = self.path(name + ".json")
            self.good("new", "--force", picture, "--out", out, "--vertices", 24, "--margin", 9)
            scene = json.load(open(out))
            jsonschema.validate(scene, SCHEMA)
            self.assertLessEqual(abs(len(scene["cage"]["rest"]) - 24), 12)
            # A new scene shows its picture bit for bit.
            self.good("render", out, "--allow-outside", "--out", self.path("r.png"))
            self.assertEqual(Image.open(self.path("r.png")).convert("RGBA").tobytes(), Image.open(picture).convert("RGBA").tobytes())

    def test_each_space_of_maps_without_folds_is_certified(self):
        shutil.copy(os.path.join(SOURCE, "assets", "octopus.png"), self.folder)
        scene = json.load(open(old_sample("octopus")))
        for space in ("nu", "psi", "h"):
            scene["method"]["parameters"] = {"space": space, "pin_weight": 1e4, "reference": "har_arap"}
            jsonschema.validate(scene, SCHEMA)
            path = self.path(space + ".json")
            with open(path, "w") as file:
                json.dump(scene, file)
            report = json.loads(self.good("info", path, "--json").stdout)
            self.assertTrue(report["certified"], space)
            self.assertEqual(report["flipped_triangles"], 0)
            self.assertAlmostEqual(report["turning_number"], 1, places=6)
            self.assertLessEqual(report["max_k"], 0.7)
            self.assertLessEqual(report["max_sigma"], 5)
            self.assertGreaterEqual(report["min_sigma"], 0.2)
        scene["method"]["parameters"]["space"] = "rigid"
        with open(path, "w") as file:
            json.dump(scene, file)
        self.bad("info", path, says="/method/parameters/space")

    def test_an_outline_is_met_and_kept_in_the_file(self):
        shutil.copy(os.path.join(SOURCE, "assets", "gecko.png"), self.folder)
        scene = json.load(open(old_sample("gecko")))
        n = 120
        scene["outline"] = [[400 + 300 * math.cos(2 * math.pi * i / n), 300 + 200 * math.sin(2 * math.pi * i / n)]
                            for i in range(n)]
        scene["cage"] = {"rest": [[[0, 0]], [[800, 0]], [[800, 600]], [[0, 600]]]}
        scene["pins"] = []
        scene["method"] = {"id": "outline", "parameters": {"softness": 0.5}}
        jsonschema.validate(scene, SCHEMA)
        path = self.write("scene.json", scene)
        report = json.loads(self.good("info", path, "--json").stdout)
        self.assertIn("met to", report["note"])
        # At a corner of 90 degrees, f behaves like z^2. A triangle of size h at distance r from it can
        # flip only if h |f''| / |f'| = h / r is at least 1, so only triangles that touch a corner can.
        vertices, triangles = self.obj_of(path)
        rest = dict(scene, method={"id": "cage"})
        del rest["outline"]
        at_rest = self.obj_of(self.write("rest.json", rest))[0].tolist()
        corners = {at_rest.index(list(map(float, z))) for z, in scene["cage"]["rest"]}
        a, b, c = (vertices[list(column)] @ [1, 1j] for column in zip(*triangles))
        flipped = numpy.array(triangles)[((b - a).conj() * (c - a)).imag <= 0].tolist()
        self.assertEqual(len(flipped), report["flipped_triangles"])
        for triangle in flipped:
            self.assertTrue(corners & set(triangle), triangle)
        self.assertNotIn("folds", report["note"])
        # The cage's corners are mapped onto the ellipse.
        corners = "\n".join(f"{x},{y}" for (x, y), *_ in scene["cage"]["rest"])
        out = self.good("map", path, "--points", self.write("p.csv", corners)).stdout
        for line in out.strip().split("\n")[1:]:
            u, v = map(float, line.split(",")[:2])
            self.assertLess(abs(math.hypot((u - 400) / 300, (v - 300) / 200) - 1), 0.03)
        scene["outline"] = [[0, 0], [10, 0], [0, 10], [10, 10]]
        self.bad("info", self.write("bad.json", scene), says="/outline: the outline crosses itself")

    def test_outlines_from_svg_and_from_a_picture(self):
        gecko, fish = (os.path.join(SOURCE, "assets", name) for name in ("gecko.png", "fish.png"))
        scene = self.path("onto.json")
        svg = self.write("egg.svg", '<svg><path d="M300 500 C300 200 800 200 800 500 C800 800 300 800 300 500 Z"/></svg>')
        self.good("new", "--force", gecko, "--out", scene, "--outline", svg)
        outline = numpy.array(json.load(open(scene))["outline"])
        self.assertAlmostEqual(outline[:, 0].min(), 300, delta=0.1)
        self.assertAlmostEqual(outline[:, 1].mean(), 400, delta=2)  # the picture is 900 high
        self.good("new", "--force", gecko, "--out", scene, "--outline", fish)
        made = json.load(open(scene))
        outline, cage = numpy.array(made["outline"]), numpy.array([s[0] for s in made["cage"]["rest"]])
        size = lambda p: numpy.linalg.norm(p.max(axis=0) - p.min(axis=0))
        self.assertAlmostEqual(size(outline), size(cage), delta=1e-6 * size(cage))
        report = json.loads(self.good("info", scene, "--allow-outside", "--json").stdout)
        self.assertEqual(report["method"], "outline")
        self.assertIn("met to", report["note"])
        line = self.write("line.svg", '<svg><path d="M0 0 L10 10 L20 20 Z"/></svg>')
        self.bad("new", "--force", gecko, "--out", scene, "--outline", line, says="line.svg: ")
        self.bad("new", "--force", gecko, "--out", scene, "--outline", self.write("no.png", "none"), says="no.png")

    def test_a_texture_goes_onto_a_surface_and_from_there_onto_another(self):
        fish, mask, leaf = (os.path.join(SOURCE, "assets", name) for name in ("fish.png", "mask.obj", "leaf.obj"))
        scene, out = self.path("mask.json"), self.path("textured.obj")
        self.good("new", "--force", fish, "--out", scene, "--outline", mask, "--flattening", "circle")
        self.good("export", scene, "--allow-outside", "--format", "textured", "--out", out, "--scale", 0.5)
        lines = open(out).read().split("\n")
        count = lambda kind, text: sum(line.startswith(kind + " ") for line in text)
        source = open(mask).read().split("\n")
        for kind in ("v", "f"):
            self.assertEqual(count(kind, lines), count(kind, source))
        self.assertEqual(count("vt", lines), count("v", lines))
        self.assertIn("mtllib textured.mtl", lines)
        self.assertIn("map_Kd textured.png", open(self.path("textured.mtl")).read())
        # The fish covers a good part of the surface.
        texture = numpy.asarray(Image.open(self.path("textured.png")).convert("RGBA"))
        uv = numpy.array([[float(x) for x in line.split()[1:]] for line in lines if line.startswith("vt ")])
        self.assertGreaterEqual(uv.min(), 0)
        self.assertLessEqual(uv.max(), 1)
        h, w = texture.shape[:2]
        column, row = (uv[:, 0] * w).astype(int).clip(0, w - 1), ((1 - uv[:, 1]) * h).astype(int).clip(0, h - 1)
        self.assertGreater((texture[row, column, 3] > 128).mean(), 0.6)
        # Maps the mask's texture onto the leaf.
        second, other = self.path("leaf.json"), self.path("leaf-textured.obj")
        self.good("new", "--force", self.path("textured.png"), "--cage", out, "--out", second, "--outline", leaf)
        self.good("export", second, "--allow-outside", "--format", "textured", "--out", other)
        moved = numpy.asarray(Image.open(self.path("leaf-textured.png")).convert("RGBA"))
        self.assertGreater((moved[..., 3] > 128).sum(), 0.05 * moved.shape[0] * moved.shape[1])
        # Surfaces that do not fit are errors.
        bent, plain = self.path("bent.json"), self.path("plain.json")
        with open(scene) as file:
            values = json.load(file)
        self.assertTrue(values["surface"]["file"].endswith("assets/mask.obj"))
        values["outline"][3][0] += 9
        self.write("bent.json", json.dumps(values))
        self.bad("export", bent, "--allow-outside", "--format", "textured", "--out", other, says="not this surface's boundary")
        self.good("new", "--force", fish, "--out", plain)
        self.bad("export", plain, "--allow-outside", "--format", "textured", "--out", other, says="no surface")
        own = self.path("own.obj")
        shutil.copy(mask, own)
        self.good("new", "--force", fish, "--out", scene, "--outline", own)
        self.bad("export", scene, "--allow-outside", "--format", "textured", "--out", own, says="surface that the scene")
        self.bad("new", "--force", fish, "--out", scene, "--cage", mask, says="no texture coordinates")
        self.bad("new", "--force", fish, "--out", scene, "--outline", mask, "--flattening", "magic", says="magic")
        closed = self.write("closed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n")
        self.bad("new", "--force", fish, "--out", scene, "--outline", closed, says="closed.obj: the surface is not a disk: it is closed")

    def test_strokes_are_kept_in_the_file_and_what_is_none_is_named(self):
        scene = {"format": "holomorph", "version": 1,
                 "cage": {"rest": [[[0, 0]], [[400, 0]], [[400, 80]], [[0, 80]]]},
                 "strokes": [{"rest": [[30, 40], [370, 40]], "pose": [[30, 80], [200, 40], [370, 80]], "by": "hand"}],
                 "method": {"id": "strokes", "parameters": {"rigidity": 0.1}}}
        jsonschema.validate(scene, SCHEMA)
        path = self.write("scene.json", scene)
        report = json.loads(self.good("info", path, "--json").stdout)
        self.assertEqual(report["flipped_triangles"], 0)
        self.assertIn("misses the strokes by", report["note"])
        out = self.good("map", path, "--points", self.write("p.csv", "30,40\n200,40\n370,40")).stdout
        for (u, v), wanted in zip((map(float, line.split(",")[:2]) for line in out.strip().split("\n")[1:]), (80, 40, 80)):
            self.assertLess(abs(v - wanted), 8)
        scene["strokes"][0]["pose"] = [[5, 5], [5, 5]]
        self.bad("info", self.write("bad.json", scene), says="/strokes/0/pose: the stroke has no length")
        scene["strokes"] = [{"pose": [[5, 5], [6, 5]]}]
        self.bad("info", self.write("bad.json", scene), says="/strokes/0: the key 'rest' is missing")

    def test_angles_are_kept_in_the_file_and_turn_the_cage(self):
        bar = [[[0, 0]], [[60, 0]], [[60, 10]], [[0, 10]]]
        turn = 3 * math.pi
        scene = {"format": "holomorph", "version": 1, "cage": {"rest": bar}, "method": {"id": "angles"},
                 "corners": [{"vertex": 0}, {"vertex": 1, "before": turn, "after": turn},
                             {"vertex": 2, "before": turn, "after": turn}, {"vertex": 3}]}
        jsonschema.validate(scene, SCHEMA)
        points = self.write("p.csv", "".join("%g,5\n" % x for x in (5, 30, 55)))
        rows = list(csv.DictReader(io.StringIO(self.good("map", self.write("s.json", scene), "--points", points).stdout)))
        slopes = [complex(float(row["fz_re"]), float(row["fz_im"])) for row in rows]
        for x, slope in zip((5, 30, 55), slopes):  # f' = exp(i theta), and theta grows along the bar
            self.assertLess(abs(slope / abs(slope) - complex(math.cos(turn * x / 60), math.sin(turn * x / 60))), 1e-3)
        self.bad("info", self.write("bad.json", {**scene, "corners": scene["corners"][:2]}), says="three corners")

    def test_keyframes_are_rendered_at_times_and_as_numbered_frames(self):
        scene = self.keyed_scene()
        jsonschema.validate(scene, SCHEMA)
        path = self.write("s.json", scene)
        for time_, moved in ((0, 0), (0.5, 15), (1, 30), (7, 30)):
            self.good("render", path, "--time", time_, "--out", self.path("t.png"))
            picture = Image.open(self.path("t.png"))
            top = max(40, 30 + moved)  # height of the drawn region
            self.assertEqual(picture.height, top, time_)
        self.good("render", path, "--frames", "all", "--out", self.path("walk.png"))
        names = sorted(name for name in os.listdir(self.folder) if name.startswith("walk"))
        self.assertEqual(names, ["walk-000%d.png" % i for i in range(5)])
        sizes = {Image.open(self.path(name)).size for name in names}
        self.assertEqual(sizes, {(70, 60)})  # one rectangle for all of them
        # Rendering a range of frames gives the same files.
        whole = [open(self.path(name), "rb").read() for name in names]
        for name in names:
            os.remove(self.path(name))
        self.good("render", path, "--frames", "2..3", "--out", self.path("walk.png"))
        self.assertEqual([open(self.path(name), "rb").read() for name in names[2:4]], whole[2:4])
        self.assertFalse(os.path.exists(self.path(names[0])))

    def test_films_have_every_frame_for_its_time(self):
        path = self.write("s.json", self.keyed_scene())
        for kind in ("webp", "gif", "apng"):
            out = self.path("film." + kind)
            self.good("export", path, "--format", kind, "--out", out)
            film = Image.open(out)
            self.assertEqual((film.n_frames, film.size), (5, (70, 60)), kind)
            self.assertEqual(film.info.get("loop"), 0, kind)
            durations = []
            for i in range(5):
                film.seek(i)
                film.load()
                durations.append(film.info["duration"])
            self.assertEqual(durations, [250] * 5, kind)
            self.good("render", path, "--frames", "2..2", "--out", self.path("f.png"))
            exact = numpy.asarray(Image.open(self.path("f-0002.png")).convert("RGBA")).astype(int)
            film.seek(2)
            frame = numpy.asarray(film.convert("RGBA")).astype(int)
            shows = exact[:, :, 3] == 255
            self.assertLess(numpy.abs(frame - exact)[shows].mean(), 3, kind)
            self.assertLess(numpy.abs(frame[:, :, 3] - exact[:, :, 3]).mean(), 2, kind)
        self.bad("export", path, "--format", "gif", "--out", self.path("film.webp"), says="must end in .gif")
        # Transparent pixels are transparent in every frame, with any number of colors.
        out = self.path("fern.gif")
        self.good("export", os.path.join(SOURCE, "assets/fern.json"), "--format", "gif", "--scale", 0.1, "--out", out)
        film = Image.open(out)
        for i in range(film.n_frames):
            film.seek(i)
            self.assertEqual(film.convert("RGBA").getpixel((0, 0))[3], 0, i)
        # A frame rate that is not a whole number of milliseconds per frame.
        scene = {**self.keyed_scene(), "animation": {"frames_per_second": 24}}
        self.good("export", self.write("fast.json", scene), "--format", "apng", "--out", self.path("fast.apng"))
        film = Image.open(self.path("fast.apng"))
        film.seek(3)
        self.assertAlmostEqual(film.info["duration"], 1000 / 24, places=9)

    def test_a_name_that_contradicts_the_format_is_refused(self):
        scene = self.write("s.json", self.keyed_scene())
        table = run("formats").stdout
        rows = re.findall(r"^([a-z0-9-]+) +(\.[^-\n]*?) *(?:--.*)?$", table[table.index("export --format"):], re.M)
        self.assertGreater(len(rows), 20)
        every = sorted({extension for _, own in rows for extension in own.split()})
        for name, own in rows:
            for extension in [*random.Random(name).sample([each for each in every if each not in own.split()], 3), "", ".doc"]:
                out = self.path("o" + extension)
                self.bad("export", scene, "--format", name, "--out", out, says=f"must end in {' or '.join(own.split())} for --format {name}")
                self.assertFalse(os.path.exists(out))
        self.good("export", scene, "--format", "svg", "--out", self.path("O.SVG"))
        self.good("export", scene, "--format", "svg", "--out", "/dev/null")

    def test_still_scenes_look_the_same_at_all_times(self):
        scene = self.write("still.json", {**self.keyed_scene(), "keyframes": []})
        points = self.write("p.csv", "10,20\n33,7\n")
        self.assertEqual(self.good("map", scene, "--points", points).stdout, self.good("map", scene, "--points", points, "--time", 3).stdout)
        told = [json.loads(self.good("info", scene, "--json", *time).stdout) for time in ((), ("--time", "0"), ("--time", "1e6"))]
        for each in told:
            for key in ("timings", "time"):
                each.pop(key, None)
        self.assertEqual(told[0], told[1])
        self.assertEqual(told[0], told[2])
        for name in ("render", "png", "svg", "obj", "npy", "psd", "glb", "unwarp", "stmap"):
            written = []
            for time in ((), ("--time", "2.5")):
                out = self.path("o." + {"render": "png", "unwarp": "png", "stmap": "exr"}.get(name, name))
                self.good("render" if name == "render" else "export", scene, *(("--format", name) if name != "render" else ()), *time,
                          "--out", out, "--force")
                with open(out, "rb") as file:
                    written.append(file.read())
            self.assertEqual(*written, name)

    def test_several_scenes_are_drawn_at_once(self):
        keyed = self.keyed_scene()

        def named(name, move):
            scene = copy.deepcopy(keyed)
            scene["cage"]["pose"] = [[[p[0][0] + move, p[0][1]], *p[1:]] for p in scene["cage"].get("pose", scene["cage"]["rest"])]
            return self.write(name, scene)
        def content(name):
            with open(self.path(name), "rb") as file:
                return file.read()
        os.makedirs(self.path("in/more"))
        os.makedirs(self.path("out"))
        for folder in ("in", "in/more"):
            shutil.copy(self.path("red.png"), self.path(folder))
        scenes = [named("in/a.json", 1), named("in/b c.json", 4), named("in/more/d.v2.json", 9)]
        alone = []
        for scene in scenes:
            self.good("render", scene, "--out", self.path("alone.png"), "--force")
            alone.append(content("alone.png"))
        self.assertEqual(len(set(alone)), 3)
        for out in (self.path("out"), self.path("out/*.png"), self.path("out/*")):
            self.good("render", *scenes, "--out", out)
            self.assertEqual(sorted(os.listdir(self.path("out"))), ["a.png", "b c.png", "d.v2.png"])
            self.assertEqual([content("out/" + name) for name in ("a.png", "b c.png", "d.v2.png")], alone)
            shutil.rmtree(self.path("out"))
            os.mkdir(self.path("out"))
        self.good("render", scenes[0], "--out", self.path("out"))  # where a pattern of the shell matches one
        self.good("render", *scenes, "--frames", "1..2", "--out", self.path("out/*-small.webp"), "--scale", 0.5)
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["a-small-0001.webp", "a-small-0002.webp", "a.png", "b c-small-0001.webp",
                                                                "b c-small-0002.webp", "d.v2-small-0001.webp", "d.v2-small-0002.webp"])
        # Names that would be used twice, and what has no name.
        self.bad("render", *scenes, "--out", self.path("x.png"), says="pictures/*.png")
        self.bad("render", scenes[0], scenes[0], "--out", self.path("*.png"), says="would both be drawn")
        self.bad("render", scenes[0], "-", "--out", self.path("*.png"), says="standard input")
        self.bad("render", *scenes, "--print-rect", "--out", self.path("*.png"), says="single scene")
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(".png") and name not in ("alone.png", "red.png")], [])
        # The others are drawn if one fails.
        self.write("in/b c.json", "{")
        shutil.rmtree(self.path("out"))
        os.mkdir(self.path("out"))
        said = self.bad("render", *scenes, self.path("none.json"), "--out", self.path("out"), says="2 of 4 scenes were not drawn").stderr
        self.assertIn("b c.json: ", said)
        self.assertIn("none.json: ", said)
        self.assertEqual([content("out/" + name) for name in ("a.png", "d.v2.png")], [alone[0], alone[2]])

    def test_films_by_ffmpeg_are_whole_or_not_there(self):
        path = self.write("s.json", self.keyed_scene())
        folder = self.path("bin")
        os.mkdir(folder)
        stub = os.path.join(folder, "ffmpeg")
        out = self.path("film.mp4")
        paths = {**os.environ, "PATH": folder}
        # ffmpeg is not installed.
        result = run("export", path, "--format", "mp4", "--out", out, env=paths)
        self.assertEqual(result.returncode, 1)
        self.assertIn("ffmpeg, which is not installed", result.stderr)
        # A stub that counts its input and writes its arguments.
        with open(stub, "w") as file:
            file.write("#!/bin/sh\nfor word in \"$@\"; do last=$word; done\n"
                       "echo \"$@\" > \"${last#file:}\"\n/usr/bin/wc -c >> \"${last#file:}\"\n")
        os.chmod(stub, 0o755)
        self.good("export", path, "--format", "mp4", "--out", out, env=paths)
        words, count = open(out).read().splitlines()
        self.assertIn("-video_size 70x60 -framerate 4", words)
        self.assertEqual(int(count), 5 * 70 * 60 * 4)
        os.remove(out)
        # A stub that fails.
        with open(stub, "w") as file:
            file.write("#!/bin/sh\necho no such codec >&2\nexit 3\n")
        result = run("export", path, "--format", "webm", "--out", self.path("film.webm"), env=paths)
        self.assertEqual(result.returncode, 1)
        self.assertIn("no such codec", result.stderr)
        self.assertEqual([n for n in os.listdir(self.folder) if "film" in n], [])  # no file is left behind

    def test_numbers_know_the_times_of_keyframes(self):
        path = self.write("s.json", self.keyed_scene())
        points = self.write("points.csv", "20,20\n30,25\n")
        reports = json.loads(self.good("info", path, "--frames", "all", "--json").stdout)
        self.assertEqual([r["frame"] for r in reports], list(range(5)))
        for report in reports:
            for key in ("time", "max_k", "min_sigma", "max_sigma", "flipped_triangles", "certified", "status"):
                self.assertIn(key, report)
        self.assertIn("blended", {r["status"] for r in reports})
        self.assertNotEqual(reports[0]["status"], "blended", "at a keyframe the map is the method's own")
        rows = self.good("map", path, "--points", points, "--frames", "1..3").stdout.split()
        self.assertEqual(rows[0], "frame,u,v,fz_re,fz_im,fzbar_re,fzbar_im")
        self.assertEqual([row.split(",")[0] for row in rows[1:]], ["1", "1", "2", "2", "3", "3"])
        # Runs map and then inverse, at a keyframe and between two keyframes.
        for time in (0, 0.05):
            there = self.good("map", path, "--points", points, "--time", time).stdout.split()[1:]
            posed = self.write("posed.csv", "".join(",".join(row.split(",")[:2]) + "\n" for row in there))
            back = self.good("inverse", path, "--points", posed, "--time", time).stdout.split()[1:]
            for row, wanted in zip(back, ((20, 20), (30, 25))):
                x, y = map(float, row.split(",")[:2])
                self.assertAlmostEqual(math.hypot(x - wanted[0], y - wanted[1]), 0, places=6)
        # Exports at a time show the map at that time.
        rest = self.write("rest.json", dict(self.keyed_scene(), keyframes=[]))
        at_rest, posed = self.obj_of(rest), self.obj_of(path, "--time", 0.3)
        points = self.write("mesh.csv", "".join("%.17g,%.17g\n" % tuple(z) for z in at_rest[0]))
        mapped = numpy.loadtxt(io.StringIO(self.good("map", path, "--points", points, "--time", 0.3).stdout),
                               delimiter=",", skiprows=1)[:, :2]
        self.assertLess(numpy.nanmax(numpy.abs(mapped - posed[0])), 1e-5)
        self.good("export", path, "--format", "npy", "--time", 0.3, "--out", self.path("t.npy"))
        self.assertLess(numpy.abs(numpy.load(self.path("t.npy")).view(float).reshape(-1, 2) - posed[0]).max(), 1e-5)
        self.good("export", path, "--format", "svg", "--time", 1, "--out", self.path("t.svg"))
        self.assertIn("30", open(self.path("t.svg")).read())
        for kind, name in (("unwarp", "u.png"), ("png", "p.png")):
            self.good("export", path, "--format", kind, "--time", 0.05, "--out", self.path(name))

    def obj_of(self, scene, *words):
        """Vertices in the plane and triangles of an exported mesh."""
        out = self.path("mesh.obj")
        self.good("export", scene, "--format", "obj", "--out", out, "--force", *words)
        lines = [line.split() for line in open(out)]
        vertices = numpy.array([[float(x) for x in line[1:3]] for line in lines if line[:1] == ["v"]])
        return vertices, [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in lines if line[:1] == ["f"]]

    def test_keyframes_work_with_every_method(self):
        scene, points = self.keyed_scene(), self.write("p.csv", "22,16\n42,24\n")
        scene["pins"] = [{"rest": [20, 20]}, {"rest": [40, 20]}]
        scene["strokes"] = [{"rest": [[20, 25], [40, 25]]}]
        scene["corners"] = [{"vertex": k} for k in range(4)]
        around = numpy.linspace(0, 2 * math.pi, 41)[:-1]
        scene["outline"] = [[30 + 25 * math.cos(t), 20 + 20 * math.sin(t)] for t in around]
        scene["animation"]["frames_per_second"] = 2
        scene["keyframes"][1]["pose"].update(pins=[{"pose": [24, 20]}, {"pose": [42, 26]}],
                                             strokes=[[[22, 25], [42, 30]]],
                                             corners=[{"before": 0.1 * k, "after": 0.2} for k in range(4)])
        for method in SCHEMA["$defs"]["layer"]["properties"]["method"]["properties"]["id"]["enum"]:
            with self.subTest(method):
                path = self.write("s.json", {**scene, "method": {"id": method}})
                rows = self.good("map", path, "--points", points, "--frames", "0..2").stdout.splitlines()[1:]
                images = numpy.array([[float(x) for x in row.split(",")[1:3]] for row in rows]).reshape(3, 2, 2)
                self.assertTrue(numpy.isfinite(images).all())
                moves = numpy.abs(numpy.diff(images, axis=0)).max(axis=(1, 2))
                self.assertGreater(moves.min(), 1)

    def test_blended_frames_are_measured_in_their_triangles(self):
        scene = self.keyed_scene()
        bent = [[[15, 10]], [[70, 20]], [[40, 60]], [[0, 35]]]
        scene["keyframes"][1]["pose"] = {"cage": bent}
        path = self.write("s.json", scene)
        vertices, triangles = self.obj_of(self.write("rest.json", dict(scene, keyframes=[])))
        rest = vertices @ [1, 1j]
        for time in (0.25, 0.5, 0.8):
            posed = self.obj_of(path, "--time", time)[0] @ [1, 1j]
            report = json.loads(self.good("info", path, "--time", time, "--json").stdout)
            self.assertEqual((report["status"], report["time"], report["certified"]), ("blended", time, False))
            self.assertNotIn("pose_ms", report["timings"])
            most_k, least, most = 0, math.inf, 0
            for a, b, c in triangles:
                # f = fz z + fzbar conj(z) + const over the triangle.
                side = numpy.array([[rest[b] - rest[a], (rest[b] - rest[a]).conjugate()],
                                    [rest[c] - rest[a], (rest[c] - rest[a]).conjugate()]])
                fz, fzbar = numpy.abs(numpy.linalg.solve(side, [posed[b] - posed[a], posed[c] - posed[a]]))
                most_k, least, most = max(most_k, fzbar / fz), min(least, fz - fzbar), max(most, fz + fzbar)
            for key, wanted in (("max_k", most_k), ("min_sigma", least), ("max_sigma", most)):
                self.assertAlmostEqual(report[key], wanted, delta=1e-3 * max(wanted, 0.1), msg=key)

    def test_held_frames_and_keys_off_the_grid_are_the_methods_own(self):
        scene = self.keyed_scene()
        scene["keyframes"] = [{"time": 0, "ease": "hold", "pose": {}},
                              {"time": 0.35, "ease": "linear", "pose": {"cage": [[[15, 10]], [[70, 20]], [[40, 60]], [[0, 35]]]}},
                              {"time": 1, "pose": {}}]
        scene["method"] = {"id": "bounded"}
        path = self.write("s.json", scene)
        frames = json.loads(self.good("info", path, "--frames", "all", "--json").stdout)
        self.assertEqual([f["status"] for f in frames], ["certified"] * 5)
        self.assertLess(max(f["max_k"] for f in frames[:2]), 1e-6)
        key = json.loads(self.good("info", path, "--time", 0.35, "--json").stdout)
        self.assertEqual((key["status"], key["certified"]), ("certified", True))
        self.assertGreater(key["max_sigma"], 1.05)
        after = json.loads(self.good("info", path, "--time", 7, "--json").stdout)
        self.assertEqual(after["status"], "certified")
        for frame, report in zip(range(5), frames):
            self.assertEqual(report["time"], frame / 4)

    def test_between_two_equal_keys_the_map_is_theirs(self):
        scene = self.keyed_scene()
        bent = {"cage": [[[15, 10]], [[70, 20]], [[40, 60]], [[0, 35]]]}
        scene["keyframes"] = [{"time": 0, "pose": bent}, {"time": 0.6, "pose": bent}, {"time": 1, "pose": {}}]
        scene["method"] = {"id": "bounded"}
        frames = json.loads(self.good("info", self.write("s.json", scene), "--frames", "all", "--json").stdout)
        self.assertEqual([f["status"] for f in frames][:2], ["certified"] * 2)
        self.assertEqual(frames[1]["max_k"], frames[0]["max_k"])
        self.assertEqual(frames[3]["status"], "certified")
        self.assertGreater(frames[3]["proved"]["sigma"], 0)
        scene["method"] = {"id": "harmonic"}  # proves nothing
        frames = json.loads(self.good("info", self.write("s.json", scene), "--frames", "all", "--json").stdout)
        self.assertEqual(frames[3]["status"], "blended")

    def test_what_map_could_not_map_goes_through_inverse(self):
        path = self.write("s.json", dict(self.keyed_scene(), keyframes=[]))
        mapped = self.good("map", path, "--points", self.write("p.csv", "20,20\n999,999\n30,25\n")).stdout
        pairs = "".join(",".join(row.split(",")[:2]) + "\n" for row in mapped.split())
        rows = list(csv.reader(io.StringIO(self.good("inverse", path, "--points", "-", input=pairs).stdout)))[1:]
        self.assertEqual([row[3] for row in rows], ["1", "0", "1"])
        self.assertEqual(rows[1][:2], ["nan", "nan"])
        self.bad("map", path, "--points", self.write("n.csv", "nan,nan\n"), says="line 1")

    def test_keyframes_that_do_not_fit_are_an_error_and_not_a_still(self):
        other = {**self.keyed_scene(), "keyframes": [{"time": 0, "pose": {"cage": [[[0, 0]], [[1, 0]], [[0, 1]]]}}]}
        path, points = self.write("other.json", other), self.write("points.csv", "20,20\n")
        for words in (("info", path), ("map", path, "--points", points), ("inverse", path, "--points", points),
                      ("export", path, "--format", "npy", "--out", self.path("o.npy"))):
            self.bad(*words, "--time", 0, says="none of the keyframes")

    def test_times_and_frames_that_are_none_are_named(self):
        scene = self.keyed_scene()
        path = self.write("s.json", scene)
        out = self.path("o.png")
        self.bad("render", path, "--frames", "2..9", "--out", out, says="frames 0..4")
        self.bad("render", path, "--time", -1, "--out", out, says="--time")
        self.bad("render", path, "--frames", "few", "--out", out, says="not a range of frames")
        self.bad("render", path, "--frames", "all", "--time", 1, "--out", out, says="excludes")
        for wrong in ("1..3:0", "1..3:-1", "1..", "..3", "3:2", "1..3:2x", "-1", "1..3:4294967297"):
            self.bad("info", path, "--frames=" + wrong, says="--frames")
        for text, frames in (("3", [3]), ("0..4:2", [0, 2, 4]), ("1..4:2", [1, 3]), ("1..3:1", [1, 2, 3]), ("1..4:999999999", [1])):
            told = json.loads(self.good("info", path, "--json", "--frames", text).stdout)
            self.assertEqual([row["frame"] for row in told], frames)
        self.good("render", path, "--frames", "1..4:3", "--out", self.path("step.png"))
        self.assertEqual(sorted(name for name in os.listdir(self.folder) if name.startswith("step")), ["step-0001.png", "step-0004.png"])
        self.bad("export", path, "--format", "gif", "--frames", "0..4:2", "--out", self.path("o.gif"), says="has a step")
        still = self.write("still.json", {**scene, "keyframes": []})
        self.bad("render", still, "--frames", "0", "--out", out, says="no keyframes")
        self.bad("export", still, "--format", "gif", "--out", self.path("o.gif"), says="no keyframes")
        self.bad("render", self.write("two.json", {**scene, "keyframes": scene["keyframes"][:1] * 2}),
                 "--time", 0, "--out", out, says="without duplicates")
        other = {**scene, "keyframes": [{"time": 0, "pose": {"cage": [[[0, 0]], [[1, 0]], [[0, 1]]]}}]}
        self.bad("render", self.write("other.json", other), "--time", 0, "--out", out, says="none of the keyframes")
        self.assertFalse(os.path.exists(out))

    def test_info(self):
        result = json.loads(self.good("info", old_sample("gecko"), "--json").stdout)
        for key in ("method", "status", "iterations", "energies", "timings", "measured", "max_k", "min_sigma", "max_sigma",
                    "zeros", "turning_number", "simple_boundary", "certified"):
            self.assertIn(key, result)
        self.assertEqual(result["method"], "pins")
        self.assertLess(result["energies"]["pins_rms"], 1e-6)
        self.assertAlmostEqual(result["turning_number"], 1, places=2)
        self.assertIn("turning number", self.good("info", old_sample("gecko")).stdout)

    def test_exports(self):
        scene = old_sample("giraffe")
        for kind in ("obj", "svg", "npy", "png"):
            self.good("export", scene, "--format", kind, "--out", self.path("x." + kind))
        positions = numpy.load(self.path("x.npy"))
        lines = open(self.path("x.obj")).read().split("\n")
        vertices = numpy.array([[float(x) for x in line.split()[1:3]] for line in lines if line.startswith("v ")])
        numpy.testing.assert_array_equal(vertices, positions)
        faces = [line for line in lines if line.startswith("f ")]
        self.assertGreater(len(faces), 10000)
        self.assertLess(len(faces), 20000)
        self.assertIn("<path", open(self.path("x.svg")).read())
        self.assertEqual(Image.open(self.path("x.png")).size, (900, 1100))

    # ---- bad input ---------------------------------------------------------------------------

    def test_bad_scenes(self):
        good = json.load(open(old_sample("gecko")))
        shutil.copy(os.path.join(SOURCE, "assets/gecko.png"), self.folder)

        def changed(change):
            scene = json.loads(json.dumps(good))
            change(scene)
            return self.write("bad.json", scene)

        text = json.dumps(good)
        for length in (0, 1, 10, len(text) // 3, len(text) - 1):
            self.bad("info", self.write("bad.json", text[:length]), says="bad.json")
        self.bad("info", changed(lambda s: s.update(version=9)), says="/version")
        self.bad("info", changed(lambda s: s.update(version="1")), says="/version")
        self.bad("info", changed(lambda s: s.update(format="other")), says="Holomorph")
        self.bad("info", changed(lambda s: s.pop("cage")), says="'cage' is missing")
        self.bad("info", changed(lambda s: s["cage"].update(rest=5)), says="/cage/rest")
        self.bad("info", changed(lambda s: s["cage"]["rest"].__setitem__(0, [[1, "x"]])), says="/cage/rest/0/0/1")
        self.bad("info", changed(lambda s: s["cage"]["rest"].pop()), says="must agree")
        self.bad("info", changed(lambda s: s["pins"].__setitem__(0, 7)), says="/pins/0")
        self.bad("info", changed(lambda s: s["method"].update(id="none")), says="/method/id")
        self.bad("info", changed(lambda s: s["image"].update(file="missing.png")), says="/image/file")
        self.bad("info", changed(lambda s: s["image"].update(file="/")), says="/image/file")
        self.bad("info", changed(lambda s: s["cage"].update(rest=[], pose=[])), says="no cage")
        self.bad("info", self.write("bad.json", text.replace("[600", "[1e400", 1)), says="bad.json")
        self.bad("info", self.write("bad.json", text.replace("[600", "[NaN", 1)), says="bad.json")
        self.bad("info", self.write("bad.json", "[" * 100000), says="bad.json")
        self.bad("info", self.folder, says="directory")
        self.bad("info", self.path("nothing.json"), says="no such file")
        crossing = {"format": "holomorph", "version": 1, "cage": {"rest": [[[0, 0]], [[10, 10]], [[10, 0]], [[0, 10]]]}}
        self.bad("info", self.write("bad.json", crossing), says="(5, 5)")
        huge = {"format": "holomorph", "version": 1, "cage": {"rest": [[[i, i * i]] for i in range(6000)]}}
        self.bad("info", self.write("bad.json", huge), says="5000")

    def test_the_manual_page_names_all_commands_and_options(self):
        with open(os.path.join(SOURCE, "desktop/holomorph.1")) as file:
            page = file.read().replace("\\-", "-")
        commands = re.findall(r"^  ([a-z]+) ", run("--help").stdout.split("Subcommands:")[1], re.M)
        self.assertGreater(len(commands), 7)
        own, shared = page.split(".SH COMMANDS")[1].split(".SH OPTIONS")
        headings = re.split(r"(?m)^\.BR? ([a-z]+)\b", own)
        sections = dict(zip(headings[1::2], headings[2::2]))
        self.assertEqual(sorted(sections), sorted(commands))
        for command in commands:
            usage, text = sections[command].split("\n", 1)
            named = " ".join([usage, *re.findall(r"(?m)^\.B.*", text + shared)])
            for flag in set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", run(command, "--help").stdout, re.M)):
                self.assertIsNotNone(re.search(rf"{flag}(?![\w-])", named), f"{command} {flag}")

    def test_bad_arguments(self):
        scene = old_sample("giraffe")
        points = self.write("p.csv", "1,2\n3,x\n")
        self.bad("map", scene, "--points", points, says="line 2")
        self.bad("map", scene, "--points", self.path("none.csv"), says="no such file")
        self.bad("map", scene, says="--points")
        self.bad("coordinates", scene, "--points", self.write("q.csv", "1,2\n"), "--order", -1, "--out", self.path("m"), says="order")
        self.bad("info", scene, "--time", -1, says="--time")
        self.bad("render", scene, "--out", self.path("no/where.png"), says="cannot write", status=1)
        self.bad("render", scene, "--out", self.path("x.png"), "--view", "xray", says="angle")
        for scale in ("0", "-1", "1e9", "nan"):
            self.bad("render", scene, "--out", self.path("x.png"), "--scale", scale, says="scale")
        self.bad("export", scene, "--format", "doc", "--out", self.path("x"), says="obj, svg, npy, png, stmap, unwarp")
        picture = os.path.join(SOURCE, "assets/giraffe.png")
        self.bad("new", "--force", picture, "--out", self.path("n.json"), "--vertices", 2, says="3 to 500")
        self.bad("new", "--force", scene, "--out", self.path("n.json"), says="not a picture")
        with open(picture, "rb") as file:
            half = file.read()[:20000]
        with open(self.path("half.png"), "wb") as file:
            file.write(half)
        self.bad("new", "--force", self.path("half.png"), "--out", self.path("n.json"), says="incomplete")
        self.assertFalse(os.path.exists(self.path("n.json")))
        self.bad("frobnicate", "x", says="")
        self.assertEqual(run("--help").returncode, 0)
        for command in ("map", "inverse", "coordinates", "render", "info", "new", "export", "bench"):
            self.assertEqual(run(command, "--help").returncode, 0)

    def test_sources_are_never_replaced(self):
        for name in ("giraffe.png", "giraffe.json"):
            shutil.copy(os.path.join(SOURCE, "assets", name), self.folder)
        scene, picture = (os.path.join(self.folder, "giraffe" + end) for end in (".json", ".png"))
        before = [open(path, "rb").read() for path in (scene, picture)]
        for arguments in (["render", scene, "--out", picture], ["render", scene, "--out", scene],
                          ["export", scene, "--format", "png", "--out", picture], ["export", scene, "--format", "unwarp", "--out", picture]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn("choose another name", result.stderr)
        self.assertEqual(before, [open(path, "rb").read() for path in (scene, picture)])
        result = run("info", picture)
        self.assertEqual(result.returncode, 2)
        self.assertIn("holomorph new", result.stderr)

    def test_inverse_undoes_map(self):
        scene = old_sample("gecko")
        loop = numpy.array([segment[0] for segment in json.load(open(scene))["cage"]["rest"]])
        inner = [loop.mean(axis=0) + 0.2 * (p - loop.mean(axis=0)) for p in loop[::5]] + [[338, 654], [840, 184]]
        points = self.write("in.csv", "".join("%r,%r\n" % (float(x), float(y)) for x, y in inner))
        there = self.path("there.csv")
        self.good("map", scene, "--points", points, "--out", there)
        rows = list(csv.DictReader(open(there)))
        posed = self.write("posed.csv", "".join(row["u"] + "," + row["v"] + "\n" for row in rows) + "1e5,1e5\n")
        back = list(csv.DictReader(io.StringIO(self.good("inverse", scene, "--points", posed, "--all").stdout)))
        for i, (x, y) in enumerate(inner):
            mine = [row for row in back if row["point"] == str(i)]
            self.assertEqual(len(mine), int(mine[0]["count"]))
            self.assertLess(min(abs(complex(float(r["x"]) - x, float(r["y"]) - y)) for r in mine), 1e-8)
            self.assertTrue(all(float(r["residual"]) < 1e-9 for r in mine))
        self.assertEqual(back[-1]["x"], "nan")
        self.assertEqual(back[-1]["count"], "0")
        short = list(csv.DictReader(io.StringIO(self.good("inverse", scene, "--points", posed).stdout)))
        self.assertEqual(len(short), len(inner) + 1)

    def test_formats_are_those_of_the_readme_and_of_export(self):
        table = self.good("formats", "--markdown").stdout
        with open(os.path.join(SOURCE, "README.md")) as file:
            self.assertIn(table, file.read())
        listed = self.good("formats").stdout
        names = re.findall(r"^(\S+) +(\.\S.*?)  +--", listed.split("export --format")[1], re.M)
        self.assertGreater(len(names), 10)
        self.bad("export", old_sample("giraffe"), "--format", "doc", "--out", self.path("x"),
                 says="choose one of: " + ", ".join(name for name, _ in names))
        for line in table.splitlines()[2:]:
            _, files, opened, written, _ = (cell.strip() for cell in line.split("|"))
            self.assertTrue(opened or written, files)

    def test_stmap_and_unwarp(self):
        scene = old_sample("giraffe")
        self.good("export", scene, "--format", "stmap", "--scale", 0.25, "--out", self.path("st.npy"))
        st = numpy.load(self.path("st.npy"))
        self.assertEqual(st.shape, (275, 225, 2))
        self.assertEqual(st.dtype, numpy.float32)
        # Where the scene does not move, the map is the identity.
        self.assertTrue(numpy.allclose(st[0, 0], [0.5 / 225, 1 - 0.5 / 275]))
        # Applying it to the source gives the rendered picture.
        self.good("render", scene, "--crop", "--out", self.path("bent.png"))
        source = numpy.asarray(Image.open(os.path.join(SOURCE, "assets/giraffe.png"))).astype(float)
        bent = numpy.asarray(Image.open(self.path("bent.png"))).astype(float)
        shown = numpy.isfinite(st[..., 0])
        rows, columns = numpy.nonzero(shown)
        x = numpy.clip((st[rows, columns, 0] * 900).astype(int), 0, 899)
        y = numpy.clip(((1 - st[rows, columns, 1]) * 1100).astype(int), 0, 1099)
        expected = source[y, x, 3]
        found = bent[rows * 4 + 2, columns * 4 + 2, 3]
        self.assertLess((numpy.abs(expected - found) > 100).mean(), 0.02)
        # Unwarping a bent picture with the scene that bent it gives the source back.
        shutil.copy(self.path("bent.png"), self.path("giraffe.png"))
        with open(scene) as file:
            text = json.load(file)
        text["image"] = {"file": "giraffe.png"}
        self.good("export", self.write("bent.json", text), "--format", "unwarp", "--out", self.path("back.png"))
        back = numpy.asarray(Image.open(self.path("back.png"))).astype(float)
        self.assertEqual(back.shape, source.shape)
        solid = (source[..., 3] == 255) & (back[..., 3] == 255)
        self.assertGreater(solid.mean(), 0.1)
        self.assertLess(numpy.abs(back - source)[solid].mean(), 4)

    def test_cages_are_made_as_closely_as_asked_and_with_holes(self):
        picture = self.path("ring.png")
        y, x = numpy.mgrid[0:200, 0:240]
        away = numpy.hypot(x - 100, y - 100)
        pixels = numpy.zeros((200, 240, 4), "uint8")
        pixels[(away < 90) & (away > 40)] = 255
        pixels[90:92, 215:226] = 255  # another part, too small to see
        Image.fromarray(pixels).save(picture)
        counts = []
        for detail in (0, 50, 100):
            out = self.path(f"{detail}.json")
            said = self.good("new", picture, "--out", out, "--detail", detail).stderr
            self.assertIn("A part of the picture stays outside", said)
            scene = json.load(open(out))
            self.assertEqual((scene["version"], len(scene["cage"]["holes"])), (3, 1))
            jsonschema.validate(scene, SCHEMA)
            counts.append(len(scene["cage"]["rest"]))
        self.assertLess(counts[0], counts[2])
        self.good("new", picture, "--out", self.path("filled.json"), "--hole-width", 60)
        self.assertNotIn("holes", json.load(open(self.path("filled.json")))["cage"])
        pixels[90:92, 215:228] = 255  # 26 pixels, 0.054 %
        Image.fromarray(pixels).save(picture)
        self.assertNotIn("outside", self.good("new", picture, "--out", self.path("small.json"), "--parts").stderr)
        self.assertEqual(len(json.load(open(self.path("small.json")))["cage"]["parts"]), 1)
        # A larger one is inside the cage, or has an outline of its own.
        pixels[90:110, 215:235] = 255
        Image.fromarray(pixels).save(picture)
        for flag, method, parts in (((), "cage", 0), (("--parts",), "sheet", 1)):
            out = self.path(f"{method}.json")
            said = self.good("new", picture, "--out", out, *flag).stderr
            self.assertNotIn("outside", said)
            scene = json.load(open(out))
            jsonschema.validate(scene, SCHEMA)
            self.assertEqual(scene["method"]["id"], method)
            self.assertEqual(len(scene["cage"].get("parts", [])), parts)
            moved = self.path(f"{method}.csv")
            open(moved, "w").write("100,20\n225,100\n")
            self.assertNotIn("nan", self.good("map", out, "--points", moved).stdout)
        # Pins move their part, and what is exported shows it.
        scene["pins"] = [{"rest": [220, 95], "pose": [200, 40]}, {"rest": [230, 105], "pose": [210, 50]},
                         {"rest": [100, 180]}, {"rest": [20, 100]}]
        self.good("render", self.write("moved.json", {**scene, "image": {"file": "ring.png"}}), "--out",
                  self.path("moved.png"))
        drawn = numpy.asarray(Image.open(self.path("moved.png")))[..., 3]
        self.assertEqual((drawn[155, 205], drawn[100, 225], drawn[15, 100]), (255, 0, 255))
        for option in ("--detail", "--hole-width"):
            for wrong in (-1, 101, "nan"):
                self.bad("new", "--force", picture, "--out", self.path("x.json"), option, wrong, says=option)
        info = json.loads(self.good("info", self.path("50.json"), "--json").stdout)
        self.assertTrue(info["locally_injective"])

    def test_cages_from_svg(self):
        picture = os.path.join(SOURCE, "assets/gecko.png")
        scene, again = self.path("gecko.json"), self.path("again.json")
        self.good("new", "--force", picture, "--out", scene)
        self.good("export", scene, "--allow-outside", "--format", "svg", "--out", self.path("cage.svg"))
        self.good("new", "--force", picture, "--cage", self.path("cage.svg"), "--pose", self.path("cage.svg"), "--out", again)
        a, b = json.load(open(scene))["cage"], json.load(open(again))["cage"]
        for name in ("rest", "pose"):
            self.assertLess(numpy.abs(numpy.array(a["rest"]) - numpy.array(b.get(name, b["rest"]))).max(), 1e-9)
        curved = self.write("curved.svg", '<svg><path d="M100 100 C300 0 700 0 1000 100 L1000 800 Q500 900 100 800 Z"/></svg>')
        self.good("new", "--force", picture, "--cage", curved, "--out", again)
        self.good("render", again, "--allow-outside", "--out", self.path("same.png"))
        same, source = (numpy.asarray(Image.open(path)) for path in (self.path("same.png"), picture))
        self.assertTrue((same == source).all(), "a curved cage at rest changes nothing")
        self.bad("new", "--force", picture, "--cage", curved, "--pose", self.path("cage.svg"), "--out", again, says="must agree")
        self.bad("new", "--force", picture, "--cage", picture, "--out", again, says="not an SVG")

    def test_pictures_of_many_kinds_are_opened(self):
        picture = Image.effect_mandelbrot((60, 40), (-2, -1.3, 1, 1.3), 40).convert("RGBA")
        pixels = numpy.array(picture)
        pixels[:20, :, 0] //= 3
        pixels[5:15, 10:20, 3] = 0
        pixels[pixels[:, :, 3] == 0] = 0
        picture = Image.fromarray(pixels)
        for name, options in (("a.png", {}), ("a.webp", {"lossless": True, "exact": True}), ("a.tif", {}),
                              ("b.tiff", {"compression": "tiff_lzw"}), ("c.TIF", {"compression": "tiff_adobe_deflate"})):
            picture.save(self.path(name), format="TIFF" if name.lower().find("tif") > 0 else None, **options)
            self.good("new", "--force", self.path(name), "--out", self.path("s.json"))
            self.good("render", self.path("s.json"), "--out", self.path("o.png"))
            self.assertTrue((numpy.array(Image.open(self.path("o.png")).convert("RGBA")) == pixels).all(), name)
        picture.convert("CMYK").save(self.path("cmyk.tif"))
        self.good("new", "--force", self.path("cmyk.tif"), "--out", self.path("s.json"))
        # Truncated files, and pictures that are not supported.
        for name in ("a.webp", "a.tif", "b.tiff"):
            with open(self.path(name), "rb") as file:
                whole = file.read()
            for share in (0.02, 0.1, 0.4, 0.8):
                with open(self.path("part" + os.path.splitext(name)[1]), "wb") as file:
                    file.write(whole[:int(share * len(whole))])
                result = run("new", "--force", file.name, "--out", self.path("s.json"))
                self.assertIn(result.returncode, (0, 2), result.stderr)
        picture.save(self.path("film.webp"), save_all=True, append_images=[picture.rotate(90, expand=False)])
        self.assertIn("only the first of its 2 pictures", self.good("new", "--force", self.path("film.webp"), "--out", self.path("s.json")).stderr)
        Image.new("L", (16400, 2)).save(self.path("wide.tif"))
        self.bad("new", "--force", self.path("wide.tif"), "--out", self.path("s.json"), says="16384")

    def test_no_points_are_no_lines(self):
        points = os.path.join(self.folder, "none.csv")
        for text in ("", "x,y\n"):
            with open(points, "w") as file:
                file.write(text)
            for name in ("giraffe", "gecko"):
                result = run("map", os.path.join(SOURCE, "assets", name + ".json"), "--points", points)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(len(result.stdout.splitlines()), 1)

    def test_killing_the_program_while_it_writes_leaves_whole_files(self):
        scene = old_sample("giraffe")
        out = self.path("x.obj")
        self.good("export", scene, "--format", "obj", "--out", out)
        whole = open(out).read()
        for i in range(12):
            process = subprocess.Popen([PROGRAM, "export", scene, "--format", "obj", "--out", out], stderr=subprocess.DEVNULL)
            time.sleep(0.02 + 0.03 * i)
            process.send_signal(signal.SIGKILL)
            process.wait()
            self.assertEqual(open(out).read(), whole)
            for name in set(os.listdir(self.folder)) - {"x.obj"}:
                self.assertRegex(name, r"^\.holomorph-[0-9a-f]{8}$")
        self.good("export", scene, "--format", "obj", "--out", out)
        self.assertEqual(os.listdir(self.folder), ["x.obj"], "what was left behind is removed")

    # ---- pictures from other programs ----------------------------------------------------------

    def opened(self, picture):
        """A picture as the program reads it: rendered at rest."""
        scene, out = self.path("opened.json"), self.path("opened.png")
        self.good("new", "--force", picture, "--out", scene)
        self.good("render", scene, "--out", out)
        return numpy.asarray(Image.open(out).convert("RGBA")).astype(int), json.load(open(scene))

    def test_photographs_are_upright_however_the_camera_was_held(self):
        stored = Image.new("RGB", (48, 32), (40, 40, 40))
        stored.paste((250, 20, 20), (0, 0, 16, 16))
        stored.paste((20, 250, 20), (32, 0, 48, 16))
        for orientation in range(1, 9):
            exif = Image.Exif()
            exif[0x0112] = orientation
            path = self.path("photo.jpg")
            stored.save(path, quality=100, subsampling=0, exif=exif)
            wanted = numpy.asarray(ImageOps.exif_transpose(Image.open(path)).convert("RGBA")).astype(int)
            seen, _ = self.opened(path)
            self.assertEqual(seen.shape, wanted.shape, orientation)
            self.assertLessEqual(numpy.abs(seen - wanted).max(), 12, orientation)

    def open_raster(self, name, stack, pictures, size=(60, 40)):
        path = self.path(name)
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr(zipfile.ZipInfo("mimetype"), "image/openraster")
            archive.writestr("stack.xml", f'<image w="{size[0]}" h="{size[1]}"><stack>{stack}</stack></image>')
            for entry, picture in {"mergedimage.png": Image.new("RGBA", (60, 40)), **pictures}.items():
                bytes = io.BytesIO()
                picture.save(bytes, "PNG")
                archive.writestr(entry, bytes.getvalue())
        return path

    def test_open_raster_layers_become_layers(self):
        red, blue = Image.new("RGBA", (60, 40), (200, 0, 0, 255)), Image.new("RGBA", (20, 20), (0, 0, 200, 255))
        path = self.open_raster("art.ora", """
            <layer name="hidden" src="data/c.png" visibility="hidden"/>
            <stack x="5" y="4" opacity="0.5"><layer name="sky &amp; sea" src="data/b.png" x="5" y="6"/></stack>
            <layer name="ground" src="data/a.png"/>""", {"data/a.png": red, "data/b.png": blue, "data/c.png": blue})
        seen, scene = self.opened(path)
        jsonschema.validate(scene, SCHEMA)
        self.assertEqual([(layer["name"], layer.get("visible", True), layer["image"]["entry"]) for layer in scene["layers"]],
                         [("ground", True, "data/a.png"), ("sky & sea", True, "data/b.png"), ("hidden", False, "data/c.png")])
        self.assertEqual(scene["layers"][0]["image"]["file"], "art.ora")
        self.assertNotIn("blending", self.good("new", "--force", path, "--out", self.path("plain.json")).stderr)
        blended = self.open_raster("blended.ora", '<layer name="a" src="data/a.png" composite-op="svg:multiply"/>', {"data/a.png": red})
        self.assertNotIn("a:", self.good("new", "--force", blended, "--out", self.path("blended.json")).stderr)
        with open(self.path("blended.json")) as file:
            self.assertEqual(json.load(file)["layers"][0]["blending"], "multiply")
        blended = self.open_raster("blended.ora", '<layer name="a" src="data/a.png" composite-op="svg:difference"/>', {"data/a.png": red})
        self.assertIn("a: left out: its blending mode", self.good("new", "--force", blended, "--out", self.path("blended.json")).stderr)
        self.assertEqual(seen.shape, (40, 60, 4))
        wanted = numpy.zeros((40, 60, 4), int)
        wanted[:, :] = (200, 0, 0, 255)
        wanted[10:30, 10:30] = (100, 0, 100, 255)
        self.assertLessEqual(numpy.abs(seen - wanted).max(), 1)

    def test_pictures_are_written_in_the_format_of_their_name(self):
        scene = old_sample("gecko")
        sizes = set()
        for name, kind in [("a.png", "PNG"), ("a.jpeg", "JPEG"), ("a.webp", "WEBP"), ("a", "PNG")]:
            self.good("render", scene, "--out", self.path(name), "--scale", "0.25")
            with Image.open(self.path(name)) as image:
                self.assertEqual(image.format, kind)
                sizes.add(image.size)
        self.assertEqual(len(sizes), 1)
        self.bad("render", scene, "--out", self.path("a.bmp"), says="a.bmp: pictures are written as .png, .jpg, .webp or .exr")
        self.assertFalse(os.path.exists(self.path("a.bmp")))

    def test_damaged_open_raster_is_said(self):
        red = Image.new("RGBA", (60, 40), (200, 0, 0, 255))
        layer = '<layer name="a" src="data/a.png"/>'
        good = open(self.open_raster("good.ora", layer, {"data/a.png": red}), "rb").read()
        for name, stack, pictures, size in [("missing", layer, {}, (60, 40)), ("none", "", {}, (60, 40)),
                                            ("huge", layer, {"data/a.png": red}, (60, 2000000)),
                                            ("nowhere", layer, {"data/a.png": red}, (0, 0))]:
            path = self.open_raster(name + ".ora", stack, pictures, size)
            self.bad("new", "--force", path, "--out", self.path("s.json"), says=name + ".ora")
        for cut in range(60, len(good), 97):
            with open(self.path("cut.ora"), "wb") as file:
                file.write(good[:cut])
            self.bad("new", "--force", self.path("cut.ora"), "--out", self.path("s.json"), says="cut.ora")
        self.assertFalse(os.path.exists(self.path("s.json")))

    # ---- layers and backgrounds ----------------------------------------------------------------

    def test_layers_are_drawn_over_each_other_and_over_the_background(self):
        for name, color in [("a.png", (200, 0, 0)), ("b.png", (0, 0, 200))]:
            Image.new("RGBA", (60, 40), color + (255,)).save(self.path(name))
        square = [[[0, 0]], [[60, 0]], [[60, 40]], [[0, 40]]]

        def moved(by):
            return [[[x + by, y]] for [[x, y]] in square]

        scene = {"format": "holomorph", "version": 2, "background": "#102030", "edited": 0, "layers": [
            {"image": {"file": "a.png"}, "cage": {"rest": square, "pose": moved(20)}},
            {"name": "b", "image": {"file": "b.png"}, "cage": {"rest": square, "pose": moved(40)}}]}
        jsonschema.validate(scene, SCHEMA)
        out = self.path("out.png")
        self.good("render", self.write("s.json", scene), "--out", out)
        image = numpy.asarray(Image.open(out).convert("RGBA"))
        self.assertEqual(image.shape, (40, 100, 4))
        row = [tuple(image[20, x]) for x in (10, 30, 70)]
        self.assertEqual(row, [(16, 32, 48, 255), (200, 0, 0, 255), (0, 0, 200, 255)])
        scene["layers"][1]["visible"] = False
        scene["background"] = "original"
        self.good("render", self.write("s.json", scene), "--out", out)
        image = numpy.asarray(Image.open(out).convert("RGBA"))
        self.assertEqual(image.shape, (40, 80, 4))
        self.assertTrue((image == (200, 0, 0, 255)).all())
        self.assertIn("edited", self.bad("info", self.write("s.json", dict(scene, edited=2)), says="/edited").stderr)


if __name__ == "__main__":
    timed.main(sys.argv[3:])
