# The real window, with real input events: draw, drag, pin, undo, save, reopen, recover.
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time

import numpy
from PIL import Image

sys.path.insert(0, os.path.dirname(__file__))
from case import PROGRAM, REAL, SOURCE, Editor, WindowCase, real, real_in_soak, load, old_sample, run_tests  # noqa: E402


class WindowTest(WindowCase):
    @real
    def test_draw_drag_pin_undo_save_reopen(self):
        with Editor([self.picture]) as editor:
            state = editor.wait(lambda s: not s["empty"], "the picture")
            self.assertEqual(state["tool"], "pin")
            editor.key("p")
            for corner in [(20, 20), (1080, 20), (1080, 880), (550, 890), (20, 880)]:
                editor.click(*corner)
            editor.click(20, 20)
            editor.wait(lambda s: s["cage_points"] == 5 and s["tool"] == "select", "the drawn cage")
            before = self.screenshot(editor, "drawn")

            editor.drag((1080, 880), (980, 800))
            editor.wait(lambda s: s["step"] == 2 and s["modified"], "the dragged vertex")
            after = self.screenshot(editor, "dragged")
            self.assertGreater(numpy.abs(after - before).max(axis=2).__gt__(40).sum(), 2000, "the picture follows")

            editor.key("n")
            editor.wait(lambda s: s["tool"] == "pin", "the pin tool")
            editor.drag((600, 410), (560, 450))
            editor.wait(lambda s: s["pins"] == 1 and s["method"] == "pins" and s["step"] == 3, "a dragged pin")
            editor.click(300, 300)
            editor.wait(lambda s: s["pins"] == 2, "another pin")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["pins"] == 1, "undo")
            editor.key("ctrl+shift+z")
            editor.wait(lambda s: s["pins"] == 2, "redo")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["pins"] == 1, "undo again")

            path = os.path.join(self.work, "scene.json")
            self.save_as(editor, path)
            scene = load(path)
            self.assertEqual(scene["format"], "holomorph")
            self.assertEqual(scene["image"]["file"], "gecko.png")
            self.assertEqual(len(scene["cage"]["rest"]), 5)
            # Positions match the pointer to the pixel.
            grain = 1.5 / editor.state()["zoom"]
            moved = scene["cage"]["pose"][2][0]
            self.assertLess(abs(moved[0] - 980) + abs(moved[1] - 800), 4 * grain)
            self.assertLess(abs(scene["cage"]["rest"][2][0][0] - 1080), 2 * grain)
            pin = scene["pins"][0]
            self.assertLess(abs(pin["pose"][0] - 560) + abs(pin["pose"][1] - 450), 4 * grain)
            self.assertEqual(scene["method"]["id"], "pins")

        with Editor([path]) as editor:
            state = editor.wait(lambda s: s["cage_points"] == 5, "the reopened scene")
            self.assertFalse(state["modified"])
            self.assertEqual(state["pins"], 1)

    def test_cage_from_picture_and_editing(self):
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: not s["empty"], "the picture")
            # The first suggested action, run by its name from the palette.
            self.ask(editor, "ctrl+shift+p")
            editor.type("make from")
            editor.key("Return")
            editor.wait(lambda s: 60 <= s["cage_points"] <= 110, "a cage around the gecko")
            points = editor.state()["cage_points"]

            editor.key("ctrl+a")
            editor.wait(lambda s: s["selected"] == points, "all selected")
            editor.key("Right")
            editor.wait(lambda s: s["step"] == 2, "a nudge")
            editor.key("ctrl+d")
            editor.wait(lambda s: s["selected"] == 0, "none selected")
            state = editor.state()
            editor.xdotool("mousemove", int(state["left"] + 4), int(state["top"] + 4))
            editor.xdotool("mousedown", 1)
            editor.xdotool("mousemove", editor.pixel(550, 0)[0], int(state["top"] + state["height"] - 6))
            editor.xdotool("mouseup", 1)
            state = editor.wait(lambda s: s["selected"] > 3, "a box selection")
            self.assertLess(state["selected"], points)

            editor.key("Tab")
            editor.wait(lambda s: s["posture"] == "rest", "the rest")
            editor.key("Tab")
            editor.wait(lambda s: s["posture"] == "pose", "the pose")
            editor.key("Delete")
            editor.wait(lambda s: s["cage_points"] < points, "deleted points")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["cage_points"] == points, "undone")
            editor.key("ctrl+d")
            editor.key("r")
            editor.wait(lambda s: s["step"] == 3, "a reset")
            for key, view in [("2", "angle"), ("3", "area"), ("4", "stretch"), ("5", "checker"), ("1", "image")]:
                editor.key(key)
                editor.wait(lambda s, v=view: s["view"] == v, view)
                self.screenshot(editor, "view-" + view)

    def test_structure_edits_keep_the_pose(self):
        scene = old_sample("giraffe")
        with Editor([scene]) as editor:
            before = load(scene)
            editor.wait(lambda s: s["cage_points"] == len(before["cage"]["rest"]), "the giraffe")
            # The longest posed edge leaves room between its handles.
            pose = [segment[0] for segment in before["cage"]["pose"]]
            edge = max(range(len(pose) - 1), key=lambda i: abs(complex(*pose[i]) - complex(*pose[i + 1])))
            a, b = pose[edge], pose[edge + 1]
            middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
            editor.move(*middle)
            editor.xdotool("click", "--repeat", 2, "--delay", 60, 1)
            editor.wait(lambda s: s["cage_points"] == len(before["cage"]["rest"]) + 1, "an inserted point")
            path = os.path.join(self.work, "scene.json")
            self.save_as(editor, path)
            after = load(path)["cage"]
            for shape in ("pose", "rest"):
                self.assertEqual(after[shape][:edge + 1] + after[shape][edge + 2:], before["cage"][shape])
            self.assertEqual(load(path)["image"]["sha256"], before["image"]["sha256"])

            editor.key("Tab")
            editor.wait(lambda s: s["posture"] == "rest", "the rest")
            x, y = after["rest"][5][0]
            editor.drag((x, y), (x + 6, y + 6))
            editor.wait(lambda s: s["modified"], "a moved rest point")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "saved")
            again = load(path)["cage"]
            self.assertEqual(again["pose"], after["pose"])
            self.assertNotEqual(again["rest"][5], after["rest"][5])

    def test_a_crossing_rest_cage_is_refused(self):
        scene = os.path.join(self.work, "square.json")
        with open(scene, "w") as file:
            json.dump({"format": "holomorph", "version": 1, "image": {"file": "gecko.png"},
                       "cage": {"rest": [[[0, 0]], [[1100, 0]], [[1100, 900]], [[0, 900]]]}}, file)
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the square")
            editor.key("Tab")
            editor.wait(lambda s: s["posture"] == "rest", "the rest")
            editor.drag((1100, 900), (-120, 300))
            editor.wait(lambda s: s["selected"] == 1, "the grabbed corner")
            state = editor.wait(lambda s: not s["gesture"], "the end of the drag")
            self.assertEqual(state["step"], 0)
            self.assertFalse(state["error"])
            self.screenshot(editor, "crossing-refused")

    @real
    def test_kill_loses_nothing_and_is_recovered(self):
        home = tempfile.mkdtemp(prefix="holomorph-home-")
        scene = old_sample("gecko")
        with Editor([scene], home=home) as editor:
            state = editor.wait(lambda s: s["cage_points"] > 0, "the gecko")
            x, y = load(scene)["cage"]["pose"][3][0]
            editor.drag((x, y), (x + 40, y + 30))
            editor.wait(lambda s: s["modified"], "an edit")
            editor.pause(0.3)
            editor.process.kill()
            editor.process.wait()
        folder = home + "/state/holomorph/autosave"
        saved = [name for name in os.listdir(folder) if name.endswith(".json")]
        self.assertEqual(len(saved), 1)
        kept = load(os.path.join(folder, saved[0]))
        self.assertNotEqual(kept["cage"]["pose"][3], load(scene)["cage"]["pose"][3])
        self.assertEqual(kept["cage"]["pose"][4], load(scene)["cage"]["pose"][4])
        with Editor([], home=home) as editor:
            editor.wait(lambda s: s["empty"], "the welcome page")
            self.screenshot(editor, "welcome-recovery")
            editor.press_item("Recover")
            editor.wait(lambda s: s["cage_points"] == state["cage_points"] and s["modified"], "the recovered gecko")
            path = os.path.join(self.work, "recovered.json")
            self.save_as(editor, path)
            self.assertEqual(load(path)["cage"]["pose"], kept["cage"]["pose"])
            self.assertEqual(os.listdir(folder), [], "no autosave is left")
        shutil.rmtree(home)

    def test_samples_are_copies(self):
        giraffe = load(os.path.join(SOURCE, "assets/giraffe.json"))
        with Editor([]) as editor:
            state = editor.wait(lambda s: s["empty"], "the welcome page")
            scenes = [name for name in os.listdir(os.path.join(SOURCE, "assets")) if name.endswith(".json")]
            titles = [name[:-5].capitalize() for name in scenes]
            self.assertEqual(len(titles), 9)
            self.assertLessEqual(set(titles), set(state["items"]))
            editor.press_item("Giraffe")
            editor.wait(lambda s: s["cage_points"] == len(giraffe["cage"]["rest"]), "the giraffe")
            editor.key("ctrl+a")
            editor.key("Up")
            editor.wait(lambda s: s["modified"], "an edit")
            editor.key("ctrl+s")  # asks for a name
            editor.pause(0.5)
            path = os.path.join(self.work, "mine.json")
            editor.key("ctrl+a")
            editor.type(path)
            editor.key("Return")
            editor.wait(lambda s: not s["modified"], "saved")
            self.assertEqual(load(os.path.join(SOURCE, "assets/giraffe.json")), giraffe)
            self.assertTrue(os.path.samefile(os.path.join(self.work, load(path)["image"]["file"]),
                                             os.path.join(SOURCE, "assets/giraffe.png")))

    def test_recent_files_and_new(self):
        with Editor([os.path.join(SOURCE, "assets/giraffe.json")]) as editor:
            giraffe = load(os.path.join(SOURCE, "assets/giraffe.json"))
            editor.wait(lambda s: s["cage_points"] == len(giraffe["cage"]["rest"]), "the giraffe")
            editor.key("ctrl+n")
            editor.wait(lambda s: s["empty"], "the welcome page again")
            self.screenshot(editor, "welcome-recent")
            editor.press_item("giraffe")
            editor.wait(lambda s: s["cage_points"] == len(giraffe["cage"]["rest"]), "the giraffe again")

    def test_export_asks_before_it_replaces(self):
        target = os.path.join(self.work, "out.png")
        with open(target, "w") as file:
            file.write("precious")
        with Editor([old_sample("giraffe")]) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the giraffe")
            self.ask(editor, "ctrl+e")
            editor.key("ctrl+a")
            editor.type(target)
            editor.key("Return")
            editor.pause(1.0)
            with open(target) as file:
                self.assertEqual(file.read(), "precious")
            self.screenshot(editor, "export-replace")
            editor.key("Return")
            end = time.time() + 20
            while os.path.getsize(target) < 100 and time.time() < end:
                editor.pause(0.05)
            subprocess.run([PROGRAM, "render", old_sample("giraffe"), "--out",
                            os.path.join(self.work, "render.png")], check=True, stdout=subprocess.DEVNULL)
            exported = numpy.asarray(Image.open(target))
            rendered = numpy.asarray(Image.open(os.path.join(self.work, "render.png")))
            self.assertEqual(exported.shape, rendered.shape)
            self.assertTrue((exported == rendered).all())
            editor.wait(lambda s: not s["exporting"], "the end of the export")
            os.remove(target)
            editor.key("ctrl+shift+e")  # again, without a question
            end = time.time() + 10
            while not os.path.exists(target) and time.time() < end:
                editor.pause(0.05)
            self.assertTrue(os.path.exists(target))

    def test_a_pin_that_would_fold_the_picture_is_held_back(self):
        path = shutil.copy(old_sample("octopus"), self.work)
        shutil.copy(os.path.join(SOURCE, "assets/octopus.png"), self.work)
        with Editor([path]) as editor:
            editor.wait(lambda s: s["cage_points"] == 48, "the octopus")
            pin = load(path)["pins"][4]["pose"]
            editor.drag(tuple(pin), (330, 620), steps=12)  # an arm through the body
            editor.wait(lambda s: s["step"] == 1, "a dragged pin")
            self.screenshot(editor, "bounded")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "saved")
        moved = load(path)["pins"][4]["pose"]
        self.assertGreater(abs(complex(*moved) - complex(*pin)), 200)

        def info(scene):
            return json.loads(subprocess.run([PROGRAM, "info", scene, "--json"], check=True,
                                             capture_output=True, text=True).stdout)
        report = info(path)
        self.assertTrue(report["certified"])
        self.assertEqual(report["flipped_triangles"], 0)
        self.assertLessEqual(report["max_k"], 0.7)
        self.assertGreaterEqual(report["min_sigma"], 0.2)
        self.assertLessEqual(report["max_sigma"], 5)
        # Without the bounds, the same pins fold the picture, so the test is not trivial.
        scene = load(path)
        scene["method"] = {"id": "pins"}
        with open(os.path.join(self.work, "free.json"), "w") as file:
            json.dump(scene, file)
        self.assertFalse(info(os.path.join(self.work, "free.json"))["locally_injective"])

    def test_a_dropped_path_is_the_cage_and_then_the_outline(self):
        paths = {}
        for name, d in (("cage", "M100 100 H900 V700 H100 Z"), ("outline", "M200 150 H850 L700 750 H250 Z")):
            paths[name] = os.path.join(self.work, name + ".svg")
            with open(paths[name], "w") as file:
                file.write(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{d}"/></svg>')
        mask = os.path.join(SOURCE, "assets/mask.obj")
        with Editor([self.picture]) as editor:
            editor.drop(mask, 400, 400)  # a surface needs a cage, and a message says so
            editor.pause(0.5)
            self.screenshot(editor, "surface-without-cage")
            self.assertEqual((editor.state()["cage_points"], editor.state()["outline_points"]), (0, 0))
            editor.drop(paths["cage"], 400, 400)
            editor.press_item("Use as the cage")
            editor.wait(lambda s: s["cage_points"] == 4 and s["history"] == 2, "the cage")
            editor.drop(paths["outline"], 400, 400)
            editor.press_item("Use as the outline")
            editor.wait(lambda s: s["outline_points"] == 4 and s["method"] == "outline", "the outline")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["outline_points"] == 0 and s["cage_points"] == 4, "the cage alone")

    def test_a_fold_is_shown_and_removed(self):
        scene = os.path.join(self.work, "folded.json")
        subprocess.run([PROGRAM, "new", self.picture, "--out", scene, "--vertices", "12"], check=True, capture_output=True)
        values = load(scene)
        pose = values["cage"]["pose"]
        pose[1], pose[7] = pose[7], pose[1]
        with open(scene, "w") as file:
            json.dump(values, file)
        with Editor([scene]) as editor:
            s = editor.wait(lambda s: s["folds"], "the fold")
            self.screenshot(editor, "folded")
            editor.press_item("fold state")
            editor.wait(lambda t: abs(t["center"][0] - s["center"][0]) + abs(t["center"][1] - s["center"][1]) > 20,
                        "the view at the fold")
            self.screenshot(editor, "folded-shown")
            editor.key("ctrl+shift+p")
            editor.type("prevent folds")
            editor.key("Return")
            editor.wait(lambda s: s["method"] == "bounded" and not s["folds"] and s["status"] == "certified",
                        "a map without folds", 30)

    def compare_methods(self, editor, rows):
        editor.wait(lambda s: s["status"] == "certified", "a map")
        editor.key("ctrl+shift+p")
        editor.type("compare meth")
        editor.key("Return")
        editor.wait(lambda s: s["compared_rows"] == rows, "all rows", 120)

    def test_projections_of_other_methods_are_compared(self):
        shutil.copy(old_sample("octopus"), self.work)
        shutil.copy(os.path.join(SOURCE, "assets/octopus.png"), self.work)
        with Editor([os.path.join(self.work, "octopus.json")]) as editor:
            self.compare_methods(editor, rows=6)
            self.assertAlmostEqual(editor.state()["boundary_turns"], 1, places=2)
            self.screenshot(editor, "compared")

    def test_methods_with_pins_are_compared(self):
        with Editor([old_sample("harmonic-octopus")]) as editor:
            self.compare_methods(editor, rows=5)
            self.screenshot(editor, "compared-pins")

    def draw_square_cage(self, editor):
        editor.wait(lambda s: not s["empty"], "the picture")
        editor.key("p")
        for x, y in ((50, 50), (750, 50), (750, 750), (50, 750)):
            editor.click(x, y)
        editor.key("Return")
        editor.wait(lambda s: s["cage_points"] == 4 and not s["busy"], "a cage")

    def test_the_picture_follows_a_drawn_outline(self):
        with Editor([self.picture]) as editor:
            self.draw_square_cage(editor)
            editor.key("u")
            around = [(400 + 330 * math.cos(t / 24 * 2 * math.pi), 400 + 220 * math.sin(t / 24 * 2 * math.pi))
                      for t in range(24)]
            editor.draw(around)
            editor.wait(lambda s: s["outline_points"] > 24 and s["method"] == "outline", "an outline")
            editor.wait(lambda s: s["playing"] and s["iterations"] > 2, "the animation")
            editor.wait(lambda s: not s["playing"] and s["iteration"] == s["iterations"] - 1, "its end")
            self.screenshot(editor, "outline")
            for text, iteration in (("first iteration", 0), ("next iteration", 1)):
                editor.key("ctrl+shift+p")
                editor.type(text)
                editor.key("Return")
                editor.wait(lambda s: s["iteration"] == iteration, f"iteration {iteration}")
            self.screenshot(editor, "outline-iteration")
            editor.key("ctrl+shift+p")
            editor.type("play iterations")
            editor.key("Return")
            editor.wait(lambda s: s["iteration"] == s["iterations"] - 1, "the end again")
            path = os.path.join(self.work, "outline.json")
            self.save_as(editor, path)
        report = json.loads(subprocess.run([PROGRAM, "info", path, "--json"], check=True,
                                           capture_output=True, text=True).stdout)
        self.assertLessEqual(report["flipped_triangles"], 16)  # specks at the corners
        self.assertIn("met to", report["note"])
        self.assertNotIn("folds", report["note"])

    def pane(self, editor, name):
        """The pixels of the pane that shows the surface in space."""
        s = editor.state()
        left, top = int(s["left"] + s["width"] + 20), int(s["top"] + 50)
        return self.screenshot(editor, name)[top:int(s["top"] + s["height"]) - 20, left:int(s["left"] + 2 * s["width"]) - 20]

    def put_on_mask(self, editor):
        self.draw_square_cage(editor)
        whole = editor.state()["width"]
        editor.drop(os.path.join(SOURCE, "assets/mask.obj"), 400, 400)
        s = editor.wait(lambda s: s["on_surface"] and s["method"] == "outline" and not s["playing"], "the surface")
        self.assertAlmostEqual(s["width"], whole / 2, delta=1)
        return whole

    @real
    def test_a_picture_goes_onto_a_surface(self):
        with Editor([self.picture]) as editor:
            self.put_on_mask(editor)
            s = editor.state()
            middle = [int(s["left"] + 1.5 * s["width"]), int(s["top"] + 0.55 * s["height"])]
            before = self.pane(editor, "surface")
            colorful = (before.max(axis=2) - before.min(axis=2) > 60).mean()
            self.assertGreater(colorful, 0.03, "the gecko is on the mask")
            # Turning and zooming change only the view.
            editor.xdotool("mousemove", *middle)
            editor.xdotool("mousedown", 1)
            for i in range(1, 6):
                editor.xdotool("mousemove", middle[0] + 24 * i, middle[1])
            editor.xdotool("mouseup", 1)
            turned = editor.wait(lambda t: abs(t["yaw"] - s["yaw"]) > 0.2, "another yaw")
            self.assertEqual((turned["history"], turned["center"]), (s["history"], s["center"]))
            editor.xdotool("click", 4)
            editor.wait(lambda t: t["distance"] < 0.95 * s["distance"], "a nearer camera")
            editor.xdotool("click", "--repeat", 2, "--delay", 60, 1)
            editor.wait(lambda t: abs(t["yaw"] - s["yaw"]) < 1e-6 and t["distance"] == s["distance"], "the whole surface again")
            # A pin moves the picture on the surface, even while it is being dragged.
            editor.key("n")
            editor.move(400, 300)
            editor.xdotool("mousedown", 1)
            for i in range(1, 6):
                editor.move(400 + 24 * i, 300)
            end, moved = time.time() + 20, 0
            while moved < 0.01 and time.time() < end:
                moved = (numpy.abs(self.pane(editor, "surface-pin") - before).max(axis=2) > 40).mean()
            self.assertGreater(moved, 0.01)
            self.assertTrue(editor.state()["gesture"])
            editor.xdotool("mouseup", 1)
            editor.wait(lambda s: s["pins"] == 1 and not s["gesture"], "the pin")

    def test_a_surface_is_exported_and_opened_again(self):
        textured, scene = os.path.join(self.work, "on mask.obj"), os.path.join(self.work, "surface.json")

        def action(editor, text, path=None):
            editor.key("ctrl+shift+p")
            editor.type(text)
            editor.key("Return")
            if path:
                editor.pause(0.8)
                editor.key("ctrl+a")
                editor.type(path)
                editor.key("Return")

        with Editor([self.picture]) as editor:
            whole = self.put_on_mask(editor)
            editor.key("n")
            editor.drag((400, 300), (520, 300))
            editor.wait(lambda s: s["pins"] == 1 and not s["gesture"], "the pin")
            action(editor, "textured surface", textured)
            end = time.time() + 20
            while not os.path.exists(textured) and time.time() < end:
                editor.pause(0.1)
            lines = open(textured).read().split("\n")
            uv = numpy.array([[float(x) for x in line.split()[1:]] for line in lines if line.startswith("vt ")])
            self.assertTrue(len(uv) > 1000 and uv.min() > 0 and uv.max() < 1)
            # Closes the surface, shows it again, and saves the scene.
            action(editor, "surface in space")
            editor.wait(lambda s: not s["on_surface"] and s["width"] == whole, "the whole canvas")
            action(editor, "surface in space")
            editor.wait(lambda s: s["on_surface"], "the surface again")
            self.save_as(editor, scene)
            # Opens the exported surface as a picture with a cage and maps it onto the leaf.
            editor.key("ctrl+o")
            editor.pause(0.8)
            editor.key("ctrl+a")
            editor.type(textured)
            editor.key("Return")
            editor.wait(lambda s: s["cage_points"] == 72 and not s["on_surface"], "the exported surface")
            action(editor, "outline from", os.path.join(SOURCE, "assets/leaf.obj"))
            editor.wait(lambda s: s["outline_points"] == 60 and s["on_surface"] and not s["playing"], "the leaf")
            if REAL:
                on_leaf = self.pane(editor, "surface-leaf")
                self.assertGreater((on_leaf.max(axis=2) - on_leaf.min(axis=2) > 60).mean(), 0.02)
            # An edited outline is no longer the surface's boundary; a message says so, and undo restores it.
            editor.key("u")
            outline = load(scene)["outline"]
            self.assertEqual(len(outline), 72)
        with Editor(["--allow-outside", scene]) as editor:
            editor.wait(lambda s: s["on_surface"] and s["pins"] == 1, "the saved surface")
            editor.key("u")
            x, y = outline[10]
            editor.drag((x, y), (x + 60, y + 40))
            editor.wait(lambda s: not s["on_surface"] and s["modified"], "the bent outline")
            if REAL:
                self.screenshot(editor, "surface-bent")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["on_surface"], "the surface again")

    @real
    def test_corners_turn_and_keyframes_become_a_film(self):
        scene = self.caged((320, 120), [[10, 10], [310, 10], [310, 110], [10, 110]])
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the scene")
            editor.key("i")
            state = editor.wait(lambda s: s["keys"] == 1 and s["shows_time"], "a key at rest")
            editor.key("period")
            editor.key("period")
            editor.wait(lambda s: abs(s["time"] - 2 / 24) < 1e-6, "the second frame")
            # The ring turns two corners together.
            editor.key("a")
            editor.wait(lambda s: s["tool"] == "angle", "the tool")
            editor.drag((270, -30), (318, 118))
            editor.wait(lambda s: s["selected"] == 2, "two corners")
            px = editor.pixel(310, 10)
            editor.xdotool("mousemove", px[0] + 28, px[1])
            editor.xdotool("mousedown", 1)
            for degrees in range(10, 91, 10):
                angle = math.radians(degrees)
                editor.xdotool("mousemove", round(px[0] + 60 * math.cos(angle)), round(px[1] - 60 * math.sin(angle)))
            self.screenshot(editor, "corner-ring")
            editor.xdotool("mouseup", 1)
            state = editor.wait(lambda s: s["method"] == "angles" and not s["gesture"], "the turned corners")
            self.assertEqual((state["corners"], state["keys"], state["shows_time"], state["folds"]), (4, 1, False, False))
            editor.key("i")
            editor.wait(lambda s: s["keys"] == 2 and s["shows_time"], "another key")
            bent = self.screenshot(editor, "second-key")
            # Scrubs on the ruler, which is two seconds long and snaps to frames.
            left, top, right, bottom = editor.state()["items"]["ruler"]
            left, top, width = left + 16, top + 8, right - left - 32
            editor.xdotool("mousemove", round(left + width / 2), round(top))
            editor.xdotool("mousedown", 1)
            editor.wait(lambda s: abs(s["time"] - 1) < 0.06 and s["shows_time"], "the time of the pointer")
            editor.xdotool("mousemove", round(left), round(top))
            editor.wait(lambda s: s["time"] == 0, "the first frame")
            editor.xdotool("mouseup", 1)
            rest = self.screenshot(editor, "first-key")
            self.assertGreater((numpy.abs(rest - bent).max(axis=2) > 40).mean(), 0.02)
            # The space bar starts and stops playback.
            editor.key("space")
            editor.wait(lambda s: s["runs"], "the playing film")
            editor.key("space")
            editor.wait(lambda s: not s["runs"], "the stopped film")
            # Exports three frames as files.
            self.ask(editor, "ctrl+shift+p")
            editor.type("film")
            editor.key("Return")
            editor.pause(0.4)
            editor.key("ctrl+a")
            editor.type(os.path.join(self.work, "walk.png"))
            editor.key("Return")
            names = ["walk-000%d.png" % i for i in range(3)]
            editor.wait(lambda s: all(os.path.exists(os.path.join(self.work, n)) for n in names), "three frames", 20)
            self.assertFalse(os.path.exists(os.path.join(self.work, "walk-0003.png")))
            editor.wait(lambda s: not s["exporting"], "the end of the export")
            frames = [Image.open(os.path.join(self.work, n)) for n in names]
            self.assertEqual(len({frame.size for frame in frames}), 1)
            self.save_as(editor, os.path.join(self.work, "walk.json"))
        saved = load(os.path.join(self.work, "walk.json"))
        self.assertEqual(len(saved["keyframes"]), 2)
        turns = [corner["before"] for corner in saved["keyframes"][1]["pose"]["corners"]]
        self.assertEqual([turn > 1 for turn in turns], [False, True, True, False])

    def test_the_box_rotates_and_drags_are_symmetric_or_soft(self):
        scene = self.caged((320, 320), [[60, 60], [160, 60], [260, 60], [260, 260], [60, 260]])

        def pose(editor, name):
            path = os.path.join(self.work, name)
            self.save_as(editor, path)
            return [point[0] for point in load(path)["cage"]["pose"]]

        with Editor([scene]) as editor:
            state = editor.wait(lambda s: s["cage_points"] == 5, "the scene")
            editor.key("ctrl+a")
            editor.wait(lambda s: s["selected"] == 5, "all points")
            margin = 18 / state["zoom"]
            knob = (160, 260 + margin + 26 / state["zoom"])
            middle, reach = (160, 160), knob[1] - 160
            editor.move(*knob)
            editor.xdotool("mousedown", 1)
            for degrees in range(10, 91, 10):
                angle = math.radians(90 - degrees)
                editor.move(middle[0] + reach * math.cos(angle), middle[1] + reach * math.sin(angle))
            self.screenshot(editor, "turned-box")
            editor.xdotool("mouseup", 1)
            editor.wait(lambda s: s["step"] == 1 and not s["gesture"], "turned points")
            turned = pose(editor, "turned.json")
            for (x, y), expected in zip(turned, [[60, 260], [60, 160], [60, 60], [260, 60], [260, 260]]):
                self.assertAlmostEqual(x, expected[0], delta=2)
                self.assertAlmostEqual(y, expected[1], delta=2)
            editor.key("ctrl+z")
            # With Shift, it turns in steps of 15 degrees: a drag by 50 degrees turns by 45.
            editor.wait(lambda s: s["step"] == 0, "the square")
            editor.xdotool("keydown", "Shift_L")
            angle = math.radians(90 - 50)
            editor.drag(knob, (middle[0] + reach * math.cos(angle), middle[1] + reach * math.sin(angle)))
            editor.xdotool("keyup", "Shift_L")
            editor.wait(lambda s: s["step"] == 1 and not s["gesture"], "turned points")
            edge = pose(editor, "stepped.json")
            turn = math.degrees(math.atan2(edge[1][1] - edge[0][1], edge[1][0] - edge[0][0]))
            self.assertAlmostEqual(turn, -45, places=6)
            editor.key("ctrl+z")
            editor.key("ctrl+d")
            # With symmetry, the other side moves as a mirror image.
            editor.key("x")
            editor.drag((260, 60), (280, 30))
            editor.wait(lambda s: s["step"] == 1, "a symmetric drag")
            symmetric = pose(editor, "symmetric.json")
            self.assertAlmostEqual(symmetric[0][0] + symmetric[2][0], 320, delta=1e-6)
            self.assertEqual(symmetric[0][1], symmetric[2][1])
            self.assertLess(symmetric[0][0], 45)
            editor.key("ctrl+z")
            editor.key("x")
            # With soft selection, nearby points follow.
            editor.key("o")
            editor.key("bracketright")
            editor.key("ctrl+d")
            editor.drag((260, 60), (260, 30))
            editor.wait(lambda s: s["step"] == 1, "a soft drag")
            self.screenshot(editor, "soft")
            soft = pose(editor, "soft.json")
            self.assertTrue(31 < soft[1][1] < 59.5, soft)
            self.assertEqual(soft[0][1], 60)

    @real_in_soak
    def test_motion_is_recorded_and_its_keyframes_are_shown_by_the_onion_skin(self):
        scene = self.caged((320, 120), [[10, 10], [310, 10], [310, 110], [10, 110]])
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 4, "the scene")
            # A corner moves up and back while Ctrl is held, which records the motion in real time.
            editor.move(310, 110)
            editor.xdotool("keydown", "ctrl")
            editor.xdotool("mousedown", 1)
            for y in (130, 150, 170, 190, 210):
                editor.move(330, y)
            editor.pause(0.3)  # nothing moves, but time passes
            self.screenshot(editor, "recording")
            for y in (180, 150, 130):
                editor.move(310, y)
            editor.xdotool("mouseup", 1)
            editor.xdotool("keyup", "ctrl")
            state = editor.wait(lambda s: s["keys"] >= 3 and s["shows_time"], "keys")
            self.assertGreater(state["time"], 1.2)
            self.assertEqual(state["history"], 2)  # a single undo step
            self.assertLess(state["keys"], 20)
            # Escape discards a recording while Ctrl is still held.
            editor.move(10, 110)
            editor.xdotool("keydown", "ctrl")
            editor.xdotool("mousedown", 1)
            editor.move(-20, 140)
            editor.move(-40, 140)
            editor.xdotool("key", "Escape")
            editor.wait(lambda s: not s["gesture"], "the discarded recording")
            editor.xdotool("mouseup", 1)
            editor.xdotool("keyup", "ctrl")
            self.assertEqual(editor.state()["history"], 2)
            # Between two keyframes, onion skins show the keyframes before and after.
            for _ in range(5):
                editor.key("comma")
            editor.pause(0.4)
            plain = self.screenshot(editor, "no-onion")
            self.ask(editor, "ctrl+shift+p")
            editor.type("onion")
            editor.key("Return")
            editor.pause(0.5)
            onion = self.screenshot(editor, "onion")
            left, top, width, height = (int(state[k]) for k in ("left", "top", "width", "height"))
            view = numpy.s_[top:top + height, left:left + width]
            self.assertGreater((numpy.abs(onion - plain)[view].max(axis=2) > 30).mean(), 0.003)
            # Asks before it replaces existing frames.
            path = os.path.join(self.work, "clip.png")
            first = os.path.join(self.work, "clip-0000.png")
            with open(first, "w") as file:
                file.write("mine")
            self.ask(editor, "ctrl+shift+p")
            editor.type("film")
            editor.key("Return")
            editor.pause(0.4)
            editor.key("ctrl+a")
            editor.type(path)
            editor.key("Return")
            editor.pause(0.5)
            with open(first) as file:
                self.assertEqual(file.read(), "mine")
            editor.key("Return")  # Replace
            end = time.time() + 20
            while os.path.getsize(first) < 100 and time.time() < end:
                editor.pause(0.1)
            self.assertEqual(Image.open(first).format, "PNG")
            editor.wait(lambda s: not s["exporting"], "the end of the export")
            editor.key("ctrl+z")
            editor.wait(lambda s: s["keys"] == 0, "no keys after one undo")

    def test_a_stroke_is_drawn_and_its_pose_dragged(self):
        with Editor([self.picture]) as editor:
            self.draw_square_cage(editor)
            editor.key("s")
            editor.wait(lambda s: s["tool"] == "stroke", "the tool")
            editor.draw([(150 + 20 * i, 400) for i in range(26)])
            editor.wait(lambda s: s["strokes"] == 1 and s["method"] == "strokes" and not s["busy"], "a stroke")
            grain = 1.5 / editor.state()["zoom"]  # rounding to pixels of the window
            editor.drag((400, 400), (400, 500))
            editor.drag((650, 500), (640, 620))
            editor.pause(0.5)
            self.screenshot(editor, "strokes")
            path = os.path.join(self.work, "strokes.json")
            self.save_as(editor, path)
        with open(path) as file:
            stroke = json.load(file)["strokes"][0]
        self.assertAlmostEqual(stroke["pose"][0][1] - stroke["rest"][0][1], 100, delta=grain)
        self.assertAlmostEqual(stroke["pose"][-1][1] - stroke["rest"][-1][1], 220, delta=1.5 * grain)
        report = json.loads(subprocess.run([PROGRAM, "info", path, "--json"], check=True,
                                           capture_output=True, text=True).stdout)
        self.assertEqual(report["flipped_triangles"], 0)

    def test_curves_are_bent_broken_and_cut(self):
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: not s["empty"], "the picture")
            editor.key("p")
            for a, b in [((1060, 300), (1060, 450)), ((800, 800), (650, 830)), ((200, 780), (80, 700)),
                         ((60, 60), (120, 20)), ((560, 70), (800, 30))]:
                editor.drag(a, b)
            editor.key("Return")
            editor.wait(lambda s: s["cage_points"] == 5, "a curved cage")
            path = os.path.join(self.work, "curves.json")
            self.save_as(editor, path)
            first = load(path)["cage"]
            self.assertEqual([len(segment) for segment in first["rest"]], [3] * 5)

            def tangents(cage, vertex):  # before the vertex, after it, and the vertex
                pose = cage["pose"] if "pose" in cage else cage["rest"]
                return complex(*pose[vertex - 1][-1]), complex(*pose[vertex][1]), complex(*pose[vertex][0])

            def bent(cage, vertex):  # how far the two tangents are from collinear
                before, after, at = tangents(cage, vertex)
                u, v = before - at, after - at
                return abs((u.conjugate() * v).imag) / (abs(u) * abs(v))

            after = tangents(first, 2)[1]
            editor.drag((after.real, after.imag), (after.real - 40, after.imag + 60))
            editor.wait(lambda s: s["step"] == 2, "a dragged tangent")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "saved")
            second = load(path)["cage"]
            self.assertLess(bent(second, 2), 1e-3, "the opposite tangent turns, too")
            self.assertGreater(abs(tangents(second, 2)[0] - tangents(first, 2)[0]), 5)
            self.assertEqual(second["rest"], first["rest"])

            after = tangents(second, 2)[1]
            editor.xdotool("keydown", "alt")
            editor.drag((after.real, after.imag), (after.real + 30, after.imag - 90))
            editor.xdotool("keyup", "alt")
            editor.wait(lambda s: s["step"] == 3, "a broken tangent")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "saved")
            third = load(path)["cage"]
            self.assertGreater(bent(third, 2), 0.05)
            self.assertEqual(tangents(third, 2)[0], tangents(second, 2)[0])
            self.screenshot(editor, "curves")

            start, a, b, end = (complex(*p) for p in third["pose"][0] + [third["pose"][1][0]])
            middle = (start + 3 * a + 3 * b + end) / 8
            editor.move(middle.real, middle.imag)
            editor.xdotool("click", "--repeat", 2, "--delay", 60, 1)
            editor.wait(lambda s: s["cage_points"] == 6, "an inserted point")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "saved")
            fourth = load(path)["cage"]
            self.assertEqual(fourth["pose"][2:], third["pose"][1:])
            self.assertEqual([len(s) for s in fourth["rest"][:2]], [3, 3])

    def test_a_number_in_the_inspector_moves_what_is_selected(self):
        scene = old_sample("giraffe")
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the giraffe")
            x, y = load(scene)["cage"]["pose"][0][0]
            editor.click(x, y)
            editor.wait(lambda s: s["selected"] == 1, "a selected point")
            self.type_into(editor, "x", "321.5")
            editor.wait(lambda s: s["step"] == 1 and s["modified"], "the typed position")
            path = os.path.join(self.work, "typed.json")
            self.save_as(editor, path)
            self.assertEqual(load(path)["cage"]["pose"][0][0], [321.5, y])

    def test_unsaved_changes_are_asked_about(self):
        scene = old_sample("giraffe")
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the giraffe")
            editor.key("ctrl+a")
            editor.key("Up")
            editor.wait(lambda s: s["modified"], "an edit")
            editor.key("ctrl+q")
            editor.pause(0.5)
            self.screenshot(editor, "unsaved")
            self.assertIsNone(editor.process.poll())
            editor.key("Escape")
            editor.pause(0.3)
            editor.key("ctrl+z")
            editor.wait(lambda s: not s["modified"], "the undone edit")
            editor.key("ctrl+q")
            editor.process.wait(timeout=10)
            self.assertEqual(editor.process.returncode, 0, editor.messages())

    def test_a_dropped_picture_opens_and_asks_about_unsaved_work(self):
        with Editor([]) as editor:
            editor.wait(lambda s: s["empty"], "the welcome page")
            editor.drop(old_sample("giraffe"), 500, 300)
            editor.wait(lambda s: s["cage_points"] > 0, "the dropped scene")
            editor.key("ctrl+a")
            editor.key("Up")
            editor.wait(lambda s: s["modified"], "an edit")
            path = os.path.join(self.work, "kept.json")
            self.save_as(editor, path)
            editor.key("Up")
            editor.wait(lambda s: s["modified"], "another edit")
            editor.drop(self.picture, 500, 300)
            editor.pause(0.5)
            self.screenshot(editor, "drop-question")
            editor.press_item("Open as a new scene")
            editor.pause(0.5)
            self.screenshot(editor, "drop-unsaved")
            self.assertGreater(editor.state()["cage_points"], 0, "nothing is lost before the answer")
            editor.key("Return")  # Save
            editor.wait(lambda s: s["cage_points"] == 0 and not s["empty"], "the dropped picture")
            before = load(old_sample("giraffe"))["cage"]["pose"]
            after = load(path)["cage"]["pose"]
            self.assertEqual(round(after[0][0][1] - before[0][0][1]), 2, "both edits were saved")

    @real
    def test_a_large_picture_fits_into_memory(self):
        noise = numpy.random.default_rng(1).integers(0, 255, (2000, 2000, 4), dtype=numpy.uint8)
        Image.fromarray(noise).save(os.path.join(self.work, "noise.png"))
        turn = numpy.exp(2j * numpy.pi * numpy.arange(32) / 32) * 780 + 1000 + 1000j
        scene = os.path.join(self.work, "noise.json")
        with open(scene, "w") as file:
            json.dump({"format": "holomorph", "version": 1, "image": {"file": "noise.png"},
                       "cage": {"rest": [[[z.real, z.imag]] for z in turn]}}, file)
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] == 32, "the scene")
            editor.drag((1780, 1000), (1900, 1100))
            editor.wait(lambda s: s["modified"], "a drag")
            with open(f"/proc/{editor.process.pid}/status") as file:
                memory = {line.split()[0]: int(line.split()[1]) for line in file if line.split()[-1] == "kB"}
            # Without the code of libraries: a third of it is the software driver, which grows with each version of Mesa.
            most = memory["VmHWM:"] - memory["RssFile:"]
            print(f"{most // 1024} MB at most", file=sys.stderr)
            self.assertLess(most, 214 * 1024)

    @real
    def test_idle_sleeps(self):
        scene = old_sample("giraffe")
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["cage_points"] > 0, "the giraffe")

            def ticks():
                with open(f"/proc/{editor.process.pid}/stat") as file:
                    fields = file.read().rsplit(")", 1)[1].split()
                return int(fields[11]) + int(fields[12])

            def used(seconds):
                start = ticks()
                editor.pause(seconds)
                return (ticks() - start) / os.sysconf("SC_CLK_TCK") / seconds

            end = time.time() + 40
            while used(1) >= 0.02 and time.time() < end:
                pass  # slow machines still finish the last frames
            self.assertLess(used(3), 0.02, "idle costs under 2 % of a core")

    def test_without_a_display_the_program_says_so(self):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        result = subprocess.run([PROGRAM], env=environment, capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn("no display", result.stderr)


if __name__ == "__main__":
    run_tests()
