// SPDX-License-Identifier: BSD-3-Clause
// certify finds a renderer that is wrong in one of its calls, and no two of its runs differ: renderers that are wrong in one
// way each, in place of the fast path.

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cfenv>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "certificate/compare.h"
#include "certificate/in_parallel.h"
#include "forceshade/certify.h"
#include "forceshade/properties.h"
#include "properties/height_map_subject.h"
#include "properties/law_subject.h"
#include "properties/spread.h"
#include "reference/numbers/ball64.h"
#include "tests/properties/subject_wrapper.h"

namespace forceshade::properties {
namespace {

using fast::InstructionSet;

constexpr Parameters kThesisBump{15.24F, 25.4F, 0.5F};

// Makes the compared subject anew, with a test's change to its calls.
using Change = std::function<Renderer(Renderer)>;
using Subjects = std::function<std::shared_ptr<const Subject>(const Change&)>;

Subjects law_of(LawId id) {
  return [id](const Change& change) {
    return std::make_shared<LawSubject>(id, kThesisBump,
                                        [change](LawId law, const Parameters& p) { return change(fast_law(law, p)); });
  };
}

Subjects map_of(const HeightMap& map) {
  return [map](const Change& change) {
    return std::make_shared<HeightMapSubject>("map.toml", map, height::Mode::true_height, kThesisBump.stiffness,
                                              [change](const HeightMap& its, height::Mode mode, float stiffness) {
                                                return change(fast_height_map(its, mode, stiffness));
                                              });
  };
}

const Change kAsItIs = [](Renderer renderer) { return renderer; };

CertifyOptions small(const Subjects& subjects, const Change& change = kAsItIs) {
  return {.subjects = {subjects(change)}, .points = 9000, .cases = 20, .seed = 3, .threads = 2};
}

Certificate certified(const CertifyOptions& options) {
  static const std::atomic<bool> never{false};
  return certify(
             options, [](std::string_view, double) {}, never)
      .value();
}

HeightMap slope() {
  return {{{height::Plane{0.25F, 0.125F, 1}}}};
}

// One B-spline: the map whose single call has code of its own in each set.
HeightMap spline() {
  std::vector<float> values(16);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.1F * static_cast<float>(i * i % 7);
  return {{{std::make_shared<const height::Grid>(
      height::Grid{4, 4, 0.5F, height::Edge::tile, height::Interpolant::cubic_spline, std::move(values)})}}};
}

const Findings& only(const Certificate& certificate) {
  return certificate.subjects.at(0);
}

std::vector<InstructionSet> available() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : fast::kInstructionSets)
    if (fast::is_available(set)) sets.push_back(set);
  return sets;
}

float flipped(float value) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1U);
}

TEST(comparison, says_which_sets_of_code_were_compared) {
  for (const Subjects& subjects : {law_of(LawId::bump_2p), map_of(slope())}) {
    const Certificate certificate = certified(small(subjects));
    const Findings& found = only(certificate);
    EXPECT_TRUE(found.held());
    EXPECT_EQ(found.points_by_instruction_set.size(), available().size());
    for (const InstructionSet set : available()) {
      EXPECT_TRUE(found.covers(std::string(name_of(set))));
      EXPECT_TRUE(found.spread.covers(std::string(name_of(set))));
    }
    EXPECT_FALSE(found.covers("mmx"));
  }
}

TEST(comparison, finds_a_single_call_that_is_wrong_in_one_set) {
  for (const InstructionSet wrong : available()) {
    CertifyOptions options = small(map_of(spline()), [=](Renderer renderer) {
      renderer.batch = [=, right = renderer.batch](auto positions, auto forces, InstructionSet set) {
        const fast::BatchResult result = right(positions, forces, set);
        if (set == wrong && positions.size() == 1) forces[0].z() = flipped(forces[0].z());
        return result;
      };
      return renderer;
    });
    options.points = 300;
    options.cases = 1;
    const Certificate certificate = certified(options);
    EXPECT_EQ(only(certificate).mismatches, 300U);
    EXPECT_NE(only(certificate).counterexamples.at(0).find("the single call (" + std::string(name_of(wrong)) + "): at "),
              std::string::npos);
  }
}

TEST(comparison, takes_the_bits_of_another_set_for_right_and_finds_what_a_batch_call_does_not_write) {
  const auto certified_with = [](std::size_t left_out, bool is_scalar) {
    return certified(small(law_of(LawId::wall), [=](Renderer renderer) {
      renderer.batch = [=, right = renderer.batch](auto positions, auto forces, InstructionSet set) {
        const std::size_t written = positions.size() - left_out;
        return right(positions.first(written), forces.first(written), is_scalar ? InstructionSet::scalar : set);
      };
      return renderer;
    }));
  };
  EXPECT_TRUE(certified_with(0, true).held());
  EXPECT_GE(only(certified_with(1, false)).mismatches, 3U) << "the last of each chunk";
}

// With the stiffness asked for, 1/2, every product is exact: only the spread rounds.
TEST(comparison, finds_by_default_that_a_wall_truncates_instead_of_rounding) {
  for (const LawId law : {LawId::wall, LawId::bump_1p}) {
    CertifyOptions options;
    options.seed = 1;
    options.threads = 2;
    options.points /= 20;  // of the default a twentieth is enough, and quicker
    options.cases = 20;
    const RenderLaw truncating = [](LawId id, const Parameters& p) {
      const fast::Law right = std::get<fast::Law>(fast::Law::build(id, p));
      const auto truncated = [right, K = static_cast<double>(p.stiffness)](const Eigen::Vector3f& position) {
        fast::Evaluation answer = right.evaluate(position);
        const double exact = K * -static_cast<double>(position.z());
        if (answer.status == Status::contact && static_cast<double>(answer.force.z()) > exact)
          answer.force.z() = std::nextafter(answer.force.z(), 0.0F);
        return answer;
      };
      return Renderer{[truncated] { return answering(truncated); },
                      [truncated](auto positions, auto forces, InstructionSet) {
                        fast::BatchResult result;
                        for (std::size_t i = 0; i < positions.size(); ++i) {
                          const fast::Evaluation answer = truncated(positions[i]);
                          forces[i] = answer.force;
                          result.invalid += answer.status == Status::invalid;
                        }
                        return result;
                      }};
    };
    options.subjects = {std::make_shared<LawSubject>(law, kThesisBump, truncating)};
    const Certificate certificate = certified(options);
    const Findings& found = only(certificate);
    EXPECT_LT(found.mismatches, found.points / 100) << "subnormal forces alone";
    EXPECT_GT(found.spread.mismatches, found.spread.points / 10);
    EXPECT_FALSE(certificate.held());
    EXPECT_NE(found.spread.counterexamples.at(0).find("K = 0x"), std::string::npos) << found.spread.counterexamples.at(0);
  }
}

class Undecided final : public tests::SubjectWrapper {
 public:
  using SubjectWrapper::SubjectWrapper;
  std::unique_ptr<ReferenceSession> open_reference() const override {
    struct Session final : ReferenceSession {
      reference::Rounded step(const Eigen::Vector3f&) override { throw std::domain_error("3072 bits are too few"); }
    };
    return std::make_unique<Session>();
  }
};

TEST(comparison, counts_what_the_reference_does_not_decide_as_a_mismatch) {
  const Undecided undecided(std::make_shared<LawSubject>(LawId::wall, kThesisBump));
  Tally tally;
  compare_chunk(undecided, 1, 5, 0, "", tally);
  const Comparison found = tally.comparison();
  EXPECT_EQ(found.points, 5U);
  EXPECT_EQ(found.mismatches, 5U);
  EXPECT_NE(found.counterexamples.at(0).find("the reference does not decide: 3072 bits are too few"), std::string::npos);
  for (const auto& counts : {found.points_by_aim, found.points_by_stage, found.points_by_method, found.points_by_status}) {
    std::uint64_t sum = 0;
    for (const auto& [name, count] : counts) sum += count;
    EXPECT_EQ(sum, 5U);
  }
  const std::vector<PropertyResult> properties = run_properties(undecided, 20, 1);
  EXPECT_FALSE(properties.at(0).held);
  EXPECT_NE(properties.at(0).counterexample.find("the reference does not decide"), std::string::npos);
}

// The first ten in the order of the chunks, and the smaller position of two equal calls.
TEST(tally, does_not_depend_on_the_order_of_threads) {
  Tally early, late;
  for (int i = 0; i < 8; ++i) late.mismatch(7, "late " + std::to_string(i));
  for (int i = 0; i < 8; ++i) early.mismatch(2, "early " + std::to_string(i));
  late.call({3, 0, 0, 0.25});
  early.call({2, 0, 0, 0.25});
  Tally one, two;
  one.add(early);
  one.add(late);
  two.add(late);
  two.add(early);
  EXPECT_EQ(one.comparison().counterexamples, two.comparison().counterexamples);
  EXPECT_EQ(one.comparison().counterexamples.size(), kCounterexamples);
  EXPECT_EQ(one.comparison().counterexamples.front(), "early 0");
  EXPECT_EQ(one.comparison().mismatches, 16U);
  EXPECT_EQ(one.closest_call.x, 2);
  EXPECT_EQ(two.closest_call.x, 2);
}

// With any number of threads, of which another one than the caller's may be the one that throws.
TEST(in_parallel, rethrows_what_a_chunk_threw) {
  const std::atomic<bool> never_stop = false;
  for (const unsigned threads : {1U, 3U})
    for (const std::uint64_t bad : {0U, 7U})
      EXPECT_THROW(in_parallel(
                       8, threads, [](double) {}, never_stop,
                       [&](std::uint64_t chunk, Tally&) {
                         if (chunk == bad) throw std::runtime_error("chunk");
                       }),
                   std::runtime_error);
}

TEST(spread, draws_from_all_of_the_domain_and_nothing_outside) {
  ParameterSource source(5);
  int full = 0, few = 0, fitting = 0, ends = 0, half_cylinders = 0, rational = 0;
  const int kDraws = 4000;
  float lowest = 1e3F, highest = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Parameters p = source.next();
    for (const LawName& law : kLaws) {
      const auto built = fast::Law::build(law.id, p);
      EXPECT_TRUE(std::holds_alternative<fast::Law>(built)) << law.name;
    }
    const std::uint32_t significand = std::bit_cast<std::uint32_t>(p.stiffness) & 0x7FFFFFU;
    full += (significand & 1U) != 0;
    few += (significand & 0x3FFFFU) == 0;
    fitting += p.width > p.radius;
    ends += p.radius == 0.1F || p.radius == 1e4F || p.stiffness == 1e-3F || p.stiffness == 1e3F || p.width == 1e-3F ||
            p.width == 2 * p.radius;
    half_cylinders += p.width == 2 * p.radius;
    const double depth = std::sqrt(static_cast<double>(p.radius) * static_cast<double>(p.radius) -
                                   static_cast<double>(p.width) * static_cast<double>(p.width) / 4);
    rational += depth > 0 && static_cast<double>(static_cast<float>(std::ldexp(std::round(std::ldexp(depth, 5)), -5))) == depth;
    lowest = std::min(lowest, p.stiffness);
    highest = std::max(highest, p.stiffness);
  }
  EXPECT_GT(full, kDraws / 4) << "odd significands of 24 bits";
  EXPECT_GT(few, kDraws / 10);
  EXPECT_GT(rational, kDraws / 10);
  EXPECT_GT(fitting, 50) << "wide bumps";
  EXPECT_GT(ends, kDraws / 16);
  EXPECT_GT(half_cylinders, kDraws / 100);
  EXPECT_EQ(lowest, 1e-3F);
  EXPECT_EQ(highest, 1e3F);
}

}  // namespace
}  // namespace forceshade::properties
