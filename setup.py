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

SOURCES = pathlib.Path(__file__).resolve().parent
BUILD = pathlib.Path(os.environ.get("FORCESHADE_BUILD", SOURCES / "build" / "release"))


def run_cmake(*words):
    try:
        subprocess.run(["cmake", *words], check=True)
    except FileNotFoundError:
        sys.exit("expected cmake 3.25 or later in the PATH, with ninja; scripts/setup installs what the package needs on Debian")
    except subprocess.CalledProcessError as failed:
        sys.exit(f"cmake failed with exit code {failed.returncode}; the package needs what scripts/setup installs (docs/python.md)")


class CMakeModule(build_ext):
    def build_extension(self, ext):
        if not (BUILD / "CMakeCache.txt").exists():
            run_cmake(
                *["-S", SOURCES, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"],
                *["-DCMAKE_CXX_FLAGS_RELEASE=-O3", "-DBUILD_TESTING=OFF", f"-DPython3_EXECUTABLE={sys.executable}"],
            )
        run_cmake("--build", BUILD, "--target", "forceshade_python")
        made = BUILD / "python" / "forceshade" / f"_forceshade{sysconfig.get_config_var('EXT_SUFFIX')}"
        if not made.exists():
            sys.exit(f"{BUILD} compiles for another Python than {sys.executable}; expected another folder in FORCESHADE_BUILD")
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(made, target)


# Files that are only made on the way to the wheel go into the build folder, not among the sources.
scratch = BUILD / "wheel"
scratch.mkdir(parents=True, exist_ok=True)
version = re.search(r"project\(forceshade VERSION ([0-9.]+)", (SOURCES / "CMakeLists.txt").read_text())
setup(
    version=version.group(1),
    ext_modules=[Extension("forceshade._forceshade", sources=[])],
    cmdclass={"build_ext": CMakeModule},
    options={"build": {"build_base": str(scratch)}, "egg_info": {"egg_base": str(scratch)}},
)
