# What commands read and write: pipes, devices, links, protected files and standard streams. Also
# covers how commands end when they are stopped, and their errors for wrong arguments.
import json
import os
import pty
import random
import re
import resource
import shutil
import signal
import socket
import socketserver
import stat
import subprocess
import threading
import time
import sys

from PIL import Image

from case import PROGRAM, SOURCE, Case, few_or_many, run, seed_of, timed

SEED = seed_of("files")
FISH = os.path.join(SOURCE, "assets/fish.json")
FERN = os.path.join(SOURCE, "assets/fern.json")
TIGER = os.path.join(SOURCE, "assets/tiger.json")  # on a surface
FFMPEG = """#!/bin/sh
for word in "$@"; do last=$word; done
/usr/bin/cat > "${last#file:}"
"""


class Files(Case):
    def setUp(self):
        super().setUp()
        self.scene = self.write("s.json", self.keyed_scene())
        self.points = self.write("p.csv", "20,20\n30,25\n")
        os.mkdir(self.path("bin"))
        with open(self.path("bin/ffmpeg"), "w") as file:
            file.write(FFMPEG)
        os.chmod(self.path("bin/ffmpeg"), 0o755)
        self.paths = {**os.environ, "PATH": self.path("bin") + ":" + os.environ["PATH"]}

    MESHES_AND_PICTURES = ("obj", "svg", "npy", "png", "stmap", "unwarp-map", "unwarp", "glb", "mdd", "pc2")
    LAYERS_AND_FILMS = ("psd", "ora", "webp", "gif", "apng", "mp4", "webm")

    def writers(self):
        """Every command that writes one file: the file's extension and the words before --out."""
        commands = [(".csv", ["map", self.scene, "--points", self.points]),
                    (".csv", ["inverse", self.scene, "--points", self.points]),
                    (".npy", ["coordinates", self.scene, "--points", self.points]),
                    (".png", ["render", self.scene]),
                    (".json", ["new", self.path("red.png")])]
        for format in self.MESHES_AND_PICTURES + self.LAYERS_AND_FILMS:
            extension = {"stmap": "npy", "unwarp-map": "exr", "unwarp": "png"}.get(format, format)
            commands.append(("." + extension, ["export", self.scene, "--format", format]))
        return commands

    def bytes_of(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_pipes_and_links_are_written_into_by_commands_that_do_not_export(self):
        self.check_pipes_and_links([each for each in self.writers() if each[1][0] != "export"])

    def test_pipes_and_links_are_written_into_by_exports_of_meshes_and_pictures(self):
        self.check_pipes_and_links(self.exporters(self.MESHES_AND_PICTURES))

    def test_pipes_and_links_are_written_into_by_exports_of_layers_and_films(self):
        self.check_pipes_and_links(self.exporters(self.LAYERS_AND_FILMS))

    def exporters(self, formats):
        return [each for each in self.writers() if each[1][0] == "export" and each[1][-1] in formats]

    def check_pipes_and_links(self, writers):
        for extension, words in writers:
            with self.subTest(words=words):
                plain, pipe, link, far, near, got = (self.path(n + extension) for n in
                                                     ("plain", "pipe", "link", "far", "near", "got"))
                if words[-1] in self.LAYERS_AND_FILMS:
                    pipe = self.path("pipe")  # --format says what it gets
                self.good(*words, "--out", plain, env=self.paths)
                wanted = self.bytes_of(plain)
                self.assertTrue(wanted)
                os.mkfifo(pipe)
                with open(got, "wb") as file:
                    reader = subprocess.Popen(["cat", pipe], stdout=file)
                    self.good(*words, "--out", pipe, env=self.paths)
                    self.assertEqual(reader.wait(20), 0)
                self.assertTrue(stat.S_ISFIFO(os.lstat(pipe).st_mode), "the pipe is still a pipe")
                self.assertEqual(self.bytes_of(got), wanted)
                # A link to a link to a file that exists, and to one that does not exist yet.
                for there in (True, False):
                    if there and words[0] != "new":
                        self.write(os.path.basename(far), "before")
                    os.symlink(os.path.basename(far), near)
                    os.symlink(near, link)
                    self.good(*words, "--out", link, env=self.paths)
                    self.assertTrue(os.path.islink(link) and os.path.islink(near))
                    self.assertEqual(self.bytes_of(far), wanted)
                    for name in (link, near, far):
                        os.remove(name)
                # Circular links are not replaced, and a full device is reported.
                os.symlink(link, near)
                os.symlink(near, link)
                self.bad(*words, "--out", link, says="symbolic links", status=1, env=self.paths)
                self.assertTrue(os.path.islink(link))
                os.remove(link)
                os.symlink("/dev/full", link)
                self.bad(*words, "--out", link, says="No space left", status=1, env=self.paths)
                self.assertEqual(os.readlink(link), "/dev/full")
                for name in (link, near, pipe, plain, got):
                    os.remove(name)
        self.assertEqual([n for n in os.listdir(self.folder) if n.startswith(".")], [], "no unfinished file is left")

    def test_frames_go_into_pipes(self):
        pipe = self.path("walk-0002.png")
        os.mkfifo(pipe)
        with open(self.path("got.png"), "wb") as file:
            reader = subprocess.Popen(["cat", pipe], stdout=file)
            self.good("render", self.scene, "--frames", "2..2", "--out", self.path("walk.png"))
            self.assertEqual(reader.wait(20), 0)
        self.assertTrue(stat.S_ISFIFO(os.lstat(pipe).st_mode))
        self.assertEqual(Image.open(self.path("got.png")).size, (70, 60))

    def test_standard_output_gets_what_a_file_gets(self):
        for extension, words in self.writers():
            if extension == ".exr":
                continue  # standard output gets NumPy
            with self.subTest(words=words):
                plain = self.path("plain" + extension)
                self.good(*words, "--out", plain, env=self.paths)
                done = subprocess.run([PROGRAM, *words, "--out", "-"], capture_output=True, env=self.paths, cwd=self.folder)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stdout, self.bytes_of(plain))
                os.remove(plain)
                with open("/dev/full", "wb") as full:
                    done = subprocess.run([PROGRAM, *words, "--out", "-"], stdout=full, stderr=subprocess.PIPE,
                                          env=self.paths, cwd=self.folder)
                self.assertEqual(done.returncode, 1)
                self.assertIn(b"No space left", done.stderr)
        for words in (["info", self.scene], ["info", self.scene, "--json"], ["--help"], ["--version"],
                      ["bench", "--filter", "prepare: mesh", "--json"]):
            with open("/dev/full", "wb") as full:
                done = subprocess.run([PROGRAM, *words], stdout=full, stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 1, words)

    def test_benchmarks_name_the_machine_and_are_compared_with_earlier_ones(self):
        words = ["bench", "--filter", "prepare: mesh of"]
        text = self.good(*words, "--json").stdout
        results = json.loads(text)
        self.assertEqual(set(results), {"machine", "commit", "rows"})
        self.assertEqual(set(results["machine"]), {"processor", "cores", "load"})
        self.assertGreater(results["machine"]["cores"], 0)
        self.assertEqual(len(results["rows"]), 1)
        results["rows"][0]["median"] *= 100
        with open(self.path("before.json"), "w") as file:
            json.dump(results, file)
        line = self.good(*words, "--against", self.path("before.json")).stdout
        self.assertRegex(line, r"was [0-9.e+]+, now 0\.[0-9]+ times as much")
        with open(self.path("other.json"), "w") as file:
            file.write("{}")
        for name, reason in (("other.json", "no benchmarks"), ("none.json", "no such file")):
            done = subprocess.run([PROGRAM, *words, "--against", self.path(name)], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(reason, done.stderr)

    def test_the_benchmarks_can_be_listed(self):
        usual, every = (self.good("bench", "--list", *words).stdout.splitlines() for words in ([], ["--long"]))
        self.assertEqual(len(set(every)), len(every))
        self.assertLess(set(usual), set(every))
        names = [line.split("  (goal ")[0] for line in every]
        for line in every:
            self.assertFalse("compar" in line and "(goal " in line, line)
        floats = [name for name in names if name.startswith("coordinates: float, order")]
        self.assertGreater(len(floats), 2)
        for name in floats:
            self.assertIn(name.replace("float", "double"), names)
        self.assertEqual(self.good("bench", "--list", "--filter", "auto-cage").stdout, "auto-cage: 2000 x 2000 picture\n")

    def test_an_interrupted_benchmark_keeps_its_rows(self):
        process = subprocess.Popen([PROGRAM, "bench", "--filter", "prepare: ", "--json"], stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, text=True)
        lines = []
        while not any("median" in line for line in lines):
            lines.append(process.stdout.readline())
            self.assertNotEqual(lines[-1], "", "a row must come before the end")
        process.send_signal(signal.SIGINT)
        results = json.loads("".join(lines) + process.stdout.read())
        process.stdout.close()
        self.assertEqual(process.wait(), 130)
        self.assertIn("prepare: ", results["rows"][0]["name"])

    def test_scenes_and_points_come_from_pipes_and_standard_input(self):
        scene = self.keyed_scene()
        scene["image"]["file"] = self.path("red.png")
        text = json.dumps(scene)
        wanted = self.good("map", self.scene, "--points", self.points).stdout
        self.assertEqual(self.good("map", "-", "--allow-outside", "--points", self.points, "--out", "-", input=text).stdout, wanted)
        self.assertEqual(self.good("map", self.scene, "--points", "-", input="20,20\n30,25\n").stdout, wanted)
        self.bad("map", "-", "--points", "-", says="not both")
        for words, name, content in ((("map", self.scene, "--points"), "points", "20,20\n30,25\n"),
                                     (("map", "--points", self.points), "scene", text)):
            os.mkfifo(self.path(name))
            writer = threading.Thread(target=lambda: self.write(name, content))
            writer.start()
            self.assertEqual(self.good(*words, self.path(name)).stdout, wanted)
            writer.join()
        folder = os.open(self.folder, os.O_RDONLY)
        self.bad("info", "-", says="standard input: cannot be read", stdin=folder)
        os.close(folder)
        self.bad("info", "-", says="standard input: /: the key 'cage'", input='{"format": "holomorph", "version": 1}')

    def test_protected_and_existing_files_are_replaced_only_with_force(self):
        for extension, words in self.writers():
            with self.subTest(words=words):
                kept = self.write("kept" + extension, "mine")
                os.chmod(kept, 0o444)
                self.bad(*words, "--out", kept, says="read-only" if words[0] != "new" else "--force", status=1,
                         env=self.paths)
                self.assertEqual(self.bytes_of("kept" + extension), b"mine")
                self.good(*words, "--out", kept, "--force", env=self.paths)
                self.assertNotEqual(self.bytes_of("kept" + extension), b"mine")
                os.remove(kept)
        there = self.write("there.json", "mine")
        self.bad("new", self.path("red.png"), "--out", there, says="already exists", status=1)
        self.assertEqual(self.bytes_of("there.json"), b"mine")
        if os.geteuid() != 0:
            return
        # Another user's file in a folder that everyone may write to.
        os.chmod(self.folder, 0o777)
        other = self.write("other.png", "mine")
        os.chmod(other, 0o644)
        program = self.path("program")  # where another user can run it
        shutil.copy(PROGRAM, program)
        done = subprocess.run([program, "render", self.scene, "--out", other], capture_output=True, text=True,
                              user=65534, group=65534, extra_groups=[])
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("read-only", done.stderr)
        self.assertEqual(self.bytes_of("other.png"), b"mine")

    def test_no_command_replaces_what_it_reads(self):
        for words in (["map", self.scene, "--points", self.points], ["inverse", self.scene, "--points", self.points],
                      ["coordinates", self.scene, "--points", self.points]):
            for name in (self.scene, self.points):
                before = self.bytes_of(name)
                self.bad(*words, "--out", name, "--force", says="also an input of the command")
                self.assertEqual(self.bytes_of(name), before)
        self.bad("new", self.path("red.png"), "--out", self.path("red.png"), "--force", says="also an input of the command")
        self.assertEqual(Image.open(self.path("red.png")).size, (60, 40))

    def test_a_full_disk_is_the_reason_that_is_given(self):
        small = self.path("small")
        os.mkdir(small)
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=32k", "none", small], capture_output=True).returncode:
            self.skipTest("mounting a small disk is not permitted here")
        try:
            out = os.path.join(small, "o.png")
            for words in (["render", FISH], ["export", FERN, "--format", "gif", "--scale", "0.2"]):
                name = out if words[0] == "render" else out[:-3] + "gif"
                self.bad(*words, "--out", name, says="No space left", status=1)
                self.assertEqual(os.listdir(small), [])
        finally:
            subprocess.run(["umount", small], check=True)

    def test_a_file_that_cannot_be_finished_leaves_nothing(self):
        """Every format, on a disk on which files cannot grow beyond 500 bytes."""
        def small():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # writing fails instead of ending the program
            resource.setrlimit(resource.RLIMIT_FSIZE, (500, 500))
        table = self.good("formats").stdout
        formats = re.findall(r"^(\S+) ", table[table.index("--format"):], re.M)[1:]
        self.assertGreater(len(formats), 15)
        for name in formats:
            with self.subTest(format=name):
                folder = self.path("small-" + name)
                os.mkdir(folder)
                suffix = {"stmap": "exr", "unwarp-map": "npy", "unwarp": "png", "textured": "obj", "godot": "tscn", "godot3": "tscn", "drawing": "svg",
                          "spine": "json"}.get(name, name)
                scene = TIGER if name == "textured" else FERN
                many = ["--frames", "0..3"] if "--frames" in table[table.index("\n" + name + " "):].split("\n")[1] else []
                scale = ["--scale", "0.2"] if suffix in ("png", "exr", "gif", "webp", "apng", "mp4", "webm", "psd", "ora") else []
                self.bad("export", scene, "--format", name, *many, *scale, "--out", os.path.join(folder, "o." + suffix),
                         says="", status=1, preexec_fn=small, restore_signals=False)
                self.assertEqual(os.listdir(folder), [])

    @staticmethod
    def wait_until_it_listens(process, stop):
        """On a machine with much to do, a signal can come before the program does anything at all."""
        end = time.time() + 20
        while time.time() < end and process.poll() is None:
            with open(f"/proc/{process.pid}/status") as status:
                caught = next(line.split()[1] for line in status if line.startswith("SigCgt"))
            if int(caught, 16) >> (stop - 1) & 1:
                return
            time.sleep(0.01)

    def test_stopped_commands_end_with_130_and_leave_nothing(self):
        draw = random.Random(SEED)
        many = self.write("many.csv", "20,20\n" * 20000)
        commands = [["info", FERN, "--frames", "all"], ["map", FERN, "--points", many, "--frames", "all"],
                    ["render", FERN, "--scale", "8", "--out", self.path("o.png")],
                    ["render", FERN, "--frames", "all", "--out", self.path("o.png")],
                    ["export", FISH, "--format", "stmap", "--out", self.path("o.npy")], ["bench"],
                    *(["export", FERN, "--format", kind, "--out", self.path("o." + kind)]
                      for kind in ("webp", "gif", "apng", "mp4"))]
        for words in commands:
            for stop in (signal.SIGINT, signal.SIGTERM):
                with self.subTest(words=words, stop=stop):
                    process = subprocess.Popen([PROGRAM, *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                               text=True, env=self.paths)
                    self.wait_until_it_listens(process, stop)
                    time.sleep(draw.uniform(0.1, 0.4))
                    process.send_signal(stop)
                    said = process.communicate(timeout=20)[1]
                    self.assertEqual(process.returncode, 130, said)
                    self.assertIn("interrupted", said)
        left = os.listdir(self.folder)
        self.assertEqual([n for n in left if n.startswith(".") or n.endswith(("webp", "gif", "apng", "mp4", "npy"))], [])
        for name in (n for n in left if n.startswith("o-")):
            Image.open(self.path(name)).load()  # finished frames are complete
        pipe = self.path("pipe")
        os.mkfifo(pipe)
        process = subprocess.Popen([PROGRAM, "map", self.scene, "--points", self.points, "--out", pipe],
                                   stderr=subprocess.PIPE)
        time.sleep(1)  # it waits for a reader
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)
        self.assertEqual(process.returncode, 130)

    def test_rectangles_are_printed_and_the_same_for_parts(self):
        whole = "70 x 60 pixels, lower left corner at (0, 0)"
        for words in (["render", self.scene, "--frames", "all", "--out", self.path("a.png")],
                      ["render", self.scene, "--frames", "1..2", "--out", self.path("a.png")],
                      ["export", self.scene, "--format", "gif", "--out", self.path("a.gif")],
                      ["export", self.scene, "--format", "gif", "--frames", "0..1", "--out", self.path("a.gif")]):
            self.assertIn(whole, self.good(*words).stderr)
            self.assertIn("60 x 40 pixels, lower left corner at (0, 0)", self.good(*words, "--crop").stderr)
        self.good("export", self.scene, "--format", "gif", "--crop", "--out", self.path("a.gif"))
        self.assertEqual(Image.open(self.path("a.gif")).size, (60, 40))
        self.assertIn("60 x 40", self.good("export", self.scene, "--format", "png", "--time", 1, "--crop", "--out",
                                           self.path("a.png")).stderr)

    def test_one_frame_of_a_long_film_costs_one_frame(self):
        scene = self.keyed_scene()
        scene["animation"] = {"frames_per_second": 240}
        scene["keyframes"][-1]["time"] = 3600
        path = self.write("long.json", scene)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        said = self.good("render", path, "--frames", "7..7", "--out", self.path("a.png")).stderr
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 10)
        # Other frames can be rendered in the same rectangle or in any other.
        shared = said.split("(--rect ")[1].split(")")[0]
        again = self.good("render", path, "--frames", "9..9", "--rect", shared, "--out", self.path("a.png")).stderr
        self.assertEqual(again.split(" frames of ")[1].split(":")[0], said.split(" frames of ")[1].split(":")[0])
        for words in (["render", path], ["export", path, "--format", "png"]):
            self.good(*words, "--rect", "-5,3,20,10", "--scale", 2, "--out", self.path("b.png"))
            self.assertEqual(Image.open(self.path("b.png")).size, (40, 20))
        for wrong in ("1,2,3", "0,0,0,5", "nan,0,1,1", "0,0,1,1x"):
            self.bad("render", path, "--rect", wrong, "--out", self.path("b.png"), says="X,Y,WIDTH,HEIGHT")
        # Rendering all frames exceeds the limit that guards against accidents.
        self.bad("render", path, "--frames", "all", "--out", self.path("a.png"), says="--max-frames")
        self.bad("export", path, "--format", "gif", "--out", self.path("a.gif"), says="--max-frames")

    def test_pictures_outside_of_the_folder_are_read_only_when_allowed(self):
        os.mkdir(self.path("in"))
        scene = self.keyed_scene()
        said = {}
        for file in ("../red.png", self.path("red.png"), "../none.png", "/etc/hostname", "/dev/zero"):
            scene["image"] = {"file": file}
            path = self.write("in/s.json", scene)
            for words in (["info"], ["render", "--out", self.path("o.png")], ["map", "--points", self.points],
                          ["export", "--format", "svg", "--out", self.path("o.svg")]):
                self.bad(words[0], path, *words[1:], says="--allow-outside")
            said[file] = run("info", path).stderr.replace(file, "X").replace(os.path.normpath(self.path("in/" + file)), "X")
        self.assertEqual(len(set(said.values())), 1, "the messages do not tell which of these files exist")
        scene["image"] = {"file": "../red.png"}
        self.good("info", self.write("in/s.json", scene), "--allow-outside")
        # And surfaces.
        shutil.copy(self.path("red.png"), self.path("in"))
        scene.update(image={"file": "red.png"}, keyframes=[], method={"id": "outline"},
                     outline=[[10, 10], [50, 10], [50, 30], [10, 30]])
        for file in ("../leaf.obj", "../none.obj", "/dev/zero"):
            scene["surface"] = {"file": file}
            self.bad("info", self.write("in/s.json", scene), says="--allow-outside")

    def test_limits_are_named_and_can_be_raised(self):
        deep = self.write("deep.svg", "<svg>" + "<g>" * 5 + '<path d="M1 1L50 1L50 35Z"/>' + "</g>" * 5 + "</svg>")
        out = self.path("o.png")
        for option, little, enough, words in (
                ("--max-pixels", "0.002", "0.01", ["info", self.scene]),
                ("--max-scene-size", "0.0001", "1", ["info", self.scene]),
                ("--max-coordinates", "0.01", "1", ["info", self.scene]),
                ("--max-keyframe-memory", "0.1", "10", ["render", self.scene, "--time", "0.7", "--out", out]),
                ("--max-frames", "3", "5", ["render", self.scene, "--frames", "all", "--out", out]),
                ("--max-frames", "3", "5", ["export", self.scene, "--format", "gif", "--out", self.path("o.gif")]),
                ("--max-groups", "3", "8", ["new", self.path("red.png"), "--cage", deep, "--force", "--out", self.path("n.json")])):
            with self.subTest(option=option, words=words):
                said = self.bad(*words, option, little, says=option).stderr
                self.assertIn("the limit is", said)
                self.good(*words, option, enough)
                # The limit that the message suggests is enough.
                asked = said.split(option + " ")[1].split()[0]
                self.good(*words, option, asked)
        self.bad("info", self.scene, "--max-pixels", "-1", says="--max-pixels")

    def test_limits_are_those_of_the_page_on_security(self):
        with open(os.path.join(SOURCE, "SECURITY.md")) as file:
            rows = re.findall(r"^\| .* \| ([\d,]+)[^|]*\| `(--max-\S+)` \|$", file.read(), re.M)
        said = self.good("info", "--help").stdout
        self.assertEqual(sorted(option for _, option in rows), sorted(re.findall(r"--max-\S+", said)))
        for default, option in rows:
            self.assertRegex(said, rf"{option} FLOAT .*; {default.replace(',', '')} .*by default")

    def test_sides_have_at_most_16384_pixels(self):
        for side, scale, fits in ((16384, 1, True), (4096, 4, True), (16385, 1, False), (3277, 5, False)):
            for size in ((side, 1), (1, side)):
                Image.new("RGBA", size, (200, 40, 40, 255)).save(self.path("long.png"))
                scene = self.write("long.json", {"format": "holomorph", "version": 1, "image": {"file": "long.png"},
                                                 "cage": {"rest": []}})
                words = ["render", scene, "--scale", scale, "--force", "--out", self.path("o.png")]
                if fits:
                    self.good(*words)
                    with Image.open(self.path("o.png")) as drawn:
                        self.assertEqual(max(drawn.size), 16384)
                else:
                    self.bad(*words, says="16384")

    def test_nothing_is_fetched_and_nothing_is_run(self):
        """Files that refer to a server of the test, in every way that their formats have."""
        seen = []
        server = socketserver.TCPServer(("127.0.0.1", 0), lambda request, *_: seen.append(request.recv(999)))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        at = "http://127.0.0.1:{}/".format(server.server_address[1])
        self.write("a.svg", f"""<?xml-stylesheet href='{at}a.css'?><!DOCTYPE svg [<!ENTITY e SYSTEM '{at}e'>]>
            <svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='90' height='90'
            onload='fetch("{at}onload")'><style>@import url({at}b.css); @font-face{{font-family:f;src:url({at}f.ttf)}}
            rect{{fill:url({at}g#g)}}</style><script href='{at}s.js'/><script>fetch("{at}script")</script>
            <image href='{at}i.png' width='9' height='9'/><image xlink:href='{at}i.svg' width='9' height='9'/>
            <use href='{at}u.svg#a'/><text font-family='f'>&e;</text>
            <path d='M5 5H85V85Z' filter='url({at}f.svg#f)'/></svg>""")
        self.write("a.obj", f"mtllib {at}a.mtl\ncsh touch {self.path('ran')}\ncall {self.path('ran.obj')}\n"
                   "v 0 0 0\nv 9 0 0\nv 9 9 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 3/3\n")
        self.write("a.mp4", f"#EXTM3U\n#EXT-X-TARGETDURATION:10\n#EXTINF:1,\n{at}a.ts\n#EXT-X-ENDLIST\n")
        scene, out = self.keyed_scene(), self.path("out.svg")
        for name in (at + "a.png", at + "a.mp4", at + "a.svg", "a.mp4"):
            path = self.write("s.json", {**scene, "image": {"file": name}})
            for words in ([], ["--allow-outside"]):
                self.assertEqual(run("info", path, *words).returncode, 2, name)
        self.good("new", self.path("a.svg"), "--out", self.path("svg.json"))
        self.good("render", self.path("svg.json"), "--out", self.path("o.png"))
        self.good("export", self.path("svg.json"), "--format", "drawing", "--out", out)
        for option in ("--cage", "--outline"):
            self.good("new", self.path("red.png"), option, self.path("a.svg"), "--force", "--out", self.path("n.json"))
            self.good("new", self.path("red.png"), option, self.path("a.obj"), "--force", "--out", self.path("n.json"))
        self.assertFalse(os.path.exists(self.path("ran")))
        with socket.create_connection(server.server_address) as client:
            client.send(b"the server works")
            client.recv(1)  # until the server has seen it, and with it all that came before
        server.shutdown()
        server.server_close()
        self.assertEqual(seen, [b"the server works"])

    def test_the_exit_status_tells_whether_all_frames_are_there(self):
        words = ["render", self.scene, "--frames", "0..3", "--missing", "--out", self.path("walk.png")]
        frames = [self.path(f"walk-000{i}.png") for i in range(4)]
        self.good(*words)
        made = [os.stat(frame).st_mtime_ns for frame in frames]
        self.good(*words)
        self.assertEqual([os.stat(frame).st_mtime_ns for frame in frames], made)
        os.remove(frames[2])
        os.symlink(self.path("nowhere/2.png"), frames[2])  # cannot be written
        self.assertEqual(run(*words).returncode, 1)
        os.remove(frames[2])
        self.good(*words)
        self.assertTrue(os.path.isfile(frames[2]))

    def test_many_points_are_mapped_in_blocks(self):
        points = self.write("many.csv", "".join(f"{10 + i % 50},{5 + i // 50 % 30}\n" for i in range(3000)))
        whole = self.good("map", self.scene, "--points", points, "--frames", "0..2").stdout
        blocks = self.good("map", self.scene, "--points", points, "--frames", "0..2", "--max-coordinates", "0.1").stdout
        self.assertEqual(whole.count("\n"), 3 * 3000 + 1)
        self.assertEqual(blocks, whole)

    def test_progress_is_shown_on_terminals_and_only_after_a_second(self):
        one_core = {"preexec_fn": lambda: os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})}

        def said_on_a_terminal(*words):
            here, there = pty.openpty()
            process = subprocess.Popen([PROGRAM, *words], stdout=subprocess.DEVNULL, stderr=there, **one_core)
            os.close(there)
            said = b""
            try:
                while block := os.read(here, 4096):
                    said += block
            except OSError:  # the other end is closed
                pass
            os.close(here)
            self.assertEqual(process.wait(), 0, said)
            return said.decode()

        points = self.write("many.csv", "".join(f"{i % 1000},{i // 250}\n" for i in range(150000)))
        slow = ["inverse", FISH, "--points", points, "--out", self.path("o.csv")]
        said = said_on_a_terminal(*slow)
        self.assertRegex(said, r"inverse: point \d+ of 150000, \d+ s")
        searched = {int(n) for n in re.findall(r"point (\d+) of", said)}
        self.assertTrue(any(n % 8192 for n in searched), f"also within a block of points: {searched}")
        self.assertIn("\x1b[K", said.split(" s")[-1], "the line is cleared at the end")
        self.assertNotIn("point", run(*slow, **one_core).stderr)
        self.assertNotIn("\x1b", said_on_a_terminal("render", self.scene, "--frames", "0..2", "--out", self.path("o.png")))

    def test_wrong_arguments_are_named(self):
        out = self.path("o.png")
        for words, says in ((["rendr", "x"], "rendr: there is neither a command nor a file"),
                            (["render", self.scene, "--outt", out], "--outt"),
                            (["render", self.scene, "--out", out, "--frames", ""], "--frames: ''"),
                            (["render", self.scene, "--out", out, "--frames", "3..1"], "backwards"),
                            (["render", self.scene, "--out", out, "--time", "-1"], "'-1' is not a time"),
                            (["render", self.scene, "--out", out, "--scale", "abc"], "--scale = abc"),
                            (["export", self.scene, "--out", out, "--format", "obj", "--crop"], "--crop cannot be used with obj"),
                            (["export", self.scene, "--out", out, "--format", "svg", "--scale", "2"], "--scale cannot be used with svg"),
                            (["export", self.scene, "--out", out, "--format", "gif", "--time", "1"], "use --frames"),
                            (["export", self.scene, "--out", out, "--format", "svg", "--frames", "all"], "use --time"),
                            (["export", self.scene, "--out", out, "--format", "doc", "--frames", "all"], "format 'doc'"),
                            (["new", self.path("red.png"), "--out", self.path("n.json"), "--margin", "-5"], "--margin"),
                            (["bench", "--filter", "zzz"], "zzz")):
            with self.subTest(words=words):
                self.bad(*words, says=says)
        self.assertFalse(os.path.exists(out))
        start = time.monotonic()
        self.assertIn("--allow-outside", self.good(FISH, "--help").stdout)
        self.assertLess(time.monotonic() - start, 5)  # without opening the scene

    def test_two_runs_of_info_differ_in_their_timings_alone(self):
        for name in few_or_many(("fish", "heart"), ("fish", "octopus", "heart")):
            sample = os.path.join(SOURCE, "assets", name + ".json")
            one, other = (json.loads(self.good("info", sample, "--json").stdout) for _ in range(2))
            self.assertGreater(one.pop("timings")["pose_ms"], 0)
            del other["timings"]
            self.assertEqual(one, other, name)


if __name__ == "__main__":
    timed.main(sys.argv[3:])
