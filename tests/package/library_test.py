# The installed libraries, used by separate projects: every method, and the programs in docs/library.md.
import os
import re
import subprocess
import sys
import tempfile
import unittest

BUILD, SOURCE = sys.argv[1:3]
sys.path.append(os.path.join(SOURCE, "tests/support"))
import timed  # noqa: E402


def run(*command, **more):
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode:
        raise AssertionError(f"{' '.join(command)}: status {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def code_blocks(language):
    with open(os.path.join(SOURCE, "docs/library.md")) as file:
        return [code for kind, code in re.findall(r"^```(\w*)\n(.*?)^```$", file.read(), re.S | re.M) if kind == language]


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="holomorph-library-")
        cls.prefixes = {}
        for name, components in (("core", ["core"]), ("both", ["core", "mesher"])):
            cls.prefixes[name] = os.path.join(cls.folder.name, name)
            for component in components:
                run("cmake", "--install", BUILD, "--component", component + "_development", "--prefix", cls.prefixes[name])

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def built(self, source, prefix):
        """Builds the project in the folder `source` against the installed tree `prefix`, and returns the build folder."""
        build = tempfile.mkdtemp(dir=self.folder.name)
        run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_PREFIX_PATH=" + self.prefixes[prefix])
        run("cmake", "--build", build)
        return build

    def project(self, cmake, program):
        source = tempfile.mkdtemp(dir=self.folder.name)
        for name, text in (("CMakeLists.txt", cmake), ("bend.cpp", program)):
            with open(os.path.join(source, name), "w") as file:
                file.write(text)
        return source

    def test_every_method_runs(self):
        table = run(os.path.join(self.built(os.path.join(SOURCE, "tests/library"), "both"), "every_method"))
        self.assertGreaterEqual(table.count(" ok\n"), 20, table)

    def test_the_documented_program_needs_the_core_alone_and_prints_what_it_says(self):
        program = code_blocks("cpp")[0]
        built = os.path.join(self.built(self.project(code_blocks("cmake")[0], program), "core"), "bend")
        self.assertEqual([run(built)], code_blocks(""))
        self.assertNotIn("libgmp", run("ldd", built))

    def test_the_documented_pieces_compile(self):
        pieces = code_blocks("cpp")[1:]
        includes = "".join(line + "\n" for piece in pieces for line in piece.splitlines() if line.startswith("#include"))
        bodies = "".join(line + "\n" for piece in pieces for line in piece.splitlines() if not line.startswith("#include"))
        program = f"""#include <holomorph/deformer.h>
            #include <cstdio>
            {includes}
            using namespace holomorph;
            int main() {{
              Rest rest;
              rest.cage = polygon_cage(Points{{{{0, 0}}, {{4, 0}}, {{0, 3}}}});
              const Points vertices = vertices_of(rest.cage);
              const std::vector<Triangle> triangles = {{{{0, 1, 2}}}};
              {bodies}
            }}"""
        cmake = code_blocks("cmake")[0].replace("find_package(holomorph REQUIRED)", "find_package(holomorph REQUIRED COMPONENTS mesher)")
        cmake = cmake.replace("holomorph::core", "holomorph::mesher")
        methods = run(os.path.join(self.built(self.project(cmake, program), "both"), "bend"))
        self.assertIn("arap (needs a mesh)", methods)

    def test_the_core_is_free_of_what_is_under_the_gpl(self):
        names = [os.path.join(folder, name) for folder, _, files in os.walk(self.prefixes["core"]) for name in files]
        headers = [os.path.relpath(n, os.path.join(self.prefixes["core"], "include")) for n in names if n.endswith(".h")]
        self.assertIn("holomorph/deformer.h", headers)
        self.assertTrue(all(os.path.dirname(h) == "holomorph" for h in headers), headers)
        for name in (n for n in names if not n.endswith(".md")):
            with open(name, "rb") as file:
                text = file.read()
            self.assertNotIn(b"CGAL::", text.replace(b"find_dependency(CGAL", b""), name)
            self.assertNotIn(b"domain_mesh(", text, name)
            self.assertNotIn(b'#include "core/', text, name)
        source = self.project(code_blocks("cmake")[0].replace("REQUIRED", "REQUIRED COMPONENTS mesher"), code_blocks("cpp")[0])
        with self.assertRaisesRegex(AssertionError, "mesher"):
            self.built(source, "core")


if __name__ == "__main__":
    timed.main(sys.argv[3:])
