// SPDX-License-Identifier: BSD-3-Clause
// The frames of a device, one by one: which of them send a force, how much of it, and the words where none may be sent.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "device/frame_times.h"
#include "device/frames/framed_device.h"
#include "device/frames/thread.h"
#include "system/system.h"
#include "tests/world/in_the_world.h"

namespace forceshade::device {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

// The answers of a device to its frames, counted from 0, and for how long it thinks, in ms.
struct Script {
  std::function<void(int frame, FrameState& state)> change = [](int, FrameState&) {};
  std::function<double(int frame)> takes = [](int) { return 0.05; };
};

struct Journal {
  std::vector<double> forces;        // N, along z
  std::vector<std::int64_t> begins;  // ns
  bool is_closed = false;
};

class ScriptedLink final : public FrameLink {
 public:
  ScriptedLink(Script script, Journal& journal) : script_(std::move(script)), journal_(journal) {}
  FrameState exchange(const Eigen::Vector3d& force) override {
    const auto frame = static_cast<int>(journal_.forces.size());
    journal_.forces.push_back(force.z());
    journal_.begins.push_back(system::now());
    system::sleep_for(std::chrono::nanoseconds(std::llround(script_.takes(frame) * 1e6)));
    FrameState state;
    script_.change(frame, state);
    return state;
  }
  void close() noexcept override { journal_.is_closed = true; }

 private:
  Script script_;
  Journal& journal_;
};

constexpr double kForce = 0.5;       // N
constexpr double kPart = 1.0 / 500;  // of a force, that a frame adds to the one before

// Frames of 1 kHz, with an order of `force` in each of these ms.
struct Frames {
  explicit Frames(Script script, const FramedOptions& options = {})
      : link(std::move(script), journal), frames(link, options, 1000, words) {}

  void order(int ms, double force = kForce, const Allowance& allowance = {}) {
    for (int i = 0; i < ms; ++i) {
      frames.orders.publish({.force = {0, 0, force}, .time = system::now(), .allowance = allowance});
      system::sleep_for(milliseconds(1));
    }
  }

  Journal journal;
  LastingWords words{};
  ScriptedLink link;
  FrameThread frames;
};

void in_world(const std::function<void()>& body) {
  world::World world;
  EXPECT_EQ(world.run(body, 600 * system::kSecond), world::World::End::over);
}

// The first frame that sends a force; -1: none.
int first_force(const Journal& journal) {
  for (std::size_t k = 0; k < journal.forces.size(); ++k)
    if (journal.forces[k] != 0) return static_cast<int>(k);
  return -1;
}

// A window has 500 gaps between frames.
TEST(frames, send_a_force_from_the_first_good_window_on) {
  struct Case {
    const char* what;
    Script script;
    int first;
  };
  const auto uncalibrated = [](int from, int to) {
    return [=](int frame, FrameState& state) { state.calibrated = frame < from || frame > to; };
  };
  const auto takes = [](int which, double ms) { return [=](int frame) { return frame == which ? ms : 0.05; }; };
  for (const Case& its : {Case{"all is good", {}, 501},
                          {"not calibrated at first", {.change = uncalibrated(0, 99)}, 601},
                          {"not calibrated at the window's end", {.change = uncalibrated(500, 500)}, 1002},
                          {"never calibrated", {.change = uncalibrated(0, 10'000)}, -1},
                          {"the longest gap that is good", {.takes = takes(200, 11.4)}, 501},
                          {"a longer one", {.takes = takes(200, 11.7)}, 1001},
                          {"the lowest rate that is good", {.takes = [](int) { return 1.04; }}, 501},
                          {"a lower one", {.takes = [](int) { return 1.06; }}, -1}})
    in_world([&] {
      Frames it(its.script);
      it.order(1200);
      EXPECT_EQ(first_force(it.journal), its.first) << its.what;
    });
}

// The frame is the 1200th, when all of the force has come.
TEST(frames, send_no_force_after_one_without_permission_and_then_a_growing_one) {
  struct Case {
    const char* what;
    std::function<void(FrameState&)> change;
    double next;  // part of the force, in frame 1201
  };
  for (const Case& its : {Case{"nothing", [](FrameState&) {}, 1},
                          {"not calibrated", [](FrameState& state) { state.calibrated = false; }, 0},
                          {"forces off", [](FrameState& state) { state.forces_on = false; }, 0},
                          {"withheld", [](FrameState& state) { state.withheld = true; }, kPart}})
    in_world([&] {
      Frames it({.change = [&](int frame, FrameState& state) {
        if (frame == 1200) its.change(state);
      }});
      it.order(1250);
      ASSERT_GT(it.journal.forces.size(), 1202U);
      EXPECT_NEAR(it.journal.forces[1200], kForce, 1e-9) << its.what;
      EXPECT_NEAR(it.journal.forces[1201], its.next * kForce, 1e-9) << its.what;
      EXPECT_NEAR(it.journal.forces[1202], std::min(1.0, its.next + kPart) * kForce, 1e-9) << its.what;
    });
}

TEST(frames, end_once_an_order_of_a_force_is_older_than_the_watchdog_allows) {
  for (const auto& [timeout, force] : {std::pair{25, kForce}, {40, kForce}, {25, 0.0}})
    in_world([timeout = timeout, force = force] {
      Frames it({}, {.watchdog_timeout = milliseconds(timeout)});
      it.order(1200, force);
      const auto before = static_cast<int>(it.journal.forces.size());
      system::sleep_for(milliseconds(300));
      const int more = static_cast<int>(it.journal.forces.size()) - before;
      const bool is_over = force != 0;
      EXPECT_EQ(it.journal.is_closed, is_over) << timeout;
      EXPECT_EQ(it.frames.samples.latest().troubled, is_over);
      EXPECT_STREQ(it.words.data(), is_over ? "the servo loop has stood still: no force was sent from then on" : "");
      EXPECT_NEAR(more, is_over ? timeout : 300, 1.5);
    });
}

// The hand goes by 0.01 mm a frame along the force.
TEST(frames, give_no_more_than_is_allowed) {
  in_world([] {
    Frames it({.change = [](int frame, FrameState& state) { state.position.z() = 0.01 * frame; }});
    it.order(1200, kForce, {.work = 0.2, .longest_step = 1});
    const Sent& sent = it.frames.samples.latest().sent;
    double given = 0;
    for (const double force : it.journal.forces) given += 0.01 * force;
    EXPECT_NEAR(sent.work, given, 0.01 * kForce);
    EXPECT_GT(given, 0.15);
    for (const double force : it.journal.forces) EXPECT_LE(force, 0.2);
    EXPECT_LT(it.journal.forces.back(), 0.01) << "nothing is left";
  });
}

TEST(frames, say_what_was_seen_of_them) {
  in_world([] {
    Frames it({.change = [](int frame, FrameState& state) { state.applied = Eigen::Vector3d(0, 0, frame == 100 ? 0.25 : 0); },
               .takes = [](int frame) { return frame == 50 ? 5.5 : 0.05; }});
    it.order(200);
    it.frames.end();
    const FrameCount& seen = it.frames.count();
    EXPECT_EQ(seen.frames, it.journal.forces.size());
    EXPECT_EQ(seen.late, 1U);
    EXPECT_NEAR(seen.longest_trip, 5.5, 0.01);
    EXPECT_TRUE(seen.says_force);
    EXPECT_EQ(seen.largest_difference, 0.25);
    // No frame makes up for one that was missed.
    for (std::size_t k = 1; k < it.journal.begins.size(); ++k)
      EXPECT_GT(it.journal.begins[k] - it.journal.begins[k - 1], 990'000) << k;
  });
}

// Frames of 1 kHz, five gaps to a window.
TEST(frame_times, say_rate_longest_gap_and_share_of_late_ones) {
  constexpr std::int64_t kMicrosecond = 1000;
  for (const auto& [gap, late] : {std::pair{1500, 0.0}, {1501, 0.2}}) {
    FrameTimes times(1000, 5);
    std::int64_t now = 7 * system::kSecond;
    EXPECT_FALSE(times.add(now));
    for (int k = 0; k < 4; ++k) EXPECT_FALSE(times.add(now += (k == 2 ? gap : 1000) * kMicrosecond)) << k;
    const auto window = times.add(now += 1000 * kMicrosecond);
    ASSERT_TRUE(window);
    EXPECT_NEAR(window->rate, 5e6 / (4000 + gap), 1e-6);
    EXPECT_NEAR(window->longest_gap, 1e-6 * gap, 1e-12);
    EXPECT_EQ(window->late, late);
    // The next window begins where this one ends, and has nothing of it.
    for (int k = 0; k < 4; ++k) EXPECT_FALSE(times.add(now += 500 * kMicrosecond));
    const auto next = times.add(now += 500 * kMicrosecond);
    ASSERT_TRUE(next);
    EXPECT_NEAR(next->rate, 2000, 1e-6);
    EXPECT_EQ(next->late, 0);
    EXPECT_NEAR(next->longest_gap, 0.0005, 1e-12);
  }
  EXPECT_EQ(words_of({.rate = 999.96, .longest_gap = 0.0125, .late = 0.0125}),
            "1000.0 frames a second, 1.25 % of them late, longest gap 12.50 ms");
  for (const auto& [late, grade] : {std::pair{0.0, "good"},
                                    {0.001, "good"},
                                    {0.0011, "fair"},
                                    {0.02, "fair"},
                                    {0.021, "poor: forces are held too long now and then"}})
    EXPECT_STREQ(grade_of({.late = late}), grade) << late;
}

class Listener final : public Attendant {
 public:
  explicit Listener(bool has_left) : has_left_(has_left) {}
  void report(const std::string& words) noexcept override { heard += words + '\n'; }
  bool has_left() const noexcept override { return has_left_; }
  std::string heard;

 private:
  bool has_left_;
};

std::unique_ptr<FramedDevice> opened(const Script& script, Journal& journal, Attendant& attendant) {
  FramedDescription description{.name = "the arm", .partner = "its service", .to_calibrate = "move it home"};
  description.capabilities.peak_force = 3;
  return std::make_unique<FramedDevice>(std::make_unique<ScriptedLink>(script, journal), description,
                                        FramedOptions{.start = milliseconds(700), .calibration = milliseconds(1500)},
                                        attendant);
}

TEST(framed_device, starts_once_its_frames_are_good_or_says_why_not) {
  struct Case {
    int calibrated_from;
    double takes;  // ms
    bool has_left;
    std::string words;  // the beginning of; empty: it starts
  };
  for (const Case& its : {Case{0, 0.05, false, ""},
                          {900, 0.05, false, ""},  // the time for it is the user's, not that of the start
                          {1600, 0.05, false, "the arm is not calibrated"},
                          {0, 1.2, false, "communication with its service is too irregular to send forces: expected 1000"},
                          {0, 0.05, true, "stopped before the arm was ready"}})
    in_world([&] {
      Listener attendant(its.has_left);
      Journal journal;
      const auto device =
          opened({.change = [&](int frame, FrameState& state) { state.calibrated = frame >= its.calibrated_from; },
                  .takes = [&](int) { return its.takes; }},
                 journal, attendant);
      const auto fault = device->start(1000);
      EXPECT_EQ(std::string(fault ? fault->words : "").substr(0, its.words.size()), its.words);
      EXPECT_EQ(!fault, its.words.empty());
      EXPECT_EQ(attendant.heard.find("move it home") != std::string::npos, its.calibrated_from > 0);
      EXPECT_EQ(journal.is_closed, fault.has_value());
    });
}

auto unplugged_at(int last, Journal& journal, Listener& attendant) {
  const auto change = [last](int frame, FrameState&) {
    if (frame == last) throw std::runtime_error("the arm was unplugged");
  };
  return opened({.change = change}, journal, attendant);
}

// At once, and not when the time for the start is over.
TEST(framed_device, that_breaks_while_it_starts_says_so_in_its_own_words) {
  in_world([] {
    Listener attendant(false);
    Journal journal;
    const auto device = unplugged_at(100, journal, attendant);
    const auto fault = device->start(1000);
    ASSERT_TRUE(fault);
    EXPECT_STREQ(fault->words, "the arm was unplugged");
    EXPECT_EQ(journal.forces.size(), 101U);
    EXPECT_LT(system::now() - journal.begins.front(), 200'000'000);
  });
}

TEST(framed_device, that_has_not_answered_yet_is_not_said_to_wait_for_its_calibration) {
  in_world([] {
    Listener attendant(false);
    Journal journal;
    const auto device = opened({.takes = [](int frame) { return frame == 0 ? 20 : 0.05; }}, journal, attendant);
    EXPECT_FALSE(device->start(1000));
    EXPECT_EQ(attendant.heard.find("calibration"), std::string::npos) << attendant.heard;
  });
}

TEST(framed_device, that_breaks_later_is_known_to_be_broken_at_once) {
  in_world([] {
    Listener attendant(false);
    Journal journal;
    const auto device = unplugged_at(700, journal, attendant);
    ASSERT_FALSE(device->start(1000));
    ReadResult read = device->read();
    for (std::int64_t frame = 0, last = 0; !std::holds_alternative<Fault>(read); last = frame) {
      const std::int64_t deadline = system::now() + system::kSecond;  // until which a servo loop waits
      while (frame == last && system::now() < deadline) frame = device->wait_for_frame(deadline);
      read = device->read();
      device->command({0, 0, 0});
    }
    EXPECT_STREQ(std::get<Fault>(read).words, "the arm was unplugged");
    EXPECT_LT(system::now() - journal.begins.back(), 5'000'000);
  });
}

TEST(framed_device, says_at_its_end_how_far_the_force_was_from_what_it_was_told) {
  for (const bool says : {false, true})
    in_world([says] {
      Listener attendant(false);
      Journal journal;
      auto device = opened({.change =
                                [=](int frame, FrameState& state) {
                                  if (says) state.applied = Eigen::Vector3d(0, 0, frame == 100 ? 0.25 : 0);
                                }},
                           journal, attendant);
      ASSERT_FALSE(device->start(1000));
      device.reset();
      const bool told = attendant.heard.find("differed from the commanded one by at most 0.25 N") != std::string::npos;
      EXPECT_EQ(told, says) << attendant.heard;
    });
}

TEST(framed_device, passes_on_what_its_device_says_of_itself) {
  in_world([] {
    Listener attendant(false);
    Journal journal;
    const auto device = opened({.change =
                                    [](int frame, FrameState& state) {
                                      state.calibrated = frame != 700;
                                      if (frame == 710) state.forces_on = false, state.forces_off = "no power";
                                    }},
                               journal, attendant);
    ASSERT_FALSE(device->start(1000));
    int uncalibrated = 0, off = 0;
    for (int tick = 0; tick < 300; ++tick) {
      device->wait_for_frame(system::now() + system::kSecond);
      ASSERT_TRUE(std::holds_alternative<Reading>(device->read()));
      device->command({0, 0, 0});
      const State state = device->state();
      uncalibrated += state.calibrated ? 0 : 1;
      off += state.forces_on ? 0 : 1;
      EXPECT_STREQ(state.forces_off, state.forces_on ? "" : "no power");
    }
    EXPECT_EQ(uncalibrated, 1);
    EXPECT_EQ(off, 1);
  });
}

TEST(framed_device, sends_no_more_than_its_highest_force) {
  in_world([] {
    Listener attendant(false);
    Journal journal;
    const auto device = opened({}, journal, attendant);
    EXPECT_TRUE(device->capabilities().latency && device->capabilities().paces) << "of its frames";
    ASSERT_FALSE(device->start(1000));
    for (int tick = 0; tick < 1000; ++tick) {
      device->command({0, 0, 5});
      system::sleep_for(milliseconds(1));
    }
    const double most = *std::ranges::max_element(journal.forces);
    EXPECT_LE(most, 3);
    EXPECT_GT(most, 2.999);
  });
}

// An answer that comes after 24 ms counts; after 27 ms it never does.
TEST(framed_device, has_a_fault_once_no_frame_came_for_as_long_as_its_watchdog_allows) {
  for (const auto& [ms, is_fault] : {std::pair{23.0, false}, {27.0, true}})
    in_world([ms = ms, is_fault = is_fault] {
      Listener attendant(false);
      Journal journal;
      const auto device = opened({.takes = [=](int frame) { return frame == 700 ? ms : 0.05; }}, journal, attendant);
      ASSERT_FALSE(device->start(1000));
      bool was_fault = false;
      for (int tick = 0; tick < 1000; ++tick) {
        system::sleep_for(microseconds(500));
        const ReadResult read = device->read();
        const Fault* const fault = std::get_if<Fault>(&read);
        EXPECT_TRUE(fault || !was_fault) << "what is over does not go on";
        EXPECT_TRUE(!fault || std::string(fault->words).starts_with("no frame of the device came in time"));
        was_fault = fault != nullptr;
        device->command({0, 0, 0});
      }
      EXPECT_EQ(was_fault, is_fault) << ms;
    });
}

}  // namespace
}  // namespace forceshade::device
