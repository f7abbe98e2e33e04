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

template <class Number>
bool same(Number a, Number b) {
  return __builtin_memcmp(&a, &b, sizeof a) == 0;
}

#define FORCESHADE_EXPECT_LANES(name, expected) \
  {                                             \
    (name).store(r);                            \
    for (std::size_t i = 0; i < P::kLanes; ++i) \
      if (!same(r[i], expected)) return #name;  \
  }

template <class P>
const char* wrong_operation() {
  constexpr std::size_t kLanes = P::kLanes;
  Numbers numbers;
  alignas(64) double x[kLanes], y[kLanes], z[kLanes], r[kLanes];
  alignas(64) float in[kLanes];
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
    FORCESHADE_EXPECT_LANES(-a, -x[i]);
    FORCESHADE_EXPECT_LANES(square_root(larger(a, P(0))), __builtin_sqrt(x[i] > 0 ? x[i] : 0));
    FORCESHADE_EXPECT_LANES(larger(a, b), x[i] > y[i] ? x[i] : y[i]);
    FORCESHADE_EXPECT_LANES(larger(P(-0.0), P(0.0)), 0.0);
    FORCESHADE_EXPECT_LANES(select(a <= b, a, c), x[i] <= y[i] ? x[i] : z[i]);
    FORCESHADE_EXPECT_LANES(select(a <= a, a, c), x[i]);
    if constexpr (requires { multiply_add(a, b, c); }) {
      FORCESHADE_EXPECT_LANES(multiply_add(a, b, c), __builtin_fma(x[i], y[i], z[i]));
    }
    if constexpr (requires { a / b; }) {
      FORCESHADE_EXPECT_LANES(a / b, x[i] / y[i]);
      FORCESHADE_EXPECT_LANES(absolute(a), __builtin_fabs(x[i]));
      FORCESHADE_EXPECT_LANES(select((a >= b) & (a >= c), a, c), x[i] >= y[i] && x[i] >= z[i] ? x[i] : z[i]);
    }
    FORCESHADE_EXPECT_LANES(P::load(x), x[i]);
    FORCESHADE_EXPECT_LANES(fused_add(a, b, c), __builtin_fma(x[i], y[i], z[i]));
    FORCESHADE_EXPECT_LANES(fused_subtract_from(a, b, c), __builtin_fma(-x[i], y[i], z[i]));
    FORCESHADE_EXPECT_LANES(fused_less(a, b, c), __builtin_fma(x[i], y[i], -z[i]));
  }
  return nullptr;
}

#define FORCESHADE_EXPECT_FLOATS(name, expected)          \
  {                                                       \
    (name).store(r);                                      \
    for (std::size_t i = 0; i < Floats::kLanes; ++i)      \
      if (!same(r[i], expected)) return "Floats: " #name; \
  }

// As many binary32 numbers as two packs.
template <class Floats, class P>
const char* wrong_operation_of_floats() {
  constexpr std::size_t kLanes = Floats::kLanes;
  static_assert(kLanes == 2 * P::kLanes);
  Numbers numbers;
  alignas(64) float x[kLanes], y[kLanes], r[kLanes];
  alignas(64) double wide[kLanes];
  for (int round = 0; round < kRounds; ++round) {
    for (float* lanes : {x, y})
      for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = static_cast<float>(numbers.next());
    x[round % kLanes] = y[round % kLanes];
    const Floats a = Floats::load(x), b = Floats::load(y);
    FORCESHADE_EXPECT_FLOATS(Floats(x[0]), x[0]);
    FORCESHADE_EXPECT_FLOATS(Floats(static_cast<double>(x[0])), x[0]);
    FORCESHADE_EXPECT_FLOATS(a + b, x[i] + y[i]);
    FORCESHADE_EXPECT_FLOATS(a * b, x[i] * y[i]);
    FORCESHADE_EXPECT_FLOATS(a / b, x[i] / y[i]);
    FORCESHADE_EXPECT_FLOATS(absolute(a), __builtin_fabsf(x[i]));
    FORCESHADE_EXPECT_FLOATS(square_root(absolute(a)), __builtin_sqrtf(__builtin_fabsf(x[i])));
    FORCESHADE_EXPECT_FLOATS(times_sign(a, b), __builtin_signbit(y[i]) ? -x[i] : x[i]);
    FORCESHADE_EXPECT_FLOATS(larger(a, b), x[i] > y[i] ? x[i] : y[i]);
    FORCESHADE_EXPECT_FLOATS(larger(Floats(-0.0F), Floats(0.0F)), 0.0F);
    FORCESHADE_EXPECT_FLOATS(select(a < b, a, b), x[i] < y[i] ? x[i] : y[i]);
    FORCESHADE_EXPECT_FLOATS(a & (a <= b), x[i] <= y[i] ? x[i] : 0.0F);
    FORCESHADE_EXPECT_FLOATS(a & (a > b), x[i] > y[i] ? x[i] : 0.0F);
    FORCESHADE_EXPECT_FLOATS(a & (a == b), x[i] == y[i] ? x[i] : 0.0F);
    FORCESHADE_EXPECT_FLOATS(a & ((a < b) & (a > Floats(1.0F))), x[i] < y[i] && x[i] > 1 ? x[i] : 0.0F);
    FORCESHADE_EXPECT_FLOATS(a & ((a < b) | (a > Floats(1.0F))), x[i] < y[i] || x[i] > 1 ? x[i] : 0.0F);
    a.first_half().store(wide);
    a.second_half().store(wide + P::kLanes);
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (!same(wide[i], static_cast<double>(x[i]))) return "Floats: halves";
      wide[i] = numbers.next();
    }
    FORCESHADE_EXPECT_FLOATS(Floats::rounded(P::load(wide), P::load(wide + P::kLanes)), static_cast<float>(wide[i]));
  }
  return nullptr;
}

// A hazard is seen in whichever lane it is.
template <class Watch, class Floats, class P>
const char* wrong_watch() {
  constexpr std::size_t kLanes = Floats::kLanes;
  constexpr int kWindow = 8;
  constexpr float kLeast = 0x1p-20F;
  constexpr double kNearest = 0x1p-10;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto coordinates_pass = [&](float value, bool is_first, bool may_be_tiny) {
      alignas(64) float sizes[kLanes];
      for (float& size : sizes) size = 1;
      sizes[lane] = value;
      Watch watch;
      const Floats size = Floats::load(sizes), other(1.0F);
      if (may_be_tiny)
        watch.domain(is_first ? size : other, is_first ? other : size);
      else
        watch.coordinates(is_first ? size : other, is_first ? other : size);
      return watch.template is_free_of_hazards<kWindow>(kLeast, kNearest);
    };
    for (const bool is_first : {true, false}) {
      for (const float good : {0.0F, kLeast, 1e4F})
        if (!coordinates_pass(good, is_first, false)) return "Watch: a good coordinate";
      for (const float bad : {1e-45F, 0x1.fffffep-21F, 0x1.388002p13F, __builtin_inff(), __builtin_nanf("")})
        if (coordinates_pass(bad, is_first, false)) return "Watch: a bad coordinate";
      if (!coordinates_pass(0x1p-21F, is_first, true) || coordinates_pass(0x1.388002p13F, is_first, true))
        return "Watch: domain";
    }
    const auto tiny_passes = [&](float value) {
      alignas(64) float sizes[kLanes] = {};
      sizes[lane] = value;
      Watch watch;
      watch.tiny(Floats::load(sizes));
      return watch.template is_free_of_hazards<kWindow>(kLeast, kNearest);
    };
    if (!tiny_passes(0.0F) || !tiny_passes(kLeast) || tiny_passes(1e-45F) || tiny_passes(0x1.fffffep-21F)) return "Watch: tiny";

    const auto number_passes = [&](double value, bool is_distance) {
      alignas(64) double all[kLanes];
      for (double& one : all) one = 1;
      all[lane] = value;
      const P first = P::load(all), second = P::load(all + P::kLanes);
      Watch watch;
      if (is_distance)
        watch.distance(first, second);
      else
        watch.template rounding<kWindow>(first, second);
      return watch.template is_free_of_hazards<kWindow>(kLeast, kNearest);
    };
    for (const double sign : {1.0, -1.0}) {
      if (!number_passes(sign * 0x1.00001p-10, true) || number_passes(sign * 0x1.00000ffffffffp-10, true) ||
          number_passes(sign * 0x1.fffffffffffffp-11, true) || number_passes(sign * 0.0, true))
        return "Watch: distance";
      constexpr double kTie = 0x1.000001p0, kUlp = 0x1p-52;
      for (const double ulps : {0.0, 8.0, -8.0})
        if (number_passes(sign * (kTie + ulps * kUlp), false)) return "Watch: a rounding in doubt";
      for (const double ulps : {10.0, -10.0})
        if (!number_passes(sign * (kTie + ulps * kUlp), false)) return "Watch: a rounding that is clear";
    }

    alignas(64) float values[kLanes] = {};
    values[lane] = 2;
    Watch watch;
    watch.doubt(Floats::load(values) < Floats(-1.0F));
    if (!watch.template is_free_of_hazards<kWindow>(kLeast, kNearest)) return "Watch: no doubt";
    watch.doubt(Floats::load(values) > Floats(1.0F));
    watch.doubt(Floats::load(values) < Floats(-1.0F));
    if (watch.template is_free_of_hazards<kWindow>(kLeast, kNearest)) return "Watch: doubt";
  }
  return nullptr;
}
