// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/haply_frames.h"

#include <pthread.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "device/monotonic.h"
#include "device/real_time.h"
#include "files/csv.h"

namespace forceshade::device::haply {
namespace {

constexpr std::chrono::milliseconds kToEnd{100};  // for the service to take the zero, and to end the session

}  // namespace

FrameThread::FrameThread(std::unique_ptr<Socket> socket, const FrameSettings& settings, LastingWords& trouble)
    : socket_(std::move(socket)),
      settings_(settings),
      messages_(settings.version, settings.id),
      trouble_(trouble),
      period_(std::llround(1e9 / settings.rate)),
      times_(settings.rate, settings.window),
      thread_([this] { run(); }) {}

void FrameThread::end() noexcept {
  ending_ = true;
  if (thread_.joinable()) thread_.join();
}

void FrameThread::run() noexcept {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, nullptr);  // they are for the thread that waits for frames
  const RealTime real_time(processor_before_last(), RealTime::kFramesPriority);
  std::int64_t due = monotonic_now();
  while (!ending_ && !sample_.troubled) {
    try {
      frame();
    } catch (const std::exception& error) {
      note(error.what());
    }
    publish();
    due += period_;
    const std::int64_t now = monotonic_now();
    if (now > due + period_) ++count_.late;
    due = std::max(due, now);  // what was missed is not made up for
    const timespec until{.tv_sec = due / kSecond, .tv_nsec = due % kSecond};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
  }
  send_zero();
  socket_->close(kToEnd);
  count_.unasked = socket_->unasked();
}

void FrameThread::frame() {
  const ForceOrder& order = orders.latest();
  const std::int64_t begin = monotonic_now(), age = begin - order.time;
  if (!order.force.isZero(0) && age > settings_.watchdog_timeout.count())
    return note("the servo loop has stood still: no force was sent from then on");
  const bool obeys = sample_.ready && sample_.forces_on && sample_.calibrated && settings_.force && !ending_;
  sent_.allow(order.allowance);
  Eigen::Vector3d force{0, 0, 0};
  if (obeys) force = sent_.send_ahead(order.force * share_of_force(age, settings_.watchdog_timeout));
  const Answer answer =
      socket_->ask(settings_.force ? messages_.with_force(force) : messages_.without_force(), settings_.watchdog_timeout);
  if (answer.kind == Answer::Kind::late)
    return note("the Inverse Service has not answered for " +
                files::shortest(static_cast<double>(settings_.watchdog_timeout.count()) / 1e6) +
                " ms; if the device still pushes, switch it off");
  if (answer.kind == Answer::Kind::closed) {
    is_closed_ = true;
    return note("the Inverse Service has closed the connection (" + socket_->why() +
                "); if the device still pushes, switch it off");
  }
  sample_.time = monotonic_now();
  count_.longest_trip = std::max(count_.longest_trip, static_cast<double>(sample_.time - begin) / 1e6);
  ++count_.frames;
  take(message_of(answer.text), force);
}

void FrameThread::take(const Message& message, const Eigen::Vector3d& force) {
  const auto arm =
      std::find_if(message.arms.begin(), message.arms.end(), [&](const Inverse3& a) { return a.id == settings_.id; });
  if (arm == message.arms.end()) return note("the Inverse3 is no longer connected: check its cable and its power");
  if (!arm->position) return note("the Inverse Service sent a state without a position of the Inverse3");
  const auto window = times_.add(sample_.time);
  if (window) sample_.times = window;
  sample_.position = *arm->position;
  sent_.arrived(sample_.position);
  sent_.acts(force);
  sample_.sent = sent_.report();
  sample_.buttons = message.buttons;
  sample_.calibrated = arm->calibrated;
  sample_.forces_on = settings_.force && arm->powered && arm->ready;
  if (arm->force) {
    count_.says_force = true;
    const double difference = std::min((*arm->force - force).norm(), (*arm->force - sample_.sent.acted.cast<double>()).norm());
    count_.largest_difference = std::max(count_.largest_difference, difference);
  }
  if (!sample_.calibrated) times_.restart();
  if (!sample_.ready && window && is_good()) sample_.ready = true;
}

bool FrameThread::is_good() const noexcept {
  const FrameTimes::Window& seen = *sample_.times;
  return sample_.calibrated && std::fabs(seen.rate - settings_.rate) <= settings_.rate_tolerance * settings_.rate &&
         seen.longest_gap <= settings_.longest_gap;
}

void FrameThread::send_zero() noexcept {
  if (is_closed_ || !settings_.force) return;
  try {
    socket_->ask(messages_.with_force(Eigen::Vector3d::Zero()), kToEnd);
  } catch (const std::exception&) {
  }
}

void FrameThread::publish() noexcept {
  samples.publish(sample_);
}

void FrameThread::note(const std::string& words) noexcept {
  std::snprintf(trouble_.data(), trouble_.size(), "%s", words.c_str());
  sample_.troubled = true;
}

}  // namespace forceshade::device::haply
