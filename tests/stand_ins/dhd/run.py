# SPDX-License-Identifier: BSD-3-Clause
"""Runs a client with the library in place, and prints the verdict."""

import argparse
import ctypes
import os
import pathlib
import platform
import signal
import subprocess
import sys
import tempfile

NAME = "libdhd.so.3"


def library_of(said):
    """The file of the library; raises OSError with where it was looked for."""
    here = pathlib.Path(__file__).resolve()
    top = here.parents[3]
    installed = [file for pattern in ("lib/*/forceshade/", "lib/forceshade/") for file in here.parents[4].glob(pattern + NAME)]
    built = sorted(top.glob("build/*/tests/stand_ins/dhd/" + NAME), key=lambda file: file.stat().st_mtime, reverse=True)
    places = [pathlib.Path(said)] if said else installed + built
    for place in places:
        if place.is_file():
            return place.resolve()
    raise OSError(f"expected {said or NAME + ' below lib or build'}, which is built by scripts/build; name it with --library")


def options_of(words):
    parser = argparse.ArgumentParser(
        prog="forceshade-standin dhd", add_help=False,
        description="Force Dimension's library DHD with a device in a simulated hand; it judges the client that loads it.",
        usage="forceshade-standin dhd [OPTIONS] [-- COMMAND ...]")
    add = parser.add_argument
    add("-h", "--help", action="store_true", help="print this, and the tables of faults, assumptions and events")
    add("--library", metavar="FILE", help="the stand-in's " + NAME + "; found by itself where it was installed or built")
    add("--assume", action="append", default=[], metavar="NAME=VALUE")
    add("--event", action="append", default=[], metavar="NAME@READING")
    add("--report", metavar="FILE", help="the file for the verdict, as JSON")
    add("--log", metavar="FILE", help="the file for the events, one JSON object a line")
    add("--judge", metavar="LOG", help="print the verdict of a client that was run with this journal, and run none")
    add("command", nargs="*", metavar="COMMAND", help="the client, with FORCESHADE_DHD_LIBRARY and LD_LIBRARY_PATH set; "
        "without one, what has to be set is printed for a shell")
    return parser, parser.parse_args(words)


def environment(library, settings, journal):
    path = os.environ.get("LD_LIBRARY_PATH", "")
    return {"FORCESHADE_DHD_LIBRARY": str(library), "LD_LIBRARY_PATH": str(library.parent) + (":" + path if path else ""),
            "FORCESHADE_STANDIN_DHD": settings, "FORCESHADE_STANDIN_JOURNAL": str(journal)}


def expect_writable(report):
    """Raises OSError where no report can be written; leaves none."""
    if report:
        was_there = os.path.exists(report)
        open(report, "a").close()
        if not was_there:
            os.unlink(report)


def sdk(folder, library):
    """A folder as the vendor's SDK, which some clients look into where FDSDK names it."""
    place = folder / "sdk" / "lib" / "release" / f"lin-{platform.machine()}-gcc"
    place.mkdir(parents=True)
    for name in ("libdhd.so.3", "libdrd.so.3"):
        (place / name).symlink_to(library)
    return str(folder / "sdk")


def run(command, more):
    """The client's exit code; it is given the signals that this program is given."""
    client = subprocess.Popen(command, env={**os.environ, **more})
    for sort in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(sort, lambda number, _: client.send_signal(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # of a terminal, which the client has, too
    return client.wait()


def verdict(loaded, library, journal, report, whose="the client"):
    kinds = loaded.forceshade_stand_in_verdict(os.fsencode(str(journal)), os.fsencode(report or ""))
    if kinds < 0:
        words = {-1: f"{whose} did not load the library, {library}: it has to load {NAME}, or the file that FORCESHADE_DHD_LIBRARY names",
                 -2: f"{whose} loaded the library, and called none of its functions",
                 -3: f"{report}: expected a file that can be written"}
        print(f"forceshade-standin dhd: {words[kinds]}", file=sys.stderr)
        return 2
    return 1 if kinds > 0 else 0


def main(words):
    parser, options = options_of(words)
    try:
        library = library_of(options.library)
        os.environ.pop("FORCESHADE_STANDIN_JOURNAL", None)  # this program is no client, although it loads the library
        loaded = ctypes.CDLL(str(library))
        loaded.forceshade_stand_in_settings.restype = ctypes.c_char_p
    except (OSError, AttributeError) as error:
        if options.help:
            parser.print_help()
        print(f"forceshade-standin dhd: {error}", file=sys.stderr)
        return 0 if options.help else 2
    if options.help:
        parser.print_help(sys.stdout)
        sys.stdout.flush()
        loaded.forceshade_stand_in_describe()
        print("exit codes: 0, no fault; 1, faults, which were printed; 2, wrong options, or the client did not load the library "
              "or called nothing of it")
        return 0
    settings = ",".join(options.assume + options.event)
    wrong = loaded.forceshade_stand_in_settings(os.fsencode(settings)).decode()
    if wrong:
        print(f"forceshade-standin dhd: {wrong}", file=sys.stderr)
        return 2
    if options.judge:
        return verdict(loaded, library, options.judge, options.report, f"the client of {options.judge}")
    with tempfile.TemporaryDirectory() as folder:
        journal = pathlib.Path(options.log).resolve() if options.log else pathlib.Path(folder) / "journal"
        try:
            for file in (journal, journal.with_name(journal.name + ".state")):
                file.unlink(missing_ok=True)
            journal.touch()
            expect_writable(options.report)
        except OSError as error:
            print(f"forceshade-standin dhd: {error.filename}: cannot be written: {error.strerror}", file=sys.stderr)
            return 2
        more = {**environment(library, settings, journal), "FDSDK": sdk(pathlib.Path(folder), library)}
        if not options.command:
            more["FORCESHADE_STANDIN_JOURNAL"] = str(journal) if options.log else ""
            del more["FDSDK"]  # its folder ends with this program
            for name, value in more.items():
                print(f"export {name}='{value}'")
            return 0
        try:
            code = run(options.command, more)
        except OSError as error:
            print(f"forceshade-standin dhd: {options.command[0]}: {error.strerror}", file=sys.stderr)
            return 2
        if code != 0:
            print(f"the client ended with {'signal ' + str(-code) if code < 0 else 'exit code ' + str(code)}", file=sys.stderr)
        return verdict(loaded, library, journal, options.report)
