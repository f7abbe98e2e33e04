// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Notices when device, hand and law swing by themselves, and lowers the force until they do not.

#include <Eigen/Core>
#include <array>
#include <optional>

namespace forceshade::device {

// A swing is an axis' motion from one turn to the next. It is quick if it took less than 25 ms, which is above 20 Hz: no hand
// moves like that, and tremor is at 8 to 12 Hz. It is fed if it and the swing before took less than 75 ms, which is above
// 13.3 Hz, and the force gave the hand more than 0.1 mJ in them: the limit cycles of a hand under late forces are at 16 to
// 21 Hz, and a hand that crosses a texture so quickly is given back what it put in. A swing is driven if the force changed by
// more than 0.1 N on its way, wherever: under a force that is a quarter of a cycle late, the turns have equal forces. Eight in
// a row that are quick or fed, are driven, and do not die away are a limit cycle: each row lowers the gain to 0.7 of what it
// was, and so do every four more. Half a second after the last of them the gain begins to rise again, from nothing to all in
// five seconds.
class OscillationWatch {
 public:
  // mm, s. A swing is longer than three resolutions and than a twentieth of a millimetre.
  OscillationWatch(double resolution, double period) noexcept;

  // Once a tick, with the force that acted up to this position. The gain for what is commanded next, in (0, 1].
  double next(const Eigen::Vector3f& position, const Eigen::Vector3f& acted) noexcept;

 private:
  // The range of some forces, N.
  struct Range {
    void add(const Range& other) noexcept;
    double size() const noexcept { return static_cast<double>((high - low).norm()); }

    Eigen::Vector3f low, high;
  };
  struct Turn {
    double position = 0;  // mm
    double work = 0;      // mJ, given to the hand so far
    int ticks = 0;        // since
  };
  struct Axis {
    Turn last, farthest;                // the last turn, and the place since that may be the next
    Range between{}, since{};           // of the forces between these two, and from the latter on
    double before = 0, before_fed = 0;  // s and mJ, of the swing before
    int direction = 1, row = 0;         // of the motion; swings of a limit cycle so far
    std::array<double, 4> lengths{};    // mm, of the last four of them
  };

  bool turned(Axis& axis, double position, const Eigen::Vector3f& acted) noexcept;

  double shortest_, period_;
  std::optional<Eigen::Vector3f> last_position_;
  double work_ = 0;  // mJ, given to the hand
  std::array<Axis, 3> axes_;
  double gain_ = 1, aim_ = 1;
  int quiet_ticks_ = 0;  // since the last swing of a limit cycle
};

}  // namespace forceshade::device
