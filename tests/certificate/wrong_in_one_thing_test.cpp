// SPDX-License-Identifier: BSD-3-Clause
// A renderer that is wrong in one thing goes the whole way: certify, write, read, beside sweeps, write, read. No device is opened for
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
constexpr Parameters kWithTies{5, 6, 0.5F};  // its axis is 4 mm deep: forces are rational, and ties need the last stage
constexpr std::uint64_t kPoints = 5000;      // two chunks, of 4096 and 904
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

TEST(wrong_in_one_thing, one_stage_of_the_single_call) {
  for (std::size_t stage = 0; stage < kStageNames.size(); ++stage) {
    const Certificate certificate = checked_alone(wrong_law(LawId::cylinder, false, kWithTies, [=](Renderer renderer) {
      return with_wrong_steps(renderer, {2, [stage](std::size_t, const fast::Evaluation& answer) {
                                           return static_cast<std::size_t>(answer.stage) == stage;
                                         }});
    }));
    const SubjectResult& found = certificate.subjects[0];
    EXPECT_GT(found.mismatches, 0U) << kStageNames[stage];
    EXPECT_EQ(found.mismatches, found.points_by_stage.at(std::string(kStageNames[stage])));
    expect_refused(certificate, std::string(kStageNames[stage]));
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

// Each in one case, the first or the last. Passivity also in one loop that belongs to it whatever is drawn.
class WithOneFailure final : public tests::SubjectWrapper {
 public:
  WithOneFailure(std::shared_ptr<const Subject> its, std::string_view property, int at)
      : SubjectWrapper(its), its_(std::move(its)), property_(property), at_(at) {}

  std::vector<Eigen::Vector3f> draw_path(Chooser& choose) const override {
    is_wrong_ = property_ == "equivalence" && drawn_++ >= at_;
    return its_->draw_path(choose);
  }
  const Rendering& rendering() const override {
    rendering_ = its_->rendering();
    if (is_wrong_)
      rendering_.renderer =
          with_wrong_steps(rendering_.renderer, {2, [](std::size_t, const fast::Evaluation&) { return true; }});
    return rendering_;
  }
  Violation check_continuity(Chooser& choose) const override { return of("continuity", its_->check_continuity(choose)); }
  Violation check_unit_normals(Chooser& choose) const override { return of("unit normals", its_->check_unit_normals(choose)); }
  Violation check_passivity(Chooser& choose) const override { return of("passivity", its_->check_passivity(choose)); }
  std::vector<std::function<Violation()>> fixed_loops() const override {
    auto loops = its_->fixed_loops();
    if (property_ == "fixed loop") loops.at(at_ == 0 ? 0 : loops.size() - 1) = [] { return Violation("a loop gives energy"); };
    return loops;
  }

 private:
  Violation of(std::string_view property, Violation right) const {
    if (property_ != property || drawn_++ < at_) return right;
    return Violation("this case fails");
  }

  std::shared_ptr<const Subject> its_;
  std::string property_;
  int at_;
  mutable int drawn_ = 0;
  mutable bool is_wrong_ = false;
  mutable Rendering rendering_;
};

TEST(wrong_in_one_thing, one_property_in_its_first_or_last_case) {
  constexpr int kAll = 20;  // cases; of passivity a tenth
  for (const std::string_view property : {"equivalence", "continuity", "unit normals", "passivity", "fixed loop"})
    for (const bool is_last : {false, true}) {
      const int all = property == "passivity" ? kAll / 10 : kAll;
      const auto right = std::make_shared<LawSubject>(LawId::bump_2p, kBumpOfLaw);
      const Certificate certificate =
          checked_alone(std::make_shared<WithOneFailure>(right, property, is_last ? all - 1 : 0), 100, kAll);
      const SubjectResult& found = certificate.subjects[0];
      const std::string what = std::string(property) + (is_last ? ", last" : ", first");
      EXPECT_EQ(found.mismatches + found.spread.mismatches, 0U) << what;
      const std::string_view failed = property == "fixed loop" ? "passivity" : property;
      for (const PropertyResult& one : found.properties) {
        EXPECT_EQ(one.held, one.name != failed) << what << ": " << one.name;
        EXPECT_EQ(one.counterexample.empty(), one.held) << what << ": " << one.name;
        if (one.name != failed || property == "fixed loop") continue;
        EXPECT_EQ(one.cases, is_last ? static_cast<std::uint64_t>(all) : 1U) << what << ": the case that failed is counted";
      }
      expect_refused(certificate, what);
    }
}

// A renderer without a batch call whose answers change. The words of certify name that.
TEST(wrong_in_one_thing, answers_that_are_random_or_remembered_or_thrown) {
  const RenderedLaw right = std::get<RenderedLaw>(fast_rendering(LawId::bump_2p, kBumpOfLaw));
  const auto words_for = [&](const ForceAt& renderer) {
    RenderedLaw rendered = right;
    rendered.force_at = renderer;
    const Certificate certificate = checked_alone(std::make_shared<LawSubject>(rendered), 1000);
    expect_refused(certificate, "inconsistent");
    return certificate.subjects[0].counterexamples;
  };
  const auto expect_in = [](const std::string& said, const char* words) {
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  const auto random = words_for([&, calls = std::make_shared<int>(0)](const Eigen::Vector3f& position) {
    Rendered answer = right.force_at(position);
    if (++*calls % 7 == 0) answer.force.z() += 1;
    return answer;
  });
  expect_in(random.at(0), "gives two answers for one input");
  const auto thrown_at = words_for([&](const Eigen::Vector3f& position) {
    if (position.x() > 1) throw std::runtime_error("no such place");
    return right.force_at(position);
  });
  EXPECT_EQ(thrown_at.size(), kCounterexamples);
  for (const std::string& words : thrown_at) expect_in(words, " mm the renderer throws: no such place");
  const auto remembering = wrong_law(LawId::bump_2p, false, kBumpOfLaw, [](Renderer renderer) {
    return with_wrong_steps(renderer, {2, [](std::size_t step, const fast::Evaluation&) { return step > 0; }});
  });
  const Certificate certificate = checked_alone(remembering, 1000);
  expect_in(certificate.subjects[0].counterexamples.at(0), "keeps state that its definition does not have");
  expect_refused(certificate, "remembering");

  const auto throwing = wrong_law(LawId::bump_2p, false, kBumpOfLaw, [](Renderer renderer) {
    renderer.batch = [](auto, auto, InstructionSet) -> fast::BatchResult { throw std::runtime_error("no memory"); };
    return renderer;
  });
  const Certificate thrown = checked_alone(throwing, 1000);
  expect_in(thrown.subjects[0].counterexamples.at(0), "the batch call (scalar) of 1000 positions from x = ");
  expect_in(thrown.subjects[0].counterexamples.at(0), " mm on throws: no memory");
  expect_refused(thrown, "a throwing batch call");
}

}  // namespace
}  // namespace forceshade::properties
