# Films for players: colors, sizes and rates, judged by ffmpeg and ffprobe.
import json
import subprocess
import sys
from random import Random

import numpy
from PIL import Image

from case import Case, few_or_many, seed_of, timed

KINDS = (".mp4", ".webm")


class Films(Case):
    def setUp(self):
        super().setUp()
        self.random = Random(seed_of("films", 1))

    def film_of(self, pixels, kind, rate=24):
        """Exports a film of two frames that shows a picture, and returns its path."""
        Image.fromarray(pixels).save(self.path("picture.png"))
        key = {"time": 0, "pose": {"cage": []}}
        scene = self.write("scene.json", {
            "format": "holomorph", "version": 1, "image": {"file": "picture.png"}, "cage": {"rest": []},
            "animation": {"frames_per_second": rate}, "keyframes": [key, {**key, "time": 1 / rate}]})
        film = self.path("film" + kind)
        self.good("export", scene, "--format", kind[1:], "--force", "--out", film)
        return film

    def probed(self, film):
        entries = "stream=width,height,r_frame_rate,color_space,color_primaries,color_transfer,color_range"
        out = subprocess.run(["ffprobe", "-v", "error", "-select_streams", "v", "-show_entries", entries, "-of", "json", film],
                             check=True, capture_output=True).stdout
        return json.loads(out)["streams"][0]

    def decoded(self, film):
        """The first frame as a player shows it that knows nothing but BT.709."""
        size = self.probed(film)
        out = subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-frames:v", "1", "-vf",
                              "scale=in_color_matrix=bt709:in_range=tv:out_range=pc:flags=accurate_rnd+full_chroma_int,format=rgb24",
                              "-f", "rawvideo", "-"], check=True, capture_output=True).stdout
        return numpy.frombuffer(out, numpy.uint8).reshape(size["height"], size["width"], 3).astype(int)

    def test_colors_and_ramps_come_back_as_those_of_bt_709(self):
        sizes = [(96, 64), (97, 65), (1280, 720), (720, 576)] + few_or_many(0, 4) * [None]
        for size in sizes:
            width, height = size or (self.random.randrange(40, 900), self.random.randrange(40, 900))
            colors = [(220, 30, 40), (20, 200, 60), (30, 60, 200), tuple(self.random.randrange(256) for _ in range(3))]
            pixels = numpy.zeros((height, width, 4), numpy.uint8)
            pixels[..., 3] = 255
            for k, color in enumerate(colors):
                pixels[:height // 2, k * width // 4:(k + 1) * width // 4, :3] = color
            pixels[:height // 2, 3 * width // 4:, :3] = colors[3]
            pixels[height // 2:, :, :3] = numpy.linspace(0, 255, width).round()[None, :, None]
            for kind in KINDS:
                with self.subTest(width=width, height=height, kind=kind):
                    film = self.film_of(pixels, kind)
                    told = self.probed(film)
                    for key in ("color_space", "color_primaries", "color_transfer"):
                        self.assertEqual(told[key], "bt709", key)
                    self.assertEqual(told["color_range"], "tv")
                    shown = self.decoded(film)
                    for k, color in enumerate(colors):  # away from edges, where chroma is shared
                        inner = shown[4:height // 2 - 8, k * width // 4 + 8:(k + 1) * width // 4 - 8]
                        self.assertLessEqual(numpy.abs(numpy.median(inner, (0, 1)) - color).max(), 2, color)
                        self.assertLessEqual(numpy.abs(inner - color).max(), 8, color)  # of the encoder
                    ramp = numpy.median(shown[height // 2 + 8:height - 4, :width], 0)
                    self.assertLessEqual(numpy.abs(ramp - pixels[-1, :, :3].astype(int)).max(), 2)
                    # Odd sizes repeat the edge.
                    self.assertLessEqual(numpy.abs(shown[4:height // 2 - 8, -1] - colors[3]).max(), 3)
                    self.assertLessEqual(numpy.abs(shown[-1] - shown[height - 4]).max(), 3)

    def test_rates_are_ratios(self):
        pixels = numpy.full((48, 64, 4), 255, numpy.uint8)
        for rate, ratio in ((24, "24/1"), (30000 / 1001, "30000/1001"), (29.97, "30000/1001"), (23.976, "24000/1001"),
                            (59.94, "60000/1001"), (12.5, "25/2"), (30, "30/1"), (1, "1/1"), (120, "120/1")):
            with self.subTest(rate=rate):
                self.assertEqual(self.probed(self.film_of(pixels, ".mp4", rate))["r_frame_rate"], ratio)


if __name__ == "__main__":
    timed.main(sys.argv[3:])
