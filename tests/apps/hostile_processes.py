"""Deeds of a process in place of what it has to do, whatever its protocol. Modules that few of them need are loaded by these."""

import os
import signal
import time

from hostile_programs import ENDED, LATE, NO_END, NO_LIST, NO_OBJECT, UNASKED, answering, text

BARE = {"PATH": os.environ["PATH"]}


def endless(stream, block=b"x" * 65536):
    while True:
        try:
            os.write(stream, block)
        except OSError:
            os._exit(0)


def null_pointer():
    import ctypes

    ctypes.string_at(0)


def stack_without_end():
    import ctypes
    import resource

    resource.setrlimit(resource.RLIMIT_STACK, (65536, 65536))
    ctypes.memset(ctypes.addressof(ctypes.c_char()) - 2**40, 0, 1)


def sleeper(**options):
    import subprocess

    mark = os.environ["MARK"]
    options.setdefault("stdout", subprocess.DEVNULL)
    return subprocess.Popen(["bash", "-c", f"exec -a {mark} sleep 300"], stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)


def detached(**options):
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            sleeper(**options)
        os._exit(0)
    time.sleep(0.2)


def forks(most=3000):
    """A bomb with an end, since a test must not take a machine along."""
    for _ in range(most):
        if os.fork() == 0:
            time.sleep(20)
            os._exit(0)
    time.sleep(100)


def doubles(generations=11):
    for _ in range(generations):
        os.fork()
    time.sleep(20)


def add_processes(door, slow):
    def process(name, words, play):
        door.plays("process: " + name, words, play, slow=slow)

    def leaves(name, words, play):
        process("leaves " + name, words, play)

    def once_greeted(play):
        return lambda: answering(door.hello, lambda asked: play())

    for number in (1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 24, 25, 26, 27, 29, 30, 31, 64):
        process(f"signal {number}", f"was killed by signal {number} (", lambda number=number: (signal.signal(number, signal.SIG_DFL) if number != 9 else 0, os.kill(os.getpid(), number)))
    for code in (0, 1, 2, 77, 126, 128, 255):
        process(f"exit code {code}", f"ended with exit code {code} without" if code else ENDED, lambda code=code: os._exit(code))
    process("a program that is not there", "exit code", lambda: os.execv("/no/such/program", ["x"]))
    process("a folder as a program", "exit code", lambda: os.execv("/", ["x"]))
    process("another program", NO_OBJECT, lambda: os.execvp("cat", ["cat", "/proc/self/status"]))
    process("an exception", "RuntimeError: no licence", lambda: exec("raise RuntimeError('no licence')"))
    process("an exception later", "ended with exit code 1 without an answer", once_greeted(lambda: exec("raise ValueError")))
    process("a null pointer", "was killed by signal 11", once_greeted(null_pointer))
    process("an abort", "was killed by signal 6", once_greeted(os.abort))
    process("a stack without end", "was killed by signal 11", stack_without_end)
    process("never an answer", LATE, lambda: time.sleep(100))
    process("reads nothing, writes nothing", LATE, lambda: (os.close(0), time.sleep(100)))
    process("spins", LATE, lambda: [None for _ in iter(int, 1) if False])
    process("ignores every signal", LATE, lambda: ([signal.signal(one, signal.SIG_IGN) for one in (1, 2, 3, 10, 12, 13, 15)], time.sleep(100)))
    process("stops itself", LATE, lambda: os.kill(os.getpid(), signal.SIGSTOP))
    process("stops itself later", LATE, once_greeted(lambda: os.kill(os.getpid(), signal.SIGSTOP)))
    process("closes its output", "closed its output, and " + NO_END, lambda: (os.close(1), time.sleep(100)))
    process("closes its output later", "closed its output, and " + NO_END, once_greeted(lambda: (os.close(1), time.sleep(100))))
    process("closes everything", "closed its output, and " + NO_END, lambda: (os.closerange(0, 1000), time.sleep(100)))
    process("floods its output", "a line of more than 16777216 bytes", lambda: endless(1))
    process("floods its output later", "a line of more than 16777216 bytes", once_greeted(lambda: endless(1)))
    process("floods with lines", NO_LIST + "|" + UNASKED, lambda: endless(1, text(door.hello)))
    process("floods with empty lines", NO_OBJECT, lambda: endless(1, b"\n" * 65536))
    process("a line of 1 GB", "a line of more than 16777216 bytes", lambda: os.execvp("head", ["head", "-c", "1000000000", "/dev/zero"]))
    process("floods with NULs", "a line of more than 16777216 bytes", lambda: endless(1, bytes(65536)))
    process("floods standard error", LATE, lambda: endless(2))
    process("floods standard error later", LATE, once_greeted(lambda: endless(2, b"error\n")))
    process("escapes on standard error", "\\x1b", lambda: (os.write(2, b"\x1b[2J\x1b]0;held\x07"), os._exit(1)))
    process("a verdict on standard error", "ended with exit code 1", lambda: (os.write(2, b"held: 256 of 256 (100 %)\n\n\n"), os._exit(1)))
    process("takes all memory", "MemoryError", lambda: bytearray(10**11))
    process("takes memory bit by bit", "MemoryError", lambda: [bytearray(2**27) for _ in range(1000)])
    process("writes a file without end", "exit code", lambda: exec("f = open('large', 'wb')\nwhile True: f.write(bytes(2**20))"))
    process("opens files without end", "exit code", lambda: exec("a = []\nwhile True: a.append(open('/dev/null'))"))
    leaves("a child", ENDED, lambda: sleeper())
    leaves("a child with its output", LATE, lambda: sleeper(stdout=None))
    leaves("ten children", ENDED, lambda: [sleeper() for _ in range(10)])
    leaves("a session", ENDED, lambda: sleeper(start_new_session=True))
    leaves("a daemon", ENDED, lambda: detached())
    leaves("a session without environment", ENDED, lambda: sleeper(start_new_session=True, env=BARE))
    leaves("a daemon without environment", ENDED, lambda: detached(env=BARE))
    leaves("a daemon without environment, and is killed", "was killed by signal 9", lambda: (detached(env=BARE), os.kill(os.getpid(), 9)))
    leaves("a daemon without environment, and sleeps", LATE, lambda: (detached(env=BARE), time.sleep(100)))
    leaves("a child that is stopped", ENDED, lambda: os.kill(sleeper().pid, signal.SIGSTOP))
    process("kills its group", "was killed by signal 15", lambda: os.kill(0, signal.SIGTERM))
    process("kills what started it", "ended the process that watches it", lambda: (os.kill(os.getppid(), signal.SIGKILL), time.sleep(100)))
    process("forks", "more than 512 processes and threads", forks)
    process("forks as a doubling tree", "more than 512 processes and threads", doubles)
    process("forks in sessions of their own", "more than 512 processes and threads", lambda: [os.setsid() or time.sleep(20) or os._exit(0) for _ in range(2000) if os.fork() == 0] or time.sleep(100))
