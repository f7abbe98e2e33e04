// SPDX-License-Identifier: BSD-3-Clause
// The Gappa scripts of fast/ describe the headers of fast/, operation by operation: each header's own templates run on numbers
// that write down what is done with them (tests/fast/recorded_number.h), once with multiply_add in two operations and once
// fused, and what they wrote must be what the script says of the number whose error it bounds (tests/fast/gappa_script.h).
// Another order, operand, sign, constant or fusing on either side is a failure.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "fast/damping/filter.h"
#include "fast/evaluate.h"
#include "fast/heights/force.h"
#include "fast/heights/spline.h"
#include "fast/heights/spline_force.h"
#include "fast/meshes/quick_slips.h"
#include "fast/meshes/vector3.h"
#include "forceshade/fast.h"
#include "tests/fast/form_operations.h"
#include "tests/fast/law_operations.h"
#include "tests/fast/pack_operations.h"
#include "tests/fast/recorded_row.h"
#include "tests/fast/recorded_run.h"

namespace forceshade::tests {
namespace {

using fast::Terms;

void double_double(ComparedScript& script, bool is_fused) {
  RecordedRun run(script, is_fused);
  const Terms<Recorded> a{run.input("a_hi", 1.3), run.input("a_lo", 0x1.3p-55)},
      b{run.input("b_hi", 1.7), run.input("b_lo", 0x1.1p-54)};
  const auto whole = [&](const Terms<Recorded>& all) { return run.expressions.sum(all.hi.expression(), all.lo.expression()); };
  for (const auto& [result, correction] : {std::pair{"p", "s"}, std::pair{"q", "e"}, std::pair{"r", "f"}})
    run.assume_larger(result, correction);
  run.expect("product", whole(product_of(a, b)));
  run.expect("quotient", whole(quotient_of(a, b)));
  run.expect("root", whole(square_root_of(a)));
}

// The map's gradient along one axis is the script's x, that along the other its y.
void height_force(ComparedScript& script, bool is_fused) {
  for (const bool is_along_x : {true, false})
    for (const bool is_level : {true, false})
      for (const auto& [mode, name] : height::kModes) {
        RecordedRun run(script, is_fused);
        const Recorded K = run.input("K", 0.7), gap = run.input("gap", 0.3), x = run.input("x", 1.1),
                       y = is_level ? Recorded(0) : run.input("y", -0.4);
        const auto force = is_along_x ? fast::gap_force(gap, x, y, mode, K) : fast::gap_force(gap, y, x, mode, K);
        const Recorded& along = is_along_x ? force.x : force.y;
        if (mode == height::Mode::conservative) {
          run.expect("conservative", along);
          run.expect_value("rnd(K * gap)", force.up.expression());
        } else {
          run.expect(is_level ? "level" : "force", along, 0);
          run.expect(is_level ? "level" : "force", force.up, 1);
        }
        if (is_level) {
          EXPECT_EQ((is_along_x ? force.y : force.x).expression(), run.expressions.zero());
        }
      }
}

std::string numbered(const char* name, std::size_t i) {
  std::string result(name);
  return result += std::to_string(i);
}

void height_spline(ComparedScript& script, bool is_fused) {
  RecordedRun run(script, is_fused);
  run.expressions.products_always_round = true;
  auto values =
      std::make_shared<height::Grid>(height::Grid{4, 4, 0.37F, height::Edge::clamp, height::Interpolant::cubic_spline, {}});
  for (int i = 0; i < 16; ++i) values->values.push_back(1 + std::sin(static_cast<float>(7 * i * i + 1)));
  const fast::HeightGrid grid(values);
  const float* c = grid.values();
  const RecordedTwo past{{0.11, run.expressions.input("past x", 53)}, {0.23, run.expressions.input("past y", 53)}};
  const Recorded per_pitch(grid.per_pitch()[0]), t = past.first * per_pitch, s = past.second * per_pitch;

  // Weights along x, and columns along y.
  const RecordedFour x(t), y(s);
  const auto by_column = [](const double(&a)[4]) { return RecordedFour::load(a); };
  const RecordedFour weights = fast::value_weight(x, by_column), slopes = fast::slope_weight(x, by_column);
  run.bind("t", t);
  for (std::size_t k = 0; k < 4; ++k)
    for (const auto& [kind, lanes] : {std::pair{"weight_", weights}, std::pair{"slope_", slopes}}) {
      const std::string piece = numbered(kind, k);
      for (const auto& [name, is] : script.script.constants(piece, run.expressions)) run.bindings[name] = is;
      run.expect(piece, lanes.lanes[k]);
    }
  const auto row = [&](int l) { return RecordedFour::load(c + 4 * l); };
  const fast::SplineColumn<RecordedFour> columns(row(0), row(1), row(2), row(3), RecordedFour(static_cast<double>(c[5])), y);
  run.bind("t", s);
  run.bind("third", Recorded(1 / 3.0));
  run.bind("sixth", Recorded(1 / 6.0));
  for (std::size_t k = 0; k < 4; ++k) {
    const auto coefficient = [&](std::size_t l) { return Recorded(static_cast<double>(c[4 * l + k])); };
    for (std::size_t l = 0; l < 3; ++l) run.bind(numbered("s", l), coefficient(l + 1) - coefficient(l));
    run.bind("b", coefficient(1) - Recorded(static_cast<double>(c[5])));
    run.expect("value", columns.value.lanes[k]);
    run.expect("twice_slope", columns.twice_slope.lanes[k]);
  }

  // The sums of four, as one position in four lanes and as several positions side by side.
  const fast::SplineValues<RecordedFour> one(grid, past, c, 4);
  const fast::SplineJets<Recorded> side_by_side(
      [&](std::size_t k, std::size_t l) { return Recorded(static_cast<double>(c[4 * l + k])); }, t, s, grid.per_slope());
  EXPECT_EQ(one.c.expression(), run.expressions.constant(static_cast<double>(c[5])));
  const auto expect = [&](const char* piece, const RecordedFour& w, const RecordedFour& h, const Recorded& first,
                          const Recorded& second) {
    for (std::size_t k = 0; k < 4; ++k) {
      run.bind(numbered("w", k), w.lanes[k]);
      run.bind(numbered("h", k), h.lanes[k]);
    }
    run.bind("p", per_pitch);
    run.expect(piece, first);
    run.expect(piece, second);
  };
  expect("rise", weights, columns.value, one.rise, side_by_side.rise);
  expect("along", slopes, columns.value, one.Ux, side_by_side.Ux);
  expect("aside", weights, columns.twice_slope, one.Uy, side_by_side.Uy);
}

// The header's products of vectors; each component of a cross product is the script's first, with the axes in turn.
void mesh_decisions(ComparedScript& script, bool is_fused) {
  RecordedRun run(script, is_fused);
  run.expressions.products_always_round = true;
  const auto vector = [&](const char* x, const char* y, const char* z) {
    return fast::Vector3<Recorded>{run.input(x, 0.3), run.input(y, -0.7), run.input(z, 0.9)};
  };
  const auto a = vector("ax", "ay", "az"), b = vector("bx", "by", "bz"), c = vector("cx", "cy", "cz"),
             d = vector("dx", "dy", "dz");
  const auto n = fast::cross(a, b);
  for (const char* piece : {"along", "length", "offset_length"}) run.expect(piece, fast::dot(a, b));
  for (const char* piece : {"across", "passes"}) run.expect(piece, fast::dot(n, c));
  for (const char* piece : {"inside", "area"}) run.expect(piece, fast::dot(fast::cross(c, d), n));
  run.expect("pressed", fast::cross(c, d).x);
  run.expect("pulled", fast::cross(n, d).x);
  run.expect("way", fast::way_to_hand(run.input("ck", 0.6), run.input("cl", -0.2), run.input("lift", 0.5), a.x, b.x, n.x));
  const auto expect = [&](const Recorded& found, const Recorded& ay, const Recorded& az, const Recorded& by,
                          const Recorded& bz) {
    run.bind("ay", ay);
    run.bind("az", az);
    run.bind("by", by);
    run.bind("bz", bz);
    run.expect("normal", found);
  };
  expect(n.x, a.y, a.z, b.y, b.z);
  expect(n.y, a.z, a.x, b.z, b.x);
  expect(n.z, a.x, a.y, b.x, b.y);
  const Recorded k = run.input("ck", 0.6), l = run.input("cl", -0.2);
  const fast::Gram<Recorded> gram{run.input("ee", 1.1), run.input("ef", 0.4), run.input("ff", 1.7)};
  run.expect("pull", fast::pull_squared(k, l, gram));
  run.expect("gain", fast::gain_by_step(k, l, gram.first, gram.mixed));
  run.expect("third", fast::third_weight(run.input("all", 0.8), run.input("second", 0.4), run.input("other", -0.3)));
}

// The parts of the bound that the pieces share_… divide by are those of its sum.
void grid_parameters(ComparedScript& script, bool is_fused) {
  for (const double sign : {1.0, -1.0}) {
    RecordedRun run(script, is_fused);
    run.expressions.products_always_round = true;
    const Recorded n = run.input("n", 0.7), en = run.input("en", 1e-15);
    const auto scale = fast::GridScale<Recorded>::over(run.input("d", 1.3), run.input("ed", 1e-14));
    const auto quotient = scale.quotient(sign > 0 ? n : -n, en);
    run.expect("share_of_rounding", sign > 0 ? quotient.value : -quotient.value);
    run.expect("bound", quotient.error);
    run.expect_value("relative", scale.relative.expression());
    script.compared.insert({"share_of_divisor", "share_of_numerator"});
  }
}

void damping(ComparedScript& script, bool is_fused) {
  RecordedRun run(script, is_fused);
  run.expressions.products_always_round = true;
  const fast::Vector3<Recorded> three{run.input("a", 0.3), run.input("b", 0.7), run.input("c", 0.9)};
  const Recorded sum = fast::sum_of_three(three), v = run.input("v", -0.4);
  run.expect("part_sum", sum);
  run.bind("along", sum);
  run.bind("square", sum);
  const fast::AlongForce<Recorded> along(three, three);
  EXPECT_EQ(run.expressions.difference(along.square.expression(), sum.expression()), "");
  EXPECT_EQ(run.expressions.difference(along.size.expression(), along.sum.expression()), "");
  run.expect("turn", along.turn(run.input("damping", 0.002), run.input("margin", 1e-15)));
  const Recorded scale = run.input("scale", 0.8), drag = run.input("drag", 0.001), f = run.input("f", 1.2);
  run.expect("full", fast::fullness(scale, along.square, run.input("per_square", 16)));
  run.expect("force", fast::pressed(scale, drag, along.sum * (Recorded(1) / along.square)) * f - drag * v);
  const Recorded x = run.input("x", 1.5), before = run.input("before", 1.25);
  run.expect("velocity", fast::VelocityAfter<Recorded>(v, x, before, run.input("keep", 0.75), run.input("gain", 250)).value);
}

// By the name of the script below fast/, without its end.
const std::map<std::string, Compare> kComparisons = [] {
  std::map<std::string, Compare> all = comparisons_of_laws();
  all.merge(comparisons_of_forms());
  all.insert({
      {"damping/damping", &damping},
      {"numbers/double_double", &double_double},
      {"heights/force", &height_force},
      {"heights/spline", &height_spline},
      {"meshes/decide", &mesh_decisions},
      {"meshes/grid_parameters", &grid_parameters},
  });
  return all;
}();

TEST(proof_operations, of_every_piece_of_every_script_are_those_of_its_header) {
  const std::filesystem::path fast = FORCESHADE_SOURCE_DIR "/fast";
  std::size_t scripts = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(fast)) {
    if (file.path().extension() != ".g") continue;
    ++scripts;
    const std::string name = std::filesystem::relative(file.path(), fast).replace_extension();
    SCOPED_TRACE(name);
    ASSERT_TRUE(kComparisons.contains(name)) << "expected a comparison with the header of this script";
    ComparedScript script(name);
    for (const bool is_fused : {false, true}) kComparisons.at(name)(script, is_fused);
    for (const GappaScript::Piece& piece : script.script.pieces())
      EXPECT_TRUE(script.compared.contains(piece.name)) << "piece " << piece.name << " was compared with nothing";
  }
  EXPECT_EQ(scripts, kComparisons.size());
}

// The sum has no script: it is algorithm 6 of Joldes, Muller and Popescu 2017, AccurateDWPlusDW, written out here.
TEST(proof_operations, of_the_sum_of_double_double_are_those_of_the_cited_algorithm) {
  ComparedScript script("numbers/double_double");
  RecordedRun run(script, true);
  const Terms<Recorded> x{run.input("a_hi", 1.3), run.input("a_lo", 0x1.3p-55)},
      y{run.input("b_hi", 1.7), run.input("b_lo", 0x1.1p-54)};
  const Terms<Recorded> z = sum_of(x, y);
  struct Two {
    Scaled high, low;
  };
  const auto define = [&](const char* name, const char* is) { return run.bindings[name] = run.value(is); };
  const auto two_sum = [&](const Scaled& a, const Scaled& b) {
    run.bindings = {{"a", a}, {"b", b}};
    const Scaled high = define("s", "rnd(a + b)");
    define("b_part", "rnd(s - a)");
    define("a_part", "rnd(s - b_part)");
    return Two{high, run.value("rnd(rnd(a - a_part) + rnd(b - b_part))")};
  };
  const auto fast_two_sum = [&](const Scaled& a, const Scaled& b) {
    run.bindings = {{"a", a}, {"b", b}};
    const Scaled high = define("s", "rnd(a + b)");
    return Two{high, run.value("rnd(b - rnd(s - a))")};
  };
  const auto sum = [&](const Scaled& a, const Scaled& b) { return run.expressions.rounded(run.expressions.sum(a, b)); };
  const Two s = two_sum(x.hi.expression(), y.hi.expression()), t = two_sum(x.lo.expression(), y.lo.expression());
  const Two v = fast_two_sum(s.high, sum(s.low, t.high)), expected = fast_two_sum(v.high, sum(t.low, v.low));
  EXPECT_EQ(run.expressions.difference(z.hi.expression(), expected.high), "");
  EXPECT_EQ(run.expressions.difference(z.lo.expression(), expected.low), "");
}

// spline.g counts errors in steps, the largest difference of coefficients side by side along either axis.
TEST(proof_operations, bounds_of_a_spline_are_in_its_largest_steps) {
  for (const auto& [along, across] :
       {std::pair{0.0F, 0.5F}, std::pair{0.5F, 0.0F}, std::pair{0.25F, 0.5F}, std::pair{2.0F, 0.5F}}) {
    height::Grid values{6, 5, 0.25F, height::Edge::clamp, height::Interpolant::cubic_spline, {}};
    for (std::uint32_t j = 0; j < values.rows; ++j)
      for (std::uint32_t i = 0; i < values.columns; ++i)
        values.values.push_back(3 + along * static_cast<float>(i % 2) + across * static_cast<float>(j % 2));
    const fast::SplineMap map(fast::HeightGrid(std::make_shared<const height::Grid>(values)), height::Mode::true_height, 1);
    const double error = fast::kSplineError * static_cast<double>(std::max(along, across)), slope_error = error / 0.25;
    EXPECT_EQ(map.sure.gap * fast::kErrorBudgetShare, error);
    EXPECT_EQ(map.sure.Ux * fast::kErrorBudgetShare, along > 0 ? slope_error : 0);
    EXPECT_EQ(map.sure.Uy * fast::kErrorBudgetShare, across > 0 ? slope_error : 0);
  }
}

// The numbers that the headers really run on do what the recording number writes down.
TEST(proof_operations, of_each_instruction_set_are_those_recorded) {
  EXPECT_STREQ(wrong_operation_without_vectors(), nullptr);
#if defined(__x86_64__)
  if (fast::is_available(fast::InstructionSet::avx2)) {
    EXPECT_STREQ(wrong_operation_avx2(), nullptr);
  }
  if (fast::is_available(fast::InstructionSet::avx512)) {
    EXPECT_STREQ(wrong_operation_avx512(), nullptr);
  }
#endif
}

}  // namespace
}  // namespace forceshade::tests
