// SPDX-License-Identifier: BSD-3-Clause
// The work of the force on the hand, by the trapezoid rule, over closed loops and over what begins out of contact.

#include <array>
#include <cmath>
#include <map>

#include "files/csv.h"
#include "properties/conformance/recordings/invariants.h"
#include "properties/conformance/recordings/words.h"

namespace forceshade::conformance {
namespace {

// Sums over the steps up to a sample.
struct Sums {
  double work = 0, exact_work = 0;  // mJ, on the hand; of a step without an exact force, the measured one is in both
  double steps_squared = 0;         // mm²
  double rule = 0;                  // mJ, what steps of twice the length change: an estimate of the rule's own error
};

double trapezoid(const Eigen::Vector3d& force, const Eigen::Vector3d& next_force, const Eigen::Vector3d& step) {
  return (force + next_force).dot(step) / 2;
}

class Energy {
 public:
  Energy(const Measurements& measured, const ExactForces& exact, const Allowed& allowed)
      : measured_(measured), samples_(measured.samples), exact_(exact), allowed_(allowed) {
    add_up();
  }

  // Between two samples in one cell of a grid, whose cells are as large as a usual step.
  Invariant loops() const {
    Invariant found{"no closed loop gives the hand energy", 0};
    const double cell = std::max(1e-3, usual_step_of(measured_));
    struct Visits {
      std::size_t last, least;  // the one before, and the one with the least work until then
    };
    std::map<std::array<long long, 3>, Visits> cells;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      std::array<long long, 3> at{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] = std::llround(std::floor(samples_[i].position[static_cast<Eigen::Index>(axis)] / cell));
      const auto [visits, is_first] = cells.try_emplace(at, Visits{i, i});
      if (is_first) continue;
      for (const std::size_t from : {visits->second.last, visits->second.least}) {
        if (from + 1 >= i) continue;  // not away meanwhile
        ++found.cases;
        look(found, from, i, "the hand comes back to this place");
      }
      visits->second.last = i;
      if (sums_[i].work < sums_[visits->second.least].work) visits->second.least = i;
    }
    return found;
  }

  Invariant passivity() const {
    Invariant found{"all in all the hand gets no energy", 0};
    std::optional<std::size_t> least;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (least) {
        ++found.cases;
        look(found, *least, i, "nothing was stored, as there was no force");
      }
      if (is_free(i) && (!least || sums_[i].work < sums_[*least].work)) least = i;
    }
    return found;
  }

 private:
  bool is_free(std::size_t i) const {
    return samples_[i].force.allFinite() && samples_[i].force.norm() <= allowed_.force &&
           (exact_.empty() || (exact_[i] && exact_[i]->isZero(0)));
  }

  // Nothing is known of a step with a force that is not finite.
  double measured_work(std::size_t from, std::size_t to) const {
    const double work = trapezoid(samples_[from].force, samples_[to].force, samples_[to].position - samples_[from].position);
    return std::isfinite(work) ? work : 0;
  }

  void add_up() {
    sums_.resize(samples_.size());
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      const Eigen::Vector3d step = samples_[i].position - samples_[i - 1].position;
      Sums& sum = sums_[i] = sums_[i - 1];
      const double work = measured_work(i - 1, i);
      sum.work += work;
      const bool is_known = !exact_.empty() && exact_[i - 1] && exact_[i];
      sum.exact_work += is_known ? trapezoid(*exact_[i - 1], *exact_[i], step) : work;
      sum.steps_squared += step.squaredNorm();
      if (exact_.empty() && i > 1) sum.rule += std::abs(measured_work(i - 2, i) - work - measured_work(i - 2, i - 1));
    }
  }

  // From a sample to a later one, and from there straight back where the loop is closed in that way.
  void look(Invariant& found, std::size_t from, std::size_t to, const char* why) const {
    if (found.violation) return;
    const Eigen::Vector3d back = samples_[from].position - samples_[to].position;
    double work = sums_[to].work - sums_[from].work, exact = sums_[to].exact_work - sums_[from].exact_work;
    double rule = sums_[to].rule - sums_[from].rule;
    if (!is_free(from)) {
      const double closing = measured_work(to, from);
      work += closing;
      exact += !exact_.empty() && exact_[from] && exact_[to] ? trapezoid(*exact_[to], *exact_[from], back) : closing;
      // The work of a force that lies between those at the ends.
      if (exact_.empty()) rule += (samples_[from].force - samples_[to].force).norm() * back.norm() / 2;
    }
    const double off =
        allowed_.force * (back.norm() + 4 * std::sqrt(sums_[to].steps_squared - sums_[from].steps_squared)) + rule;
    const double most = exact_.empty() ? 0 : std::max(0.0, exact);
    if (!(work > most + allowed_.energy + off)) return;
    found.violation = measured_.place(to) + ": since " + measured_.place(from) + ", where " + why + ", the hand gets " +
                      brief(work) + " mJ; expected " + brief(most + allowed_.energy) + " mJ at most, and " + brief(off) +
                      " mJ are allowed for what is measured";
  }

  const Measurements& measured_;
  const std::vector<Measured>& samples_;
  const ExactForces& exact_;
  const Allowed& allowed_;
  std::vector<Sums> sums_;
};

}  // namespace

std::vector<Invariant> energy_invariants_of(const Measurements& measured, const ExactForces& exact, const Allowed& allowed) {
  const Energy energy(measured, exact, allowed);
  return {energy.loops(), energy.passivity()};
}

}  // namespace forceshade::conformance
