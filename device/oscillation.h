// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Notices when device, hand and law swing by themselves, and lowers the force until they do not.

#include <Eigen/Core>
#include <array>

namespace forceshade::device {

// A swing is an axis' motion from one turn to the next. It is quick if it took less than 25 ms, which is above 20 Hz: no hand
// moves like that, and tremor is at 8 to 12 Hz. It is driven if the force changed by more than 0.1 N meanwhile. Eight quick
// and driven ones in a row that do not die away are a limit cycle: each row lowers the gain to 0.7 of what it was, and so do
// every four more. Half a second after the last of them the gain begins to rise again, from nothing to all in five seconds.
class OscillationWatch {
 public:
  // mm, s. A swing is longer than three resolutions and than a twentieth of a millimetre.
  OscillationWatch(double resolution, double period) noexcept;

  // Once a tick, with the force that acted up to this position. The gain for what is commanded next, in (0, 1].
  double next(const Eigen::Vector3f& position, const Eigen::Vector3f& acted) noexcept;

 private:
  struct Turn {
    double position = 0;  // mm
    Eigen::Vector3f force{0, 0, 0};
    int ticks = 0;  // since
  };
  struct Axis {
    Turn last, farthest;              // the last turn, and the place since that may be the next
    int direction = 1, row = 0;       // of the motion; quick and driven swings so far
    std::array<double, 4> lengths{};  // mm, of the last four of them
  };

  bool turned(Axis& axis, double position, const Eigen::Vector3f& acted) noexcept;

  double shortest_, period_;
  bool begun_ = false;
  std::array<Axis, 3> axes_;
  double gain_ = 1, aim_ = 1;
  int quiet_ticks_ = 0;  // since the last swing of a limit cycle
};

}  // namespace forceshade::device
