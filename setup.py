"""Builds the Python module with CMake. HOLOMORPH_BUILD names a build folder to use instead of build/python."""
import os
import re
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = os.path.dirname(os.path.abspath(__file__))


def version():
    with open(os.path.join(HERE, "CMakeLists.txt")) as file:
        return re.search(r"project\(holomorph VERSION ([\d.]+)", file.read())[1]


class BuildWithCMake(build_ext):
    def run(self):
        build = os.path.abspath(os.environ.get("HOLOMORPH_BUILD", os.path.join(HERE, "build/python")))
        options = ["-DHOLOMORPH_PYTHON=ON", "-DPYTHON_EXECUTABLE=" + sys.executable]
        if not os.path.exists(os.path.join(build, "build.ninja")):
            options += ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DHOLOMORPH_TESTS=OFF"]
        subprocess.check_call(["cmake", "-S", HERE, "-B", build, *options])
        subprocess.check_call(["cmake", "--build", build, "--target", "holomorph_python"])
        for extension in self.extensions:
            target = self.get_ext_fullpath(extension.name)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            folder = os.path.join(build, "python/holomorph")
            self.copy_file(os.path.join(folder, "_core" + sysconfig.get_config_var("EXT_SUFFIX")), target)


setup(
    name="holomorph",
    version=version(),
    description="Deforms pictures by conformal, bounded-distortion and other maps",
    license="GPL-3.0-or-later",  # the module links CGAL; holomorph's own code is MIT
    packages=["holomorph"],
    package_dir={"": "src/python"},
    package_data={"holomorph": ["py.typed", "_core.pyi"]},
    ext_modules=[Extension("holomorph._core", [])],
    cmdclass={"build_ext": BuildWithCMake},
    python_requires=">=3.9",
    install_requires=["numpy"],
)
