# SPDX-License-Identifier: BSD-3-Clause
"""The service: its sockets, its device, its report, and the command line."""

import argparse
import asyncio
import http
import json
import math
import os
import signal
import sys
import urllib.parse

from websockets.exceptions import ConnectionClosed, ConnectionClosedOK
from websockets.legacy.server import WebSocketServerProtocol, serve

from haply import judge, switches
from haply.arm import Arm
from haply.session import Session, now


class Protocol(WebSocketServerProtocol):
    """HTTP at the same port, and what comes after the end."""

    def __init__(self, *words, service, http_only, **options):
        super().__init__(*words, **options)
        self.service, self.http_only = service, http_only
        self.late_data = False

    def data_received(self, data):
        if getattr(self, "close_rcvd", None) is not None and data:
            self.late_data = True
        super().data_received(data)

    def has_message_waiting(self):
        buffer = self.reader._buffer  # there is no other way to look at what has come
        return bool(self.messages) or bool(buffer) and buffer[0] & 0x0F in (1, 2)  # text or binary

    async def process_request(self, path, headers):
        if headers.get("Upgrade", "").lower() == "websocket" and not self.http_only:
            return None
        return self.service.http(path, self.http_only)


class Service:
    def __init__(self, options):
        self.options = options
        self.judge, self.arm = judge.Judge(), Arm()
        self.sessions, self.over, self.reports = [], None, []
        major, minor = options.version.split(".")[:2]
        self.is_new = (int(major), int(minor)) >= (3, 5)
        self.basis, self.calibrated, self.powered = "XYZ", True, True
        self.unplugged, self.unplugged_at, self.pressed, self.died = False, 0, options.pressed, ""
        self.time, self.begun, self.count = now(), 0, 0
        self.log = open(options.log, "w", buffering=1) if options.log else None

    def assumed(self, name):
        return self.options.assumptions.get(name, switches.ASSUMPTIONS[name][0][0])

    def note(self, event, **more):
        if self.log:
            self.log.write(json.dumps({"time_ns": now(), "event": event, **more}) + "\n")

    def advance(self, to):
        """Moves the arm on, under the force that acted."""
        if self.options.clock == "messages":
            return self.arm.advance(1 / self.options.rate)
        seconds, self.time = (to - self.time) / 1e9, to
        idle = self.assumed("idle-after")
        held = seconds if idle == "never" else min(seconds, float(idle) / 1000)
        # A hand is not simulated for longer than it can be felt.
        self.arm.advance(min(held, 1.0))
        if seconds > held:
            self.arm.force = (0.0, 0.0, 0.0)
            self.arm.advance(min(seconds - held, 1.0))

    def apply(self):
        total = self.to_device([sum(session.force[i] for session in self.sessions) for i in range(3)])
        share = float(self.assumed("ration"))
        clamp = self.assumed("clamp")
        size = judge.length(total)
        if clamp != "none" and size > float(clamp):
            share *= float(clamp) / size
        self.arm.force = tuple(share * c for c in total) if self.powered and not self.unplugged else (0.0, 0.0, 0.0)

    async def watch_for_idle(self):
        """The device idles by itself, whether or not another message ever comes."""
        idle = self.assumed("idle-after")
        while idle != "never":
            await asyncio.sleep(0.005)
            for session in self.sessions:
                if judge.length(session.force) > 0 and now() - session.last > float(idle) * 1e6 and not session.is_idle:
                    session.is_idle = True
                    self.note("idle", session=session.number)

    def happen(self, event):
        if event == "unplug":
            self.unplugged, self.unplugged_at = True, self.sessions[-1].messages
        elif event in ("calibrated", "uncalibrated"):
            self.calibrated = event == "calibrated"
        elif event == "power-off":
            self.powered = False
        elif event == "press":
            self.pressed = not self.pressed
        elif event in ("die", "freeze"):
            self.died = event
        self.note(event)

    def state(self, session, with_config):
        grip = self.assumed("grip")
        message = {"inverse3": [], "verse_grip": [], "wireless_verse_grip": [], "custom_verse_grip": []}
        if not self.unplugged:
            message["inverse3"].append(self.arm_state(session, with_config))
        if grip == "wired":
            message["verse_grip"].append({"device_id": "1A2B", "status": {"ready": True}, "state": {
                "orientation": {"w": 1, "x": 0, "y": 0, "z": 0}, "button": self.pressed, "hall": 0}})
        elif grip == "wireless":
            message["wireless_verse_grip"].append({"device_id": "1A2B", "status": {"ready": True}, "state": {
                "orientation": {"w": 1, "x": 0, "y": 0, "z": 0}, "buttons": {"a": self.pressed, "b": False, "c": False},
                "battery_level": 0.8, "awake": True}})
        return message

    def arm_state(self, session, with_config):
        vector = lambda v: {"x": v[0], "y": v[1], "z": v[2]}
        others = any(other is not session for other in self.sessions)
        entry = {
            "device_id": self.options.device_id,
            "state": {"cursor_position": vector(self.to_session(self.arm.position)),
                      "cursor_velocity": vector(self.to_session(self.arm.velocity)),
                      "angular_position": {"a0": 0.0, "a1": 0.0, "a2": 0.0}, "body_orientation": {"w": 1, "x": 0, "y": 0, "z": 0},
                      "current_cursor_force": vector(self.to_session(self.arm.force, False)), "control_domain": "cartesian",
                      "control_mode": self.assumed("control-mode"), "transform": self.transform()},
            "status": {"calibrated": self.calibrated, "in_use": others or self.assumed("in-use") == "any",
                       "power_supply": self.powered, "ready": True, "started": True},
        }
        if self.assumed("force-reported") == "no":
            del entry["state"]["current_cursor_force"]
        if with_config:
            entry["config"] = {
                "type": self.options.type, "device_info": {"major_version": 1, "minor_version": 2, "id": 1181, "uuid": "stand-in-0001"},
                "extended_firmware_version": "1.2.3-stand-in", "gravity_compensation": {"enabled": True, "scaling_factor": 1.0},
                "handedness": self.options.handedness, "torque_scaling": {"enabled": False}, "preset": "defaults",
                "filters": {"force_gate": {"gain": 0.3}, "damping": {"scalar": 0.0}}}
            if self.assumed("basis-reported") == "yes":
                entry["config"]["basis"] = {"permutation": self.basis}
            if self.assumed("mount") == "turned":
                entry["config"]["mount"] = {"rotation": {"w": math.sqrt(0.5), "z": math.sqrt(0.5)}}
        return entry

    def transform(self):
        return {"scale": {"x": 2.0, "y": 2.0, "z": 2.0}} if self.assumed("transform") == "doubled" else {}

    def to_session(self, vector, is_length=True):
        """A vector of the device as its sessions have it."""
        x, y, z = vector
        if self.assumed("mount") == "turned":
            x, y = -y, x
        return tuple((2 if is_length and self.transform() else 1) * c for c in (x, y, z))

    def to_device(self, force):
        x, y, z = force
        return (y, -x, z) if self.assumed("mount") == "turned" else force

    def http(self, path, http_only):
        here = "before" if http_only else "same"
        url = urllib.parse.urlsplit(path)
        if self.assumed("http") != here:
            return http.HTTPStatus.NOT_FOUND, [], b""
        data = {"/version": {"version": self.options.version}, "/sessions": [{"session_id": s.number} for s in self.sessions],
                "/devices": self.state(None, True), "/settings": {}}.get(url.path)
        enveloped = self.assumed("envelope") == "always" or "format=json" in url.query
        if data is None:
            return http.HTTPStatus.BAD_REQUEST, [], json.dumps({"ok": False, "error": "no such path"}).encode()
        body = json.dumps({"ok": True, "data": data} if enveloped else data)
        return http.HTTPStatus.OK, [("Content-Type", "application/json")], body.encode()

    async def serve_client(self, socket, _path=None):
        self.begun += 1
        session = Session(self, socket, self.begun)
        if not self.sessions:
            self.time = now()  # the hand begins with the client
        self.sessions.append(session)
        how = "closed"
        try:
            await session.run()
            await socket.wait_closed()
        except ConnectionClosedOK:
            pass
        except ConnectionClosed as closed:
            own = closed.sent and not closed.rcvd
            how = "protocol" if own and closed.sent.code == 1002 else "abrupt-end" if not closed.rcvd else "closed"
        if how == "closed" and (socket.late_data or socket.reader._buffer):
            session.fault("after-close")
        session.end(how)
        self.sessions.remove(session)
        self.reports.append(session.report)
        self.count += 1
        if self.options.sessions and self.count >= self.options.sessions and not self.over.done():
            self.over.set_result(None)

    def report(self):
        return {"stand_in": "haply", "version": self.options.version, "held": not self.judge.faults,
                "assumptions": {name: self.assumed(name) for name in switches.ASSUMPTIONS},
                "sessions": self.reports, "faults": self.judge.faults}

    async def run(self):
        loop = asyncio.get_running_loop()
        self.over = loop.create_future()
        end = lambda: self.over.done() or self.over.set_result(None)
        for sort in (signal.SIGTERM, signal.SIGINT):  # handled after the loop's end too, so that the report is written whole
            signal.signal(sort, lambda *_: loop.is_closed() or loop.call_soon_threadsafe(end))
        ping = self.assumed("ping")
        options = {"compression": None, "ping_interval": None if ping == "never" else float(ping), "close_timeout": 1,
                   "max_queue": 32, "server_header": None}
        protocol = lambda http_only: lambda *w, **k: Protocol(*w, service=self, http_only=http_only, **k)
        host, port = "127.0.0.1", self.options.port
        async with serve(self.serve_client, host, port, create_protocol=protocol(False), **options) as server:
            port = server.sockets[0].getsockname()[1]
            before = None
            if self.assumed("http") == "before":
                before = await serve(self.serve_client, host, port - 1, create_protocol=protocol(True), **options)
            print(f"listening on {host}:{port}", flush=True)
            watch = loop.create_task(self.watch_for_idle())
            await self.over
            watch.cancel()
            if before:
                before.close()


def numbers_of_version(text):
    parts = text.split(".")
    if len(parts) not in (2, 3) or not all(part.isdigit() for part in parts):
        raise argparse.ArgumentTypeError(f"expected a version as 3.5.1, got \"{text}\"")
    return text


def number_of(kind, least, most=math.inf):
    """Reads a number from least to most, both included but for infinity."""
    def read(text):
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not (least <= value <= most and math.isfinite(value)):
            bounds = f"from {least:g} to {most:g}" if math.isfinite(most) else f"from {least:g} up"
            raise argparse.ArgumentTypeError(f"expected a {'whole ' if kind is int else ''}number {bounds}, got \"{text}\"")
        return value
    return read


def checked(parse):
    def check(text):
        try:
            return parse(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from error
    return check


def options_of(words):
    parser = argparse.ArgumentParser(prog="forceshade-standin haply", formatter_class=argparse.RawDescriptionHelpFormatter,
                                     description="Haply's Inverse Service with an Inverse3 in a simulated hand; it judges its client.",
                                     epilog="faults of a client:\n" + "\n".join(f"  {n}: {w}" for n, w in judge.FAULTS.items()) +
                                     "\n" + switches.described() +
                                     "\nexit codes: 0, no fault; 1, faults, which were printed; 2, wrong options, "
                                     "a port that is taken, or a file that cannot be written")
    add = parser.add_argument
    add("--port", type=number_of(int, 0, 65535), default=10001,
        help="the port of the WebSocket at 127.0.0.1; 0: a free one, which is printed; default 10001")
    add("--version", type=numbers_of_version, default="3.5.1", help="the version of the service; default 3.5.1")
    add("--type", default="inverse3", choices=["inverse3", "inverse3x", "minverse"], help="the type of the device")
    add("--device-id", default="049D", help="default 049D")
    add("--handedness", default="right", choices=["right", "left"], help="default right")
    add("--sessions", type=number_of(int, 0), default=0, help="end after so many sessions; else at SIGTERM or SIGINT")
    add("--clock", default="real", choices=["real", "messages"],
        help="the clock that moves the hand: the time, or each message by a period of --rate, for runs faster than real time")
    add("--rate", type=number_of(float, 1e-3, 1e6), default=1000.0, help="Hz, with --clock messages; default 1000")
    add("--most-force", type=number_of(float, 0), default=10.0, help="N, beyond which a force is absurd; default 10")
    add("--longest-gap", type=number_of(float, 0), default=20.0, help="ms without a message that a force may act; default 20")
    add("--inventory-after", type=number_of(float, 0), default=0.0, help="ms from the connection to the inventory")
    add("--pressed", action="store_true", help="the grip's button is down")
    add("--assume", type=checked(switches.parse_assumption), action="append", default=[], metavar="NAME=VALUE")
    add("--event", type=checked(switches.parse_event), action="append", default=[], metavar="NAME@MESSAGE")
    add("--report", help="FILE for the verdict, as JSON; - is standard output")
    add("--log", help="FILE for the events, one JSON object a line")
    options = parser.parse_args(words)
    options.assumptions = dict(options.assume)
    options.events = {}
    for message, name in options.event:
        options.events.setdefault(message, []).append(name)
    return options


def have_real_time():
    """A late stand-in would be taken for a late client; where the system refuses, it is an ordinary process."""
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(75))
    except OSError:
        pass


def main(words):
    options = options_of(words)
    try:
        if options.report not in (None, "-"):
            was_there = os.path.exists(options.report)
            open(options.report, "a").close()  # known before the client runs
            if not was_there:
                os.unlink(options.report)
        service = Service(options)
    except OSError as error:
        print(f"forceshade-standin haply: {error.filename}: cannot be written: {error.strerror}", file=sys.stderr)
        return 2
    have_real_time()
    try:
        asyncio.run(service.run())
    except OSError as error:
        print(f"forceshade-standin haply: port {options.port}: {error.strerror or error}", file=sys.stderr)
        return 2
    verdict = service.report()
    try:
        if options.report:
            with (sys.stdout if options.report == "-" else open(options.report, "w")) as file:
                json.dump(verdict, file, indent=2)
                file.write("\n")
    except OSError as error:
        print(f"forceshade-standin haply: {options.report}: cannot be written: {error.strerror}", file=sys.stderr)
        return 2
    binary = sum(session["binary_messages"] for session in verdict["sessions"])
    if binary and service.assumed("binary") == "accept":
        print(f"{binary} binary messages were read as text: no document says that the service does so; "
              "--assume binary=refuse is the other way", file=sys.stderr)
    for name, fault in verdict["faults"].items():
        first = fault["first"]
        print(f"fault: {name}, {fault['count']} times, first in message {first['message']} of session {first['session']}: "
              f"{first['words']}", file=sys.stderr)
    return 1 if verdict["faults"] else 0
