"""The common parts of the tables of hostile programs and files: cases, and a program that answers right but in one thing."""

import json
import os
import sys

CASES, SEEN = {}, set()  # by name; the kinds and words of those that are not slow
IS_PLAYED = sys.argv[0] == "-c"  # by a process of its own, PLAY, which has no use for what is only said
PLAY = "import sys; sys.path[0] = sys.argv[1]; __import__(sys.argv[2]).CASES[sys.argv[3]].play()"
NO_OBJECT, LATE, ENDED = "expected a JSON object in one line", "did not answer within", "ended without an answer"
UNASKED, NO_LIST, NO_END = "wrote without having been asked", "answered without a list", "did not end"


class Case:
    """words: one of those between | is in the verdict. run(mark, folder): the arguments of the command in its own folder;
    whatever a program starts has the mark in its arguments. play(): what the program does."""

    def __init__(self, words, run, play=None, code=1, slow=False):
        self.words, self.run, self.play, self.code, self.slow = words, run, play, code, slow

    @property
    def waits(self):
        return LATE in self.words or NO_END in self.words


def add(name, case):
    """A run that is not slow has one case of each verdict on each kind of program or file; the others are slow."""
    assert name not in CASES, name
    verdict = (name.split()[0], case.words)
    case.slow = case.slow or verdict in SEEN
    SEEN.update([verdict] * (not case.slow))
    CASES[name] = case


def patience(words):
    """A busy machine may be slow to start a program, so that only those that do not answer or end get little time."""
    if words.startswith(LATE + " 10 s"):
        return []  # which is as long as without the option
    return ["--answer-timeout", "1" if LATE in words else "10" if NO_END in words else "60"]


class Door:
    """A way for programs into the command: `arguments`, then `option` with how the shell starts one. module: that of the table."""

    def __init__(self, kind, module, hello, arguments, option):
        self.kind, self.module, self.hello, self.arguments, self.option = kind, module, hello, arguments, option

    def plays(self, name, words, play, **options):
        name = f"{self.kind} {name}"

        def run(mark, folder):
            import shlex

            cache = "pycache_prefix=" + os.environ["CACHE"]  # without one, or with another one, it starts more slowly
            player = [sys.executable, "-S", "-E", "-X", cache, "-c", PLAY, os.path.dirname(__file__), self.module, name, mark]
            return self.arguments + patience(words) + [self.option, "exec " + shlex.join(player)]

        add(name, Case(words, run, play, **options))

    def says(self, name, words, said, **options):
        """It greets so, whatever it is asked, and then repeats what it hears, but goodbye. said: bytes, or what makes many of them."""

        def run(mark, folder):
            with open(os.path.join(folder, "said"), "wb") as file:
                file.write(said() if callable(said) else said)
            return self.arguments + patience(words) + [self.option, "read line; cat said; exec sed -u /goodbye/d"]

        add(f"{self.kind} {name}", Case(words, run, **options))

    def greets(self, name, words, said, **options):
        if IS_PLAYED:
            return
        self.says("hello: " + name, words, said if isinstance(said, bytes) or callable(said) else text(said), **options)

    def changed(self, what, words, **changes):
        self.greets(what, words, self.hello | changes)

    def raw(self, key, value):
        """The hello with the text of a value that Python does not write."""
        return b"" if IS_PLAYED else text(self.hello | {key: "@"}).replace(b'"@"', value)


def write(data):
    while data:
        data = data[os.write(1, data) :]


def text(value):
    return json.dumps(value).encode() + b"\n"


def lines():
    """The output of conform, without a buffer of its own."""
    return map(json.loads, os.fdopen(0, "rb", buffering=0, closefd=False))


def answering(hello, answer, at_goodbye=lambda: None):
    """answer(asked) returns JSON, or writes and returns None."""
    for asked in lines():
        if "goodbye" in asked:
            return at_goodbye()
        said = hello if "scene" in asked else answer(asked)
        if said is not None:
            write(said if isinstance(said, bytes) else text(said))


def add_lines(door, slow=False):
    """Lines that are no hello, whatever the protocol."""
    if IS_PLAYED:
        return
    right_hello = text(door.hello)

    def greets(name, words, said):
        door.greets(name, words, said, slow=slow)

    for name, said in {
        "empty line": b"\n", "spaces": b"   \n", "a NUL": b"\0\n", "UTF-16": right_hello.decode().encode("utf-16"),
        "UTF-32": right_hello.decode().encode("utf-32"), "not UTF-8": door.raw("name", b'"\xff\xfe"'), "half a surrogate": door.raw("name", b'"\\ud800"'),
        "a NUL within": door.raw("name", b'"a\0b"'), "a tab in a text": door.raw("name", b'"a\tb"'), "a comment": b"// hello\n", "a comment at the end": right_hello[:-1] + b" // x\n",
        "garbage at the end": right_hello[:-1] + b"x\n", "two objects": right_hello[:-1] * 2 + b"\n", "an array": b"[" + right_hello[:-1] + b"]\n",
        "null": b"null\n", "a number": b"1\n", "a text": b'"conform 1"\n', "single quotes": right_hello.replace(b'"', b"'"), "a comma too many": right_hello[:-2] + b",}\n",
        "no end": right_hello[:-2] + b"\n", "half of it": right_hello[:60] + b"\n", "a million brackets": b"[" * 1_000_000 + b"\n", "a million objects": b'{"a":' * 1_000_000 + b"\n",
        "YAML": b"forceshade: conform 1\n", "HTML": b"<html>\n", "random bytes": bytes(range(128, 256)) * 40 + b"\n",
        "a carriage return alone": right_hello[:-1].replace(b", ", b",\r", 1)[:40] + b"\n", "over several lines": json.dumps(door.hello, indent=1).encode() + b"\n",
    }.items():  # fmt: skip
        greets(name, NO_OBJECT, said)
    greets("a BOM before", NO_LIST, b"\xef\xbb\xbf" + right_hello)  # which JSON allows: it goes on, with an echo
    greets("16 million brackets", NO_OBJECT, lambda: b"[" * 16_000_000 + b"\n")
    greets("16 million objects", NO_OBJECT, lambda: b'{"":' * 4_000_000 + b"\n")
    greets("8 million numbers", NO_OBJECT, lambda: door.raw("forceshade", b"[" + b"1," * 8_000_000 + b"1]"))
    greets("twice", UNASKED, right_hello * 2)
    greets("an empty object", 'has no key "forceshade"', {})
    greets("an answer", 'has no key "forceshade"', {"answers": []})
    greets("what it got", "expected", b'{"forceshade":"conform 1","scene":{}}\n')
