// SPDX-License-Identifier: BSD-3-Clause
// Damping under conform: this program's own holds, and each fault of dampers is found by the check that looks for it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "properties/conformance/conform.h"
#include "properties/conformance/invariants/trial.h"
#include "properties/conformance/judgement_text.h"
#include "properties/conformance/scene.h"
#include "properties/conformance/strokes.h"
#include "properties/conformance/vectors.h"
#include "rendering/meshes/make.h"
#include "tests/conformance/own_renderer.h"

namespace forceshade::conformance::damper_test {
namespace {

using Names = std::set<std::string>;

const std::string kExact = "exact", kLeaving = "the damper lets go: a hand that leaves is not pulled back",
                  kLanding = "a landing begins without a step", kRest = "at rest damping adds nothing, however the hand came",
                  kPauses = "after a pause no speed is left", kMissed = "missed positions count as evenly spaced",
                  kNoise = "one position changes damping by the filter's share alone";

const Description kWall{"wall", DescribedLaw{LawId::wall, {.stiffness = 0.75F}}};

Json hello_with(const Json& damping) {
  return {{"kind", "renderer"},       {"name", "damper"},       {"version", "1"},      {"memory", "path"},
          {"answers", "force"},       {"claims", "invariants"}, {"length_unit", "mm"}, {"force_unit", "N"},
          {"frame", {"x", "y", "z"}}, {"domain_mm", 10000},     {"rate_Hz", 1000},     {"loop_energy_mJ", nullptr},
          {"damping", damping}};
}

enum class Fault {
  none,
  pulls,
  no_limit,
  steps,
  steps_unnoticed,
  no_limit_at_first_touch,
  keeps_speed,
  unfiltered_sign,
  speed_outlives_pause,
  ignores_periods,
  other_rate
};

// A wall with damping along z, in binary64.
class Damper : public RendererUnderTest {
 public:
  Damper(Fault fault, bool claims_definition, const Json& scene, const Json& also = Json::object()) : fault_(fault) {
    Json damping = {{"damping", kDamping}, {"share", kShare}};
    damping.update(also);
    Json hello = hello_with(damping);
    if (claims_definition) hello["claims"] = "definition";
    hello_ = hello_of(hello, scene);
  }

  const Hello& hello() const override { return hello_; }
  void say_goodbye() override {}

  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset,
                                       std::span<const std::uint32_t> periods) override {
    if (is_reset) has_last_ = false;
    std::vector<Eigen::Vector3f> forces;
    for (std::size_t i = 0; i < positions.size(); ++i)
      forces.emplace_back(0, 0, force(positions[i], periods.empty() ? 1 : periods[i]));
    return forces;
  }

 private:
  static constexpr float kDamping = 0.002F, kShare = 0.25F;

  float force(const Eigen::Vector3f& position, std::uint32_t periods) {
    since_ += periods;
    if (!(position.array().abs() <= 10'000).all()) return 0;
    const double z = std::abs(position.z()) < 0x1p-30F ? 0 : static_cast<double>(position.z());
    if (periods > 0) move_to(z);
    const double spring = z < 0 ? -0.75 * z : 0, most = has_no_limit(spring) ? HUGE_VAL : 2 * spring;
    double speed = static_cast<double>(speed_);
    if (fault_ == Fault::unfiltered_sign) speed = std::copysign(speed, unfiltered_);
    double damped = spring - static_cast<double>(kDamping) * speed;
    if (fault_ != Fault::pulls) damped = std::max(damped, 0.0);
    if (spring == 0) return 0;
    return static_cast<float>(std::min(damped, most) + (fault_ == Fault::steps             ? 0.1
                                                        : fault_ == Fault::steps_unnoticed ? 0.005
                                                                                           : 0));
  }

  bool has_no_limit(double spring) const {
    return fault_ == Fault::no_limit || (fault_ == Fault::no_limit_at_first_touch && spring < 0.005);
  }

  void move_to(double z) {
    const double rate = fault_ == Fault::other_rate ? 500 : 1000;
    const std::uint32_t passed = fault_ == Fault::ignores_periods ? 1 : since_;
    since_ = 0;
    if (!has_last_ || (passed > 16 && fault_ != Fault::speed_outlives_pause)) {
      speed_ = 0;
    } else if (passed <= 16 && (fault_ != Fault::keeps_speed || z != last_)) {
      unfiltered_ = rate * (z - last_) / passed;
      for (std::uint32_t period = 0; period < passed; ++period) {
        const double speed = static_cast<double>(speed_);
        speed_ = static_cast<float>(speed + static_cast<double>(kShare) * (unfiltered_ - speed));
        if (std::abs(speed_) < 0x1p-20F) speed_ = 0;
      }
    }
    has_last_ = true;
    last_ = z;
  }

  Fault fault_;
  Hello hello_;
  bool has_last_ = false;
  double last_ = 0, unfiltered_ = 0;
  float speed_ = 0;
  std::uint32_t since_ = 0;
};

Names failures(const Conformance& its) {
  EXPECT_FALSE(its.failure) << *its.failure;
  Names names;
  if (its.judgement.all.beyond > 0) names.insert(kExact);
  for (const Invariant& invariant : its.invariants)
    if (invariant.violation) names.insert(invariant.name);
  EXPECT_EQ(names.empty(), its.held()) << words_of(its, {});
  return names;
}

Names failures(Fault fault, bool claims_definition = false, const Json& also = Json::object()) {
  const auto open = [=](const Json& scene) { return std::make_unique<Damper>(fault, claims_definition, scene, also); };
  return failures(conform(kWall, open, {.points = 4000, .tolerance = {Unit::newton, *files::Decimal::of("0.001")}}));
}

TEST(damping_under_conform, a_renderer_without_faults_holds) {
  EXPECT_EQ(failures(Fault::none), Names{});
  EXPECT_EQ(failures(Fault::none, true), Names{});
}

TEST(damping_under_conform, each_fault_is_found_by_the_check_that_looks_for_it) {
  EXPECT_TRUE(failures(Fault::pulls).contains(kLeaving));
  EXPECT_TRUE(failures(Fault::no_limit).contains(kLanding));
  EXPECT_TRUE(failures(Fault::steps).contains(kLanding)) << "one of a tenth of a newton is felt, too";
  EXPECT_TRUE(failures(Fault::steps, false, {{"drag", 0.001}, {"full_at", 0x1p-10}}).contains(kLanding))
      << "as much drag is no step";
  EXPECT_FALSE(failures(Fault::steps_unnoticed).contains(kLanding)) << "one of a two hundredth is not";
  EXPECT_TRUE(failures(Fault::no_limit_at_first_touch).contains(kLanding)) << "looked at in the first micrometres";
  EXPECT_TRUE(failures(Fault::keeps_speed).contains(kRest));
  EXPECT_EQ(failures(Fault::speed_outlives_pause), Names{kPauses});
  EXPECT_TRUE(failures(Fault::ignores_periods).contains(kMissed));
  EXPECT_EQ(failures(Fault::unfiltered_sign), Names{kNoise});
}

TEST(damping_under_conform, what_needs_no_definition_cannot_be_blamed_for_another_rate) {
  EXPECT_EQ(failures(Fault::other_rate), Names{});
  EXPECT_EQ(failures(Fault::other_rate, true), Names{kExact});
}

// On other scenes, with every parameter, bit for bit.
TEST(damping_under_conform, holds_of_the_own_renderer) {
  MeshRendering ball{
      std::get<mesh::CheckedMesh>(mesh::check(mesh::icosphere(3, 20))), {}, mesh::Sides::front, mesh::Shading::none, 0.5F};
  const std::array<Description, 4> scenes{kWall, Description{"bump", DescribedLaw{LawId::bump_2p, {15.24F, 25.4F, 0.5F}}},
                                          Description{"shaded", DescribedLaw{LawId::bump_1p_shaded, {15.24F, 25.4F, 0.5F}}},
                                          Description{"ball", ball}};
  const std::array<Json, 4> dampings{Json{{"damping", 0.002}}, Json{{"damping", 0.004}, {"share", 0.1}, {"drag", 0.001}},
                                     Json{{"damping", 0.01}, {"most", nullptr}, {"share", 0.5}},
                                     Json{{"drag", 0.002}, {"full_at", 1}, {"share", 0.3}}};
  std::size_t next = 0;
  for (const std::size_t damper : {0U, 1U, 2U, 3U, 1U}) {
    const Description& scene = scenes[std::min(next++, scenes.size() - 1)];
    const Json& damping = dampings[damper];
    const auto declares = [&](Description&, Json& hello) {
      hello["rate_Hz"] = 500;
      hello["damping"] = damping;
      return Spoil();
    };
    const Conformance its = conform(scene, own_renderer(scene, declares), {.points = 2000});
    EXPECT_EQ(failures(its), Names{});
    EXPECT_EQ(its.judgement.all.wrong, 0U);
    EXPECT_GT(its.judgement.all.cases, 1900U);
    EXPECT_EQ(its.invariants.size(), 25U);
    for (const Invariant& invariant : its.invariants)
      if (invariant.name == kRest || invariant.name == kLeaving) {
        EXPECT_FALSE(invariant.not_applicable) << invariant.name;
      }
  }
}

TEST(damping_under_conform, a_wrong_answer_is_shown_with_its_periods) {
  const auto ignores = [](const Json& scene) { return std::make_unique<Damper>(Fault::ignores_periods, true, scene); };
  const Conformance its = conform(kWall, ignores, {.points = 2000, .tolerance = {Unit::newton, *files::Decimal::of("0.001")}});
  ASSERT_TRUE(its.counterexample);
  ASSERT_EQ(its.periods_of_shortest_path.size(), its.shortest_path.size());
  EXPECT_GT(std::ranges::max(its.periods_of_shortest_path), 1U);
  EXPECT_NE(words_of(its, {}).find("const unsigned periods[] = {"), std::string::npos);
}

// Half of the positions that are numbers are ends of strokes of four ticks, after a pause.
TEST(damping_under_conform, strokes_are_at_the_speed_of_a_hand_and_miss_positions) {
  const auto subject = properties::subject_of(kWall);
  constexpr int kPositions = 4000, kTicks = 4;
  Strokes strokes(subject->positions(5), true, 5);
  const auto positions = subject->positions(5);
  std::map<std::uint32_t, int> alone, in_strokes;  // by periods
  int ends = 0, ways = 0, up = 0, slow = 0;
  for (int i = 0; i < kPositions; ++i) {
    const properties::Aimed aimed = positions->next();
    std::vector<Tick> ticks{strokes.next()};
    const bool is_alone = same_bits(ticks[0].aimed.position, aimed.position) && ticks[0].aimed.aim == aimed.aim;
    while (!is_alone && ticks.size() < kTicks) ticks.push_back(strokes.next());
    ASSERT_TRUE(same_bits(ticks.back().aimed.position, aimed.position) && ticks.back().aimed.aim == aimed.aim) << i;
    if (is_alone) {
      ++alone[ticks[0].periods];
      continue;
    }
    ++ends;
    EXPECT_EQ(ticks[0].periods, kPause);
    for (std::size_t tick = 1; tick < kTicks; ++tick) ++in_strokes[ticks[tick].periods];
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const float end = aimed.position[axis], way = end - ticks[0].aimed.position[axis];
      if (std::fabs(end) > 16) continue;  // where roundings are long beside the shortest steps
      EXPECT_LE(std::fabs(way), 3 * 0.5F + 1e-5F);
      EXPECT_NEAR(ticks[2].aimed.position[axis], end - way / 3, 1e-5F);
      ++ways;
      up += way > 0;
      slow += std::fabs(way) < 3 * 0x1p-8F;
    }
  }
  EXPECT_NEAR(ends, kPositions / 2, kPositions / 10);
  EXPECT_NEAR(up, ways / 2, ways / 10);
  EXPECT_NEAR(slow, ways / 4, ways / 10);
  EXPECT_EQ(alone.size(), kPause + 1) << "0 to a pause";
  EXPECT_EQ(alone.rbegin()->first, kPause);
  EXPECT_NEAR(alone[1], 3 * (kPositions - ends) / 4, (kPositions - ends) / 8);
  EXPECT_EQ(in_strokes.size(), 2U);
  EXPECT_NEAR(in_strokes[3], 3 * ends / 8, 3 * ends / 32);
  EXPECT_EQ(in_strokes[1] + in_strokes[3], 3 * ends);
}

// Each row of vectors, computed by the real-time side.
TEST(damping_under_conform, vectors_have_the_forces_behind_their_periods) {
  const damping::Parameters p{.rate = 500, .share = 0.25F, .damping = 0.002F, .most = HUGE_VALF, .drag = 0.001F};
  const Json vectors = Json::parse(vectors_of(kWall, 300, 1, {}, p));
  EXPECT_EQ(vectors.at("damping").at("rate_Hz"), 500);
  EXPECT_TRUE(vectors.at("damping").at("most").is_null());
  std::size_t damped = 0, late = 0;
  for (const Json& path : vectors.at("paths")) {
    fast::DampedSession session(properties::subject_of(kWall)->renderer().open(),
                                std::get<fast::Damping>(fast::Damping::build(p)));
    for (const Json& row : path) {
      const auto numbers = [&](const char* key) { return Eigen::Vector3f(numbers_of(row.at(key)).data()); };
      const Eigen::Vector3f position = numbers("position_mm"), force = numbers("force_N");
      EXPECT_FALSE(row.contains("exact_force_N"));
      EXPECT_EQ(session.step_after(row.at("periods"), position).force, force) << row;
      damped += !force.isZero(0) && force.z() != -0.75F * position.z();
      late += row.at("periods") != 1;
    }
  }
  EXPECT_GT(damped, 50U);
  EXPECT_GT(late, 50U);
}

TEST(damping_under_conform, a_declaration_out_of_place_is_refused) {
  const auto refused = [](const Json& damping, const char* key = "damping", const Json& value = nullptr) {
    Json hello = hello_with(damping);
    if (std::string(key) != "damping") hello[key] = value;
    try {
      hello_of(hello, scene_of(kWall));
    } catch (const files::ProcessFailed& failure) {
      return std::string(failure.what());
    }
    return std::string();
  };
  const Json right{{"damping", 0.002}};
  EXPECT_EQ(refused(right), "");
  EXPECT_NE(refused({{"damping", 20}}).find("damping is 20 N·s/mm"), std::string::npos) << refused({{"damping", 20}});
  EXPECT_NE(refused({{"share", 0}}), "");
  EXPECT_NE(refused({{"viscosity", 1}}), "");
  EXPECT_NE(refused(0.002), "");
  EXPECT_NE(refused(right, "rate_Hz", nullptr), "");
  EXPECT_NE(refused(right, "memory", "none"), "");
  EXPECT_NE(refused(right, "answers", "closest point"), "");
}

}  // namespace
}  // namespace forceshade::conformance::damper_test
