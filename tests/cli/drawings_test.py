# SVG drawings as pictures: they open, bend as drawings, and look as they are rendered. rsvg-convert draws what we write.
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import numpy
from PIL import Image

from case import SOURCE, Case, few_or_many, seed_of, timed

ASSETS = os.path.join(SOURCE, "assets")
SAMPLES = sorted(name[:-4] for name in os.listdir(ASSETS) if name.endswith(".svg"))
METHODS = ("cage", "pins", "arap", "har_arap", "outline", "strokes", "angles", "harmonic", "mean_value", "bounded", "puppet", "sheet")
SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


# What drawing programs write. Each drawing has 1200 x 900 pixels and is bent a little.
BLUE = "<rect x='200' y='150' width='800' height='600' fill='#24c'/>"
RSVG = tuple(int(each) for each in re.findall(r"\d+", subprocess.run(["rsvg-convert", "--version"], check=True, capture_output=True,
                                                                      text=True).stdout)[:2])
FEATURES = {
    "the root's color": ("color='#c22'", "<rect x='200' y='150' width='800' height='600' fill='currentColor'/>"),
    "the root's opacity": ("opacity='0.4'", BLUE),
    "the root's fill rule": ("fill-rule='evenodd'", "<path d='M100 100H1100V800H100ZM300 300H900V600H300Z'/>"),
    "the root's caps": ("stroke-linecap='round' stroke='#123' stroke-width='90'", "<path d='M300 300H900M300 600H900' fill='none'/>"),
    "the root's transform": ("transform='rotate(9) scale(0.8)'", BLUE),
    "the root's clipping path": ("clip-path='url(#c)'", "<clipPath id='c'><circle cx='500' cy='400' r='250'/></clipPath>" + BLUE),
    "a copy in a clipping path": ("", "<defs><rect id='s' x='300' y='200' width='300' height='500'/></defs>"
                                  "<clipPath id='c'><use xlink:href='#s' x='40' overflow='visible'/></clipPath><g clip-path='url(#c)'>" + BLUE + "</g>"),
    "what overhangs the page": ("", "<rect x='-400' y='300' width='2000' height='300' fill='#2a4'/>"),
    "an inner viewport": ("", "<svg x='200' y='100' width='500' height='300' viewBox='0 0 10 10'><circle cx='5' cy='5' r='8' fill='#a31'/></svg>"),
    "an inner viewport with a clipping path": ("", "<clipPath id='c'><circle cx='500' cy='400' r='250'/></clipPath><svg clip-path='url(#c)'>" + BLUE + "</svg>"),
    "a copy of a viewport": ("", "<defs><svg id='v' width='300' height='200'><rect width='900' height='900' fill='#284'/></svg></defs><use href='#v' x='300' y='300'/>"),
    "a gradient with percentages": ("viewBox='0 0 600 450'", "<linearGradient id='g' gradientUnits='userSpaceOnUse' x2='100%'><stop stop-color='#f00'/>"
                                    "<stop offset='1' stop-color='#00f'/></linearGradient><rect x='50' y='50' width='500' height='350' fill='url(#g)'/>"),
    "a stroke with percentages": ("viewBox='0 0 600 450'", "<path d='M100 200H500' stroke='#123' stroke-width='20%'/>"),
    "a pattern with a clipping path": ("", "<clipPath id='c'><circle cx='20' cy='20' r='15'/></clipPath><pattern id='p' width='40' height='40' "
                                       "patternUnits='userSpaceOnUse'><rect width='40' height='40' fill='#a3a' clip-path='url(#c)'/></pattern>"
                                       "<rect x='200' y='150' width='400' height='300' fill='url(#p)'/>"),
    "a pattern of the bounding box": ("", "<pattern id='p' width='.25' height='.25'><rect width='90' height='70' fill='#a3a'/></pattern>"
                                      "<rect x='200' y='150' width='400' height='300' fill='url(#p)'/>"),
    "ids that others would use": ("", "<linearGradient id='cage'><stop stop-color='#f00'/><stop offset='1' stop-color='#00f'/></linearGradient>"
                                  "<linearGradient id='bent-1'><stop stop-color='#0a0'/><stop offset='1' stop-color='#aa0'/></linearGradient>"
                                  "<rect width='1200' height='450' fill='url(#cage)'/><rect y='450' width='1200' height='450' fill='url(#bent-1)'/>"),
    "a gradient on a flat line": ("", "<linearGradient id='g'><stop stop-color='#f00'/></linearGradient>" + BLUE +
                                  "<path d='M100 400H1100' stroke='url(#g)' stroke-width='30'/>"),
    "a mask's region": ("", "<mask id='m' x='0.25' y='0.25' width='0.5' height='0.5'><rect width='1200' height='900' fill='#fff'/></mask>"
                        "<g mask='url(#m)'>" + BLUE + "</g>"),
    "a switch between languages": ("", "<switch><g systemLanguage='xx'><rect width='900' height='900' fill='#f00'/></g><g>" + BLUE + "</g></switch>"),
    "markers without a stroke": ("", "<marker id='m' markerWidth='60' markerHeight='60' refX='15' refY='15'><circle cx='15' cy='15' r='15'/></marker>"
                                 "<path d='M200 200H900V600' fill='none' marker-start='url(#m)' marker-end='url(#m)'/>"),
    "text in parts": ("", "<text font-size='90'><tspan x='700' y='500'>Words</tspan></text>"),
    "a small frame": ("", "<g transform='scale(1e-9)'><path d='M2e11 4e11H9e11' stroke='#123' stroke-width='1e11'/></g>"),
    "names with a prefix": ("prefix", "<s:rect x='200' y='150' width='800' height='600' fill='#24c'/>"),
    "a copy of a viewport with a size": ("", "<defs><svg id='v'><rect width='900' height='900' fill='#284'/></svg></defs>"
                                         "<use href='#v' x='300' y='300' width='300' height='200'/>"),
    "a filter": ("", "<filter id='f'><feGaussianBlur stdDeviation='20'/></filter><g filter='url(#f)'>" + BLUE + "</g>")
}


def premultiplied(image):
    pixels = numpy.asarray(image.convert("RGBA")).astype(float)
    pixels[..., :3] *= pixels[..., 3:] / 255
    return pixels


def cubics_of(data):
    """The cubics of path data that has only the commands M, L, C and Z."""
    curves, at, start = [], None, None
    for command, text in re.findall(r"([A-Za-z])([^A-Za-z]*)", data):
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
        self.seed = seed_of(self.id())
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
        if method in ("pins", "arap", "har_arap", "bounded", "puppet", "sheet"):
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
        for name in few_or_many(["fish", "gecko", "tiger"], SAMPLES):
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
        for method in few_or_many(["cage", "arap", "angles", "puppet", "sheet"], METHODS):
            with self.subTest(method):
                average, far = self.compare(self.write("a.json", self.method_scene(method, "a.svg", w, h, 50)))
                print(f"{method}: {average:.2f} on average, {100 * far:.3f} % differ much", file=sys.stderr)
                self.assertLess(average, 0.6)
                self.assertLess(far, 0.002)

    def test_curves_follow_the_map_of_every_method(self):
        w, h = 1200, 800
        shapes = []
        for _ in range(few_or_many(2, 12)):
            # Inside the cage, which has no corners.
            points = [complex(self.chance.uniform(150, w - 150), self.chance.uniform(120, h - 120)) for _ in range(4)]
            shapes.append(points)
        text = "".join("<path fill='none' stroke='#123' stroke-width='3' d='M{0.real} {0.imag}C{1.real} {1.imag} {2.real} {2.imag} {3.real} {3.imag}'/>"
                       .format(*points) for points in shapes)
        self.write("a.svg", f"<svg xmlns='http://www.w3.org/2000/svg' width='{w}' height='{h}'>{text}</svg>")
        for method in few_or_many(METHODS[::2], METHODS):
            with self.subTest(method):
                scene = self.write("a.json", self.method_scene(method, "a.svg", w, h, 40))
                svg, _ = self.exported(scene)
                corner = self.good("render", scene, "--out", self.path("r.png"), "--force").stderr
                left, bottom = map(float, re.search(r"corner at \((.*), (.*)\)", corner).groups())
                height = self.size_of("r.png")[1]
                written = [placed_cubics_of(path) for path in ElementTree.parse(svg).iter(SVG + "path") if path.get("fill") == "none"]
                self.assertEqual(len(written), len(shapes))
                dense = few_or_many(10001, 20001)
                rest = numpy.concatenate([sampled([points], dense) for points in shapes])
                self.write("p.csv", "\n".join(f"{z.real!r},{h - z.imag!r}" for z in rest.tolist()))
                out = self.good("map", scene, "--points", self.path("p.csv")).stdout
                lines = [line for line in out.splitlines() if re.match(r"[-+]?\d", line)]
                x, y = numpy.loadtxt(lines, delimiter=",", usecols=(0, 1), unpack=True)
                self.assertEqual(len(x), len(rest))
                mapped = x - left + 1j * (bottom + height - y)
                for exact, curves in zip(mapped.reshape(-1, dense), written):
                    ours = sampled(curves, 9)
                    # The distance to the nearest segment between exact points, which are dense because the
                    # segments cut off kinks, in the neighborhoods of the nearest eight of every tenth point.
                    near = numpy.argpartition(abs(ours[:, None] - exact[::10]), 8, axis=1)[:, :8]
                    near = (10 * near[:, :, None] + numpy.arange(-10, 10)).reshape(len(ours), -1).clip(0, len(exact) - 2)
                    a, b = exact[near], exact[near + 1]
                    along = b - a
                    to = ours[:, None] - a
                    t = numpy.clip((to * along.conj()).real / numpy.maximum(abs(along) ** 2, 1e-30), 0, 1)
                    self.assertLess(abs(to - t * along).min(axis=1).max(), 0.055)
                    # And nothing is missing.
                    self.assertLess(abs(exact[::400, None] - sampled(curves, 257)).min(axis=1).max(), 8)
                    self.assertLess(abs(ours[0] - exact[0]) + abs(ours[-1] - exact[-1]), 0.2)

    def test_features_of_drawings_stay(self):
        rest = [[5, 5], [1195, 5], [1195, 895], [5, 895]]
        for feature, (root, content) in list(FEATURES.items())[::few_or_many(2, 1)]:
            with self.subTest(feature):
                name = "s:svg" if root == "prefix" else "svg"
                self.write("a.svg", f"<{name} xmlns='http://www.w3.org/2000/svg' xmlns:s='http://www.w3.org/2000/svg' "
                           f"xmlns:xlink='http://www.w3.org/1999/xlink' width='1200' height='900' {root if root != 'prefix' else ''}>{content}</{name}>")
                pose = [[[x + self.chance.uniform(-20, 20), y + self.chance.uniform(-20, 20)]] for x, y in rest]
                path = self.write("a.json", {"format": "holomorph", "version": 1, "image": {"file": "a.svg"}, "method": {"id": "cage"},
                                             "cage": {"rest": [[p] for p in rest], "pose": pose}})
                if feature == ("a copy of a viewport" if RSVG >= (2, 60) else "a copy of a viewport with a size"):
                    continue  # SVG 2 wants both to be clipped; rsvg-convert clips the one or the other, depending on its version
                average, far = self.compare(path, "--rect", "50,50,1100,800")
                self.assertLess(far, 0.02 if "pattern" in feature else 0.003)
                self.assertLess(average, 3)
                self.assertGreater(numpy.asarray(Image.open(self.path("rendered.png")))[..., 3].max(), 90, "the drawing is not empty")

    def test_nothing_that_runs_or_loads_is_written(self):
        self.write("a.svg", """<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='900' height='900' onload='a()'>
            <style>@font-face{font-family:f;src:url(http://e.x/f)} rect{fill:url(http://e.x/g)}</style><script>alert(1)</script>
            <defs><foreignObject><iframe srcdoc='x'/></foreignObject><pattern id='p'><embed src='javascript:1'/></pattern></defs>
            <a xlink:href='javascript:alert(1)'><text onclick='a()'>T<set attributeName='xlink:href' to='javascript:1'/></text></a>
            <image href='http://e.x/i.png' width='9' height='9'/><image href='/etc/passwd' width='9' height='9'/>
            <a href='https://e.y/page'><text>Page</text></a>
            <use href='http://e.x/u.svg#a'/><rect ONCLICK='a()' width='99' height='99' filter='url(http://e.x/f#a)'/></svg>""")
        path = self.write("a.json", {"format": "holomorph", "version": 1, "image": {"file": "a.svg"},
                                     "cage": {"rest": [[p] for p in ([5, 5], [890, 5], [890, 890])]}})
        svg, said = self.exported(path)
        with open(svg) as file:
            text = file.read().lower()
        for word in ("script", "onclick", "onload", "e.x", "passwd", "foreignobject", "iframe", "embed", "<set"):
            self.assertNotIn(word, text)
        self.assertIn("https://e.y/page", text, "links to web pages stay")
        self.assertIn("its linked pictures are left out", said)
        self.assertIn("its animation is left out", said)

    def test_a_drawing_shows_no_other_file(self):
        Image.new("RGB", (90, 90), (255, 0, 0)).save(self.path("red.png"))
        red = self.path("red.png")
        start = "<svg xmlns='http://www.w3.org/2000/svg' width='90' height='90'>"
        self.write("red.svg", start + "<rect id='r' width='90' height='90' fill='#f00'/></svg>")
        names = ("red.png", "./red.png", red, "file:" + red, "file://" + red, "red.svg", "red.svg#r",
                 "file://" + self.path("red.svg#r"))
        images = "".join(f"<{tag} href='{name}' width='90' height='90'/>" for tag in ("image", "use") for name in names)
        self.write("a.svg", f"<?xml-stylesheet href='red.css'?>{start}<style>@import 'red.css';</style>"
                   f"<rect width='90' height='90'/>{images}</svg>")
        self.write("red.css", "rect { fill: #f00 }")
        path = self.write("a.json", {"format": "holomorph", "version": 1, "image": {"file": "a.svg"},
                                     "cage": {"rest": []}})
        self.good("render", path, "--allow-outside", "--out", self.path("a.png"))
        self.assertEqual(numpy.asarray(Image.open(self.path("a.png")))[..., :3].max(), 0, "all of it is black")

    def test_a_drawing_that_takes_too_long_is_ended(self):
        # 100,000 shapes from a few lines, each of them blurred.
        levels = "".join(f"<g id='g{k}'>" + 10 * f"<use href='#g{k - 1}'/>" + "</g>" for k in range(1, 6))
        self.write("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='900' height='900'><filter id='f'>"
                   "<feGaussianBlur stdDeviation='90'/></filter><defs><g id='g0'><rect width='900' height='900' "
                   f"filter='url(#f)'/></g>{levels}</defs><use href='#g5'/></svg>")
        self.bad("--max-reader-seconds", "1", "new", self.path("a.svg"), "--out", self.path("n.json"),
                 says="a.svg: drawing this file takes too long; the limit is 1 s. Start with --max-reader-seconds 2 to raise it")

    def test_drawings_are_opened_in_their_size_between_1024_and_4096_pixels(self):
        for width, height, pixels in (("2000", "1000", (2000, 1000)), ("20in", "10in", (1920, 960)),
                                      ("30", "60", (512, 1024)), ("9000", "900", (4096, 410))):
            self.write("a.svg", f"<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}'>"
                       "<rect width='9' height='9'/></svg>")
            path = self.write("a.json", {"format": "holomorph", "version": 1, "image": {"file": "a.svg"},
                                         "cage": {"rest": []}})
            self.good("render", path, "--force", "--out", self.path("a.png"))
            self.assertEqual(self.size_of("a.png"), pixels)

    def test_a_small_drawing_keeps_its_size(self):
        self.write("icon.svg", "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 24 12' width='24' height='12'><circle cx='6' cy='6' r='5'/></svg>")
        path = self.write("a.json", {"format": "holomorph", "version": 1, "image": {"file": "icon.svg"}, "cage": {"rest": []}})
        svg, _ = self.exported(path)
        root = ElementTree.parse(svg).getroot()
        self.assertEqual((root.get("width"), root.get("height"), root.get("viewBox")), ("24", "12", "0 0 1024 512"))
        self.bad("export", path, "--format", "drawing", "--out", self.path("a.png"), says="must end in .svg")

    def test_copies_of_copies_are_refused_before_they_fill_the_memory(self):
        levels = "".join(f"<g id='l{k}'>" + f"<use href='#l{k - 1}'/>" * 10 + "</g>" for k in range(1, 7))
        clips = "<clipPath id='c'>" + "<circle r='99'/>" * 300 + "</clipPath>" + "<g clip-path='url(#c)'><rect width='9' height='9'/></g>" * 1000
        bomb = "<defs><circle id='l0' r='9'/>" + levels + "</defs><use href='#l6'/>"
        for content, says in ((bomb, "rsvg-convert cannot draw"), (clips, "with all copies, the drawing has more than")):
            self.write("a.svg", f"<svg xmlns='http://www.w3.org/2000/svg' width='900' height='900'>{content}</svg>")
            path = self.write("a.json", {"format": "holomorph", "version": 1, "image": {"file": "a.svg"}, "cage": {"rest": []}})
            self.bad("export", path, "--format", "drawing", "--out", self.path("out.svg"), says=says)

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
            self.assertLessEqual({"layer-1-g", "layer-3-g", "layer-5-g"}, set(ids), "the gradients of the drawings")
            self.assertNotIn("g", ids)

    def test_clipped_ink_on_soft_edges_has_no_fringe(self):
        """Pictures whose alpha falls off slowly, and light or dark ink that is clipped to them."""
        for _ in range(4):
            layers = []
            for i, dark in enumerate((True, False, True)):
                y, x = numpy.mgrid[0:120, 0:160]
                pixels = numpy.zeros((120, 160, 4), numpy.uint8)
                pixels[..., :3] = [self.chance.randrange(0, 90) if dark else self.chance.randrange(160, 256) for _ in range(3)]
                fall = self.chance.uniform(3, 8)
                pixels[..., 3] = numpy.clip((55 - numpy.hypot(x - 80, y - 60)) * fall, 0, 255) if i == 0 else 255
                Image.fromarray(pixels, "RGBA").save(self.path(f"{i}.png"))
                layers.append({"image": {"file": f"{i}.png"}, "cage": {"rest": []}, "clipped": i > 0,
                               "opacity": 1 if i == 0 else self.chance.choice([1, 0.6]),
                               "blending": "normal" if i == 0 else self.chance.choice(["normal", "multiply", "screen", "overlay"])})
            background = self.chance.choice([{}, {"background": "#ffffff"}, {"background": "#204060"}])
            path = self.write("soft.json", {"format": "holomorph", "version": 2, "layers": layers, **background})
            svg, _ = self.exported(path)
            self.good("render", path, "--out", self.path("soft.png"), "--force")
            ours, theirs = premultiplied(Image.open(self.path("soft.png"))), premultiplied(self.drawn(svg))
            self.assertLess(numpy.abs(ours - theirs).max(), 4, [layer["blending"] for layer in layers])
            if background == {}:  # the alpha is that of the base
                self.assertLess(numpy.abs(theirs[..., 3] - numpy.asarray(Image.open(self.path("0.png")))[..., 3]).max(), 2)

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

    def test_texts_are_turned_by_the_map_where_they_are_drawn(self):
        """Whatever point of a text its position is."""
        cage, matrices = self.random_cage(1100, 300, 9), []
        for anchor, x in (("start", 300), ("middle", 400), ("end", 500)):
            self.write("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='1100' height='300'>"
                       f"<text x='{x}' y='200' font-size='80' text-anchor='{anchor}'>Words</text></svg>")
            path = self.write("a.json", {"format": "holomorph", "version": 1, "image": {"file": "a.svg"}, "cage": cage})
            out, _ = self.exported(path)
            text = next(node for node in ElementTree.parse(out).iter() if node.tag.endswith("text"))
            numbers = [float(x) for x in re.findall(r"-?[\d.]+(?:e-?\d+)?", text.get("transform"))]
            self.assertEqual(len(numbers), 6, text.get("transform"))
            matrices.append(numbers)
        for numbers in matrices[1:]:
            for mine, other in zip(numbers, matrices[0]):
                self.assertAlmostEqual(mine, other, delta=1e-3 * max(1, abs(other)))

    def test_losses_are_said(self):
        self.write("a.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='1100' height='300'>"
                   "<text x='100' y='200' font-size='80'>Words</text></svg>")
        path = self.write("a.json", {"format": "holomorph", "version": 2,
                                     "layers": [{"name": "Sign", "image": {"file": "a.svg"}, "cage": self.random_cage(1100, 300, 9)}]})
        _, said = self.exported(path)
        self.assertIn("Sign: its texts are moved and turned, but not bent", said)
        self.assertIn("1 layer of 1100 x 300 pixels; 1 is a drawing", said)

    def test_what_is_wrong_with_a_drawing_is_said(self):
        scene = {"format": "holomorph", "version": 1, "image": {"file": "a.svg"}, "cage": {"rest": []}}
        for content, says in (("<svg><path", "not an SVG file"), ("<svg xmlns='http://www.w3.org/2000/svg'/>", "size"),
                              ("<svg>" + "<g>" * 3000 + "</g>" * 3000 + "</svg>", "groups")):
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
    timed.main(sys.argv[3:])
