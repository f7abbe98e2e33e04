// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vendor's library of a PHANToM in the simulated world: over an arm of a session, with a scheduler's thread of its own. It
// answers, fails and blocks as it is told, and what its caller should not have done is a misuse of the arm. Crashes of real
// processes are those of tests/device/stand_in_hd.

#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "device/phantom/hdapi_library.h"
#include "device/phantom/phantom.h"
#include "system/system.h"
#include "tests/world/session.h"

namespace forceshade::world {

namespace hdapi = device::hdapi;

// The answer to a get: the right one, one value in each of its places, an error, or nothing written and no error.
struct Answer {
  enum class How { right, value, error, nothing };

  Answer() = default;
  Answer(double given) : how(How::value), value(given) {}  // implicit: a number is itself
  static Answer fails(hdapi::HDerror code) {
    Answer answer;
    answer.how = How::error;
    answer.error = code;
    return answer;
  }
  static Answer nothing() {
    Answer answer;
    answer.how = How::nothing;
    return answer;
  }
  double value_or(double right) const { return how == How::value ? value : right; }

  How how = How::right;
  double value = 0;
  hdapi::HDerror error = 0;
};

// Calls that never return: hdEndFrame once the force is sent, the others at once.
enum class Blocks { nothing, init_device, begin_frame, end_frame, start_scheduler, stop_scheduler, disable_device };

// By default what is on any day to be expected of the vendor's library, and nothing worse. An error of a frame is put on the
// stack in one frame and not again until orders are given anew; only one that refuses a call (0x1..) comes with each call.
struct Orders {
  hdapi::HDerror init = 0, rate = 0, schedule = 0, start = 0;  // given by these calls
  hdapi::HDerror start_with_error = 0;                         // on the stack after hdStartScheduler, which runs all the same
  hdapi::HDerror begin = 0, get_position = 0, set = 0;         // in frames
  std::array<hdapi::HDerror, 3> end = {};                      // in frames, in this order
  bool comm_lost = false;            // an error, once; then the last position for ever, and an update rate of 0
  bool init_fails_silently = false;  // no device and no error

  // The answer of hdCheckCalibration until hdUpdateCalibration. nullopt: as its styles have it, anew in each process.
  std::optional<hdapi::HDenum> calibration = hdapi::kCalibrated;
  int styles = hdapi::kCalibratesInInkwell;
  bool update_helps = true;                                // true if hdUpdateCalibration leads to kCalibrated
  bool in_reset_pose = true, in_inkwell = false;           // the arm, and its stylus
  std::optional<Eigen::Vector3d> position = std::nullopt;  // mm, in the driver's frame, instead of the simulated one
  bool withholds_position = false;                         // hdGet writes nothing and reports no error

  Answer peak_force = {}, continuous_force = {};                         // N: 8.5, 1.4
  Answer workspace = {}, velocity_limit = {}, impulse_limit = {};        // mm, mm/s: 1500, N/ms: 4
  Answer temperature = {}, encoders = {}, joint_angles = {};             // 0 to 1, counts, rad
  Answer update_rate = {}, instantaneous_rate = {}, input_degrees = {};  // Hz: 1000, Hz: as meant, 6
  int output_degrees = 3;                                                // 3 or 6: as many temperatures are written

  bool output_stays_off = false;
  bool output_goes_off = false;             // as by an emergency switch
  bool hung = false;                        // the scheduler runs no callback
  double frame_hz = 0;                      // of the frames; 0: the rate that was asked for
  std::chrono::milliseconds frame_time{0};  // more than a frame takes anyway
  Blocks blocks = Blocks::nothing;
};

class Hd {
 public:
  explicit Hd(Arm& arm);
  ~Hd();
  Hd(const Hd&) = delete;
  Hd& operator=(const Hd&) = delete;

  // The one that there is, and the functions that call it.
  static Hd& current() noexcept;
  static const device::hdapi::Functions& functions();

  // From now on.
  void tell(const Orders& orders);
  const Orders& orders() const noexcept { return orders_; }

  struct Frame {
    Eigen::Vector3d position, force;  // mm, N, in the driver's frame
  };
  struct Seen {
    std::optional<std::string> name;
    bool initialised = false, scheduler = false, output = false;
    bool is_left = false;  // by a process that ended without hdDisableDevice
    int updates = 0;
    double rate = 1000;
    std::vector<Frame> frames;
  };
  const Seen& seen() const noexcept { return seen_; }

 private:
  friend struct HdFunctions;
  void run();
  void tick();

  Arm& arm_;
  Orders orders_;
  Seen seen_;
  std::vector<device::hdapi::HDErrorInfo> errors_;
  std::set<std::pair<std::string, device::hdapi::HDerror>> reported_;  // in frames, since orders were given
  std::map<device::hdapi::HDSchedulerHandle, std::pair<device::hdapi::HDCallback, void*>> callbacks_;
  system::Thread scheduler_;
  int scheduler_id_ = -1;
  bool stop_ = false, in_frame_ = false, calibrated_ = false, has_position_ = false;
  system::Number ticking_ = 0;  // 1: a callback runs, and other threads' calls wait
  device::FrameState state_;
  Eigen::Vector3d position_{0, 0, 0}, force_{0, 0, 0};  // in the driver's frame
};

// The attendant of a session's PHANToM; a test tells it what to do.
struct Attends final : device::Attendant {
  void report(const std::string& words) noexcept override {
    heard += words + "\n";
    if (on_words) on_words(words);
  }
  bool did(const std::string& words) noexcept override;
  bool has_left() const noexcept override { return leaves; }

  std::string heard;
  std::vector<std::string> asked;
  bool does = false, leaves = false;
  Ns patience = 0;  // for so long it thinks about what it is asked, unless it does that or leaves
  std::function<void(const std::string&)> on_words;
};

// A device of a session: a Phantom over a driver and an attendant of its own, which the test may change before.
struct OpenPhantom {
  Orders orders = {.peak_force = 3.0};
  device::PhantomOptions options = {};
  std::function<void(Attends&)> attended = nullptr;

  std::unique_ptr<device::Device> operator()(Arm& arm) const;
  // The attendant of the session that runs, or was the last.
  static Attends& attends() noexcept;
};

}  // namespace forceshade::world
