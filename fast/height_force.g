# SPDX-License-Identifier: BSD-3-Clause
# The relative errors of the height maps' last step (fast/height_force.h): what rounding adds to a force whose jet is exact.
# Slopes x and y below 2^-480 in size are 0 (fast/tracked.h), and then add nothing. The end of the enclosure is rounded once
# more, by at most 2^-53 of the component and a little, which the header's constant pays for too.

@rnd = float<ieee_64, ne>;
K = float<ieee_32, ne>(K_);
x = rnd(x_);
y = rnd(y_);
gap = rnd(GAP);
up rnd= (K * gap) / sqrt(1 + (x * x + y * y));
fx rnd= up * x;
FX = ((K * GAP) / sqrt(1 + (x * x + y * y))) * x;
conservative rnd= (K * gap) * x;
CONSERVATIVE = (K * GAP) * x;
#! piece force
{ K in [1b-10, 1000] /\ GAP in [1b-480, 1b20] /\ x in [1b-480, 1b30] /\ |y| in [1b-480, 1b30] -> fx -/ FX in ? }
#! piece conservative
{ K in [1b-10, 1000] /\ GAP in [1b-480, 1b20] /\ x in [1b-480, 1b30] -> conservative -/ CONSERVATIVE in ? }
