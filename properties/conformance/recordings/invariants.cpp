// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/invariants.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "files/csv.h"
#include "properties/conformance/quantile.h"
#include "properties/conformance/recordings/words.h"

namespace forceshade::conformance {
namespace {

class Looking {
 public:
  Looking(const Measurements& measured, const ExactForces& exact, const Allowed& allowed)
      : measured_(measured), samples_(measured.samples), exact_(exact), allowed_(allowed), stays_(measured) {}

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
  // The first violation at this sample; the later ones are not reported.
  void violated(std::size_t sample, const std::string& words) {
    found_.back().violated(measured_.place(sample) + ": " + words);
  }
  double interval(std::size_t i) const { return samples_[i + 1].interval; }
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
        violated(i + 1, "the time is " + (interval(i) == 0 ? "that" : milliseconds(-interval(i)) + " before that") +
                            " of the sample before; expected one after it");
  }

  std::string moves(const Stay& stay) const {
    return "the position stays for " + milliseconds(stays_.seconds(stay)) + ", and then is " + brief(stays_.step_after(stay)) +
           " mm away; the step before was " + brief(stays_.step_before(stay)) + " mm in " +
           milliseconds(stays_.seconds(*(&stay - 1)));
  }

  bool is_held_force(const Stay& stay) const { return stays_.is_long(stay) && has_force(stay.last) && stays_.is_stale(stay); }

  // Long stays are a matter of hold(), also those without a force where there are others with one.
  void repeat() {
    begin("no sample is repeated while the hand moves");
    found_.back().cases = samples_.size();
    const bool is_held = std::ranges::any_of(stays_.all(), [&](const Stay& stay) { return is_held_force(stay); });
    for (const Stay& stay : stays_.all())
      if (stays_.is_stale(stay) && !(is_held && stays_.is_long(stay))) violated(stay.first + 1, moves(stay));
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
    for (const Stay& stay : stays_.all())
      if (is_held_force(stay))
        violated(stay.last, "a force of " + newtons(samples_[stay.last].force.norm()) + " is held while " + moves(stay));
  }

  void rest() {
    begin("a hand at rest feels a force at rest");
    for (const Stay& stay : stays_.all())
      for (std::size_t i = stay.first + 2; i <= stay.last; ++i, ++found_.back().cases) {
        const double change = (samples_[i].force - samples_[i - 1].force).norm();
        if (change > allowed_.force)
          violated(i, "the force changes by " + newtons(change) + " while the position does not, " + allowance());
      }
  }

  // Begins an invariant that needs the exact forces.
  void begin_beside_exact(const char* name) {
    begin(name);
    if (exact_.empty()) found_.back().not_applicable = "without a subject and its place, the surface is not known";
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
  const Stays stays_;
  std::vector<Invariant> found_;
};

// A slow hand moves a sensor by one of its steps at a time, which may be along three axes at once, or by two.
constexpr double kFewSteps = 4;

// Copies to which noise was added move by less than this share of a large step. A hand that turns does so, too, but not after
// each second sample, or each third one.
constexpr double kStill = 0.001;

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
    intervals.push_back(samples[i].interval);
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
  pace.rate_of_positions = Stays(measured).rate();
  return pace;
}

std::vector<Invariant> invariants_of(const Measurements& measured, const ExactForces& exact, const Allowed& allowed) {
  std::vector<Invariant> found = Looking(measured, exact, allowed).look();
  for (Invariant& each : energy_invariants_of(measured, exact, allowed)) found.push_back(std::move(each));
  return found;
}

Stays::Stays(const Measurements& measured) : samples_(measured.samples) {
  divide(0);
  are_copied_ = are_copied();
  if (!are_copied_) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < samples_.size(); ++i) steps.push_back(step(i));
    divide(kStill * quantile(steps, 0.995));
    are_copied_ = are_copied();
    if (!are_copied_) divide(0);
  }
  std::vector<double> speeds, steps;
  for (const Stay& stay : stays_) {
    if (!has_neighbours(stay)) continue;
    steps.push_back(step_after(stay));
    if (const double time = seconds(stay); time > 0) speeds.push_back(step_after(stay) / time);
  }
  usual_speed_ = quantile(speeds, 0.5);
  small_step_ = quantile(steps, 0.01);
}

void Stays::divide(double nearly) {
  stays_.clear();
  for (std::size_t i = 0; i < samples_.size(); ++i)
    if (i > 0 && step(i) <= nearly)
      stays_.back().last = i;
    else
      stays_.push_back({i, i});
}

double Stays::step(std::size_t i) const {
  return (samples_[i].position - samples_[i - 1].position).norm();
}

double Stays::seconds(const Stay& stay) const {
  double sum = 0;
  for (std::size_t i = stay.first + 1; i <= stay.last + 1 && i < samples_.size(); ++i) sum += samples_[i].interval;
  return sum;
}

// Ten intervals of 1 ms may add up to a little more than 10 ms.
bool Stays::is_long(const Stay& stay) const {
  return seconds(stay) > kLongestHold * (1 + 1e-9);
}

bool Stays::is_stale(const Stay& stay) const {
  if (stay.first == stay.last || !has_neighbours(stay)) return false;
  const double before = seconds(*(&stay - 1)), last = samples_[stay.last + 1].interval, held = seconds(stay);
  if (!(before > 0) || !(last > 0)) return false;
  const double speed = step_before(stay) / before, jump = step_after(stay);
  return jump > speed * (held + last) / 2 && speed >= usual_speed_ / 2 && (are_copied_ || jump > kFewSteps * small_step_);
}

// Positions that were copied to a higher rate stay for the same number of samples, or for one of two numbers, however fast the
// hand is and wherever it goes. Those of a sensor with coarse steps do so only at one speed along one line.
bool Stays::are_copied() const {
  if (stays_.size() < 10) return false;
  std::vector<double> counts;
  for (const Stay& stay : stays_)
    if (has_neighbours(stay)) counts.push_back(static_cast<double>(stay.last - stay.first + 1));
  const double usual = quantile(counts, 0.5);
  if (usual < 2 || quantile(counts, 0.95) - quantile(counts, 0.05) > 1) return false;
  const Stay& first = stays_[1];
  const Eigen::Vector3d along = samples_[first.first].position - samples_[first.first - 1].position;
  return std::ranges::any_of(stays_, [&](const Stay& stay) {
    if (!has_neighbours(stay)) return false;
    const Eigen::Vector3d other = samples_[stay.last + 1].position - samples_[stay.last].position;
    return along.cross(other).norm() > 0.5 * along.norm() * other.norm();
  });
}

double Stays::rate() const {
  double time = 0;
  std::size_t positions = 0;
  for (const Stay& stay : stays_) {
    if (!has_neighbours(stay) || (is_long(stay) && !is_stale(stay))) continue;
    time += seconds(stay);
    ++positions;
  }
  return time > 0 ? static_cast<double>(positions) / time : 0;
}

}  // namespace forceshade::conformance
