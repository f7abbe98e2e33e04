"""The lines of `forceshade conform` (docs/conformance-protocol.md), for the renderers in Python beside this file."""

import json
import sys

import numpy as np

CAPABILITIES = {
    "forceshade": "conform 1", "kind": "renderer", "version": "1", "answers": "force", "length_unit": "mm", "force_unit": "N",
    "frame": ["x", "y", "z"], "domain_mm": 10_000, "rate_Hz": None, "loop_energy_mJ": None,
}


class NotRendered(Exception):
    pass


def render(about, open_scene):
    """open_scene(scene) gives a function of positions (n, 3), binary32, and whether a path begins with them: forces (n, 3)."""
    for line in sys.stdin:
        asked = json.loads(line)
        if "scene" in asked:
            answer = CAPABILITIES | about
            try:
                forces = open_scene(asked["scene"])
            except NotRendered as reason:
                answer |= {"accepts": False, "reason": str(reason)}
        elif "positions" in asked:
            positions = np.frombuffer(bytes.fromhex("".join(asked["positions"])), ">f4").astype(np.float32).reshape(-1, 3)
            digits = np.asarray(forces(positions, asked.get("reset", False)), ">f4").tobytes().hex()
            answer = {"answers": [digits[at : at + 24] for at in range(0, len(digits), 24)]}
        else:
            return  # goodbye
        print(json.dumps(answer), flush=True)
