#!/usr/bin/env python3
"""A wall at z = 0 for `forceshade conform`: reads lines of JSON, answers with lines of JSON (docs/conformance-protocol.md)."""

import json
import struct
import sys


def force(x, y, z, stiffness):
    if not all(abs(coordinate) <= 10_000 for coordinate in (x, y, z)):
        return (0, 0, 0)  # outside the domain, or not a number
    return (0, 0, stiffness * -z if z <= -(2.0**-30) else 0)


def hello(scene):
    about = {
        "forceshade": "conform 1",
        "kind": "renderer",
        "name": "a wall in Python",
        "version": "1",
        "memory": "none",
        "answers": "force",
        "claims": "definition",
        "length_unit": "mm",
        "force_unit": "N",
        "frame": ["x", "y", "z"],
        "domain_mm": 10000,
        "rate_Hz": None,
        "loop_energy_mJ": 0,
    }
    if scene["kind"] != "law" or scene["name"] != "wall":
        about |= {"accepts": False, "reason": "it renders the law wall alone"}
    return about


def main():
    stiffness = 0
    for line in sys.stdin:
        asked = json.loads(line)
        if "scene" in asked:
            answer = hello(asked["scene"])
            stiffness = asked["scene"]["parameters"].get("stiffness_N_per_mm", 0)
        elif "positions" in asked:
            forces = (force(*struct.unpack(">3f", bytes.fromhex(at)), stiffness) for at in asked["positions"])
            answer = {"answers": [struct.pack(">3f", *one).hex() for one in forces]}
        else:
            return  # goodbye
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
