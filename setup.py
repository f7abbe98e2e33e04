# SPDX-License-Identifier: BSD-3-Clause
"""Makes the compiled module with CMake, for pip and build, and puts the libraries that it needs beside it: docs/python.md.

The build folder is build/release of the sources, as scripts/build makes it, or that of the environment variable
FORCESHADE_BUILD. What it has compiled is used again.
"""

import hashlib
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


OF_EVERY_SYSTEM = ("ld-linux", "libc.", "libdl.", "libgcc_s.", "libm.", "libpthread.", "librt.", "libstdc++.")


def carry_libraries(module):
    """Copies the shared libraries that not every system has into libs/ beside the module, with their licences.

    They get names of their own there, as auditwheel gives them: the interpreter and other packages may load others of the usual
    names in the same process.
    """
    try:
        said = subprocess.run(["ldd", module], check=True, capture_output=True, text=True).stdout
        found = {name: pathlib.Path(path) for name, path in re.findall(r"(\S+) => (/\S+)", said) if not name.startswith(OF_EVERY_SYSTEM)}
        libs = module.parent / "libs"
        shutil.rmtree(libs, ignore_errors=True)
        libs.mkdir()
        own, packages = {}, set()
        for name, path in found.items():
            stem, rest = name.split(".so", 1)
            own[name] = f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so{rest}"
            shutil.copy(path, libs / own[name])
            owner = subprocess.run(["dpkg", "-S", f"*/{path.resolve().name}"], check=True, capture_output=True, text=True).stdout
            packages.add(owner.split(":")[0])
        for file in (module, *(libs / name for name in own.values())):  # one change in each call: patchelf 0.14 mixes up several
            needed = subprocess.run(["patchelf", "--print-needed", file], check=True, capture_output=True, text=True).stdout.split()
            changes = [["--replace-needed", name, own[name]] for name in needed if name in own]
            changes.append(["--set-rpath", "$ORIGIN/libs" if file == module else "$ORIGIN"])
            if file != module:
                changes.append(["--set-soname", file.name])
            for change in changes:
                subprocess.run(["patchelf", *change, file], check=True)
        for package in packages:
            shutil.copy(f"/usr/share/doc/{package}/copyright", libs / f"{package}.copyright")
    except (FileNotFoundError, subprocess.CalledProcessError) as failed:
        sys.exit(f"{failed}; expected ldd, dpkg and patchelf, which scripts/setup installs on Debian, to carry libraries in the package")


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
        carry_libraries(target)


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
