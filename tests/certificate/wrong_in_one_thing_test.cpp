// SPDX-License-Identifier: BSD-3-Clause
// A renderer that is wrong in one thing goes the whole way: certify, write, read, merge, write, read. No device is opened for
// it. Each fault is one row of a table.

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <limits>
#include <memory>

#include "certificate/build.h"
#include "forceshade/certify.h"
#include "properties/height_map_subject.h"
#include "properties/law_subject.h"
#include "properties/rendered.h"
#include "rendering/breakdown.h"
#include "tests/properties/subject_wrapper.h"

namespace forceshade::properties {
namespace {

using fast::InstructionSet;

constexpr Parameters kBumpOfLaw{15.24F, 25.4F, 0.5F};
constexpr std::uint64_t kPoints = 5000;  // two chunks, of 4096 and 904
constexpr std::size_t kLastOfChunk = 4095;

// The certificate after it was written, read, given sweeps, written and read.
Certificate after_the_whole_way(const Certificate& certificate) {
  const auto again = [](const Certificate& one) { return from_json(to_json(one), "here.json"); };
  Sweeps sweeps = planned({{LawId::wall}, kBumpOfLaw, {15.24F}, false, true, false});
  sweeps.next = sweeps.end;
  Certificate both = again(certificate);
  both.sweeps = sweeps;
  return again(both);
}

Certificate checked_alone(const std::shared_ptr<const Subject>& subject, std::uint64_t points = kPoints, int cases = 10) {
  static const std::atomic<bool> never{false};
  return certify(
             {.subjects = {subject}, .points = points, .cases = cases, .seed = 3, .threads = 1},
             [](std::string_view, double) {}, never)
      .value();
}

void expect_refused(const Certificate& certificate, const std::string& what) {
  const Certificate end = after_the_whole_way(certificate);
  const Identity& identity = certificate.subjects.at(0).identity;
  EXPECT_FALSE(end.held()) << what;
  EXPECT_EQ(refusal(end, current_build(), identity),
            "the certificate says that a program's own renderer of " + identity.name + " failed")
      << what;
}

float with_last_bit_flipped(float value) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1U);
}

// A single call that is wrong in one component, or in the status, where `where` says so of the step's number and answer.
struct WrongStep {
  int component = 0;  // 3: the status
  std::function<bool(std::size_t step, const fast::Evaluation& answer)> where;
};

Renderer with_wrong_steps(Renderer renderer, const WrongStep& wrong) {
  struct Session final : fast::Session {
    Session(std::unique_ptr<fast::Session> its, WrongStep what) : right(std::move(its)), wrong(std::move(what)) {}
    fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
      fast::Evaluation answer = right->step(position);
      if (!wrong.where(steps++, answer)) return answer;
      if (wrong.component < 3)
        answer.force[wrong.component] = with_last_bit_flipped(answer.force[wrong.component]);
      else
        answer.status = answer.status == Status::free ? Status::contact : Status::free;
      return answer;
    }
    std::unique_ptr<fast::Session> right;
    WrongStep wrong;
    std::size_t steps = 0;
  };
  renderer.open = [open = renderer.open, wrong] { return std::make_unique<Session>(open(), wrong); };
  return renderer;
}

// A batch call of more than one position that is wrong at one of them, in one set.
struct WrongBatch {
  InstructionSet set;
  Eigen::Index component;
  std::size_t at;
};

Renderer with_a_wrong_batch(Renderer renderer, const WrongBatch& wrong) {
  renderer.batch = [right = renderer.batch, wrong](auto positions, auto forces, InstructionSet set) {
    const fast::BatchResult result = right(positions, forces, set);
    if (set == wrong.set && wrong.at < positions.size() && positions.size() > 1)
      forces[wrong.at][wrong.component] = with_last_bit_flipped(forces[wrong.at][wrong.component]);
    return result;
  };
  return renderer;
}

// A law that is wrong with the given parameters alone, or in the spread alone.
std::shared_ptr<const Subject> wrong_law(LawId law, bool in_spread, const Parameters& given,
                                         const std::function<Renderer(Renderer)>& change) {
  return std::make_shared<LawSubject>(law, given, [=](LawId id, const Parameters& p) {
    const bool is_given = p == given;
    return is_given == in_spread ? fast_law(id, p) : change(fast_law(id, p));
  });
}

std::shared_ptr<const Subject> wrong_map(const std::function<Renderer(Renderer)>& change) {
  return std::make_shared<HeightMapSubject>(
      "map.toml", HeightMap{{{height::Plane{0.25F, 0.125F, 1}}}}, height::Mode::true_height, 0.5F,
      [=](const HeightMap& map, height::Mode mode, float stiffness) { return change(fast_height_map(map, mode, stiffness)); });
}

TEST(wrong_in_one_thing, a_right_renderer_is_refused_for_its_few_points_alone) {
  const Certificate certificate = checked_alone(std::make_shared<LawSubject>(LawId::bump_2p, kBumpOfLaw));
  const Certificate end = after_the_whole_way(certificate);
  EXPECT_TRUE(end.held());
  EXPECT_EQ(refusal(end, current_build(), certificate.subjects[0].identity),
            "the certificate has 5000 points for bump-2p; driving needs at least 1000000");
}

// At the first and at the last position of a chunk; with the given parameters and in the spread, whose chunks are shorter.
TEST(wrong_in_one_thing, a_component_or_the_status_of_the_single_call) {
  for (const int component : {0, 1, 2, 3})
    for (const bool in_spread : {false, true})
      for (const std::size_t at : {std::size_t{0}, in_spread ? std::size_t{1023} : kLastOfChunk}) {
        const Certificate certificate = checked_alone(wrong_law(LawId::bump_2p, in_spread, kBumpOfLaw, [=](Renderer renderer) {
          return with_wrong_steps(renderer,
                                  {component, [at](std::size_t step, const fast::Evaluation&) { return step == at; }});
        }));
        const std::string what = "component " + std::to_string(component) + " at " + std::to_string(at);
        const SubjectResult& found = certificate.subjects[0];
        EXPECT_EQ(found.mismatches, in_spread ? 0U : at == 0 ? 2U : 1U) << what;
        EXPECT_EQ(found.spread.mismatches, !in_spread ? 0U : at == 0 ? 2U : 1U) << what;
        EXPECT_EQ(found.has_held("equivalence"), in_spread || at > 0) << what;
        expect_refused(certificate, what);
      }
}

TEST(wrong_in_one_thing, a_component_of_one_set_s_batch_call) {
  for (const InstructionSet set : fast::kInstructionSets) {
    if (!fast::is_available(set)) continue;
    for (const Eigen::Index component : {0, 1, 2})
      for (const std::size_t at : {std::size_t{0}, kLastOfChunk}) {
        const WrongBatch wrong{set, component, at};
        const auto change = [wrong](Renderer renderer) { return with_a_wrong_batch(std::move(renderer), wrong); };
        for (const auto& subject : {wrong_law(LawId::bump_2p, false, kBumpOfLaw, change), wrong_map(change)}) {
          const Certificate certificate = checked_alone(subject, kPoints, 1);
          const std::string what = subject->identity().name + ", " + std::string(name_of(set)) + ", component " +
                                   std::to_string(component) + " at " + std::to_string(at);
          const SubjectResult& found = certificate.subjects[0];
          EXPECT_EQ(found.mismatches, at == 0 ? 2U : 1U) << what;
          EXPECT_EQ(found.spread.mismatches > 0, at == 0 && found.identity.kind != "law") << what;
          const std::string words = "the batch call (" + std::string(name_of(set)) + "): at ";
          EXPECT_NE(found.counterexamples.at(0).find(words), std::string::npos) << found.counterexamples.at(0);
          expect_refused(certificate, what);
        }
      }
  }
}

// One too many or too few, of one set.
TEST(wrong_in_one_thing, the_number_of_invalid_positions_of_one_set_s_batch_call) {
  for (const InstructionSet wrong : fast::kInstructionSets) {
    if (!fast::is_available(wrong)) continue;
    for (const bool too_many : {false, true}) {
      const Certificate certificate = checked_alone(
          wrong_law(LawId::bump_2p, false, kBumpOfLaw,
                    [=](Renderer renderer) {
                      renderer.batch = [=, right = renderer.batch](auto positions, auto forces, InstructionSet set) {
                        fast::BatchResult result = right(positions, forces, set);
                        if (set == wrong) result.invalid += too_many ? 1 : -1;
                        return result;
                      };
                      return renderer;
                    }),
          kPoints, 1);
      EXPECT_EQ(certificate.subjects[0].mismatches, 2U) << "one for each chunk";
      const std::string said = certificate.subjects[0].counterexamples.at(0);
      EXPECT_NE(said.find("invalid positions of 4096; expected "), std::string::npos) << said;
      expect_refused(certificate, std::string(name_of(wrong)) + (too_many ? ", too many" : ", too few"));
    }
  }
}

// A renderer that writes no answer leaves there the answer of the call before.
TEST(wrong_in_one_thing, a_single_call_of_one_set_that_does_not_write_an_answer_again) {
  std::vector<float> values(16, 0.5F);
  const HeightMap flat{{{std::make_shared<const height::Grid>(
      height::Grid{4, 4, 0.5F, height::Edge::tile, height::Interpolant::cubic_spline, std::move(values)})}}};
  const auto lazy = [](const HeightMap& map, height::Mode mode, float stiffness) {
    Renderer renderer = fast_height_map(map, mode, stiffness);
    renderer.batch = [right = renderer.batch, last = Eigen::Vector3f(-1, 0, 0)](auto positions, auto forces,
                                                                                InstructionSet set) mutable {
      if (positions.size() > 1) return right(positions, forces, set);
      Eigen::Vector3f answer;
      const fast::BatchResult result = right(positions, std::span(&answer, 1), set);
      if (answer != last) forces[0] = last = answer;
      return result;
    };
    return renderer;
  };
  const Certificate certificate =
      checked_alone(std::make_shared<HeightMapSubject>("flat.toml", flat, height::Mode::true_height, 0.5F, lazy), 400, 1);
  EXPECT_GT(certificate.subjects[0].mismatches, 40U);
  expect_refused(certificate, "unwritten");
}

// inconsistent_renderer_test has the words for answers of single calls that change.
TEST(wrong_in_one_thing, a_batch_call_that_throws) {
  const auto throwing = wrong_law(LawId::bump_2p, false, kBumpOfLaw, [](Renderer renderer) {
    renderer.batch = [](auto, auto, InstructionSet) -> fast::BatchResult { throw std::runtime_error("no memory"); };
    return renderer;
  });
  const Certificate thrown = checked_alone(throwing, 1000);
  const std::string said = thrown.subjects[0].counterexamples.at(0);
  EXPECT_NE(said.find("the batch call (scalar) of 1000 positions from x = "), std::string::npos) << said;
  EXPECT_NE(said.find(" mm on throws: no memory"), std::string::npos) << said;
  expect_refused(thrown, "a throwing batch call");
}

}  // namespace
}  // namespace forceshade::properties
