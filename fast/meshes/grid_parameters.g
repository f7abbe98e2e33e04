# SPDX-License-Identifier: BSD-3-Clause
# The bound of the error of a quotient on the grid of parameters (GridScale in fast/meshes/decide.h): 2^24·N/D, computed from n and
# d, which are within en and ed of N and D. How the scripts are written and run: docs/proofs.md.
#
# scaled - 2^24·N/D has three parts: by rounding, scaled - X; by the divisor, X - 2^24·n/D; and by the numerator, 2^24·(n - N)/D.
# The bound is a sum of three: scaled·2^-51, scaled·relative_d, and from_n. Each piece share_… proves that one part is less than
# its own term, and `bound` how well the sum of the three is computed. d is scaled to [1, 2]; A = (D - d)/ed, B = (n - N)/en.

@rnd = float<ieee_64, ne>;
d = rnd(d_);
ed = rnd(ed_);
n = rnd(n_);
en = rnd(en_);
D = d + A * ed;
inverse rnd= 0x1p24 / d;
relative_d rnd= (0x1.008p0 * ed) / d;
relative rnd= relative_d + 0x1p-51;
scaled rnd= n * inverse;
from_n rnd= (0x1.01p0 * en) * inverse;
error rnd= scaled * relative + from_n;
X = n * (0x1p24 / d);
ERROR = scaled * (relative_d + 0x1p-51) + from_n;
#! piece share_of_rounding
{ d in [1, 2] /\ n in [1b-200, 1b60] -> (scaled - X) / (0x1p-51 * scaled) in ? }
(scaled - X) / (0x1p-51 * scaled) -> 0x1p51 * (((scaled - X) / X) / (1 + ((scaled - X) / X))) { scaled <> 0, d <> 0, n <> 0 };
#! piece share_of_divisor
{ d in [1, 2] /\ ed / d in [1b-200, 1b-10] /\ ed in [1b-200, 1b-9] /\ |A| <= 1 /\ n in [1b-200, 1b60]
-> (X - 0x1p24 * (n / D)) / (relative_d * scaled) in ? }
(X - 0x1p24 * (n / D)) / (relative_d * scaled) -> A / (1 + A * (ed / d)) / (1 + ((scaled - X) / X))
  / (0x1.008p0 * (1 + (relative_d - 0x1.008p0 * ed / d) / (0x1.008p0 * ed / d)))
  { d <> 0, D <> 0, ed <> 0, n <> 0, scaled <> 0, relative_d <> 0 };
#! piece share_of_numerator
{ d in [1, 2] /\ ed / d in [0, 1b-10] /\ |A| <= 1 /\ en in [1b-200, 1b60] /\ |B| <= 1
-> (0x1p24 * (B * en) / D) / from_n in ? }
(0x1p24 * (B * en) / D) / from_n -> B / (1 + A * (ed / d))
  / (0x1.01p0 * (1 + (from_n - 0x1.01p0 * en * (0x1p24 / d)) / (0x1.01p0 * en * (0x1p24 / d)))) { d <> 0, D <> 0, en <> 0, from_n <> 0 };
#! piece bound
{ d in [1, 2] /\ ed in [1b-200, 1b-9] /\ n in [1b-200, 1b60] /\ en in [1b-200, 1b60] -> error -/ ERROR in ? }
