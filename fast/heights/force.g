# SPDX-License-Identifier: BSD-3-Clause
# The relative errors of the height maps' last step (gap_force in fast/heights/force.h): what rounding adds to a force whose jet
# is exact. The end of the enclosure is rounded once more, by at most 2^-53 of the component and a little, which the header's
# constant covers too.
#
# The upper ends are those of the domain; tests/fast/height_bounds_test.cpp computes them. Below the lower ends nothing is to be
# shown: a component of less than 2^-160 rounds to 0, and a slope below 2^-500 is as good as 0 (docs/proofs.md).

@rnd = float<ieee_64, ne>;
K = float<ieee_32, ne>(K_);
x = rnd(x_);
y = rnd(y_);
gap = rnd(GAP);
up rnd= (K * gap) / sqrt(1 + (x * x + y * y));
fx rnd= up * x;
UP = (K * GAP) / sqrt(1 + (x * x + y * y));
FX = ((K * GAP) / sqrt(1 + (x * x + y * y))) * x;
up_level rnd= (K * gap) / sqrt(1 + x * x);
fx_level rnd= up_level * x;
UP_LEVEL = (K * GAP) / sqrt(1 + x * x);
FX_LEVEL = ((K * GAP) / sqrt(1 + x * x)) * x;
conservative rnd= (K * gap) * x;
CONSERVATIVE = (K * GAP) * x;
#! piece force
{ K in [1b-10, 1000] /\ GAP in [1b-200, 1b29] /\ x in [1b-500, 1b30] /\ |y| in [1b-500, 1b30] -> fx -/ FX in ? /\ up -/ UP in ? }
# y = 0
#! piece level
{ K in [1b-10, 1000] /\ GAP in [1b-200, 1b29] /\ x in [1b-500, 1b30] -> fx_level -/ FX_LEVEL in ? /\ up_level -/ UP_LEVEL in ? }
#! piece conservative
{ K in [1b-10, 1000] /\ GAP in [1b-200, 1b29] /\ x in [1b-500, 1b30] -> conservative -/ CONSERVATIVE in ? }
