# SPDX-License-Identifier: BSD-3-Clause
# bump-cylinder: the relative error of the first stage (fast/laws/bump_cylinder.h). F_x is the cylinder's own.
# The form and use of the scripts, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
from_cylinder = rnd(from_cylinder_);
from_wall = rnd(from_wall_);  # exact: fast/laws/wall.g
sum rnd= from_cylinder + from_wall;
Z = TRUE_CYLINDER + from_wall;

# z > -d: neither force points down. Below, both or neither act: in doubt, or the wall's force alone, which is exact.
#! piece z
{ |from_cylinder -/ TRUE_CYLINDER| <= 0x1.0ap-49 # from cylinder force
/\ TRUE_CYLINDER in [1b-120, 1b24] /\ from_wall / TRUE_CYLINDER in [0, 1b150] -> (sum - Z) / Z in ? }
#! piece x
{ |(from_cylinder - TRUE_CYLINDER) / TRUE_CYLINDER| <= 0x1.0ap-49 # from cylinder force
-> (from_cylinder - TRUE_CYLINDER) / TRUE_CYLINDER in ? }
