# SPDX-License-Identifier: BSD-3-Clause
"""stand_in_test.py STAND-IN faults|assumptions|early: every fault of a client is recorded under its name, a client without one is not
blamed, and every assumption can be seen in both of its ways. `early` is the one fault that a client which is late does not make."""

import asyncio
import json
import subprocess
import sys
import time

from stand_in import Checks, ForkedStandIn, StandIn, skip_without_websockets

skip_without_websockets()
import websockets  # noqa: E402
from websockets.legacy.client import connect  # noqa: E402

checks = Checks()
program = sys.argv[1]
ZERO = {"x": 0, "y": 0, "z": 0}
ONE = {"x": 0, "y": 0, "z": 1.0}


def force(vector, key="vector", device="049D"):
    return json.dumps({"inverse3": [{"device_id": device, "commands": {"set_cursor_force": {key: vector}}}]})


class Client:
    def __init__(self, socket):
        self.socket, self.inventory = socket, None

    async def ask(self, text):
        """The answer, or None where the connection is closed."""
        await self.socket.send(text)
        try:
            return json.loads(await self.socket.recv())
        except websockets.exceptions.ConnectionClosed:
            return None


async def session(address, act):
    async with connect("ws://" + address, compression=None, ping_interval=None) as socket:
        client = Client(socket)
        client.inventory = json.loads(await socket.recv())
        return await act(client)


PATIENT = ("--longest-gap", "3600000", "--assume", "idle-after=never")


def run(act, *words):
    """The result of the act, and the faults."""
    with ForkedStandIn(program, *PATIENT, *words) as stand_in:
        result = asyncio.run(session(stand_in.address, act))
        code, report = stand_in.verdict()
        checks.expect(code == (1 if report["faults"] else 0), f"exit code {code} with {report['faults']}")
        return result, report["faults"]


async def press(client, *forces):
    await client.ask(force(ZERO))
    for one in forces:
        await client.ask(one)
    await client.ask(force(ZERO))


def misdeed(text):
    return lambda client: press(client, text)


async def configures_twice(client):
    for _ in range(2):
        await client.ask(json.dumps({"session": {"configure": {"profile": {"name": "co.x.y:scene"}}}}))


async def forces_at_once(client):
    await client.ask(force(ONE))
    await client.ask(force(ZERO))


async def pauses(client):
    await client.ask(force(ZERO))
    await client.ask(force(ONE))
    await asyncio.sleep(0.05)
    await client.ask(force(ZERO))


async def leaves_under_force(client):
    await client.ask(force(ZERO))
    await client.ask(force(ONE))


async def breaks_off(client):
    await client.ask(force(ZERO))
    client.socket.transport.abort()


async def hurries(client):
    await client.ask(force(ZERO))
    await at_once(client, 20, force(ONE))
    for _ in range(20):
        await client.socket.recv()
    await client.ask(force(ZERO))


async def at_once(client, times, text):
    """So many frames in one write, since a stand-in with real-time priority answers before a second one."""
    size = bytes([0x80 | len(text)]) if len(text) < 126 else bytes([0xFE]) + len(text).to_bytes(2, "big")
    client.socket.transport.write((b"\x81" + size + b"\x00\x00\x00\x00" + text.encode()) * times)


async def goes_on_after_the_end(client):
    await client.ask(force(ZERO))
    client.socket.transport.write(b"\x88\x82\x00\x00\x00\x00\x03\xe8" + b"\x81\x82\x00\x00\x00\x00{}")
    await asyncio.sleep(0.1)


async def sends_no_mask(client):
    await client.ask(force(ZERO))
    client.socket.transport.write(b"\x81\x02{}")
    await asyncio.sleep(0.1)


def alone(text):
    """For a version that reads `values`."""
    async def act(client):
        await client.ask(force(ZERO, "values"))
        await client.ask(text)
        await client.ask(force(ZERO, "values"))
    return act


async def sends_bytes_ten_times(client):
    for _ in range(10):
        await client.ask(force(ZERO).encode())


MISDEEDS = {
    "malformed": misdeed("force, please"),
    "not-finite": misdeed(force(ONE).replace("1.0", "NaN")),
    "unknown-key": misdeed(force(ONE).replace("set_cursor_force", "set_cursor_farce")),
    "unknown-device": misdeed(force(ONE, device="0000")),
    "wrong-key": misdeed(force(ONE, "values")),
    "no-vector": misdeed(force({"x": 0, "y": 0})),
    "absurd-force": misdeed(force({"x": 0, "y": 0, "z": 1000.0})),
    "force-first": forces_at_once,
    "in-flight": hurries,
    "configured-again": configures_twice,
    "force-at-end": leaves_under_force,
    "abrupt-end": breaks_off,
    "after-close": goes_on_after_the_end,
    "protocol": sends_no_mask,
}
WITH_WORDS = {
    "binary": (misdeed(b"{}"), ["--assume", "binary=refuse"]),
    "gap": (pauses, ["--longest-gap", "20"]),
    "uncalibrated-force": (misdeed(force(ONE)), ["--event", "uncalibrated@1"]),
    "unpowered-force": (misdeed(force(ONE)), ["--event", "power-off@1"]),
}


async def waits_for_the_inventory(client):
    await press(client, force(ONE))


def second_source():
    async def two(address):
        async def under_force(client):
            await client.ask(force(ZERO))
            await client.ask(force(ONE))

            async def other(second):
                await press(second, force(ONE))
            await session(address, other)
            await client.ask(force(ZERO))
        await session(address, under_force)
    with StandIn(program, *PATIENT, sessions=2) as stand_in:
        asyncio.run(two(stand_in.address))
        checks.expect(set(stand_in.verdict()[1]["faults"]) == {"second-source"}, "second-source")


def early():
    async def hasty(address):
        async with connect("ws://" + address, compression=None) as socket:
            await socket.send(force(ZERO))
            await socket.recv()
            await socket.recv()
    with StandIn(program, "--inventory-after", "200") as stand_in:
        asyncio.run(hasty(stand_in.address))
        checks.expect(set(stand_in.verdict()[1]["faults"]) == {"early"}, "early")


def every_fault_is_seen():
    _, faults = run(waits_for_the_inventory)
    checks.expect(not faults, f"a good client was blamed for {faults}")
    for name, act in MISDEEDS.items():
        _, faults = run(act)
        checks.expect(set(faults) == {name}, f"{name}: got {faults}")
    for name, (act, words) in WITH_WORDS.items():
        _, faults = run(act, *words)
        checks.expect(set(faults) == {name}, f"{name}: got {faults}")
    second_source()
    for words, expected in ((["--port", "65536"], "expected a whole number from 0 to 65535, got"),
                            (["--rate", "0"], "expected a number from 0.001"),
                            (["--most-force", "nan"], "expected a number from 0 up"),
                            (["--sessions", "-1"], "expected a whole number from 0 up"),
                            (["--assume", "top-rate=0"], "top-rate: expected none or a number"), (["--assume", "ping=0"], "ping: expected"),
                            (["--assume", "clamp=inf"], "clamp: expected"),
                            (["--report", "/none/report"], "/none/report: cannot be written: No such file"),
                            (["--log", "/none/log"], "/none/log: cannot be written: No such file")):
        done = subprocess.run([sys.executable, program, "haply", "--port", "0", *words], capture_output=True, text=True)
        checks.expect(done.returncode == 2 and expected in done.stderr and "Traceback" not in done.stderr, f"{words}: {done}")
    # A message that is not read, or read as text, is judged for all that it has.
    for text, words, expected in (
            (force(ZERO).encode(), (), set()),
            (force({"x": 0, "y": 0, "z": 1000.0}).encode(), (), {"absurd-force"}),
            (force(ONE).replace("1.0", "NaN").encode(), (), {"not-finite"}),
            (b"\xff\xfe", (), {"malformed"}),
            ("[" * 100000, (), {"malformed"}),
            (force({"x": 0, "y": 0, "z": 1000.0}, "values"), (), {"wrong-key", "absurd-force"}),
            (force({"x": 0, "y": 0, "z": 1000.0}, "values").encode(), (), {"wrong-key", "absurd-force"}),
            (force({"x": 0, "y": 0}, "values"), (), {"wrong-key", "no-vector"}),
            (force({"x": 0, "y": 0, "z": 1000.0}, "values").encode(), ("--version", "3.1.0"), {"absurd-force"}),
            (force(ONE).replace('{"vector"', '{"values": {}, "vector"'), (), {"wrong-key"})):
        _, faults = run(misdeed(text) if "--version" not in words else alone(text), *words)
        checks.expect(set(faults) == expected, f"{str(text)[:80]} {words}: got {faults}")
    _, faults = run(sends_bytes_ten_times, "--assume", "binary=refuse")
    checks.expect(faults["binary"]["count"] == 1, f"binary ten times: {faults}")
    listed = set(MISDEEDS) | set(WITH_WORDS) | {"second-source", "early"}
    sys.dont_write_bytecode = True
    sys.path.insert(0, program.rsplit("/", 1)[0])
    from haply import judge
    checks.expect(listed == set(judge.FAULTS), f"faults without a test: {set(judge.FAULTS) - listed}")


def arm(answer):
    return answer["inverse3"][0]


def force_in(answer):
    return arm(answer)["state"]["current_cursor_force"]["z"]


async def pushes(client):
    await client.ask(force(ZERO))
    answer = await client.ask(force({"x": 0, "y": 0, "z": 4.0}))
    await client.ask(force(ZERO))
    return answer


async def says(client, text):
    """The next message has a force: an answer without one is that to the text."""
    await client.ask(force(ZERO))
    await client.socket.send(text)
    answer = await client.ask(force(ONE))
    return "closed" if answer is None else "silent" if force_in(answer) == 1 else "answer"


async def acts(client, text):
    """The force after this message."""
    await client.ask(force(ZERO))
    answer = await client.ask(text)
    await client.ask(force(ZERO))
    return force_in(answer)


async def idles(client):
    """The force a moment after the last message."""
    await client.ask(force(ZERO))
    await client.ask(force(ONE))
    await asyncio.sleep(0.06)
    answer = await client.ask(json.dumps({"inverse3": [{"device_id": "049D", "commands": {"probe_position": {}}}]}))
    await client.ask(force(ZERO))
    return force_in(answer)


async def drops(client):
    """The number of ten that are answered before one that has a force, which is sent until it is."""
    await client.ask(force(ZERO))
    await at_once(client, 10, force(ZERO))
    count = 0
    while True:
        try:
            if force_in(json.loads(await asyncio.wait_for(client.socket.recv(), 0.1))) == 1:
                return count
            count += 1
        except asyncio.TimeoutError:
            await client.socket.send(force(ONE))


async def state(client):
    return client.inventory


def seen(act, *assumptions):
    words = []
    for one in assumptions:
        words += ["--assume", one]
    return run(act, *words)[0]


def every_assumption_has_two_ways():
    checks.expect(force_in(seen(pushes)) == 4 and force_in(seen(pushes, "clamp=3")) == 3, "clamp")
    checks.expect(force_in(seen(pushes, "ration=0.5")) == 2, "ration")
    checks.expect(seen(idles) == 1 and seen(idles, "idle-after=30") == 0, "idle-after")
    nan = force(ONE).replace("1.0", "NaN")
    for name, text, ways in (("not-finite", nan, {"refuse": "answer", "close": "closed"}),
                             ("malformed", "?", {"answer": "answer", "silent": "silent", "close": "closed"}),
                             ("unknown-command", force(ONE, device="0"), {"answer": "answer", "silent": "silent", "close": "closed"})):
        for way, expected in ways.items():
            got = seen(lambda client: says(client, text), f"{name}={way}")
            checks.expect(got == expected, f"{name}={way}: {got}")
    for way, expected in (("accept", 1), ("refuse", 0)):
        got = seen(lambda client: acts(client, force(ONE).encode()), f"binary={way}")
        checks.expect(got == expected, f"binary={way}: {got}")
    _, faults = run(misdeed(force(ONE, "values")), "--assume", "values-key=both")
    checks.expect(not faults, f"values-key=both: {faults}")
    checks.expect(seen(drops, "in-flight=queue") == 10 and seen(drops, "in-flight=drop") < 10, "in-flight")
    checks.expect(arm(seen(state))["config"]["basis"] == {"permutation": "XYZ"} and
                  "basis" not in arm(seen(state, "basis-reported=no"))["config"], "basis-reported")
    checks.expect("current_cursor_force" not in arm(seen(state, "force-reported=no"))["state"], "force-reported")
    checks.expect(arm(seen(state, "control-mode=force"))["state"]["control_mode"] == "force", "control-mode")
    checks.expect(arm(seen(state, "in-use=any"))["status"]["in_use"] and not arm(seen(state))["status"]["in_use"], "in-use")
    turned, doubled = arm(seen(state, "mount=turned")), arm(seen(state, "transform=doubled"))
    checks.expect(abs(turned["config"]["mount"]["rotation"]["z"] - 0.5**0.5) < 1e-9 and "mount" not in arm(seen(state))["config"] and
                  turned["state"]["cursor_position"]["x"] == -arm(seen(state))["state"]["cursor_position"]["y"], "mount")
    checks.expect(doubled["state"]["transform"]["scale"]["x"] == 2 and not arm(seen(state))["state"]["transform"] and
                  doubled["state"]["cursor_position"]["z"] == 2 * arm(seen(state))["state"]["cursor_position"]["z"], "transform")
    grips = [(len(m["verse_grip"]), len(m["wireless_verse_grip"])) for m in
             (seen(state), seen(state, "grip=wireless"), seen(state, "grip=none"))]
    checks.expect(grips == [(1, 0), (0, 1), (0, 0)], f"grip {grips}")


def the_report_is_written_whole_whatever_signals_come():
    with StandIn(program) as stand_in:
        asyncio.run(session(stand_in.address, lambda client: client.ask(force(ZERO))))
        while stand_in.process.poll() is None:
            stand_in.process.terminate()
            time.sleep(0.0005)
        _, report = stand_in.verdict()
        checks.expect(len(report["sessions"]) == 1, f"signals during the end: {report}")


if __name__ == "__main__":
    if sys.argv[2] == "faults":
        every_fault_is_seen()
        the_report_is_written_whole_whatever_signals_come()
        sys.exit(checks.exit_code(40))
    if sys.argv[2] == "early":
        early()
        sys.exit(checks.exit_code(1))
    every_assumption_has_two_ways()
    sys.exit(checks.exit_code(20))
