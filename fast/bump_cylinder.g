# SPDX-License-Identifier: BSD-3-Clause
# bump-cylinder: the relative error of the first stage (fast/bump_cylinder.h). F_x is the cylinder's own.
# How the scripts are written and run, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
from_cylinder = rnd(from_cylinder_);
from_wall = rnd(from_wall_);  # exact: fast/wall.g
sum rnd= from_cylinder + from_wall;
exact_sum = from_cylinder + from_wall;
Z = TRUE_CYLINDER + from_wall;

# |sum| >= |from_cylinder|/2, or it is in doubt. The piece without contact with the cylinder has from_cylinder = 0 and no error.
#! piece z
{ |(from_cylinder - TRUE_CYLINDER) / TRUE_CYLINDER| <= 0x1.d8p-50 # from cylinder force
/\ |from_cylinder / sum| <= 2 /\ |exact_sum| in [1b-120, 1b30] -> (sum - Z) / Z in ? }
(sum - Z) / Z -> 1 / (Z / sum) - 1;
Z / sum -> 1 / (1 + (sum - exact_sum) / exact_sum) - (from_cylinder / sum) * ((from_cylinder - TRUE_CYLINDER) / TRUE_CYLINDER) / (1 + (from_cylinder - TRUE_CYLINDER) / TRUE_CYLINDER);
#! piece x
{ |(from_cylinder - TRUE_CYLINDER) / TRUE_CYLINDER| <= 0x1.d8p-50 # from cylinder force
-> (from_cylinder - TRUE_CYLINDER) / TRUE_CYLINDER in ? }
