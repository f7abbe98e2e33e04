# SPDX-License-Identifier: BSD-3-Clause
"""Counts checks of the tests in Python."""


class Checks:
    """Counts what was not as expected, and says it."""

    def __init__(self):
        self.wrong, self.made = 0, 0

    def expect(self, holds, words):
        self.made += 1
        if not holds:
            self.wrong += 1
            print("WRONG:", words, flush=True)

    def exit_code(self, least):
        """The last line of a test: it fails, too, where fewer checks were made than it has."""
        print(f"{self.made} checks, {self.wrong} wrong")
        return 1 if self.wrong or self.made < least else 0
