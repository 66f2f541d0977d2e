"""Builds the compiled part by CMake, for `pip install ./lib/python` in a checkout: a compiler, CMake and Eigen have to be there."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent


class ByCMake(build_ext):
    def build_extension(self, extension):
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        build = here.parents[1] / "build" / f"pip-{sys.implementation.cache_tag}"
        subprocess.run(
            ["cmake", "-S", here, "-B", build, "-DCMAKE_BUILD_TYPE=Release", f"-DPython_EXECUTABLE={sys.executable}",
             f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"], check=True,
        )  # fmt: skip
        subprocess.run(["cmake", "--build", build, "--target", "_avi", "--parallel", str(os.cpu_count())], check=True)
        self.copy_file(next((build / "avi").glob("_avi*")), target)


setup(
    version=re.search(r"project\(avi VERSION ([\d.]+)", (here / "../../CMakeLists.txt").read_text())[1],
    ext_modules=[Extension("avi._avi", [])],
    cmdclass={"build_ext": ByCMake},
)
