// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session with one participant as a deterministic state machine: presses in; screen, bumps to render and events out.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "study/experiments/language.h"
#include "study/experiments/order.h"
#include "study/experiments/participant.h"
#include "study/experiments/protocol.h"

namespace forceshade::experiments {

enum class EventKind {
  run_started,     // run, device, certified
  block_started,   // block; by enter on its instructions
  trial_started,   // block, trial (index), attempt, condition; by the press before it
  radius_changed,  // radius
  match_done,      // radius
  answered,        // radius; answer: satisfaction 1 to 10, or picture 1 to 4
  break_started,
  break_ended,
  question_answered,  // answer: number of the question from 1; text
  session_ended,
  run_ended,  // the window was closed, or the session is over
};

// One line of the trial log. What a kind does not list keeps its zero.
struct Event {
  EventKind kind = EventKind::run_started;
  double time = 0;   // s since the first tick of the run
  int run = 0;       // from 1; one for each start of the program
  int block = 0;     // Block::number
  int index = 0;     // of the trial in its block, from 1
  int attempt = 0;   // from 1; more after an interruption
  Trial trial = {};  // of trial_started
  Mil radius = 0;
  int answer = 0;
  std::string text = {};
  std::string device = {};             // of run_started: Origin::device
  std::optional<bool> certified = {};  // of run_started

  friend bool operator==(const Event&, const Event&) = default;
};

// An event that cannot have come from the session's protocol and seed: which one, from 0; what() states what was expected.
struct ReplayError : std::invalid_argument {
  ReplayError(std::size_t its_event, const std::string& reason) : invalid_argument(reason), event(its_event) {}
  std::size_t event;
};

class Session {
 public:
  // Called with each event before the session goes on: a log that throws leaves the session where it was.
  using Log = std::function<void(const Event&)>;

  // `earlier`: the events of earlier runs, in their order; none for a new session. Throws ReplayError. Logs run_started.
  Session(Protocol protocol, Language language, std::uint64_t seed, Log log, std::span<const Event> earlier = {},
          KeyNames keys = {});

  Screen screen() const;
  Scene scene() const;

  // A press that has no meaning on this screen changes nothing. `time`: s since the first tick of the run; one before that of
  // an earlier call counts as that one.
  void press(const Press& press, double time);

  // Logs run_ended once; after it, presses change nothing.
  void close(double time);

  // The trial that is going on, practice among them; none between trials.
  struct Current {
    int run = 0, block = 0, index = 0, attempt = 0;  // as in Event
    bool is_practice = false;
    Trial trial;
    Mil radius = 0;      // of the matching bump, or of the bump to classify
    double started = 0;  // s of the run
  };
  std::optional<Current> current() const;

  bool is_over() const { return place_ == Place::end; }
  const Protocol& protocol() const { return protocol_; }
  const Language& language() const { return language_; }
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  // pending: a trial or the end comes next without a further press, or, in a later run, after a screen of text.
  enum class Place { instructions, block_text, trial, satisfaction, pause, question, pending, end };

  // State changes in these two alone, so that a log replays to the same state.
  void log_and_apply(Event event);
  void apply(const Event& event);
  std::string expected(const Event& event) const;  // empty where the event may come next

  Event at_trial(EventKind kind) const;
  void start_trial();
  void change_radius(int direction);
  void type(const std::string& typed);
  void enter();
  void go_on();
  void end_session();
  Screen text_screen(const Heading& heading) const;
  std::string filled(std::string text) const;
  const Block& block() const { return blocks_[block_]; }
  bool is_matching() const { return protocol_.experiment == Experiment::matching; }
  const std::vector<std::string>& questions() const {
    return is_matching() ? language_.questions_after_matching : language_.questions_after_classification;
  }

  Protocol protocol_;
  Language language_;
  Log log_;
  KeyNames keys_;
  std::vector<Block> blocks_;
  std::vector<std::vector<int>> attempts_;  // starts of each trial of each block
  Place place_ = Place::instructions;
  std::size_t block_ = 0, trial_ = 0, question_ = 0;
  Mil radius_ = 0;
  std::string entry_;
  int run_ = 0;
  double time_ = 0, started_ = 0;
  bool is_closed_ = true;
};

}  // namespace forceshade::experiments
