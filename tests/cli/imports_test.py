# Pictures as other programs write them: the colors that are read, and what is said about the rest.
import gzip
import io
import json
import random
import struct
import sys
import zipfile

import numpy
from PIL import Image
from psd_tools import PSDImage

from case import Case, seed_of, timed
from psd_writer import CMYK, COLORS, DUOTONE, GRAY, INDEXED, LAB, NONE, RGB, RUNS, ZIP, ZIP_DIFFERENCES, psd

def srgb_of_lab(lab):
    """CIELAB (D50) as 8-bit sRGB, by the formulas of CIE 15 and IEC 61966-2-1, adapted to D65 by the Bradford matrix."""
    l, a, b = lab[0] * 100 / 255, lab[1] - 128.0, lab[2] - 128.0
    fy = (l + 16) / 116
    f = numpy.stack([fy + a / 500, fy, fy - b / 200])
    xyz = numpy.where(f > 6 / 29, f ** 3, 3 * (6 / 29) ** 2 * (f - 4 / 29)) * numpy.array([0.9642, 1, 0.8249])[:, None, None]
    linear = numpy.einsum("ij,jrc->irc", numpy.array([[3.1338561, -1.6168667, -0.4906146], [-0.9787684, 1.9161415, 0.0334540],
                                                      [0.0719453, -0.2289914, 1.4052427]]), xyz).clip(0, 1)
    return 255 * numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


class Imports(Case):
    def planes(self, rng, count, height, width, depth, calm=False):
        """Smooth random planes; `calm` keeps Lab colors within sRGB."""
        y, x = numpy.mgrid[0:height, 0:width]
        most = (1 << depth) - 1
        planes = []
        for k in range(count):
            value = 0.5 + 0.5 * numpy.sin(x * rng.uniform(-0.4, 0.4) + y * rng.uniform(-0.4, 0.4) + rng.uniform(0, 6))
            if calm:
                value = 0.3 + 0.4 * value if k == 0 else 0.47 + 0.06 * value
            planes.append(numpy.rint(most * value).astype(int))
        return planes

    def seen(self, mode, depth, planes):
        """The 8-bit sRGB of planes, as the specification says."""
        eight = [(plane + 128) // 257 if depth == 16 else plane for plane in planes]
        if mode in (GRAY, DUOTONE):
            eight = [eight[0]] * 3
        if mode == CMYK:
            eight = [plane * eight[3] / 255 for plane in eight[:3]]
        if mode == LAB:
            eight = srgb_of_lab(eight)
        return numpy.dstack(list(eight))

    def opened(self, data, says=None):
        """The picture that a file without a cage shows, and what was said when it was opened."""
        with open(self.path("a.psd"), "wb") as file:
            file.write(data)
        said = self.good("new", self.path("a.psd"), "--out", self.path("a.json"), "--force").stderr
        if says:
            self.assertIn(says, said)
        with open(self.path("a.json")) as file:
            scene = json.load(file)
        for layer in scene.get("layers", [scene]):
            layer["cage"] = {"rest": []}
        with open(self.path("a.json"), "w") as file:
            json.dump(scene, file)
        self.good("render", self.path("a.json"), "--out", self.path("a.png"), "--force")
        return numpy.asarray(Image.open(self.path("a.png")).convert("RGBA")).astype(float), said

    def test_flat_psd_files_have_their_colors(self):
        for seed in (1, seed_of("flat PSD files", 2)):
            rng = random.Random(seed)
            for mode in (GRAY, RGB, CMYK, DUOTONE, LAB):
                for depth in (8, 16):
                    for packing in (NONE, RUNS):
                        with self.subTest(seed=seed, mode=mode, depth=depth, packing=packing):
                            planes = self.planes(rng, COLORS[mode], 20, 31, depth, mode == LAB)
                            says = {CMYK: "CMYK", LAB: "Lab", DUOTONE: "duotone"}.get(mode, "16 bits" if depth == 16 else None)
                            shown, _ = self.opened(psd(31, 20, mode, depth, packing, planes), says)
                            self.assertEqual(shown[..., 3].min(), 255)
                            self.assertLessEqual(numpy.abs(shown[..., :3] - self.seen(mode, depth, planes)).max(), 2 if mode == LAB else 1)

    def test_indexed_and_bitmap_psd_files_have_their_colors(self):
        palette = bytes(random.Random(3).randrange(256) for _ in range(768))
        indices = numpy.random.RandomState(4).randint(0, 5, (9, 13))
        shown, _ = self.opened(psd(13, 9, INDEXED, 8, RUNS, [indices], palette=palette, transparent=2))
        for k in range(3):
            expected = numpy.array([palette[256 * k + i] for i in range(5)])[indices]
            self.assertEqual(numpy.abs(numpy.where(indices == 2, 0, shown[..., k] - expected)).max(), 0)
        self.assertTrue(((shown[..., 3] == 0) == (indices == 2)).all())
        ink = numpy.random.RandomState(5).randint(0, 2, (9, 13))
        bits = numpy.packbits(ink, axis=1).tobytes()
        shown, _ = self.opened(b"8BPS" + struct.pack(">H6xHIIHHIIIH", 1, 1, 9, 13, 1, 0, 0, 0, 0, 0) + bits)
        self.assertTrue((shown[..., 0] == 255 * (1 - ink)).all())

    def test_layers_of_all_kinds_are_read_as_psd_tools_reads_them(self):
        for seed in (1, seed_of("layers of PSD files", 3)):
            rng = random.Random(seed)
            for mode in (GRAY, RGB, CMYK, LAB):
                for depth in (8, 16):
                    for packing in (NONE, RUNS, ZIP, ZIP_DIFFERENCES):
                        with self.subTest(seed=seed, mode=mode, depth=depth, packing=packing):
                            height, width, left, top = rng.randint(3, 30), rng.randint(3, 30), rng.randint(-9, 20), rng.randint(-9, 20)
                            colors = self.planes(rng, COLORS[mode], height, width, depth, mode == LAB)
                            alpha = numpy.full((height, width), (1 << depth) - 1)
                            merged = self.planes(rng, COLORS[mode], 24, 32, depth)
                            data = psd(32, 24, mode, depth, packing if packing < ZIP else NONE, merged,
                                       [("paint", left, top, [alpha, *colors])])
                            if packing >= ZIP:  # only layers are packed in this way
                                data = psd(32, 24, mode, depth, packing, [], [("paint", left, top, [alpha, *colors])])
                                data += b"".join(plane.astype(">u2" if depth == 16 else "u1").tobytes() for plane in merged)
                                data = data[:12] + struct.pack(">H", len(merged)) + data[14:]
                                at = len(data) - sum(plane.size for plane in merged) * depth // 8 - 2
                                data = data[:at] + struct.pack(">H", NONE) + data[at + 2:]
                            judge = PSDImage.open(io.BytesIO(data))[0].numpy("color")
                            expected = numpy.dstack(colors) / ((1 << depth) - 1)
                            self.assertLessEqual(numpy.abs(judge - expected).max(), 1e-6, "the test writes what psd-tools reads")
                            shown, _ = self.opened(data)
                            canvas = numpy.zeros((24, 32, 4))
                            part = self.seen(mode, depth, colors)
                            for r in range(max(0, top), min(24, top + height)):
                                for c in range(max(0, left), min(32, left + width)):
                                    canvas[r, c] = [*part[r - top, c - left], 255]
                            self.assertEqual(shown.shape, canvas.shape)
                            self.assertEqual(numpy.abs(shown[..., 3] - canvas[..., 3]).max(), 0)
                            self.assertLessEqual(numpy.abs(shown - canvas).max(), 2 if mode == LAB else 1)

    def test_of_too_many_layers_the_topmost_open(self):
        shades = [[numpy.full((1, 1), 255)] + [numpy.full((1, 1), value)] * 3 for value in (10, 200)]
        layers = [("low" if i < 20 else "top", 0, 0, shades[i >= 20]) for i in range(420)]  # with 4 pixels each
        merged = [numpy.full((2, 2), 99)] * 3
        shown, said = self.opened(psd(2, 2, RGB, 8, NONE, merged, layers), "the lowest 20 of its layers")
        self.assertEqual(shown[0, 0].tolist(), [200, 200, 200, 255])
        with open(self.path("a.json")) as file:
            self.assertEqual({layer["name"] for layer in json.load(file)["layers"]}, {"top"})

    def test_drawings_in_utf_16_and_gzip_are_the_same_drawings(self):
        text = '<?xml version="1.0" encoding="{}"?><svg xmlns="http://www.w3.org/2000/svg" width="600" height="400"><title>Größe 𝔄</title>' \
               '<ellipse cx="300" cy="200" rx="200" ry="90" fill="#084"/></svg>'
        plain = text.format("UTF-8").encode()
        kinds = {"plain.svg": plain, "little.svg": text.format("UTF-16").encode("utf-16"), "big.svg": b"\xfe\xff" + text.format("UTF-16").encode("utf-16-be"),
                 "marked.svg": b"\xef\xbb\xbf" + plain, "packed.svgz": gzip.compress(plain), "packed.svg": gzip.compress(plain)}
        seen = {}
        for name, data in kinds.items():
            with open(self.path(name), "wb") as file:
                file.write(data)
            self.good("new", self.path(name), "--out", self.path("a.json"), "--force")
            self.good("render", self.path("a.json"), "--out", self.path("a.png"), "--force")
            self.good("export", self.path("a.json"), "--format", "drawing", "--out", self.path("bent.svg"), "--force")
            with open(self.path("a.png"), "rb") as picture, open(self.path("bent.svg"), "rb") as drawing:
                seen[name] = picture.read(), drawing.read().count(b"<path")
        for name in kinds:
            self.assertEqual(seen[name], seen["plain.svg"], name)
        wrong = (("cut.svgz", gzip.compress(plain)[:-20], "damaged or incomplete"),
                 ("bomb.svgz", gzip.compress(b"<svg>" + b" " * (80 << 20)), "more than 64 MB"))
        for name, data, says in wrong:
            with open(self.path(name), "wb") as file:
                file.write(data)
            self.bad("new", self.path(name), "--out", self.path("b.json"), says=says)

    def test_damaged_pictures_are_named_before_they_are_reported_on(self):
        frames = [Image.effect_noise((60, 40), 90).convert("RGB") for _ in range(3)]
        for kind in ("gif", "png", "webp", "tif"):
            frames[0].save(self.path("a." + kind), save_all=True, append_images=frames[1:])
            with open(self.path("a." + kind), "rb") as file:
                data = file.read()
            for length in (9, 40, len(data) // 4):
                with open(self.path("cut." + kind), "wb") as file:
                    file.write(data[:length])
                self.bad("new", self.path("cut." + kind), "--out", self.path("b.json"), says="cut." + kind)

    def test_a_damaged_zip_channel_is_said(self):
        planes = self.planes(random.Random(1), 4, 20, 20, 8)
        data = bytearray(psd(20, 20, RGB, 8, ZIP, [], [("paint", 0, 0, planes)]) + bytes(1200))
        for k in range(120):
            data[300 + k] ^= 0x5a
        with open(self.path("a.psd"), "wb") as file:
            file.write(data)
        self.bad("new", self.path("a.psd"), "--out", self.path("a.json"), "--force", says="damaged")

    def test_only_the_first_of_many_pictures_is_opened_and_this_is_said(self):
        frames = [Image.new("RGB", (20, 10), color) for color in ((250, 0, 0), (0, 250, 0), (0, 0, 250))]
        for kind, word in (("gif", "pictures"), ("png", "pictures"), ("webp", "pictures"), ("tif", "pages")):
            options = {"lossless": True} if kind == "webp" else {}
            frames[0].save(self.path("a." + kind), save_all=True, append_images=frames[1:], **options)
            said = self.good("new", self.path("a." + kind), "--out", self.path("a.json"), "--force").stderr
            self.assertIn(f"a.{kind}: only the first of its 3 {word} is opened", said)
            self.assertIn("of its 3", self.good("info", self.path("a.json")).stderr)
            self.good("render", self.path("a.json"), "--out", self.path("a.out.png"), "--force")
            color = Image.open(self.path("a.out.png")).convert("RGB").getpixel((10, 5))
            self.assertLessEqual(max(abs(a - b) for a, b in zip(color, (250, 0, 0))), 3, kind)
            frames[0].save(self.path("b." + kind))
            self.assertNotIn("first", self.good("new", self.path("b." + kind), "--out", self.path("b.json"), "--force").stderr)

    def test_a_group_of_openraster_that_blends_alone_is_said(self):
        """It matters if there is something below it."""
        data = io.BytesIO()
        Image.new("RGBA", (4, 4), (9, 9, 9, 255)).save(data, "PNG")
        shade, plain = '<layer name="shade" src="a.png" composite-op="svg:multiply"/>', '<layer name="ground" src="a.png"/>'
        for attributes, inside, below, lost in (('isolation="isolate"', shade, plain, True), ('opacity="0.5"', shade, plain, True),
                                                ('isolation="isolate"', shade, "", False), ('isolation="isolate"', plain, plain, False),
                                                ("", shade, plain, False), ('isolation="auto"', shade, plain, False)):
            with zipfile.ZipFile(self.path("g.ora"), "w") as archive:
                archive.writestr("mimetype", "image/openraster")
                archive.writestr("stack.xml", f'<image w="4" h="4"><stack><stack name="group" {attributes}>{inside}</stack>{below}</stack></image>')
                archive.writestr("a.png", data.getvalue())
            said = self.good("new", self.path("g.ora"), "--out", self.path("g.json"), "--force").stderr
            self.assertEqual("group: left out: the blending of the group" in said, lost, (attributes, inside, below, said))

    def test_openraster_layers_keep_their_opacity(self):
        """It is the layer's, and that of its groups; the pixels stay as they are. Older scenes, whose pixels had it, look
        the same."""
        rng = random.Random(seed_of("opacity of OpenRaster", 5))
        for _ in range(3):
            pixels = numpy.frombuffer(rng.randbytes(12 * 16 * 4), numpy.uint8).reshape(12, 16, 4)
            own, groups = rng.choice([0, 0.02, 0.35, 1]), rng.choice([0.5, 1])
            stack = (f"<image w='16' h='12'><stack><stack name='g' opacity='{groups}'><layer name='a' src='a.png' "
                     f"opacity='{own}'/></stack></stack></image>")
            buffer = io.BytesIO()
            Image.fromarray(pixels, "RGBA").save(buffer, "png")
            with zipfile.ZipFile(self.path("o.ora"), "w") as archive:
                archive.writestr("mimetype", "image/openraster")
                archive.writestr("stack.xml", stack)
                archive.writestr("a.png", buffer.getvalue())
            self.good("new", self.path("o.ora"), "--out", self.path("o.json"), "--force")
            with open(self.path("o.json")) as file:
                scene = json.load(file)
            layer = scene.get("layers", [scene])[0]
            self.assertAlmostEqual(layer.get("opacity", 1), own * groups)
            layer["cage"] = {"rest": []}
            older = json.loads(json.dumps(scene))
            first = older.get("layers", [older])[0]
            first.pop("opacity", None)
            for key in ("hash", "offset", "name"):
                first["image"].pop(key, None)
            for name, each in (("o.json", scene), ("older.json", older)):
                self.write(name, each)
                self.good("render", self.path(name), "--crop", "--out", self.path("o.png"), "--force")
                seen = numpy.asarray(Image.open(self.path("o.png")).convert("RGBA")).astype(int)
                self.assertLessEqual(numpy.abs(seen[..., 3] - own * groups * pixels[..., 3]).max(), 1, name)

    def test_vector_layers_of_openraster_are_drawn_and_others_are_named(self):
        picture = io.BytesIO()
        Image.new("RGBA", (40, 30), (0, 0, 200, 255)).save(picture, "png")
        stack = ('<image w="40" h="30"><stack><layer name="notes" src="data/notes.txt"/><text name="words"/>'
                 '<layer name="ink" src="data/ink.svg" x="10" y="5"/><layer name="paper" src="data/paper.png"/></stack></image>')
        with zipfile.ZipFile(self.path("a.ora"), "w") as archive:
            archive.writestr("mimetype", "image/openraster")
            archive.writestr("stack.xml", stack)
            archive.writestr("mergedimage.png", picture.getvalue())
            archive.writestr("data/paper.png", picture.getvalue())
            archive.writestr("data/ink.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="12" height="8"><rect width="12" height="8" fill="#c00"/></svg>')
        said = self.good("new", self.path("a.ora"), "--out", self.path("a.json")).stderr
        self.assertIn("notes: left out: the whole layer", said)
        self.assertIn("words: left out: the whole layer", said)
        self.good("render", self.path("a.json"), "--out", self.path("a.png"))
        shown = Image.open(self.path("a.png")).convert("RGB")
        self.assertEqual([shown.getpixel(at) for at in ((16, 9), (2, 2), (30, 9))], [(204, 0, 0), (0, 0, 200), (0, 0, 200)])


if __name__ == "__main__":
    timed.main(sys.argv[3:])
