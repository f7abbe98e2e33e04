// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A subject that answers as another one does, for tests that change one of its answers.

#include <memory>
#include <utility>

#include "forceshade/properties.h"

namespace forceshade::tests {

class SubjectWrapper : public properties::Subject {
 public:
  explicit SubjectWrapper(std::shared_ptr<const properties::Subject> its) : its_(std::move(its)) {}

  const Rendering& rendering() const override { return its_->rendering(); }
  std::vector<std::string> parts() const override { return its_->parts(); }
  std::unique_ptr<properties::ReferenceSession> open_reference() const override { return its_->open_reference(); }
  std::unique_ptr<properties::Positions> positions(std::uint64_t seed) const override { return its_->positions(seed); }
  std::vector<Eigen::Vector3f> draw_path(properties::Chooser& choose) const override { return its_->draw_path(choose); }
  properties::Violation check_continuity(properties::Chooser& choose) const override { return its_->check_continuity(choose); }
  properties::Violation check_unit_normals(properties::Chooser& choose) const override {
    return its_->check_unit_normals(choose);
  }
  properties::Violation check_passivity(properties::Chooser& choose) const override { return its_->check_passivity(choose); }
  std::vector<std::function<properties::Violation()>> fixed_loops() const override { return its_->fixed_loops(); }
  std::vector<properties::FurtherProperty> further_properties() const override { return its_->further_properties(); }
  properties::Expected expected() const override { return its_->expected(); }
  std::vector<properties::LoopEnergy> energies(const Monitor& monitor) const override { return its_->energies(monitor); }
  properties::DrawnSubject with_drawn_parameters(std::uint64_t seed) const override {
    return its_->with_drawn_parameters(seed);
  }
  std::uint64_t points_of_a_set(std::uint64_t points) const override { return its_->points_of_a_set(points); }

 private:
  std::shared_ptr<const properties::Subject> its_;
};

}  // namespace forceshade::tests
