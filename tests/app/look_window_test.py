# Tests of how the real window looks and answers: alarms, themes, menus, file dialogs, exports.
import json
import os
import shutil
import subprocess
import sys
from random import Random

import numpy
from PIL import Image

sys.path.insert(0, os.path.dirname(__file__))
from case import PROGRAM, SOURCE, Editor, WindowCase, few_or_many, real, real_in_soak, load, run_tests, seed_of  # noqa: E402

SQUARE = [[60, 60], [340, 60], [340, 240], [60, 240]]


def share(image, color, tolerance=4):
    """The share of pixels that have a color, written as in the table of the look."""
    wanted = numpy.array([int(color[k:k + 2], 16) for k in (0, 2, 4)])
    return (numpy.abs(image - wanted).max(axis=2) <= tolerance).mean()


class LookWindowTest(WindowCase):
    def canvas(self, editor, name):
        state = editor.state()
        image = self.screenshot(editor, name)
        left, top, width, height = (int(state[key]) for key in ("left", "top", "width", "height"))
        return image[top:top + height, left:left + width]

    def state_text(self, editor, name):
        """The part of the status bar that tells about folds."""
        left, top, right, bottom = (int(value) for value in editor.state()["items"]["fold state"])
        return self.screenshot(editor, name)[top:bottom, left:right]

    def scene_with(self, picture, **values):
        picture.save(os.path.join(self.work, "picture.png"))
        path = os.path.join(self.work, "scene.json")
        with open(path, "w") as file:
            json.dump({"format": "holomorph", "version": 1, "image": {"file": "picture.png"}, **values}, file)
        return path

    def folded(self, opaque):
        """A scene that is folded in its left half. The picture is opaque there, or only on the right."""
        picture = Image.new("RGBA", (400, 300), (0, 0, 0, 0))
        picture.paste((40, 120, 200, 255), (0, 0, 400, 300) if opaque else (300, 0, 400, 300))
        rest = [[[x, y]] for x, y in [(60, 60), (200, 60), (340, 60), (340, 240), (200, 240), (60, 240)]]
        pose = [list(p) for p in rest]
        pose[0], pose[5] = rest[5], rest[0]
        return self.scene_with(picture, cage={"rest": rest, "pose": pose}, method={"id": "mean_value"})

    @real_in_soak
    def test_only_folds_that_can_be_seen_are_alarms(self):
        with Editor([self.folded(True)]) as editor:
            editor.wait(lambda s: s["folds"], "the visible fold")
            self.assertGreater(share(self.state_text(editor, "visible-fold"), "FF8A80", 30), 0.01, "red in the status bar")
        with Editor([self.folded(False)]) as editor:
            editor.wait(lambda s: s["pictured"], "the picture")
            editor.pause(1)
            self.assertFalse(editor.state()["folds"])
            self.assertEqual(share(self.state_text(editor, "invisible-fold"), "FF8A80", 30), 0)

    def bent(self, random):
        """A random pose of a sample, in a random method, without the picture: info counts folds as if it were opaque."""
        name = random.choice(["gecko", "octopus", "giraffe"])
        scene = load(os.path.join(SOURCE, "assets", name + ".json"))
        scene.pop("image")
        scene["method"] = {"id": random.choice(["sheet", "puppet", "bounded", "arap", "pins", "har_arap"])}
        scene.pop("keyframes", None)
        reach = random.choice([20, 80, 300])
        for pin in scene["pins"]:
            pin["pose"] = [value + random.uniform(-reach, reach) for value in pin["rest"]]
        path = os.path.join(self.work, "bent.json")
        with open(path, "w") as file:
            json.dump(scene, file)
        return path

    def wound(self):
        """A map of Angles that the mesh is too coarse for."""
        turns = [(1.47, 3.41, 0), (1.93, 0.33, 1), (-0.83, -7.03, 1), (6.86, -2.66, 1),
                 (0.58, -1.7, 1), (-2.06, -1.87, 0), (-1.53, 0.54, 0), (-0.29, -6.78, 1)]
        rest = [[[x, y]] for x, y in [(473, 318), (417, 419), (295, 426), (171, 412), (133, 265), (227, 199), (321, 132), (442, 172)]]
        corners = [{"vertex": i, "before": a, "after": b, "tension": c} for i, (a, b, c) in enumerate(turns)]
        return self.scene_with(Image.new("RGBA", (500, 450), (40, 120, 200, 255)), cage={"rest": rest},
                               method={"id": "angles"}, corners=corners)

    def test_the_window_says_about_folds_what_info_says(self):
        random = Random(seed_of("folds in the window", 3))
        seen = set()
        for make in [lambda: self.folded(True), self.wound, *few_or_many(3, 30) * [lambda: self.bent(random)]]:
            scene = make()
            told = json.loads(subprocess.run([PROGRAM, "info", scene, "--json"], check=True, capture_output=True).stdout)
            with self.subTest(scene=load(scene)), Editor([scene]) as editor:
                editor.wait(lambda s: not s["busy"] and not s["moving"] and s["fold_state"], "the map")
                state = editor.state()
                seen.add(state["fold_state"])
                for key in ("method", "status", "note"):
                    self.assertEqual(state[key], told[key], key)
                self.assertEqual(state["folds"], told["folds_visibly"])
                self.assertEqual(state["fold_state"] == "No folds", not told["folds_visibly"])
                self.assertEqual(state["fold_state"] == "Mesh too coarse", "too coarse" in told["note"])
        self.assertLessEqual({"Mesh too coarse", "No folds"}, seen)
        self.assertTrue(any(text.endswith("olds") and text != "No folds" for text in seen), seen)

    @real
    def test_themes_have_the_colors_of_the_table(self):
        with Editor([os.path.join(SOURCE, "assets", "gecko.json")]) as editor:
            editor.wait(lambda s: s["status"] == "certified", "the map")
            for name, panel, canvas in (("dark", "25262A", "17181B"), ("light", "F6F6F8", "D3D5DA"), ("high contrast", "000000", "000000")):
                self.by_palette(editor, "theme: " + name)
                editor.wait(lambda s: s["theme"] == name.split()[-1] and not s["moving"], "the theme")
                image = self.screenshot(editor, "theme-" + name.split()[-1])
                self.assertGreater(share(image[:, 1100:], panel, 1), 0.3, name)
                self.assertGreater(share(image, canvas, 1), 0.05, name)

    @real_in_soak
    def test_the_cage_hides_behind_a_posed_body_until_the_pointer_comes(self):
        cage, pose = [[p] for p in SQUARE], [[p] for p in [[60, 60], [340, 60], [360, 250], [80, 240]]]
        picture = Image.new("RGBA", (400, 300), (0, 0, 0, 0))
        picture.paste((200, 180, 40, 255), (100, 100, 300, 200))
        path = self.scene_with(picture, cage={"rest": cage, "pose": pose}, method={"id": "cage"})
        with Editor([path]) as editor:
            editor.wait(lambda s: s["status"] == "exact", "the map")
            editor.xdotool("mousemove", 1300, 880)
            editor.pause(0.4)
            away = self.canvas(editor, "cage-at-rest")
            editor.move(340, 62)
            editor.pause(0.4)
            near = self.canvas(editor, "cage-hovered")
            green = lambda image: ((image[:, :, 1] > 190) & (image[:, :, 0] < 90) & (image[:, :, 2] < 200)).sum()  # noqa: E731
            self.assertGreater(green(near), 5 * max(green(away), 20))
            # Transparent pixels show the checkerboard of the theme.
            for color in ("3A3C41", "404247"):
                self.assertGreater(share(away, color, 2), 0.02)

    @real
    def test_the_welcome_page_says_why_a_file_does_not_open(self):
        bad = os.path.join(self.work, "bad.png")
        with open(bad, "w") as file:
            file.write("not a picture")
        with Editor([]) as editor:
            editor.wait(lambda s: s["empty"], "the welcome page")
            before = self.screenshot(editor, "welcome")
            editor.drop(bad, 700, 400)
            editor.pause(1.5)
            after = self.screenshot(editor, "welcome-complains")
            self.assertGreater(share(after, "FF8A80", 30) - share(before, "FF8A80", 30), 2e-5, "a sign in the color of errors")

    def test_menus_are_short_and_begin_with_what_is_used_most(self):
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: s["pictured"], "the picture")
            for menu, first in (("File", ["New", "Open...", "Open recent", "Save"]), ("Edit", ["Undo", "Redo"])):
                editor.press_item("Menu: " + menu)
                editor.pause(0.4)
                self.screenshot(editor, "menu-" + menu)
                names = {name[6:]: box for name, box in editor.state()["items"].items() if name.startswith("Menu: ") and box[1] > 33}
                order = sorted(names, key=lambda name: names[name][1])
                self.assertEqual([name.rstrip(".") for name in order[:len(first)]], [name.rstrip(".") for name in first])
                self.assertLessEqual(len(order), 12)
                editor.key("Escape")

    def test_the_file_dialog_begins_where_the_scene_is(self):
        folder = os.path.join(self.work, "drawings")
        os.makedirs(folder)
        for name in ("b.png", "a.png"):
            shutil.copy(self.picture, os.path.join(folder, name))
        home = os.path.join(self.work, "home")
        os.makedirs(home + "/config/holomorph")
        with open(home + "/config/holomorph/preferences.json", "w") as file:
            json.dump({"hints": False, "native_dialogs": False}, file)
        with Editor([os.path.join(folder, "b.png")], home=home) as editor:
            editor.wait(lambda s: s["pictured"], "the picture")
            self.ask(editor, "ctrl+o")
            editor.pause(0.8)
            self.screenshot(editor, "file-dialog")
            items = editor.state()["items"]
            self.assertIn("File: a.png", items)
            self.assertTrue([name for name in items if name.startswith("Place: ")])
            self.assertLess(items["File: a.png"][1], items["File: b.png"][1])
            editor.press_item("Sort: Name")
            editor.pause(0.4)
            items = editor.state()["items"]
            self.assertGreater(items["File: a.png"][1], items["File: b.png"][1], "sorted the other way")
            editor.key("Escape")

    @real
    def test_a_fitted_view_stays_fitted_when_the_window_grows(self):
        with Editor([self.picture], size="1900x1200") as editor:
            before = editor.wait(lambda s: s["pictured"], "the picture")
            window = subprocess.run(["xdotool", "search", "--pid", str(editor.process.pid), "--name", "Holomorph"],
                                    env=editor.environment, capture_output=True, text=True).stdout.split()[-1]
            editor.xdotool("windowsize", window, 1880, 1180)
            editor.wait(lambda s: s["width"] > before["width"] + 200, "the larger canvas")
            editor.pause(0.5)
            after = editor.state()
            self.assertGreater(after["zoom"], 1.15 * before["zoom"])
            self.screenshot(editor, "grown")

    def test_an_export_takes_the_soft_edge_along_and_crops_to_what_is_filled(self):
        picture = Image.new("RGBA", (400, 300), (0, 0, 0, 0))
        picture.paste((30, 30, 30, 70), (60, 60, 220, 240))
        picture.paste((220, 60, 40, 255), (100, 100, 180, 200))
        x0, y0, x1, y1 = 96, 96, 184, 204
        rest = [[[x0, y0]], [[x1, y0]], [[x1, y1]], [[x0, y1]]]
        pose = [[[x + 150, y]] for [[x, y]] in rest]
        path = self.scene_with(picture, cage={"rest": rest, "pose": pose}, method={"id": "cage"})
        target = os.path.join(self.work, "out.png")
        with Editor([path]) as editor:
            editor.wait(lambda s: s["status"] == "exact", "the map")
            editor.pause(0.5)
            self.screenshot(editor, "soft-edge")
            self.ask(editor, "ctrl+e")
            editor.press_item("Crop to filled area")
            editor.press_item("name")
            editor.key("ctrl+a")
            editor.type(target)
            self.screenshot(editor, "export-cropped")
            editor.key("Return")
            editor.wait(lambda s: os.path.exists(target) and not s["exporting"], "the export")
        image = Image.open(target)
        self.assertEqual(image.size, (160, 180))
        self.assertEqual(image.getpixel((2, 2))[3], 70)

    def test_points_that_are_not_posed_follow_the_rest_shape(self):
        cage = [[p] for p in SQUARE]
        pose = [[[60, 60]], [[340, 60]], [[340, 240]], [[90, 270]]]
        picture = Image.new("RGBA", (400, 300), (90, 160, 90, 255))
        path = self.scene_with(picture, cage={"rest": cage, "pose": pose}, method={"id": "cage"})
        with Editor([path]) as editor:
            editor.wait(lambda s: s["status"] == "exact", "the map")
            editor.key("Tab")
            editor.wait(lambda s: s["posture"] == "rest", "the rest shape")
            editor.drag((340, 60), (320, 90))
            editor.wait(lambda s: s["modified"] and not s["gesture"], "a new rest shape")
            target = os.path.join(self.work, "rest.json")
            self.save_as(editor, target)
            saved = load(target)["cage"]
        self.assertEqual(saved["rest"][1], saved["pose"][1], "it was not posed")
        self.assertLess(abs(saved["rest"][1][0][0] - 320) + abs(saved["rest"][1][0][1] - 90), 4)
        self.assertEqual(saved["pose"][3], [[90, 270]], "the posed point stays")

    def test_rigid_and_smooth_stays_in_one_piece(self):
        scene = load(os.path.join(SOURCE, "assets/gecko.json"))
        shutil.copy(os.path.join(SOURCE, "assets/gecko.png"), self.work)
        scene["image"] = {"file": "gecko.png"}
        scene["method"] = {"id": "har_arap"}
        path = os.path.join(self.work, "rigid.json")
        with open(path, "w") as file:
            json.dump(scene, file)
        with Editor([path]) as editor:
            state = editor.wait(lambda s: s["pictured"] and s["status"] != "none", "the map", 30)
            editor.pause(0.5)
            self.screenshot(editor, "rigid-and-smooth")
            state = editor.state()
            self.assertFalse(state["folds"])
            self.assertEqual(state["zeros"], 0)


if __name__ == "__main__":
    run_tests()
