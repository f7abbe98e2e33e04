// SPDX-License-Identifier: BSD-3-Clause
// The forms in which a batch evaluates the laws (fast/simd/form.inl), beside their Gappa scripts: the forms' own templates run
// on packs of one number that writes down what is done with it (tests/fast/recorded_number.h).
#include "tests/fast/form_operations.h"

#include <cmath>
#include <optional>
#include <string>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "fast/simd/batch.h"

namespace forceshade::fast {
namespace {

using tests::Recorded;

struct Pack {
  static constexpr std::size_t kLanes = 1;
  using Mask = Recorded::Mask;

  Recorded lane;

  explicit Pack(double a) : lane(a) {}
  Pack(const Recorded& a) : lane(a) {}
  static Pack load(const float* from) { return Pack(static_cast<double>(*from)); }

  friend Pack operator+(const Pack& a, const Pack& b) { return a.lane + b.lane; }
  friend Pack operator-(const Pack& a, const Pack& b) { return a.lane - b.lane; }
  friend Pack operator*(const Pack& a, const Pack& b) { return a.lane * b.lane; }
  friend Pack operator-(const Pack& a) { return -a.lane; }
  friend Mask operator<=(const Pack& a, const Pack& b) { return a.lane <= b.lane; }
  friend Pack fused_add(const Pack& a, const Pack& b, const Pack& c) { return fused(a.lane, b.lane, c.lane); }
  friend Pack fused_subtract_from(const Pack& a, const Pack& b, const Pack& c) { return fused(-a.lane, b.lane, c.lane); }
  friend Pack fused_less(const Pack& a, const Pack& b, const Pack& c) { return fused(a.lane, b.lane, -c.lane); }
  friend Pack square_root(const Pack& a) { return square_root(a.lane); }
  friend Pack larger(const Pack& a, const Pack& b) { return larger(a.lane, b.lane); }
  friend Pack select(Mask condition, const Pack& yes, const Pack& no) { return select(condition, yes.lane, no.lane); }
};

// Binary32 numbers: a value where they are loaded, and what is done with them in words.
struct Floats {
  static constexpr std::size_t kLanes = 2;
  using Mask = Recorded::Mask;

  float value = 0;
  std::string words;

  explicit Floats(float a) : value(a) {}
  explicit Floats(double a) : Floats(static_cast<float>(a)) {}
  explicit Floats(const char* name) : words(name) {}
  static Floats load(const float* from) { return Floats(*from); }
  void store(float* to) const { to[0] = to[1] = value; }
  Pack first_half() const { return Pack(static_cast<double>(value)); }
  Pack second_half() const { return first_half(); }
  static Floats rounded(const Pack& first, const Pack&) { return Floats(first.lane.value()); }

  static Floats written(const Floats& a, const char* operation, const Floats& b) {
    return Floats(("(" + a.words + operation + b.words + ")").c_str());
  }
  friend Floats operator+(const Floats& a, const Floats& b) { return written(a, " + ", b); }
  friend Floats operator-(const Floats& a, const Floats& b) { return written(a, " - ", b); }
  friend Floats operator*(const Floats& a, const Floats& b) {
    Floats product = written(a, " * ", b);
    product.value = a.value * b.value;
    return product;
  }
  friend Floats operator/(const Floats& a, const Floats& b) { return written(a, " / ", b); }
  friend Floats square_root(const Floats& a) { return Floats(("sqrt(" + a.words + ")").c_str()); }
  friend Floats absolute(const Floats& a) { return Floats(__builtin_fabsf(a.value)); }
  friend Floats larger(const Floats& a, const Floats& b) { return a.value > b.value ? a : b; }
  friend Floats times_sign(const Floats& a, const Floats& b) { return Floats(__builtin_signbit(b.value) ? -a.value : a.value); }
  friend Floats select(Mask condition, const Floats& yes, const Floats& no) { return condition.holds ? yes : no; }
  friend Floats operator&(const Floats& a, Mask condition) { return condition.holds ? a : Floats(0.0F); }
  friend Mask operator<(const Floats& a, const Floats& b) { return {a.value < b.value}; }
  friend Mask operator<=(const Floats& a, const Floats& b) { return {a.value <= b.value}; }
  friend Mask operator>(const Floats& a, const Floats& b) { return {a.value > b.value}; }
  friend Mask operator==(const Floats& a, const Floats& b) { return {a.value == b.value}; }
};

// Sees no hazard; keeps the distance that it is given.
struct Watch {
  std::optional<Recorded> last_distance;

  void domain(const Floats&, const Floats&) {}
  void tiny(const Floats&) {}
  void coordinates(const Floats&, const Floats&) {}
  void doubt(Floats::Mask) {}
  void distance(const Pack& first, const Pack&) { last_distance = first.lane; }
  template <int>
  void rounding(const Pack&, const Pack&) {}
  template <int>
  bool is_free_of_hazards(float, double) const {
    return true;
  }
};

}  // namespace
}  // namespace forceshade::fast

// The forms made of packs:
#include "fast/simd/form_of.inl"

namespace forceshade::tests {
namespace {

using fast::Built;
using fast::Two;
using fast::Watch;

// Every constant of every law has another significand here.
constexpr Parameters kBump{530.3F, 0.71F, 0.7F};
constexpr float kX = 0.13F, kZ = -0.31F;  // mm: over the bump and below all its surfaces

// Gives the two coordinates the script's names.
void name_position(RecordedRun& run, float x, float z) {
  run.expressions.name_constant(static_cast<double>(x), run.expressions.input("x", 24));
  run.expressions.name_constant(static_cast<double>(z), run.expressions.input("z", 24));
  run.bind("x", Recorded(static_cast<double>(x)));
  run.bind("z", Recorded(static_cast<double>(z)));
}

template <class Definition>
auto form_of() {
  return typename fast::FormOf<Definition>::Type(Built<Definition>(kBump).definition);
}

template <class Definition>
void gap_of_sides(ComparedScript& script, float x) {
  RecordedRun run(script, true);
  name_position(run, x, kZ);
  const auto gap_form = form_of<Definition>().gap;
  Two edge(static_cast<double>(x)), tail = gap_form.slope_tail;
  if constexpr (requires { gap_form.top; }) {
    if (x <= gap_form.top.edge.value) {
      edge = gap_form.top.wide_edge;
      tail = gap_form.top_tail;
      // The tail adds the part of h′ that the side's height at the edge lacks.
      const fast::LinearGap top = Built<Definition>(kBump).definition.gap.top;
      const auto number = [](const Two& a) { return static_cast<long double>(a.first.lane.value()); };
      const long double from_edge = number(gap_form.half_width) - number(edge);
      const long double missing = (static_cast<long double>(top.height) - number(gap_form.slope) * from_edge) +
                                  static_cast<long double>(top.height_tail);
      EXPECT_LE(std::fabs(number(tail) * from_edge - missing), 0x1p-68L * static_cast<long double>(top.height));
    }
  }
  run.bind("distance", (gap_form.half_width - edge).first.lane);
  run.bind("slope", gap_form.slope.first.lane);
  run.bind("tail", tail.first.lane);
  Watch watch;
  const Recorded gap = gap_form.at(watch, fast::Floats(x), Two(static_cast<double>(kZ))).first.lane;
  for (const char* piece : {"near_inside", "near_outside", "far_above", "far_below"}) run.expect(piece, gap);
  ASSERT_TRUE(watch.last_distance);
  EXPECT_EQ(watch.last_distance->expression(), gap.expression());
}

// The components are those of |x|.
template <class Definition>
void shaded(ComparedScript& script) {
  for (const float x : {kX, -kX}) {
    RecordedRun run(script, true);
    name_position(run, kX, kZ);
    run.constant("K", static_cast<double>(kBump.stiffness));
    run.constant("R", static_cast<double>(kBump.radius));
    run.constant("K_over_R", Built<Definition>(kBump).definition.shading.K_over_R);
    const auto form = form_of<Definition>();
    Watch watch;
    const Recorded at_x(static_cast<double>(kX));
    run.bind("gap", form.gap.at(watch, fast::Floats(kX), Two(static_cast<double>(kZ))).first.lane);
    run.bind("square", fused(-at_x, at_x, form.normal.R_squared.first.lane));
    const fast::Components force = form.components(watch, &x, &kZ);
    run.expect("shaded_z", force.z.first.lane);
    run.expect_value("rnd(scale * x)", force.x.first.lane.expression());
    EXPECT_EQ(form.plane.minus_K.value, -kBump.stiffness);
  }
}

// The products are those of the law's own script.
template <class Definition>
void flat(const char* law, const char* piece, float x) {
  ComparedScript script(law);
  RecordedRun run(script, true);
  run.constant("K", static_cast<double>(kBump.stiffness));
  run.constant("K_sine", Built<Definition>(kBump).definition.K_sine);
  run.constant("K_cosine", Built<Definition>(kBump).definition.K_cosine);
  const auto form = form_of<Definition>();
  Watch watch;
  run.bind("gap", form.gap.at(watch, fast::Floats(x), Two(static_cast<double>(kZ))).first.lane);
  const fast::Components force = form.components(watch, &x, &kZ);
  if (std::string(piece) == "side") {
    run.expect(piece, force.x.first.lane, 0);
    run.expect(piece, force.z.first.lane, 1);
  } else {
    run.expect(piece, force.z.first.lane);
  }
  EXPECT_EQ(form.plane.minus_K.value, -kBump.stiffness);
}

// One binary32 product, which the processor rounds.
template <class Definition>
void wall() {
  const float x[2] = {kX, kX}, z[2] = {kZ, kZ};
  float fx[2], fz[2];
  EXPECT_TRUE(answer(form_of<Definition>(), 2, x, z, fx, fz));
  EXPECT_EQ(fx[0], 0);
  EXPECT_EQ(fz[0], kBump.stiffness * -kZ);
}

void bump_form(ComparedScript& script, bool) {
  wall<fast::Wall>();
  wall<fast::Bump1p>();
  const auto last_on_top = Built<fast::Bump3p>(kBump).definition.half_top;
  for (const float x : {0.05F, 0.3F}) {  // over the top of three polygons and over a side
    gap_of_sides<fast::Bump2p>(script, x);
    gap_of_sides<fast::Bump2pShaded>(script, x);
    gap_of_sides<fast::Bump3p>(script, x);
    gap_of_sides<fast::Bump3pShaded>(script, x);
    flat<fast::Bump2p>("laws/bump_2p", "side", x);
    flat<fast::Bump3p>("laws/bump_3p", x <= last_on_top ? "top" : "side", x);
  }
  shaded<fast::Bump1pShaded>(script);
  shaded<fast::Bump2pShaded>(script);
  shaded<fast::Bump3pShaded>(script);
}

template <class Definition>
void cylinder(ComparedScript& script) {
  RecordedRun run(script, true);
  name_position(run, kX, kZ);
  const auto form = form_of<Definition>();
  const Two x(static_cast<double>(kX)), z(static_cast<double>(kZ));
  run.bind("near_half", (form.half_width - x).first.lane);
  run.bind("far_half", (form.half_width + x).first.lane);
  run.bind("factor", (z + form.twice_d_head).first.lane);
  run.bind("twice_tail", form.twice_d_tail.first.lane);
  Watch watch;
  const Two v = form.v(watch, x, z);
  for (const char* piece : {"v_inside", "part_of_square", "sign_near", "sign_far"}) run.expect(piece, v.first.lane);
  ASSERT_TRUE(watch.last_distance);
  EXPECT_EQ(watch.last_distance->expression(), v.first.lane.expression());
  EXPECT_EQ(form.half_width.first.lane.value(), 0.5 * static_cast<double>(kBump.width));

  // The binary32 part: the script's square, sum and quotient.
  fast::CylinderForm<Definition> in_words = form;
  in_words.R = fast::Floats("R");
  in_words.R_squared_head = fast::Floats("head");
  in_words.R_squared_tail = fast::Floats("tail");
  EXPECT_EQ(in_words.rho_squared(fast::Floats("v")).words, "((head - v) + tail)");
  EXPECT_EQ(in_words.rough_t(fast::Floats("v"), fast::Floats("square")).words, "(v / ((R * sqrt(square)) + square))");
  EXPECT_EQ(static_cast<double>(form.R_squared_head.value) + static_cast<double>(form.R_squared_tail.value),
            form.R_squared.first.lane.value());
  script.compared.insert({"part_sum", "part_quotient"});

  // The step, whose six roundings the script has as e1 to e6, and that of ρ², which it has in es.
  const auto number = [&](const char* name, double value) {
    const Recorded result(value, run.expressions.input(name, 53));
    run.bind(name, result);
    return Two(result, result);
  };
  const double R_squared = form.R_squared.first.lane.value();
  const Two t = number("t_", 0.2), known_v = number("v_", 0.2 * 2.2 / 1.44 * R_squared);  // ρ = R/1.2
  run.bind("K", form.K.first.lane);
  run.bind("R_squared", form.R_squared.first.lane);
  run.bind("c", form.K_over_2R_squared.first.lane);
  EXPECT_EQ(form.K_over_2R_squared.first.lane.value(), 0.5 * form.K.first.lane.value() / R_squared);
  const Two scale = form.scale(t, known_v);
  run.expect_value("rnd(rnd(v_ - rnd(t_ * rnd(R_squared - v_)) * rnd(t_ + 2)) * rnd(t_ * c + c) + rnd(t_ * K))",
                   scale.first.lane.expression());
  script.compared.insert({"step", "sign_of_step"});

  run.bind("scale", scale.first.lane);
  run.bind("d_head", form.d_head.first.lane);
  run.bind("d_tail", form.d_tail.first.lane);
  run.bindings["l"] = run.value("rnd(rnd(z + d_head) + d_tail)");
  run.bind("plane", form.K.first.lane * -z.first.lane);
  const fast::Components force = form.components(scale, x, z);
  run.expect("force_x", force.x.first.lane);
  run.expect(form.kHasPlane ? "both_z" : "force_z", force.z.first.lane);
}

void cylinder_form(ComparedScript& script, bool) {
  cylinder<fast::Cylinder>(script);
  cylinder<fast::BumpCylinder>(script);
}

}  // namespace

std::map<std::string, Compare> comparisons_of_forms() {
  return {{"simd/bump_form", &bump_form}, {"simd/cylinder_form", &cylinder_form}};
}

}  // namespace forceshade::tests
