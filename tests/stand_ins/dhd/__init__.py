# SPDX-License-Identifier: BSD-3-Clause
"""The stand-in for Force Dimension's DHD: a shared library in C, and the program that runs a client with it."""
