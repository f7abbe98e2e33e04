// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the frames of a PHANToM in its driver's thread, one a tick: the only place where the driver is called while its
// scheduler runs.

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "device/frame_times.h"
#include "device/phantom/hdapi_library.h"
#include "device/phantom/hdapi_words.h"
#include "device/phantom/phantom_shared.h"
#include "device/sent_forces.h"

namespace forceshade::device {

struct FrameSettings {
  bool gimbal = false;
  hdapi::HDenum style = 0;  // in which the driver calibrates the device while frames run; 0: in none
  bool force = true;        // false: the force output is never switched on
  // A force is held for an eighth of it without a new order, then fades, and at its end the output goes off for good.
  std::chrono::nanoseconds watchdog_timeout{25'000'000};
  double rate = 1000;  // Hz, that the scheduler was set to
  // Forces are switched on after one window of good frames: calibrated, no error, this near to the rate, no longer gap.
  int window = 500;
  double rate_tolerance = 0.05;
  double longest_gap = 0.0125;  // s
};

class PhantomFrames {
 public:
  using Phase = PhantomSample::Phase;

  PhantomFrames(const hdapi::Functions& hd, hdapi::HHD device, const FrameSettings& settings, PhantomShared& shared) noexcept
      : hd_(hd),
        device_(device),
        settings_(settings),
        shared_(shared),
        share_(settings.watchdog_timeout, settings.rate),
        times_(settings.rate, settings.window) {}

  // To be scheduled with `self`.
  static unsigned tick(void* self) noexcept;

  // May be called by any thread and by a signal handler: zero is sent in the next frame and the output switched off, for good.
  void close() noexcept { closing_ = true; }
  bool closed() const noexcept { return closed_; }  // or the device was released

  // Called by the frames' own thread in a frame that does not end: releases the device, which ends the force. No frame may
  // follow.
  void abandon() noexcept;
  bool abandoned() const noexcept { return abandoned_; }

  TripleBuffer<PhantomSample> samples;  // for a thread of this process, as in the shared memory for the other one

 private:
  void frame() noexcept;
  void measure() noexcept;
  bool is_switched() noexcept;
  void watch_calibration() noexcept;
  void watch_rate() noexcept;
  bool is_good() const noexcept;
  void switch_on() noexcept;
  bool went_well(const char* step) noexcept;
  bool went_well(const char* step, const hdapi::HDErrorInfo& error) noexcept;
  bool known_and_well(const char* step, bool& known) noexcept;
  void note(const hdapi::Trouble& trouble) noexcept;

  const hdapi::Functions& hd_;
  hdapi::HHD device_;
  FrameSettings settings_;
  PhantomShared& shared_;
  std::atomic<bool> closing_ = false, closed_ = false, abandoned_ = false;

  PhantomSample sample_;
  SentForces sent_;
  SentShare share_;
  FrameTimes times_;
  bool has_encoders_ = true, has_joints_ = true;
  bool has_switch_ = true;
  std::optional<hdapi::HDboolean> switch_ = std::nullopt;
  int frames_switched_ = 0;  // that are still to come without force
  int at_uncalibrated_pose_ = 0, silent_frames_ = 0;
  int since_update_ = 1 << 20;  // frames
};

}  // namespace forceshade::device
