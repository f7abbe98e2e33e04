# SPDX-License-Identifier: BSD-3-Clause
"""Arms that a test drives forceshade over: an Inverse3 and a device of DHD, each behind its stand-in, and a program of one's own.
Each says when a hand comes into contact, and the last moment at which the arm felt a force."""

import json
import math
import os
import select
import socket
import subprocess
import sys
import tempfile
import threading
import time

from haply.stand_in import StandIn, skip_without_websockets
from stalls import may_run_in_real_time

STAND_IN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "stand_ins", "forceshade-standin")


class Arm:
    """An arm, what goes wrong with it ("unplug@contact"), and the journal of what happened, of which each line has a time in ns
    and an event: "contact", "free" and the names of what went wrong."""

    journal, partner, link = "", None, None  # the last two: processes that a test may end, as their ids

    def __enter__(self):
        return self

    def events(self):
        if not os.path.exists(self.journal):
            return []
        with open(self.journal) as file:
            return [json.loads(line) for line in file if line.endswith("\n")]

    def first(self, event, is_alive=lambda: True):
        """The time of the first such event, in ns; none where it does not come before the client ends."""
        while True:
            was_alive = is_alive()
            for entry in self.events():
                if entry["event"] == event:
                    return entry["time_ns"]
            if not was_alive:
                return None
            time.sleep(0.001)

    def felt_until(self):
        """ns, once the client is gone; 0 where it felt no force, none where the force stays until its own time-out, if it has one."""
        changes = [entry for entry in self.events() if entry["event"] in ("contact", "free")]
        if not changes:
            return 0
        return changes[-1]["time_ns"] if changes[-1]["event"] == "free" else self.held_until()


class Haply(Arm):
    """With a process between service and client where `between` is said: a link that can be cut."""

    device, longest_ms = "haply", 110  # the default of idle-after

    def __init__(self, events=(), options=(), between=False):
        skip_without_websockets()
        words = [word for event in events for word in ("--event", event)]
        self.service = StandIn(STAND_IN, "--longest-gap", "3600000", *words, *options)
        self.journal, self.partner = self.service.log_file, self.service.process.pid
        self.between = subprocess.Popen([sys.executable, os.path.abspath(__file__), "--between", self.service.address],
                                        stdout=subprocess.PIPE, text=True) if between else None
        self.link = self.between.pid if between else None
        address = self.between.stdout.readline().strip() if between else self.service.address
        self.environment = {"FORCESHADE_HAPLY_SERVICE": address}

    def __exit__(self, *_):
        if self.between:
            self.between.kill()
            self.between.communicate()
        self.service.__exit__()

    def held_until(self):
        if self.first("ended") is None:
            return None
        return [entry for entry in self.events() if entry["event"] == "ended"][-1]["force_until_ns"]

    def verdict(self):
        """The names of the client's faults."""
        try:
            self.service.process.wait(10)  # it ends with its one session
        except subprocess.TimeoutExpired:
            self.service.process.terminate()
        return set(self.service.verdict()[1]["faults"])


class Dhd(Arm):
    device, longest_ms = "dhd", 31.875  # its watchdog
    library = ""  # the stand-in's

    def __init__(self, events=(), options=()):
        self.folder = tempfile.TemporaryDirectory()
        self.journal = os.path.join(self.folder.name, "journal")
        self.environment = {"FORCESHADE_DHD_LIBRARY": self.library, "FORCESHADE_STANDIN_JOURNAL": self.journal,
                            "FORCESHADE_STANDIN_DHD": ",".join(["longest-gap=3600000", *options, *events])}

    def __exit__(self, *_):
        self.folder.cleanup()

    def judged(self):
        report = os.path.join(self.folder.name, "report")
        subprocess.run([sys.executable, STAND_IN, "dhd", "--library", self.library, "--judge", self.journal, "--report", report],
                       stderr=subprocess.DEVNULL, check=False)
        with open(report) as file:
            return json.load(file)

    def held_until(self):
        return self.judged()["sessions"][-1]["force_until_ns"] or None

    def verdict(self):
        return set(self.judged()["faults"])


class Command(Arm):
    """The program is this file; it has a zero force where no line has come for 25 ms, as docs/command-device.md requires. With the
    option "by-lines" it waits for ever, and its time is that of the lines at 1 kHz."""

    longest_ms = 60

    def __init__(self, events=(), options=()):
        self.folder = tempfile.TemporaryDirectory()
        self.journal, self.environment = os.path.join(self.folder.name, "journal"), {}
        words = ["chrt", "--fifo", "50"] if may_run_in_real_time() else []  # so that other programs do not make it late
        self.device = "command:exec " + " ".join([*words, sys.executable, os.path.abspath(__file__), "--program", self.journal, *options])

    def __exit__(self, *_):
        self.folder.cleanup()

    @property
    def partner(self):
        return self.events()[0]["process"]

    def felt_until(self):
        self.first("over")  # its lines have ended
        return super().felt_until()

    def held_until(self):
        return None

    def verdict(self):
        return set()


class Program:
    def __init__(self, journal, by_lines=False):
        self.journal, self.pushes, self.by_lines = open(journal, "a", buffering=1), False, by_lines
        self.note("opened", process=os.getpid())

    def note(self, event, **more):
        print(json.dumps({"time_ns": time.monotonic_ns(), "event": event, **more}), file=self.journal)

    def take(self, force):
        if force != self.pushes:
            self.note("contact" if force else "free")
        self.pushes = force

    def lines(self):
        """Those of standard input; nothing in the place of one that has not come for 25 ms."""
        text = b""
        while True:
            while b"\n" not in text:
                if not self.by_lines and not select.select([0], [], [], 0.025)[0]:
                    yield None
                    continue
                some = os.read(0, 4096)
                if not some:
                    return
                text += some
            line, text = text.split(b"\n", 1)
            yield json.loads(line)

    def run(self):
        print(json.dumps({"forceshade-device": 1, "name": "an arm", "workspace_mm": [[-100, -100, -100], [100, 100, 100]],
                          "peak_force_N": 3, "continuous_force_N": 1, "resolution_mm": 0.05, "buttons": 1, "paces": False}), flush=True)
        begin, count = time.monotonic(), 0
        for line in self.lines():
            force = line.get("force_N") if line else None
            self.take(any(force or [0]))
            if line and "end" in line:
                break
            if force is None:
                continue
            count += 1
            seconds = count / 1000 if self.by_lines else time.monotonic() - begin
            print(json.dumps({"time_s": seconds, "position_mm": [0, 0, 1.5 + 2.5 * math.cos(math.pi * seconds)], "buttons": 1}), flush=True)
        self.take(False)
        self.note("over")


KINDS = {"haply": Haply, "dhd": Dhd, "command": Command}


def forward(source, sink):
    """Until one of them is gone."""
    try:
        while some := source.recv(65536):
            sink.sendall(some)
    except OSError:
        pass
    for one in (source, sink):
        one.close()


def between(address):
    """A process that stands between a client and the service at this address. Prints its own address."""
    host, port = address.rsplit(":", 1)
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(75))
    except OSError:
        pass
    with socket.create_server(("127.0.0.1", 0)) as server:
        print(f"127.0.0.1:{server.getsockname()[1]}", flush=True)
        while True:
            client, _ = server.accept()
            service = socket.create_connection((host, int(port)))
            for one in (client, service):
                one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            threading.Thread(target=forward, args=(client, service), daemon=True).start()
            threading.Thread(target=forward, args=(service, client), daemon=True).start()


if __name__ == "__main__":
    if sys.argv[1] == "--program":
        Program(sys.argv[2], "by-lines" in sys.argv[3:]).run()
    else:
        between(sys.argv[2])
