// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/path.h"

namespace forceshade::conformance {

RecordedPath::RecordedPath(const std::vector<Measured>& samples) {
  for (const Measured& each : samples)
    if (knots_.empty() || each.time > knots_.back().time) knots_.push_back({each.time, each.position, Eigen::Vector3d::Zero()});
  if (knots_.size() < 2) return;
  // The speeds with which accelerations go on through the knots: a tridiagonal system, solved from the first row to the last
  // and back. There is no acceleration at the ends.
  const std::size_t last = knots_.size() - 1;
  const auto inverse = [&](std::size_t i) { return 1 / (knots_[i + 1].time - knots_[i].time); };
  const auto pull = [&](std::size_t i) -> Eigen::Vector3d {  // from a knot to the next
    return 3 * inverse(i) * inverse(i) * (knots_[i + 1].position - knots_[i].position);
  };
  std::vector<double> diagonal(knots_.size());
  for (std::size_t i = 0; i <= last; ++i) {
    diagonal[i] = 2 * ((i > 0 ? inverse(i - 1) : 0) + (i < last ? inverse(i) : 0));
    if (i > 0) knots_[i].velocity += pull(i - 1);
    if (i < last) knots_[i].velocity += pull(i);
    if (i == 0) continue;
    const double factor = inverse(i - 1) / diagonal[i - 1];
    diagonal[i] -= factor * inverse(i - 1);
    knots_[i].velocity -= factor * knots_[i - 1].velocity;
  }
  for (std::size_t i = last + 1; i-- > 0;) {
    if (i < last) knots_[i].velocity -= inverse(i) * knots_[i + 1].velocity;
    knots_[i].velocity /= diagonal[i];
  }
}

bool RecordedPath::reaches(const Measured& sample, double lag) const {
  const double time = sample.time - lag;
  return lag == 0 || (time >= knots_.front().time && time <= knots_.back().time);
}

Eigen::Vector3d RecordedPath::position(const Measured& sample, double lag) const {
  if (lag == 0) return sample.position;
  const double time = sample.time - lag, begin = knots_.front().time, end = knots_.back().time;
  if (time <= begin) return knots_.front().position + (time - begin) * knots_.front().velocity;
  if (time >= end) return knots_.back().position + (time - end) * knots_.back().velocity;
  // Begins at the interval that it would be if all were equal, and goes from there to the right one.
  auto i = static_cast<std::size_t>((time - begin) / (end - begin) * static_cast<double>(knots_.size() - 1));
  while (knots_[i].time > time) --i;
  while (knots_[i + 1].time < time) ++i;
  const Knot &from = knots_[i], &to = knots_[i + 1];
  const double step = to.time - from.time, u = (time - from.time) / step, v = 1 - u;
  return v * v * ((1 + 2 * u) * from.position + u * step * from.velocity) +
         u * u * ((1 + 2 * v) * to.position - v * step * to.velocity);
}

}  // namespace forceshade::conformance
