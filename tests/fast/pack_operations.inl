// SPDX-License-Identifier: BSD-3-Clause
// Included once by each tests/pack_operations_<set>.cpp in an unnamed namespace. No function of the standard library that is
// not a builtin: what is compiled here for one instruction set must not be linked into code for all machines.

constexpr int kRounds = 1000;

// Numbers of either sign within a few powers of two of 1, with all 53 bits: products and sums of them round.
struct Numbers {
  unsigned long long state = 1;

  double next() {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const unsigned long long fraction = state >> 12, sign = state << 63, exponent = 1021 + (state >> 9) % 5;
    return __builtin_bit_cast(double, sign | exponent << 52 | fraction);
  }
};

bool same(double a, double b) {
  return __builtin_bit_cast(unsigned long long, a) == __builtin_bit_cast(unsigned long long, b);
}

#define FORCESHADE_EXPECT_LANES(name, expected) \
  {                                             \
    (name).store(r);                            \
    for (std::size_t i = 0; i < P::kLanes; ++i) \
      if (!same(r[i], expected)) return #name;  \
  }

// multiply_add and multiply_subtract are fused.
template <class P>
const char* wrong_operation() {
  constexpr std::size_t kLanes = P::kLanes;
  Numbers numbers;
  alignas(64) double x[kLanes], y[kLanes], z[kLanes], r[kLanes];
  alignas(64) float in[kLanes], out[kLanes];
  for (int round = 0; round < kRounds; ++round) {
    // A pack loads binary32 numbers; two of them make one with more bits.
    const auto half = [&](double scale) {
      for (float& lane : in) lane = static_cast<float>(numbers.next());
      return P::load(in) * P(scale);
    };
    const auto load = [&](double* to) {
      const P sum = half(1) + half(0x1p-29);
      sum.store(to);
      return sum;
    };
    const P a = load(x), b = load(y), c = load(z);
    FORCESHADE_EXPECT_LANES(P::load(in), static_cast<double>(in[i]));
    FORCESHADE_EXPECT_LANES(P(x[0]), x[0]);
    FORCESHADE_EXPECT_LANES(a + b, x[i] + y[i]);
    FORCESHADE_EXPECT_LANES(a - b, x[i] - y[i]);
    FORCESHADE_EXPECT_LANES(a * b, x[i] * y[i]);
    FORCESHADE_EXPECT_LANES(a / b, x[i] / y[i]);
    FORCESHADE_EXPECT_LANES(-a, -x[i]);
    FORCESHADE_EXPECT_LANES(absolute(a), __builtin_fabs(x[i]));
    FORCESHADE_EXPECT_LANES(square_root(absolute(a)), __builtin_sqrt(__builtin_fabs(x[i])));
    FORCESHADE_EXPECT_LANES(larger(a, b), x[i] > y[i] ? x[i] : y[i]);
    FORCESHADE_EXPECT_LANES(select(a < b, a, c), x[i] < y[i] ? x[i] : z[i]);
    FORCESHADE_EXPECT_LANES(select(a <= a, a, c), x[i]);
    FORCESHADE_EXPECT_LANES(select(a > b, a, c), x[i] > y[i] ? x[i] : z[i]);
    FORCESHADE_EXPECT_LANES(select(a >= b, a, c), x[i] >= y[i] ? x[i] : z[i]);
    FORCESHADE_EXPECT_LANES(select(a == b, a, c), z[i]);
    FORCESHADE_EXPECT_LANES(multiply_add(a, b, c), __builtin_fma(x[i], y[i], z[i]));
    FORCESHADE_EXPECT_LANES(multiply_subtract(a, b, c), __builtin_fma(-x[i], y[i], z[i]));
    a.store(out);
    for (std::size_t i = 0; i < kLanes; ++i)
      if (out[i] != static_cast<float>(x[i])) return "rounding to binary32";
  }
  return nullptr;
}

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
