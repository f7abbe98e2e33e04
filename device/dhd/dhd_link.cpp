// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/dhd_link.h"

#include <algorithm>

namespace forceshade::device::dhd {
namespace {

constexpr std::chrono::milliseconds kToEnd{500};  // for zero force, dhdStop, its tenth of a second and dhdClose
// While the forces are not on, nothing pushes; and the frame that switches them on may take its time.
constexpr std::chrono::milliseconds kWithoutForce{1000};

std::string counted_words(std::size_t frames, const char* of) {
  return frames == 0 ? "" : std::to_string(frames) + " frames had " + of;
}

}  // namespace

Link::Link(const Functions& functions, const std::string& which, const FramedOptions& options)
    : frame_(std::make_shared<Frame>(functions, options.force)), answer_(options.answer), end_(std::max(kToEnd, options.end)) {
  if (!calls_.run([frame = frame_, which] { frame->identity = frame->arm.open(which); }, options.open))
    throw DeviceError("the vendor's library has not answered for " + std::to_string(options.open.count()) +
                      " ms while the device was opened: check its cable and power");
}

FrameState Link::exchange(const Eigen::Vector3d& force) {
  const std::chrono::milliseconds longest = frame_->state.forces_on ? answer_ : std::max(answer_, kWithoutForce);
  const std::int64_t until = system::now() + system::in_ns(longest);
  if (!calls_.run_until(until, [frame = frame_, force, until] { frame->state = frame->arm.exchange(force, until); }))
    throw DeviceError("the vendor's library has not answered for " + std::to_string(longest.count()) +
                      " ms: check the device's cable and power; if it still pushes, switch it off");
  return frame_->state;
}

void Link::close() noexcept {
  try {
    calls_.run([frame = frame_] { frame->arm.close(); }, end_);
  } catch (const std::exception&) {  // of a lack of memory
  }
}

std::string Link::remark() const {
  const std::string saturated = counted_words(frame_->arm.saturated(), "saturated motors, which shortened their force");
  const std::string guarded = counted_words(frame_->arm.guarded(), "the position of the one before (time guard)");
  return saturated + (saturated.empty() || guarded.empty() ? "" : "; ") + guarded;
}

}  // namespace forceshade::device::dhd
