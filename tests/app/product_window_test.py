# Tests of the first minutes in the real window: few actions to a bent picture, methods that are easy to change, panels
# that stay in place.
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile

import numpy
from PIL import Image

sys.path.insert(0, os.path.dirname(__file__))
from case import PROGRAM, SOURCE, Editor, WindowCase, real, real_in_soak, load, run_tests  # noqa: E402

BODY, LEG, HEAD = (600, 410), (800, 668), (250, 270)  # on the gecko


class ProductWindowTest(WindowCase):
    def saved(self, editor, name):
        path = os.path.join(self.work, name)
        self.save_as(editor, path)
        return load(path)

    def test_four_actions_bend_a_picture(self):
        with Editor([]) as editor:
            editor.wait(lambda s: s["empty"], "the welcome page")
            editor.drop(self.picture, 700, 500)
            editor.wait(lambda s: s["pictured"] and s["tool"] == "pin", "the dropped picture and the pin tool")
            editor.pause(0.5)
            editor.click(*BODY)
            editor.wait(lambda s: s["pins"] == 1 and s["method"] == "sheet", "a pin in a puppet")
            editor.click(*LEG)
            editor.wait(lambda s: s["pins"] == 2, "a second pin")
            editor.drag(HEAD, (250, 330))
            state = editor.wait(lambda s: s["pins"] == 3 and not s["gesture"], "a third pin")
            self.assertFalse(state["folds"])
            self.screenshot(editor, "four-actions")
            pins = self.saved(editor, "bent.json")["pins"]
        for pin, place in zip(pins, (BODY, LEG, HEAD)):
            self.assertLess(abs(pin["rest"][0] - place[0]) + abs(pin["rest"][1] - place[1]), 6, "pins lie where they were pressed")
        self.assertEqual([pin.get("pose", pin["rest"]) == pin["rest"] for pin in pins], [True, True, False])
        self.assertGreater(pins[2]["pose"][1] - pins[2]["rest"][1], 45, "the drag moves the pin that its press has set")

    def painted(self, layers, width=200, height=150):
        """An OpenRaster file of rectangles: name, x, y from the upper left corner, and color, from bottom to top."""
        stack, path = "", os.path.join(self.work, "doll.ora")
        with zipfile.ZipFile(path + ".new", "w") as archive:
            archive.writestr("mimetype", "image/openraster")
            for number, (name, x, y, color) in enumerate(reversed(layers)):
                data = io.BytesIO()
                Image.new("RGBA", (60, 40), color).save(data, "PNG")
                archive.writestr(f"data/layer{number}.png", data.getvalue())
                stack += f'<layer name="{name}" src="data/layer{number}.png" x="{x}" y="{y}"/>'
            archive.writestr("stack.xml", f'<image w="{width}" h="{height}"><stack>{stack}</stack></image>')
        os.replace(path + ".new", path)
        return path

    def test_a_layered_file_that_changes_keeps_its_rig(self):
        """Layers are found again while the scene is open and when it is opened; the window asks where it is not clear."""
        body, arm = ("body", 20, 20, (40, 90, 200, 255)), ("arm", 100, 60, (200, 40, 40, 255))
        scene = os.path.join(self.work, "doll.json")
        with Editor([self.painted([body, arm])]) as editor:
            editor.wait(lambda s: s["layers"] == 2 and s["pictured"], "the layers")
            self.save_as(editor, scene)
            place = {layer["name"]: layer["image"] for layer in load(scene)["layers"]}
            self.assertEqual(place["arm"]["entry"], "data/layer0.png")
            # A new layer on top gives all files other names; the arm moves.
            editor.pause(1)
            self.painted([body, ("arm", 110, 55, (200, 40, 40, 255)), ("hat", 0, 0, (10, 200, 10, 255))])
            editor.wait(lambda s: s["entry"] == "data/layer1.png", "the arm under its new name")
            scene = os.path.join(self.work, "again.json")
            self.save_as(editor, scene)
            found = {layer["name"]: layer for layer in load(scene)["layers"]}
            self.assertEqual(found["arm"]["image"]["entry"], "data/layer1.png")
            self.assertEqual(found["arm"]["placement"]["shift"], [10, 5])
        # The arm is renamed and repainted while the program does not run: which one is it?
        self.painted([body, ("sleeve", 110, 55, (240, 200, 40, 255)), ("hat", 0, 0, (10, 200, 10, 255))])
        with Editor([scene]) as editor:
            editor.wait(lambda s: s["question"] == "Which layer is it?", "the question")
            self.screenshot(editor, "which-layer")
            editor.press_item("Later")
            editor.wait(lambda s: not s["asking"], "no question")
            self.screenshot(editor, "which-layer-later")
            later = os.path.join(self.work, "later.json")
            self.save_as(editor, later)
            refused = subprocess.run([PROGRAM, "render", later, "--out", os.path.join(self.work, "later.png")], capture_output=True, text=True)
            self.assertEqual(refused.returncode, 2, "a saved scene still has the question")
            self.assertIn("the layer 'arm' may now be", refused.stderr)
            scene = later
            editor.press_item("Choose...")
            editor.wait(lambda s: s["question"] == "Which layer is it?", "the question again")
            editor.press_item("layer")
            editor.pause(0.3)
            self.screenshot(editor, "which-layer-list")
            editor.press_item("sleeve")
            editor.pause(0.5)
            self.screenshot(editor, "which-layer-chosen")
            editor.press_item("OK")
            editor.wait(lambda s: not s["asking"] and s["modified"], "the answer")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "the saved scene")
            self.assertEqual([layer["image"]["name"] for layer in load(scene)["layers"]], ["body", "sleeve"])
            self.by_palette(editor, "Add new layers of the file")
            editor.wait(lambda s: s["layers"] == 3 and s["modified"], "the new layer")
            editor.key("ctrl+s")
            editor.wait(lambda s: not s["modified"], "the saved scene")
            self.assertEqual([layer["name"] for layer in load(scene)["layers"]], ["body", "arm", "hat"])

    def test_ctrl_drags_the_radius_of_the_held_disk(self):
        with Editor([os.path.join(SOURCE, "assets", "gecko.json")]) as editor:
            state = editor.wait(lambda s: s["status"] == "certified", "the map")
            place = (600, 415)  # the pin with a rotation
            ring = 34 * state["scale"] / state["zoom"]
            editor.click(*place)
            editor.wait(lambda s: s["selected"] == 1, "a selected pin")
            self.screenshot(editor, "held-disk")
            editor.xdotool("keydown", "ctrl")
            editor.drag((place[0] + ring, place[1]), (place[0] + ring + 60, place[1]))
            editor.xdotool("keyup", "ctrl")
            editor.wait(lambda s: s["modified"] and not s["gesture"], "a larger disk")
            self.screenshot(editor, "larger-held-disk")
            pin = self.saved(editor, "disk.json")["pins"][0]
            self.assertGreater(pin["radius"], 80)
            self.assertEqual(pin["angle"], 0.05, "the rotation stays")

    def test_a_change_of_the_method_keeps_the_handles(self):
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: s["pictured"], "the picture")
            for place in (BODY, LEG):
                editor.click(*place)
            editor.drag(HEAD, (250, 330))
            editor.wait(lambda s: s["pins"] == 3 and not s["gesture"], "three pins")
            before = self.saved(editor, "puppet.json")
            editor.press_item("Elastic")
            editor.wait(lambda s: s["method"] != "sheet", "another method")
            editor.pause(0.3)
            self.screenshot(editor, "elastic")
            after = self.saved(editor, "elastic.json")
            for old, new in zip(before["pins"], after["pins"]):
                for a, b in zip(old.get("pose", old["rest"]), new.get("pose", new["rest"])):
                    self.assertLess(abs(a - b), 1)
            free = editor.state()["method"]
            editor.press_item("Prevent folds")
            editor.wait(lambda s: s["method"] == "bounded", "a map without folds")
            method = self.saved(editor, "proved.json")["method"]
            self.assertEqual(method["parameters"]["reference"], free, "the switch keeps what the card has chosen")
            editor.press_item("Prevent folds")
            editor.wait(lambda s: s["method"] == free, "the method without the switch")
            editor.press_item("Puppet")
            editor.wait(lambda s: s["method"] == "sheet", "the puppet again")
            editor.press_item("More methods")
            self.screenshot(editor, "more-methods")
            editor.press_item("As rigid as possible")
            editor.wait(lambda s: s["method"] == "arap", "a method from the list")
            editor.press_item("More methods")
            editor.press_item("Harmonic puppet")
            editor.wait(lambda s: s["method"] == "puppet", "the puppet of earlier releases")
            self.assertIn("Puppet", editor.state()["items"], "the section stays open")

    def test_panels_stay_in_place(self):
        with Editor([self.picture]) as editor:
            editor.wait(lambda s: s["pictured"], "the picture")

            def places():
                editor.pause(0.4)
                state = editor.state()
                names = [name for name in state["items"] if name.startswith(("section ", "tool.", "layer.", "view."))]
                return {name: state["items"][name] for name in names} | {
                    "canvas": [state[key] for key in ("left", "top", "width", "height")]}
            editor.click(*BODY)
            editor.wait(lambda s: s["pins"] == 1, "a pin")
            editor.wait(lambda s: not s["moving"], "rest")
            before = places()
            self.assertGreater(len(before), 15)
            editor.click(*LEG)
            editor.wait(lambda s: s["pins"] == 2, "another pin")
            self.assertEqual(places(), before, "another pin")
            editor.key("Escape")
            self.assertEqual(places(), before, "nothing selected")
            for tool in ("tool.select", "tool.brush", "tool.pen", "tool.stroke", "tool.pin"):
                editor.press_item(tool)
                self.assertEqual(places(), before, tool)
            # A scroll bar moves nothing.
            for section in ("section history", "section view", "section folds"):
                editor.press_item(section)
            after = places()
            self.assertNotEqual(after["section history"], before["section history"])
            above = [name for name in before if name.startswith("layer.") or name == "section method"]
            self.assertEqual({name: after[name] for name in above}, {name: before[name] for name in above})

    def two_ferns(self):
        """A scene with two layers that have keyframes at 0, 1 and 2 seconds."""
        shutil.copy(os.path.join(SOURCE, "assets/fern.png"), self.work)
        layers = []
        for k, name in enumerate(("lower", "upper")):
            x = 40 + 150 * k
            cage = [[[x, 20]], [[x + 100, 20]], [[x + 100, 600]], [[x, 600]]]
            bent = [[[x, 20]], [[x + 100, 20]], [[x + 190, 600]], [[x + 90, 600]]]
            keys = [{"time": t, "pose": {"cage": pose}} for t, pose in ((0, cage), (1, bent), (2, cage))]
            layers.append({"name": name, "image": {"file": "fern.png"}, "cage": {"rest": cage}, "method": {"id": "cage"}, "keyframes": keys})
        path = os.path.join(self.work, "ferns.json")
        with open(path, "w") as file:
            json.dump({"format": "holomorph", "version": 2, "layers": layers, "edited": 1}, file)
        return path

    def test_the_timeline_edits_keys_of_several_layers(self):
        with Editor([self.two_ferns()]) as editor:
            editor.wait(lambda s: s["pictured"] and "keys" in s["items"], "the timeline")
            left, top, right, bottom = editor.state()["items"]["keys"]
            width, row = right - left - 32, (bottom - top) / 2  # the ruler shows 2.2 s

            def at(seconds, number):
                return round(left + 16 + seconds / 2.2 * width), round(top + (number + 0.5) * row)

            def drag(start, end, keys=()):
                for key in keys:
                    editor.xdotool("keydown", key)
                editor.xdotool("mousemove", *start)
                editor.xdotool("mousedown", 1)
                for t in (0.3, 0.7, 1):
                    editor.xdotool("mousemove", *(round(a + t * (b - a)) for a, b in zip(start, end)))
                editor.xdotool("mouseup", 1)
                for key in keys:
                    editor.xdotool("keyup", key)

            def times(name):
                return [[round(key["time"], 3) for key in layer["keyframes"]] for layer in self.saved(editor, name)["layers"]]

            # A box over the middle keys of both layers, and a drag of one of them.
            drag((at(0.7, 0)[0], top + 2), (at(1.3, 1)[0], bottom - 2))
            editor.wait(lambda s: s["selected_keys"] == 2, "two selected keys")
            drag(at(1, 0), at(1.5, 0))
            editor.wait(lambda s: s["modified"], "moved keys")
            self.screenshot(editor, "moved-keys")
            self.assertEqual(times("moved.json"), [[0, 1.5, 2]] * 2)
            # Shift adds keys; a bar of the box stretches them.
            editor.xdotool("keydown", "shift")
            for number in (0, 1):
                editor.press(*at(2, number))
            editor.xdotool("keyup", "shift")
            editor.wait(lambda s: s["selected_keys"] == 4, "four selected keys")
            self.screenshot(editor, "stretched-keys")
            x, y = at(1.5, 0)
            drag((x - 14, round(top + row)), (at(0.5, 0)[0] - 14, round(top + row)))
            self.assertEqual(times("stretched.json"), [[0, 0.5, 2]] * 2)
            # Easing and deletion act on all of them, each as one step.
            editor.press_item("Ease: Linear")
            self.assertEqual([[key.get("ease") for key in layer["keyframes"]] for layer in self.saved(editor, "eased.json")["layers"]],
                             [[None, "linear", "linear"]] * 2)
            editor.key("Delete")
            editor.wait(lambda s: s["keys"] == 1, "the deletion")
            self.assertEqual(times("deleted.json"), [[0]] * 2)
            editor.key("ctrl+z")
            editor.wait(lambda s: s["keys"] == 3, "undo")
            # Ctrl copies.
            editor.press(*at(0.5, 0))
            editor.wait(lambda s: s["selected_keys"] == 1, "one selected key")
            drag(at(0.5, 0), at(1.25, 0), ["ctrl"])
            self.assertEqual(times("copied.json"), [[0, 0.5, 2], [0, 0.5, 1.25, 2]])

    def test_a_press_while_the_scene_plays_keeps_the_time_of_that_moment(self):
        """With auto-key, the new key has the other pins where they are at its time."""
        path = os.path.join(self.work, "rising.json")
        pins = [[60, 50], [540, 50]]
        with open(path, "w") as file:
            json.dump({"format": "holomorph", "version": 1, "cage": {"rest": [[[0, 0]], [[600, 0]], [[600, 100]], [[0, 100]]]},
                       "method": {"id": "puppet"}, "pins": [{"rest": pin} for pin in pins],
                       "keyframes": [{"time": time, "ease": "linear", "pose": {"pins": [{"pose": [60, 50 + 60 * time]}, {"pose": pins[1]}]}}
                                     for time in (0, 5)]}, file)
        for hold in (0, 0.15, 0.6):
            with Editor([path]) as editor:
                editor.wait(lambda s: s["keys"] == 2, "the keys")
                editor.key("k")
                editor.move(*pins[1])
                x, y = editor.pixel(*pins[1])
                editor.key("space")
                editor.wait(lambda s: s["time"] > 0.7, "playback")
                editor.xdotool("mousedown", 1, pause=hold)
                for k in range(1, 6):
                    editor.xdotool("mousemove", x, y - 8 * k, pause=0.03)
                editor.xdotool("mouseup", 1)
                editor.wait(lambda s: s["keys"] == 3 and not s["gesture"], "a new key")
                key = self.saved(editor, f"pressed-{hold}.json")["keyframes"][1]
            there = subprocess.run([PROGRAM, "map", path, "--points", "-", "--time", str(key["time"])], input="60,50\n", text=True,
                                   check=True, capture_output=True).stdout.splitlines()[-1].split(",")
            self.assertAlmostEqual(key["pose"]["pins"][0]["pose"][1], float(there[1]), delta=0.01)

    @real_in_soak
    def test_a_hat_follows_the_pin_that_was_clicked(self):
        Image.new("RGBA", (80, 60), (230, 30, 30, 255)).save(os.path.join(self.work, "hat.png"))
        shutil.copy(os.path.join(SOURCE, "assets/gecko.png"), self.work)
        scene = load(os.path.join(SOURCE, "assets/gecko.json"))
        scene["image"] = {"file": "gecko.png"}
        body = {key: scene[key] for key in ("image", "cage", "pins", "method")}
        hat = {"name": "hat", "image": {"file": "hat.png"}, "cage": {"rest": []},
               "placement": {"factor": [1, 0], "shift": [850, 600]}}
        path = os.path.join(self.work, "hat.json")
        with open(path, "w") as file:
            json.dump({"format": "holomorph", "version": 2, "layers": [dict(body, name="gecko"), hat], "edited": 1}, file)
        with Editor([path]) as editor:
            editor.wait(lambda s: s["pictured"] and not s["moving"], "the scene")
            editor.pause(1)
            pin = 5  # on the head
            head = body["pins"][pin].get("pose", body["pins"][pin]["rest"])
            editor.press_item("attach")
            editor.wait(lambda s: s["tool"] == "attach", "the tool")
            for _ in range(20):  # until the map of the other layer is ready
                editor.click(*head)
                editor.pause(1)
                if editor.state()["tool"] == "select":
                    break
            editor.wait(lambda s: s["tool"] == "select" and s["modified"], "the attachment")
            before = self.screenshot(editor, "attached-hat")
            layers = self.saved(editor, "attached.json")["layers"]
            self.assertEqual(layers[1]["attachment"], {"layer": layers[0]["id"], "pin": layers[0]["pins"][pin]["id"]})
            editor.press_item("Layer: gecko")
            editor.wait(lambda s: s["edited_layer"] == 0, "the gecko")
            editor.drag(head, (head[0] - 40, head[1] - 120))
            editor.wait(lambda s: s["modified"] and not s["gesture"], "the bent gecko")
            editor.pause(0.5)
            after = self.screenshot(editor, "carried-hat")
            # The hat is red. It has moved with the head.
            red = lambda image: numpy.argwhere((image[:, :1000, 0] > 180) & (image[:, :1000, 1] < 90)).mean(axis=0)  # noqa: E731
            moved = red(after) - red(before)
            zoom = editor.state()["zoom"]
            self.assertGreater(moved[0], 50 * zoom)
            # Without its pin, the hat stays where it is.
            editor.key("Delete")
            editor.wait(lambda s: s["pins"] == len(body["pins"]) - 1, "the deleted pin")
            self.assertNotIn("attachment", self.saved(editor, "frozen.json")["layers"][1])

    def slow_scene(self):
        """A scene whose first maps take a while: four layers, and a method that solves a nonlinear problem."""
        scene = load(os.path.join(SOURCE, "assets/gecko.json"))
        shutil.copy(os.path.join(SOURCE, "assets/gecko.png"), self.work)
        scene["image"] = {"file": "gecko.png"}
        layer = {key: scene[key] for key in ("image", "cage", "pins")}
        layer["method"] = {"id": "har_arap"}
        scene = {"format": "holomorph", "version": 2, "layers": [layer] * 4}
        path = os.path.join(self.work, "slow.json")
        with open(path, "w") as file:
            json.dump(scene, file)
        return path

    @real
    def test_a_slow_scene_shows_its_last_picture_until_the_first_answer(self):
        path = self.slow_scene()
        home = tempfile.mkdtemp(dir=self.work)
        kept = os.path.join(home, "state", "holomorph", "pictures")
        with Editor([path], home=home) as editor:
            state = editor.wait(lambda s: s["pictured"] and s["status"] != "none" and not s["last_picture"], "the first answer", 60)
            end = time.time() + 20
            while not (os.path.exists(kept) and any(name.endswith(".box") for name in os.listdir(kept))):
                self.assertLess(time.time(), end, "a picture is kept")
                editor.pause(0.1)
            solved = self.screenshot(editor, "solved")
        with Editor([path], home=home, settles=False) as editor:
            seen, end = None, time.time() + 60
            while time.time() < end:
                state = editor.state()
                if state and state["last_picture"] and state["solving"]:
                    seen = self.screenshot(editor, "last-picture")
                    break
                if state and state["pictured"] and not state["busy"]:
                    break
            self.assertIsNotNone(seen, "the last picture is shown while the scene is solved")
            state = editor.wait(lambda s: not s["solving"] and not s["last_picture"], "the answer", 60)
            left, top, width, height = (int(state[k]) for k in ("left", "top", "width", "height"))
            part = (slice(top + 80, top + height), slice(left, left + width))
            self.assertGreater((seen[part].max(axis=2) > 150).mean(), 0.03, "there is something to see")
            self.assertLess((numpy.abs(seen[part] - solved[part]).max(axis=2) > 60).mean(), 0.02)


if __name__ == "__main__":
    run_tests()
