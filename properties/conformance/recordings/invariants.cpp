// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/invariants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "files/csv.h"
#include "properties/conformance/quantile.h"
#include "properties/conformance/recordings/words.h"

namespace forceshade::conformance {
namespace {

// Samples first to last are at one position, and more than one.
struct Rest {
  std::size_t first, last;
};

std::vector<Rest> rests_of(const std::vector<Measured>& samples) {
  std::vector<Rest> rests;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].position != samples[i - 1].position) continue;
    if (rests.empty() || rests.back().last + 1 != i) rests.push_back({i - 1, i - 1});
    rests.back().last = i;
  }
  return rests;
}

class Looking {
 public:
  Looking(const Measurements& measured, const ExactForces& exact, const Allowed& allowed)
      : measured_(measured), samples_(measured.samples), exact_(exact), allowed_(allowed), rests_(rests_of(samples_)) {}

  std::vector<Invariant> look() {
    stay_finite();
    increase();
    repeat();
    hold();
    rest();
    free();
    attract();
    return std::move(found_);
  }

 private:
  void begin(const char* name) { found_.push_back({name, 0}); }
  // The first violation at this sample; the later ones are not said.
  void violated(std::size_t sample, const std::string& words) {
    found_.back().violated(measured_.place(sample) + ": " + words);
  }
  double interval(std::size_t i) const { return samples_[i + 1].time - samples_[i].time; }
  double step(std::size_t i) const { return (samples_[i + 1].position - samples_[i].position).norm(); }
  bool has_force(std::size_t i) const { return samples_[i].force.allFinite() && samples_[i].force.norm() > allowed_.force; }

  void stay_finite() {
    begin("every force is finite");
    for (std::size_t i = 0; i < samples_.size(); ++i, ++found_.back().cases)
      if (!samples_[i].force.allFinite())
        violated(i, "the force is " + shown(samples_[i].force) +
                        " N; expected a finite one: a device gets no force, the last one, or its largest");
  }

  void increase() {
    begin("time increases");
    for (std::size_t i = 0; i + 1 < samples_.size(); ++i, ++found_.back().cases)
      if (!(interval(i) > 0))
        violated(i + 1, "the time is " + files::shortest(samples_[i + 1].time) +
                            " s; expected one after that of the sample before, " + files::shortest(samples_[i].time) + " s");
  }

  // Where the hand was at rest, it goes on slowly; where a sample was repeated instead, it then is where it would have been. Of
  // a hand that is slow beside what is usual, this is not known, since positions are rounded.
  bool is_stale(const Rest& rest) const {
    if (rest.first == 0 || rest.last + 1 == samples_.size()) return false;
    const double before = interval(rest.first - 1), last = interval(rest.last);
    if (!(before > 0) || !(last > 0)) return false;
    const double speed = step(rest.first - 1) / before, held = samples_[rest.last].time - samples_[rest.first].time;
    const double jump = step(rest.last);
    return jump > speed * (last + held / 2) && speed * last >= usual_step_ / 2;
  }

  std::string moves(const Rest& rest) const {
    return "the position stays for " + milliseconds(samples_[rest.last + 1].time - samples_[rest.first].time) +
           ", and then is " + brief(step(rest.last)) + " mm away; the step before was " + brief(step(rest.first - 1)) +
           " mm in " + milliseconds(interval(rest.first - 1));
  }

  void repeat() {
    begin("no sample is repeated while the hand moves");
    found_.back().cases = samples_.size();
    for (const Rest& rest : rests_)
      if (is_stale(rest) && samples_[rest.last].time - samples_[rest.first].time <= kLongestHold)
        violated(rest.first + 1, moves(rest));
  }

  void hold() {
    begin("no force is held longer than 10 ms without a new position");
    for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
      if (!has_force(i)) continue;
      ++found_.back().cases;
      if (interval(i) > kLongestHold)
        violated(i, "a force of " + newtons(samples_[i].force.norm()) + " is held for " + milliseconds(interval(i)) +
                        ", until the next sample");
    }
    for (const Rest& rest : rests_)
      if (is_stale(rest) && has_force(rest.last) && samples_[rest.last].time - samples_[rest.first].time > kLongestHold)
        violated(rest.last, "a force of " + newtons(samples_[rest.last].force.norm()) + " is held while " + moves(rest));
  }

  void rest() {
    begin("a hand at rest feels a force at rest");
    for (const Rest& rest : rests_)
      for (std::size_t i = rest.first + 2; i <= rest.last; ++i, ++found_.back().cases) {
        const double change = (samples_[i].force - samples_[i - 1].force).norm();
        if (change > allowed_.force)
          violated(i, "the force changes by " + newtons(change) + " while the position does not, " + allowance());
      }
  }

  // Begins an invariant that needs the exact forces.
  void begin_beside_exact(const char* name) {
    begin(name);
    if (exact_.empty()) found_.back().not_applicable = "without a subject, and its place, nobody knows where its surface is";
  }

  void free() {
    begin_beside_exact("no force out of contact");
    double largest = -1;
    for (std::size_t i = 0; i < exact_.size(); ++i) {
      if (!exact_[i] || !exact_[i]->isZero(0)) continue;
      ++found_.back().cases;
      if (const double size = samples_[i].force.norm(); size > largest) {
        largest = size;
        found_.back().largest = newtons(size) + " at " + measured_.place(i) + ", " + allowance();
      }
      if (has_force(i))
        violated(i, "at " + shown(samples_[i].position) + " mm, out of contact, the force is " + shown(samples_[i].force) +
                        " N, " + allowance() + ": a hand feels " + newtons(samples_[i].force.norm()) + " of nothing");
    }
  }

  void attract() {
    begin_beside_exact("no attraction");
    for (std::size_t i = 0; i < exact_.size(); ++i) {
      if (!exact_[i] || exact_[i]->isZero(0)) continue;
      ++found_.back().cases;
      const double away = samples_[i].force.dot(exact_[i]->normalized());
      if (away < -allowed_.force)
        violated(i, "at " + shown(samples_[i].position) + " mm the force is " + shown(samples_[i].force) + " N, where " +
                        shown(*exact_[i]) + " N is exact: a hand is pulled into the surface with " + newtons(-away));
    }
  }

  std::string allowance() const { return "where " + newtons(allowed_.force) + " are allowed for"; }

  const Measurements& measured_;
  const std::vector<Measured>& samples_;
  const ExactForces& exact_;
  const Allowed& allowed_;
  const std::vector<Rest> rests_;
  const double usual_step_ = usual_step_of(measured_);
  std::vector<Invariant> found_;
};

}  // namespace

double usual_step_of(const Measurements& measured) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < measured.samples.size(); ++i)
    if (const double step = (measured.samples[i].position - measured.samples[i - 1].position).norm(); step > 0)
      steps.push_back(step);
  return quantile(steps, 0.5);
}

Pace pace_of(const Measurements& measured) {
  const std::vector<Measured>& samples = measured.samples;
  Pace pace;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    intervals.push_back(samples[i].time - samples[i - 1].time);
    const Eigen::Vector3d change = samples[i].force - samples[i - 1].force;
    if (samples[i].position != samples[i - 1].position || !change.allFinite()) continue;
    ++pace.repeats;
    pace.noise += change.squaredNorm();
  }
  if (pace.repeats > 0) pace.noise = std::sqrt(pace.noise / static_cast<double>(pace.repeats));
  pace.seconds = samples.back().time - samples.front().time;
  pace.median = quantile(intervals, 0.5);
  pace.p99 = quantile(intervals, 0.99);
  pace.longest = quantile(intervals, 1);
  for (const double interval : intervals)
    pace.jitter += std::abs(interval - pace.median) / static_cast<double>(intervals.size());
  if (pace.median > 0) pace.rate = 1 / pace.median;
  return pace;
}

std::vector<Invariant> invariants_of(const Measurements& measured, const ExactForces& exact, const Allowed& allowed) {
  std::vector<Invariant> found = Looking(measured, exact, allowed).look();
  for (Invariant& each : energy_invariants_of(measured, exact, allowed)) found.push_back(std::move(each));
  return found;
}

}  // namespace forceshade::conformance
