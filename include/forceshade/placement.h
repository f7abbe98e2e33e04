// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The placement of what is rendered in a device's workspace.
//
//   const auto placement = device::Placement({10, 0, -25.4F}).turned(2, 1);  // mm; by a quarter turn about the device's z
//   const Eigen::Vector3f at = placement.to_subject({10, 0, 0});             // mm, in the subject's frame
//   device::ServoOptions options;                                            // of servo_loop.h
//   options.placement = placement;
//   std::printf("%g mm\n", static_cast<double>(at.z()));
//
// Threads: a placement is a value.
//
// Not promised: any other angle than quarter turns.

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace forceshade::device {

// The placement of a law or a height map in a device's workspace: shifted by any vector, turned by quarter turns.
//
// Axis i of the subject points along axis `axes[i]` of the device, or against it. Quarter turns only exchange coordinates and
// change signs, so turning a force or a position rounds nothing. Any other angle would round every component, and a force that
// was correctly rounded would no longer be so on the device.
class Placement {
 public:
  // The subject's own frame is the device's.
  Placement() = default;

  // The subject's origin in the device's frame, mm.
  explicit Placement(const Eigen::Vector3f& origin) : origin_(origin) {}

  // Turned about an axis of the device (0: x, 1: y, 2: z) through the subject's origin, by quarter turns. One is from x to y
  // about z, from y to z about x, from z to x about y.
  Placement turned(int axis, int quarters) const noexcept {
    Placement placement = *this;
    const int from = (axis + 1) % 3, to = (axis + 2) % 3;
    for (int k = 0; k < (quarters % 4 + 4) % 4; ++k)
      for (Direction& direction : placement.axes_) {
        if (direction.axis == from)
          direction.axis = to;
        else if (direction.axis == to)
          direction = {from, !direction.is_against};
      }
    return placement;
  }

  // The device's position in the subject's frame: the difference is rounded to binary32 once for each coordinate, and is exact
  // where the origin is 0. The rendered force is that at this very position.
  Eigen::Vector3f to_subject(const Eigen::Vector3f& position) const noexcept { return turned_to_subject(position - origin_); }

  // Exact.
  Eigen::Vector3f turned_to_subject(const Eigen::Vector3f& v) const noexcept {
    return {along(axes_[0], v), along(axes_[1], v), along(axes_[2], v)};
  }
  Eigen::Vector3f turned_to_device(const Eigen::Vector3f& v) const noexcept {
    Eigen::Vector3f turned;
    for (int i = 0; i < 3; ++i) {
      const Direction direction = axes_[static_cast<std::size_t>(i)];
      turned[direction.axis] = direction.is_against ? 0 - v[i] : v[i];
    }
    return turned;
  }

  const Eigen::Vector3f& origin() const noexcept { return origin_; }  // mm
  int axis(std::size_t i) const noexcept { return axes_[i].axis; }
  bool is_against(std::size_t i) const noexcept { return axes_[i].is_against; }

  friend bool operator==(const Placement& a, const Placement& b) noexcept {
    return a.origin_ == b.origin_ && a.axes_ == b.axes_;
  }

 private:
  struct Direction {
    int axis;
    bool is_against;
    bool operator==(const Direction&) const = default;
  };

  // 0 - x, so that no force becomes -0.
  static float along(const Direction& direction, const Eigen::Vector3f& v) noexcept {
    return direction.is_against ? 0 - v[direction.axis] : v[direction.axis];
  }

  Eigen::Vector3f origin_{0, 0, 0};
  std::array<Direction, 3> axes_{{{0, false}, {1, false}, {2, false}}};
};

}  // namespace forceshade::device
