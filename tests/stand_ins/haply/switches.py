# SPDX-License-Identifier: BSD-3-Clause
"""Choices that the documents leave open, each a named assumption with its values, the first of them the default; and what can go wrong."""

import math

NUMBER = "a number"
POSITIVE = ("top-rate", "ping")  # that zero stands for nothing in
CONTACT = "contact"  # once 100 messages of a session had a force

ASSUMPTIONS = {
    "idle-after": (["100", NUMBER, "never"], "ms without a message after which the device gives no force any more"),
    "after-close": (["idle", "hold"], "a session that ends while its force acts: the device idles at once, or when idle-after is over"),
    "not-finite": (["refuse", "close"], "NaN or infinity in a message: no force and an answer, or the connection is closed"),
    "binary": (["accept", "refuse"], "a message that is not text: read as one, or taken as malformed"),
    "malformed": (["answer", "silent", "close"], "a text that is no JSON object"),
    "unknown-command": (["answer", "silent", "close"], "a command or a device that there is not"),
    "values-key": (["by-version", "both"], "a force is read from `vector` since 3.5 and from `values` before, or from either"),
    "clamp": (["none", NUMBER], "N: a longer force is shortened"),
    "ration": (["1", NUMBER], "the share of a force that the service's filters leave"),
    "in-flight": (["queue", "drop"], "a message before the answer to the last one: answered in turn, or left unanswered"),
    "top-rate": (["none", NUMBER], "Hz: answers come no faster"),
    "control-mode": (["idle", "force"], "the control_mode of a state"),
    "http": (["same", "before", "none"], "HTTP answers at the port of the WebSocket, at the one before, or not"),
    "envelope": (["always", "asked"], "an answer of HTTP has `ok` and `data`, always or only with ?format=json"),
    "in-use": (["others", "any"], "in_use is true while another session is open, or while any is"),
    "force-reported": (["yes", "no"], "a state has current_cursor_force"),
    "basis-reported": (["yes", "no"], "a configuration has the basis"),
    "mount": (["identity", "turned"], "the device stands as it should, or turned by a quarter about z, as its configuration has it"),
    "transform": (["identity", "doubled"], "a length of the device is one of the session, or two, as each state has it"),
    "grip": (["wired", "wireless", "none"], "the grip that is connected"),
    "ping": (["never", NUMBER], "s between pings"),
}

EVENTS = {
    "unplug": "the Inverse3 is not listed any more",
    "uncalibrated": "it says that it is not calibrated, as from then on",
    "calibrated": "it says that it is calibrated again",
    "power-off": "its power supply is off, as from then on",
    "garbage": "an answer that is no JSON",
    "wrong-unit": "a position in mm",
    "nan": "a position that is not a number",
    "no-position": "a state without a position",
    "lose": "no answer",
    "late": "an answer 100 ms late",
    "unasked": "two answers instead of one",
    "press": "the grip's button goes down, or up again",
    "close": "the service ends the session",
    "reset": "the connection breaks off",
    "die": "the service is killed",
    "freeze": "the service is stopped",
    "jump": "the position is 50 mm off, once",
}


def parse_assumption(text):
    """NAME=VALUE; raises ValueError with what was expected."""
    name, _, value = text.partition("=")
    if name not in ASSUMPTIONS:
        raise ValueError(f"expected one of {', '.join(ASSUMPTIONS)}, got \"{name}\"")
    values = ASSUMPTIONS[name][0]
    if value in values and value != NUMBER:
        return name, value
    try:
        if NUMBER in values and 0 <= float(value) < math.inf and (float(value) > 0 or name not in POSITIVE):
            return name, value
    except ValueError:
        pass
    raise ValueError(f"{name}: expected {' or '.join(values)}, got \"{value}\"")


def parse_event(text):
    """NAME@MESSAGE, counted from 1 in each session, or NAME@contact; raises ValueError with what was expected."""
    name, _, message = text.partition("@")
    if name not in EVENTS:
        raise ValueError(f"expected one of {', '.join(EVENTS)}, got \"{name}\"")
    if message == CONTACT:
        return CONTACT, name
    if not message.isdigit() or int(message) < 1:
        raise ValueError(f"{name}: expected {CONTACT} or the number of a message from 1, got \"{message}\"")
    return int(message), name


def described():
    lines = ["assumptions (--assume NAME=VALUE; the first value is the default):"]
    for name, (values, words) in ASSUMPTIONS.items():
        lines.append(f"  {name}={'|'.join(values)}: {words}")
    lines.append(f"events (--event NAME@MESSAGE or NAME@{CONTACT}, once 100 messages had a force):")
    lines += [f"  {name}: {words}" for name, words in EVENTS.items()]
    return "\n".join(lines)
