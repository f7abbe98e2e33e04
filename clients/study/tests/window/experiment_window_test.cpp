// SPDX-License-Identifier: BSD-3-Clause
// The window of an experiment in a simulated world, from the first screen to the last: the session, the servo loop, a device,
// the window, and a participant with keys and a mouse, who types any key at any frame.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "device/null.h"
#include "device/simulated/simulated.h"
#include "study/apparatus/session_run.h"
#include "study/command/experiment_fronts.h"
#include "study/tests/experiments/protocol_folder.h"
#include "study/tests/window/short_protocols.h"
#include "study/window/view.h"
#include "tests/recorder/faulty_disk.h"
#include "tests/window/drawn_canvas.h"
#include "tests/window/screenshots.h"
#include "tests/world/world.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;
using apparatus::Bumps;
using experiments::Event;
using experiments::EventKind;
using experiments::Press;
using experiments::RecordedSession;
using experiments::Screen;
using experiments::ScreenKind;
using window::Person;
using window::Picture;
using window::Point;

constexpr window::Size kWindow{1280, 800};

bool is_one(const Screen& a, const Screen& b) {
  const auto parts = [](const Screen& s) { return std::tie(s.kind, s.title, s.text, s.block, s.trial, s.is_practice); };
  return parts(a) == parts(b);
}

const char* name_of(ScreenKind kind) {
  constexpr std::array kNames{"text", "matching", "satisfaction", "classification", "question", "end"};
  return kNames[static_cast<std::size_t>(kind)];
}

// A protocol, read once.
struct Experiment {
  explicit Experiment(const std::string& file)
      : path(file), bumps(experiments::read_protocol(file), apparatus::read_until(never)) {}

  static inline const std::atomic<bool> never = false;
  const std::string path;
  Bumps bumps;
};

// The participant, whose screens are noted between the session and its window.
class Participant final : apparatus::Front, device::Attendant {
 public:
  explicit Participant(Experiment& experiment) : experiment_(experiment) {
    person_.sees = [this](const Picture& picture) {
      if (on_frame) on_frame(screens_.back(), picture);
      if (++frames_of_screen_ % 2 == 0 && frames_of_screen_ > (screens_.back().kind == ScreenKind::matching ? waits : 0))
        person_.key(next_key(screens_.back()));
    };
  }

  // A run of the session, from its beginning or where the last one ended. The mouse moves a simulated hand, or nothing moves.
  apparatus::Outcome run(bool has_hand) {
    world::World world;
    apparatus::Outcome outcome;
    presses_.emplace_back();
    const auto end = world.run(
        [&] {
          const Eigen::Vector3f origin(2, 1, -3);
          const std::unique_ptr<device::Device> device =
              has_hand ? device::open_mouse("premium-1.5", *this) : std::make_unique<device::Null>();
          WindowFront window({}, experiment_.bumps, has_hand ? &steering_ : nullptr, origin);
          window_ = &window;
          RecordedSession recorded = fs::exists(session()) ? RecordedSession::resume(session(), {}, experiments::Sync::never)
                                                           : RecordedSession::start(session(), experiment_.path, "P-1", 5, {},
                                                                                    experiments::Sync::never);
          const apparatus::LoopPlan plan{.device = "mouse",
                                         .folder = {},
                                         .certificates = {},
                                         .origin = origin,
                                         .servo = {.rate_hz = has_hand ? 1000.0 : 100.0}};
          outcome = apparatus::run_session(
              recorded, experiment_.bumps, *device, *this, plan, [](const std::string&) {}, stop_);
        },
        600 * system::kSecond);
    EXPECT_EQ(end, world::World::End::over);
    return outcome;
  }

  Person& person() { return person_; }
  const std::vector<Screen>& screens() const { return screens_; }
  std::size_t pressed() const { return presses_.back().size(); }  // in the last run
  int early() const { return early_; }
  std::string session() const { return folder_.file("session"); }
  std::vector<Event> events() const { return experiments::read_session(session()).events; }

  // The events that the presses of each run must have made, with the times that they have.
  std::vector<Event> expected() const {
    std::vector<Event> events;
    const experiments::Protocol& protocol = experiment_.bumps.protocol();
    for (const std::vector<Press>& presses : presses_) {
      const std::vector<Event> earlier = events;
      experiments::Session session(
          protocol, experiments::read_language(protocol.language), 5, [&](const Event& event) { events.push_back(event); },
          earlier);
      for (const Press& press : presses) session.press(press, 0);
      session.close(0);
    }
    const std::vector<Event> got = this->events();
    for (std::size_t i = 0; i < std::min(events.size(), got.size()); ++i) events[i].time = got[i].time;
    return events;
  }

  int waits = 0;  // frames of a matching screen, before the first key
  std::function<void(const Screen& screen, const Picture& picture)> on_frame;

 private:
  bool show(const Screen& screen, const std::optional<device::Sample>& latest, const experiments::Scene& felt) override {
    if (screens_.empty() || !is_one(screens_.back(), screen)) frames_of_screen_ = 0, keys_of_screen_ = 0;
    screens_.push_back(screen);
    return window_->show(screen, latest, felt);
  }
  // A key that is pressed now acts on the screen of this frame. It was typed at that of the frame before.
  std::vector<Press> presses() override {
    std::vector<Press> presses = window_->presses();
    const std::size_t shown = screens_.size();
    if (!presses.empty() && (shown < 2 || !is_one(screens_[shown - 1], screens_[shown - 2]))) ++early_;
    presses_.back().insert(presses_.back().end(), presses.begin(), presses.end());
    return presses;
  }
  device::Steering* steering() noexcept override { return &steering_; }

  std::string next_key(const Screen& screen) {
    const auto answer = [&](const std::string& wanted) {
      return screen.entry == wanted ? "return" : screen.entry.empty() ? wanted : "backspace";
    };
    switch (screen.kind) {
      case ScreenKind::matching: return keys_of_screen_++ == 0 ? "k" : "l";
      case ScreenKind::satisfaction: return answer("7");
      case ScreenKind::classification: return answer("2");
      case ScreenKind::question: return answer("y");
      default: return "return";
    }
  }

  Experiment& experiment_;
  const tests::TemporaryDirectory folder_;
  const tests::FaultyDisk disk_;
  device::Steering steering_;
  Person person_;
  WindowFront* window_ = nullptr;
  std::vector<Screen> screens_;              // of each frame
  std::vector<std::vector<Press>> presses_;  // of each run
  int frames_of_screen_ = 0, keys_of_screen_ = 0, early_ = 0;
  const std::atomic<bool> stop_ = false;
};

TEST(experiment_window, matching_goes_from_start_to_end_by_keys_and_mouse) {
  const tests::TemporaryDirectory folder;
  Experiment experiment(window::written_protocol(folder, window::short_matching("english", 0)));
  Participant participant(experiment);
  participant.waits = 40;
  window::Scene scene;
  scene.separation = 38.1;
  const window::View view(scene, window::scene_area(kWindow));
  const window::Position aim{scene.separation / 2, 0, -6};  // in the right bump, which is flat
  participant.person().at(0).point(view.pixel(aim));
  Point expected = view.pixel({aim.x, 0, window::drawn_height(scene, aim.x)});
  const double radius = 1.3 * view.pixels_per_mm();
  expected.y -= radius;
  int with = 0, without = 0;
  double farthest = 0;
  std::set<std::string> saved;
  int frames = 0;
  participant.on_frame = [&](const Screen& screen, const Picture& picture) {
    frames = screen.kind == ScreenKind::matching ? frames + 1 : 0;
    const std::string name = std::string(name_of(screen.kind)) + (frames == 0 || screen.shows_scene ? "" : "-without-vision");
    if ((screen.kind != ScreenKind::matching || frames == 39) && saved.insert(name).second)
      window::save(participant.person().image(), "experiment-" + name);
    EXPECT_EQ(picture.cursor.has_value(), frames > 0 && screen.shows_scene) << name << ", frame " << frames;
    without += frames > 0 && !screen.shows_scene;
    if (frames < 39 || !screen.shows_scene || !picture.cursor) return;
    ++with;
    farthest = std::max(farthest, std::hypot(picture.cursor->x - expected.x, picture.cursor->y - expected.y));
  };
  const apparatus::Outcome outcome = participant.run(true);
  std::printf("%zu frames; the ball of %.3f pixels is at most %.6f from its place on the drawn bump\n",
              participant.screens().size(), radius, farthest);
  EXPECT_TRUE(outcome.is_over);
  EXPECT_FALSE(outcome.result.trip);
  EXPECT_GT(with, 3);
  EXPECT_GT(without, 3);
  EXPECT_LT(farthest, radius / 2);  // 4.22 of 16.29: the arm's friction holds the hand back
  EXPECT_EQ(participant.events(), participant.expected());
  EXPECT_EQ(participant.events().back().kind, EventKind::run_ended);
  EXPECT_EQ(saved.size(), 6U);
}

TEST(experiment_window, a_closed_window_loses_nothing_and_the_session_goes_on) {
  const tests::TemporaryDirectory folder;
  Experiment experiment(window::written_protocol(folder, window::short_classification("german", 1, 2)));
  Participant participant(experiment);
  participant.on_frame = [&](const Screen& screen, const Picture&) {
    if (screen.trial == 3 && !screen.is_practice) participant.person().key("2").close();
  };
  EXPECT_FALSE(participant.run(true).is_over);
  const std::size_t before = participant.events().size();
  participant.on_frame = {};
  EXPECT_TRUE(participant.run(true).is_over);
  const std::vector<Event> events = participant.events();
  EXPECT_EQ(events, participant.expected());
  ASSERT_GT(events.size(), before);
  EXPECT_EQ(events[before - 1].kind, EventKind::run_ended);
  EXPECT_EQ(std::distance(fs::directory_iterator(participant.session() + "/ticks"), fs::directory_iterator()), 2);
}

// A key that is typed between two screens belongs to the one that was seen: no screen is left, answered or begun by a key from
// before it was drawn.
void expect_every_key_at_every_frame_to_be_of_the_screen_that_was_seen(const std::string& protocol,
                                                                       const std::vector<std::string>& keys) {
  const tests::ProtocolFolder folder;
  Experiment experiment(folder.file(protocol));
  Participant plain(experiment);
  EXPECT_TRUE(plain.run(false).is_over);
  const int frames = static_cast<int>(plain.screens().size());
  int sessions = 0, more = 0;
  std::map<std::string, int> changed;
  for (const std::string& key : keys)
    for (int frame = 0; frame < frames; ++frame) {
      Participant participant(experiment);
      participant.on_frame = [&](const Screen&, const Picture&) {
        if (participant.person().frames() == frame) participant.person().key(key);
      };
      if (frame == 0) participant.person().at(0).key(key);  // before there is any screen
      EXPECT_TRUE(participant.run(false).is_over) << key << " at frame " << frame;
      EXPECT_EQ(participant.early(), 0) << key << " at frame " << frame;
      EXPECT_EQ(participant.events(), participant.expected()) << key << " at frame " << frame;
      ++sessions;
      changed[key] += participant.pressed() != plain.pressed();
      more += static_cast<int>(participant.screens().size()) != frames;
    }
  std::printf("%d sessions of %d frames; %d took another number\n", sessions, frames, more);
  for (const auto& [key, count] : changed) {
    std::printf("%s: %d changed the presses\n", key.c_str(), count);
    EXPECT_GT(count, 0) << key;
  }
}

TEST(experiment_window, every_key_at_every_frame_of_a_matching_belongs_to_the_screen_that_was_seen) {
  expect_every_key_at_every_frame_to_be_of_the_screen_that_was_seen("matching.toml", {"return", "l"});
}

TEST(experiment_window, every_key_at_every_frame_of_a_classification_belongs_to_the_screen_that_was_seen) {
  expect_every_key_at_every_frame_to_be_of_the_screen_that_was_seen("classification.toml", {"return", "2"});
}

}  // namespace
}  // namespace forceshade::apps
