# More tests of the real window, with real input events: layers, files that other programs change, keys, exports.
import json
import math
import os
import random
import shutil
import stat
import subprocess
import sys
import time

import numpy
from PIL import Image

sys.path.insert(0, os.path.dirname(__file__))
from case import PROGRAM, SOURCE, Editor, WindowCase, real, recorded_only, real_in_soak, load, old_sample, few_or_many, run_tests, seed_of  # noqa: E402

RED, BLUE, GREEN = (220, 30, 30), (30, 60, 220), (20, 160, 60)


class EditorWindowTest(WindowCase):
    def plain(self, name, color, size=(300, 200)):
        path = os.path.join(self.work, name)
        Image.new("RGBA", size, color + (255,)).save(path)
        return path

    def color_at(self, editor, x, y):
        """The color that the canvas shows at a point of the plane."""
        px, py = editor.pixel(x, y)
        return self.screenshot(editor, "color")[py, px]

    def wait_color(self, editor, place, color, what):
        end = time.time() + 10
        while time.time() < end:
            if numpy.abs(self.color_at(editor, *place) - color).max() < 12:
                return
            editor.pause(0.1)
        self.fail(f"{what}: the color at {place} is {self.color_at(editor, *place)}, not {color}")

    def program(self, name, script):
        """Puts a stub for another program on PATH, ahead of the real one."""
        folder = os.path.join(self.work, "bin")
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(folder, name)
        with open(path, "w") as file:
            file.write("#!/bin/sh\n" + script)
        os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
        self.addCleanup(os.environ.__setitem__, "PATH", os.environ["PATH"])
        os.environ["PATH"] = folder + ":" + os.environ["PATH"]

    def preferences(self, **values):
        """A home directory with these preferences."""
        home = os.path.join(self.work, "home")
        os.makedirs(home + "/config/holomorph", exist_ok=True)
        with open(home + "/config/holomorph/preferences.json", "w") as file:
            json.dump(values, file)
        return home

    @real_in_soak
    def test_layers_are_added_hidden_locked_ordered_and_saved(self):
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        self.plain("caged.png", RED)
        blue = self.plain("blue.png", BLUE, (150, 200))
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the scene")
            self.wait_color(editor, (150, 100), RED, "the lower layer")
            editor.drop(blue, 400, 400)
            editor.press_item("Add as a layer")
            editor.wait(lambda s: s["layers"] == 2 and s["edited_layer"] == 1, "a second layer")
            self.wait_color(editor, (150, 100), BLUE, "the upper layer")
            self.wait_color(editor, (30, 100), RED, "the lower one next to it")
            editor.key("ctrl+h")
            editor.wait(lambda s: not s["visible"], "a hidden layer")
            self.wait_color(editor, (150, 100), RED, "the layer under it")
            editor.key("ctrl+h")
            editor.key("ctrl+Next")
            editor.wait(lambda s: s["visible"] and s["edited_layer"] == 0, "the layer at the bottom")
            self.wait_color(editor, (150, 100), RED, "the layer that covers the other")
            editor.key("Prior")
            editor.wait(lambda s: s["edited_layer"] == 1 and s["cage_points"] == 4, "the layer with the cage")
            editor.key("ctrl+l")
            editor.wait(lambda s: s["locked"], "a locked layer")
            step = editor.state()["step"]
            editor.drag((10, 10), (60, 60))
            self.assertEqual(editor.state()["step"], step, "a locked layer is not moved")
            editor.key("ctrl+l")
            editor.drag((10, 10), (60, 60))
            editor.wait(lambda s: s["step"] > step + 1, "a moved point")
            self.screenshot(editor, "layers")
            path = os.path.join(self.work, "layers.json")
            self.save_as(editor, path)
        saved = load(path)
        self.assertEqual([layer["image"]["file"] for layer in saved["layers"]], ["blue.png", "caged.png"])
        self.assertEqual(saved["edited"], 1)

    @real_in_soak
    def test_blended_layers_look_like_the_export(self):
        rng = numpy.random.default_rng(20)
        for mode in ("multiply", "screen", "overlay", "add", "normal"):
            with self.subTest(mode=mode):
                colors = [tuple(int(c) for c in rng.integers(0, 256, 3)) for _ in range(2)]
                opacity = round(float(rng.uniform(0.3, 0.9)), 2)
                self.plain("lower.png", colors[0], (300, 200))
                self.plain("upper.png", colors[1], (150, 200))
                scene, out = os.path.join(self.work, "blended.json"), os.path.join(self.work, "blended.png")
                with open(scene, "w") as file:
                    json.dump({"format": "holomorph", "version": 2, "layers": [
                        {"image": {"file": "lower.png"}, "cage": {"rest": [[[0, 0]], [[300, 0]], [[300, 200]], [[0, 200]]]}},
                        {"image": {"file": "upper.png"}, "opacity": opacity, "blending": mode,
                         "cage": {"rest": [[[0, 0]], [[150, 0]], [[150, 200]], [[0, 200]]]}}]}, file)
                subprocess.run([PROGRAM, "render", scene, "--out", out, "--force"], check=True, capture_output=True)
                exported = numpy.asarray(Image.open(out).convert("RGB")).astype(int)
                with Editor([scene]) as editor:
                    editor.wait(lambda s: s["layers"] == 2 and s["pictured"], "the scene")
                    editor.wait(lambda s: not s["moving"], "an interface at rest")
                    editor.pause(0.5)
                    shot = self.screenshot(editor, "blended-" + mode)
                    for x, y in ((75, 100), (225, 100)):
                        px, py = editor.pixel(x, y)
                        difference = numpy.abs(shot[py, px] - exported[200 - y, x]).max()
                        self.assertLessEqual(difference, 1, (mode, opacity, colors, x, shot[py, px], exported[200 - y, x]))

    @real
    def test_originals_look_like_the_export(self):
        """The original of a bent layer lies where the layer was placed; a box that was moved has none."""
        box = [[0, 0], [80, 0], [80, 60], [0, 60]]
        rest = [[p] for p in box]
        layers = [{"image": {"file": "a.png"}, "placement": {"factor": [0, 1], "shift": [90, 110]},
                   "cage": {"rest": rest, "pose": [[[x + 0.3 * y, y - 90]] for x, y in box]}},
                  {"image": {"file": "b.png"}, "cage": {"rest": rest, "pose": [[[x - 60, y + 40]] for x, y in box]}}]
        self.plain("a.png", (60, 200, 90), (80, 60))
        self.plain("b.png", (40, 90, 220), (80, 60))
        scene, out = os.path.join(self.work, "originals.json"), os.path.join(self.work, "originals.png")
        with open(scene, "w") as file:
            json.dump({"format": "holomorph", "version": 2, "background": "original", "layers": layers}, file)
        subprocess.run([PROGRAM, "render", scene, "--rect=-100,0,400,200", "--out", out, "--force"], check=True, capture_output=True)
        exported = numpy.asarray(Image.open(out).convert("RGBA")).astype(int)
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["layers"] == 2 and s["pictured"], "the scene")
            editor.wait(lambda s: not s["moving"], "an interface at rest")
            editor.pause(0.5)
            shot = self.screenshot(editor, "originals").astype(int)
            for x, y, color in ((60, 150, (60, 200, 90)), (150, 150, (60, 200, 90)), (-20, 70, (40, 90, 220)), (60, 50, None)):
                px, py = editor.pixel(x, y)
                if color:
                    self.assertEqual(tuple(exported[200 - y, 100 + x]), (*color, 255), (x, y))
                    self.assertLessEqual(numpy.abs(shot[py, px] - color).max(), 1, (x, y, shot[py, px]))
                else:
                    self.assertEqual(exported[200 - y, 100 + x, 3], 0)
                    self.assertLess(numpy.ptp(shot[py, px]), 30, "the page")

    @real
    def test_pictures_at_rest_are_shown_once(self):
        """The half that shows the pictures at rest has no originals behind them."""
        box = [[0, 0], [80, 0], [80, 60], [0, 60]]
        rest = [[p] for p in box]
        self.plain("right.png", (60, 200, 90), (80, 60))
        self.plain("left.png", (40, 90, 220), (80, 60))
        scene = os.path.join(self.work, "halves.json")
        with open(scene, "w") as file:
            json.dump({"format": "holomorph", "version": 2, "background": "original", "layers": [
                {"image": {"file": "right.png"}, "placement": {"factor": [1, 0], "shift": [300, 0]}, "cage": {"rest": rest}},
                {"image": {"file": "left.png"}, "cage": {"rest": rest, "pose": [[[x, y + 100]] for x, y in box]}}]}, file)
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["layers"] == 2 and s["pictured"] and not s["moving"], "the scene")
            self.wait_color(editor, (40, 130), (40, 90, 220), "the moved picture")
            editor.key("shift+backslash")
            editor.wait(lambda s: s["split"] == 0.5 and not s["moving"], "two halves")
            self.wait_color(editor, (40, 30), (40, 90, 220), "the picture at rest")
            self.assertLess(numpy.ptp(self.color_at(editor, 40, 130)), 30, "the page where it was moved to")

    @real
    def test_originals_do_not_shine_through_faint_layers(self):
        """A faint picture that is not bent, below one that is, looks the same with and without its original behind it."""
        Image.new("RGBA", (200, 120), (200, 60, 40, 120)).save(os.path.join(self.work, "faint.png"))
        self.plain("bent.png", (40, 90, 220), (80, 60))
        box = [[0, 0], [80, 0], [80, 60], [0, 60]]
        layers = [{"image": {"file": "faint.png"}, "cage": {"rest": []}},
                  {"image": {"file": "bent.png"}, "placement": {"factor": [1, 0], "shift": [120, 50]},
                   "cage": {"rest": [[p] for p in box], "pose": [[[x + 30 + 0.4 * y, y + 0.2 * x]] for x, y in box]}}]
        scene, shots = os.path.join(self.work, "faint.json"), []
        for background in ({}, {"background": "original"}):
            with open(scene, "w") as file:
                json.dump({"format": "holomorph", "version": 2, "layers": layers, **background}, file)
            with Editor([scene]) as editor:
                editor.wait(lambda s: s["layers"] == 2 and s["pictured"], "the scene")
                editor.wait(lambda s: not s["moving"], "an interface at rest")
                editor.pause(0.5)
                shot = self.screenshot(editor, "faint" + "".join(background.values())).astype(int)
                shots.append([shot[editor.pixel(x, y)[1], editor.pixel(x, y)[0]] for x, y in ((20, 20), (60, 100), (90, 40), (165, 116))])
        for k in range(3):
            self.assertLessEqual(numpy.abs(shots[1][k] - shots[0][k]).max(), 1, (k, shots))
        self.assertGreater(numpy.abs(shots[1][3] - shots[0][3]).max(), 50)  # the original of the bent one

    @real
    def test_layers_do_not_blend_with_originals(self):
        """In the gap that a bent page leaves, a faint layer with each mode lies on the original as in the export."""
        Image.new("RGBA", (200, 120), (200, 60, 40, 120)).save(os.path.join(self.work, "faint.png"))
        self.plain("page.png", (60, 200, 90), (200, 120))
        box = [[0, 0], [200, 0], [200, 120], [0, 120]]
        for mode in ("multiply", "screen", "overlay", "add"):
            with self.subTest(mode=mode):
                layers = [{"image": {"file": "page.png"}, "cage": {"rest": [[p] for p in box], "pose": [[[0.5 * x + 10, y]] for x, y in box]}},
                          {"image": {"file": "faint.png"}, "blending": mode, "cage": {"rest": []}}]
                scene, out = os.path.join(self.work, mode + ".json"), os.path.join(self.work, mode + ".png")
                with open(scene, "w") as file:
                    json.dump({"format": "holomorph", "version": 2, "background": "original", "layers": layers}, file)
                subprocess.run([PROGRAM, "render", scene, "--rect=0,0,200,120", "--out", out, "--force"], check=True, capture_output=True)
                exported = numpy.asarray(Image.open(out).convert("RGBA")).astype(int)
                on_original = [a * 120 / 255 + b * 135 / 255 for a, b in zip((200, 60, 40), (60, 200, 90))]
                with Editor([scene]) as editor:
                    editor.wait(lambda s: s["layers"] == 2 and s["pictured"], "the scene")
                    editor.wait(lambda s: not s["moving"], "an interface at rest")
                    editor.pause(0.5)
                    shot = self.screenshot(editor, "behind-" + mode).astype(int)
                    for x, y in ((60, 60), (150, 60), (190, 20)):
                        px, py = editor.pixel(x, y)
                        there = exported[120 - y, x]
                        self.assertEqual(there[3], 255)
                        self.assertLessEqual(numpy.abs(shot[py, px] - there[:3]).max(), 1, (x, shot[py, px], there))
                        if x != 60:
                            self.assertLessEqual(numpy.abs(there[:3] - on_original).max(), 1, (x, there))

    @real
    def test_clipped_layers_look_like_the_export(self):
        seed = seed_of("clipped layers")
        rng = numpy.random.default_rng(seed)
        colors = [tuple(int(c) for c in rng.integers(0, 256, 3)) for _ in range(4)]
        squares = [(0, 300), (40, 160), (90, 280), (120, 260)]  # left and right edges
        layers = []
        for i, (left, right) in enumerate(squares):
            picture = Image.new("RGBA", (300, 200))
            picture.paste(colors[i] + ((150 if i == 1 else 255),), (left, 0, right, 200))  # the base is soft
            picture.save(os.path.join(self.work, f"{i}.png"))
            layers.append({"image": {"file": f"{i}.png"}, "clipped": i in (2, 3), "opacity": [1, 0.8, 1, 0.6][i],
                           "blending": ["normal", "screen", "normal", "multiply"][i],
                           "cage": {"rest": []}})
        scene, out = os.path.join(self.work, "clipped.json"), os.path.join(self.work, "clipped.png")
        with open(scene, "w") as file:
            json.dump({"format": "holomorph", "version": 2, "layers": layers}, file)
        subprocess.run([PROGRAM, "render", scene, "--out", out, "--force"], check=True, capture_output=True)
        exported = numpy.asarray(Image.open(out).convert("RGB")).astype(int)
        self.assertEqual(exported[100, 200].tolist(), list(colors[0]))  # beside the base
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["layers"] == 4 and s["pictured"], "the scene")
            editor.wait(lambda s: not s["moving"], "an interface at rest")
            editor.pause(0.5)
            shot = self.screenshot(editor, "clipped")
            for x in (20, 60, 105, 140, 200, 290):
                px, py = editor.pixel(x, 100)
                difference = numpy.abs(shot[py, px] - exported[100, x]).max()
                self.assertLessEqual(difference, 1, (seed, x, shot[py, px], exported[100, x]))
            # The panel releases the layer, and the keys clip it again.
            editor.press_item("Clip")
            editor.wait(lambda s: s["step"] == 1, "a released layer")
            editor.key("ctrl+alt+g")
            editor.wait(lambda s: s["step"] == 2, "a clipped layer")
            editor.press_item("Clip")
            path = os.path.join(self.work, "released.json")
            self.save_as(editor, path)
        self.assertEqual([layer.get("clipped", False) for layer in load(path)["layers"]], [False, False, True, False])

    def test_layers_are_exported_from_the_dialog(self):
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        for kind in ("psd", "ora"):
            out = os.path.join(self.work, "layers." + kind)
            with Editor([scene]) as editor:
                editor.wait(lambda s: s["cage_points"] == 4, "the scene")
                self.ask(editor, "ctrl+e")
                editor.key("ctrl+a")
                editor.type(out)
                editor.key("Return")
                editor.wait(lambda s: os.path.exists(out) and not s["exporting"], "the exported layers")
            with open(out, "rb") as file:
                self.assertTrue(file.read(8).startswith(b"8BPS" if kind == "psd" else b"PK"))

    def test_a_drawing_opens_bends_and_is_exported_as_a_drawing(self):
        drawing = os.path.join(self.work, "gecko.svg")
        shutil.copy(os.path.join(SOURCE, "assets/gecko.svg"), drawing)
        with Editor([]) as editor:
            editor.wait(lambda s: s["empty"], "the welcome page")
            editor.drop(drawing, 700, 500)
            editor.wait(lambda s: s["pictured"] and s["tool"] == "pin", "the drawing and the pin tool", 60)
            editor.pause(0.5)
            self.screenshot(editor, "drawing-opened")
            for count, place in enumerate([(600, 410), (800, 668)], 1):
                editor.click(*place)
                editor.wait(lambda s: s["pins"] == count, f"pin {count}", 60)
            editor.drag((250, 270), (250, 360))
            editor.wait(lambda s: s["pins"] == 3 and not s["gesture"] and s["modified"], "a bent drawing", 60)
            editor.drop(drawing, 700, 500)
            editor.item("Use as the outline")
            self.screenshot(editor, "drawing-dropped")
            editor.key("Escape")
            scene = os.path.join(self.work, "bent.json")
            self.save_as(editor, scene)
            self.ask(editor, "ctrl+e")  # an SVG file is proposed
            out = os.path.join(self.work, "bent-bent.svg")
            editor.pause(0.5)
            self.screenshot(editor, "drawing-export")
            editor.key("Return")
            editor.wait(lambda s: os.path.exists(out) and not s["exporting"], "the exported drawing", 60)
            editor.pause(0.5)
            self.screenshot(editor, "drawing-exported")
        expected = os.path.join(self.work, "expected.svg")
        subprocess.run([PROGRAM, "export", scene, "--format", "drawing", "--out", expected], check=True, stderr=subprocess.DEVNULL)
        with open(out) as ours, open(expected) as theirs:
            self.assertEqual(ours.read(), theirs.read())

    def test_pictures_with_more_bits_from_the_dialog_have_the_bits_of_the_command(self):
        scene = self.caged((300, 200), [[20, 20], [280, 20], [280, 180], [20, 180]])
        subprocess.run(["convert", "-size", "300x200", "gradient:#203040-#506070", "-depth", "16", "-define", "png:bit-depth=16",
                        "-define", "png:color-type=2", os.path.join(self.work, "caged.png")], check=True)
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the scene")
            editor.key("r")
            for name, depth in (("deep.png", 16), ("half.exr", 16), ("single.exr", 32)):
                out, expected = (os.path.join(self.work, kind + name) for kind in ("window-", "command-"))
                self.ask(editor, "ctrl+e")
                editor.key("ctrl+a")
                editor.type(out)
                editor.press_item("Depth")
                editor.press_item(f"{depth} bits per color")
                editor.pause(0.5)
                self.screenshot(editor, "export-" + name)
                editor.key("Return")
                editor.wait(lambda s: os.path.exists(out) and not s["exporting"] and not s["asking"], "the export", 120)
                subprocess.run([PROGRAM, "render", scene, "--depth", str(depth), "--out", expected], check=True,
                               stderr=subprocess.DEVNULL)
                with open(out, "rb") as ours, open(expected, "rb") as theirs:
                    self.assertEqual(ours.read(), theirs.read(), name)
            with open(os.path.join(self.work, "window-deep.png"), "rb") as file:
                self.assertEqual(file.read()[24], 16)

    def test_formats_with_the_same_extension_are_told_apart(self):
        scene = self.caged((60, 40), [[5, 5], [55, 5], [55, 35], [5, 35]])
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the scene")
            for version, row in (("godot", None), ("godot3", "Godot 3 scene"), ("godot", "Godot 4 scene")):
                out, expected = (os.path.join(self.work, folder, f"{version}-{bool(row)}.tscn") for folder in ("window", "command"))
                for path in (out, expected):
                    os.makedirs(os.path.dirname(path), exist_ok=True)
                self.ask(editor, "ctrl+e")
                editor.key("ctrl+a")
                editor.type(out)
                if row:
                    editor.press_item("Format")
                    editor.press_item(row)
                editor.key("Return")
                editor.wait(lambda s: os.path.exists(out) and not s["exporting"] and not s["asking"], "the export", 60)
                subprocess.run([PROGRAM, "export", scene, "--format", version, "--out", expected], check=True, stderr=subprocess.DEVNULL)
                with open(out) as ours, open(expected) as theirs:
                    self.assertEqual(ours.read(), theirs.read(), (version, row))

    def test_meshes_and_st_maps_from_the_dialog_have_the_bits_of_the_command(self):
        cage = [[20, 20], [280, 20], [280, 180], [20, 180]]
        scene = self.caged((300, 200), cage)
        content = load(scene)
        content["animation"] = {"frames_per_second": 12}
        content["keyframes"] = [{"time": 0, "pose": {}}, {"time": 1, "pose": {"cage": [[[y + 20, 0.8 * x]] for x, y in cage]}}]
        with open(scene, "w") as file:
            json.dump(content, file)
        options = {"bent.glb": ["glb"], "bent.tscn": ["godot"], "bent.pc2": ["pc2"], "bent.exr": ["stmap", "--time", "0"]}
        chosen = {"bent.exr": "ST-map (OpenEXR)"}  # otherwise, it is a picture
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the scene")
            for name, words in options.items():
                out, expected = (os.path.join(self.work, folder, name) for folder in ("window", "command"))
                os.makedirs(os.path.dirname(out), exist_ok=True)
                os.makedirs(os.path.dirname(expected), exist_ok=True)
                self.ask(editor, "ctrl+e")
                editor.key("ctrl+a")
                editor.type(out)
                if name in chosen:
                    editor.press_item("Format")
                    editor.press_item(chosen[name])
                editor.pause(0.5)
                self.screenshot(editor, "export-" + name)
                editor.key("Return")
                editor.wait(lambda s: os.path.exists(out) and not s["exporting"] and not s["asking"], "the export", 120)
                subprocess.run([PROGRAM, "export", scene, "--format", *words, "--out", expected], check=True,
                               stderr=subprocess.DEVNULL)
            # The mesh is measured before it is exported, with fewer vertices if that is asked for.
            self.ask(editor, "ctrl+e")
            editor.key("ctrl+a")
            editor.type(os.path.join(self.work, "window/small.glb"))
            editor.press_item("Fewest vertices")
            editor.press_item("Full mesh")
            self.type_into(editor, "Per layer", "120")
            editor.pause(3)
            self.screenshot(editor, "export-small")
            editor.key("Return")
            editor.wait(lambda s: os.path.exists(os.path.join(self.work, "window/small.glb")) and not s["exporting"],
                        "a smaller mesh", 120)
            # Esc in the file chooser goes back to the dialog. The name for a skeleton is not that of a scene.
            self.ask(editor, "ctrl+e")
            editor.press_item("Format")
            editor.press_item("Spine skeleton")
            editor.press_item("Choose...")
            editor.pause(1)
            editor.key("Escape")
            editor.pause(0.5)
            self.assertTrue(editor.state()["asking"])
            editor.press_item("Format")
            editor.press_item("Moving meshes (glTF)")
            editor.press_item("Format")
            editor.press_item("Spine skeleton")
            editor.key("Return")
            editor.wait(lambda s: not s["exporting"] and not s["asking"], "the skeleton", 120)
            self.assertTrue(os.path.exists(os.path.join(self.work, "window/small-spine.json")))
            self.assertFalse(os.path.exists(os.path.join(self.work, "window/small-spine-spine.json")))
            # Other files are replaced only after a question, which counts all of them.
            os.remove(os.path.join(self.work, "window/bent.tscn"))
            texture, = (name for name in os.listdir(os.path.join(self.work, "window")) if name.startswith("bent-"))
            with open(os.path.join(self.work, "window", texture), "w") as file:
                file.write("mine")
            self.ask(editor, "ctrl+e")
            editor.key("ctrl+a")
            editor.type(os.path.join(self.work, "window/bent.TSCN"))  # names may be in capitals
            editor.press_item("Fewest vertices")  # settings stay from one export to the next
            editor.key("Return")
            editor.item("Replace")
            self.screenshot(editor, "export-replace-texture")
            with open(os.path.join(self.work, "window", texture)) as file:
                self.assertEqual(file.read(), "mine")
            editor.key("Return")
            editor.wait(lambda s: not s["exporting"] and not s["asking"], "the export", 120)
            os.rename(os.path.join(self.work, "window/bent.TSCN"), os.path.join(self.work, "window/bent.tscn"))
        subprocess.run([PROGRAM, "export", scene, "--format", "glb", "--vertices", "120", "--out",
                        os.path.join(self.work, "command/small.glb")], check=True, stderr=subprocess.DEVNULL)
        for name in os.listdir(os.path.join(self.work, "command")):
            with open(os.path.join(self.work, "window", name), "rb") as a, open(os.path.join(self.work, "command", name), "rb") as b:
                self.assertEqual(a.read(), b.read(), name)

    def test_opacity_and_blending_are_chosen_and_saved(self):
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the scene")
            left, top, right, bottom = editor.state()["items"]["Opacity"]
            editor.press(right - 30, (top + bottom) // 2)
            editor.pause(0.3)
            editor.key("ctrl+a")
            editor.type("40")
            editor.key("Return")
            editor.wait(lambda s: s["modified"], "another opacity")
            editor.press_item("Blending")
            editor.press_item("Screen")
            editor.wait(lambda s: s["step"] == 2, "another blending mode")
            path = os.path.join(self.work, "inked.json")
            self.save_as(editor, path)
        layer = load(path)["layers"][0]
        self.assertEqual((layer["opacity"], layer["blending"]), (0.4, "screen"))

    @real_in_soak
    def test_a_picture_that_another_program_changes_is_read_again(self):
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        self.plain("caged.png", RED)
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the scene")
            editor.drag((10, 10), (60, 40))
            step = editor.wait(lambda s: s["modified"], "a pose")["step"]
            self.wait_color(editor, (150, 100), RED, "the picture")
            self.plain("caged.png", GREEN)
            self.wait_color(editor, (150, 100), GREEN, "the changed picture")
            state = editor.state()
            self.assertEqual((state["step"], state["cage_points"]), (step, 4), "the cage and its pose stay")
            with open(os.path.join(self.work, "caged.png"), "w") as file:
                file.write("half a pic")  # a program that is still writing
            editor.pause(2.5)
            self.wait_color(editor, (150, 100), GREEN, "the picture that could be read")
            self.plain("caged.png", BLUE)
            self.wait_color(editor, (150, 100), BLUE, "the next one")

    def film(self, colors, rate):
        """A film with one color per frame."""
        path = os.path.join(self.work, "film.mp4")
        frames = b"".join(bytes(color + (255,)) * (300 * 200) for color in colors)
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgba", "-video_size", "300x200",
                        "-framerate", str(rate), "-i", "-", "-c:v", "libx264", "-pix_fmt", "yuv444p", "-g", "250", path],
                       input=frames, check=True)
        return path

    @real_in_soak
    def test_a_film_plays_as_a_picture(self):
        colors = [RED, GREEN, BLUE] * 8
        with Editor([self.film(colors, 4)]) as editor:
            state = editor.wait(lambda s: s["pictured"] and s["shows_time"], "the film and its timeline")
            self.assertFalse(state["runs"])
            for k in (0, 1, 2, 3):
                self.wait_color(editor, (150, 100), colors[k], f"frame {k}")
                editor.key("period")
            for k in (3, 2):
                editor.key("comma")
                self.wait_color(editor, (150, 100), colors[k], f"frame {k} again")
            editor.key("space")
            editor.wait(lambda s: s["runs"] and s["time"] > 1.5, "the film plays")
            editor.key("space")
            state = editor.wait(lambda s: not s["runs"], "the film stops")
            frame = round(state["time"] * 4)
            self.wait_color(editor, (150, 100), colors[frame], f"frame {frame}, where it stopped")
            # A trim is an undo step.
            self.type_into(editor, "First frame", "2")
            self.wait_color(editor, (150, 100), colors[frame + 2], "two frames later")
            editor.xdotool("mousemove", *editor.item("First frame"))
            for _ in range(10):
                editor.xdotool("click", 5)  # the wheel
            editor.press_item("Repeat")
            path = os.path.join(self.work, "film.json")
            self.save_as(editor, path)
            clip = load(path)["image"]["clip"]
            self.assertEqual((clip["first"], clip["after"], clip["frames"]), (2, "loop", len(colors)))
            editor.key("ctrl+z")
            editor.key("ctrl+z")
            self.wait_color(editor, (150, 100), colors[frame], "the whole film again")

    @real_in_soak
    def test_the_bar_of_a_film_is_dragged(self):
        colors = [RED, GREEN, BLUE] * 8
        with Editor([self.film(colors, 4)]) as editor:
            editor.wait(lambda s: s["pictured"] and s["shows_time"], "the film and its timeline")
            x, y = editor.item("ruler")
            row = editor.item("keys")[1]

            def scale():
                """Where time 0 is on the ruler, and the pixels of a second. Both change when the animation gets longer."""
                times = []
                editor.xdotool("keydown", "Alt_L", pause=0.8)
                for at in (x - 300, x + 300):
                    editor.press(at, y)
                    times.append(editor.state()["time"])
                editor.xdotool("keyup", "Alt_L")
                second = 600 / (times[1] - times[0])
                return x - 300 - times[0] * second, second

            def go_to(time):
                zero, second = scale()
                editor.press(round(zero + second * time), y)

            def drag(start, end, height=row):
                zero, second = scale()
                editor.xdotool("mousemove", round(zero + second * start), height)
                editor.xdotool("mousedown", 1)
                for k in (1, 2, 3):
                    editor.xdotool("mousemove", round(zero + second * (start + (end - start) * k / 3)), height)
                editor.xdotool("mouseup", 1)

            # Under a keyframe, the left end is dragged at the bar's upper edge.
            go_to(0)
            unbent = editor.state()["step"]
            editor.click(150, 150)
            editor.wait(lambda s: s["pins"] == 1, "a pin")
            editor.key("i")
            keyed = editor.wait(lambda s: s["keys"] == 1, "a keyframe at the film's start")["step"]
            drag(0, 1, row - 9)
            go_to(1)
            self.wait_color(editor, (150, 100), colors[4], "the frame that was there before")
            go_to(0)
            self.wait_color(editor, (150, 100), colors[4], "the first frame that is left")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["step"] == keyed and s["keys"] == 1, "the whole film again")
            while editor.state()["step"] > unbent:
                editor.key("ctrl+z")
            first_step = editor.wait(lambda s: s["keys"] == s["pins"] == 0, "neither a keyframe nor a pin")["step"]
            drag(6, 4)  # the right end
            drag(2, 3)
            go_to(0)
            self.wait_color(editor, (150, 100), colors[0], "the first frame, which is held")
            go_to(2.25)
            self.wait_color(editor, (150, 100), colors[5], "the frame of a second before")
            path = os.path.join(self.work, "film.json")
            self.save_as(editor, path)
            clip = load(path)["image"]["clip"]
            self.assertEqual((clip["start"], clip.get("first", 0)), (1, 0))
            self.assertAlmostEqual(clip["last"], 15, delta=1)
            editor.key("ctrl+z")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["step"] == first_step, "both drags are undone")
            self.wait_color(editor, (150, 100), colors[9], "the whole film again")

    def test_a_film_with_sound_is_exported_with_it_by_default(self):
        film = self.film([RED, GREEN, BLUE, RED], 4)
        heard = os.path.join(self.work, "heard.mp4")
        subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-f", "lavfi", "-i", "sine=frequency=440:duration=1", "-c:v",
                        "copy", "-c:a", "aac", heard], check=True)
        with Editor([heard]) as editor:
            editor.wait(lambda s: s["pictured"] and s["shows_time"], "the film")
            self.ask(editor, "ctrl+e")
            editor.key("Return")
            out = os.path.join(self.work, "heard-bent.mp4")
            editor.wait(lambda s: not s["exporting"] and os.path.exists(out), "the exported film")
            kinds = subprocess.run(["ffprobe", "-v", "error", "-show_entries", "stream=codec_type", "-of", "csv=p=0", out],
                                   capture_output=True, text=True, check=True).stdout.split()
            self.assertEqual(sorted(kinds), ["audio", "video"])

    @real_in_soak
    def test_numbered_pictures_play_as_a_film(self):
        for k, color in enumerate([RED, GREEN, BLUE]):
            self.plain(f"step-{k + 7:03d}.png", color)
        with Editor([os.path.join(self.work, "step-008.png")]) as editor:
            self.wait_color(editor, (150, 100), GREEN, "the picture alone")
            editor.press_item("Play as film")
            editor.wait(lambda s: s["shows_time"], "the timeline")
            for k, color in enumerate([RED, GREEN, BLUE]):
                self.wait_color(editor, (150, 100), color, f"frame {k}")
                editor.key("period")
            for _ in range(4):
                editor.key("comma")
            editor.key("ctrl+z")
            self.wait_color(editor, (150, 100), GREEN, "the picture alone again")

    @real
    def test_pictures_come_from_the_clipboard_and_go_there(self):
        there, copied = os.path.join(self.work, "there.png"), os.path.join(self.work, "copied.png")
        self.plain("there.png", GREEN, (120, 200))
        # xclip -out writes a picture; -in reads one and leaves a helper process behind, like the real program.
        self.program("xclip", f'case "$*" in *-out) cat {there};; *) cat > {copied}.part; mv {copied}.part {copied}; '
                              f'sleep 30 & esac\n')
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        self.plain("caged.png", RED)
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the scene")
            self.by_palette(editor, "paste picture")
            editor.wait(lambda s: s["layers"] == 2, "the pasted layer")
            self.wait_color(editor, (150, 100), GREEN, "the pasted picture")
            self.by_palette(editor, "copy picture")
            editor.wait(lambda s: os.path.exists(copied), "the copied picture")
            path = os.path.join(self.work, "pasted.json")
            self.save_as(editor, path)
        image = numpy.asarray(Image.open(copied).convert("RGB"))
        self.assertEqual(image.shape, (200, 300, 3))
        self.assertEqual([tuple(image[100, x]) for x in (150, 40)], [GREEN, RED])
        file = load(path)["layers"][1]["image"]["file"]
        self.assertEqual(os.path.dirname(file), "", "the pasted picture is next to the scene")
        self.assertTrue(os.path.exists(os.path.join(self.work, file)))

    def test_the_desktops_file_dialog_is_used_where_there_is_one(self):
        chosen = self.plain("chosen.png", BLUE)
        log = os.path.join(self.work, "asked")
        self.program("zenity", f'echo "$@" > {log}; echo {chosen}\n')
        with Editor([]) as editor:
            editor.wait(lambda s: s["empty"], "the welcome page")
            editor.key("ctrl+o")
            editor.wait(lambda s: not s["empty"], "the chosen picture")
            with open(log) as file:
                self.assertIn("*.png", file.read())
            self.program("zenity", "exit 1\n")  # canceled
            editor.key("ctrl+o")
            editor.pause(0.8)
            editor.key("ctrl+n")
            editor.wait(lambda s: s["empty"], "a window that still responds")

    @real
    def test_keys_are_changed_and_kept(self):
        scene = old_sample("giraffe")
        home = self.preferences(hints=False)
        with Editor([scene], home=home) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the giraffe")
            self.ask(editor, "F1")
            editor.type("checker")
            self.screenshot(editor, "keys")
            editor.key("Down")  # selects the only row
            editor.key("Return")
            editor.pause(0.3)
            self.screenshot(editor, "keys-waiting")
            editor.key("m")  # the key of the mesh view: pressing it once does not reassign it
            editor.pause(0.3)
            self.screenshot(editor, "keys-taken")
            editor.key("j")
            editor.pause(0.3)
            # The panel waits for a key again. A held key counts as one press, and Escape cancels.
            editor.key("Return")
            editor.pause(0.3)
            editor.xdotool("keydown", "m")
            editor.pause(1.2)
            editor.xdotool("keyup", "m")
            editor.key("Escape")
            editor.pause(0.3)
            editor.key("Escape")
            editor.pause(0.3)
            editor.key("5")
            editor.pause(0.3)
            self.assertEqual(editor.state()["view"], "image", "the old key is free")
            before = self.screenshot(editor, "no-mesh")
            editor.key("m")
            editor.pause(0.5)
            self.assertGreater((numpy.abs(self.screenshot(editor, "mesh") - before).max(axis=2) > 20).sum(), 500)
            editor.key("j")
            editor.wait(lambda s: s["view"] == "checker", "the new key")
        with Editor([scene], home=home) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the giraffe")
            editor.key("j")
            editor.wait(lambda s: s["view"] == "checker", "the new key in the next session")

    def test_the_first_steps_are_shown_one_by_one_and_closed(self):
        home = self.preferences(native_dialogs=False)
        with Editor([self.picture], home=home) as editor:
            editor.wait(lambda s: not s["empty"], "the picture")
            self.screenshot(editor, "start")
            editor.click(600, 420)
            editor.wait(lambda s: s["pins"] == 1 and s["method"] == "sheet", "the first pin")
            editor.wait(lambda s: "Hold it" in s["items"], "the first step")
            self.screenshot(editor, "hints-1")
            editor.press_item("Hold the rest")
            state = editor.wait(lambda s: s["pins"] > 2 and "Bend it" in s["items"], "the second step")
            editor.drag((600, 420), (600, 480))
            editor.wait(lambda s: "Keep it" in s["items"], "the third step")
            self.screenshot(editor, "hints-3")
            editor.key("ctrl+z")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["pins"] == 1, "undo")
            self.assertIn("Keep it", editor.state()["items"], "it never goes back a step")
            target = os.path.join(self.work, "bent.png")
            self.ask(editor, "ctrl+e")
            editor.key("ctrl+a")
            editor.type(target)
            editor.key("Return")
            editor.wait(lambda s: os.path.exists(target) and "Keep it" not in s["items"], "no card after an export")
        self.assertFalse(load(home + "/config/holomorph/preferences.json")["hints"])

    def test_a_held_key_stands_in_for_alt(self):
        scene = self.caged((300, 200), [[10, 10], [150, 5], [290, 10], [290, 190], [10, 190]])
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 5, "the scene")
            editor.move(150, 5)
            editor.xdotool("keydown", "q", pause=0.8)  # keys are not waited for, and machines may be busy
            editor.xdotool("click", 1)
            editor.xdotool("keyup", "q")
            editor.wait(lambda s: s["cage_points"] == 4, "a deleted point")

    @real
    def test_a_press_acts_where_the_pointer_was(self):
        """A press acts where it happened, even if the pointer moves 20 pixels before the program reads it."""
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        self.plain("caged.png", RED)
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the scene")
            x, y = editor.pixel(290, 190)
            for drag in range(5):
                wanted = (330, 220 - 5 * drag)
                editor.xdotool("mousemove", x, y, "mousedown", 1, "mousemove", x + 20, y - 20,
                               "mousemove", *editor.pixel(*wanted), "mouseup", 1, pause=0.6)
                editor.wait(lambda s: s["step"] == 1, "a moved cage point")
                editor.key("ctrl+s")
                editor.wait(lambda s: not s["modified"], "the saved scene")
                with open(scene) as file:
                    pose = numpy.reshape(json.load(file)["cage"]["pose"], (4, 2)).tolist()
                self.assertLess(math.dist(pose[2], wanted), 2, pose)
                self.assertEqual(pose[:2] + pose[3:], [[10, 10], [290, 10], [10, 190]])
                editor.key("ctrl+z")
                editor.wait(lambda s: s["step"] == 0, "the point where it was")

    def gestures(self, rng, count):
        """Random clicks and short drags on the picture of the gecko that start apart from each other, as lines of points."""
        with Image.open(self.picture) as picture:
            alpha = numpy.asarray(picture.convert("RGBA"))[:, :, 3]
        height, width = alpha.shape
        starts = []
        while len(starts) < count:
            x, y = rng.randrange(width), rng.randrange(height)
            inside = alpha[max(0, y - 12):y + 13, max(0, x - 12):x + 13].min() > 200
            if inside and all(math.dist((x, height - y), start) > 110 for start in starts):
                starts.append((x, height - y))
        return [[start] + ([(start[0] + rng.uniform(-25, 25), start[1] + rng.uniform(-25, 25)) for _ in range(rng.randint(1, 4))]
                           if rng.random() < 0.4 else []) for start in starts]

    def pinned(self, gestures, play):
        """The pins of the scene after gestures on the picture. `play` sends lists of events, one for each gesture."""
        scene = os.path.join(self.work, "pinned.json")
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: s["pictured"] and s["tool"] == "pin", "the picture")
            lines = [[editor.pixel(*point) for point in line] for line in gestures]
            play(editor, [[["move", *line[0]], ["button", 0, True], *(["move", *point] for point in line[1:]), ["button", 0, False]]
                          for line in lines])
            editor.wait(lambda s: s["pins"] > 0 and not s["pending"] and not s["gesture"], "the pins")
            editor.key("ctrl+s")
            editor.press_item("Save")
            editor.wait(lambda s: not s["modified"], "the saved scene")
        saved = os.path.join(self.work, "gecko.json")
        os.replace(saved, scene)
        return load(scene)["pins"]

    @recorded_only
    def test_quick_clicks_and_drags_end_like_slow_ones(self):
        def slowly(editor, gestures):
            for events in gestures:
                for event in events:
                    editor.send(event)
                    editor.settle(0.3)
                    editor.ready()

        def quickly(editor, gestures):
            while gestures:
                some = rng.randint(1, len(gestures))
                editor.send(*(event for events in gestures[:some] for event in events))
                gestures = gestures[some:]

        for case in range(few_or_many(2, 20)):
            rng = random.Random(f"{seed_of('quick clicks')} {case}")
            gestures = self.gestures(rng, rng.randint(3, 6))
            slow, quick = self.pinned(gestures, slowly), self.pinned(gestures, quickly)
            self.assertEqual(len(slow), len(quick), (case, gestures))
            for a, b in zip(slow, quick):
                self.assertLess(math.dist(a["rest"], b["rest"]), 0.5, (case, slow, quick))
                self.assertLess(math.dist(a["pose"], b["pose"]), 0.5, (case, slow, quick))

    @recorded_only
    def test_escape_discards_the_clicks_that_wait_for_the_cage(self):
        with Image.open(self.picture) as picture:
            picture.resize((4400, 3600)).save(self.picture)  # a cage that takes a while
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: s["pictured"] and s["tool"] == "pin", "the picture")
            x, y = editor.pixel(2200, 1800)
            click = [["move", x, y], ["button", 0, True], ["button", 0, False]]
            editor.send(*click, *click, *editor.pressed("Escape"))
            editor.wait(lambda s: not s["pending"] and not s["exporting"], "the end of the job")
            self.assertEqual(editor.state()["pins"], 0)
            editor.send(*click)
            editor.wait(lambda s: s["pins"] == 1 and not s["gesture"], "a pin, with the button up")

    @recorded_only
    def test_the_window_survives_extreme_poses(self):
        """Handles far beyond what floats of the graphics library hold, with each method and tool."""
        rng = random.Random(seed_of("extreme poses"))
        methods = ["angles", "bounded", "cage", "har_arap", "arap", "mean_value", "pins", "puppet", "sheet", "strokes", "outline", "harmonic"]
        samples = [os.path.join(SOURCE, "assets", name) for name in ("fern.json", "octopus.json", "snake.json", "heart.json")]

        def far(point):
            size = 10 ** rng.uniform(0, 7.9)
            return [max(-9.9e7, min(9.9e7, value + rng.uniform(-size, size))) for value in point]

        def extreme(scene):
            method = rng.choice(methods)
            scene["method"] = {"id": method}
            rest = [point for segment in scene["cage"]["rest"] for point in segment]
            if method == "outline":
                scene.setdefault("outline", [far(rest[0]) for _ in range(5)])
            if rng.random() < 0.7:
                scene["cage"]["pose"] = [[far(point) for point in segment] for segment in scene["cage"]["rest"]]
            for pin in scene.get("pins", []):
                pin.update(pose=far(pin["rest"]), angle=rng.uniform(-9e4, 9e4), scale=10 ** rng.uniform(-2, 2))
            for stroke in scene.get("strokes", []):
                stroke["pose"] = [far(point) for point in stroke["rest"]]
            scene["corners"] = [{"vertex": v, "before": rng.uniform(-900, 900), "after": rng.uniform(-900, 900)}
                                for v in range(min(6, len(scene["cage"]["rest"])))]
            scene.pop("keyframes", None)
            scene.pop("surface", None)
            scene.pop("image", None)
            return method

        crash = {"format": "holomorph", "version": 1, "cage": {"rest": [[[0, 0]], [[200, 0]], [[200, 200]], [[0, 200]]]},
                 "method": {"id": "angles"}, "corners": [{"vertex": v, "before": turn, "after": turn} for v, turn in enumerate((0, 200, 0, -200))]}
        for case in range(few_or_many(8, 60)):
            scene, method = (crash, "angles") if case == 0 else (None, None)
            if not scene:
                scene = load(rng.choice(samples))
                method = extreme(scene)
            path = os.path.join(self.work, "extreme.json")
            with open(path, "w") as file:
                json.dump(scene, file)
            with Editor([path]) as editor:
                for key in "a" + "".join(rng.sample("vnpsuaogx", 9)):
                    editor.key(key)
                    for event in ([["move", rng.uniform(60, 1000), rng.uniform(60, 700)]],
                                  editor.pressed("r"), editor.pressed("0"), [["scroll", rng.choice([-20, 20])]], editor.pressed("ctrl+a")):
                        editor.send(*event)
                        self.assertIsNone(editor.process.poll(), (case, method, key, editor.messages()))

    def test_two_clicks_are_a_double_click_only_if_they_are_quick(self):
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4 and s["tool"] == "select", "the scene")
            edge = editor.pixel(150, 190)
            editor.xdotool("mousemove", *edge)
            for _ in range(2):
                editor.press(*edge)
                editor.pause(3)  # the window sleeps, so no frame tells how much time has passed
            self.assertEqual(editor.state()["cage_points"], 4)
            editor.xdotool("click", "--repeat", 2, "--delay", 60, 1)
            editor.wait(lambda s: s["cage_points"] == 5, "another point")

    @real_in_soak
    def test_before_and_after_lie_side_by_side(self):
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        half = numpy.zeros((200, 300, 4), numpy.uint8)
        half[:, :] = RED + (255,)
        half[100:, :] = BLUE + (255,)  # the lower half
        Image.fromarray(half).save(os.path.join(self.work, "caged.png"))
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the scene")
            editor.key("ctrl+a")
            for _ in range(4):
                editor.key("shift+Up")  # by 40 px in total
            editor.wait(lambda s: s["modified"], "a moved picture")
            editor.key("0")
            editor.key("shift+backslash")
            editor.wait(lambda s: s["split"] == 0.5, "two halves")
            self.wait_color(editor, (75, 120), RED, "before")
            self.wait_color(editor, (225, 120), BLUE, "after")
            editor.drag((150, 150), (250, 150))
            editor.wait(lambda s: s["split"] > 0.6, "the dragged line")
            self.wait_color(editor, (225, 120), RED, "before, as far as the line")
            self.screenshot(editor, "before-after")

    def red_scene(self):
        """A scene with a red picture of 300 x 200 px and a cage 10 px inside its border."""
        scene = self.caged((300, 200), [[10, 10], [290, 10], [290, 190], [10, 190]])
        self.plain("caged.png", RED)
        return scene

    def move_right(self, editor, times):
        """Moves the whole cage to the right by 10 px, this many times."""
        editor.wait(lambda s: s["cage_points"] == 4, "the scene")
        editor.key("ctrl+a")
        for _ in range(times):
            editor.key("shift+Right")
        editor.wait(lambda s: s["modified"], "a moved picture")

    def test_an_export_shows_what_it_will_be_and_repeats(self):
        target = os.path.join(self.work, "out.png")
        with Editor([self.red_scene()]) as editor:
            self.move_right(editor, 1)
            self.by_palette(editor, "background: original")
            self.ask(editor, "ctrl+e")
            self.screenshot(editor, "export")
            editor.key("ctrl+a")
            editor.type(target)
            editor.key("Return")
            editor.wait(lambda s: os.path.exists(target), "the export")
            image = Image.open(target)
            self.assertEqual(image.size, (310 - 10, 200))
            editor.wait(lambda s: not s["exporting"] and not s["asking"], "the end of the export")
            os.remove(target)
            editor.key("ctrl+shift+e")
            editor.wait(lambda s: os.path.exists(target), "the export again")
            # Enter exports after a choice with the mouse, too.
            self.ask(editor, "ctrl+e")
            editor.press_item("Format")
            editor.press_item("JPEG picture")
            editor.pause(0.3)
            editor.key("Return")
            editor.wait(lambda s: os.path.exists(os.path.join(self.work, "out.jpg")), "the export as JPEG")

    def test_what_is_exported_is_chosen_without_a_mouse(self):
        target = os.path.join(self.work, "out.png")
        with Editor([self.red_scene()]) as editor:
            self.move_right(editor, 4)
            self.ask(editor, "ctrl+e")
            editor.key("ctrl+a")
            editor.type(target)
            for _ in range(4):  # format, depth, scale, region
                editor.key("Down")
            for key in ("Return", "Down", "Return"):  # the second choice: the picture's rectangle
                editor.key(key)
                editor.pause(0.2)
            editor.key("Down")  # background
            for key in ("Return", "Down", "Down", "Return"):  # the third choice: a color
                editor.key(key)
                editor.pause(0.2)
            self.screenshot(editor, "export-chosen")
            for key in ("Down", "Down", "Down", "Right", "Return"):  # past the color, to the button at the right
                editor.key(key)
            editor.wait(lambda s: os.path.exists(target), "the export")
            editor.wait(lambda s: not s["asking"], "the closed dialog")
            image = numpy.asarray(Image.open(target))
            self.assertEqual(image.shape, (200, 300, 4))
            self.assertEqual(image[:, :, 3].min(), 255, "a background everywhere")
            self.assertNotEqual(tuple(image[100, 20, :3]), RED, "where the picture was")
            self.assertEqual(tuple(image[100, 150, :3]), RED)
            self.ask(editor, "ctrl+e")
            editor.key("ctrl+a")
            editor.type(os.path.join(self.work, "out.bmp"))
            editor.key("Return")
            editor.pause(0.5)
            self.assertTrue(editor.state()["asking"], "no such format")
            editor.key("ctrl+a")
            editor.type(os.path.join(self.work, "out.jpg"))
            editor.key("Return")
            editor.wait(lambda s: os.path.exists(os.path.join(self.work, "out.jpg")), "the JPEG")
            self.assertEqual(Image.open(os.path.join(self.work, "out.jpg")).format, "JPEG")
        self.assertFalse(any(name.startswith("out.bmp") for name in os.listdir(self.work)))

    def test_panels_take_the_keys(self):
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: s["pictured"], "the picture")
            editor.pause(0.4)
            editor.key("F6")
            editor.wait(lambda s: s["in_panel"], "the suggestions with the keyboard focus")
            for key in ("Down", "Right", "Return"):  # Place
                editor.key(key)
            editor.wait(lambda s: s["cage_points"] == 4 and s["selected"] == 4, "a box around the picture")
            if editor.state()["in_panel"]:  # the suggestions are part of the inspector
                editor.key("Escape")
                editor.wait(lambda s: not s["in_panel"], "the canvas with the keyboard focus")
            self.type_into_inspector(editor, 4, "50")  # x, y, degrees, size
            self.type_into_inspector(editor, 3, "90")
            self.type_into_inspector(editor, 1, "100")
            path = os.path.join(self.work, "moved.json")
            self.save_as(editor, path)
            width, height = Image.open(self.picture).size
            pose = numpy.array([segment[0] for segment in load(path)["cage"]["pose"]])
            self.assertEqual(len(pose), 4)
            extent = pose.max(axis=0) - pose.min(axis=0)
            numpy.testing.assert_allclose(extent, [height / 2, width / 2], atol=1e-6)
            numpy.testing.assert_allclose((pose.max(axis=0) + pose.min(axis=0)) / 2, [100, height / 2], atol=1e-6)
            editor.key("F6")
            editor.wait(lambda s: s["in_panel"], "a panel with the keyboard focus")
            editor.key("v")
            editor.key("n")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["step"] == 3, "undo")
            self.assertEqual(editor.state()["tool"], "select", "letters do not go to the canvas")
            editor.click(width / 2, height / 2)
            editor.wait(lambda s: not s["in_panel"], "a click on the canvas gives it the keyboard focus")
            editor.key("ctrl+a")
            editor.wait(lambda s: s["selected"] == 4, "everything")
            editor.key("shift+F10")
            editor.pause(0.3)
            editor.key("Escape")
            editor.pause(0.3)
            self.assertEqual(editor.state()["selected"], 4, "Escape only closed the menu")
            editor.key("F10")
            editor.pause(0.4)
            self.screenshot(editor, "menu")
            for key in ("Down", "Up", "Return"):  # the first menu's last entry: Quit
                editor.key(key)
                editor.pause(0.2)
            editor.wait(lambda s: s["asking"], "the question about unsaved work")
            editor.key("Escape")
            editor.wait(lambda s: not s["asking"], "the answer")
            editor.key("F10")
            for key in ("Right", "Right", "Right"):  # Edit, Layer, Cage
                editor.key(key)
                editor.pause(0.2)
            self.screenshot(editor, "menu-cage")
            editor.key("Down")
            editor.pause(0.2)
            editor.key("Return")  # its first enabled entry: Make from picture
            editor.wait(lambda s: s["cage_points"] > 4, "a cage from the picture")

    @real
    def test_looks_are_chosen_by_name(self):
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: s["pictured"] and s["theme"] == "dark" and s["scale"] == 1, "the picture")
            menu = (slice(2, 20), slice(400, 500))
            self.assertLess(self.screenshot(editor, "dark")[menu].mean(), 90)
            self.by_palette(editor, "theme light")
            editor.wait(lambda s: s["theme"] == "light", "the light theme")
            editor.pause(0.3)
            self.assertGreater(self.screenshot(editor, "light")[menu].mean(), 180)
            self.by_palette(editor, "theme contrast")
            editor.wait(lambda s: s["theme"] == "contrast", "high contrast")
            editor.pause(0.3)
            self.assertLess(self.screenshot(editor, "contrast")[menu].mean(), 10)
            self.by_palette(editor, "interface 200")
            editor.wait(lambda s: s["scale"] == 2, "twice the size")
            self.screenshot(editor, "contrast-200")

    @real_in_soak
    def test_a_missing_picture_is_found(self):
        scene = self.red_scene()
        away = os.path.join(self.work, "away")
        os.mkdir(away)
        shutil.move(os.path.join(self.work, "caged.png"), os.path.join(away, "renamed.png"))
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4 and not s["pictured"], "the scene without its picture")
            editor.pause(0.5)
            self.screenshot(editor, "missing")
            self.ask(editor, "ctrl+e")
            editor.key("ctrl+a")
            editor.type(os.path.join(self.work, "out.png"))
            editor.key("Return")
            editor.pause(0.8)
            self.assertFalse(os.path.exists(os.path.join(self.work, "out.png")), "an export without the picture")
            editor.key("Escape")
            self.by_palette(editor, "missing")
            editor.wait(lambda s: s["asking"], "the question where the picture is")
            editor.key("ctrl+a")
            editor.type(os.path.join(away, "renamed.png"))
            editor.key("Return")
            editor.wait(lambda s: s["pictured"], "the picture")
            self.wait_color(editor, (150, 100), RED, "the picture")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "the saved scene")
            self.assertEqual(load(scene)["image"]["file"], "away/renamed.png")
        shutil.move(os.path.join(away, "renamed.png"), os.path.join(self.work, "kept.png"))
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4 and not s["pictured"], "the scene without its picture")
            editor.pause(1.2)
            shutil.move(os.path.join(self.work, "kept.png"), os.path.join(away, "renamed.png"))
            editor.wait(lambda s: s["pictured"] and not s["modified"], "the picture that is back")
        layer = {key: load(scene)[key] for key in ("image", "cage")}
        with open(scene, "w") as file:  # a picture can also be found for a locked layer
            json.dump({"format": "holomorph", "version": 2, "edited": 0, "layers": [dict(layer, locked=True)]}, file)
        shutil.move(os.path.join(away, "renamed.png"), os.path.join(self.work, "kept.png"))
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["locked"] and not s["pictured"], "the locked layer without its picture")
            self.by_palette(editor, "missing")
            editor.wait(lambda s: s["asking"], "the question where the picture is")
            editor.key("ctrl+a")
            editor.type(os.path.join(self.work, "kept.png"))
            editor.key("Return")
            editor.wait(lambda s: s["pictured"], "the picture of a locked layer")

    def home_of_tests(self):
        """A home directory for several sessions, without the first steps, which would cover what tests click on."""
        home = os.path.join(self.work, "home")
        os.makedirs(os.path.join(home, "config/holomorph"))
        with open(os.path.join(home, "config/holomorph/preferences.json"), "w") as file:
            json.dump({"hints": False}, file)
        return home

    def square_scene(self, folder, picture):
        path = os.path.join(folder, "scene.json")
        with open(path, "w") as file:
            json.dump({"format": "holomorph", "version": 1, "image": {"file": picture},
                       "cage": {"rest": [[[100, 100]], [[1000, 100]], [[1000, 600]], [[100, 600]]]}}, file)
        return path

    def change(self, path, x):
        """Replaces the scene's file with another one, as git or another window does."""
        scene = load(path)
        scene["cage"]["rest"][0][0][0] = x
        scene["cage"].pop("pose", None)
        with open(path + ".new", "w") as file:
            json.dump(scene, file)
        os.replace(path + ".new", path)

    def test_pictures_from_other_folders_are_shown_when_the_user_agrees(self):
        folder = os.path.join(self.work, "in")
        os.mkdir(folder)
        scene = self.square_scene(folder, "../gecko.png")
        home = self.home_of_tests()
        with Editor([scene], home=home) as editor:
            editor.wait(lambda s: s["question"] == "Files from other folders", "the question")
            self.screenshot(editor, "elsewhere")
            editor.key("Return")  # leaves the picture out
            editor.wait(lambda s: not s["asking"] and not s["pictured"], "the scene without it")
            self.screenshot(editor, "withheld")
            editor.key("ctrl+q")
            editor.process.wait(timeout=10)
        with Editor([scene], home=home) as editor:
            editor.wait(lambda s: s["question"] == "Files from other folders", "the question again")
            editor.press_item("Show them")
            editor.wait(lambda s: s["pictured"] and not s["modified"], "the picture")
            editor.key("ctrl+q")
            editor.process.wait(timeout=10)
        os.mkdir(os.path.join(self.work, "other"))
        other = self.square_scene(os.path.join(self.work, "other"), "../gecko.png")
        for each in (scene, other):  # the answer is remembered for all scenes
            with Editor([each], home=home) as editor:
                editor.wait(lambda s: s["pictured"] and not s["asking"], "the picture")
        path = os.path.join(home, "config/holomorph/preferences.json")
        preferences = load(path)
        self.assertIn(self.work, preferences.pop("trusted"))
        with open(path, "w") as file:
            json.dump(preferences, file)
        with Editor([other], home=home) as editor:
            editor.wait(lambda s: s["question"] == "Files from other folders", "the question, as at first")
        with Editor(["--allow-outside", scene]) as editor:
            editor.wait(lambda s: s["pictured"] and not s["asking"], "the picture without a question")

    def test_a_scene_that_another_program_changes_is_read_again(self):
        scene = self.square_scene(self.work, "gecko.png")
        with Editor([scene]) as editor:
            before = editor.wait(lambda s: s["pictured"] and not s["busy"], "the scene")
            editor.key("plus")
            zoomed = editor.wait(lambda s: s["zoom"] > before["zoom"], "another view")
            self.change(scene, 180)
            again = editor.wait(lambda s: s["first_point"] == [180, 100], "the file's new content")
            self.assertEqual(again["zoom"], zoomed["zoom"], "the view stays")
            # If there is unsaved work, the editor asks which version to keep, and neither is lost.
            editor.key("ctrl+a")
            editor.key("Right")
            editor.wait(lambda s: s["modified"], "an edit")
            self.change(scene, 250)
            editor.pause(1.5)
            self.assertTrue(editor.state()["modified"])
            editor.key("ctrl+s")
            editor.wait(lambda s: s["question"] == "Changed by another program", "the question")
            self.screenshot(editor, "changed")
            self.assertEqual(load(scene)["cage"]["rest"][0][0][0], 250, "the file is not overwritten")
            editor.key("Return")  # cancels
            editor.wait(lambda s: not s["asking"] and s["modified"], "no answer")
            editor.key("ctrl+s")
            editor.wait(lambda s: s["asking"], "the question")
            editor.xdotool("mousemove", *editor.item("Overwrite with this version"), "click", 1, "key", "Right")
            editor.wait(lambda s: s["modified"] and not s["asking"], "an edit right after the dialog")
            self.assertEqual(load(scene)["cage"]["rest"][0][0][0], 180)
            self.change(scene, 300)
            editor.key("ctrl+s")
            editor.wait(lambda s: s["asking"], "the question")
            editor.press_item("Reload the file")
            editor.wait(lambda s: s["first_point"] == [300, 100] and not s["modified"], "the file's content")
            editor.key("ctrl+z")  # reloading can be undone like any other step
            editor.wait(lambda s: s["first_point"] == [180, 100] and s["modified"], "the previous content")
            editor.key("ctrl+shift+z")
            editor.wait(lambda s: s["first_point"] == [300, 100] and not s["modified"], "the reloaded scene again")
            # If the file is damaged or deleted, the work counts as unsaved, and quitting asks.
            with open(scene, "w") as file:
                file.write('{"format"')
            editor.wait(lambda s: s["modified"] and s["first_point"] == [300, 100], "unsaved work")
            editor.key("ctrl+s")
            editor.wait(lambda s: s["asking"], "the question")
            editor.press_item("Overwrite with this version")
            editor.wait(lambda s: not s["modified"], "the saved scene")
            os.remove(scene)
            editor.wait(lambda s: s["modified"], "unsaved work")
            editor.key("ctrl+q")
            editor.wait(lambda s: s["question"] == "Unsaved changes", "the question")

    def test_unsaved_work_is_offered_where_its_scene_is_opened(self):
        scene = self.square_scene(self.work, "gecko.png")
        home = self.home_of_tests()
        with Editor([scene], home=home) as editor:
            editor.wait(lambda s: s["pictured"] and not s["busy"], "the scene")
            editor.key("ctrl+a")
            for _ in range(3):
                editor.key("Right")
            editor.wait(lambda s: s["history"] == 2 or s["modified"], "an edit")
            editor.pause(0.3)
            editor.process.kill()
            editor.process.wait()
        with Editor([scene], home=home) as editor:
            editor.wait(lambda s: s["question"] == "Unsaved work", "the offer")
            self.screenshot(editor, "offered")
            editor.key("Return")
            editor.wait(lambda s: s["modified"] and not s["asking"] and s["cage_points"] == 4, "the recovered scene")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "the saved scene")
            pose = load(scene)["cage"]["pose"]
            self.assertEqual(pose[0][0][0], 103)
            editor.key("ctrl+q")
            editor.process.wait(timeout=10)
        with Editor([scene], home=home) as editor:
            editor.wait(lambda s: s["pictured"] and not s["asking"], "no offer")

    def test_recovered_work_that_has_no_file_can_be_exported(self):
        home = self.home_of_tests()
        picture = self.plain("leaf.png", (200, 80, 40), (300, 200))
        with Editor([picture], home=home) as editor:
            editor.wait(lambda s: s["pictured"] and not s["busy"], "the picture")
            editor.drag((150, 100), (190, 120))
            editor.wait(lambda s: s["modified"], "an edit")
            editor.pause(0.3)
            editor.process.kill()
            editor.process.wait()
        with Editor([], home=home) as editor:
            editor.wait(lambda s: s["empty"], "the welcome page")
            editor.press_item("Recover")
            editor.wait(lambda s: s["modified"] and s["pictured"] and not s["busy"], "the recovered work")
            self.ask(editor, "ctrl+e")
            self.screenshot(editor, "export-recovered")
            editor.key("Return")
            out = os.path.join(self.work, "leaf-bent.png")
            editor.wait(lambda s: os.path.exists(out) and not s["exporting"] and not s["asking"], "the exported picture")

    def test_no_preferences_end_the_window(self):
        for text in ('{"recent":[""]}', '{"recent":["/a##b","/a##b","' + "x" * 5000 + '","/' + "y" * 3000 + '"]}', "[", '{"keys":{"file.open":["A B C"]}}',
                     '{"recent":["/%s%n%d"],"ui_scale":1e300,"theme":"none"}'):
            home = os.path.join(self.work, "home")
            os.makedirs(os.path.join(home, "config/holomorph"), exist_ok=True)
            with open(os.path.join(home, "config/holomorph/preferences.json"), "w") as file:
                file.write(text)
            with Editor([], home=home) as editor:
                editor.wait(lambda s: s["empty"], "the welcome page")
                editor.key("F10")
                editor.key("Down")
                editor.pause(0.2)
                self.assertIsNone(editor.process.poll(), text)

    def test_an_export_is_cancelled(self):
        fern = os.path.join(SOURCE, "assets/fern.json")
        target = os.path.join(self.work, "film.webp")
        with Editor([fern]) as editor:
            editor.wait(lambda s: s["keys"] > 0, "the fern")
            self.by_palette(editor, "export film")
            editor.wait(lambda s: s["asking"], "the dialog")
            editor.key("ctrl+a")
            editor.type(target)
            editor.key("Return")
            editor.wait(lambda s: s["exporting"], "the export")
            editor.pause(0.5)
            self.screenshot(editor, "exporting")
            editor.key("Escape")
            editor.wait(lambda s: not s["exporting"], "the end of the export")
            editor.pause(1.5)
            self.assertFalse(os.path.exists(target))
            self.assertEqual(os.listdir(self.work), ["gecko.png"], "no unfinished file is left")


if __name__ == "__main__":
    run_tests()
