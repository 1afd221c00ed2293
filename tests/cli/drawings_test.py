# SVG drawings as pictures: they open, bend as drawings, and look as they are rendered. rsvg-convert draws what we write.
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

import numpy
from PIL import Image

from case import SOURCE, Case

ASSETS = os.path.join(SOURCE, "assets")
SAMPLES = sorted(name[:-4] for name in os.listdir(ASSETS) if name.endswith(".svg"))
METHODS = ("cage", "pins", "arap", "har_arap", "outline", "strokes", "angles", "harmonic", "mean_value", "bounded", "puppet")
SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


def premultiplied(image):
    pixels = numpy.asarray(image.convert("RGBA")).astype(float)
    pixels[..., :3] *= pixels[..., 3:] / 255
    return pixels


def cubics_of(data):
    """The cubics of path data that has only the commands M, L, C and Z."""
    curves, at, start = [], None, None
    for command, text in re.findall(r"([MLCZmlczHVSQTAhvsqta])([^A-Za-z]*)", re.sub(r"[eE]([-+]?\d)", r"", data)):
        numbers = [float(x) for x in re.findall(r"[-+]?(?:\d+\.?\d*|\.\d+)", text)]
        points = [complex(*pair) for pair in zip(numbers[::2], numbers[1::2])]
        if command == "M":
            at = start = points[0]
            points = points[1:]
            command = "L"
        if command == "L":
            for z in points:
                curves.append((at, at + (z - at) / 3, z + (at - z) / 3, z))
                at = z
        elif command == "C":
            for k in range(0, len(points), 3):
                curves.append((at, *points[k:k + 3]))
                at = points[k + 2]
        elif command == "Z":
            at = start
        else:
            raise ValueError(command)
    return curves


def placed_cubics_of(path):
    """The cubics of a path, with its own transform."""
    numbers = re.findall(r"[-+.\deE]+", path.get("transform", "matrix(1 0 0 1 0 0)"))
    a, b, c, d, e, f = map(float, numbers[-6:])
    return [tuple(complex(a * z.real + c * z.imag + e, b * z.real + d * z.imag + f) for z in cubic)
            for cubic in cubics_of(path.get("d"))]


def sampled(curves, count):
    t = numpy.linspace(0, 1, count)[:, None]
    p = numpy.array(curves).T[:, None, :]
    return ((1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t**2 * p[2] + t**3 * p[3]).T.ravel()


class Drawings(Case):
    def setUp(self):
        super().setUp()
        self.seed = int(os.environ.get("HOLOMORPH_SEED", random.randrange(1 << 30)))
        print(f"HOLOMORPH_SEED={self.seed}", file=sys.stderr)
        self.chance = random.Random(self.seed)

    def exported(self, scene, *options, name="out.svg"):
        said = self.good("export", scene, "--format", "drawing", "--out", self.path(name), "--force", *options).stderr
        return self.path(name), said

    def size_of(self, name):
        with Image.open(self.path(name)) as picture:
            return picture.size

    def drawn(self, svg):
        subprocess.run(["rsvg-convert", "--unlimited", svg, "-o", self.path("judged.png")], check=True)
        return Image.open(self.path("judged.png"))

    def compare(self, scene, *options):
        """The average difference between the drawing and the picture, and the part that differs much."""
        svg, _ = self.exported(scene, *options)
        self.good("render", scene, "--out", self.path("rendered.png"), "--force", *options)
        ours, theirs = premultiplied(Image.open(self.path("rendered.png"))), premultiplied(self.drawn(svg))
        self.assertEqual(ours.shape, theirs.shape)
        difference = numpy.abs(ours - theirs)
        return difference.mean(), (difference.max(axis=2) > 64).mean()

    def sample(self, name):
        """A sample with its drawing as the picture."""
        with open(os.path.join(ASSETS, name + ".json")) as file:
            scene = json.load(file)
        for each in (name + ".svg", "leaf.obj", "mask.obj"):
            shutil.copy(os.path.join(ASSETS, each), self.folder)
        scene["image"] = {"file": name + ".svg"}
        return self.write(name + ".json", scene)

    def random_cage(self, w, h, by):
        rest = [[w / 2 + 0.49 * w * math.cos(t) * min(1.3, 1 / max(abs(math.cos(t)), abs(math.sin(t)))),
                 h / 2 + 0.49 * h * math.sin(t) * min(1.3, 1 / max(abs(math.cos(t)), abs(math.sin(t))))]
                for t in numpy.linspace(0, 2 * math.pi, 13)[:-1]]
        pose = [[[x + self.chance.uniform(-by, by), y + self.chance.uniform(-by, by)]] for x, y in rest]
        return {"rest": [[p] for p in rest], "pose": pose}

    def method_scene(self, method, file, w, h, by):
        cage = self.random_cage(w, h, by)
        scene = {"format": "holomorph", "version": 1, "image": {"file": file}, "method": {"id": method}, "cage": cage}
        if method in ("pins", "arap", "har_arap", "bounded", "puppet"):
            cage.pop("pose")
            scene["pins"] = [{"id": k + 1, "rest": [x * w, y * h],
                              "pose": [x * w + self.chance.uniform(-by, by), y * h + self.chance.uniform(-by, by)]}
                             for k, (x, y) in enumerate([(0.25, 0.3), (0.7, 0.25), (0.5, 0.7)])]
        if method == "strokes":
            cage.pop("pose")
            scene["strokes"] = [{"id": 1, "rest": [[0.2 * w, 0.3 * h], [0.7 * w, 0.4 * h]],
                                 "pose": [[0.2 * w + by, 0.3 * h - by], [0.7 * w - by, 0.4 * h + by]]}]
        if method == "outline":
            cage.pop("pose")
            scene["outline"] = [[0.5 * w + 0.4 * h * math.cos(t), 0.5 * h + 0.45 * h * math.sin(t)]
                                           for t in numpy.linspace(0, 2 * math.pi, 41)[:-1]]
        if method == "angles":
            cage.pop("pose")
        return scene

    def test_samples_look_as_they_are_rendered(self):
        for name in SAMPLES:
            with self.subTest(name):
                average, far = self.compare(self.sample(name))
                print(f"{name}: {average:.2f} on average, {100 * far:.3f} % differ much", file=sys.stderr)
                # Strokes have one width, and gradients are not bent.
                self.assertLess(average, 4)
                self.assertLess(far, 0.05)

    def test_plain_shapes_look_as_they_are_rendered(self):
        w, h = 1200, 800
        shapes = []
        for _ in range(14):
            x, y = self.chance.uniform(150, w - 150), self.chance.uniform(150, h - 150)
            shapes.append(self.chance.choice([
                f"<circle cx='{x}' cy='{y}' r='{self.chance.uniform(10, 130)}'",
                f"<rect x='{x - 90}' y='{y - 60}' width='180' height='120' rx='{self.chance.uniform(0, 40)}'",
                f"<path d='M{x - 100} {y}Q{x} {y - 150} {x + 90} {y + 40}T{x - 60} {y + 80}'",
                f"<polyline points='{x - 90},{y} {x},{y + 90} {x + 99},{y - 20}'"])
                + " fill='#%06x' fill-opacity='%.2f'/>" % (self.chance.randrange(1 << 24), self.chance.uniform(0.4, 1)))
        self.write("a.svg", f"<svg xmlns='http://www.w3.org/2000/svg' width='{w}' height='{h}'>{''.join(shapes)}</svg>")
        for method in METHODS:
            with self.subTest(method):
                average, far = self.compare(self.write("a.json", self.method_scene(method, "a.svg", w, h, 50)))
                print(f"{method}: {average:.2f} on average, {100 * far:.3f} % differ much", file=sys.stderr)
                self.assertLess(average, 0.6)
                self.assertLess(far, 0.002)

    def test_curves_follow_the_map_of_every_method(self):
        w, h = 1200, 800
        shapes = []
        for _ in range(12):
            points = [complex(self.chance.uniform(80, w - 80), self.chance.uniform(80, h - 80)) for _ in range(4)]
            shapes.append(points)
        text = "".join("<path fill='none' stroke='#123' stroke-width='3' d='M{0.real} {0.imag}C{1.real} {1.imag} {2.real} {2.imag} {3.real} {3.imag}'/>"
                       .format(*points) for points in shapes)
        self.write("a.svg", f"<svg xmlns='http://www.w3.org/2000/svg' width='{w}' height='{h}'>{text}</svg>")
        for method in METHODS:
            with self.subTest(method):
                scene = self.write("a.json", self.method_scene(method, "a.svg", w, h, 40))
                svg, _ = self.exported(scene)
                corner = self.good("render", scene, "--out", self.path("r.png"), "--force").stderr
                left, bottom = map(float, re.search(r"corner at \((.*), (.*)\)", corner).groups())
                height = self.size_of("r.png")[1]
                written = [placed_cubics_of(path) for path in ElementTree.parse(svg).iter(SVG + "path") if path.get("fill") == "none"]
                self.assertEqual(len(written), len(shapes))
                for points, curves in zip(shapes, written):
                    rest = sampled([points], 2001)
                    self.write("p.csv", "\n".join(f"{z.real!r},{h - z.imag!r}" for z in rest))
                    out = self.good("map", scene, "--points", self.path("p.csv")).stdout
                    exact = numpy.array([complex(*map(float, line.split(",")[:2])) for line in out.splitlines()
                                         if re.match(r"[-+]?\d", line)])
                    self.assertEqual(len(exact), 2001)
                    exact = numpy.array([complex(z.real - left, bottom + height - z.imag) for z in exact])
                    ours = sampled(curves, 9)
                    # The distance to the nearest of the short segments between exact points.
                    a, b = exact[:-1], exact[1:]
                    along = b - a
                    to = ours[:, None] - a
                    t = numpy.clip((to * along.conj()).real / numpy.maximum(abs(along) ** 2, 1e-30), 0, 1)
                    self.assertLess(abs(to - t * along).min(axis=1).max(), 0.055)

    def layered_scene(self):
        """Drawings and pixels with random ink."""
        w, h = 1100, 900
        layers = []
        for i in range(5):
            color = "#%06x" % self.chance.randrange(1 << 24)
            circles = "".join(f"<circle cx='{self.chance.uniform(200, 900):.1f}' cy='{self.chance.uniform(200, 700):.1f}' "
                              f"r='{self.chance.uniform(40, 180):.1f}' fill='url(#g)'/>" for _ in range(4))
            self.write(f"{i}.svg", f"<svg xmlns='http://www.w3.org/2000/svg' width='{w}' height='{h}'><defs>"
                       f"<linearGradient id='g'><stop offset='0' stop-color='{color}'/><stop offset='1' stop-color='#fff'/>"
                       f"</linearGradient></defs>{circles}</svg>")
            if i % 2:
                subprocess.run(["rsvg-convert", self.path(f"{i}.svg"), "-o", self.path(f"{i}.png")], check=True)
            layers.append({"name": f"<{i}> & \"é\"", "image": {"file": f"{i}.png" if i % 2 else f"{i}.svg"},
                           "cage": self.random_cage(w, h, 30), "opacity": self.chance.choice([1, 0.5, 0.8]),
                           "blending": self.chance.choice(["normal", "multiply", "screen", "overlay"]),
                           "visible": self.chance.random() < 0.8, "clipped": i > 0 and self.chance.random() < 0.5})
        layers[0]["visible"] = True
        background = self.chance.choice([{}, {"background": "#204060"}, {"background": "original"}])
        return {"format": "holomorph", "version": 2, "layers": layers, **background}

    def test_layers_keep_their_ink(self):
        for _ in range(4):
            scene = self.layered_scene()
            path = self.write("layers.json", scene)
            options = self.chance.choice([(), ("--crop",), ("--scale", "0.7"), ("--rect", "200,100,500,600")])
            average, far = self.compare(path, *options)
            self.assertLess(average, 1.0, options)
            self.assertLess(far, 0.01, options)
            root = ElementTree.parse(self.path("out.svg")).getroot()
            names = [group.get(INKSCAPE + "label") for group in root.iter(SVG + "g") if group.get(INKSCAPE + "groupmode")]
            self.assertEqual([name for name in names if "Original" not in name], [layer["name"] for layer in scene["layers"]])
            ids = [element.get("id") for element in root.iter() if element.get("id")]
            self.assertEqual(len(ids), len(set(ids)))

    def test_motions_show_the_moment(self):
        w, h = 1100, 900
        self.write("a.svg", f"<svg xmlns='http://www.w3.org/2000/svg' width='{w}' height='{h}'>"
                   "<rect x='300' y='250' width='500' height='400' rx='60' fill='#357'/></svg>")
        cage = self.random_cage(w, h, 60)
        scene = {"format": "holomorph", "version": 1, "image": {"file": "a.svg"}, "method": {"id": "cage"},
                 "cage": {"rest": cage["rest"]},
                 "keyframes": [{"time": 0, "pose": {}}, {"time": 1, "pose": {"cage": cage["pose"]}}]}
        path = self.write("moves.json", scene)
        for time in (0, 0.4, 1):
            average, far = self.compare(path, "--time", str(time))
            self.assertLess(average, 0.5)
            self.assertLess(far, 0.002)

    def test_solid_parts_outside_the_cage_stay(self):
        self.write("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='1200' height='800'>"
                   "<rect width='1200' height='800' fill='#8bc'/><circle cx='600' cy='400' r='200' fill='#b43'/></svg>")
        rest = [[400, 200], [800, 200], [800, 600], [400, 600]]
        pose = [[[x + self.chance.uniform(-60, 60), y + self.chance.uniform(-60, 60)]] for x, y in rest]
        for method in ("cage", "harmonic", "arap"):
            path = self.write("cut.json", {"format": "holomorph", "version": 1, "image": {"file": "a.svg"},
                                           "cage": {"rest": [[p] for p in rest], "pose": pose}, "method": {"id": method}})
            average, far = self.compare(path)
            self.assertLess(average, 0.8)
            self.assertLess(far, 0.005)

    def test_losses_are_said(self):
        self.write("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='1100' height='300'>"
                   "<text x='100' y='200' font-size='80'>Words</text></svg>")
        path = self.write("a.json", {"format": "holomorph", "version": 2,
                                     "layers": [{"name": "Sign", "image": {"file": "a.svg"}, "cage": self.random_cage(1100, 300, 9)}]})
        _, said = self.exported(path)
        self.assertIn("Sign: its texts are moved and turned, but not bent", said)
        self.assertIn("1 layer of", said)

    def test_what_is_wrong_with_a_drawing_is_said(self):
        scene = {"format": "holomorph", "version": 1, "image": {"file": "a.svg"}, "cage": {"rest": []}}
        for content, says in (("<svg><path", "a.svg"), ("<svg xmlns='http://www.w3.org/2000/svg'/>", "size"),
                              ("<svg" + "><g" * 3000 + ">", "a.svg")):
            self.write("a.svg", content)
            path = self.write("a.json", scene)
            self.bad("render", path, "--out", self.path("a.png"), says=says)
        self.write("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='1100' height='300'><rect width='9' height='9'/></svg>")
        os.mkdir(self.path("empty"))
        self.bad("render", path, "--out", self.path("a.png"), says="librsvg2-bin", status=1,
                 env=dict(os.environ, PATH=self.path("empty")))

    def test_a_cage_is_found_around_a_drawing(self):
        shutil.copy(os.path.join(ASSETS, "gecko.svg"), self.folder)
        self.good("new", self.path("gecko.svg"), "--out", self.path("gecko.json"))
        average, far = self.compare(self.path("gecko.json"))
        self.assertLess(average, 1)
        self.assertLess(far, 0.01)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
