# SPDX-License-Identifier: BSD-3-Clause
"""A stand-in for Haply's Inverse Service, from its public documents alone."""
