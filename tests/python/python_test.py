# The Python module, compared with the command line and with formulas.
import ast
import cmath
import csv
import io
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np
from PIL import Image

PROGRAM, SOURCE, PACKAGE = sys.argv[1:4]
sys.path.insert(0, PACKAGE)
sys.path.append(os.path.join(SOURCE, "tests/support"))
import timed  # noqa: E402
from seeds import few_or_many, seed_of  # noqa: E402
import holomorph  # noqa: E402

SAMPLES = sorted(name for name in os.listdir(os.path.join(SOURCE, "assets")) if name.endswith(".json"))
SEED = seed_of("python")


def sample(name):
    return os.path.join(SOURCE, "assets", name)


def printed(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def rows(text):
    """The columns of a table as arrays."""
    table = list(csv.reader(io.StringIO(text.decode())))
    return dict(zip(table[0], np.array(table[1:], float).T))


def same(a, b):
    """Whether two arrays have the same bits, except that all NaN are alike."""
    a, b = np.asarray(a), np.asarray(b)
    return a.shape == b.shape and bool(np.all((a == b) | (np.isnan(a) & np.isnan(b))))


def random_star(rng, count=9):
    angles = 2 * np.pi * (np.arange(count) + 0.3 * rng.random(count)) / count
    return 200 + 150j + 100 * (0.6 + 0.4 * rng.random(count)) * np.exp(1j * angles)


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="holomorph-python-")
        self.rng = np.random.default_rng(SEED)

    def tearDown(self):
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def points_file(self, points):
        with open(self.path("points.csv"), "w") as file:
            file.writelines(f"{float(z.real)!r},{float(z.imag)!r}\n" for z in points)
        return self.path("points.csv")

    def scene(self, method="cage"):
        Image.new("RGBA", (400, 300), (200, 40, 40, 255)).save(self.path("red.png"))
        scene = holomorph.Scene(self.path("red.png"))
        scene.set_cage(random_star(self.rng))
        scene.method = method
        return scene


class AgainstTheCommandLine(Folder):
    def test_maps_and_derivatives_have_the_same_bits(self):
        for name in few_or_many(["fern.json", "tiger.json"], SAMPLES):
            with self.subTest(scene=name):
                scene = holomorph.load(sample(name))
                cage = scene.mesh().vertices
                points = cage[self.rng.integers(0, len(cage), 40)] + self.rng.normal(size=40) + 1j * self.rng.normal(size=40)
                for time_of in ([None, 0.4] if scene.keys and name in ("fern.json", "gecko.json", "octopus.json") else [None]):
                    table = rows(printed("map", sample(name), "--points", self.points_file(points),
                                         *(["--time", time_of] if time_of is not None else [])))
                    self.assertTrue(same(scene.map(points, time=time_of), table["u"] + 1j * table["v"]))
                    fz, fzbar = scene.derivatives(points, time=time_of)
                    self.assertTrue(same(fz, table["fz_re"] + 1j * table["fz_im"]))
                    self.assertTrue(same(fzbar, table["fzbar_re"] + 1j * table["fzbar_im"]))

    def test_inverses_have_the_same_bits(self):
        for name in few_or_many(SAMPLES[:1], SAMPLES[:5]):
            with self.subTest(scene=name):
                scene = holomorph.load(sample(name))
                mesh = scene.mesh()
                points = mesh.positions[self.rng.integers(0, len(mesh.positions), 30)] + 0.3
                table = rows(printed("inverse", sample(name), "--points", self.points_file(points)))
                self.assertTrue(same(scene.inverse(points), table["x"] + 1j * table["y"]))
                counts = [len(found) for found in scene.preimages(points)]
                self.assertEqual(counts, list(table["count"]))

    def test_pictures_have_the_same_pixels(self):
        for name in few_or_many(["octopus.json"], ["fish.json", "octopus.json", "fern.json"]):
            scene = holomorph.load(sample(name))
            for option, more in ((["--scale", "0.5"], {"scale": 0.5}), (["--crop"], {"crop": True}),
                                 (["--view", "area"], {"view": "area"})):
                with self.subTest(scene=name, option=option):
                    printed("render", sample(name), *option, "--out", self.path("o.png"))
                    self.assertTrue(np.array_equal(scene.render(**more), np.array(Image.open(self.path("o.png")).convert("RGBA"))))
        moving = holomorph.load(sample("fern.json"))
        self.assertTrue(moving.keys)
        printed("render", sample("fern.json"), "--time", "0.3", "--out", self.path("o.png"))
        self.assertTrue(np.array_equal(moving.render(time=0.3), np.array(Image.open(self.path("o.png")).convert("RGBA"))))

    def test_a_film_shows_the_frame_of_each_time(self):
        for k in range(4):
            Image.new("RGBA", (30, 20), (40 * k, 0, 0, 255)).save(self.path(f"frame{k}.png"))
        with open(self.path("film.json"), "w") as file:
            json.dump({"format": "holomorph", "version": 1, "cage": {"rest": []},
                       "image": {"file": "frame0.png", "clip": {"frames_per_second": 4, "first": 1}}}, file)
        scene = holomorph.load(self.path("film.json"))
        for time, red in ((None, 40), (0.3, 80), (None, 40), (9.0, 120), (0.0, 40)):
            shown = scene.render() if time is None else scene.render(time=time)
            self.assertEqual(shown[10, 10, 0], red, time)

    def test_coordinates_have_the_same_bits(self):
        scene = self.scene()
        scene.save(self.path("s.json"))
        points = scene.mesh().vertices[:50]
        for order in (0, 1, 2):
            printed("coordinates", self.path("s.json"), "--points", self.points_file(points), "--order", order,
                    "--out", self.path("c.npy"))
            given = np.load(self.path("c.npy"))
            self.assertTrue(same(holomorph.coordinates(scene.cage, points, order=order), given))

    def test_reports_agree(self):
        told = json.loads(printed("info", sample("gecko.json"), "--json"))
        scene = holomorph.load(sample("gecko.json"))
        info = scene.info()
        for key in told:
            if key != "timings":
                self.assertEqual(info[key], told[key], key)


class Mathematics(Folder):
    def test_coordinates_of_every_kind_reproduce_the_plane(self):
        cage = random_star(self.rng)
        points = cage.mean() + 20 * (self.rng.normal(size=30) + 1j * self.rng.normal(size=30))
        points = points[abs(points - cage.mean()) < 40]
        for kind in ("cauchy", "mean_value", "harmonic"):
            c = holomorph.coordinates(cage, points, kind)
            self.assertEqual(c.dtype, complex if kind == "cauchy" else float, kind)
            np.testing.assert_allclose(c.sum(axis=1), 1, atol=1e-9, err_msg=kind)
            np.testing.assert_allclose(c @ cage, points, atol=1e-7, err_msg=kind)
            slopes = holomorph.coordinates(cage, points, kind, order=1)
            along, up = ((holomorph.coordinates(cage, points + step, kind) - holomorph.coordinates(cage, points - step, kind)) / 2e-4
                         for step in (1e-4, 1e-4j))
            # The complex derivative, or h_x - i h_y of real coordinates.
            np.testing.assert_allclose(slopes, along if kind == "cauchy" else along - 1j * up, atol=1e-6, err_msg=kind)
        turned = holomorph.coordinates(cage[::-1], points, "harmonic")
        np.testing.assert_allclose(turned[:, ::-1], holomorph.coordinates(cage, points, "harmonic"), atol=1e-4)
        hilbert = holomorph.coordinates(cage, points, "hilbert")
        slopes = holomorph.coordinates(cage, points, "hilbert", order=1)
        for step in (1e-4, 1e-4j):
            difference = holomorph.coordinates(cage, points + step, "hilbert") - holomorph.coordinates(cage, points - step, "hilbert")
            np.testing.assert_allclose(slopes, difference / (2 * step), atol=1e-5)
        self.assertEqual(hilbert.shape, (len(points), 2 * len(cage)))
        np.testing.assert_allclose(hilbert.sum(axis=1).real, 1, atol=1e-9)

    def test_a_similarity_of_the_cage_is_the_map(self):
        scene = self.scene()
        factor, move = 1.3 * cmath.exp(0.7j), 40 - 20j
        scene.pose = factor * scene.cage + move
        points = scene.mesh().vertices[::50]
        np.testing.assert_allclose(scene.map(points), factor * points + move, atol=1e-8)
        jacobian = np.array([[factor.real, -factor.imag], [factor.imag, factor.real]])
        inner = points[abs(points - points.mean()) < 40]
        np.testing.assert_allclose(scene.jacobians(inner), np.broadcast_to(jacobian, (len(inner), 2, 2)), atol=1e-8)
        np.testing.assert_allclose(scene.inverse(scene.map(inner)), inner, atol=1e-8)
        self.assertTrue(np.isnan(scene.map([5000 + 0j])[0]))

    def test_pins_reach_their_targets_and_the_proof_is_told(self):
        scene = self.scene("pins")
        middle = scene.cage.mean()
        scene.pins = [holomorph.Pin(middle, middle + 5 + 3j), holomorph.Pin(middle - 30)]
        moved, fixed = scene.map([middle, middle - 30])
        self.assertLess(abs(moved - (middle + 5 + 3j)), 0.01)
        self.assertLess(abs(fixed - (middle - 30)), 0.01)
        scene.method = "bounded"
        proof = scene.certificate()
        self.assertEqual((proof.proved, proof.status), (True, "certified"))
        self.assertLess(proof.shear, 1)
        fz, fzbar = scene.derivatives(scene.mesh().vertices)
        self.assertGreaterEqual(np.nanmin(abs(fz) - abs(fzbar)), proof.smallest - 1e-9)

    def test_unknown_and_unusable_parameters_are_refused(self):
        scene = self.scene()
        for parameters in ({"nosuch": 1.0}, {"k": float("nan")}):
            with self.assertRaises(holomorph.InvalidInput):
                scene.parameters = parameters
        scene.method = "bounded"
        with self.assertRaises(holomorph.InvalidInput):
            scene.parameters = {"kk": 0.5}

    def test_a_signal_handler_cannot_use_the_scene_at_work(self):
        scene, seen = self.scene(), []

        def handler(*_):
            try:
                seen.append(scene.method)
            except holomorph.InvalidInput as error:
                seen.append(str(error))

        before = signal.signal(signal.SIGALRM, handler)
        signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
        try:
            for _ in range(20):
                scene.inverse(scene.mesh().positions)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)
        self.assertTrue(any("at work" in text for text in seen), seen)

    def test_points_may_have_any_shape_and_kind(self):
        self.assertEqual(self.scene().map(np.zeros((0, 2))).shape, (0,))
        self.assertEqual(self.scene().map(np.zeros((3, 0, 2))).shape, (3, 0))
        self.assertEqual(self.scene().map([]).shape, (0,))
        scene = self.scene()
        middle = scene.cage.mean()
        grid = middle + np.add.outer(np.arange(3.0), 1j * np.arange(4.0))
        mapped = scene.map(grid)
        self.assertEqual(mapped.shape, (3, 4))
        xy = np.stack([grid.real, grid.imag], axis=-1)
        self.assertTrue(same(scene.map(xy), mapped))
        self.assertTrue(same(scene.map(xy.tolist()), mapped))
        self.assertTrue(same(scene.map(np.asfortranarray(grid)), mapped))
        self.assertTrue(same(scene.map(grid[::2, ::-1]), mapped[::2, ::-1]))
        self.assertEqual(scene.jacobians(grid).shape, (3, 4, 2, 2))
        self.assertEqual(scene.map([]).shape, (0,))
        odd = np.array([np.nan, middle, np.inf, complex(0, -np.inf), 1e300])
        for result in (scene.map(odd), scene.inverse(odd)):
            self.assertEqual(list(np.isfinite(result)), [False, True, False, False, False])
        for wrong in ([1.0, 2.0, 3.0], "middle", None):
            with self.assertRaises(TypeError):
                scene.map(wrong)


class Editing(Folder):
    def test_a_scene_survives_saving(self):
        scene = self.scene("bounded")
        scene.parameters = {"k": 0.5}
        scene.pins = [holomorph.Pin(scene.cage.mean(), angle=0.5, scale=1.2)]
        scene.set_key(0)
        scene.pose = scene.cage + 10
        pins = scene.pins
        pins[0].target += 10
        scene.pins = pins
        scene.set_key(1.5)
        scene.save(self.path("s.json"))
        again = holomorph.load(self.path("s.json"))
        self.assertEqual((again.method, again.parameters, again.keys), ("bounded", {"k": 0.5}, [0, 1.5]))
        self.assertEqual([(p.position, p.angle, p.scale) for p in again.pins], [(scene.cage.mean(), 0.5, 1.2)])
        self.assertTrue(same(again.pose, scene.pose))
        middle = np.array([scene.cage.mean()])
        moved = again.map(middle, time=0.75) - middle
        self.assertTrue(0 < moved[0].real < 10, moved)
        again.remove_key(1.5)
        self.assertEqual(again.keys, [0])
        self.assertEqual(os.path.basename(again.picture), "red.png")

    def test_the_background_fills_gaps(self):
        scene = self.scene()
        scene.pose = scene.cage + 400
        middle = 150, 200  # row and column
        self.assertEqual(scene.background, "original")  # the picture has no transparency
        for background, color in (("original", [200, 40, 40, 255]), ("transparent", [0, 0, 0, 0]), ("#0a141e", [10, 20, 30, 255])):
            scene.background = background
            self.assertEqual(scene.background, background)
            self.assertEqual(list(scene.render(region=(0, 0, 400, 300))[middle]), color)
        for wrong in ("blue", "#12345", "#gggggg", "#1234567", "#    ff", "#-00001", "#0x00ff"):
            with self.assertRaises(holomorph.InvalidInput):
                scene.background = wrong

    def test_curves_and_holes(self):
        square = np.array([0, 10 - 5j, 20 - 5j, 30, 35 + 10j, 35 + 20j, 30 + 30j, 20 + 35j, 10 + 35j, 30j, -5 + 20j, -5 + 10j])
        scene = holomorph.Scene()
        scene.set_cage(square, degree=3)
        self.assertEqual(len(scene.cage), 12)
        np.testing.assert_allclose(scene.map([15 + 15j]), [15 + 15j], atol=1e-9)
        hole = 15 + 15j + 4 * np.exp(-2j * np.pi * np.arange(6) / 6)
        scene.set_cage(np.array([0, 30, 30 + 30j, 30j]), holes=[hole])
        self.assertTrue(np.isnan(scene.map([15 + 15j])[0]))
        np.testing.assert_allclose(scene.map([5 + 5j]), [5 + 5j], atol=1e-9)

    def test_parts_move_alone_until_another_method_joins_them(self):
        square = np.array([0, 30, 30 + 30j, 30j])
        scene = holomorph.Scene()
        scene.set_cage(square, parts=[square + 50], holes=[65 + 15j + 4 * np.exp(-2j * np.pi * np.arange(6) / 6)])
        self.assertEqual(scene.method, "sheet")
        self.assertEqual(len(scene.cage), 14)
        scene.pins = [holomorph.Pin(at, at + shift) for at, shift in
                      ((5 + 5j, 0), (25 + 5j, 0), (55 + 5j, 10j), (75 + 5j, 10j))]
        np.testing.assert_allclose(scene.map([10 + 10j, 60 + 25j]), [10 + 10j, 60 + 35j], atol=0.1)
        self.assertTrue(np.isnan(scene.map([65 + 15j])[0]))
        scene.method = "pins"
        self.assertFalse(np.isnan(scene.map([40 + 15j])[0]))
        # Each method keeps its own parameters.
        scene.method = "bounded"
        scene.parameters = {"pin_weight": 500}
        scene.set_cage(square, parts=[square + 50])
        self.assertEqual((scene.method, scene.parameters), ("sheet", {}))
        scene.method = "bounded"
        self.assertEqual(scene.parameters, {"pin_weight": 500})

    def test_mistakes_are_explained_and_change_nothing(self):
        scene = self.scene()
        before = scene.cage
        for says, mistake in (("crosses itself", lambda: scene.set_cage([0, 10 + 10j, 10, 10j])),
                              ("multiple", lambda: scene.set_cage(before, degree=2)),
                              ("no_such", lambda: setattr(scene, "method", "no_such")),
                              ("control points", lambda: setattr(scene, "pose", before[1:])),
                              ("there is no keyframe", lambda: scene.remove_key(4)),
                              ("layers", lambda: setattr(scene, "layer", 7)),
                              ("kinds are", lambda: holomorph.coordinates(before, before, "fancy")),
                              ("pixels", lambda: holomorph.set_limit("fancy", 1)),
                              ("view", lambda: scene.render(view="fancy")),
                              ("above 0", lambda: holomorph.set_limit("max-pixels", -1)),
                              ("region is empty", lambda: scene.render(region=(5, 5, 1, 1))),
                              ("order 0 to 12", lambda: holomorph.coordinates(before, before, order=1000)),
                              ("no cage", lambda: holomorph.Scene().map([0j]))):
            with self.subTest(says=says), self.assertRaises(holomorph.InvalidInput) as caught:
                mistake()
            self.assertIn(says, str(caught.exception))
            self.assertIsInstance(caught.exception, ValueError)
        self.assertTrue(same(scene.cage, before))
        self.assertEqual(scene.method, "cage")
        with open(self.path("broken.json"), "w") as file:
            file.write('{"format": "holomorph", "version": 1, "cage": 5}')
        with self.assertRaisesRegex(holomorph.InvalidInput, "broken.json: /cage"):
            holomorph.load(self.path("broken.json"))
        with self.assertRaises(holomorph.Error):
            holomorph.load(self.path("missing.json"))
        with self.assertRaisesRegex(holomorph.Error, "red.png"):
            scene.save(self.path("red.png"))


class Resources(Folder):
    def test_results_own_their_memory(self):
        scene = self.scene()
        points = scene.mesh().vertices
        mapped = scene.map(points)
        del scene
        self.assertTrue(mapped.flags.aligned and not mapped.flags.owndata and mapped.base is not None)
        self.assertTrue(np.isfinite(mapped).all())

    def test_thousands_of_calls_leak_nothing(self):
        scene = self.scene("pins")
        points = scene.mesh().vertices[:200]
        image = scene.cage.mean() + np.arange(3)

        def calls(count):
            for i in range(count):
                scene.map(points)
                holomorph.coordinates(scene.cage, points[:20])
                scene.inverse(image)
                try:
                    scene.map([1.0])
                except TypeError:
                    pass
                if i % 100 == 0:
                    scene.pose = scene.pose
                    scene.render(scale=0.1)

        calls(300)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        count = few_or_many(1250, 2500)
        calls(count)  # of four functions
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        self.assertLess(grown, 1.6 * count, "kilobytes; a leak of the results of map() would be twice that")

    def test_other_threads_run_meanwhile(self):
        scene = self.scene("angles")
        many = scene.cage.mean() + 20 * self.rng.random(200_000)
        turns, done = 0, threading.Event()

        def work():
            scene.map(many)
            done.set()

        worker = threading.Thread(target=work)
        worker.start()
        while not done.is_set():
            time.sleep(0.001)
            turns += 1
        worker.join()
        self.assertGreater(turns, 3, "Python's lock was held")

    def test_threads_may_share_a_scene(self):
        scene = self.scene("pins")
        points = scene.mesh().vertices
        expected, wrong = scene.map(points), []

        def work():
            for _ in range(20):
                if not same(scene.map(points), expected):
                    wrong.append(1)
                scene.pins = scene.pins

        workers = [threading.Thread(target=work) for _ in range(4)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        self.assertEqual(wrong, [])


class Packaging(Folder):
    def test_the_stubs_have_what_stubgen_finds(self):
        # Versions of stubgen write types in different ways, so only that of mypy 1.0 is compared word by word.
        # Of all others, names and arguments are, and how many of them have defaults.
        def signatures(path):
            with open(path) as file:
                tree = ast.parse(file.read())
            found = set()
            for owner in [tree] + [node for node in ast.walk(tree) if isinstance(node, ast.ClassDef)]:
                for node in owner.body:
                    if isinstance(node, ast.FunctionDef):
                        found.add((getattr(owner, "name", ""), node.name, tuple(each.arg for each in node.args.args + node.args.kwonlyargs),
                                   len(node.args.defaults), sum(each is not None for each in node.args.kw_defaults)))
                    elif isinstance(node, ast.ClassDef):
                        found.add((node.name,))
            return found - {("Error",), ("InvalidInput",)}  # exceptions, which only some versions take for classes

        subprocess.run(["stubgen", "-p", "holomorph._core", "-o", self.path("stubs"), "-q"], check=True,
                       env={**os.environ, "PYTHONPATH": PACKAGE}, cwd=self.folder.name, stdout=subprocess.DEVNULL)
        made = signatures(self.path("stubs/holomorph/_core.pyi"))
        self.assertGreater(len(made), 20)
        self.assertEqual(made, signatures(os.path.join(SOURCE, "src/python/holomorph/_core.pyi")),
                         "run stubgen -p holomorph._core again, and change its output as this test does")
        if subprocess.run(["mypy", "--version"], check=True, capture_output=True, text=True).stdout.startswith("mypy 1.0"):
            with open(self.path("stubs/holomorph/_core.pyi")) as made, \
                    open(os.path.join(SOURCE, "src/python/holomorph/_core.pyi")) as kept:
                # pybind11 says os.PathLike where it takes texts, too, and stubgen leaves out __version__.
                stubs = made.read().replace("os.PathLike", "Union[str, os.PathLike]")
                stubs = stubs.replace("Optional, Tuple\n", "Optional, Tuple, Union\n", 1).replace("import os\n", "import os\n\n__version__: str\n", 1)
                self.assertEqual(stubs, kept.read(), "run stubgen -p holomorph._core again, and change its output as this test does")
        with open(self.path("uses.py"), "w") as file:
            file.write("import holomorph\nscene = holomorph.Scene('a.png')\nscene.save('a.json')\n"
                       "holomorph.load('a.json').render()\nprint(holomorph.__version__)\n")
        checked = subprocess.run(["mypy", self.path("uses.py")], capture_output=True, text=True, cwd=self.folder.name,
                                 env={**os.environ, "MYPYPATH": os.path.join(SOURCE, "src/python")})
        self.assertEqual(checked.returncode, 0, checked.stdout)

    def test_every_name_has_a_docstring(self):
        for name in holomorph.__all__:
            thing = getattr(holomorph, name)
            self.assertTrue(thing.__doc__, name)
            for member in vars(thing) if isinstance(thing, type) and thing.__module__.startswith("holomorph") else ():
                if not member.startswith("_") and not issubclass(thing, Exception):
                    self.assertTrue(getattr(thing, member).__doc__, f"{name}.{member}")

    def test_the_example_runs(self):
        subprocess.run([sys.executable, os.path.join(SOURCE, "docs/examples/warp.py"), self.folder.name], check=True,
                       env={**os.environ, "PYTHONPATH": PACKAGE, "MPLBACKEND": "Agg"}, stdout=subprocess.DEVNULL)
        for name in ("grid.png", "drawing.svg", "photograph.png", "distortion.png"):
            self.assertGreater(os.path.getsize(self.path(name)), 2000, name)

    def test_pip_installs_it(self):
        """In an environment that has the system's packages, from a build folder that exists already."""
        subprocess.run(["/usr/bin/python3", "-m", "venv", "--system-site-packages", self.path("env")], check=True)
        build = os.path.dirname(PACKAGE)
        with open(os.path.join(build, "CMakeCache.txt")) as file:
            before = next(line.split("=", 1)[1].strip() for line in file if line.startswith("PYTHON_EXECUTABLE:"))
        # The environment's Python is gone after the test.
        self.addCleanup(subprocess.run, ["cmake", "-DPYTHON_EXECUTABLE=" + before, build], check=True, capture_output=True)
        done = subprocess.run([self.path("env/bin/python"), "-m", "pip", "install", "--no-build-isolation", "--no-index", SOURCE],
                              env={**os.environ, "HOLOMORPH_BUILD": build}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        told = subprocess.run([self.path("env/bin/python"), "-c", "import holomorph; print(holomorph.__file__, holomorph.methods())"],
                              capture_output=True, text=True, cwd=self.folder.name)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn(self.path("env"), told.stdout)
        self.assertIn("bounded", told.stdout)


if __name__ == "__main__":
    timed.main(sys.argv[4:])
