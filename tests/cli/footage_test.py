# Films and numbered pictures as pictures of layers. The films are made by ffmpeg. Each frame shows its own number as a
# row of black and white bars, so that no other decoder is needed to tell which frame was drawn.
import io
import json
import math
import os
import random
import subprocess
import sys
import zipfile
from fractions import Fraction

import jsonschema
import numpy
from PIL import Image

from case import PROGRAM, SOURCE, Case, few_or_many, seed_of, timed

BITS, BAR, HEIGHT = 9, 8, 48
WIDTH = BITS * BAR


def numbered_frame(number):
    """A picture that shows a number."""
    frame = numpy.zeros((HEIGHT, WIDTH, 4), numpy.uint8)
    frame[..., 3] = 255
    for bit in range(BITS):
        frame[:, bit * BAR:(bit + 1) * BAR, :3] = 255 * ((number >> bit) & 1)
    return frame


def number_in(picture):
    pixels = numpy.asarray(picture.convert("RGB"))
    return sum(1 << bit for bit in range(BITS) if pixels[HEIGHT // 2, bit * BAR + BAR // 2, 0] > 128)


def encode(name, count, rate, *options, sound=()):
    """A film of frames 0 to count - 1."""
    frames = b"".join(numbered_frame(k).tobytes() for k in range(count))
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pixel_format", "rgba", "-video_size",
                    f"{WIDTH}x{HEIGHT}", "-framerate", str(rate), "-i", "-", *sound, *options, name],
                   input=frames, check=True)


def shown_frame(clip, time):
    """The number of the frame that a clip shows, by its definition in exact numbers."""
    rate, start = Fraction(clip["frames_per_second"]), Fraction(str(clip.get("start", 0)))
    first, last = clip.get("first", 0), clip.get("last", clip["frames"] - 1)
    passed = math.floor((time - start) * rate)
    if clip.get("after") == "loop":
        return first + passed % (last - first + 1)
    return first + min(max(passed, 0), last - first)


H264 = ("-c:v", "libx264", "-pix_fmt", "yuv420p")


def yuv_of(color, red, blue):
    """The 8-bit Y, Cb and Cr of a color by ITU-R BT.709 or BT.601, which differ in the weights of red and blue."""
    r, g, b = (c / 255 for c in color)
    y = red * r + (1 - red - blue) * g + blue * b
    return [round(16 + 219 * y), round(128 + 224 * (b - y) / (2 - 2 * blue)), round(128 + 224 * (r - y) / (2 - 2 * red))]


class Footage(Case):
    def flat_film(self, size, yuv, *options, depth=8):
        """A film of one color, given by its samples."""
        name, (w, h) = self.path("flat.mp4"), size
        kind, data = ("yuv444p", "u1") if depth == 8 else ("yuv444p10le", "<u2")
        frame = b"".join(numpy.full(w * h, value, data).tobytes() for value in yuv)
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pixel_format", kind, "-video_size", f"{w}x{h}", "-framerate", "5",
                        "-i", "-", *(options or ("-c:v", "libx264", "-qp", "0")), name], input=3 * frame, check=True)
        self.said = self.good("new", name, "--out", self.path("flat.json"), "--force").stderr
        self.good("render", self.path("flat.json"), "--time", "0", "--out", self.path("flat.png"), "--force")
        return numpy.asarray(Image.open(self.path("flat.png")).convert("RGB"))[h // 2, w // 2].astype(int)

    def test_films_without_color_tags_are_read_as_players_read_them(self):
        rng = random.Random(seed_of("untagged films", 1))
        for size, red, blue in (((1280, 720), 0.2126, 0.0722), ((720, 480), 0.299, 0.114)):
            color = [rng.randrange(40, 216) for _ in range(3)]
            with self.subTest(size=size, color=color):
                self.assertLessEqual(numpy.abs(self.flat_film(size, yuv_of(color, red, blue)) - color).max(), 2)
                self.assertNotIn("HDR", self.said)

    def test_hdr_films_are_toned_down(self):
        """Gray stays gray, brighter stays brighter, black is black, and diffuse white (203 cd/m2) is nearly white."""
        for transfer, white in (("arib-std-b67", 0.75), ("smpte2084", 0.58)):
            shown = []
            for level in (0, 0.4 * white, 0.7 * white, white, 1):
                yuv = [round(64 + 876 * level), 512, 512]
                options = ("-c:v", "libx265", "-pix_fmt", "yuv444p10le", "-tag:v", "hvc1", "-x265-params",
                           f"log-level=error:lossless=1:colorprim=bt2020:transfer={transfer}:colormatrix=bt2020nc",
                           "-color_primaries", "bt2020", "-color_trc", transfer, "-colorspace", "bt2020nc")
                pixel = self.flat_film((64, 64), yuv, *options, depth=10)
                self.assertLessEqual(numpy.ptp(pixel), 2, (transfer, level, pixel))
                self.assertIn("HDR colors are toned down", self.said)
                shown.append(pixel[0])
            self.assertTrue((numpy.diff(shown) > 0).all(), (transfer, shown))
            self.assertLessEqual(shown[0], 2)
            self.assertTrue(170 <= shown[3] <= 250, (transfer, shown))

    def setUp(self):
        super().setUp()
        self.seed = seed_of(self.id())
        self.random = random.Random(self.seed)

    def scene(self, file, clip=None, **more):
        image = {"file": file}
        if clip is not None:
            image["clip"] = clip
        return self.write("scene.json", {"format": "holomorph", "version": 1, "image": image,
                                         "cage": {"rest": []}, **more})

    def bytes_of(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def frames_drawn(self, scene):
        self.good("render", scene, "--frames", "all", "--crop", "--out", self.path("drawn.png"))
        names = sorted(name for name in os.listdir(self.folder) if name.startswith("drawn-"))
        return [number_in(Image.open(self.path(name))) for name in names]

    def remove_drawn(self):
        for name in os.listdir(self.folder):
            if name.startswith("drawn-"):
                os.remove(self.path(name))

    def drawn_at(self, scene, time):
        self.good("render", scene, "--time", f"{float(time):.9g}", "--crop", "--out", self.path("one.png"))
        return number_in(Image.open(self.path("one.png")))

    def test_every_frame_is_the_right_one_in_any_order(self):
        kinds = [("film.mp4", H264 + ("-bf", "3")), ("film.mkv", H264 + ("-bf", "2")), ("film.mov", H264),
                 ("film.webm", ("-c:v", "libvpx-vp9", "-b:v", "1M", "-deadline", "realtime", "-cpu-used", "8")),
                 ("film.avi", ("-c:v", "mjpeg", "-q:v", "3", "-pix_fmt", "yuvj444p"))]
        for name, options in self.random.sample(kinds, few_or_many(3, 5)):
            rate = self.random.choice(["12", "24", "25", "30000/1001", "60"])
            count, group = self.random.randrange(40, 80), self.random.choice([1, 7, 30, 250])
            with self.subTest(film=name, rate=rate, count=count, group=group):
                encode(self.path(name), count, rate, *options, "-g", str(group))
                scene = self.scene(name, animation={"frames_per_second": float(Fraction(rate))})
                self.assertEqual(self.frames_drawn(scene), list(range(count)))
                for _ in range(4):
                    k = self.random.randrange(count)
                    self.assertEqual(self.drawn_at(scene, (k + Fraction(1, 2)) / Fraction(rate)), k)
            self.remove_drawn()

    def test_frames_that_last_longer_stay_until_the_next_one(self):
        count, rate = 90, 25
        kept = sorted(self.random.sample(range(1, count - 1), 40) + [0, count - 1])
        chosen = "+".join(f"eq(n,{k})" for k in kept)
        expected = [max(k for k in kept if k <= i) for i in range(count)]
        for name, group in (("film.mkv", "12"), ("film.mp4", "250")):
            encode(self.path(name), count, rate, "-vf", f"select='{chosen}'", "-vsync", "vfr", *H264, "-g", group)
            scene = self.scene(name, animation={"frames_per_second": rate})
            with self.subTest(film=name):
                self.assertEqual(self.frames_drawn(scene), expected)
                for k in self.random.sample(range(count), 5):
                    self.assertEqual(self.drawn_at(scene, Fraction(2 * k + 1, 2 * rate)), expected[k])
            self.remove_drawn()

    def test_trims_offsets_rates_and_loops(self):
        count = 50
        encode(self.path("film.mp4"), count, 25, *H264)
        for _ in range(few_or_many(5, 10)):
            clip = {"frames_per_second": self.random.choice([10, 24, 25, 29.97, 60]), "frames": count,
                    "first": self.random.randrange(0, 20), "last": self.random.randrange(20, 50),
                    "start": self.random.choice([0, round(self.random.uniform(-3, 3), 2)]),
                    "after": self.random.choice(["hold", "loop"])}
            scene = self.scene("film.mp4", clip)
            for _ in range(3):
                time = Fraction(self.random.randrange(0, 8000), 1000) + Fraction(1, 3000)
                with self.subTest(clip=clip, time=float(time)):
                    self.assertEqual(self.drawn_at(scene, time), shown_frame(clip, time))

    def test_numbered_pictures_play(self):
        for first, digits in ((self.random.randrange(0, 90), 4), (self.random.randrange(1, 9), 1), (95, 2)):
            names = [f"walk {n:0{digits}d}.png" for n in range(first, first + 12)]
            for k, name in enumerate(names):
                Image.fromarray(numbered_frame(k)).save(self.path(name))
            scene = self.scene(names[0], {"frames_per_second": 12}, animation={"frames_per_second": 12})
            with self.subTest(first=first, digits=digits):
                self.assertEqual(self.frames_drawn(scene), list(range(12)))
            for name in os.listdir(self.folder):
                os.remove(self.path(name))

    def test_numbered_pictures_in_other_folders_are_not_reached_by_links(self):
        os.mkdir(self.path("private"))
        for k in range(3):
            where = "private/b1.png" if k == 1 else f"b{k}.png"
            Image.fromarray(numbered_frame(k)).save(self.path(where))
        os.symlink(self.path("private/b1.png"), self.path("b1.png"))
        self.assertEqual(self.frames_drawn(self.scene("b0.png", {"frames_per_second": 24})), [0])
        self.remove_drawn()
        os.remove(self.path("b1.png"))
        os.symlink("b2.png", self.path("b1.png"))
        self.assertEqual(self.frames_drawn(self.scene("b0.png", {"frames_per_second": 24})), [0, 2, 2])

    def test_every_export_of_a_moment_shows_the_frame_of_that_moment(self):
        """Also of hidden layers, and of pictures that are textures."""
        for k in range(10):
            Image.fromarray(numbered_frame(100 + k)).save(self.path(f"c{k}.png"))
        frame = {"file": "c0.png", "clip": {"frames_per_second": 10}}
        cage = {"rest": [[[0, 0]], [[WIDTH, 0]], [[WIDTH, HEIGHT]], [[0, HEIGHT]]]}
        hidden = {"image": frame, "cage": {"rest": []}, "visible": False, "name": "hidden"}
        scene = self.write("scene.json", {"format": "holomorph", "version": 2, "edited": 1,
                                          "layers": [hidden, {"image": frame, "cage": cage, "name": "shown"}]})
        self.good("export", scene, "--format", "unwarp", "--time", "0.7", "--out", self.path("u.png"))
        self.assertEqual(number_in(Image.open(self.path("u.png"))), 107)
        self.good("export", scene, "--format", "ora", "--time", "0.3", "--out", self.path("o.ora"))
        with zipfile.ZipFile(self.path("o.ora")) as layers:
            names = [name for name in layers.namelist() if name.startswith("data/")]
            self.assertEqual(len(names), 2)
            for name in names:
                with layers.open(name) as file:
                    self.assertEqual(number_in(Image.open(file)), 103)
        self.good("export", scene, "--format", "glb", "--time", "0.5", "--out", self.path("g.glb"))
        model = self.bytes_of("g.glb")
        self.assertEqual(number_in(Image.open(io.BytesIO(model[model.index(b"\x89PNG"):]))), 105)

    def test_numbered_pictures_end_at_a_gap(self):
        for k in (0, 1, 2, 4):
            Image.fromarray(numbered_frame(k)).save(self.path(f"a{k:03d}.png"))
        scene = self.scene("a000.png", {"frames_per_second": 24})
        self.assertEqual(self.frames_drawn(scene), [0, 1, 2])

    def test_the_map_and_the_picture_move_together(self):
        """A film of a moving cage is, frame by frame, what a still picture of that frame gives."""
        count = 20
        for k in range(count):
            Image.effect_noise((60, 40), 60 + k).convert("RGBA").save(self.path(f"noise-{k:04d}.png"))
        moving = self.keyed_scene()
        moving["animation"] = {"frames_per_second": 24}
        moving["image"] = {"file": "noise-0000.png", "clip": {"frames_per_second": 24}}
        self.write("moving.json", moving)
        self.good("render", self.path("moving.json"), "--frames", "0..19", "--crop", "--out", self.path("m.png"))
        for k in self.random.sample(range(count), 6):
            still = dict(moving, image={"file": f"noise-{k:04d}.png"})
            self.write("still.json", still)
            self.good("render", self.path("still.json"), "--time", f"{k / 24:.12g}", "--crop", "--out",
                      self.path("s.png"))
            moved, expected = (numpy.asarray(Image.open(self.path(name))) for name in (f"m-{k:04d}.png", "s.png"))
            self.assertTrue(numpy.array_equal(moved, expected), f"frame {k}")

    def test_two_layers_play_at_different_times(self):
        encode(self.path("film.mp4"), 60, 30, *H264)
        layers = [{"image": {"file": "film.mp4", "clip": {"frames_per_second": 30}}, "cage": {"rest": []}},
                  {"image": {"file": "film.mp4", "clip": {"frames_per_second": 30, "start": 0.5}},
                   "cage": {"rest": []}, "placement": {"factor": [1, 0], "shift": [0, HEIGHT]}}]
        scene = self.write("two.json", {"format": "holomorph", "version": 2, "layers": layers})
        self.good("render", scene, "--time", "1.01", "--out", self.path("two.png"))
        both = Image.open(self.path("two.png"))
        self.assertEqual(both.size, (WIDTH, 2 * HEIGHT))
        self.assertEqual(number_in(both.crop((0, HEIGHT, WIDTH, 2 * HEIGHT))), 30)
        self.assertEqual(number_in(both.crop((0, 0, WIDTH, HEIGHT))), 15)

    def test_transparency_is_kept(self):
        frames = [numpy.zeros((HEIGHT, WIDTH, 4), numpy.uint8) for _ in range(6)]
        for frame in frames:
            frame[:, :WIDTH // 2] = (200, 60, 30, 255)
        for k, frame in enumerate(frames):
            Image.fromarray(frame).save(self.path(f"f-{k:04d}.png"))
        scene = self.scene("f-0000.png", {"frames_per_second": 24})
        self.good("export", scene, "--format", "webm", "--crop", "--out", self.path("alpha.webm"))
        again = self.write("again.json", {"format": "holomorph", "version": 1, "image": {"file": "alpha.webm"},
                                          "cage": {"rest": []}})
        self.good("render", again, "--time", "0.1", "--crop", "--out", self.path("one.png"))
        alpha = numpy.asarray(Image.open(self.path("one.png")).convert("RGBA"))[..., 3]
        self.assertGreater(alpha[:, :WIDTH // 2 - 4].min(), 240)
        self.assertLess(alpha[:, WIDTH // 2 + 4:].max(), 15)

    def test_the_original_behind_a_faint_frame_does_not_shine_through(self):
        """Opaque and faint frames take turns; none is drawn as if it were like the one before."""
        alphas = [255, 120, 255, 60]
        for k, alpha in enumerate(alphas):
            Image.new("RGBA", (WIDTH, HEIGHT), (200, 60, 30, alpha)).save(self.path(f"f-{k}.png"))
        cage = {"rest": [[[20, 20]], [[WIDTH - 20, 20]], [[WIDTH - 20, HEIGHT - 20]], [[20, HEIGHT - 20]]]}
        scene = self.write("faint.json", {"format": "holomorph", "version": 1, "image": {"file": "f-0.png", "clip": {"frames_per_second": 10}},
                                          "animation": {"frames_per_second": 10}, "cage": cage, "background": "original"})
        self.good("render", scene, "--frames", "all", "--crop", "--out", self.path("drawn.png"))
        whole = [numpy.asarray(Image.open(self.path(name)).convert("RGBA")) for name in sorted(os.listdir(self.folder)) if name.startswith("drawn-")]
        self.assertEqual(len(whole), len(alphas))
        for k, alpha in enumerate(alphas):
            self.good("render", scene, "--time", str(k / 10), "--crop", "--out", self.path("one.png"), "--force")
            alone = numpy.asarray(Image.open(self.path("one.png")).convert("RGBA"))
            self.assertEqual(numpy.abs(alone.astype(int) - whole[k]).max(), 0, k)
            self.assertLessEqual(numpy.abs(alone[5:-5, 5:-5, 3].astype(int) - alpha).max(), 1, k)

    def test_a_new_scene_of_a_film_has_its_rate_and_length(self):
        encode(self.path("film.mp4"), 33, 25, *H264)
        self.good("new", self.path("film.mp4"), "--out", self.path("new.json"))
        scene = json.loads(self.bytes_of("new.json"))
        self.assertEqual(scene["image"]["clip"], {"frames_per_second": 25.0, "frames": 33})
        self.assertEqual(scene["animation"]["frames_per_second"], 25.0)
        self.assertEqual(self.frames_drawn(self.path("new.json")), list(range(33)))

    def beeps(self, name):
        """The times at which sound begins in a film, in seconds."""
        sound = subprocess.run(["ffmpeg", "-v", "error", "-i", self.path(name), "-map", "a:0", "-ac", "1", "-ar", "48000",
                                "-f", "f32le", "-"], capture_output=True, check=True).stdout
        loud = numpy.abs(numpy.frombuffer(sound, numpy.float32)) > 0.05
        begins, last = [], 0
        for i in numpy.flatnonzero(loud):
            if not begins or i - last > 4800:
                begins.append(i / 48000)
            last = i
        return begins, len(loud) / 48000

    def test_sound_is_kept_if_asked(self):
        self.check_sound("mp4")

    def test_sound_is_kept_in_webm_films(self):
        self.check_sound("webm")

    def check_sound(self, kind):
        beep = "aevalsrc='0.6*sin(2*PI*880*t)*between(t,1,1.2)':d=3:s=44100"
        encode(self.path("film.mp4"), 75, 25, *H264, "-c:a", "aac", "-shortest", sound=("-f", "lavfi", "-i", beep))
        cases = [({}, [1.0]), ({"first": 10}, [0.6]), ({"start": 0.5}, [1.5]),
                 ({"first": 20, "last": 39, "after": "loop"}, [0.2]),
                 ({"frames_per_second": 50}, [0.5])]
        for clip, expected in cases:
            with self.subTest(clip=clip):
                scene = self.scene("film.mp4", {"frames_per_second": 25, **clip}, animation={"frames_per_second": 25})
                self.good("export", scene, "--format", kind, "--sound", "--crop", "--out", self.path("out." + kind))
                begins, length = self.beeps("out." + kind)
                self.assertEqual(len(begins), len(expected), begins)
                for begin, wanted in zip(begins, expected):
                    self.assertLess(abs(begin - wanted), 0.02)
                frames = json.loads(subprocess.run(
                    ["ffprobe", "-v", "error", "-count_packets", "-select_streams", "v:0", "-show_entries",
                     "stream=nb_read_packets", "-of", "json", self.path("out." + kind)], capture_output=True,
                    check=True).stdout)["streams"][0]["nb_read_packets"]
                self.assertLess(abs(length - int(frames) / 25), 0.05)

    def test_a_looping_film_repeats_its_sound(self):
        beep = "aevalsrc='0.6*sin(2*PI*880*t)*between(t,0.3,0.4)':d=1:s=48000"
        encode(self.path("film.mp4"), 25, 25, *H264, "-c:a", "aac", sound=("-f", "lavfi", "-i", beep))
        red = {"image": {"file": "film.mp4", "clip": {"frames_per_second": 25, "after": "loop", "start": 0.2}},
               "cage": {"rest": []}}
        long = dict(red, image={"file": "film.mp4", "clip": {"frames_per_second": 25, "start": 2}}, visible=False)
        scene = self.write("loops.json", {"format": "holomorph", "version": 2, "layers": [red, long],
                                          "animation": {"frames_per_second": 25}})
        self.good("export", scene, "--format", "mp4", "--sound", "--crop", "--out", self.path("out.mp4"))
        begins, _ = self.beeps("out.mp4")
        self.assertEqual(len(begins), 3, begins)
        for begin, wanted in zip(begins, (0.5, 1.5, 2.5)):
            self.assertLess(abs(begin - wanted), 0.02)

    def test_sound_that_is_not_there_is_said(self):
        encode(self.path("film.mp4"), 10, 25, *H264)
        scene = self.scene("film.mp4")
        self.bad("export", scene, "--format", "mp4", "--sound", "--out", self.path("out.mp4"), says="film with sound")
        self.bad("export", scene, "--format", "gif", "--sound", "--out", self.path("out.gif"), says="only mp4 and webm")
        self.assertFalse(os.path.exists(self.path("out.mp4")))

    def test_a_film_reads_no_other_file(self):
        """A playlist or a list of files with the name of a film must not be followed."""
        encode(self.path("secret.mp4"), 10, 25, *H264)
        for text in ("#EXTM3U\n#EXT-X-TARGETDURATION:10\n#EXTINF:1,\nsecret.mp4\n#EXT-X-ENDLIST\n",
                     "ffconcat version 1.0\nfile secret.mp4\n"):
            self.write("film.mp4", text)
            self.bad("info", self.scene("film.mp4"), says="film.mp4: not a film in a supported format")

    def test_what_cannot_be_read_is_said(self):
        self.write("film.mp4", "nothing")
        self.bad("info", self.scene("film.mp4"), says="film.mp4: not a film in a supported format")
        self.bad("info", self.scene("gone.mp4"), says="gone.mp4: no such file")
        os.mkfifo(self.path("pipe.mp4"))
        self.bad("info", self.scene("pipe.mp4"), says="pipe.mp4: this is not a regular file")
        Image.fromarray(numbered_frame(1)).save(self.path("plain.png"))
        self.bad("info", self.scene("plain.png", {}), says="does not end with a number")
        Image.fromarray(numbered_frame(1)).save(self.path("a1.png"))
        Image.new("RGBA", (10, 10)).save(self.path("a2.png"))
        self.bad("render", self.scene("a1.png", {}), "--time", "0.05", "--out", self.path("o.png"),
                 says="this frame has 10 x 10 pixels, and the others 72 x 48")
        encode(self.path("film.mp4"), 30, 25, *H264)
        self.bad("--max-frames", "20", "info", self.scene("film.mp4"), says="the film has 30")
        empty = self.path("empty")
        os.mkdir(empty)
        self.bad("info", self.scene("film.mp4"), says="install the package ffmpeg", status=1, env={"PATH": empty})
        for clip, says in (({"first": -1}, "/image/clip/first"), ({"first": 3, "last": 2}, "/image/clip/last"),
                           ({"after": "stop"}, "choose hold or loop"), ({"frames_per_second": 0}, "frames_per_second"),
                           ({"start": 1e9}, "/image/clip/start")):
            self.bad("info", self.scene("film.mp4", clip), says=says)

    def test_a_frame_that_takes_too_long_is_ended(self):
        encode(self.path("film.mp4"), 6, 25, *H264)
        os.mkdir(self.path("bin"))
        with open(self.path("bin/ffmpeg"), "w") as file:
            file.write("#!/bin/sh\nwhile :; do :; done\n")
        os.chmod(self.path("bin/ffmpeg"), 0o755)
        slow = {**os.environ, "PATH": self.path("bin") + ":" + os.environ["PATH"]}
        self.bad("--max-reader-seconds", "1", "render", self.scene("film.mp4"), "--time", "0", "--out", self.path("o.png"),
                 says="decoding frame 0 takes too long; the limit is 1 s. Start with --max-reader-seconds 2", env=slow)

    def test_frames_have_at_most_64_megapixels(self):
        subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", "color=s=8002x8000:r=1:d=1", "-pix_fmt", "monow",
                        "-c:v", "png", self.path("large.mkv")], check=True)
        self.bad("info", self.scene("large.mkv"), says="more than 64 megapixels")

    def test_a_damaged_film_never_shows_a_frame_too_early(self):
        encode(self.path("film.mkv"), 60, 25, *H264, "-g", "10")
        whole = self.bytes_of("film.mkv")
        drawn = False
        for _ in range(4):
            cut = self.random.randrange(len(whole) // 3, len(whole))
            with open(self.path("film.mkv"), "wb") as file:
                file.write(whole[:cut])
            scene = self.scene("film.mkv", animation={"frames_per_second": 25})
            result = subprocess.run([PROGRAM, "render", scene, "--frames", "all", "--crop", "--out", self.path("drawn.png")],
                                    capture_output=True, text=True, timeout=120)
            self.assertIn(result.returncode, (0, 2), result.stderr)
            drawn = drawn or result.returncode == 0
            if result.returncode == 0:
                names = sorted(n for n in os.listdir(self.folder) if n.startswith("drawn-"))
                numbers = [number_in(Image.open(self.path(n))) for n in names]
                self.assertEqual(numbers, sorted(numbers))
                self.assertTrue(all(number <= k for k, number in enumerate(numbers)), numbers)
            self.remove_drawn()
        self.assertTrue(drawn, "none of the damaged films could be read")

    def test_a_film_that_becomes_shorter_keeps_its_trims(self):
        for k in range(12):
            Image.fromarray(numbered_frame(k)).save(self.path(f"d{k:02d}.png"))
        clip = {"frames_per_second": 12, "first": 4, "last": 9}
        scene = self.scene("d00.png", clip, animation={"frames_per_second": 12})
        self.assertEqual(self.frames_drawn(scene), [4, 5, 6, 7, 8, 9])
        self.remove_drawn()
        for k in range(7, 12):
            os.remove(self.path(f"d{k:02d}.png"))
        self.assertEqual(self.frames_drawn(scene), [4, 5, 6])

    def test_frames_are_not_overwritten(self):
        for k in range(3):
            Image.fromarray(numbered_frame(k)).save(self.path(f"a-{k:04d}.png"))
        before = self.bytes_of("a-0002.png")
        scene = self.scene("a-0000.png", {})
        self.bad("render", scene, "--frames", "1..2", "--out", self.path("a.png"), says="picture that the scene deforms")
        self.assertEqual(self.bytes_of("a-0002.png"), before)

    def test_the_scene_is_valid_by_the_schema(self):
        with open(os.path.join(SOURCE, "schema/scene.schema.json")) as file:
            schema = json.load(file)
        encode(self.path("film.mp4"), 12, 25, *H264)
        self.good("new", self.path("film.mp4"), "--out", self.path("new.json"))
        scene = json.loads(self.bytes_of("new.json"))
        scene["image"]["clip"].update(first=1, last=9, start=-1.5, after="loop")
        jsonschema.validate(scene, schema)
        for wrong in ({"first": -1}, {"after": "stop"}, {"start": 1e9}, {"frames_per_second": 0}):
            scene["image"]["clip"] = wrong
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(scene, schema)


if __name__ == "__main__":
    timed.main(sys.argv[3:])
