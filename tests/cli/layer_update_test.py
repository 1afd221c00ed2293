# Layered files that change after a scene was made of them: each layer of the scene is found again, and keeps its rig.
import io
import json
import random
import sys
import zipfile

import numpy
from PIL import Image

from case import Case, few_or_many, seed_of, timed
from psd_writer import NONE, RGB, psd


class Art:
    """A picture with layers, and what artists do with it. Positions count from the upper left corner."""

    def __init__(self, rng, count):
        self.rng = rng
        self.width, self.height = rng.randrange(60, 120), rng.randrange(60, 120)
        self.layers, self.made = [], 0
        for _ in range(count):
            self.add()

    def pixels(self, width, height):
        image = numpy.array([[[self.rng.randrange(256) for _ in range(3)] + [255] for _ in range(width)] for _ in range(height)], numpy.uint8)
        image[self.rng.randrange(1, height - 1), self.rng.randrange(1, width - 1), 3] = 0
        return image

    def add(self, at=None):
        self.made += 1
        width, height = self.rng.randrange(5, 20), self.rng.randrange(5, 20)
        layer = {"id": self.made, "name": f"layer {self.made}", "pixels": self.pixels(width, height),
                 "x": self.rng.randrange(-10, self.width - 5), "y": self.rng.randrange(-10, self.height - 5)}
        self.layers.insert(len(self.layers) if at is None else at, layer)

    def grow(self):
        """Adds or removes rows and columns at all sides; returns how far everything has moved from the lower left corner."""
        left, top, right, bottom = (self.rng.randrange(-9, 30) for _ in range(4))
        self.grown = left, top
        self.width += left + right
        self.height += top + bottom
        for layer in self.layers:
            layer["x"] += left
            layer["y"] += top
        return left, bottom

    def ora(self):
        """As two painting programs write it: the files of the layers are numbered from the top."""
        stack, files = "", {}
        for number, layer in enumerate(reversed(self.layers)):
            data = io.BytesIO()
            Image.fromarray(layer["pixels"], "RGBA").save(data, "PNG")
            files[f"data/layer{number}.png"] = data.getvalue()
            stack += f'<layer name="{layer["name"]}" src="data/layer{number}.png" x="{layer["x"]}" y="{layer["y"]}"/>'
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w") as archive:
            archive.writestr("mimetype", "image/openraster")
            archive.writestr("stack.xml", f'<image w="{self.width}" h="{self.height}"><stack>{stack}</stack></image>')
            for name, data in files.items():
                archive.writestr(name, data)
        return out.getvalue()

    def psd(self, ids=True, renumbered=False):
        layers = []
        for number, layer in enumerate(self.layers):
            planes = [layer["pixels"][..., k].astype(int) for k in (3, 0, 1, 2)]
            ident = [number + 1 if renumbered else layer["id"]] if ids else []
            layers.append((layer["name"], layer["x"], layer["y"], planes, *ident))
        merged = [numpy.zeros((self.height, self.width), int)] * 3
        return psd(self.width, self.height, RGB, 8, NONE, merged, layers)


WRITERS = {"ora": Art.ora, "ids.psd": Art.psd, "renumbered.psd": lambda art: art.psd(renumbered=True), "plain.psd": lambda art: art.psd(ids=False)}


class Updates(Case):
    def save(self, art, kind):
        with open(self.path("art." + kind), "wb") as file:
            file.write(WRITERS[kind](art))

    def scene(self):
        with open(self.path("s.json")) as file:
            return json.load(file)

    def start(self, art, kind):
        """A scene of the art as it is, in which nothing is deformed."""
        self.save(art, kind)
        self.good("new", self.path("art." + kind), "--out", self.path("s.json"), "--force")
        scene = self.scene()
        for layer in scene.get("layers", [scene]):
            layer["cage"] = {"rest": []}
            layer["method"] = {"id": "cage"}
        self.write("s.json", scene)

    def drawn(self, box, *words):
        rect = ",".join(map(str, box))
        self.said = self.good("render", self.path("s.json"), "--out", self.path("s.png"), "--force", "--rect", rect, *words).stderr
        return numpy.asarray(Image.open(self.path("s.png")).convert("RGBA"))

    def composed(self, art, layers, box, moved):
        """These layers of the art where the scene shows them; `moved` is how far the canvas has moved in it."""
        left, bottom, width, height = box
        out = Image.new("RGBA", (width, height))
        for layer in layers:
            rows = layer["pixels"].shape[0]
            x, up = layer["x"] - moved[0] - left, art.height - layer["y"] - rows - moved[1] - bottom
            whole = Image.new("RGBA", out.size)
            whole.paste(Image.fromarray(layer["pixels"], "RGBA"), (x, height - up - rows))
            out.alpha_composite(whole)
        return numpy.asarray(out)

    BOX = (-60, -60, 260, 260)

    def assert_same(self, shown, wanted, seed):
        difference = numpy.abs(shown.astype(int) - wanted.astype(int))
        difference[(shown[..., 3] == 0) & (wanted[..., 3] == 0)] = 0
        self.assertLessEqual(difference.max(), 1, seed)

    def test_attached_layers_move_as_in_the_file(self):
        """Layers that are attached to each other are moved in the file: the scene looks like the file."""
        for kind in ("ora", "ids.psd", "plain.psd"):
            for seed in (*few_or_many(range(3), range(12)), seed_of("attached layers " + kind, 60)):
                with self.subTest(kind=kind, seed=seed):
                    rng = random.Random(seed)
                    art = Art(rng, rng.randint(3, 6))
                    self.start(art, kind)
                    scene = self.scene()
                    for i, layer in enumerate(scene["layers"]):
                        layer["id"] = i + 1
                        shown = art.layers[i]
                        rows, columns = shown["pixels"].shape[:2]
                        left, bottom = shown["x"], art.height - shown["y"] - rows
                        corners = [[left, bottom], [left + columns, bottom], [left + columns, bottom + rows], [left, bottom + rows]]
                        layer["cage"] = {"rest": [[corner] for corner in corners]}
                        if i > 0 and rng.random() < 0.7:
                            layer["attachment"] = {"layer": rng.randint(1, i), "place": [left + columns / 2, bottom + rows / 2]}
                    # A layer is taken away, comes back later, and lies where the file has it.
                    gone = rng.choice(art.layers) if rng.random() < 0.5 else None
                    self.write("s.json", scene)
                    for layer in art.layers:
                        if rng.random() < 0.6:
                            layer["x"] += rng.randrange(-20, 20)
                            layer["y"] += rng.randrange(-20, 20)
                    if gone:
                        place = art.layers.index(gone)
                        art.layers.remove(gone)
                        self.save(art, kind)
                        self.good("update", self.path("s.json"))
                        art.layers.insert(place, gone)
                    self.save(art, kind)
                    self.good("update", self.path("s.json"))
                    self.assert_same(self.drawn(self.BOX), self.composed(art, art.layers, self.BOX, (0, 0)), seed)

    def test_an_enlarged_layer_moves_with_what_it_is_attached_to(self):
        """Moved together with it, it keeps its place on it, moved a little farther, it moves a little, in its own
        direction and size; if only the other one is moved, it stays."""
        for moved, window in ((12, (-138, -150, 400, 400)), (13, (-138, -148, 400, 400)), (0, (-150, -150, 400, 400))):
            with self.subTest(moved=moved):
                art = Art(random.Random(8), 2)
                self.start(art, "ids.psd")
                scene = self.scene()
                head, hat = scene["layers"]
                rows, columns = art.layers[0]["pixels"].shape[:2]
                left, bottom = art.layers[0]["x"], art.height - art.layers[0]["y"] - rows
                head["id"] = 1
                head["cage"] = {"rest": [[[left, bottom]], [[left + columns, bottom]], [[left + columns, bottom + rows]], [[left, bottom + rows]]]}
                hat["attachment"] = {"layer": 1, "place": [left + columns / 2, bottom + rows / 2]}
                hat["placement"] = {"factor": [0, 2], "shift": [40, -7]}
                head["visible"] = False
                self.write("s.json", scene)
                before = self.drawn((-150, -150, 400, 400))
                art.layers[0]["x"] += 12
                art.layers[1]["x"] += moved
                self.save(art, "ids.psd")
                self.good("update", self.path("s.json"))
                self.assertGreater(before[..., 3].max(), 0)
                self.assert_same(self.drawn(window), before, moved)

    def test_a_file_that_was_a_plain_picture_for_a_while_is_as_before(self):
        for kind in ("ora", "ids.psd"):
            with self.subTest(kind=kind):
                art = Art(random.Random(4), 3)
                self.start(art, kind)
                self.write("s.json", self.scene())
                before = self.drawn(self.BOX)
                name = self.path(self.scene()["layers"][0]["image"]["file"])
                with open(name, "rb") as file:
                    whole = file.read()
                for flat_size in ((art.width, art.height), (33, 77)):
                    Image.new("RGBA", flat_size, (9, 8, 7, 255)).save(name, format="PNG")
                    self.assertNotIn("canvas", self.good("update", self.path("s.json")).stderr)
                    with open(name, "wb") as file:
                        file.write(whole)
                    self.good("update", self.path("s.json"))
                    self.assert_same(self.drawn(self.BOX), before, flat_size)

    def test_new_layers_lie_where_the_canvas_does(self):
        """Layers of the scene were placed by hand, or have moved in the file, when the canvas grows and gets a layer."""
        for kind in ("ora", "ids.psd", "plain.psd"):
            for placed in ("nothing", "one", "both", "scaled", "moved in the file", "moved back in the scene"):
                with self.subTest(kind=kind, placed=placed):
                    art = Art(random.Random(placed), 2)
                    self.start(art, kind)
                    scene = self.scene()
                    for layer in scene["layers"][:1 if placed == "one" else 2]:
                        if placed in ("one", "both", "scaled"):
                            layer["placement"] = {"factor": [2 if placed == "scaled" else 1, 0], "shift": [5, 0]}
                    self.write("s.json", scene)
                    if placed.startswith("moved"):
                        for layer in art.layers:
                            layer["x"] += 7
                        self.save(art, kind)
                        self.good("update", self.path("s.json"))
                        if placed.startswith("moved back"):
                            scene = self.scene()
                            for layer in scene["layers"]:
                                del layer["placement"]
                            self.write("s.json", scene)
                    moved = art.grow()
                    self.save(art, kind)
                    self.good("update", self.path("s.json"))
                    art.add()
                    self.save(art, kind)
                    self.good("update", self.path("s.json"), "--add")
                    scene = self.scene()
                    self.assertEqual(len(scene["layers"]), 3)
                    for layer in scene["layers"][:2]:
                        layer["visible"] = False
                    self.write("s.json", scene)
                    self.assert_same(self.drawn(self.BOX), self.composed(art, art.layers[2:], self.BOX, moved), placed)

    def test_layers_are_found_after_any_change(self):
        """Layers are added, removed, moved, renamed, repainted and put in another order, and the canvas grows or is cropped."""
        for kind in WRITERS:
            for seed in (*few_or_many(range(3), range(12)), seed_of("changed layers " + kind, 50)):
                with self.subTest(kind=kind, seed=seed):
                    rng = random.Random(seed)
                    art = Art(rng, rng.randint(2, 7))
                    self.start(art, kind)
                    before = list(art.layers)
                    self.assert_same(self.drawn(self.BOX), self.composed(art, before, self.BOX, (0, 0)), seed)
                    moved = (0, 0)
                    # Most layers stay as they are, so that the side is known at which a canvas has grown.
                    changing = rng.sample(before, (len(before) - 1) // 2)
                    for layer in changing:
                        # With ids that are not kept, nobody knows which layer was repainted.
                        change = rng.choice(["move", "rename", "order"] + ["repaint"] * (kind != "renumbered.psd"))
                        if change == "move":
                            layer["x"] += rng.randrange(-9, 9)
                            layer["y"] += rng.randrange(-9, 9)
                        elif change == "rename":
                            layer["name"] += " once more"
                        elif change == "repaint":
                            layer["pixels"] = art.pixels(rng.randrange(5, 20), rng.randrange(5, 20))
                        else:
                            art.layers.remove(layer)
                            art.layers.insert(rng.randrange(len(art.layers) + 1), layer)
                    for _ in range(rng.randrange(3)):
                        art.add(rng.randrange(len(art.layers) + 1))
                    if rng.random() < 0.5:
                        moved = art.grow()
                    self.save(art, kind)
                    said = self.good("update", self.path("s.json")).stderr
                    self.assertRegex(said, "updated|have not changed")
                    self.assertEqual([layer["image"]["name"] for layer in self.scene()["layers"]], [layer["name"] for layer in before], (seed, said))
                    wanted = self.composed(art, before, self.BOX, moved)
                    self.assert_same(self.drawn(self.BOX), wanted, seed)
                    self.assertNotIn("canvas", self.said)  # it was said once
                    again = self.scene()
                    self.good("update", self.path("s.json"))
                    self.assertEqual(self.scene(), again)
                    self.good("update", self.path("s.json"), "--add")  # also what an earlier update has not added
                    self.assertEqual({layer["image"]["name"] for layer in self.scene()["layers"]}, {layer["name"] for layer in art.layers})

    def test_a_rig_moves_with_its_layer(self):
        for seed in (1, seed_of("moved rigs", 2)):
            for kind in WRITERS:
                with self.subTest(kind=kind, seed=seed):
                    rng = random.Random(seed)
                    art = Art(rng, 3)
                    self.start(art, kind)
                    arm = art.layers[0]
                    scene = self.scene()
                    h, w = arm["pixels"].shape[:2]
                    x, y = arm["x"], art.height - arm["y"] - h
                    box = [[x - 3, y - 3], [x + w + 3, y - 3], [x + w + 3, y + h + 3], [x - 3, y + h + 3]]
                    rig = scene["layers"][0]
                    rig["cage"] = {"rest": [[p] for p in box], "pose": [[[p[0] + 20, p[1] + 7]] for p in box]}
                    for layer in scene["layers"][1:]:
                        layer["visible"] = False
                    self.write("s.json", scene)
                    bent = self.drawn(self.BOX)
                    by = rng.randrange(1, 9), rng.randrange(1, 9)
                    arm["x"] += by[0]
                    arm["y"] -= by[1]
                    self.save(art, kind)
                    self.assertIn(f"has moved by {by[0]} px to the right and {by[1]} px up", self.good("update", self.path("s.json")).stderr)
                    wanted = numpy.zeros_like(bent)
                    wanted[:-by[1], by[0]:] = bent[by[1]:, :-by[0]]
                    self.assert_same(self.drawn(self.BOX), wanted, seed)

    def test_what_is_not_certain_is_asked(self):
        rng = random.Random(4)
        for kind in WRITERS:
            with self.subTest(kind=kind):
                art = Art(rng, 3)
                self.start(art, kind)
                old = self.scene()
                arm = art.layers.pop(1)
                art.add(0)
                art.add(3)
                self.save(art, kind)
                low, high = art.layers[0]["name"], art.layers[-1]["name"]
                says = f"the layer '{arm['name']}' may now be '{low}' or '{high}'"
                for command in (("update", self.path("s.json")), ("render", self.path("s.json"), "--out", self.path("x.png")), ("info", self.path("s.json"))):
                    self.bad(*command, says=says)
                self.assertEqual(self.scene(), old)
                self.good("update", self.path("s.json"), "--match", f"{arm['name']}={high}")
                self.assertEqual(self.scene()["layers"][1]["image"]["name"], high)
                self.bad("update", self.path("s.json"), "--match", "nobody=" + low, says="no layer of a file with the name 'nobody'")
                self.bad("update", self.path("s.json"), "--match", "nothing", says="not of the form")

    def test_an_answer_concerns_one_layer_only(self):
        """What was renamed and repainted at once is asked about, while others get the entries that it had."""
        for kind in WRITERS:
            for seed in (11, seed_of("one answer", 12)):
                with self.subTest(kind=kind, seed=seed):
                    rng = random.Random(seed)
                    art = Art(rng, 4)
                    self.start(art, kind)
                    before = list(art.layers)
                    arm = rng.choice(before)
                    was = arm["name"]
                    arm["name"], arm["pixels"], arm["id"] = "sleeve", art.pixels(9, 12), 77
                    art.add(rng.randrange(len(art.layers) + 1))
                    self.save(art, kind)
                    if kind != "renumbered.psd":  # whose ids may say the right thing
                        self.bad("update", self.path("s.json"), says=f"the layer '{was}' may now be")
                    self.good("update", self.path("s.json"), "--match", was + "=sleeve")
                    self.assertEqual([layer["image"]["name"] for layer in self.scene()["layers"]], [layer["name"] for layer in before])
                    self.assert_same(self.drawn(self.BOX), self.composed(art, before, self.BOX, (0, 0)), seed)

    def test_lost_layers_follow_the_canvas_and_do_not_mix(self):
        """Two layers with the same pixels are lost, the canvas grows, and they come back one by one."""
        for kind in WRITERS:
            with self.subTest(kind=kind):
                art = Art(random.Random(13), 4)
                left, right = art.layers[1], art.layers[2]
                right["pixels"] = left["pixels"].copy()
                self.start(art, kind)
                shown = self.drawn(self.BOX)
                art.layers = [art.layers[0], art.layers[3]]
                self.save(art, kind)
                self.good("update", self.path("s.json"))
                moved = art.grow()
                for layer in (left, right):  # the canvas grows at the left and at the top, too
                    layer["x"] += art.grown[0]
                    layer["y"] += art.grown[1]
                self.save(art, kind)
                self.good("update", self.path("s.json"))
                art.layers.insert(1, right)
                self.save(art, kind)
                self.good("update", self.path("s.json"))
                wanted = self.composed(art, art.layers, self.BOX, moved)
                self.assert_same(self.drawn(self.BOX), wanted, kind)
                art.layers.insert(1, left)
                self.save(art, kind)
                self.good("update", self.path("s.json"))
                self.assert_same(self.drawn(self.BOX), shown, kind)

    def test_a_lost_layer_keeps_its_rig_and_can_come_back(self):
        for kind in WRITERS:
            with self.subTest(kind=kind):
                art = Art(random.Random(5), 3)
                self.start(art, kind)
                shown = self.drawn(self.BOX)
                arm = art.layers.pop(1)
                self.save(art, kind)
                self.assertIn("is no longer in the file", self.good("update", self.path("s.json")).stderr)
                self.assert_same(self.drawn(self.BOX), self.composed(art, art.layers, self.BOX, (0, 0)), kind)
                self.assertEqual(len(self.scene()["layers"]), 3)
                art.layers.insert(1, arm)
                self.save(art, kind)
                self.assertIn("is in the file again", self.good("update", self.path("s.json")).stderr)
                self.assert_same(self.drawn(self.BOX), shown, kind)

    def test_new_layers_are_added_in_their_order(self):
        for seed in (6, seed_of("added layers", 7)):
            for kind in WRITERS:
                with self.subTest(kind=kind, seed=seed):
                    rng = random.Random(seed)
                    art = Art(rng, 3)
                    self.start(art, kind)
                    for _ in range(3):
                        art.add(rng.randrange(len(art.layers) + 1))
                    self.save(art, kind)
                    self.assertIn("3 new layers", self.good("update", self.path("s.json"), "--add").stderr)
                    self.assertEqual([layer["name"] for layer in self.scene()["layers"]], [layer["name"] for layer in art.layers])
                    scene = self.scene()
                    for layer in scene["layers"]:
                        layer["cage"] = {"rest": []}
                    self.write("s.json", scene)
                    self.assert_same(self.drawn(self.BOX), self.composed(art, art.layers, self.BOX, (0, 0)), seed)

    def test_scenes_without_marks_are_found_by_name(self):
        """Scenes of older programs store neither pixels nor names of layers in files."""
        for kind in WRITERS:
            with self.subTest(kind=kind):
                art = Art(random.Random(8), 3)
                self.start(art, kind)
                scene = self.scene()
                for layer in scene["layers"]:
                    for key in ("hash", "name", "offset"):
                        layer["image"].pop(key, None)
                scene["version"] = 2
                self.write("s.json", scene)
                art.add(0)
                art.height += 20  # below
                self.save(art, kind)
                if kind == "renumbered.psd":  # nothing tells whether the ids or the names are right
                    self.bad("update", self.path("s.json"), says="may now be 'layer 4' or 'layer 1'")
                    continue
                wanted = self.composed(art, art.layers[1:], self.BOX, (0, 20))
                self.assert_same(self.drawn(self.BOX), wanted, kind)

    def test_what_lies_beyond_the_canvas_appears_on_it(self):
        """An arm that is half beyond the canvas is moved onto it as a whole, and by its cage; at rest, its half stays hidden."""
        red, blue = numpy.full((20, 60, 4), (200, 30, 40, 255), numpy.uint8), numpy.full((100, 100, 4), (30, 60, 200, 255), numpy.uint8)
        for kind in WRITERS:
            art = Art(random.Random(9), 0)
            art.width = art.height = 100
            art.layers = [{"id": 1, "name": "sky", "pixels": blue, "x": 0, "y": 0}, {"id": 2, "name": "arm", "pixels": red, "x": -30, "y": 40}]
            self.start(art, kind)
            box = [[-32, 38], [32, 38], [32, 62], [-32, 62]]
            for change, left, right in (({}, 0, 30), ({"placement": {"factor": [1, 0], "shift": [40, 0]}}, 10, 70),
                                        ({"cage": {"rest": [[p] for p in box], "pose": [[[x + 35, y]] for x, y in box]}}, 5, 65)):
                with self.subTest(kind=kind, change=change):
                    scene = self.scene()
                    scene["layers"][1] = {**scene["layers"][1], **change}
                    self.write("moved.json", scene)
                    self.good("render", self.path("moved.json"), "--out", self.path("s.png"), "--force")
                    shown = numpy.asarray(Image.open(self.path("s.png")).convert("RGB"))
                    self.assertEqual(shown.shape, (100, 100, 3))
                    columns = numpy.flatnonzero(shown[50, :, 0] > 128)
                    self.assertEqual((columns[0], columns[-1] + 1), (left, right))

    def test_a_layer_takes_the_memory_of_its_own_pixels(self):
        art = Art(random.Random(9), 12)
        art.width = art.height = 4000
        self.save(art, "ids.psd")
        self.good("new", self.path("art.ids.psd"), "--out", self.path("s.json"), "--max-pixels", "20000")
        self.good("info", self.path("s.json"), "--max-pixels", "20000")


if __name__ == "__main__":
    timed.main(sys.argv[3:])
