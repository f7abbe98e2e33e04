# SPDX-License-Identifier: BSD-3-Clause
# wall: the first stage has no error; the binary64 product of two binary32 numbers is their product.
# The form and use of the scripts, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
K = float<ieee_32, ne>(K_);
p = float<ieee_32, ne>(p_);  # -z, a binary32 number as z is
fz rnd= K * p;
FZ = K * p;
#! piece force
{ K in [1b-10, 1000] /\ p in [1b-30, 10000] -> fz - FZ in ? }
