// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/judged_recording.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "properties/binary32.h"
#include "properties/conformance/quantile.h"
#include "properties/conformance/recordings/words.h"
#include "rendering/control_words.h"

namespace forceshade::conformance {
namespace {

Description with_stiffness(Description description, float stiffness) {
  if (auto* law = std::get_if<DescribedLaw>(&description.what)) law->parameters.stiffness = stiffness;
  if (auto* map = std::get_if<DescribedHeightMap>(&description.what)) map->stiffness = stiffness;
  if (auto* mesh = std::get_if<MeshRendering>(&description.what)) mesh->stiffness = stiffness;
  return description;
}

Spread spread_of(const std::vector<double>& sizes) {
  return {quantile(sizes, 0.5), quantile(sizes, 0.9), quantile(sizes, 0.99), quantile(sizes, 1)};
}

// The errors of forces that follow from those of positions: rounded to binary32, and fitted.
double force_of_placement(const Measurements& measured, const std::optional<Fit>& fit, float stiffness) {
  double farthest = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Measured& each : measured.samples) {
    farthest = std::max(farthest, each.position.cwiseAbs().maxCoeff());
    middle += each.position / static_cast<double>(measured.samples.size());
  }
  double off = std::sqrt(3.0) * properties::half_spacing(static_cast<float>(farthest));
  if (fit) {
    double lever = 0;
    for (const Measured& each : measured.samples) lever = std::max(lever, (each.position - middle).norm());
    off += fit->shift_error + fit->turn_error * std::numbers::pi / 180 * lever;
  }
  return off * static_cast<double>(stiffness) + (fit ? fit->offset_error.norm() : 0);
}

class Judging {
 public:
  Judging(const Measurements& measured, const RecordingOptions& options, const Monitor& monitor)
      : measured_(measured), options_(options), monitor_(monitor) {
    found_.file = measured.file;
    found_.samples = measured.samples.size();
    found_.pace = pace_of(measured);
  }

  JudgedRecording without_definition() {
    Placement placement;
    placement.offset = options_.offset.value_or(placement.offset);
    placement.lag = options_.lag.value_or(placement.lag);
    found_.invariants = invariants_of(placed(measured_, placement), {}, {options_.noise, options_.energy});
    return std::move(found_);
  }

  JudgedRecording with(const Description& description) {
    Placement placement;
    if (options_.turn) placement.turn = *options_.turn;
    placement.offset = options_.offset.value_or(placement.offset);
    placement.lag = options_.lag.value_or(placement.lag);
    float stiffness = description.stiffness();
    if (options_.fits) {
      const auto subject = properties::subject_of(description);
      found_.fit = fit_of(measured_, *subject, stiffness,
                          {options_.turn, options_.offset, options_.lag, options_.noise, options_.seed}, monitor_.part(0, 0.2));
      if (found_.fit->refusal) return without_definition();
      placement = found_.fit->placement;
      stiffness = static_cast<float>(found_.fit->stiffness);
    }
    const Measurements there = placed(measured_, placement);
    const ExactForces exact = compare(there, with_stiffness(description, stiffness));
    found_.invariants =
        invariants_of(there, exact, {options_.noise + force_of_placement(there, found_.fit, stiffness), options_.energy});
    return std::move(found_);
  }

 private:
  ExactForces compare(const Measurements& there, const Description& description) {
    const std::shared_ptr<const properties::Subject> subject = properties::subject_of(description);
    Judge judge(subject, options_.tolerance);
    ExactForces exact;
    std::vector<TimedForce> course;
    std::vector<double> differences, percents;
    for (std::size_t i = 0; i < there.samples.size(); ++i) {
      monitor_.at(0.2 + 0.8 * static_cast<double>(i) / static_cast<double>(there.samples.size()));
      const Measured& sample = there.samples[i];
      judge.add({sample.position.cast<float>(), i == 0, sample.force.cast<float>(), "", there.place(i)});
      const auto& judged = judge.exact();
      exact.push_back(judged ? std::optional<Eigen::Vector3d>(judged->force.cast<double>()) : std::nullopt);
      course.push_back({sample.time, sample.force.norm(), exact.back() ? exact.back()->norm() : std::nan("")});
      if (!judged || !sample.force.allFinite()) continue;
      differences.push_back((sample.force - *exact.back()).norm());
      if (const double size = exact.back()->norm(); size > 0) percents.push_back(100 * differences.back() / size);
    }
    found_.comparison = {description,         subject->identity(), judge.judgement(), spread_of(differences),
                         spread_of(percents), std::move(course)};
    return exact;
  }

  const Measurements& measured_;
  const RecordingOptions& options_;
  const Monitor& monitor_;
  JudgedRecording found_;
};

}  // namespace

bool JudgedRecording::held() const {
  return !(fit && fit->refusal) && !(comparison && !comparison->judgement.held()) &&
         std::ranges::none_of(invariants, [](const Invariant& each) { return each.violation.has_value(); });
}

JudgedRecording judge_recording(const Measurements& measured, const std::optional<Description>& description,
                                const RecordingOptions& options, const Monitor& monitor) {
  const ExactArithmetic with_all_bits;
  Judging judging(measured, options, monitor);
  return description ? judging.with(*description) : judging.without_definition();
}

}  // namespace forceshade::conformance
