// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/phantom_host.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <stdio_ext.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "forceshade/csv/csv.h"
#include "forceshade/device/hdapi_library.h"
#include "forceshade/device/monotonic.h"
#include "forceshade/device/open_device.h"
#include "forceshade/device/phantom_frames.h"
#include "forceshade/device/phantom_limits.h"
#include "forceshade/device/phantom_messages.h"
#include "forceshade/device/real_time.h"

namespace forceshade::device {
namespace {

using Kind = PhantomMessage::Kind;
using std::chrono::milliseconds;

constexpr milliseconds kPoll{1}, kWatch{10};
constexpr milliseconds kClosing{200};  // for the last frame
constexpr milliseconds kEnding{1000};  // for the driver to stop, after which the process ends all the same
constexpr int kMeasured = 2;           // Hz: a window of frames is half a second

// Why the device cannot be driven.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The frames that a crash of this process has time to close, and their own thread.
std::atomic<PhantomFrames*> running = nullptr;
std::atomic<pid_t> driver = 0;
std::atomic<bool> interrupts = false;
thread_local bool is_driver = false;

constexpr int kInterrupt = SIGUSR1;

bool closes_in_time(const PhantomFrames& frames) noexcept {
  const std::int64_t deadline = monotonic_now() + std::chrono::nanoseconds(kClosing).count();
  while (!frames.closed() && monotonic_now() < deadline) ::usleep(500);
  return frames.closed();
}

// Whether the force has ended; by any thread, and by a signal handler. A frame that does not end keeps the driver's locks, so
// that every call of another thread waits for it: then the frames' own thread, which has the locks, releases the device.
bool let_go() noexcept {
  PhantomFrames* frames = running;
  if (!frames) return true;
  if (is_driver) {
    frames->abandon();
    return true;
  }
  frames->close();
  if (closes_in_time(*frames)) return true;
  interrupts = true;
  const pid_t thread = driver;
  if (thread != 0) ::tgkill(::getpid(), thread, kInterrupt);
  return closes_in_time(*frames);
}

// On the frames' own thread. Back in the library it would run a frame of a device that is released.
void interrupted(int) {
  const PhantomFrames* frames = running;
  if (!is_driver || !interrupts || !frames || frames->closed()) return;
  let_go();
  for (;;) ::pause();
}

// Once, in the first frame.
void meet_driver() noexcept {
  is_driver = true;
  driver = ::gettid();
  sigset_t interrupt;
  sigemptyset(&interrupt);
  sigaddset(&interrupt, kInterrupt);
  ::pthread_sigmask(SIG_UNBLOCK, &interrupt, nullptr);
}

bool is_alone(int socket, pid_t parent) noexcept {
  pollfd end{.fd = socket, .events = POLLRDHUP, .revents = 0};
  const bool closed = ::poll(&end, 1, 0) > 0 && (end.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0;
  return closed || ::getppid() != parent;
}

// What the watch says for the process, and ends it, where the driver's call does not return in time.
class LastWords {
 public:
  void say_unless_taken_back(const std::string& words, milliseconds patience) {
    const std::lock_guard lock(mutex_);
    words_ = words;
    due_ = Clock::now() + patience;
  }
  void take_back() {
    const std::lock_guard lock(mutex_);
    due_.reset();
  }
  std::optional<std::string> due() {
    const std::lock_guard lock(mutex_);
    return due_ && Clock::now() > *due_ ? std::optional(words_) : std::nullopt;
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  std::string words_;
  std::optional<Clock::time_point> due_;
};

// Ends the process when the other one is gone, whatever the driver's calls are stuck in: where they let no zero be sent, at
// once, since the device's port is then closed, which is the last that can be done.
void watch(int socket, pid_t parent, LastWords& last_words) {
  std::optional<std::string> words;
  while (!(words = last_words.due()) && !is_alone(socket, parent)) {
    pollfd end{.fd = socket, .events = POLLRDHUP, .revents = 0};
    ::poll(&end, 1, static_cast<int>(kWatch.count()));
  }
  const bool zero_was_sent = let_go();
  if (words)
    send_words(socket, Kind::failed, *words);
  else if (zero_was_sent)
    std::this_thread::sleep_for(kEnding);
  ::_exit(kStuck);
}

void crashed(int signal) {
  let_go();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// A library that ends the process ends the force first. What is registered last is called first, so this comes after all that
// the library registers: its objects are not destroyed yet, and never are, since frames may use them.
void end_force_at_exit() noexcept {
  ::on_exit(
      [](int code, void*) {
        let_go();
        ::_exit(code);
      },
      nullptr);
}

// Nothing that is sent to a terminal's programs reaches this process, and no handler of the driver's is ever called.
void be_a_process_of_its_own() {
  ::setsid();
  ::prctl(PR_SET_NAME, "forceshade-hd");
  sigset_t all;
  sigfillset(&all);
  for (const int crash : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) {
    sigdelset(&all, crash);
    std::signal(crash, crashed);
  }
  std::signal(kInterrupt, interrupted);
  sigprocmask(SIG_SETMASK, &all, nullptr);
}

// What a vendor's library prints goes to standard error; no file of the other process's stays open. The socket, which may have
// a new number.
int have_files_of_its_own(int socket) {
  __fpurge(stdout);
  if (socket <= STDERR_FILENO) socket = ::fcntl(socket, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  constexpr unsigned kFirst = STDERR_FILENO + 1, kLast = ~0U;
  const auto kept = static_cast<unsigned>(socket);
  if (kept > kFirst) ::close_range(kFirst, kept - 1, 0);
  ::close_range(kept + 1, kLast, 0);
  return socket;
}

// The driver's thread answers every frame within some µs, and a frame that is late holds an old force: it comes before the
// servo loop, and on another processor where there is one. The loop takes the last, so this takes the one before.
std::optional<int> processor_of_driver() {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return std::nullopt;
  std::optional<int> last, before;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &allowed)) {
      before = last;
      last = cpu;
    }
  return before ? before : last;
}

class Host {
 public:
  Host(int socket, pid_t parent, PhantomShared& shared, const std::string& name, const PhantomOptions& options,
       LastWords& last_words)
      : socket_(socket),
        parent_(parent),
        shared_(shared),
        name_(name),
        options_(options),
        last_words_(last_words),
        hd_(hdapi::vendor()) {}

  // Opens the device, starts it when told to, and holds it until the other process is gone. Throws Refused.
  void hold() {
    open();
    PhantomMessage message;
    if (next(message) != Kind::start) return;
    start(message.rate);
    send_words(socket_, Kind::ready, "");
    next(message);
  }

  // Zero force, output off, scheduler stopped, device released, in this order.
  void close() noexcept;
  // A frame did not end, and the device was released from its thread: the last that can be done.
  bool was_abandoned() const noexcept { return frames_ && frames_->abandoned(); }

 private:
  void open();
  PhantomDescription described();
  void start(double rate);
  hdapi::HDenum preferred_style();
  void calibrate_by_hand();
  void wait_until_ready();

  // The next message's kind; none where the other end is closed.
  std::optional<Kind> next(PhantomMessage& message) const {
    Received received = Received::nothing_yet;
    while (received == Received::nothing_yet && !is_alone(socket_, parent_))
      received = receive_message(socket_, kWatch, message);
    return received == Received::message ? std::optional(message.kind) : std::nullopt;
  }
  void tell(const std::string& words) const { send_words(socket_, Kind::told, words); }
  bool ask(const std::string& words) const {
    send_words(socket_, Kind::asked, words);
    PhantomMessage answer;
    return next(answer) == Kind::yes;
  }

  void expect_success(const char* step) {
    const hdapi::HDErrorInfo error = hdapi::drained(hd_);
    if (error.code == hdapi::kSuccess) return;
    std::array<char, 512> room{};
    throw Refused(hdapi::sentence({step, error, hd_.hdGetErrorString(error.code)}, room));
  }
  // What the driver has no answer to, stays unknown.
  bool knows() noexcept { return hdapi::drained(hd_).code == hdapi::kSuccess; }
  std::optional<double> number(hdapi::HDenum what) noexcept {
    std::array<double, 16> value{};
    value[0] = std::numeric_limits<double>::quiet_NaN();
    hd_.hdGetDoublev(what, value.data());
    return knows() ? std::optional(value[0]) : std::nullopt;
  }
  int whole(hdapi::HDenum what) noexcept {
    int value = 0;
    hd_.hdGetIntegerv(what, &value);
    return knows() ? value : 0;
  }
  template <std::size_t size>
  void copy_words(hdapi::HDenum what, std::array<char, size>& to) noexcept {
    const char* words = hd_.hdGetString(what);
    if (knows() && words) std::snprintf(to.data(), to.size(), "%s", words);
  }

  int socket_;
  pid_t parent_;
  PhantomShared& shared_;
  const std::string& name_;
  const PhantomOptions& options_;
  LastWords& last_words_;
  const hdapi::Functions& hd_;
  hdapi::HHD device_ = hdapi::kInvalidDevice;
  PhantomDescription description_;
  std::optional<RealTime> real_time_;
  std::unique_ptr<PhantomFrames> frames_;
  std::optional<hdapi::HDSchedulerHandle> callback_;
  hdapi::HDenum style_ = 0;
  double rate_ = 0;  // Hz
  bool scheduler_ = false;
};

void Host::open() {
  end_force_at_exit();
  hdapi::drained(hd_);
  device_ = hd_.hdInitDevice(name_.empty() ? nullptr : name_.c_str());
  const hdapi::HDErrorInfo error = hdapi::drained(hd_);
  if (error.code != hdapi::kSuccess || device_ == hdapi::kInvalidDevice) {
    hdapi::Trouble trouble{"initialising the PHANToM failed, and the driver says no more"};
    if (error.code != hdapi::kSuccess) trouble = {"initialising the PHANToM", error, hd_.hdGetErrorString(error.code)};
    throw Refused(hdapi::initialisation_advice(name_, trouble));
  }
  PhantomMessage message{.kind = Kind::described, .description = described()};
  description_ = message.description;
  send_message(socket_, message);
}

PhantomDescription Host::described() {
  PhantomDescription it;
  copy_words(hdapi::kModel, it.model);
  copy_words(hdapi::kSerialNumber, it.serial);
  copy_words(hdapi::kDriverVersion, it.driver);
  copy_words(hdapi::kFirmware, it.firmware);

  DriversLimits driver{.peak = number(hdapi::kMaxForce),
                       .continuous = number(hdapi::kContinuousForce),
                       .speed = number(hdapi::kVelocityLimit),
                       .impulse = number(hdapi::kImpulseLimit)};
  std::array<double, 16> box{};
  box.fill(std::numeric_limits<double>::quiet_NaN());
  hd_.hdGetDoublev(hdapi::kUsableWorkspace, box.data());
  if (knows()) driver.workspace = {box[0], box[1], box[2], box[3], box[4], box[5]};
  const auto limits = phantom_limits(driver);
  if (const auto* why = std::get_if<std::string>(&limits)) throw Refused(*why);
  const auto& [peak, continuous, speed, slew, low, high, words] = std::get<PhantomLimits>(limits);
  it.peak = peak;
  it.continuous = continuous;
  it.speed = speed;
  it.slew = slew;
  it.low = low;
  it.high = high;
  if (!words.empty()) tell(words);
  it.rate = std::max(0, whole(hdapi::kUpdateRate));
  it.gimbal = whole(hdapi::kInputDegrees) == 6;
  return it;
}

// In the vendor's order of preference, where a device has several: one that needs nobody first.
hdapi::HDenum Host::preferred_style() {
  const auto styles = static_cast<hdapi::HDenum>(whole(hdapi::kCalibrationStyles));
  for (const hdapi::HDenum style : {hdapi::kCalibratesItself, hdapi::kCalibratesInInkwell, hdapi::kCalibratesAtResetPose})
    if ((styles & style) != 0) return style;
  return 0;
}

// Before the scheduler runs. Each process has to, and no other program can do it for this one.
void Host::calibrate_by_hand() {
  for (int tries = 0; tries < 3; ++tries) {
    const hdapi::HDenum status = hd_.hdCheckCalibration();
    expect_success("checking the calibration");
    if (status == hdapi::kCalibrated) return;
    if (!ask(hdapi::kHoldInResetPose)) break;
    hd_.hdUpdateCalibration(hdapi::kCalibratesAtResetPose);
    expect_success("updating the calibration");
  }
  const hdapi::HDenum status = hd_.hdCheckCalibration();
  expect_success("checking the calibration");
  if (status != hdapi::kCalibrated) throw Refused(hdapi::kNotCalibrated);
}

void Host::start(double rate) {
  style_ = preferred_style();
  if (style_ == hdapi::kCalibratesAtResetPose) calibrate_by_hand();
  rate_ = std::round(rate);
  if (rate_ != description_.rate) {
    hd_.hdSetSchedulerRate(static_cast<hdapi::HDulong>(rate_));
    expect_success("setting the driver's rate (most devices have 1000 and 500 Hz)");
  }
  FrameSettings settings{.gimbal = description_.gimbal,
                         .style = style_,
                         .force = options_.force,
                         .patience = options_.patience,
                         .rate = rate_,
                         .window = std::max(1, static_cast<int>(rate_) / kMeasured),
                         .rate_tolerance = options_.rate_tolerance,
                         .longest_gap = std::chrono::duration<double>(options_.patience).count() / 2};
  frames_ = std::make_unique<PhantomFrames>(hd_, device_, settings, shared_);
  running = frames_.get();
  const auto tick = [](void* self) -> unsigned {
    if (!is_driver) meet_driver();
    return PhantomFrames::tick(self);
  };
  callback_ = hd_.hdScheduleAsynchronous(tick, frames_.get(), hdapi::kDefaultPriority);
  if (*callback_ == hdapi::kInvalidSchedulerHandle) callback_.reset();
  expect_success("scheduling the frames");

  // The driver's thread inherits this one's priority and processor.
  real_time_.emplace(processor_of_driver(), RealTime::kPriority + 5);
  // It may run although an error is reported: it is stopped either way.
  scheduler_ = true;
  last_words_.say_unless_taken_back(hdapi::kNoStart, options_.start);
  hd_.hdStartScheduler();
  end_force_at_exit();
  last_words_.take_back();
  expect_success("starting the driver's scheduler");
  wait_until_ready();
}

// What the user can expect of the device's frames.
const char* grade_of(const FrameTimes::Window& seen) noexcept {
  return seen.late <= 0.001 ? "good" : seen.late <= 0.02 ? "fair" : "poor: forces are held too long now and then";
}

std::string words_of(const FrameTimes::Window& seen) {
  std::array<char, 160> words{};
  std::snprintf(words.data(), words.size(), "%.1f frames a second, %.2f %% of them late, longest gap %.2f ms", seen.rate,
                100 * seen.late, 1000 * seen.longest_gap);
  return words.data();
}

std::string why_not_ready(const PhantomSample& sample, double rate) {
  if (sample.time == 0) return hdapi::kNoFrames;
  if (!sample.times) return "the PHANToM did not get ready in time: the driver runs its frames too slowly";
  if (!sample.answers && sample.times->rate > rate / 2) return hdapi::kNoAnswer;
  return "communication with the PHANToM is too irregular to switch forces on: expected " + csv::shortest(rate) +
         " frames a second and no long gap, got " + words_of(*sample.times) +
         ": check cable and power, and what else this machine computes";
}

void Host::wait_until_ready() {
  const Privileges& granted = real_time_->granted();
  tell(std::string("the driver's thread has ") +
       (granted.scheduling ? "real-time priority" : "ordinary priority, because real-time priority was refused") +
       (granted.cpu ? ", on processor " + std::to_string(*granted.cpu) : ""));
  const auto begin = std::chrono::steady_clock::now();
  auto calibrated_at = begin;
  bool told = false;
  for (;;) {
    std::this_thread::sleep_for(kPoll);
    if (is_alone(socket_, parent_)) throw Refused("the other process is gone");
    const PhantomSample& sample = frames_->samples.latest();
    const auto now = std::chrono::steady_clock::now();
    if (sample.troubled) throw Refused(shared_.trouble.data());
    if (sample.phase == PhantomSample::Phase::ready) {
      if (!sample.tells_temperature) tell(hdapi::kTemperatureUnknown);
      if (!sample.tells_rate) tell(hdapi::kRateUnknown);
      return tell(words_of(*sample.times) + ": " + grade_of(*sample.times));
    }
    if (sample.time == 0 || sample.calibrated) {
      if (now - calibrated_at > options_.start) throw Refused(why_not_ready(sample, rate_));
      continue;
    }
    if (!told)
      tell(std::string("waiting for the PHANToM's calibration: ") +
           (style_ == hdapi::kCalibratesItself ? hdapi::kMoveItAbout : hdapi::kRestInInkwell));
    told = true;
    calibrated_at = now;
    if (now - begin > options_.calibration) throw Refused(hdapi::kNotCalibrated);
  }
}

void Host::close() noexcept {
  if (scheduler_) {
    let_go();
    if (was_abandoned()) return;  // nor does any call of the driver's return now
    hd_.hdStopScheduler();
    hdapi::drained(hd_);
    // The scheduler ran no more frames. Now that it is stopped, this thread may switch the output off; a driver that does so at
    // the next frame ends the force when it disables the device, below.
    if (!frames_->closed()) {
      hd_.hdDisable(hdapi::kForceOutput);
      hdapi::drained(hd_);
    }
  }
  running = nullptr;
  if (callback_) {
    hd_.hdUnschedule(*callback_);
    hdapi::drained(hd_);
  }
  if (device_ == hdapi::kInvalidDevice) return;
  hd_.hdDisableDevice(device_);
  hdapi::drained(hd_);
}

}  // namespace

int run_phantom_host(int socket, pid_t parent, PhantomShared& shared, const std::string& name, const PhantomOptions& options) {
  be_a_process_of_its_own();
  socket = have_files_of_its_own(socket);
  // What the other threads still look at when this one returns lives as long as the process.
  auto& last_words = *new LastWords;
  auto& host = *new std::optional<Host>;
  std::thread(watch, socket, parent, std::ref(last_words)).detach();
  try {
    host.emplace(socket, parent, shared, name, options, last_words).hold();
    host->close();
    return host->was_abandoned() ? kStuck : kLetGo;
  } catch (const std::exception& error) {
    const bool of_ours = dynamic_cast<const Refused*>(&error) || dynamic_cast<const DeviceError*>(&error);
    const std::string why = (of_ours ? "" : "the vendor's library failed: ") + std::string(error.what());
    last_words.say_unless_taken_back(why, kEnding);
    if (host) host->close();
    send_words(socket, Kind::failed, why);
    return host && host->was_abandoned() ? kStuck : kRefused;
  }
}

}  // namespace forceshade::device
