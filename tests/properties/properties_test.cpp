// SPDX-License-Identifier: BSD-3-Clause
// Every property can fail: renderers that are wrong in one way each, and the property that must say so.

#include "forceshade/properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "properties/binary32.h"
#include "properties/field_properties.h"
#include "properties/generators.h"
#include "properties/law_subject.h"
#include "properties/positions.h"

namespace forceshade::properties {
namespace {

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};
constexpr int kCases = 3000;
constexpr std::uint64_t kSeed = 11;

// The fast path with its answers changed by `change(position, answer)`.
template <class Change>
RenderedLaw changed(LawId law, const Change& change) {
  RenderedLaw subject = std::get<RenderedLaw>(fast_rendering(law, kBump));
  subject.force_at = [right = subject.force_at, change](const Eigen::Vector3f& position) {
    return change(position, right(position));
  };
  return subject;
}

PropertyResult result_of(const RenderedLaw& subject, const std::string& property) {
  for (const PropertyResult& result : run_properties(LawSubject(subject), kCases, kSeed))
    if (result.name == property) return result;
  throw std::invalid_argument(property);
}

TEST(properties, a_run_of_no_cases_holds_of_nothing_and_is_refused) {
  const LawSubject wall(LawId::wall, kBump);
  for (const int cases : {0, -5}) EXPECT_THROW(run_properties(wall, cases, kSeed), std::invalid_argument);
}

TEST(properties, a_run_that_is_stopped_calls_the_renderer_no_more) {
  std::atomic<bool> stop{false};
  int calls = 0, after = 0;
  const LawSubject subject(changed(LawId::wall, [&](const Eigen::Vector3f&, Rendered answer) {
    if (stop) ++after;
    if (++calls == 100) stop = true;
    return answer;
  }));
  run_properties(subject, 1000, kSeed, nullptr, nullptr, &stop);
  EXPECT_GE(calls, 100);
  EXPECT_LT(after, 10) << "the case in which it was stopped is finished";
}

// The progress of each property goes from 0 to 1 and never back, also while a failure is made simpler; results are as without
// a watcher.
TEST(properties, a_run_reports_each_case_of_each_property) {
  const LawSubject wrong(changed(LawId::bump_2p, [](const Eigen::Vector3f& position, Rendered answer) {
    if (position.x() > 1) answer.force.x() += 1;
    return answer;
  }));
  std::map<std::string, std::vector<double>> seen;
  const std::vector<PropertyResult> watched = run_properties(
      wrong, 200, kSeed, nullptr, [&](const std::string& property, double done) { seen[property].push_back(done); });
  const std::vector<PropertyResult> alone = run_properties(wrong, 200, kSeed);
  ASSERT_EQ(watched.size(), alone.size());
  ASSERT_EQ(seen.size(), watched.size());
  EXPECT_FALSE(watched[0].held);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(watched[i].held, alone[i].held) << alone[i].name;
    EXPECT_EQ(watched[i].counterexample, alone[i].counterexample);
    const std::vector<double>& done = seen[watched[i].name];
    EXPECT_GT(done.size(), 1U) << watched[i].name;
    EXPECT_EQ(done.front(), 0);
    EXPECT_EQ(done.back(), 1);
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end())) << watched[i].name;
  }
}

// Steps of both signs up to three, each as often as any other; the steps of a pair in x say nothing of those in z.
TEST(properties, neighbours_are_up_to_three_steps_away_in_either_direction) {
  Draws draws(1);
  std::map<int, int> steps;
  for (int i = 0; i < 7000; ++i) ++steps[draws.small_step()];
  for (int step = -3; step <= 3; ++step) EXPECT_NEAR(steps[step], 1000, 150) << step;
  EXPECT_EQ(steps.size(), 7U);
  const Generator<NearbyPair> generator = pair_of(std::get<RenderedLaw>(fast_rendering(LawId::bump_2p, kBump)).law);
  std::map<std::pair<int, int>, int> pairs;
  for (std::uint64_t seed = 0; seed < 4900; ++seed) {
    const NearbyPair pair = generator.draw(seed);
    ++pairs[{pair.x_steps, pair.z_steps}];
  }
  EXPECT_EQ(pairs.size(), 49U);
}

// Down to three corners, and one corner at a time too; a pair keeps its steps.
TEST(properties, simpler_cases_have_fewer_corners_or_rounder_positions) {
  const reference::Law law = std::get<RenderedLaw>(fast_rendering(LawId::bump_2p, kBump)).law;
  std::map<std::size_t, int> sizes;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto polygons = polygon_of(law);
    const std::vector<PathPoint> polygon = polygons.draw(seed);
    ++sizes[polygon.size()];
    std::map<std::size_t, std::size_t> simpler;
    for (const auto& one : polygons.simpler(polygon)) ++simpler[one.size()];
    EXPECT_EQ(simpler.empty(), polygon.size() == 3);
    if (simpler.empty()) continue;
    EXPECT_EQ(simpler.begin()->first, 3U);
    EXPECT_EQ(simpler[polygon.size() - 1], polygon.size()) << "without each of the corners";
    const NearbyPair pair = pair_of(law).draw(seed);
    for (const NearbyPair& one : pair_of(law).simpler(pair)) {
      EXPECT_NE(one.a, pair.a);
      EXPECT_EQ(one.x_steps, pair.x_steps);
      EXPECT_EQ(one.z_steps, pair.z_steps);
    }
  }
  EXPECT_EQ(sizes.size(), 6U);
}

struct Wrong {
  const char* what;
  const char* property;  // that must refuse it
  std::vector<LawId> laws;
  std::function<Rendered(const Eigen::Vector3f& position, Rendered right)> change;
};
Wrong negative_zero(const char* what, Eigen::Index axis) {
  return {what, "equivalence", {LawId::wall}, [axis](const Eigen::Vector3f&, Rendered answer) {
            if (answer.force[axis] == 0) answer.force[axis] = -0.0F;
            return answer;
          }};
}
std::vector<Wrong> wrong_renderers() {
  std::vector<LawId> all;
  for (const LawName& law : kLaws) all.push_back(law.id);
  const std::vector<LawId> shaded{LawId::bump_1p_shaded, LawId::bump_2p_shaded, LawId::bump_3p_shaded};
  std::vector<LawId> round = shaded, active = shaded;
  round.insert(round.end(), {LawId::cylinder, LawId::bump_cylinder});
  active.insert(active.end(), {LawId::bump_2p, LawId::bump_3p});
  return {{"one unit in the last place", "equivalence", all,
           [](const Eigen::Vector3f&, Rendered answer) {
             answer.force.z() = neighbour(answer.force.z(), answer.force.z() > 0.5F ? 1 : 0);
             return answer;
           }},
          negative_zero("a negative zero in x", 0),
          negative_zero("a negative zero in y", 1),
          negative_zero("a negative zero in z", 2),
          {"a silent zero",
           "equivalence",
           {LawId::wall},
           [](const Eigen::Vector3f&, Rendered answer) {
             if (answer.status == Status::invalid) answer.status = Status::free;
             return answer;
           }},
          {"a short normal on the ridge: as printed, sgn(0) = 0",
           "unit normals",
           {LawId::bump_2p},
           [](const Eigen::Vector3f& position, Rendered answer) {
             if (position.x() == 0) answer.force.x() = 0;
             return answer;
           }},
          {"an interpolated normal that was not normalised", "unit normals", round,
           [](const Eigen::Vector3f&, Rendered answer) {
             answer.force *= 0.999999F;
             return answer;
           }},
          {"a jump where none is listed", "continuity", all,
           [](const Eigen::Vector3f& position, Rendered answer) {
             if (answer.status == Status::contact && position.x() > 0) answer.force.x() += 0.01F;
             return answer;
           }},
          {"a listed jump of another size", "continuity", active,
           [](const Eigen::Vector3f& position, Rendered answer) {
             if (std::fabs(position.x()) > kBump.width / 2) answer.force *= 1.001F;
             return answer;
           }},
          // Friction with the wrong sign along x; and for the conservative laws a force that depends on the way round.
          {"a force that always pays a little", "passivity", all, [](const Eigen::Vector3f& position, Rendered answer) {
             if (answer.status == Status::contact) answer.force.x() += 1e-4F * position.z();
             return answer;
           }}};
}

TEST(properties, each_refuses_the_renderers_that_are_wrong_for_it) {
  for (const Wrong& wrong : wrong_renderers())
    for (const LawId law : wrong.laws)
      EXPECT_FALSE(result_of(changed(law, wrong.change), wrong.property).held) << wrong.what << ", " << name_of(law);
}

TEST(properties, counterexamples_are_simple) {
  // Wrong for every x above 1: the smallest such case has round numbers and no y.
  const PropertyResult result = result_of(changed(LawId::bump_1p,
                                                  [](const Eigen::Vector3f& position, Rendered answer) {
                                                    if (position.x() > 1) answer.force.x() = 1;
                                                    return answer;
                                                  }),
                                          "equivalence");
  ASSERT_FALSE(result.held);
  EXPECT_NE(result.counterexample.find("expected the force"), std::string::npos) << result.counterexample;
  EXPECT_NE(result.counterexample.find("y = 0x0p+0 (0)"), std::string::npos) << result.counterexample;
  EXPECT_NE(result.counterexample.find("z = 0x0p+0 (0)"), std::string::npos) << result.counterexample;
}

// On either edge of a shaded bump the jump is known to a thousandth; also across the edge and down at once.
TEST(properties, continuity_is_as_strict_on_the_left_edge_as_on_the_right) {
  for (const LawId law : {LawId::bump_1p_shaded, LawId::bump_2p_shaded, LawId::bump_3p_shaded})
    for (const float side : {1.0F, -1.0F}) {
      const RenderedLaw wrong = changed(law, [side](const Eigen::Vector3f& position, Rendered answer) {
        if (side * position.x() > kBump.width / 2) answer.force.x() += side * 1e-3F;
        return answer;
      });
      const RenderedLaw right = std::get<RenderedLaw>(fast_rendering(law, kBump));
      const LawClaims claims(right.law);
      const float edge = kBump.width / 2, beyond = neighbour(edge, 1);
      for (const float below : {-1.5F, neighbour(-1.5F, -20)}) {
        const Eigen::Vector3f a(side * edge, 0, -1.5F), b(side * beyond, 0, below);
        EXPECT_EQ(continuity(right, claims, a, b), std::nullopt) << name_of(law);
        EXPECT_NE(continuity(wrong, claims, a, b), std::nullopt) << name_of(law) << ", side " << side;
      }
    }
}

TEST(properties, continuity_knows_the_size_of_every_listed_jump) {
  // Straight across each line, on the fast path; the sizes are of the table in docs/laws.md.
  for (const LawId law :
       {LawId::bump_2p, LawId::bump_3p, LawId::bump_1p_shaded, LawId::bump_2p_shaded, LawId::bump_3p_shaded}) {
    const RenderedLaw subject = std::get<RenderedLaw>(fast_rendering(law, kBump));
    const LawClaims claims(subject.law);
    ASSERT_FALSE(claims.jump_lines.empty());
    for (const JumpLine& line : claims.jump_lines) {
      // The last position that the <= gives to the inside, and the first outside; for x = 0, either side of it.
      float inside = static_cast<float>(line.x);
      while (static_cast<long double>(inside) > line.x) inside = neighbour(inside, -1);
      const float a = line.x == 0 ? -0x1p-30F : inside, b = line.x == 0 ? 0.0F : neighbour(inside, 1);
      const float z = static_cast<float>(line.height) - 1.5F;
      const AllowedChange allowed = allowed_change(subject.law, claims, {a, 0, z}, {b, 0, z});
      EXPECT_TRUE(allowed.is_known);
      EXPECT_GT(allowed.jump, 0.1L) << name_of(law);
      EXPECT_LT(allowed.reach, 1e-5L);
      EXPECT_EQ(continuity(subject, claims, {a, 0, z}, {b, 0, z}), std::nullopt);
    }
  }
}

TEST(properties, continuity_expects_twice_K_R_across_the_axis) {
  for (const LawId law : {LawId::cylinder, LawId::bump_cylinder}) {
    const RenderedLaw subject = std::get<RenderedLaw>(fast_rendering(law, {1.25F, 1.5F, 2}));
    const LawClaims claims(subject.law);
    const Eigen::Vector3f a(1e-5F, 0, -1), b(-1e-5F, 0, -1);
    EXPECT_NEAR(static_cast<double>(allowed_change(subject.law, claims, a, b).jump), 2 * 2 * 1.25, 1e-12);
    EXPECT_EQ(continuity(subject, claims, a, b), std::nullopt);
  }
}

TEST(properties, active_laws_pay_what_is_promised_and_conservative_laws_nothing) {
  for (const LawName& law : kLaws) {
    const RenderedLaw subject = std::get<RenderedLaw>(fast_rendering(law.id, kBump));
    const LawClaims claims(subject.law);
    for (const float depth : {0.5F, 1.0F, 2.0F, 6.0F}) {
      const WitnessLoop loop = witness_loop(subject.law, depth);
      EXPECT_EQ(loop.bound_mJ[1] == 0, claims.is_conservative) << law.name;
      EXPECT_EQ(witness_is_reached(subject, claims, depth), std::nullopt) << law.name;
    }
  }
}

TEST(properties, a_renderer_that_pays_less_than_promised_is_refused) {
  for (const LawId law : {LawId::bump_2p, LawId::bump_3p_shaded}) {
    const RenderedLaw weak = changed(law, [](const Eigen::Vector3f&, Rendered answer) {
      answer.force *= 0.999F;
      return answer;
    });
    EXPECT_NE(witness_is_reached(weak, LawClaims(weak.law), 2), std::nullopt) << name_of(law);
  }
}

}  // namespace
}  // namespace forceshade::properties
