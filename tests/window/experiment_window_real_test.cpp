// SPDX-License-Identifier: BSD-3-Clause
// forceshade experiment run in its real window: the command, the servo loop with a simulated PHANToM in a hand that the mouse
// moves, keys and mouse through a display in memory, from the first screen to the last.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "display.h"
#include "screenshots.h"
#include "short_protocols.h"
#include "study/experiments/session_folder.h"
#include "study/window/layout.h"
#include "study/window/settings.h"
#include "study/window/view.h"
#include "tests/device/faults/command.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/wait_until.h"

namespace forceshade::window {
namespace {

using experiments::Action;
using experiments::Event;
using experiments::EventKind;
using experiments::Press;
using experiments::Protocol;
using experiments::ScreenKind;
using experiments::Session;
using namespace std::chrono_literals;

constexpr std::uint64_t kSeed = 5;
constexpr int kWindowLeft = 160, kWindowTop = 100;  // a window of 1280 x 800 in the middle of 1600 x 1000

// A picture of the display takes a while.
void wait_until(const auto& condition) {
  tests::wait_until(condition, 20ms);
}

// A participant whose screens are computed: another session in this process is given the same presses, so its screens and
// events are those that the command must have.
class Person {
 public:
  Person(const std::string& name, const std::string& text) : name_(name) {
    protocol_ = experiments::read_protocol(written_protocol(folder_, text));
    expect_run({});
    start(
        {"experiment", "run", "protocol.toml", "--participant", "P1", "--session", "session", "--seed", std::to_string(kSeed)});
  }

  // Through screens until `count` trials are answered, or to the end.
  void take_part(std::size_t answers = 1000) {
    while (!session_->is_over() && answered() < answers) {
      const experiments::Screen screen = session_->screen();
      if (screen.kind == ScreenKind::matching) {
        ASSERT_NO_FATAL_FAILURE(touch(screen));
      }
      switch (screen.kind) {
        case ScreenKind::matching:
          for (const char* key : {"j", "k", "k"})
            ASSERT_NO_FATAL_FAILURE(press(key, {{key[0] == 'j' ? Action::smaller : Action::bigger, ""}}));
          ASSERT_NO_FATAL_FAILURE(press("l", {{Action::done, ""}}));
          break;
        case ScreenKind::satisfaction:
          ASSERT_NO_FATAL_FAILURE(press("7 Return", {{Action::type, "7"}, {Action::enter, ""}}));
          break;
        case ScreenKind::classification:
          ASSERT_NO_FATAL_FAILURE(press("2 Return", {{Action::type, "2"}, {Action::enter, ""}}));
          break;
        case ScreenKind::question:
          ASSERT_NO_FATAL_FAILURE(
              press("y e s Return", {{Action::type, "y"}, {Action::type, "e"}, {Action::type, "s"}, {Action::enter, ""}}));
          break;
        default: ASSERT_NO_FATAL_FAILURE(press("Return", {{Action::enter, ""}}));
      }
    }
  }

  // The window is closed as by a window manager; what the command printed.
  std::string close() {
    EXPECT_TRUE(ask_to_close());
    const std::string end = command_->end();
    command_.reset();
    return end;
  }

  void resume() {
    const std::vector<Event> before = events();
    expect_run(before);
    start({"experiment", "resume", "session"});
  }

  // Leaves the last screen.
  std::string leave() {
    see("end");
    EXPECT_EQ(by_hand("key Return").get(), 0);
    return command_->end();
  }

  std::vector<Event> events() const { return experiments::read_session(folder_.file("session")).events; }
  const std::vector<Event>& expected() const { return expected_; }
  const tests::TemporaryDirectory& folder() const { return folder_; }

 private:
  // Our own session goes on where the events ended, as the command's does.
  void expect_run(const std::vector<Event>& before) {
    expected_ = before;
    session_.emplace(
        protocol_, experiments::read_language(protocol_.language), kSeed,
        [this](const Event& event) { expected_.push_back(event); }, std::span<const Event>(before), key_names(Keys{}));
  }

  void start(std::vector<std::string> arguments) {
    for (const char* word : {"--device", "simulated:premium-1.5:mouse", "--uncertified"}) arguments.emplace_back(word);
    command_.emplace(folder_, arguments);
    wait_until([&] { return is_on_display() || !command_->is_running(); });
    ASSERT_TRUE(command_->is_running()) << command_->end();
    wait_until(
        [&] { return std::filesystem::exists(folder_.file("session/trials.jsonl")) && events().size() == expected_.size(); });
  }

  std::size_t answered() const {
    std::size_t count = 0;
    for (const Event& event : expected_) count += event.kind == EventKind::answered;
    return count;
  }

  Scene scene() const {
    Scene scene;
    scene.width = experiments::kMillimetresPerMil * protocol_.width;
    if (protocol_.spacing > 0) scene.separation = experiments::kMillimetresPerMil * protocol_.spacing;
    return scene;
  }

  Image see(const std::string& screen) {
    const Image all = display_image();
    Image window{1280, 800, {}};
    for (int y = 0; y < window.height; ++y)
      window.bytes.insert(window.bytes.end(), all.at(kWindowLeft, kWindowTop + y),
                          all.at(kWindowLeft, kWindowTop + y) + 3 * window.width);
    save(window, "experiment-" + name_ + '-' + screen);
    return window;
  }

  // How much of the cursor the display shows.
  static int cursor_pixels(const Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const std::uint8_t* pixel = image.at(x, y);
        count += std::abs(pixel[0] - 200) < 3 && std::abs(pixel[1] - 64) < 3 && std::abs(pixel[2] - 36) < 3;
      }
    return count;
  }

  // The mouse means the hand to be 6 mm under the plane, in the right bump, which is flat: the surface keeps the hand above
  // that, and the cursor on the picture of the bump.
  void touch(const experiments::Screen& screen) {
    const View view(scene(), Size{1280, 800});
    const double x = scene().separation / 2;
    const Point at = view.pixel({x, 0, -6});
    ASSERT_EQ(by_hand("mousemove " + std::to_string(kWindowLeft + std::lround(at.x)) + ' ' +
                      std::to_string(kWindowTop + std::lround(at.y)))
                  .get(),
              0);
    if (!screen.shows_scene) {
      EXPECT_EQ(cursor_pixels(see("matching-without-vision")), 0);
      return;
    }
    const Point drawn = view.pixel({x, 0, drawn_height(scene(), x)});
    const auto is_on_bump = [&] {
      const Image all = display_image();
      const auto* pixel =
          all.at(kWindowLeft + static_cast<int>(drawn.x), kWindowTop + static_cast<int>(drawn.y - 1.3 * view.pixels_per_mm()));
      return pixel[0] == std::lround(255 * kCursor.red) && pixel[1] == std::lround(255 * kCursor.green);
    };
    wait_until(is_on_bump);
    EXPECT_GT(cursor_pixels(see("matching")), 100);
  }

  // Keys of one screen that end in one event of the log. Before a new screen is drawn its keys have no meaning, and a person
  // waits until they see it; here they press again what had no effect. The answers begin with Backspace, for that.
  void press(const std::string& keys, const std::vector<Press>& meaning) {
    const ScreenKind kind = session_->screen().kind;
    for (const Press& one : meaning) session_->press(one, 0);
    const bool is_answer =
        kind == ScreenKind::satisfaction || kind == ScreenKind::classification || kind == ScreenKind::question;
    const auto has_come = [&] { return events().size() >= expected_.size(); };
    for (int attempt = 0; attempt < 6 && !has_come(); ++attempt) {
      std::this_thread::sleep_for(80ms);
      if (attempt == 0 && kind != ScreenKind::matching) see(names_of(kind));
      ASSERT_EQ(by_hand("key --delay 60 " + std::string(is_answer ? "BackSpace BackSpace BackSpace " : "") + keys).get(), 0);
      for (int i = 0; i < 400 && !has_come(); ++i) std::this_thread::sleep_for(20ms);
    }
    ASSERT_EQ(events().size(), expected_.size()) << "after " << keys;
  }

  static std::string names_of(ScreenKind kind) {
    switch (kind) {
      case ScreenKind::text: return "text";
      case ScreenKind::satisfaction: return "satisfaction";
      case ScreenKind::classification: return "classification";
      case ScreenKind::question: return "question";
      default: return "other";
    }
  }

  const std::string name_;
  const tests::TemporaryDirectory folder_;
  Protocol protocol_;
  std::vector<Event> expected_;
  std::optional<Session> session_;
  std::optional<faults::Command> command_;
};

// But for times.
void expect_same(std::vector<Event> got, const std::vector<Event>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  double before = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (i > 0 && got[i].run == got[i - 1].run) {
      EXPECT_GE(got[i].time, before);
    }
    before = got[i].time;
    got[i].time = expected[i].time;
    EXPECT_EQ(got[i], expected[i]) << "event " << i;
  }
}

class experiment_window : public testing::Test {
 protected:
  void SetUp() override {
    if (!Window::is_available()) GTEST_SKIP() << "this build has no window";
  }
};

TEST_F(experiment_window, matching_goes_from_start_to_end_by_keys_and_mouse) {
  Person person("matching", short_matching("english", 0));
  if (HasFatalFailure()) return;
  ASSERT_NO_FATAL_FAILURE(person.take_part());
  const std::string end = person.leave();
  EXPECT_TRUE(end.starts_with("exit 0: ")) << end;
  std::vector<Event> got = person.events();
  ASSERT_FALSE(got.empty());
  EXPECT_EQ(got.back().kind, EventKind::run_ended);
  got.pop_back();
  expect_same(got, person.expected());
}

TEST_F(experiment_window, a_closed_window_loses_nothing_and_the_session_goes_on) {
  Person person("classification", short_classification("german", 1, 2));
  if (HasFatalFailure()) return;
  ASSERT_NO_FATAL_FAILURE(person.take_part(3));
  const std::string closed = person.close();
  EXPECT_NE(closed.find("is kept"), std::string::npos) << closed;
  ASSERT_NO_FATAL_FAILURE(person.resume());
  ASSERT_NO_FATAL_FAILURE(person.take_part());
  const std::string end = person.leave();
  EXPECT_TRUE(end.starts_with("exit 0: ")) << end;
  std::vector<Event> got = person.events();
  got.pop_back();  // run_ended
  expect_same(got, person.expected());
  int runs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(person.folder().file("session/ticks")))
    runs += entry.is_directory();
  EXPECT_EQ(runs, 2);
}

}  // namespace
}  // namespace forceshade::window
