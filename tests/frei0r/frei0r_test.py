# The frei0r filter in ffmpeg: its frames have the bits of `render`.
import ctypes
import os
import random
import subprocess
import sys
import time

import numpy
from PIL import Image

FOLDER = sys.argv[3]
sys.path.append(os.path.join(sys.argv[2], "tests/cli"))
from case import Case, few_or_many, seed_of, timed  # noqa: E402

RATE = 25


class Frei0r(Case):
    def scene(self, rng, size, layers=1):
        """A picture of this size whose cage moves for four seconds, and small pictures on top of it."""
        w, h = size
        entries = []
        for i in range(layers):
            pw, ph = (w, h) if i == 0 else (w // 3, h // 4)
            picture = Image.effect_mandelbrot((pw, ph), (-2, -1, 1, 1), 30 + i).convert("RGB")
            picture = Image.merge("RGB", (picture.getchannel(0), Image.linear_gradient("L").resize((pw, ph)),
                                          Image.effect_noise((pw, ph), 60)))
            picture.save(self.path(f"{i}.png"))
            cage = [[pw * x, ph * y] for x, y in ((.2, .1), (.8, .15), (.9, .8), (.5, .6), (.15, .85))]
            keys = [{"time": t, "pose": {"cage": [[[x + rng.uniform(-.08, .08) * pw, y + rng.uniform(-.08, .08) * ph]]
                                                  for x, y in cage]}} for t in (0, 1.3, 2.5, 4)]
            entries.append({"name": f"layer {i}", "image": {"file": f"{i}.png"}, "cage": {"rest": [[p] for p in cage]},
                            "method": {"id": rng.choice(["cage", "harmonic", "mean_value"])}, "keyframes": keys})
        return self.write("scene.json", {"format": "holomorph", "version": 2, "animation": {"frames_per_second": RATE},
                                         "layers": entries, "edited": 0})

    def filtered(self, size, frames, parameters, source=None, words=(), more="", check=True):
        """The frames that ffmpeg makes of a picture, or of transparent frames, and what it prints."""
        w, h = size
        given = (["-loop", "1", "-framerate", str(RATE), "-i", source] if source else
                 ["-f", "lavfi", "-i", f"color=black@0:s={w}x{h}:r={RATE},format=rgba"])
        result = subprocess.run(
            ["ffmpeg", "-nostdin", "-loglevel", "error", *given, *words, "-frames:v", str(frames), "-vf",
             f"format=rgba{more},frei0r=holomorph:{parameters}", "-f", "rawvideo", "-pix_fmt", "rgba", "-"],
            capture_output=True, env=dict(os.environ, FREI0R_PATH=FOLDER))
        said = result.stderr.decode()
        if check:
            self.assertEqual(said, "")
        pixels = numpy.frombuffer(result.stdout, numpy.uint8)
        self.assertEqual(len(pixels), 4 * w * h * frames, said)
        return pixels.reshape(frames, h, w, 4), said

    def rendered(self, scene, first, last):
        self.good("render", scene, "--crop", "--frames", f"{first}..{last}", "--out", self.path("f.png"), "--force")
        return [numpy.asarray(Image.open(self.path(f"f-{i:04}.png")).convert("RGBA")) for i in range(first, last + 1)]

    def assert_same(self, frames, expected):
        self.assertEqual(len(frames), len(expected))
        for i, (a, b) in enumerate(zip(frames, expected)):
            self.assertTrue((a == b).all(), f"frame {i}")

    def test_frames_have_the_bits_of_render_in_both_modes(self):
        count = few_or_many(30, 100)
        for size in (few_or_many((640, 360), (1280, 720)), (322, 242)):  # rows of 322 pixels are padded, and then ffmpeg passes no times
            seed = seed_of(f"frames of {size}")
            with self.subTest(size=size, seed=seed):
                scene = self.scene(random.Random(seed), size, layers=2)
                expected = self.rendered(scene, 0, count - 1)
                self.assertTrue((expected[0] != expected[count // 2]).any())
                self.assert_same(self.filtered(size, count, f"{scene}|{RATE}|0", self.path("0.png"))[0], expected)
                self.assert_same(self.filtered(size, count, f"{scene}|{RATE}|1")[0], expected)

    def test_the_rate_of_the_scene_is_the_default(self):
        scene = self.scene(random.Random(3), (322, 242))
        self.assert_same(self.filtered((322, 242), 30, scene, self.path("0.png"))[0], self.rendered(scene, 0, 29))

    def test_frames_from_the_middle_of_a_film_show_their_own_time(self):
        size = (320, 240)
        scene = self.scene(random.Random(4), size)
        expected = self.rendered(scene, 20, 40)
        for rate in ("25", "0", "50/2"):
            frames, _ = self.filtered(size, 21, f"{scene}|{rate}|0", self.path("0.png"), more=",trim=start_frame=20")
            self.assert_same(frames, expected)

    def test_frames_of_another_size_are_warped_alike(self):
        scene = self.scene(random.Random(5), (320, 240))
        smooth = Image.merge("RGB", (Image.linear_gradient("L"), Image.linear_gradient("L").rotate(90), Image.radial_gradient("L")))
        smooth.resize((320, 240), Image.BICUBIC).save(self.path("0.png"))
        expected = self.rendered(scene, 30, 30)[0].astype(int)
        earlier = self.rendered(scene, 0, 0)[0].astype(int)
        for w, h in ((640, 480), (160, 120), (400, 240)):
            smooth.resize((w, h), Image.BICUBIC).save(self.path("other.png"))
            frames, _ = self.filtered((w, h), 31, f"{scene}|{RATE}|0", self.path("other.png"))
            frame = numpy.asarray(Image.fromarray(frames[30]).resize((320, 240), Image.BILINEAR)).astype(int)
            self.assertLess(numpy.mean(numpy.abs(frame - expected).max(axis=2) > 12), 0.04, (w, h))  # only at edges of the cage
            self.assertGreater(numpy.mean(numpy.abs(frame - earlier).max(axis=2) > 12), 0.1)
        unmoved = self.write("unmoved.json", {"format": "holomorph", "version": 1, "image": {"file": "0.png"}, "cage": {"rest": []}})
        smooth.resize((400, 100)).save(self.path("wide.png"))
        frames, _ = self.filtered((400, 100), 2, f"{unmoved}|25|0", self.path("wide.png"))
        wide = numpy.asarray(Image.open(self.path("wide.png")).convert("RGBA"))
        self.assertTrue((numpy.abs(frames[1].astype(int) - wide) <= 2)[1:-1].all())  # enlarged, so the edge is soft

    def test_a_scene_is_drawn_over_the_middle_of_a_frame(self):
        Image.new("RGB", (400, 300), (10, 200, 90)).save(self.path("film.png"))
        Image.new("RGBA", (50, 100), (250, 0, 0, 255)).save(self.path("red.png"))
        scene = self.write("red.json", {"format": "holomorph", "version": 1, "image": {"file": "red.png"}, "cage": {"rest": []}})
        frame = self.filtered((400, 300), 1, f"{scene}|25|1", self.path("film.png"))[0][0]
        expected = numpy.full((300, 400, 4), (10, 200, 90, 255))
        expected[:, 125:275] = (250, 0, 0, 255)
        same = (frame == expected).all(axis=2)
        self.assertTrue(same[2:-2, 127:273].all() and same[:, :125].all() and same[:, 275:].all())
        self.assertGreater(same.mean(), 0.99)  # enlarged pictures have soft edges

    def instance(self, size, scene, mode):
        library = ctypes.CDLL(os.path.join(FOLDER, "holomorph.so"))
        library.f0r_construct.restype = ctypes.c_void_p
        one = ctypes.c_void_p(library.f0r_construct(*size))
        library.f0r_set_param_value(one, ctypes.byref(ctypes.c_char_p(scene.encode())), 0)
        library.f0r_set_param_value(one, ctypes.byref(ctypes.c_double(mode)), 2)

        def update(time, frame):
            out = numpy.zeros_like(frame)
            library.f0r_update(one, ctypes.c_double(time), frame.ctypes.data_as(ctypes.c_void_p), out.ctypes.data_as(ctypes.c_void_p))
            return out
        return library, one, update

    def test_the_mode_and_the_scene_may_change_while_it_runs(self):
        size = (64, 48)
        scene = self.scene(random.Random(6), size)
        frame = numpy.random.default_rng(1).integers(0, 256, (48, 64, 4)).astype(numpy.uint8)
        frame[..., 3] = 255
        library, one, update = self.instance(size, scene, 0)
        fresh, other, update_over = self.instance(size, scene, 1)
        update(0, frame)
        warped = update(0.04, frame)
        over = update_over(0.04, frame)
        self.assertTrue((warped != over).any())
        for mode, expected in ((1, over), (0, warped), (1, over)):
            library.f0r_set_param_value(one, ctypes.byref(ctypes.c_double(mode)), 2)
            self.assertTrue((update(0.04, frame) == expected).all(), mode)
        time.sleep(1.1)  # the file is looked at once a second
        self.write("scene.json", {"format": "holomorph", "version": 1, "image": {"file": "0.png"}, "cage": {"rest": []}})
        os.utime(scene, (1, 1))
        plain = numpy.asarray(Image.open(self.path("0.png")).convert("RGBA"))
        self.assertTrue((update(0.04, frame) == plain).all())
        library.f0r_destruct(one)
        fresh.f0r_destruct(other)

    def test_a_single_pixel_and_scenes_without_their_picture(self):
        scene = self.scene(random.Random(7), (64, 48))
        os.remove(self.path("0.png"))
        frame = numpy.full((48, 64, 4), 200, numpy.uint8)
        library, one, update = self.instance((64, 48), scene, 0)  # frames replace the picture
        self.assertTrue((update(1, frame) != frame).any())
        library.f0r_destruct(one)
        tiny = numpy.full((1, 1, 4), 200, numpy.uint8)
        library, one, update = self.instance((1, 1), scene, 0)
        update(0, tiny)
        library.f0r_destruct(one)

    def test_what_is_wrong_is_said_once_and_frames_stay(self):
        Image.effect_noise((64, 48), 80).convert("RGB").save(self.path("film.png"))
        film = numpy.asarray(Image.open(self.path("film.png")).convert("RGBA"))
        broken = self.write("broken.json", "{")
        Image.new("RGB", (64, 48)).save(self.path("a.png"))
        layer = {"image": {"file": "a.png"}, "cage": {"rest": []}, "name": "a"}
        hidden = self.write("hidden.json", {"format": "holomorph", "version": 2, "layers": [{**layer, "visible": False}, layer],
                                            "edited": 0})
        lost = self.write("lost.json", {"format": "holomorph", "version": 1, "image": {"file": "lost.png"}, "cage": {"rest": []}})
        for parameters, says in ((self.path("none.json"), "none.json"), (broken, "broken.json"),
                                 (f"{hidden}|25|0", "the edited layer is hidden"), (f"{lost}|25|1", "lost.png"),
                                 (f"{self.scene(random.Random(1), (64, 48))}|fast", "the frame rate 'fast'")):
            frames, said = self.filtered((64, 48), 3, parameters, self.path("film.png"), check=False)
            self.assert_same(frames, [film] * 3)
            self.assertEqual(said.count("holomorph:"), 1)
            self.assertIn(says, said)
        frames, said = self.filtered((64, 48), 2, "", self.path("film.png"), check=False)  # no scene yet
        self.assert_same(frames, [film] * 2)
        self.assertEqual(said.count("the parameter Scene must be"), 1)

    def test_parameters_are_listed_and_can_be_read_back(self):
        class Info(ctypes.Structure):
            _fields_ = [("name", ctypes.c_char_p), ("type", ctypes.c_int), ("explanation", ctypes.c_char_p)]

        library = ctypes.CDLL(os.path.join(FOLDER, "holomorph.so"))
        library.f0r_construct.restype = ctypes.c_void_p
        names = []
        for i in range(3):
            info = Info()
            library.f0r_get_param_info(ctypes.byref(info), i)
            names.append(info.name.decode())
        self.assertEqual(names, ["Scene", "Frame rate", "Mode"])
        one = ctypes.c_void_p(library.f0r_construct(8, 8))
        for i, text in enumerate((b"a scene.json", b"24")):
            library.f0r_set_param_value(one, ctypes.byref(ctypes.c_char_p(text)), i)
            read = ctypes.c_char_p()
            library.f0r_get_param_value(one, ctypes.byref(read), i)
            self.assertEqual(read.value, text)
        mode = ctypes.c_double(1)
        library.f0r_set_param_value(one, ctypes.byref(mode), 2)
        read = ctypes.c_double()
        library.f0r_get_param_value(one, ctypes.byref(read), 2)
        self.assertEqual(read.value, 1)
        library.f0r_destruct(one)


if __name__ == "__main__":
    timed.main(sys.argv[4:])
