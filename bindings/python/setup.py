# SPDX-License-Identifier: BSD-3-Clause
"""Makes the compiled module with CMake, for pip and build: docs/python.md.

The build folder is build/release of the sources, as scripts/build makes it, or that of the environment variable
FORCESHADE_BUILD. What it has compiled is used again.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCES = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("FORCESHADE_BUILD", SOURCES / "build" / "release"))


class CMakeModule(build_ext):
    def build_extension(self, ext):
        if not (SOURCES / "CMakeLists.txt").exists():
            sys.exit(f"expected the sources of forceshade in {SOURCES}: the package is compiled in bindings/python of them")
        if not (BUILD / "CMakeCache.txt").exists():
            subprocess.run(
                ["cmake", "-S", SOURCES, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
                + ["-DCMAKE_CXX_FLAGS_RELEASE=-O3", "-DBUILD_TESTING=OFF", f"-DPython3_EXECUTABLE={sys.executable}"],
                check=True,
            )
        subprocess.run(["cmake", "--build", BUILD, "--target", "forceshade_python"], check=True)
        made = BUILD / "python" / "forceshade" / f"_forceshade{sysconfig.get_config_var('EXT_SUFFIX')}"
        if not made.exists():
            sys.exit(f"{BUILD} compiles for another Python than {sys.executable}; expected another folder in FORCESHADE_BUILD")
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(made, target)


# What is only made on the way to the wheel goes into the build folder, not among the sources.
scratch = BUILD / "wheel"
scratch.mkdir(parents=True, exist_ok=True)
version = re.search(r"project\(forceshade VERSION ([0-9.]+)", (SOURCES / "CMakeLists.txt").read_text())
setup(
    version=version.group(1),
    ext_modules=[Extension("forceshade._forceshade", sources=[])],
    cmdclass={"build_ext": CMakeModule},
    options={"build": {"build_base": str(scratch)}, "egg_info": {"egg_base": str(scratch)}},
)
