// SPDX-License-Identifier: BSD-3-Clause
#include "device/frames/thread.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forceshade::device {

FrameThread::FrameThread(FrameLink& link, const FramedOptions& options, double rate, LastingWords& trouble)
    : link_(link),
      options_(options),
      rate_(rate),
      trouble_(trouble),
      share_(options.watchdog_timeout, rate),
      times_(rate, std::max(1, static_cast<int>(rate / 2))),
      thread_("frames", [this] { run(); }) {}

void FrameThread::end() noexcept {
  ending_ = true;
  if (thread_.is_joinable()) thread_.join();
}

void FrameThread::run() noexcept {
  const system::RealTime real_time(system::processor_before_last(), system::RealTime::kFramesPriority);
  const std::int64_t period = std::llround(1e9 / rate_);
  std::int64_t due = system::now();
  while (!ending_ && !sample_.troubled) {
    try {
      frame();
    } catch (const std::exception& error) {
      note(error.what());
    }
    samples.publish(sample_);
    due += period;
    const std::int64_t now = system::now();
    if (now > due + period) ++count_.late;
    due = options_.device_paces ? now : std::max(due, now);  // missed frames are not made up for
    system::sleep_until(due);
  }
  link_.close();
}

void FrameThread::frame() {
  const ForceOrder& order = orders.latest();
  const std::chrono::nanoseconds timeout = options_.watchdog_timeout;
  const std::int64_t begin = system::now(), age = begin - order.time;
  if (!order.force.isZero(0) && age > timeout.count())
    return note("the servo loop has stood still: no force was sent from then on");
  const bool obeys = sample_.ready && sample_.state.forces_on && sample_.state.calibrated && !ending_;
  sent_.allow(order.allowance);
  Eigen::Vector3d force{0, 0, 0};
  if (obeys) force = sent_.send_ahead(order.force * share_.next(age));
  const FrameState state = link_.exchange(force);
  sample_.time = system::now();
  count_.longest_trip = std::max(count_.longest_trip, static_cast<double>(sample_.time - begin) / 1e6);
  ++count_.frames;
  take(state, order.force, force);
}

void FrameThread::take(const FrameState& state, const Eigen::Vector3d& ordered, const Eigen::Vector3d& force) {
  const Eigen::Vector3d acting = state.withheld ? Eigen::Vector3d(0, 0, 0) : force;
  const auto window = times_.add(sample_.time);
  if (window) sample_.times = window;
  sample_.state = state;
  sent_.arrived(state.position);
  sent_.acts(acting);
  share_.acts(ordered, acting);
  sample_.sent = report_of(sent_, share_);
  if (state.applied) {
    count_.says_force = true;
    const double difference =
        std::min((*state.applied - acting).norm(), (*state.applied - sample_.sent.acted.cast<double>()).norm());
    count_.largest_difference = std::max(count_.largest_difference, difference);
  }
  if (!state.calibrated) times_.restart();
  if (!sample_.ready && window && is_good()) sample_.ready = true;
}

bool FrameThread::is_good() const noexcept {
  const FrameTimes::Window& seen = *sample_.times;
  return sample_.state.calibrated && std::fabs(seen.rate - rate_) <= options_.rate_tolerance * rate_ &&
         seen.longest_gap <= std::chrono::duration<double>(options_.watchdog_timeout).count() / 2;
}

void FrameThread::note(const std::string& words) noexcept {
  std::snprintf(trouble_.data(), trouble_.size(), "%s", words.c_str());
  sample_.troubled = true;
  sample_.time = system::now();  // another one, so that the loop does not wait for a frame that will not come
}

}  // namespace forceshade::device
