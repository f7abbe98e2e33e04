// SPDX-License-Identifier: BSD-3-Clause
// Included after tests/fast/pack_operations.inl, under the same conditions, where there are rows (fast/numbers/row.h).

using fast::Pair64;

// Four: a row of a spline's window; fuses: whether its multiply_add is one operation.
template <class Four, bool kFuses>
const char* wrong_operation_of_row() {
  Numbers numbers;
  alignas(32) double x[4], y[4], z[4];
  for (int round = 0; round < kRounds; ++round) {
    for (double* lanes : {x, y, z})
      for (int i = 0; i < 4; ++i) lanes[i] = numbers.next();
    const Four a = Four::load(x), b = Four::load(y), c = Four::load(z);
    const auto product_and_sum = [&](int i) { return kFuses ? __builtin_fma(x[i], y[i], z[i]) : x[i] * y[i] + z[i]; };
    const auto in_pairs = [](const double* v) { return (v[0] + v[1]) + (v[2] + v[3]); };
    if (!same(sum(a), (x[0] + x[2]) + (x[1] + x[3]))) return "sum";
    const Pair64 two = sums(a, b);
    if (!same(two[0], in_pairs(x)) || !same(two[1], in_pairs(y))) return "sums";
    const Pair64 pairs = Four::multiply_add_pairs(Pair64{x[0], x[1]}, Pair64{y[0], y[1]}, Pair64{z[0], z[1]});
    if (!same(pairs[0], product_and_sum(0)) || !same(pairs[1], product_and_sum(1))) return "multiply_add_pairs";
    // A lane at a time, by a sum with all others 0.
    for (int i = 0; i < 4; ++i) {
      alignas(32) double only[4]{};
      only[i] = 1;
      const Four lane = Four::load(only);
      if (!same(sum(multiply_add(a, b, c) * lane), product_and_sum(i))) return "multiply_add";
      if (!same(sum((a + b) * lane), x[i] + y[i])) return "+";
      if (!same(sum((a - b) * lane), x[i] - y[i])) return "-";
      if (!same(sum(a * b * lane), x[i] * y[i])) return "*";
      if (!same(sum(Four(x[0]) * lane), x[0])) return "one number in all lanes";
    }
    float in[4];
    for (int i = 0; i < 4; ++i) in[i] = static_cast<float>(x[i]);
    const auto wide = [&](int i) { return static_cast<double>(in[i]); };
    if (!same(sum(Four::load(in)), (wide(0) + wide(2)) + (wide(1) + wide(3)))) return "load";
  }
  return nullptr;
}
