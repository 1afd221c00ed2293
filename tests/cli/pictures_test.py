# Pictures with more than 8 bits: those of other programs are read, and ours are read by them.
import os
import random
import shutil
import struct
import subprocess
import sys
import zlib

import numpy
from PIL import Image

from case import Case, few_or_many, seed_of, timed


def srgb(linear):
    x = numpy.clip(linear, 0, 1)
    return 255 * numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def linear(srgb):
    x = srgb / 255
    return numpy.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def to_xyz(white, red, green, blue):
    """The matrix from linear colors to XYZ, by the definition of chromaticities."""
    corners = numpy.array([[x / y, 1, (1 - x - y) / y] for x, y in (red, green, blue)]).T
    x, y = white
    return corners * numpy.linalg.solve(corners, [x / y, 1, (1 - x - y) / y])


WHITE = (0.3127, 0.3290)
WIDE = ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046))  # Rec. 2020
WIDE_TO_SRGB = numpy.linalg.solve(to_xyz(WHITE, (0.64, 0.33), (0.30, 0.60), (0.15, 0.06)), to_xyz(WHITE, *WIDE))


def png16(samples, gamma=None, chromaticities=None, orientation=None):
    """A PNG file of 16-bit samples: height x width x channels. The orientation is that of Exif."""
    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
    height, width, channels = samples.shape
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in samples)
    file = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, {1: 0, 2: 4, 3: 2, 4: 6}[channels], 0, 0, 0))
    if gamma:
        file += chunk(b"gAMA", struct.pack(">I", round(gamma * 100000)))
    if chromaticities:
        file += chunk(b"cHRM", struct.pack(">8I", *(round(x * 100000) for x in chromaticities)))
    if orientation:
        file += chunk(b"eXIf", b"MM\0*" + struct.pack(">IHHHIHHI", 8, 1, 0x112, 3, 1, orientation, 0, 0))
    return file + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class DeepPictures(Case):
    def setUp(self):
        super().setUp()
        seed = seed_of(self.id())
        self.rng = numpy.random.default_rng(seed)

    def shown(self, name):
        """The picture as the program reads it."""
        self.good("render", self.scene_of(name), "--out", self.path("out.png"), "--force")
        return numpy.asarray(Image.open(self.path("out.png")).convert("RGBA")).astype(float)

    def oiio(self, *words):
        subprocess.run(["oiiotool", *words], check=True, cwd=self.folder, capture_output=True)

    def floats(self, name):
        """The channels of a picture as oiiotool reads them: 1 is white, and nothing is converted."""
        planes = []
        for channel in "RGBA":
            self.oiio("--no-autopremult", name, "--ch", channel, "--origin", "+0+0", "--fullpixels", "-d", "float",
                      "--compression", "none", "-o", "plane.tif")
            planes.append(numpy.asarray(Image.open(self.path("plane.tif"))).astype(float))
        return numpy.dstack(planes)

    def write_exr(self, name, pixels):
        """An OpenEXR file of floats."""
        planes = []
        for k in range(4):
            Image.fromarray(pixels[..., k].astype(numpy.float32), "F").save(self.path(f"plane-{k}.tif"))
            planes += [f"plane-{k}.tif"] + (["--chappend"] if k else [])
        self.oiio(*planes, "--chnames", "R,G,B,A", "-d", "float", "-o", name)

    def scene_of(self, name):
        return self.write("scene.json", {"format": "holomorph", "version": 1, "image": {"file": name}, "cage": {"rest": []}})

    def bent_scene(self, name, width, height, method):
        """A scene whose cage is moved at random."""
        box = [[0.1, 0.1], [0.5, 0.05], [0.9, 0.1], [0.95, 0.5], [0.9, 0.9], [0.5, 0.95], [0.1, 0.9], [0.05, 0.5]]
        rest = numpy.array(box) * (width, height)
        pose = rest + self.rng.uniform(-0.08, 0.08, rest.shape) * (width, height)
        cage = {"rest": [[[*p]] for p in rest.tolist()], "pose": [[[*p]] for p in pose.tolist()]}
        return self.write("scene.json", {"format": "holomorph", "version": 1, "image": {"file": name}, "cage": cage,
                                         "method": {"id": method}})

    def random_picture(self, opaque=False):
        pixels = self.rng.integers(0, 256, (37, 53, 4)).astype(numpy.uint8)
        if opaque:
            pixels[..., 3] = 255
        Image.fromarray(pixels).save(self.path("in.png"))
        return pixels.astype(float)

    def test_open_exr_of_every_kind(self):
        pixels = self.random_picture()
        solid = pixels[..., 3:] > 40  # below, premultiplied half floats have few steps
        for words in (["-d", "half", "--compression", "zip"], ["-d", "float", "--compression", "piz"],
                      ["-d", "float", "--compression", "none"], ["-d", "half", "--compression", "rle", "--tile", "16", "16"]):
            self.oiio("--no-autopremult", "in.png", "--colorconvert", "sRGB", "linear", "--premult", *words, "-o", "in.exr")
            shown = self.shown("in.exr")
            self.assertLessEqual(numpy.abs(shown - pixels)[..., 3].max(), 1, words)
            self.assertLessEqual((numpy.abs(shown - pixels) * solid).max(), 1, words)

    def test_gray_and_opaque_open_exr(self):
        pixels = self.random_picture(opaque=True)
        self.oiio("in.png", "--ch", "R,G,B", "--colorconvert", "sRGB", "linear", "-o", "rgb.exr")
        self.assertLessEqual(numpy.abs(self.shown("rgb.exr") - pixels).max(), 1)
        self.oiio("in.png", "--ch", "Y=R", "--colorconvert", "sRGB", "linear", "-o", "gray.exr")
        gray = self.shown("gray.exr")
        self.assertLessEqual(numpy.abs(gray[..., :3] - pixels[..., :1]).max(), 1)

    def test_only_the_display_window_is_shown(self):
        pixels = self.random_picture(opaque=True)
        self.oiio("in.png", "--colorconvert", "sRGB", "linear", "--origin", "+10-5", "--fullsize", "60x30+0+0", "-o", "moved.exr")
        shown = self.shown("moved.exr")
        self.assertEqual(shown.shape, (30, 60, 4))
        self.assertLessEqual(numpy.abs(shown[:, 10:] - pixels[5:35, :50]).max(), 1)
        self.assertEqual(shown[:, :10].max(), 0)

    def test_other_primaries_and_bright_colors(self):
        colors = self.rng.uniform(0, 1.2, (20, 30, 3))
        Image.fromarray((255 * numpy.clip(colors / 1.2, 0, 1)).round().astype(numpy.uint8)).save(self.path("c.png"))
        stored = 1.2 * (255 * numpy.clip(colors / 1.2, 0, 1)).round() / 255
        exact = srgb(stored @ WIDE_TO_SRGB.T)
        self.oiio("c.png", "--mulc", "1.2", "-d", "float", "--attrib:type=float[8]", "chromaticities",
                  "0.708,0.292,0.170,0.797,0.131,0.046,0.3127,0.3290", "-o", "wide.exr")
        self.assertLessEqual(numpy.abs(self.shown("wide.exr")[..., :3] - exact).max(), 1)

    def test_damaged_and_useless_open_exr_is_refused(self):
        self.random_picture()
        self.oiio("in.png", "-o", "in.exr")
        with open(self.path("in.exr"), "rb") as file:
            whole = file.read()
        for length in (4, 50, 300, len(whole) // 2, len(whole) - 10):
            with open(self.path("cut.exr"), "wb") as file:
                file.write(whole[:length])
            scene = self.write("scene.json", {"format": "holomorph", "version": 1, "image": {"file": "cut.exr"}, "cage": {"rest": []}})
            self.bad("render", scene, "--out", self.path("out.png"), "--force", says="cut.exr")
        self.oiio("in.png", "--ch", "Z=R", "-o", "depth.exr")
        scene = self.write("scene.json", {"format": "holomorph", "version": 1, "image": {"file": "depth.exr"}, "cage": {"rest": []}})
        self.bad("render", scene, "--out", self.path("out.png"), "--force", says="has no channels R, G, B or Y")

    def test_infinite_and_undefined_samples(self):
        Image.new("RGB", (4, 1), (255, 128, 0)).save(self.path("in.png"))
        for words in ([], ["--attrib:type=float[8]", "chromaticities", "0.708,0.292,0.170,0.797,0.131,0.046,0.3127,0.3290"]):
            self.oiio("in.png", "-d", "half", "--mulc", "1e30,1,1", *words, "-o", "inf.exr")
            self.assertEqual(self.shown("inf.exr")[0, 0, 0], 255)
            self.oiio("in.png", "-d", "float", "--subc", "1,1,1", "--divc", "0,1,1", *words, "-o", "nan.exr")
            self.assertEqual(self.shown("nan.exr")[0, 0, 3], 255)

    def test_files_with_thousands_of_channels_take_no_memory(self):
        many = ",".join(f"c{i}" for i in range(1000))
        self.oiio("--create", "16000x2", "1000", "-d", "float", "--chnames", many, "-o", "many.exr")
        scene = self.write("scene.json", {"format": "holomorph", "version": 1, "image": {"file": "many.exr"}, "cage": {"rest": []}})
        self.bad("render", scene, "--out", self.path("out.png"), "--force", says="takes too much memory")

    def test_linear_png_of_16_bits_keeps_dark_steps(self):
        wanted = numpy.arange(256.0).reshape(8, 32)
        samples = (65535 * linear(wanted)).round()
        for channels in (1, 3):
            with open(self.path("dark.png"), "wb") as file:
                file.write(png16(numpy.repeat(samples[..., None], channels, 2), 1))
            self.assertLessEqual(numpy.abs(self.shown("dark.png")[..., :3] - wanted[..., None]).max(), 1)
            self.assertEqual(self.shown("dark.png")[..., 3].min(), 255)
        colors = self.rng.integers(0, 65536, (20, 20, 4))
        with open(self.path("plain.png"), "wb") as file:
            file.write(png16(colors))
        self.assertLessEqual(numpy.abs(self.shown("plain.png") - colors / 257).max(), 0.51)
        wide = WHITE + WIDE[0] + WIDE[1] + WIDE[2]
        with open(self.path("wide.png"), "wb") as file:
            file.write(png16(colors, 1, wide))
        shown = self.shown("wide.png")
        self.assertLessEqual(numpy.abs(shown[..., :3] - srgb(colors[..., :3] / 65535 @ WIDE_TO_SRGB.T)).max(), 1.6)
        self.assertLessEqual(numpy.abs(shown[..., 3] - colors[..., 3] / 257).max(), 0.51)

    def test_what_is_not_bent_keeps_its_16_bits(self):
        colors = self.rng.integers(0, 65536, (20, 30, 4))
        colors[:, 10:, 3] = 65535
        colors[:5, :5, 3] = 0
        with open(self.path("in.png"), "wb") as file:
            file.write(png16(colors))
        self.good("render", self.scene_of("in.png"), "--depth", "16", "--out", self.path("out.png"))
        self.assertLess(numpy.abs(self.floats("out.png") * 65535 - colors).max(), 0.01)
        self.good("render", self.scene_of("in.png"), "--out", self.path("eight.png"))
        eight = numpy.asarray(Image.open(self.path("eight.png"))).astype(float)
        self.assertLessEqual(numpy.abs(eight - colors / 257).max(), 0.51)

    def test_profiles_of_16_bits_are_applied_exactly(self):
        colors = self.rng.integers(0, 65536, (20, 20, 4))
        with open(self.path("in.png"), "wb") as file:
            file.write(png16(colors, 1))
        self.good("render", self.scene_of("in.png"), "--depth", "16", "--out", self.path("out.png"))
        self.assertLess(numpy.abs(self.floats("out.png")[..., :3] - srgb(colors[..., :3] / 65535) / 255).max(), 2e-4)
        gray = numpy.arange(400).reshape(20, 20, 1) * 160
        with open(self.path("gray.png"), "wb") as file:
            file.write(png16(gray, 1))
        self.good("render", self.scene_of("gray.png"), "--depth", "16", "--out", self.path("out.png"), "--force")
        self.assertLess(numpy.abs(self.floats("out.png")[..., :3] - srgb(gray / 65535) / 255).max(), 2e-4)

    def test_open_exr_keeps_bright_and_dark_colors(self):
        pixels = numpy.exp2(self.rng.uniform(-14, 5, (20, 30, 4)))
        pixels[..., 3] = self.rng.uniform(0.05, 1, (20, 30))
        self.write_exr("in.exr", pixels)
        for depth, precision in ((32, 1e-5), (16, 1e-3)):
            self.good("render", self.scene_of("in.exr"), "--depth", depth, "--out", self.path("out.exr"), "--force")
            self.assertLess(numpy.abs(self.floats("out.exr") / pixels - 1).max(), precision)
        self.good("render", self.scene_of("in.exr"), "--out", self.path("usual.exr"))
        self.assertEqual((self.floats("usual.exr") == self.floats("out.exr")).all(), True)

    def test_bent_pictures_are_as_fine_as_exact_ones(self):
        """A gradient is linear in sRGB, so that bilinear samples are exact, and the color is known from the map. It changes
        by 10 of 65535 steps in a pixel."""
        y, x = numpy.mgrid[0:120, 0:160] + 0.5
        shade = (x / 160 + y / 120) / 40 + 0.3
        with open(self.path("in.png"), "wb") as file:
            file.write(png16((65535 * shade).round()[..., None]))
        for method in few_or_many(["arap"], ["cage", "mean_value", "harmonic", "arap"]):
            scene = self.bent_scene("in.png", 160, 120, method)
            self.good("render", scene, "--crop", "--depth", "16", "--out", self.path("out.png"), "--force")
            self.good("render", scene, "--crop", "--out", self.path("eight.png"), "--force")
            self.good("export", scene, "--format", "stmap", "--out", self.path("st.exr"), "--force")
            bent, st = self.floats("out.png"), self.floats("st.exr")
            inside = st[..., 3] == 1
            self.assertGreater(inside.mean(), 0.4)
            exact = (st[..., 0] + 1 - st[..., 1]) / 40 + 0.3
            off = numpy.abs(bent[..., 0] - exact)[inside]
            # Pictures are drawn with a mesh, ST-maps are closer to the map. Where the map folds, both may show other parts.
            self.assertLess(numpy.median(off), 4 / 65535, method)
            self.assertLess(numpy.quantile(off, 0.95), 20 / 65535, method)
            eight = numpy.asarray(Image.open(self.path("eight.png"))).astype(float)
            self.assertLessEqual(numpy.abs(eight / 255 - bent)[..., :3].max(), 1.01 / 255, method)
            self.assertGreater(len(numpy.unique((bent[..., 0] * 65535).round()[inside])), 500)

    def test_layers_are_put_together_with_all_bits(self):
        y, x = numpy.mgrid[0:40, 0:60]
        below = numpy.dstack([0.2 + 0.001 * x, 0.3 + 0 * x, 0.25 + 0.001 * y, 1 + 0 * x])
        above = numpy.dstack([0.6 + 0 * x, 0.002 * y, 0.1 + 0.001 * x, 0.5 + 0.005 * x])
        for name, pixels in (("below.png", below), ("above.png", above)):
            with open(self.path(name), "wb") as file:
                file.write(png16((65535 * pixels).round()))
        opacity = 0.4
        for blending, mixed in (("normal", lambda b, s: s), ("multiply", lambda b, s: b * s)):
            layers = [{"id": 1, "name": "below", "image": {"file": "below.png"}, "cage": {"rest": []}},
                      {"id": 2, "name": "above", "image": {"file": "above.png"}, "cage": {"rest": []},
                       "opacity": opacity, "blending": blending}]
            scene = self.write("layers.json", {"format": "holomorph", "version": 2, "layers": layers})
            self.good("render", scene, "--depth", "16", "--out", self.path("out.png"), "--force")
            alpha = (round(255 * opacity) / 255) * above[..., 3:]
            exact = (1 - alpha) * below[..., :3] + alpha * mixed(below[..., :3], above[..., :3])
            self.assertLess(numpy.abs(self.floats("out.png")[..., :3] - exact).max(), 3 / 65535, blending)

    def test_numbered_open_exr_frames_keep_their_colors(self):
        for i in range(3):
            self.write_exr(f"film-{i}.exr", numpy.full((8, 10, 4), [3 + i, 0.001 * (i + 1), 0.5, 1]))
        image = {"file": "film-0.exr", "clip": {"frames_per_second": 4}}
        scene = self.write("scene.json", {"format": "holomorph", "version": 1, "image": image, "cage": {"rest": []},
                                          "animation": {"frames_per_second": 4}})
        self.good("render", scene, "--out", self.path("still.exr"))
        self.assertLess(numpy.abs(self.floats("still.exr")[0, 0] / [3, 0.001, 0.5, 1] - 1).max(), 1e-3)
        self.good("render", scene, "--frames", "all", "--out", self.path("out.exr"))
        for i in range(3):
            self.assertLess(numpy.abs(self.floats(f"out-{i:04}.exr")[0, 0] / [3 + i, 0.001 * (i + 1), 0.5, 1] - 1).max(), 1e-3)

    def test_fine_pixels_go_wherever_those_of_8_bits_go(self):
        """Turned, trimmed, faded and put on a color: 16 bits are those of 8 bits before they are rounded."""
        colors = self.rng.integers(0, 65536, (30, 40, 4))
        with open(self.path("turned.png"), "wb") as file:
            file.write(png16(colors, orientation=6))
        self.good("render", self.scene_of("turned.png"), "--depth", "16", "--out", self.path("out.png"))
        self.assertLess(numpy.abs(self.floats("out.png") * 65535 - numpy.rot90(colors, -1)).max(), 0.01)
        colors[..., 3] = 65535
        colors[:6, :6, 3] = 0
        with open(self.path("in.png"), "wb") as file:
            file.write(png16(colors))
        rest = [[5, 5], [35, 5], [35, 25], [5, 25]]
        cage = {"rest": [[p] for p in rest], "pose": [[[x - 20, y + 8]] for x, y in rest]}
        layer = {"id": 1, "name": "one", "image": {"file": "in.png"}, "cage": cage, "method": {"id": "cage"}}
        for more, background in (({}, {}), ({"opacity": 0.4}, {}), ({"opacity": 0.4}, {"background": "#204060"})):
            scene = self.write("moved.json", {"format": "holomorph", "version": 2, "layers": [{**layer, **more}], **background})
            self.good("render", scene, "--depth", "16", "--out", self.path("out.png"), "--force")
            self.good("render", scene, "--out", self.path("eight.png"), "--force")
            fine = 255 * self.floats("out.png")
            eight = numpy.asarray(Image.open(self.path("eight.png")).convert("RGBA")).astype(float)
            self.assertEqual(fine.shape, eight.shape)
            self.assertGreater(fine.shape[1], 40)
            seen = eight[..., 3:] > 0
            self.assertLessEqual(numpy.abs(fine - eight)[..., 3].max(), 1.01)
            self.assertLessEqual((numpy.abs(fine - eight) * seen).max(), 1.5, (more, background))
            self.assertGreater(numpy.abs(fine - eight)[..., :3].max(), 0.2)

    def test_bright_layers_stay_bright(self):
        for name, value in (("below.exr", 3), ("above.exr", 10)):
            self.write_exr(name, numpy.full((6, 8, 4), [value, 0.5, 2, 1]))
        for blending in ("screen", "overlay", "add", "multiply"):
            layers = [{"id": i + 1, "name": name, "image": {"file": name}, "cage": {"rest": []}, "blending": blend}
                      for i, (name, blend) in enumerate((("below.exr", "normal"), ("above.exr", blending)))]
            scene = self.write("layers.json", {"format": "holomorph", "version": 2, "layers": layers})
            self.good("render", scene, "--out", self.path("out.exr"), "--force")
            red = self.floats("out.exr")[0, 0, 0]
            self.assertTrue(2.99 < red < 100, (blending, red))

    def test_nearly_transparent_and_endless_colors_become_numbers(self):
        pixels = numpy.full((4, 6, 4), [1e4, 1, 0, 1.0])
        pixels[0, :, 3] = 10.0 ** self.rng.integers(-40, -1, 6)
        pixels[1, 0] = [numpy.nan, numpy.inf, -numpy.inf, numpy.nan]
        self.write_exr("odd.exr", pixels)
        for name in ("out.exr", "out.png"):
            self.good("render", self.scene_of("odd.exr"), "--depth", "16", "--out", self.path(name))
            self.assertTrue(numpy.isfinite(self.floats(name)).all())

    def test_pictures_that_are_too_large_have_8_bits(self):
        colors = self.rng.integers(0, 65536, (300, 400, 4))
        with open(self.path("in.png"), "wb") as file:
            file.write(png16(colors))
        done = self.good("render", self.scene_of("in.png"), "--depth", "16", "--max-pixels", "0.7", "--out", self.path("out.png"))
        self.assertIn("--max-pixels", done.stderr)
        self.assertIn("it has 8 bits", done.stderr)
        self.assertLessEqual(numpy.abs(self.floats("out.png") * 65535 - colors).max(), 0.51 * 257)
        self.bad("render", self.scene_of("in.png"), "--depth", "16", "--scale", "3", "--max-pixels", "0.7",
                 "--out", self.path("large.png"), says="--max-pixels")

    def test_fine_pixels_count_five_times_and_those_of_png_seven_times(self):
        megapixels = 0.03
        with open(self.path("in.png"), "wb") as file:
            file.write(png16(self.rng.integers(0, 65536, (150, 200, 4))))
        self.oiio("in.png", "-d", "half", "-o", "in.exr")
        for name, factor in (("in.png", 7), ("in.exr", 5)):
            for more, fine in ((1.01, True), (0.99, False)):
                done = self.good("render", self.scene_of(name), "--depth", "16", "--scale", "0.5", "--max-pixels",
                                 megapixels * factor * more, "--out", self.path("out.png"), "--force")
                self.assertEqual("it has 8 bits" not in done.stderr, fine, (name, more))
        # What is drawn, of a picture with 8 bits, which counts once.
        self.random_picture()
        drawn = 4 * 37 * 4 * 53 / 1e6
        words = ["render", self.scene_of("in.png"), "--depth", "16", "--scale", "4", "--out", self.path("drawn.png"),
                 "--max-pixels"]
        self.bad(*words, drawn * 4.99, says="--max-pixels")
        self.good(*words, drawn * 5.01)

    def test_other_pictures_have_8_bits(self):
        samples = self.rng.integers(0, 65536, (20, 30, 4))
        samples[..., 3] = 65535
        with open(self.path("fine.png"), "wb") as file:
            file.write(png16(samples))
        for name in ("film-1.tif", "film-2.tif"):
            self.oiio("fine.png", "-d", "uint16", "-o", name)
        clip = {"format": "holomorph", "version": 1, "cage": {"rest": []},
                "image": {"file": "film-1.tif", "clip": {"frames_per_second": 4}}}
        fine = shutil.copy(self.scene_of("fine.png"), self.path("fine.json"))
        for scene in (fine, self.scene_of("film-1.tif"), self.write("clip.json", clip)):
            self.good("render", scene, "--depth", "16", "--out", self.path("out.png"), "--force")
            self.oiio("out.png", "--ch", "R", "-d", "float", "-o", "red.tif")
            steps = (65535 * numpy.asarray(Image.open(self.path("red.tif")))).round() % 257
            self.assertEqual(bool(steps.any()), scene == fine)

    def test_what_does_not_move_keeps_its_bits_beside_what_moves(self):
        noise = self.rng.integers(0, 256, (90, 120, 4)).astype(numpy.uint8)
        noise[..., 3] = 255
        Image.fromarray(noise).save(self.path("in.png"))
        rest = [[40, 30], [80, 30], [80, 60], [40, 60]]
        for method in few_or_many(["cage", "harmonic"], ["cage", "mean_value", "harmonic", "arap"]):
            pose = [[[x + self.rng.uniform(-9, 9), y + self.rng.uniform(-9, 9)]] for x, y in rest]
            scene = self.write("scene.json", {"format": "holomorph", "version": 1, "image": {"file": "in.png"},
                                              "cage": {"rest": [[p] for p in rest], "pose": pose},
                                              "method": {"id": method}})
            for name in ("out.png", "out.webp"):
                self.good("render", scene, "--out", self.path(name), "--force")
                moved = (numpy.asarray(Image.open(self.path(name)).convert("RGBA")) != noise).any(axis=2)
                self.assertGreater(moved.sum(), 500)
                moved[15:75, 25:95] = False
                self.assertEqual(moved.sum(), 0, (method, name))

    def test_depths_that_a_format_does_not_have(self):
        self.random_picture()
        scene = self.scene_of("in.png")
        for name, depth, says in (("a.png", 12, ".png has 8 or 16 bits"), ("a.jpg", 16, ".jpg has 8 bits"),
                                  ("a.exr", 8, ".exr has 16 or 32 bits")):
            self.bad("render", scene, "--depth", depth, "--out", self.path(name), says=says)
            self.assertFalse(os.path.exists(self.path(name)))


if __name__ == "__main__":
    timed.main(sys.argv[3:])
