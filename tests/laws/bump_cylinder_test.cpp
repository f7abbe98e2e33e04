// SPDX-License-Identifier: BSD-3-Clause
#include "tests/laws/law_suite.h"

FORCESHADE_LAW_SUITE(bump_cylinder)
