# SPDX-License-Identifier: BSD-3-Clause
# wall: the first stage has no error; the binary64 product of two binary32 numbers is their product.
# How the scripts are written and run, and the hypotheses they share: docs/proofs.md.

@rnd = float<ieee_64, ne>;
K = float<ieee_32, ne>(K_);
z = float<ieee_32, ne>(z_);
fz rnd= K * -z;
FZ = K * -z;
#! piece force
{ K in [1b-10, 1000] /\ z in [-10000, -1b-30] -> fz - FZ in ? }
