# Files with layers, judged by psd-tools: what it sees of our files is what we draw.
import io
import os
import random
import sys
import zipfile
from xml.etree import ElementTree

import numpy
from PIL import Image
from psd_tools import PSDImage
from psd_tools.composite import composite

from case import Case, seed_of, timed

MODES = ["normal", "multiply", "screen", "overlay", "add"]


def premultiplied(image):
    pixels = numpy.asarray(image.convert("RGBA")).astype(float)
    pixels[..., :3] *= pixels[..., 3:] / 255
    return pixels


class Layered(Case):
    def scene(self, rng, count, size=(160, 120), soft=True):
        """A scene of bent discs and their colors, with random ink."""
        w, h = size
        y, x = numpy.mgrid[0:h, 0:w]
        layers = []
        for i in range(count):
            pixels = numpy.zeros((h, w, 4), numpy.uint8)
            distance = numpy.hypot(x - rng.uniform(40, w - 40), y - rng.uniform(40, h - 40))
            for k in range(3):
                pixels[..., k] = (x * rng.uniform(0, 1.5) + y * rng.uniform(0, 1.5) + rng.randrange(99)) % 256
            pixels[..., 3] = numpy.clip((rng.uniform(30, 70) - distance) * (rng.choice([5, 50]) if soft else 1e9), 0, 255)
            pixels[pixels[..., 3] == 0] = 0
            Image.fromarray(pixels, "RGBA").save(self.path(f"{i}.png"))
            cage = [[10, 10], [w - 10, 10], [w - 10, h - 10], [10, h - 10]]
            posed = [[[px + rng.uniform(-9, 9), py + rng.uniform(-9, 9)]] for px, py in cage]
            layers.append({"name": rng.choice(["sky", "Straße", "漢字"]) + str(i), "image": {"file": f"{i}.png"},
                           "cage": {"rest": [[p] for p in cage], "pose": posed} if soft else {"rest": []},
                           "opacity": rng.choice([1, 0.5, 0.8]), "blending": rng.choice(MODES), "visible": rng.random() < 0.8})
        layers[0]["visible"] = True
        background = rng.choice([{}, {"background": "#204060"}, {"background": "original"}])
        return {"format": "holomorph", "version": 2, "layers": layers, **background}

    def written(self, scene, *options):
        """The render, and the PSD file as psd-tools reads it."""
        path = self.write("scene.json", scene)
        self.good("render", path, "--out", self.path("whole.png"), "--force", *options)
        self.good("export", path, "--format", "psd", "--out", self.path("layers.psd"), "--force", *options)
        return Image.open(self.path("whole.png")), PSDImage.open(self.path("layers.psd"))

    def difference(self, scene, *options):
        whole, psd = self.written(scene, *options)
        color, _, alpha = composite(psd, force=True)
        self.assertEqual(whole.size, color.shape[1::-1])
        seen = 255 * numpy.dstack([color * alpha, alpha])
        return numpy.abs(numpy.rint(premultiplied(whole)) - numpy.rint(seen)).max()

    def test_psd_tools_sees_what_is_drawn(self):
        for seed in (1, 2, seed_of("layered files", 3)):
            with self.subTest(seed=seed):
                rng = random.Random(seed)
                scene = self.scene(rng, rng.randint(1, 6))
                options = rng.choice([(), ("--crop",), ("--scale", "0.7"), ("--rect", "20,10,90,80")])
                self.assertLessEqual(self.difference(scene, *options), 1, (seed, options))

    def test_psd_tools_sees_clipped_layers(self):
        """With bases whose pixels are opaque or absent; psd-tools shows clipping to faint pixels differently."""
        for seed in (1, seed_of("layered files", 2)):
            with self.subTest(seed=seed):
                rng = random.Random(seed)
                scene = self.scene(rng, 5, soft=False)
                for layer in scene["layers"][1:]:
                    layer["clipped"] = rng.random() < 0.6
                self.assertLessEqual(self.difference(scene), 1, seed)
                _, psd = self.written(scene)
                layers = [layer for layer in psd.descendants(include_clip=False) if layer.name[-1].isdigit()]
                self.assertEqual([bool(layer.clipping_layer) for layer in layers],
                                 [layer.get("clipped", False) for layer in scene["layers"]])

    def test_names_and_ink_are_kept(self):
        scene = self.scene(random.Random(4), 4)
        scene.pop("background", None)
        _, psd = self.written(scene)
        modes = {"normal": "NORMAL", "multiply": "MULTIPLY", "screen": "SCREEN", "overlay": "OVERLAY", "add": "LINEAR_DODGE"}
        self.assertEqual([(l.name, l.visible, l.opacity, l.blend_mode.name) for l in psd],
                         [(l["name"], l["visible"], round(255 * l["opacity"]), modes[l["blending"]]) for l in scene["layers"]])

    def test_names_that_xml_does_not_allow_are_written_with_spaces(self):
        scene = self.scene(random.Random(8), 3)
        names = ["a\x01b\x0b<&\"", "\ufffe\uffff c", "d\x7f\t"]
        for layer, name in zip(scene["layers"], names):
            layer["name"] = name
        path = self.write("names.json", scene)
        self.good("export", path, "--format", "ora", "--out", self.path("n.ora"))
        self.good("export", path, "--format", "drawing", "--out", self.path("n.svg"))
        with zipfile.ZipFile(self.path("n.ora")) as archive:
            stack = ElementTree.fromstring(archive.read("stack.xml"))
        written = [layer.get("name") for layer in stack.iter("layer")][::-1][-3:]
        self.assertEqual([name.split() for name in written], [["a", "b", "<&\""], ["c"], ["d"]])
        drawing = ElementTree.parse(self.path("n.svg"))
        label = "{http://www.inkscape.org/namespaces/inkscape}label"
        written = [group.get(label) for group in drawing.iter("{http://www.w3.org/2000/svg}g") if group.get(label)][-3:]
        self.assertEqual([name.split() for name in written], [["a", "b", "<&\""], ["c"], ["d"]])

    def test_exported_layers_open_again_and_look_the_same(self):
        for seed in (5, seed_of("layered files", 6)):
            with self.subTest(seed=seed):
                rng = random.Random(seed)
                scene = self.scene(rng, 4)
                scene.pop("background", None)
                for layer in scene["layers"][1:]:
                    layer["clipped"] = rng.random() < 0.5
                whole, _ = self.written(scene)
                for kind in ("psd", "ora"):
                    out = self.path("again." + kind)
                    self.good("export", self.path("scene.json"), "--format", kind, "--out", out, "--force")
                    self.good("new", out, "--out", self.path("again.json"), "--force")
                    self.good("render", self.path("again.json"), "--out", self.path("again.png"), "--force")
                    # The program cages the uppermost layer, whose edge is drawn from the mesh.
                    again = premultiplied(Image.open(self.path("again.png")))
                    self.assertEqual(again.shape, premultiplied(whole).shape)
                    if kind == "psd":
                        self.assertLessEqual(numpy.abs(again - premultiplied(whole)).max(), 1, (seed, kind))

    def test_open_raster_has_what_readers_expect(self):
        self.written(self.scene(random.Random(6), 3))
        self.good("export", self.path("scene.json"), "--format", "ora", "--out", self.path("a.ora"))
        with zipfile.ZipFile(self.path("a.ora")) as archive:
            self.assertEqual(archive.infolist()[0].filename, "mimetype")
            self.assertEqual(archive.read("mimetype"), b"image/openraster")
            self.assertIsNone(archive.testzip())
            merged = Image.open(io.BytesIO(archive.read("mergedimage.png")))
            small = Image.open(io.BytesIO(archive.read("Thumbnails/thumbnail.png")))
        self.assertEqual(merged.tobytes(), Image.open(self.path("whole.png")).convert("RGBA").tobytes())
        self.assertLessEqual(max(small.size), 256)

    def test_what_the_formats_cannot_do_is_refused(self):
        path = self.write("scene.json", self.scene(random.Random(7), 2))
        self.bad("export", path, "--format", "psd", "--out", self.path("a.psd"), "--frames", "all", says="--frames cannot be used with psd")
        self.assertFalse(os.path.exists(self.path("a.psd")))


if __name__ == "__main__":
    timed.main(sys.argv[3:])
