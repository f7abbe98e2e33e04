# SPDX-License-Identifier: BSD-3-Clause
"""The faults of a client, by the documents. A fault is recorded with its first occurrence, and the run goes on."""

import json
import math

FAULTS = {
    "early": "a message before the inventory",
    "binary": "messages that are not text, where the service refuses them (binary=refuse); counted once a session",
    "malformed": "a message that is no JSON object",
    "not-finite": "a number that is NaN or infinite",
    "unknown-key": "a key or a command that the documents do not have",
    "unknown-device": "a command to a device that is not connected",
    "wrong-key": "a force in `values` to 3.5 or later, or in `vector` to an earlier version",
    "no-vector": "a force without three numbers x, y and z",
    "absurd-force": "a force beyond --most-force: wrong units, or no clamp",
    "force-first": "a force before any position was answered",
    "uncalibrated-force": "a force while the device is not calibrated",
    "unpowered-force": "a force while its power supply is off",
    "second-source": "a force while another session commands one: they add up",
    "in-flight": "a message before the answer to the last one, other than a zero force",
    "gap": "no message for longer than --longest-gap while a force acted",
    "configured-again": "the session configured more than once",
    "force-at-end": "the session ended while a force acted",
    "abrupt-end": "the connection broke off without a closing handshake",
    "after-close": "data after the closing handshake",
    "protocol": "a breach of the WebSocket protocol",
}

COMMANDS = {"set_cursor_force", "set_cursor_position", "set_angular_torques", "set_angular_position", "set_transform",
            "probe_position", "probe_orientation"}
GRIPS = {"verse_grip", "wireless_verse_grip", "custom_verse_grip"}


class Judge:
    def __init__(self):
        self.faults = {}

    def fault(self, name, where, words=""):
        assert name in FAULTS
        entry = self.faults.setdefault(name, {"count": 0, "first": {**where, "words": words or FAULTS[name]}})
        entry["count"] += 1


class NotFinite(ValueError):
    pass


def _number(text):
    value = float(text)
    if not math.isfinite(value):
        raise NotFinite(text)
    return value


def _constant(text):
    raise NotFinite(text)


_decoder = json.JSONDecoder(parse_float=_number, parse_constant=_constant)


def parse(text):
    """The message; raises NotFinite, or ValueError for anything but a JSON object."""
    message = _decoder.decode(text.decode() if isinstance(text, bytes) else text)
    if not isinstance(message, dict):
        raise ValueError("no object")
    return message


def vector_of(value):
    """Three numbers, or None."""
    if not isinstance(value, dict) or set(value) != {"x", "y", "z"}:
        return None
    numbers = [value[axis] for axis in "xyz"]
    if any(isinstance(n, bool) or not isinstance(n, (int, float)) for n in numbers):
        return None
    return tuple(min(max(n, -1e300), 1e300) for n in numbers)


def length(vector):
    return math.sqrt(sum(c * c for c in vector))
