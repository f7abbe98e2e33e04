// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fast/law_operations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fast/evaluate.h"
#include "fast/laws/all.h"

namespace forceshade::tests {
namespace {

using fast::Built;

// Every constant of every law has another significand here.
constexpr Parameters kBump{530.3F, 0.71F, 0.7F};
constexpr double kX = 0.13F, kZ = -0.31F;  // mm: over the bump and below all its surfaces
constexpr double kBeside = 4.7F;           // mm: over the plane

void wall(ComparedScript& script, bool is_fused) {
  RecordedRun run(script, is_fused);
  const Built<fast::Wall> law(kBump);
  run.constant("K", law.definition.K);
  const auto force = law.definition.first_stage(Recorded(kX), -run.input("p", -kZ));
  run.expect("force", force.z);
  EXPECT_EQ(force.x.expression(), run.expressions.zero());
}

// K(H - z) along (x, √(R² - x²))/R. gap_at: the gap of a position over the bump; null for the law that shades the plane.
template <class Definition>
void shaded_bump(ComparedScript& script, bool is_fused,
                 const std::function<Recorded(const Definition&, const Recorded&, const Recorded&)>& gap_at) {
  for (int i = 0; i < 100; ++i) {
    const Parameters p{kBump.radius + 0.37F * static_cast<float>(i), kBump.width, kBump.stiffness};
    RecordedRun run(script, is_fused);
    run.constant("K", static_cast<double>(p.stiffness));
    run.constant("R", static_cast<double>(p.radius));
    run.constant("K_over_R", fast::Shading(p).K_over_R);
  }
  const Definition law = Built<Definition>(kBump).definition;
  for (const double x_value : {kX, -kX, 0.0, kBeside}) {
    RecordedRun run(script, is_fused);
    run.constant("K", static_cast<double>(kBump.stiffness));
    run.constant("R", law.shading.R);
    run.constant("K_over_R", law.shading.K_over_R);
    // The script has x > 0.
    const Recorded size = x_value == 0 ? Recorded(0) : run.input("x", std::fabs(x_value)), x = x_value < 0 ? -size : size;
    const Recorded z = run.input("z", kZ);
    const bool is_inside = std::fabs(x_value) < kBeside;
    if (gap_at != nullptr) run.bind("gap", is_inside ? gap_at(law, size, z) : -z);
    const auto force = law.first_stage(x, z);
    EXPECT_TRUE(force.contact.holds);
    if (is_inside && x_value != 0) {
      run.expect("x", x_value < 0 ? -force.x : force.x);
      run.expect("z", force.z);
    } else {
      run.expect("beside", force.z);
      EXPECT_EQ(force.x.expression(), run.expressions.zero());
    }
  }
}

void bump_1p_shaded(ComparedScript& script, bool is_fused) {
  shaded_bump<fast::Bump1pShaded>(script, is_fused, nullptr);
}
void bump_2p_shaded(ComparedScript& script, bool is_fused) {
  shaded_bump<fast::Bump2pShaded>(script, is_fused,
                                  [](const auto& law, const auto& size, const auto& z) { return law.gap.at(size, z).value; });
}
void bump_3p_shaded(ComparedScript& script, bool is_fused) {
  shaded_bump<fast::Bump3pShaded>(script, is_fused, [](const auto& law, const auto& size, const auto& z) {
    return law.gap.at(size, z, {std::fabs(size.value()) <= static_cast<double>(law.half_top)}).value;
  });
}

void bump_2p(ComparedScript& script, bool is_fused) {
  const fast::Bump2p law = Built<fast::Bump2p>(kBump).definition;
  for (const double x_value : {kX, -kX, 0.0, kBeside}) {
    RecordedRun run(script, is_fused);
    run.constant("K", law.K);
    run.constant("K_sine", law.K_sine);
    run.constant("K_cosine", law.K_cosine);
    const Recorded x(x_value), z = -run.input("p", -kZ);
    run.bind("gap", law.gap.at(absolute(x), z).value);
    const auto force = law.first_stage(x, z);
    if (std::fabs(x_value) == kBeside) {
      run.expect("plane", force.z);
      EXPECT_EQ(force.x.expression(), run.expressions.zero());
    } else {
      run.expect("side", x_value < 0 ? -force.x : force.x, 0);
      run.expect("side", force.z, 1);
    }
  }
}

void bump_3p(ComparedScript& script, bool is_fused) {
  const fast::Bump3p law = Built<fast::Bump3p>(kBump).definition;
  const double on_side = 0.5 * (law.half_width + static_cast<double>(law.half_top));
  for (const double x_value : {on_side, -on_side, 0.01, kBeside}) {
    RecordedRun run(script, is_fused);
    run.constant("K", law.K);
    run.constant("K_sine", law.K_sine);
    run.constant("K_cosine", law.K_cosine);
    const Recorded x(x_value), z = -run.input("p", -kZ);
    const bool is_on_top = std::fabs(x_value) <= static_cast<double>(law.half_top);
    run.bind("gap", law.gap.at(absolute(x), z, {is_on_top}).value);
    const auto force = law.first_stage(x, z);
    if (std::fabs(x_value) == on_side) {
      run.expect("side", x_value < 0 ? -force.x : force.x, 0);
      run.expect("side", force.z, 1);
    } else {
      run.expect(is_on_top ? "top" : "plane", force.z);
      EXPECT_EQ(force.x.expression(), run.expressions.zero());
    }
  }
}

// The constants of one side or top of a bump, which the script knows by these names.
void name_gap(RecordedRun& run, const fast::LinearGap& gap) {
  run.constant("height", gap.height);
  run.constant("height_tail", gap.height_tail);
  if (gap.slope.head == 0) {
    for (const char* name : {"slope", "slope_tail"}) run.bind(name, Recorded(0));
    return;
  }
  run.constant("slope", gap.slope.head);
  run.constant("slope_tail", gap.slope.tail);
}

void polygon_gap(ComparedScript& script, bool is_fused) {
  const fast::LinearGap two = Built<fast::Bump2p>(kBump).definition.gap;
  const fast::ThreePolygonGap three = Built<fast::Bump3p>(kBump).definition.gap;
  const auto expect = [&](const fast::LinearGap& constants, const auto& gap_at) {
    RecordedRun run(script, is_fused);
    name_gap(run, constants);
    run.assume_larger("height", "slope * ax");
    const fast::Gap<Recorded> gap = gap_at(run.input("ax", kX), run.input("z", kZ));
    for (const GappaScript::Piece& piece : script.script.pieces()) run.expect(piece.name, gap.value);
    ASSERT_EQ(run.recording.comparisons.size(), 1U);
    run.expect_value("value", run.recording.comparisons[0].left);
    run.expect_value("1b-27 * height", run.recording.comparisons[0].right);
  };
  expect(two, [&](const Recorded& ax, const Recorded& z) { return two.at(ax, z); });
  expect(three.top, [&](const Recorded& ax, const Recorded& z) { return three.at(ax, z, {true}); });
  expect(three.side, [&](const Recorded& ax, const Recorded& z) { return three.at(ax, z, {false}); });
}

// On the script's v and l, under what it says of the rounding of sums.
void cylinder(ComparedScript& script, bool is_fused) {
  const fast::Cylinder law = Built<fast::Cylinder>(kBump).definition;
  const auto expect = [&](bool is_near, bool is_force_inside, const char* v, const std::vector<const char*>& pieces_of_v) {
    for (const double side : {1.0, -1.0}) {
      RecordedRun run(script, is_fused);
      run.constant("K", law.K);
      run.constant("R", law.R);
      run.expressions.name_constant(law.anchor, run.expressions.input("anchor", 53));
      run.bind("anchor", Recorded(law.anchor));
      run.constant("anchored", law.anchored);
      run.constant("rest", law.rest);
      run.constant("d_head", law.d.head);
      run.constant("d_tail", law.d.tail);
      const Recorded size = run.input("x", kX), z = run.input("z", kZ);
      if (is_near) {
        run.assume_larger("anchored", "xx");
        run.assume_larger("a", "zz");
      }
      if (is_force_inside) run.expressions.assume_binary64(run.value("b_anchor"));  // Sterbenz
      const auto force = law.first_stage(side > 0 ? size : -size, z);
      EXPECT_TRUE(force.contact.holds);
      const std::vector<Comparison>& compared = run.recording.comparisons;
      ASSERT_EQ(compared.size(), 3U);
      for (const char* piece : pieces_of_v) run.expect(piece, compared[0].left);
      EXPECT_EQ(compared[0].right, run.expressions.zero());
      EXPECT_EQ(compared[1].left, compared[0].left);
      run.expect_value("rnd(1b-25 * -z * d_head + 1b-50 * anchor)", compared[1].right);
      EXPECT_EQ(compared[2].left, z.expression());
      if (!is_force_inside) continue;
      run.bindings["near_v"] = run.value(v);
      run.bindings["near_l"] = run.value("l");
      run.expect("force_x", side > 0 ? force.x : -force.x);
      run.expect("force_z", force.z);
      // The pieces of l bound the l that was just found in the force.
      for (const char* piece : {"l_cancelling_above", "l_cancelling_below", "l_far_above", "l_far_below"})
        run.expect(piece, run.value("l"));
    }
  };
  expect(true, true, "v", {"v_inside"});
  expect(true, false, "v_rough", {"sign_near_inside", "sign_near_outside"});
  expect(false, false, "v_far", {"sign_far"});
}

void bump_cylinder(ComparedScript& script, bool is_fused) {
  const fast::BumpCylinder law = Built<fast::BumpCylinder>(kBump).definition;
  for (const double height : {kZ, 2e-5}) {
    RecordedRun run(script, is_fused);
    const Recorded x(kX), z(height);
    const auto cylinder = static_cast<const fast::Cylinder&>(law).off_axis(x, z);
    run.bind("from_wall", height < 0 ? Recorded(law.K) * -z : Recorded(0));
    run.bind("from_cylinder", cylinder.z);
    const auto force = law.first_stage(x, z);
    EXPECT_TRUE(force.contact.holds);
    run.expect("z", force.z);
    run.bind("from_cylinder", cylinder.x);
    run.expect("x", force.x);
  }
}

}  // namespace

std::map<std::string, Compare> comparisons_of_laws() {
  return {
      {"laws/wall", &wall},
      {"laws/bump_1p", &wall},
      {"laws/cylinder", &cylinder},
      {"laws/bump_cylinder", &bump_cylinder},
      {"laws/bump_2p", &bump_2p},
      {"laws/bump_3p", &bump_3p},
      {"laws/bump_1p_shaded", &bump_1p_shaded},
      {"laws/bump_2p_shaded", &bump_2p_shaded},
      {"laws/bump_3p_shaded", &bump_3p_shaded},
      {"laws/polygon_gap", &polygon_gap},
  };
}

}  // namespace forceshade::tests
