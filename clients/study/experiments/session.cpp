// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/session.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "files/printable.h"

namespace forceshade::experiments {
namespace {

constexpr int kHighestSatisfaction = 10, kPictures = 4;  // thesis, figures 5-7 and 5-8
constexpr std::size_t kLongestAnswer = 4000;             // bytes of an answer to a question

int number_in(std::string_view digits) {
  int number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

bool is_digit(const std::string& typed) {
  return typed.size() == 1 && typed[0] >= '0' && typed[0] <= '9';
}

void erase_last_character(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
  if (!text.empty()) text.pop_back();
}

Event of(EventKind kind) {
  Event event;
  event.kind = kind;
  return event;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

}  // namespace

Session::Session(Protocol protocol, Language language, std::uint64_t seed, Log log, std::span<const Event> earlier,
                 KeyNames keys)
    : protocol_(std::move(protocol)),
      language_(std::move(language)),
      log_(std::move(log)),
      keys_(std::move(keys)),
      blocks_(order(protocol_, seed)) {
  for (const Block& one : blocks_) attempts_.emplace_back(one.trials.size());
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    if (const std::string what = expected(earlier[i]); !what.empty()) throw ReplayError(i, what);
    apply(earlier[i]);
  }
  Event start = of(EventKind::run_started);
  start.run = run_ + 1;
  log_and_apply(start);
  if (place_ == Place::pending && block_ == blocks_.size()) end_session();
}

// An error text for an event that a log must not hold here, else "". In tests of the replay live events pass it, too.
std::string Session::expected(const Event& event) const {
  const auto unless = [](bool is_right, const char* words) { return is_right ? std::string() : std::string(words); };
  if (event.kind == EventKind::run_started)
    return unless(event.run == run_ + 1 && place_ != Place::end, "expected the next run of a session that is not over");
  if (run_ == 0 || is_closed_) return "expected the start of a run";
  if (!(event.time >= time_)) return "expected a time that is not before the event before it";
  const bool has_trial = block_ < blocks_.size() && trial_ < block().trials.size();
  const auto is_of_trial = [&](int started) {
    return has_trial && event.block == block().number && event.index == static_cast<int>(trial_) + 1 &&
           event.attempt == attempts_[block_][trial_] + started;
  };
  switch (event.kind) {
    case EventKind::run_started: break;
    case EventKind::block_started:
      return unless((place_ == Place::block_text || place_ == Place::instructions) && event.block == block().number,
                    "expected what follows the instructions of a block");
    case EventKind::trial_started:
      return unless(place_ == Place::pending && is_of_trial(1) && event.trial == block().trials[trial_],
                    "expected another trial: protocol.toml or the seed is not the one that the session began with");
    case EventKind::radius_changed: {
      if (!is_matching() || place_ != Place::trial || !is_of_trial(0)) return "expected no change of the radius here";
      const Stimulus& stimulus = protocol_.stimulus(block().trials[trial_].stimulus);
      return unless(event.radius != radius_ && (event.radius == protocol_.stepped(stimulus, radius_, 1) ||
                                                event.radius == protocol_.stepped(stimulus, radius_, -1)),
                    "expected a radius that is one step away");
    }
    case EventKind::match_done:
      return unless(is_matching() && place_ == Place::trial && is_of_trial(0) && event.radius == radius_,
                    "expected the end of no match here, or another radius");
    case EventKind::answered:
      return unless(place_ == (is_matching() ? Place::satisfaction : Place::trial) && is_of_trial(0) &&
                        event.radius == radius_ && event.answer >= 1 &&
                        event.answer <= (is_matching() ? kHighestSatisfaction : kPictures),
                    "expected no answer here, or another one");
    case EventKind::break_started: return unless(place_ == Place::pending && has_trial && trial_ > 0, "expected no break here");
    case EventKind::break_ended: return unless(place_ == Place::pause, "expected no end of a break here");
    case EventKind::question_answered:
      return unless(place_ == Place::question && event.answer == static_cast<int>(question_) + 1,
                    "expected the answer to another question, or none");
    case EventKind::session_ended:
      return unless(place_ == Place::pending && block_ == blocks_.size(), "expected a session that goes on");
    case EventKind::run_ended: break;
  }
  return {};
}

void Session::apply(const Event& event) {
  time_ = event.time;
  switch (event.kind) {
    case EventKind::run_started: {
      run_ = event.run;
      is_closed_ = false;
      const bool is_in_block = place_ == Place::trial || place_ == Place::satisfaction || place_ == Place::pause ||
                               (place_ == Place::pending && block_ < blocks_.size());
      if (is_in_block) place_ = protocol_.resume == Resume::block ? Place::block_text : Place::pending;
      entry_.clear();
      break;
    }
    case EventKind::block_started:
      trial_ = 0;
      place_ = Place::pending;
      break;
    case EventKind::trial_started:
      place_ = Place::trial;
      radius_ = is_matching() ? event.trial.initial_radius : event.trial.radius;
      ++attempts_[block_][trial_];
      started_ = event.time;
      entry_.clear();
      break;
    case EventKind::radius_changed: radius_ = event.radius; break;
    case EventKind::match_done:
      place_ = Place::satisfaction;
      entry_.clear();
      break;
    case EventKind::answered:
      place_ = Place::pending;
      entry_.clear();
      if (++trial_ < block().trials.size()) break;
      trial_ = 0;
      if (++block_ < blocks_.size())
        place_ = Place::block_text;
      else if (!questions().empty())
        place_ = Place::question;
      break;
    case EventKind::break_started: place_ = Place::pause; break;
    case EventKind::break_ended: place_ = Place::pending; break;
    case EventKind::question_answered:
      entry_.clear();
      if (++question_ == questions().size()) place_ = Place::pending;
      break;
    case EventKind::session_ended: place_ = Place::end; break;
    case EventKind::run_ended: is_closed_ = true; break;
  }
}

void Session::log_and_apply(Event event) {
  if (event.kind != EventKind::run_started) {
    event.run = run_;
    event.time = time_;
  }
  log_(event);
  apply(event);
}

Event Session::at_trial(EventKind kind) const {
  Event event = of(kind);
  event.block = block().number;
  event.index = static_cast<int>(trial_) + 1;
  event.attempt = attempts_[block_][trial_];
  event.radius = radius_;
  return event;
}

void Session::start_trial() {
  Event event = at_trial(EventKind::trial_started);
  ++event.attempt;
  event.trial = block().trials[trial_];
  event.radius = 0;
  log_and_apply(event);
}

void Session::end_session() {
  log_and_apply(of(EventKind::session_ended));
}

// After an answer: a break, the next trial, the next block's text or the end.
void Session::go_on() {
  if (place_ != Place::pending) return;
  if (block_ == blocks_.size()) return end_session();
  const int done = static_cast<int>(trial_), every = protocol_.trials_before_break;
  if (!block().is_practice && every > 0 && done > 0 && done % every == 0)
    log_and_apply(of(EventKind::break_started));
  else
    start_trial();
}

void Session::change_radius(int direction) {
  const Mil stepped = protocol_.stepped(protocol_.stimulus(block().trials[trial_].stimulus), radius_, direction);
  if (stepped == radius_) return;
  Event event = at_trial(EventKind::radius_changed);
  event.radius = stepped;
  log_and_apply(event);
}

void Session::type(const std::string& typed) {
  if (place_ == Place::question) {
    if (files::is_printable(typed) && entry_.size() + typed.size() <= kLongestAnswer) entry_ += typed;
  } else if (place_ == Place::satisfaction && is_digit(typed)) {
    const int number = number_in(entry_ + typed);
    if (number >= 1 && number <= kHighestSatisfaction) entry_ += typed;
  } else if (place_ == Place::trial && !is_matching() && is_digit(typed)) {
    if (const int number = number_in(typed); number >= 1 && number <= kPictures) entry_ = typed;
  }
}

void Session::enter() {
  switch (place_) {
    case Place::instructions: place_ = Place::block_text; break;
    case Place::block_text: {
      Event event = of(EventKind::block_started);
      event.block = block().number;
      log_and_apply(event);
      start_trial();
      break;
    }
    case Place::satisfaction:
    case Place::trial: {
      if (entry_.empty()) break;
      Event event = at_trial(EventKind::answered);
      event.answer = number_in(entry_);
      log_and_apply(event);
      go_on();
      break;
    }
    case Place::pause:
      log_and_apply(of(EventKind::break_ended));
      start_trial();
      break;
    case Place::question: {
      Event event = of(EventKind::question_answered);
      event.answer = static_cast<int>(question_) + 1;
      event.text = entry_;
      log_and_apply(event);
      go_on();
      break;
    }
    case Place::pending:
      if (block_ == blocks_.size()) return end_session();
      start_trial();
      break;
    case Place::end: break;
  }
}

void Session::press(const Press& press, double time) {
  if (is_closed_) return;
  time_ = std::max(time_, time);
  const bool is_match = place_ == Place::trial && is_matching();
  const int bigger = protocol_.bigger == Bigger::larger_radius ? 1 : -1;
  switch (press.action) {
    case Action::smaller:
      if (is_match) change_radius(-bigger);
      break;
    case Action::bigger:
      if (is_match) change_radius(bigger);
      break;
    case Action::done:
      if (is_match) log_and_apply(at_trial(EventKind::match_done));
      break;
    case Action::enter: enter(); break;
    case Action::erase: erase_last_character(entry_); break;
    case Action::type: type(press.typed); break;
  }
}

void Session::close(double time) {
  if (is_closed_) return;
  time_ = std::max(time_, time);
  log_and_apply(of(EventKind::run_ended));
}

std::string Session::filled(std::string text) const {
  int done = 0, all = 0;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (blocks_[i].is_practice) continue;
    const auto size = static_cast<int>(blocks_[i].trials.size());
    all += size;
    if (i < block_) done += size;
    if (i == block_) done += static_cast<int>(trial_);
  }
  const int number = block_ < blocks_.size() ? block().number : 0;
  const std::pair<std::string_view, std::string> places[] = {{"{smaller}", keys_.smaller},
                                                             {"{bigger}", keys_.bigger},
                                                             {"{done}", keys_.done},
                                                             {"{enter}", keys_.enter},
                                                             {"{erase}", keys_.erase},
                                                             {"{block}", std::to_string(number)},
                                                             {"{blocks}", std::to_string(blocks_.back().number)},
                                                             {"{trial}", std::to_string(done)},
                                                             {"{trials}", std::to_string(all)}};
  for (const auto& [place, words] : places) replace_all(text, place, words);
  return text;
}

Screen Session::text_screen(const Heading& heading) const {
  return {.kind = ScreenKind::text, .title = filled(heading.title), .text = filled(heading.text)};
}

Screen Session::screen() const {
  switch (place_) {
    case Place::instructions: return text_screen(is_matching() ? language_.matching : language_.classification);
    case Place::block_text:
      if (block().is_practice) return text_screen(language_.practice);
      if (!is_matching()) return text_screen(language_.classification_block);
      return text_screen(block().vision ? language_.block_with_vision : language_.block_without_vision);
    case Place::pause: return text_screen(language_.pause);
    case Place::pending: return text_screen(language_.resumed);
    case Place::question: {
      Screen screen = text_screen(language_.question);
      screen.kind = ScreenKind::question;
      screen.text += "\n\n" + questions()[question_];
      screen.entry = entry_;
      return screen;
    }
    case Place::end: {
      Screen screen = text_screen(language_.end);
      screen.kind = ScreenKind::end;
      return screen;
    }
    case Place::trial:
    case Place::satisfaction: break;
  }
  const bool is_satisfaction = place_ == Place::satisfaction;
  Screen screen = text_screen(is_satisfaction ? language_.satisfy : is_matching() ? language_.match : language_.classify);
  screen.kind = is_satisfaction ? ScreenKind::satisfaction : is_matching() ? ScreenKind::matching : ScreenKind::classification;
  screen.entry = entry_;
  screen.shows_scene = block().vision;
  screen.block = block().number;
  screen.trial = static_cast<int>(trial_) + 1;
  screen.trials = static_cast<int>(block().trials.size());
  screen.is_practice = block().is_practice;
  return screen;
}

Scene Session::scene() const {
  if (is_closed_ || (place_ != Place::trial && place_ != Place::satisfaction)) return {};
  const Trial& trial = block().trials[trial_];
  if (!is_matching()) return {.left = Bump{trial.stimulus, trial.radius, 0}, .right = std::nullopt};
  return {.left = Bump{protocol_.reference.name, trial.radius, -protocol_.spacing / 2},
          .right = Bump{trial.stimulus, radius_, protocol_.spacing / 2}};
}

std::optional<Session::Current> Session::current() const {
  if (is_closed_ || (place_ != Place::trial && place_ != Place::satisfaction)) return std::nullopt;
  return Current{run_,
                 block().number,
                 static_cast<int>(trial_) + 1,
                 attempts_[block_][trial_],
                 block().is_practice,
                 block().trials[trial_],
                 radius_,
                 started_};
}

}  // namespace forceshade::experiments
