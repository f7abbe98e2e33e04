// SPDX-License-Identifier: BSD-3-Clause
// Both experiments from the first screen to the last in a real window, by the keys and the mouse of a display in memory: a
// session of study/experiments/ without a device.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "screenshots.h"
#include "short_protocols.h"
#include "study/experiments/session.h"
#include "study/window/layout.h"
#include "study/window/view.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::window {
namespace {

using experiments::Event;
using experiments::EventKind;
using experiments::Protocol;
using experiments::Screen;
using experiments::ScreenKind;
using experiments::Session;

const char* kind_name(ScreenKind kind) {
  switch (kind) {
    case ScreenKind::text: return "text";
    case ScreenKind::matching: return "matching";
    case ScreenKind::satisfaction: return "satisfaction";
    case ScreenKind::classification: return "classification";
    case ScreenKind::question: return "question";
    case ScreenKind::end: return "end";
  }
  return "unknown";
}

// What a participant does on each kind of screen, and how many presses come of it.
struct Habit {
  const char* keys;
  int presses;
};
const std::map<ScreenKind, Habit> kHabits{{ScreenKind::text, {"key Return", 1}},
                                          {ScreenKind::matching, {"key --delay 20 j j k k k l", 6}},
                                          {ScreenKind::satisfaction, {"key --delay 20 9 BackSpace 8 Return", 4}},
                                          {ScreenKind::classification, {"key --delay 20 3 KP_Enter", 2}},
                                          {ScreenKind::question, {"key --delay 20 o k Return", 3}}};

// The hand is where the mouse is; it feels the nominal plane of bump-1p-shaded, or nothing that anybody looks at.
class Participant {
 public:
  Participant(const std::string& name, const std::string& text) : name_(name) {
    protocol_ = experiments::read_protocol(written_protocol(folder_, text));
    const experiments::Language language = experiments::read_language(protocol_.language);
    window_.emplace(Settings{}, language.labels);
    session_.emplace(
        protocol_, language, 1, [this](const Event& event) { events_.push_back(event); }, std::span<const Event>{},
        key_names(Settings{}.keys));
  }

  void take_part() {
    for (int screens = 0; screens < 100 && !session_->is_over(); ++screens) {
      const Screen screen = session_->screen();
      if (screen.kind == ScreenKind::matching) touch_right_bump(screen.shows_scene);
      const Habit& habit = kHabits.at(screen.kind);
      frame();
      picture(std::string(kind_name(screen.kind)) +
              (screen.kind == ScreenKind::matching && !screen.shows_scene ? "-without-vision" : ""));
      const auto hand = by_hand(habit.keys);
      int presses = 0;
      while (presses < habit.presses) presses += frame();
      ASSERT_EQ(presses, habit.presses) << kind_name(screen.kind);
    }
    frame();
    picture("end");
    EXPECT_TRUE(session_->is_over());
  }

  const std::vector<Event>& events() const { return events_; }
  const std::set<std::string>& pictures() const { return pictures_; }
  const Protocol& protocol() const { return protocol_; }

 private:
  Scene scene() const {
    return {.tip = window_->mouse(),
            .separation = experiments::kMillimetresPerMil * protocol_.spacing,
            .width = experiments::kMillimetresPerMil * protocol_.width};
  }

  int frame() {
    EXPECT_TRUE(window_->draw(session_->screen(), scene()));
    time_ += 1.0 / 60;
    int presses = 0;
    for (const experiments::Press& press : window_->presses()) {
      session_->press(press, time_);
      ++presses;
    }
    return presses;
  }

  void picture(const std::string& screen) {
    const std::string name = "session-" + name_ + '-' + screen;
    if (pictures_.insert(name).second) save(window_->pixels(), name);
  }

  // 4 mm into the flat bump that is felt: the cursor rests on the round one that is drawn.
  void touch_right_bump(bool shows_scene) {
    const Position aim{experiments::kMillimetresPerMil * protocol_.spacing / 2, 0, -4};
    const View view(scene(), Size{1280, 800});
    const Point at = view.pixel(aim);
    // The window stands in the middle of the display, 1600 x 1000.
    const auto moved =
        by_hand("mousemove " + std::to_string(160 + std::lround(at.x)) + ' ' + std::to_string(100 + std::lround(at.y)));
    const auto is_there = [&] {
      const auto tip = window_->mouse();
      return tip && std::fabs(tip->x - aim.x) < 0.2 && std::fabs(tip->z - aim.z) < 0.2;
    };
    while (!is_there()) frame();
    frame();
    if (!shows_scene) return;
    const Point expected = view.pixel({aim.x, 0, drawn_height(scene(), aim.x)});
    const Image image = window_->pixels();
    const auto* pixel = image.at(static_cast<int>(expected.x), static_cast<int>(expected.y - 1.3 * view.pixels_per_mm()));
    EXPECT_EQ(pixel[0], std::lround(255 * kCursor.red)) << "the cursor is not on the drawn bump";
  }

  const std::string name_;
  const tests::TemporaryDirectory folder_;
  Protocol protocol_;
  std::optional<Window> window_;
  std::optional<Session> session_;
  std::vector<Event> events_;
  std::set<std::string> pictures_;
  double time_ = 0;
};

std::vector<Event> of_kind(const std::vector<Event>& events, EventKind kind) {
  std::vector<Event> found;
  for (const Event& event : events)
    if (event.kind == kind) found.push_back(event);
  return found;
}

class window_session : public testing::Test {
 protected:
  void SetUp() override {
    if (!Window::is_available()) GTEST_SKIP() << "this build has no window";
  }
};

TEST_F(window_session, the_matching_experiment_goes_from_its_instructions_to_its_end) {
  Participant participant("matching", short_matching("german", 1));
  ASSERT_NO_FATAL_FAILURE(participant.take_part());
  const auto& events = participant.events();
  const std::size_t trials = 1 + static_cast<std::size_t>(participant.protocol().trials());
  const auto started = of_kind(events, EventKind::trial_started), done = of_kind(events, EventKind::match_done),
             answers = of_kind(events, EventKind::answered);
  EXPECT_EQ(started.size(), trials);
  EXPECT_EQ(of_kind(events, EventKind::radius_changed).size(), 5 * trials);
  ASSERT_EQ(done.size(), started.size());
  ASSERT_EQ(answers.size(), started.size());
  for (std::size_t i = 0; i < started.size(); ++i) {
    // Two steps smaller and three bigger: bigger is higher, so the radius is one step less.
    EXPECT_EQ(done[i].radius, started[i].trial.initial_radius - 20);
    EXPECT_EQ(answers[i].answer, 8);
  }
  for (const Event& event : of_kind(events, EventKind::question_answered)) EXPECT_EQ(event.text, "ok");
  EXPECT_EQ(of_kind(events, EventKind::question_answered).size(), 5U);
  EXPECT_EQ(participant.pictures().size(), 6U);  // each kind of screen, and one without vision
}

TEST_F(window_session, the_classification_experiment_goes_from_its_instructions_to_its_end) {
  Participant participant("classification", short_classification("english", 0, 0));
  ASSERT_NO_FATAL_FAILURE(participant.take_part());
  const auto answers = of_kind(participant.events(), EventKind::answered);
  EXPECT_EQ(answers.size(), 4U);
  for (const Event& event : answers) EXPECT_EQ(event.answer, 3);
}

}  // namespace
}  // namespace forceshade::window
