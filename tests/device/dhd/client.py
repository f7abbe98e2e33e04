# SPDX-License-Identifier: BSD-3-Clause
"""client.py DEED: a client of DHD in Python, which does one thing that it must not, or none (`nothing`)."""

import ctypes
import os
import sys
import threading
import time

dhd = ctypes.CDLL(os.environ["FORCESHADE_DHD_LIBRARY"])
ID = ctypes.c_byte(-1)
N = ctypes.c_double
COM, NOT_ENABLED = 2, 19
values = [N() for _ in range(3)]
NAN = float("nan")


def read():
    return dhd.dhdGetPosition(*(ctypes.byref(value) for value in values), ID)


def force(*vector):
    return dhd.dhdSetForce(*(N(component) for component in vector), ID)


def begin(position=True, enabled=True):
    assert dhd.dhdGetDeviceCount() == 1 and dhd.dhdOpen() == 0
    assert not position or read() == 0
    assert not enabled or (dhd.dhdSetBrakes(0, ID) == 0 and dhd.dhdEnableForce(1, ID) == 0)


def end():
    force(0, 0, 0)
    assert dhd.dhdStop(ID) == 0
    dhd.dhdSleep(N(0.01))
    assert dhd.dhdClose(ID) == 0


def status():
    numbers = (ctypes.c_int * 32)(*([-7] * 32))
    assert dhd.dhdGetStatus(numbers, ID) == 0
    return list(numbers)


def within(act, **how):
    def deed():
        begin(**how)
        act()
        end()

    return deed


def before_open():
    assert read() == -1
    begin()
    end()


def after_close():
    begin()
    end()
    force(0, 0, 1)


def twice():
    assert dhd.dhdOpen() == -1


def after_cut():
    assert read() == 0  # the force button is pressed in the second reading
    time.sleep(0.12)
    force(0, 0, 1)


def unplugged():
    read()
    time.sleep(0.12)
    force(0, 0, 1)


def blindly():
    for _ in range(100):
        force(0, 0, 0.1)


def pauses():
    force(0, 0, 1)
    time.sleep(0.05)


def from_another_thread():
    force(0, 0, 1)
    other = threading.Thread(target=force, args=(0, 0, 0))
    other.start()
    other.join()


def ends_under_force():
    begin()
    force(0, 0, 1)
    dhd.dhdStop(ID)
    dhd.dhdClose(ID)


def never_stops():
    begin()
    force(0, 0, 0)
    dhd.dhdClose(ID)


def never_closes():
    begin()
    force(0, 0, 0)
    dhd.dhdStop(ID)


def switched_off():
    force(0, 0, 0)
    dhd.dhdEnableForce(0, ID)
    force(0, 0, 1)


DEEDS = {
    "nothing": within(lambda: force(0, 0, 1)),
    "not-open": before_open,
    "after-close": after_close,
    "bad-id": within(lambda: dhd.dhdSetForce(N(0), N(0), N(0), ctypes.c_byte(3))),
    "null-argument": within(lambda: dhd.dhdGetStatus(None, ID)),
    "out-of-range": within(lambda: dhd.dhdSetBrakes(2, ID)),
    "no-expert-mode": within(lambda: dhd.dhdSetWatchdog(255, ID)),
    "opened-twice": within(twice),
    "force-first": within(lambda: force(0, 0, 1), position=False),
    "not-enabled": within(switched_off),
    "after-cut": within(after_cut),
    "uncalibrated-force": within(lambda: (dhd.dhdReset(ID), force(0, 0, 1))),
    "not-finite": within(lambda: force(0, NAN, 0)),
    "absurd-force": within(lambda: force(0, 0, 3000)),
    "blind": within(blindly),
    "gap": within(pauses),
    "two-threads": within(from_another_thread),
    "after-unplug": within(unplugged),
    "force-at-end": ends_under_force,
    "no-stop": never_stops,
    "left-open": never_closes,
}


if __name__ == "__main__":
    DEEDS[sys.argv[1]]()
