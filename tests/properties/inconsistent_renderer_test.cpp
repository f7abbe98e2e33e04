// SPDX-License-Identifier: BSD-3-Clause
// A renderer whose answers are not for good gets a verdict in words: the input, the two answers, and after what.

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/properties.h"
#include "properties/law_subject.h"
#include "properties/second_answer.h"
#include "tests/properties/subject_wrapper.h"

namespace forceshade::properties {
namespace {

constexpr Parameters kParameters{15.24F, 25.4F, 0.5F};

// A field's renderer as a stranger writes it: a function of the position, which may keep what it likes.
LawSubject field_of(const std::function<Rendered(const Eigen::Vector3f&, const Rendered& right)>& change) {
  RenderedLaw law = std::get<RenderedLaw>(fast_rendering(LawId::wall, kParameters));
  law.force_at = [right = law.force_at, change](const Eigen::Vector3f& position) { return change(position, right(position)); };
  return LawSubject(law);
}

// A renderer with sessions, each of which answers the n-th step, from 0 on, as `change` says.
LawSubject sessions_of(const std::function<void(int step, fast::Evaluation& answer)>& change) {
  return LawSubject(LawId::wall, kParameters, [change](LawId law, const Parameters& p) {
    Renderer renderer = fast_law(law, p);
    renderer.open = [open = renderer.open, change] {
      return answering([right = std::shared_ptr<fast::Session>(open()), change,
                        step = std::make_shared<int>(0)](const Eigen::Vector3f& position) {
        fast::Evaluation answer = right->step(position);
        change((*step)++, answer);
        return answer;
      });
    };
    return renderer;
  });
}

PropertyResult equivalence_of(const Subject& subject, int cases = 300) {
  return run_properties(subject, cases, 5).at(0);
}

void expect_words(const PropertyResult& result, const std::vector<std::string>& all) {
  EXPECT_FALSE(result.held);
  for (const std::string& words : all)
    EXPECT_NE(result.counterexample.find(words), std::string::npos)
        << "expected: " << words << "; got: " << result.counterexample;
  EXPECT_EQ(result.counterexample.find("no exceptions thrown"), std::string::npos) << result.counterexample;
}

// Wrong in one answer of so many, whatever the input. The rarest is wrong so seldom that shrinking does not meet it again.
TEST(inconsistent_renderer, that_is_random_gives_two_answers_for_one_input) {
  for (const int one_of : {2, 10, 1000}) {
    const PropertyResult result =
        equivalence_of(field_of([one_of, calls = std::make_shared<int>(0)](const Eigen::Vector3f&, Rendered answer) {
                         if (++*calls % one_of == 0) answer.force.z() = 123;
                         return answer;
                       }),
                       2000);
    expect_words(result, {"at x = ", " mm the renderer gives two answers for one input, ", ": first x = ", "(123) N (",
                          "), then x = ", "; it is random, or its sessions share state"});
    EXPECT_TRUE(result.counterexample.ends_with("share state")) << result.counterexample;
  }
}

TEST(inconsistent_renderer, that_goes_wrong_for_good_after_some_time_gives_two_answers) {
  expect_words(equivalence_of(field_of([calls = std::make_shared<int>(0)](const Eigen::Vector3f&, Rendered answer) {
                 if (++*calls > 100) answer.force.z() = 123;
                 return answer;
               })),
               {"the renderer gives two answers for one input", "then ", "(123)"});
}

TEST(inconsistent_renderer, that_remembers_is_told_from_one_that_is_wrong) {
  const auto expected = {"at x = ",
                         "the renderer gives two answers: ",
                         "0x1.ecp+6 (123)",
                         " N (",
                         ") after x = ",
                         " mm, and ",
                         "as the first position of a session",
                         "keeps state that its definition does not have"};
  expect_words(equivalence_of(sessions_of([](int step, fast::Evaluation& answer) {
                 if (step > 0) answer.force.z() = 123;
               })),
               {expected.begin(), expected.end()});
  const PropertyResult wrong = equivalence_of(sessions_of([](int, fast::Evaluation& answer) { answer.force.z() = 123; }));
  expect_words(wrong, {"expected the force"});
  EXPECT_EQ(wrong.counterexample.find("two answers"), std::string::npos) << wrong.counterexample;
}

// One position before is enough to have the answer again, or the whole path is needed.
TEST(inconsistent_renderer, that_remembers_is_quoted_with_as_much_of_its_path_as_it_takes) {
  const std::vector<Eigen::Vector3f> path{{0, 0, 1}, {1, 0, -1}, {2, 0, -1}, {3, 0, -1}};
  for (const int remembered : {1, 3}) {
    const LawSubject subject = sessions_of([remembered](int step, fast::Evaluation& answer) {
      if (step >= remembered) answer.force.z() = 123;
    });
    const reference::Rounded exact = subject.open_reference()->step(path.back());
    const Violation words = undeclared_memory(subject, path, {{0, 0, 123}, Status::contact}, exact);
    ASSERT_TRUE(words);
    EXPECT_EQ(words->find("after 3 positions, the last ") != std::string::npos, remembered == 3) << *words;
  }
}

TEST(inconsistent_renderer, that_throws_is_quoted_with_the_position) {
  const auto throws = [](const std::function<void()>& what) {
    return field_of([what](const Eigen::Vector3f& position, const Rendered& answer) {
      if (position.z() < -1) what();
      return answer;
    });
  };
  for (const PropertyResult& result : run_properties(throws([] { throw std::runtime_error("no such place"); }), 300, 5)) {
    if (result.name == "continuity" || result.name == "equivalence")
      expect_words(result, {"at x = ", " mm the renderer throws: no such place"});
    EXPECT_FALSE(result.held) << result.name;
  }
  expect_words(equivalence_of(throws([] { throw 7; })), {"the renderer throws: something that is no std::exception"});
}

TEST(inconsistent_renderer, that_opens_no_session_is_quoted) {
  const LawSubject subject(LawId::wall, kParameters, [](LawId law, const Parameters& p) {
    Renderer renderer = fast_law(law, p);
    renderer.open = [open = renderer.open, count = std::make_shared<int>(0)] {
      if (++*count > 1) throw std::runtime_error("no more sessions");
      return open();
    };
    return renderer;
  });
  expect_words(equivalence_of(subject), {"an exception is thrown: no more sessions"});
}

// Nothing is known of a property of one's own but that its case failed and then held.
TEST(inconsistent_renderer, a_property_that_fails_once_keeps_the_words_of_its_failure) {
  int calls = 0;
  const PropertyResult once = run_property(
      "mine", 100, 1, [&](Chooser&) -> Violation { return ++calls == 50 ? Violation("the wall is soft") : std::nullopt; });
  EXPECT_EQ(once.cases, 50U);
  expect_words(once, {"the wall is soft; the same case held when it was tried again"});
  const auto always = [](const Property& property) { return run_property("mine", 100, 1, property); };
  EXPECT_EQ(always([](Chooser&) -> Violation { return "the wall is soft"; }).counterexample, "the wall is soft");
  EXPECT_EQ(always([](Chooser&) -> Violation { throw std::runtime_error("lost"); }).counterexample,
            "an exception is thrown: lost");
}

class WithLoops final : public tests::SubjectWrapper {
 public:
  WithLoops(std::shared_ptr<const Subject> its, std::vector<std::function<Violation()>> loops)
      : SubjectWrapper(std::move(its)), loops_(std::move(loops)) {}
  std::vector<std::function<Violation()>> fixed_loops() const override { return loops_; }

 private:
  std::vector<std::function<Violation()>> loops_;
};

TEST(inconsistent_renderer, that_throws_in_a_fixed_loop_fails_passivity) {
  const auto wall = std::make_shared<LawSubject>(LawId::wall, kParameters);
  const WithLoops subject(wall, {[]() -> Violation { throw std::runtime_error("too deep"); }});
  for (const PropertyResult& result : run_properties(subject, 20, 5)) {
    EXPECT_EQ(result.held, result.name != "passivity") << result.name;
    EXPECT_EQ(result.counterexample, result.held ? "" : "an exception is thrown: too deep");
  }
}

// A fixed loop is a case of its own, and the first that fails is the last that is tried.
TEST(inconsistent_renderer, passivity_counts_its_fixed_loops_up_to_the_first_that_fails) {
  const auto wall = std::make_shared<LawSubject>(LawId::wall, kParameters);
  std::uint64_t drawn = 0;
  for (const PropertyResult& result : run_properties(WithLoops(wall, {}), 20, 5))
    if (result.name == "passivity") drawn = result.cases;
  const auto loop = [](Violation violation) { return [violation] { return violation; }; };
  const auto passivity_of = [&](std::vector<std::function<Violation()>> loops) {
    for (PropertyResult& result : run_properties(WithLoops(wall, std::move(loops)), 20, 5))
      if (result.name == "passivity") return std::move(result);
    return PropertyResult{};
  };
  const PropertyResult held = passivity_of({loop(std::nullopt), loop(std::nullopt)});
  EXPECT_TRUE(held.held);
  EXPECT_EQ(held.cases, drawn + 2);
  const PropertyResult failed = passivity_of({loop(std::nullopt), loop("the first"), loop("the second")});
  EXPECT_FALSE(failed.held);
  EXPECT_EQ(failed.cases, drawn + 2);
  EXPECT_EQ(failed.counterexample, "the first");
}

}  // namespace
}  // namespace forceshade::properties
