# The Debian packages: unpacked anywhere, the program runs and finds its own files.
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from PIL import Image

BUILD, SOURCE = sys.argv[1:3]
sys.path.append(os.path.join(SOURCE, "tests/support"))
import timed  # noqa: E402
sys.path.insert(0, os.path.join(SOURCE, "tests/app"))
from driver import Display  # noqa: E402


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="holomorph-package-")
        subprocess.run(["cpack", "-G", "DEB", "-B", cls.folder], cwd=BUILD, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        cls.packages = {n.split("_")[0]: os.path.join(cls.folder, n) for n in os.listdir(cls.folder) if n.endswith(".deb")}
        cls.root = os.path.join(cls.folder, "root")
        subprocess.run(["dpkg-deb", "-x", cls.packages["holomorph"], cls.root], check=True)
        cls.program = os.path.join(cls.root, "usr/bin/holomorph")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def field(self, package, name):
        return subprocess.run(["dpkg-deb", "-f", self.packages[package], name], check=True, capture_output=True,
                              text=True).stdout

    def test_it_names_what_it_needs(self):
        needs = self.field("holomorph", "Depends")
        for package in ("libglfw3", "libopenblas0", "fonts-roboto-unhinted", "libwebp7"):
            self.assertIn(package, needs)
        # The program opens each font by its path, so its dependencies must contain the fonts.
        for font, package in (("Roboto-Regular.ttf", "fonts-roboto-unhinted"), ("Roboto-Medium.ttf", "fonts-roboto-unhinted")):
            files = subprocess.run(["dpkg", "-L", package], check=True, capture_output=True, text=True).stdout
            self.assertIn(font, files)
        self.assertNotIn("usr/include", subprocess.run(["dpkg-deb", "-c", self.packages["holomorph"]], check=True,
                                                       capture_output=True, text=True).stdout)

    def test_the_program_runs_where_it_is_unpacked(self):
        scene = os.path.join(self.root, "usr/share/holomorph/assets/gecko.json")
        report = json.loads(subprocess.run([self.program, "info", scene, "--json"], check=True, capture_output=True,
                                           text=True).stdout)
        self.assertEqual(report["method"], "sheet")

    def test_the_window_shows_its_own_samples(self):
        # If the package lacked its samples, the program would use those of the source tree. To tell
        # them apart, give one a picture of a color that nothing else has.
        assets = os.path.join(self.root, "usr/share/holomorph/assets")
        with Image.open(os.path.join(assets, "giraffe.png")) as picture:
            size = picture.size
        Image.new("RGB", size, (255, 0, 255)).save(os.path.join(assets, "giraffe.png"))
        path = os.path.join(assets, "giraffe.json")
        with open(path) as file:
            scene = json.load(file)
        scene["image"] = {"file": "giraffe.png"}
        with open(path, "w") as file:
            json.dump(scene, file)
        with Display() as display:
            display.run(self.program)
            shot = os.path.join(self.folder, "welcome.png")
            end, count = time.time() + 40, 0
            while count < 1000 and time.time() < end:
                time.sleep(0.3)
                display.screenshot(shot)
                count = sum(n for n, color in Image.open(shot).convert("RGB").getcolors(1 << 24) if color == (255, 0, 255))
            self.assertGreaterEqual(count, 1000, display.messages())
            windows = subprocess.run(["xdotool", "search", "--class", "^holomorph$"], env=display.environment,
                                     capture_output=True, text=True).stdout.split()
            self.assertTrue(windows, "the window has the class that the desktop file names")

    def test_python_finds_its_module_where_it_is_unpacked(self):
        root = os.path.join(self.folder, "python")
        subprocess.run(["dpkg-deb", "-x", self.packages["python3-holomorph"], root], check=True)
        self.assertRegex(self.field("python3-holomorph", "Depends"), r"python3-numpy.*")
        self.assertIn("libopenblas0", self.field("python3-holomorph", "Depends"))
        told = subprocess.run(["/usr/bin/python3", "-c", "import holomorph; print(holomorph.__file__, len(holomorph.methods()))"],
                              env={**os.environ, "PYTHONPATH": os.path.join(root, "usr/lib/python3/dist-packages")},
                              check=True, capture_output=True, text=True, cwd=self.folder).stdout
        self.assertIn(root, told)
        self.assertTrue(os.path.exists(os.path.join(root, "usr/share/doc/python3-holomorph/copyright")))

    def test_it_says_its_license_and_brings_what_its_texts_link(self):
        doc = os.path.join(self.root, "usr/share/doc/holomorph")
        with open(os.path.join(doc, "copyright")) as file:
            text = file.read()
        self.assertIn("License: GPL-3", text)
        for part in ("CGAL", "Dear ImGui", "CLI11"):  # compiled in, so their notices must be included
            self.assertIn(part, text)
        self.assertIn("/usr/share/common-licenses/GPL-3", text)
        with open(os.path.join(doc, "README.md")) as file:
            linked = [name for name in re.findall(r"\]\(([^)#]+)\)", file.read()) if not name.startswith("http")]
        for name in ("schema/scene.schema.json", "assets", "src/DECISIONS.md"):
            self.assertIn(name, linked)
        for name in linked:
            self.assertTrue(os.path.exists(os.path.join(doc, name)), name)

    def test_manual_completion_and_catalogue_entry(self):
        page = os.path.join(self.root, "usr/share/man/man1/holomorph.1")
        shown = subprocess.run(["groff", "-man", "-Tascii", "-ww", page], capture_output=True, text=True)
        self.assertEqual((shown.returncode, shown.stderr), (0, ""))
        manual = re.sub(".\x08", "", shown.stdout)  # bold text, which is overstruck as on a typewriter
        commands = re.findall(r"^  ([a-z]+) ", subprocess.run([self.program, "--help"], check=True, capture_output=True,
                                                             text=True).stdout.split("Subcommands:")[1], re.M)
        self.assertGreater(len(commands), 7)
        complete = os.path.join(self.root, "usr/share/bash-completion/completions/holomorph")
        script = f"source {complete}; COMP_WORDS=(holomorph ''); COMP_CWORD=1; cd /; _holomorph; echo ${{COMPREPLY[@]}}; " \
                 f"COMP_WORDS=(holomorph render --cr); COMP_CWORD=2; _holomorph; echo ${{COMPREPLY[@]}}; " \
                 f"COMP_WORDS=(holomorph export s.json --format w); COMP_CWORD=4; _holomorph; echo ${{COMPREPLY[@]}}"
        path = os.path.dirname(self.program) + ":" + os.environ["PATH"]
        words, options, formats = subprocess.run(["bash", "-c", script], check=True, capture_output=True, text=True,
                                        env={**os.environ, "PATH": path}).stdout.splitlines()
        for command in commands:
            self.assertIn(command, words.split())
            self.assertIn(command, manual)
        self.assertEqual(options, "--crop")
        self.assertEqual(formats, "webp webm")
        entry = os.path.join(self.root, "usr/share/metainfo/holomorph.metainfo.xml")
        subprocess.run(["appstreamcli", "validate", "--no-net", entry], check=True, capture_output=True)

    def test_the_libraries_are_packages_of_their_own_with_their_own_licenses(self):
        self.assertEqual(set(self.packages), {"holomorph", "libholomorph-dev", "libholomorph-mesher-dev", "python3-holomorph"})
        for package, license, library in (("libholomorph-dev", "Expat", "libholomorph_core.a"),
                                          ("libholomorph-mesher-dev", "GPL-3", "libholomorph_mesher.a")):
            listed = subprocess.run(["dpkg-deb", "-c", self.packages[package]], check=True, capture_output=True, text=True).stdout
            self.assertEqual([n for n in re.findall(r"libholomorph_\w+\.a", listed)], [library])
            root = os.path.join(self.folder, package)
            subprocess.run(["dpkg-deb", "-x", self.packages[package], root], check=True)
            with open(os.path.join(root, "usr/share/doc", package, "copyright")) as file:
                stated = re.search(r"Files: \*\n.*?License: (\S+)", file.read(), re.S).group(1)
            self.assertEqual(stated, license)
        self.assertIn("libcgal-dev", self.field("libholomorph-mesher-dev", "Depends"))
        self.assertNotIn("cgal", self.field("libholomorph-dev", "Depends"))

    def test_a_desktop_knows_scenes(self):
        desktop = os.path.join(self.root, "usr/share/applications/holomorph.desktop")
        subprocess.run(["desktop-file-validate", desktop], check=True)
        mime = os.path.join(self.root, "usr/share/mime")
        subprocess.run(["update-mime-database", mime], check=True, stderr=subprocess.DEVNULL)
        with open(os.path.join(mime, "globs2")) as file:
            self.assertIn("application/x-holomorph:*.holomorph", file.read())
        with open(os.path.join(mime, "magic"), "rb") as file:
            self.assertIn(b"application/x-holomorph", file.read())
        icon = os.path.join(self.root, "usr/share/icons/hicolor/scalable/apps/holomorph.svg")
        picture = os.path.join(self.folder, "icon.png")
        subprocess.run(["rsvg-convert", "-w", "48", icon, "-o", picture], check=True)
        self.assertGreater(os.path.getsize(picture), 500)


if __name__ == "__main__":
    timed.main(sys.argv[3:])
