# SPDX-License-Identifier: BSD-3-Clause
"""One session with a client: its messages are judged and answered, each with one state."""

import asyncio
import json
import os
import signal
import time

from haply import judge, switches
from haply.judge import length

SMALL = 0.01  # N: less is not felt


def now():
    return time.monotonic_ns()


class Session:
    def __init__(self, service, socket, number):
        self.service, self.socket, self.number = service, socket, number
        self.messages = 0
        self.configured = False
        self.was_in_contact = self.is_unanswered = self.is_idle = False
        self.ended_here = False  # by an event or an assumption, which is no fault of the client
        self.told = (True, True)  # calibrated and powered, as of the last answer
        self.is_early = False  # the next message came before the answer to the last one
        self.answered = 0
        self.force = (0.0, 0.0, 0.0)  # that this session commands
        self.last = now()  # the time of its last message
        self.report = {"session": number, "messages": 0, "largest_force_N": 0.0, "longest_gap_ms": 0.0, "contact_messages": 0,
                       "binary_messages": 0}

    def fault(self, name, words=""):
        where = {"session": self.number, "message": self.messages}
        self.service.judge.fault(name, where, words)
        self.service.note("fault", fault=name, **where)

    def answer(self, with_config=False):
        self.told = (self.service.calibrated, self.service.powered)
        return json.dumps(self.service.state(self, with_config))

    async def run(self):
        service = self.service
        service.note("connected", session=self.number)
        if service.options.inventory_after > 0:
            await asyncio.sleep(service.options.inventory_after / 1000)
            if self.socket.has_message_waiting():
                self.fault("early")
        inventory = service.state(self, True)
        inventory["session_id"] = self.number
        await self.socket.send(json.dumps(inventory))
        service.note("inventory", session=self.number)
        while True:
            text = await self.socket.recv()
            if not await self.take(text):
                return

    async def take(self, text):
        """False where the session is over."""
        service, begin = self.service, now()
        self.messages += 1
        gap = (begin - self.last) / 1e6
        self.report["longest_gap_ms"] = max(self.report["longest_gap_ms"], gap) if self.messages > 1 else 0.0
        # A client that was not answered may wait.
        if gap > service.options.longest_gap and length(self.force) > SMALL and not self.is_unanswered:
            self.fault("gap", f"{gap:.1f} ms")
        self.is_unanswered, self.is_idle = True, False
        self.last = begin
        if self.messages == 300:
            service.note("settling", session=self.number)
        service.advance(begin)
        events = service.options.events.get(self.messages, [])
        if self.report["contact_messages"] >= 100 and not self.was_in_contact:
            self.was_in_contact = True
            events = events + service.options.events.get(switches.CONTACT, [])
        for event in events:
            service.happen(event)
        if service.died:
            os.kill(os.getpid(), signal.SIGKILL if service.died == "die" else signal.SIGSTOP)
        self.ended_here = "close" in events or "reset" in events
        if "close" in events:
            await self.socket.close(1001, "the service ends")
            return False
        if "reset" in events:
            self.socket.transport.abort()
            return False
        reaction, with_config = self.judged(text)
        if reaction == "close":
            self.ended_here = True
            await self.socket.close(1003, "the message was not understood")
            return False
        if self.is_early:
            if length(self.force) > 0:
                self.fault("in-flight")
            if service.assumed("in-flight") == "drop":
                self.is_early = self.socket.has_message_waiting()
                return True
        # A client that waits for its answers has sent nothing yet.
        self.is_early = self.socket.has_message_waiting()
        if reaction == "silent" or "lose" in events:
            return True
        await self.send(events, with_config, begin)
        return True

    async def send(self, events, with_config, begin):
        service = self.service
        if "late" in events:
            await asyncio.sleep(0.1)
        rate = service.assumed("top-rate")
        if rate != "none":
            await asyncio.sleep(max(0.0, 1 / float(rate) - (now() - begin) / 1e9))
        text = self.answer(with_config)
        if "garbage" in events:
            text = "{\"inverse3\": [{\"device_id\": \"04"
        elif "nan" in events:
            text = self.broken(("cursor_position", "x"), float("nan"))
        elif "wrong-unit" in events:
            text = self.broken(("cursor_position", "z"), 210.0)
        elif "no-position" in events:
            text = self.broken(("cursor_position",), None)
        elif "jump" in events:
            text = self.broken(("cursor_position", "x"), service.arm.position[0] + 0.05)
        await self.socket.send(text)
        self.is_unanswered = "late" in events
        if "unasked" in events:
            await self.socket.send(text)
        self.answered += 1

    def broken(self, path, value):
        state = self.service.state(self, False)
        place = state["inverse3"][0]["state"]
        for key in path[:-1]:
            place = place[key]
        if value is None:
            del place[path[-1]]
        else:
            place[path[-1]] = value
        return json.dumps(state)

    def judged(self, text):
        """The reaction: answer, silent or close; and True if the answer has the configuration."""
        assumed = self.service.assumed
        if isinstance(text, bytes):
            self.report["binary_messages"] += 1
            if assumed("binary") == "refuse":
                if self.report["binary_messages"] == 1:
                    self.fault("binary")
                return assumed("malformed"), False
        try:
            message = judge.parse(text)
        except judge.NotFinite as error:
            self.fault("not-finite", str(error))
            self.command((0.0, 0.0, 0.0))
            return ("close" if assumed("not-finite") == "close" else "answer"), False
        except (ValueError, RecursionError):
            self.fault("malformed", str(text[:80]))
            return assumed("malformed"), False
        reaction, full = "answer", False
        for key, value in message.items():
            if key == "session" and isinstance(value, dict):
                full = "force_render_full_state" in value or full
                self.configure(value)
            elif key == "inverse3" and isinstance(value, list):
                for part in value:
                    if not self.take_part(part):
                        reaction = assumed("unknown-command")
            elif key not in judge.GRIPS:
                self.fault("unknown-key", key)
                reaction = assumed("unknown-command")
        return reaction, full

    def configure(self, value):
        for key in value:
            if key not in ("configure", "force_render_full_state"):
                self.fault("unknown-key", key)
        configure = value.get("configure")
        if configure is None:
            return
        if self.configured:
            self.fault("configured-again")
        self.configured = True
        if isinstance(configure, dict) and isinstance(configure.get("basis"), dict):
            self.service.basis = configure["basis"].get("permutation", self.service.basis)

    def take_part(self, part):
        # Unplugged while the message was under way, it may still be named once.
        is_gone = self.service.unplugged and self.messages > self.service.unplugged_at + 1
        if not isinstance(part, dict) or part.get("device_id") != self.service.options.device_id or is_gone:
            self.fault("unknown-device", str(part)[:80])
            return False
        understood = True
        commands = part.get("commands", {})
        for name, command in commands.items() if isinstance(commands, dict) else ():
            if name not in judge.COMMANDS:
                self.fault("unknown-key", name)
                understood = False
            elif name == "set_cursor_force":
                understood = self.take_force(command) and understood
        return understood

    def take_force(self, command):
        service = self.service
        right, wrong = ("vector", "values") if service.is_new else ("values", "vector")
        key, is_read = right, True
        if isinstance(command, dict) and wrong in command:
            key = right if right in command else wrong
            if service.assumed("values-key") == "by-version":
                self.fault("wrong-key", f"{wrong} to version {service.options.version}, which reads {right}")
                is_read = key == right
        # A force that is not read is judged, too: it would act once the key is mended.
        force = judge.vector_of(command.get(key)) if isinstance(command, dict) else None
        if force is None:
            self.fault("no-vector", str(command)[:80])
            return False
        if length(force) > 0:
            if length(force) > service.options.most_force:
                self.fault("absurd-force", f"{length(force):.6g} N")
            if self.answered == 0:
                self.fault("force-first")
            if not self.told[0]:
                self.fault("uncalibrated-force")
            if not self.told[1]:
                self.fault("unpowered-force")
            if any(length(other.force) > 0 for other in service.sessions if other is not self):
                self.fault("second-source")
        if is_read:
            self.command(force)
        return is_read

    def command(self, force):
        before = length(self.force)
        self.force = force
        self.service.apply()
        size = length(force)
        self.report["largest_force_N"] = max(self.report["largest_force_N"], size)
        if size > SMALL:
            self.report["contact_messages"] += 1
        if (before > SMALL) != (size > SMALL):
            self.service.note("contact" if size > SMALL else "free", session=self.number)

    def end(self, how):
        """The connection is gone: what the arm feels from then on."""
        service, closed = self.service, now()
        force = length(service.arm.force)
        if length(self.force) > SMALL and not self.ended_here:
            self.fault("force-at-end", f"{length(self.force):.3f} N")
        if how != "closed" and not self.ended_here:
            self.fault(how)
        idle_after = service.assumed("idle-after")
        until = closed
        if service.assumed("after-close") == "hold":
            until = None if idle_after == "never" else max(closed, self.last + int(float(idle_after) * 1e6))
        elif idle_after != "never":
            until = min(closed, self.last + int(float(idle_after) * 1e6))
        self.report.update({"messages": self.messages, "end": how, "last_message_ns": self.last, "closed_ns": closed,
                            "force_at_end_N": force, "force_until_ns": until if force > SMALL else self.last})
        self.force = (0.0, 0.0, 0.0)
        service.apply()
        service.note("ended", **self.report)
