// SPDX-License-Identifier: BSD-3-Clause
#include "device/command/command.h"

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

#include "device/command/command_messages.h"
#include "files/child_process.h"
#include "system/process.h"

namespace forceshade::device {
namespace {

using files::LineProgram;
using files::ProcessFailed;
using std::chrono::milliseconds;

constexpr milliseconds kToEnd{1000};  // for the program to end by itself, before it is ended

class CommandLink final : public FrameLink {
 public:
  CommandLink(std::unique_ptr<LineProgram> program, int buttons, const FramedOptions& options)
      : program_(std::move(program)), answers_(buttons), may_force_(options.force) {
    program_->set_answer_time(options.answer);
  }

  FrameState exchange(const Eigen::Vector3d& force) override {
    FrameState state;
    try {
      state = answers_.state_of(program_->ask(command::line_of(may_force_ ? force : Eigen::Vector3d::Zero())));
    } catch (const ProcessFailed& failure) {
      throw ProcessFailed(std::string(failure.what()) + ". If the device still pushes, switch it off");
    }
    if (!state.forces_on) state.forces_off = "its program reports that they are off";
    state.forces_on = state.forces_on && may_force_;
    return state;
  }

  void close() noexcept override {
    end_ = program_->dismiss(command::line_of(Eigen::Vector3d::Zero()) + '\n' + command::kEnd + '\n');
  }

  std::string remark() const override { return end_ == "ended" ? "" : "it " + end_; }

 private:
  system::KilledFirst first_;  // and not the program, which reads the end of its input then and ends the force
  std::unique_ptr<LineProgram> program_;
  command::Answers answers_;
  bool may_force_;
  std::string end_;  // the way in which the program ended
};

}  // namespace

files::ProcessLimits command::limits_of(const FramedOptions& options) {
  constexpr auto kAny = std::numeric_limits<std::uint32_t>::max();
  return {.answer = options.open,
          .longest_line = std::size_t{1} << 16U,
          .memory = std::numeric_limits<std::size_t>::max(),
          .processor_seconds = kAny,
          .file_megabytes = kAny,
          .grace = std::max(kToEnd, options.end)};
}

std::unique_ptr<Device> command::open(std::unique_ptr<LineProgram> program, const FramedOptions& options,
                                      Attendant& attendant) {
  const Hello hello = hello_of(program->hear());
  FramedOptions its = options;
  its.device_paces = hello.paces;
  const int buttons = hello.description.capabilities.buttons;
  return std::make_unique<FramedDevice>(std::make_unique<CommandLink>(std::move(program), buttons, options), hello.description,
                                        its, attendant);
}

std::unique_ptr<Device> open_command(const std::string& command, const FramedOptions& options, Attendant& attendant) try {
  return command::open(std::make_unique<files::ChildProcess>(command, command::limits_of(options), command::kWhose), options,
                       attendant);
} catch (const ProcessFailed& failure) {
  throw DeviceError(failure.what());
} catch (const std::system_error& error) {
  throw DeviceError(std::string("the program's process could not be made: ") + error.what());
}

std::unique_ptr<Device> open_command(const std::string& command, Attendant& attendant, Forces forces) {
  FramedOptions options = kCommandOptions;
  options.force = forces == Forces::as_commanded;
  return open_command(command, options, attendant);
}

}  // namespace forceshade::device
