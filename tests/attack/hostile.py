#!/usr/bin/env python3
"""Hostile files: whatever they claim, the program says what is wrong within 20 s and 2 GB."""
import json
import math
import os
import random
import shutil
import struct
import tempfile
import zlib

import attack

options = attack.arguments(__doc__, rounds=1)
MOST_SECONDS, MOST_MEGABYTES = 20, 2048
PNG_START = b"\x89PNG\r\n\x1a\n"
SQUARE = [[[10, 10]], [[60, 10]], [[60, 50]], [[10, 50]]]
MOVED = [[[10, 12]], [[60, 10]], [[60, 50]], [[10, 50]]]


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def png(width, height, pixels=None, before=b""):
    packed = zlib.compress((b"\0" + b"\x80" * 4 * width) * height if pixels is None else pixels, 9)
    return (PNG_START + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) + before
            + chunk(b"IDAT", packed) + chunk(b"IEND", b""))


def loop(corners, degree=1, radius=25):
    at = lambda k: [30 + radius * math.cos(2 * math.pi * k / corners), 30 + radius * math.sin(2 * math.pi * k / corners)]
    return [[at(i + k / degree) for k in range(degree)] for i in range(corners)]


class Round:
    """One set of files, each with the command that reads it. Sizes and names are random."""

    def __init__(self, folder, rng):
        self.folder, self.rng, self.cases = folder, rng, []
        self.write("p.png", png(64, 64))
        self.names()
        self.pictures()
        self.drawings()
        self.claims()
        self.options()

    def write(self, name, content):
        with open(os.path.join(self.folder, name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return name

    def add(self, title, *words, refused=False):
        """Adds a command. With `refused`, the program must reject it."""
        self.cases.append((title, words, refused))

    def scene(self, title, words=("info",), version=1, refused=False, **members):
        name = f"scene-{len(self.cases)}.json"
        content = {"format": "holomorph", "version": version, **members}
        if version == 1:
            content = {"image": {"file": "p.png"}, "cage": {"rest": SQUARE, "pose": MOVED}, **content}
        self.write(name, json.dumps(content))
        self.add(title, words[0], name, *words[1:], refused=refused)

    def names(self):
        """Names that do not refer to a picture of the scene."""
        os.mkfifo(os.path.join(self.folder, "pipe.png"))
        for a, b in (("one.png", "two.png"), ("two.png", "one.png")):
            os.symlink(a, os.path.join(self.folder, b))
        os.symlink("/etc/passwd", os.path.join(self.folder, "door.png"))
        odd = ["/etc/passwd", "../" * self.rng.randint(1, 30) + "etc/passwd", "file:///etc/passwd", "http://localhost/a.png",
               "/dev/zero", "/dev/stdin", "/dev/full", "/proc/self/mem", "/proc/self/pagemap", "/proc/self/environ", ".", "..", "-",
               "--help", "a\0b", "n" * self.rng.randint(256, 9000), "pipe.png", "one.png", "door.png", "p.png/", "p.png/x", "", " ", "\u202e.png"]
        for name in odd:
            for inside in ((), ("--allow-outside",)):
                self.scene(f"a picture called {name[:24]!r} {inside}", ("info", *inside), refused=True, image={"file": name})

    def pictures(self):
        """Small files that claim many pixels, or many passes over them."""
        side = lambda: self.rng.choice([16384, 16383, 15000, 65535, 2**31 - 1, 0])
        claims = {
            "a.png": png(min(side(), 2**31 - 1), 16384, b"\0" * 99),
            "text.png": png(4, 4, before=chunk(b"zTXt", b"a\0\0" + zlib.compress(b"x" * (200 << 20), 9))),
            "profile.png": png(4, 4, before=chunk(b"iCCP", b"a\0\0" + zlib.compress(b"\0" * (200 << 20), 9))),
            "a.gif": b"GIF89a" + struct.pack("<HHBBB", 16384, 16384, 0x80, 0, 0) + bytes(6) + b","
                     + struct.pack("<HHHHB", 0, 0, 16384, 16384, 0) + b"\2\2\x44\1\0;",
            "a.tga": struct.pack("<BBBHHBHHHHBB", 0, 0, 10, 0, 0, 0, 0, 0, 16384, min(side(), 65535), 32, 8) + b"\xff" + bytes(4),
            "a.bmp": b"BM" + struct.pack("<IHHI", 100, 0, 0, 54) + struct.pack("<IiiHHIIiiII", 40, 16384, -16384, 1, 32, 0, 0, 0, 0, 0, 0),
            "a.psd": b"8BPS" + struct.pack(">H6sHIIHH", 1, bytes(6), 4, 16384, 16384, 8, 3) + bytes(14),
            "a.tif": b"II*\0" + struct.pack("<I", 8) + struct.pack("<H", 4)
                     + b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in ((256, 16384), (257, 16384), (277, 4), (258, 8))) + bytes(4),
            "a.webp": b"RIFF" + struct.pack("<I", 30) + b"WEBPVP8X" + struct.pack("<I", 10) + bytes(4) + b"\xff\x3f\0\xff\x3f\0" + bytes(8),
            "codes.jpg": self.jpeg_with_many_codes(),
        }
        for name, content in claims.items():
            self.write(name, content)
            self.scene(f"{name} of {len(content)} bytes", refused=name not in ("text.png", "profile.png"), image={"file": name})
        flat = zlib.compressobj(9)
        rows = b"".join(flat.compress(bytes(1 + 4 * 12000)) for _ in range(12000)) + flat.flush()
        for i in range(3):  # each can be opened alone, but not all three together
            self.write(f"flat{i}.png", PNG_START + chunk(b"IHDR", struct.pack(">IIBBBBB", 12000, 12000, 8, 6, 0, 0, 0))
                       + chunk(b"IDAT", rows) + chunk(b"IEND", b""))
        self.scene("three pictures of 144 megapixels", version=2, refused=True,
                   layers=[{"image": {"file": f"flat{i}.png"}, "cage": {"rest": SQUARE}} for i in range(3)])
        self.scene("one picture of 144 megapixels", image={"file": "flat0.png"})

    def jpeg_with_many_codes(self):
        segment = lambda kind, content: b"\xff" + bytes([kind]) + struct.pack(">H", len(content) + 2) + content
        codes = bytes(self.rng.randint(0, 9)) + b"\xff" * 3
        codes = codes[:16].ljust(16, b"\0") + b"\xff" * 765
        return (b"\xff\xd8" + segment(0xdb, b"\0" + b"\1" * 64) + segment(0xc0, b"\x08\0\x10\0\x10\1\1\x11\0")
                + segment(0xc4, b"\0" + codes) + segment(0xc4, b"\x10" + codes) + segment(0xda, b"\1\1\0\0\x3f\0") + bytes(99))

    def drawings(self):
        depth = self.rng.randint(30000, 90000)
        self.write("deep.svg", "<g>" * depth + '<path d="M1 1L9 1L9 9Z"/>' + "</g>" * depth)
        self.write("long.svg", '<svg><path d="M0 0' + "".join(f"L{i} {i * i % 977}" for i in range(300000)) + 'Z"/></svg>')
        for name in ("deep.svg", "long.svg"):
            for use in ("--cage", "--outline"):
                self.add(f"{name} as {use}", "new", "p.png", use, name, "--out", "o.json", "--force", refused=True)
        thin = [f"v {self.rng.random()} 0 0" for _ in range(5)]
        self.write("thin.obj", "\n".join(thin) + "\nf 1 2 3\nf 2 3 4\nf 3 4 5\n")
        self.write("twice.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 0 0\nv 1 1 0\nf 3 4 5\n")
        for name in ("thin.obj", "twice.obj"):
            self.add(f"{name}, without area", "new", "p.png", "--outline", name, "--out", "o.json", "--force", refused=True)

    def claims(self):
        """Scenes that require a lot of work."""
        keys = ",".join(f'"k{i}":{i}' for i in range(100000))
        self.write("keys.json", '{"format":"holomorph","version":1,"cage":{"rest":%s},%s}' % (json.dumps(SQUARE), keys))
        self.add("100,000 unknown keys", "info", "keys.json")
        self.write("same.json", '{"format":"holomorph","version":1,"cage":{"rest":%s},"method":{"id":"pins","parameters":{%s}}}'
                   % (json.dumps(SQUARE), ",".join(['"smoothness":0.001'] * 100000)))
        self.add("one key 100,000 times", "info", "same.json")
        self.write("deep.json", '{"format":"holomorph","version":1,"cage":{"rest":[]},"a":' + "[" * 500000 + "]" * 500000 + "}")
        self.add("500,000 brackets", "info", "deep.json")
        self.write("long.json", '{"format":"holomorph","version":1,"cage":{"rest":%s},"a":[%s]}' % (json.dumps(SQUARE), ",".join("0" * 4700000)))
        self.add("9 MB of zeros", "info", "long.json")
        for corners, degree in ((5000, 1), (1000, 8), (5000, 8), (self.rng.randint(500, 2000), self.rng.randint(1, 8))):
            self.scene(f"a cage of {corners} segments of degree {degree}",
                       cage={"rest": loop(corners, degree), "pose": loop(corners, degree, 26)})
        cage = {"rest": loop(3000), "pose": loop(3000, 1, 26)}
        self.scene("50 layers with cages of 3000 points", ("render", "--out", "o.png"), version=2, refused=True,
                   layers=[{"image": {"file": "p.png"}, "cage": cage} for _ in range(50)])
        for seconds, rate in ((60, 24), (3600, 240)):
            film = dict(animation={"frames_per_second": rate}, keyframes=[{"time": 0}, {"time": seconds, "pose": {"cage": SQUARE}}])
            self.scene(f"one frame of {seconds} s at {rate}", ("render", "--frames", "0..0", "--out", "o.png"), **film)
        keyframes = [{"time": i, "pose": {"cage": SQUARE if i % 2 else MOVED}} for i in range(2000)]
        self.scene("a time among 2000 keyframes", ("render", "--time", "77.5", "--out", "o.png"), keyframes=keyframes)
        self.scene("an angle of 1e308", pins=[{"rest": [30, 30], "angle": 1e308}], method={"id": "pins"})
        far = [[[x, y]] for x, y in ((-9e7, -9e7), (9e7, -9e7), (9e7, 9e7), (-9e7, 9e7))]
        self.scene("coordinates of 9e7", cage={"rest": far})

    def options(self):
        for scale in ("1e6", "1e308", "nan", "-1", "1e-300", "inf", "0"):
            self.scene(f"--scale {scale}", ("render", "--scale", scale, "--out", "o.png"))
        wide = [[[x, y]] for x, y in ((0, 0), (16000, 0), (16000, 16000), (0, 16000))]
        for out in (("--out", "o.exr"), ("--depth", "16", "--out", "o.png")):
            self.scene(f"a picture of 16000 x 16000 pixels with {out}", ("render", *out), refused=True,
                       cage={"rest": SQUARE, "pose": wide})
        for out in ("/dev/full", "n" * 300 + ".png", "p.png/x.png", "one.png"):
            self.scene(f"--out {out[:20]}", ("render", "--out", out))


bad, count, peak, slowest = [], 0, 0, 0
for round_number in range(options.rounds):
    folder = tempfile.mkdtemp(prefix="hostile-")
    for title, words, refused in Round(folder, random.Random(options.seed + round_number)).cases:
        outcome = attack.run([options.program, *words], folder, MOST_SECONDS)
        attack.note(title, outcome.seconds)
        wrong = outcome.wrong(MOST_SECONDS, MOST_MEGABYTES) or ("is not rejected" if refused and outcome.status == 0 else "")
        if wrong:
            bad.append(f"{title}: {wrong}")
        count, peak, slowest = count + 1, max(peak, outcome.megabytes), max(slowest, outcome.seconds)
    shutil.rmtree(folder)
attack.finish("hostile", f"seed {options.seed}, {count} inputs, {len(bad)} bad, at most {peak} MB and {slowest:.1f} s", bad)
