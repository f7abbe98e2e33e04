// SPDX-License-Identifier: BSD-3-Clause
// The findings about a driver's files and a device's nodes, and the words that report them.

#include "device/check.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "device/machine.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::device {
namespace {

namespace fs = std::filesystem;
using tests::TemporaryDirectory;

// For as long as this lives; without a value the variable is not set.
class Environment {
 public:
  Environment(const char* name, const std::optional<std::string>& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Environment() { set(old_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const std::optional<std::string>& value) const {
    if (value)
      ::setenv(name_, value->c_str(), 1);
    else
      ::unsetenv(name_);
  }
  const char* name_;
  std::optional<std::string> old_;
};

void expect(const Check& check, Grade grade, const std::vector<std::string>& all_words) {
  EXPECT_EQ(name_of(check.grade), name_of(grade)) << check.words;
  for (const std::string& words : all_words)
    EXPECT_NE(check.words.find(words), std::string::npos) << words << '\n' << check.words;
}

TEST(driver_folder, holds_a_file_for_each_device_and_is_where_the_driver_looks) {
  const TemporaryDirectory here;
  fs::create_directories(here.file("config/folder.config"));
  for (const char* name : {"config/Left arm", "config/Default Device.config", "config/b.config.old"}) here.write(name, "x");
  const Environment home("GTDD_HOME", here.path());
  const DriverFolder found = driver_folder();
  EXPECT_EQ(found.path, here.file("config"));
  EXPECT_EQ(found.problem, "");
  EXPECT_EQ(found.names, (std::vector<std::string>{"Default Device", "Left arm", "b.config.old"}));
}

TEST(driver_folder, is_below_the_home_directory_where_nothing_else_is_said) {
  const TemporaryDirectory here;
  const Environment none("GTDD_HOME", std::nullopt), home("HOME", here.path());
  EXPECT_EQ(driver_folder().path, here.file(".3dsystems/config"));
  EXPECT_NE(driver_folder().problem.find(here.file(".3dsystems/config") + ": No such file or directory"), std::string::npos);
  EXPECT_FALSE(fs::exists(here.file(".3dsystems")));
  const Environment no_home("HOME", std::nullopt);
  EXPECT_NE(driver_folder().problem.find("neither GTDD_HOME nor HOME is set"), std::string::npos);
}

TEST(check, of_a_name_says_which_there_are) {
  const DriverFolder two{"/f", "", {"Default Device", "Left arm"}};
  expect(check_name(two, ""), Grade::ok, {"/f holds Default Device, Left arm"});
  expect(check_name(two, "Left arm"), Grade::ok, {"Left arm"});
  expect(check_name(two, "Right arm"), Grade::wrong, {"/f holds Default Device, Left arm", "not \"Right arm\""});
  expect(check_name({"/f", "", {}}, ""), Grade::wrong, {"/f holds none", "set-up program"});
  expect(check_name({"/f", "/f: No such file or directory", {}}, "x"), Grade::unknown, {"/f: No such"});
}

// A made-up machine: a Touch on USB, a keyboard, something on FireWire, and other nodes.
TEST(check, of_device_nodes_finds_the_vendors_by_its_numbers) {
  const TemporaryDirectory machine;
  for (const char* folder : {"dev", "sys/usb/touch/port", "sys/usb/keyboard/port", "sys/class/tty/ttyACM3",
                             "sys/class/hidraw/hidraw0", "sys/class/tty/ttyACM4"})
    fs::create_directories(machine.file(folder));
  for (const char* node : {"ttyACM3", "ttyACM4", "hidraw0", "fw12", "fwx", "hidraw", "ttyS0"})
    machine.write(std::string("dev/") + node, "");
  machine.write("sys/usb/touch/idVendor", "2988\n");
  machine.write("sys/usb/keyboard/idVendor", "0301\n");
  machine.write("sys/usb/keyboard/idProduct", "0001\n");
  fs::create_symlink(machine.file("sys/usb/touch/port"), machine.file("sys/class/tty/ttyACM3/device"));
  fs::create_symlink(machine.file("sys/usb/keyboard/port"), machine.file("sys/class/hidraw/hidraw0/device"));
  const std::vector<DeviceNode> nodes = device_nodes(machine.path());
  std::vector<std::string> paths, vendors;
  for (const DeviceNode& node : nodes) {
    paths.push_back(node.path);
    if (node.vendors) vendors.push_back(node.path);
    EXPECT_TRUE(node.accessible) << node.path;
    EXPECT_NE(node.group, "") << node.path;
  }
  EXPECT_EQ(paths, (std::vector<std::string>{"/dev/fw12", "/dev/hidraw0", "/dev/ttyACM3", "/dev/ttyACM4"}));
  EXPECT_EQ(vendors, std::vector<std::string>{"/dev/ttyACM3"});
  machine.write("sys/usb/keyboard/idProduct", "2988\n");
  EXPECT_TRUE(device_nodes(machine.path())[1].vendors);
  machine.write("sys/usb/keyboard/idVendor", "046d\n");  // another vendor's number for one of its products
  EXPECT_FALSE(device_nodes(machine.path())[1].vendors);
  EXPECT_EQ(device_nodes(machine.file("nowhere")).size(), 0U);
}

TEST(check, of_device_nodes_says_which_group_to_join) {
  const DeviceNode touch{"/dev/ttyACM0", false, "dialout", true}, keyboard{"/dev/hidraw0", true, "root", false};
  expect(check_nodes({keyboard, touch}), Grade::wrong, {"/dev/ttyACM0", "sudo adduser $USER dialout"});
  expect(check_nodes({{"/dev/hidraw1", false, "root", true}}), Grade::wrong, {"/dev/hidraw1", "udev rule"});
  expect(check_nodes({{"/dev/ttyACM0", true, "dialout", true}}), Grade::ok, {"/dev/ttyACM0 can be read and written"});
  expect(check_nodes({{"/dev/ttyACM0", true, "dialout", true}, {"/dev/ttyACM1", false, "dialout", true}}), Grade::wrong,
         {"/dev/ttyACM1", "sudo adduser $USER dialout"});
  expect(check_nodes({keyboard, {"/dev/fw1", false, "video", false}}), Grade::unknown,
         {"none is known", "adduser $USER video"});
  expect(check_nodes({}), Grade::unknown, {"/dev/ttyACM*"});
}

TEST(check, of_what_a_device_says_of_itself_says_what_it_does_not_say) {
  expect(check_identity({.model = "Touch", .serial = "0050C", .driver = "2023.11.15"}), Grade::ok,
         {"model Touch", "serial number 0050C", "driver 2023.11.15", "firmware not given"});
  expect(check_identity({.model = ""}), Grade::wrong, {"model not given"});
}

TEST(machine, is_read_from_the_files_of_the_system) {
  const TemporaryDirectory here;
  EXPECT_FALSE(this_machine(here.path()).real_time_kernel);
  EXPECT_TRUE(this_machine(here.path()).governors.empty());
  const std::string processors = here.file("sys/devices/system/cpu");
  for (const auto& [processor, governor] :
       {std::pair{"cpu0", "powersave\n"}, {"cpu1", "performance\n"}, {"cpu10", "powersave\n"}}) {
    fs::create_directories(fs::path(processors) / processor / "cpufreq");
    std::ofstream(fs::path(processors) / processor / "cpufreq/scaling_governor") << governor;
  }
  fs::create_directories(here.file("sys/kernel"));
  here.write("sys/kernel/realtime", "1\n");
  const Machine machine = this_machine(here.path());
  EXPECT_TRUE(machine.real_time_kernel);
  EXPECT_EQ(machine.governors, (std::vector<std::string>{"performance", "powersave"}));
  here.write("sys/kernel/realtime", "0\n");
  EXPECT_FALSE(this_machine(here.path()).real_time_kernel);
}

TEST(machine, is_told_what_to_type_for_each_setting_that_is_lacking) {
  const auto checks = [](const Machine& machine, bool scheduling, bool memory, std::optional<double> latest = {}) {
    Observed seen;
    seen.granted = {.scheduling = scheduling, .memory_locked = memory, .cpu = {}};
    seen.latest_waking = latest;
    return machine_checks(machine, seen, 1000);
  };
  for (const Check& check : checks({true, 90, {"performance"}}, true, true, 0.999)) expect(check, Grade::ok, {});
  const std::vector<Check> lacking = checks({false, 79, {"performance", "powersave"}}, false, false, 1.0);
  ASSERT_EQ(lacking.size(), 5U);
  expect(lacking[0], Grade::lacking, {"1.000 ms late; expected less than its period, 1 ms"});
  expect(lacking[1], Grade::lacking, {"sudo apt-get install linux-image-rt-amd64"});
  expect(lacking[2], Grade::lacking, {"ulimit -r is 79 and not 80", "- rtprio 90", "/etc/security/limits.d/realtime.conf"});
  expect(lacking[3], Grade::lacking, {"not locked", "- memlock unlimited"});
  expect(lacking[4], Grade::lacking, {"performance, powersave: sudo cpupower frequency-set --governor performance"});
  const std::vector<Check> unknown = checks({true, 80, {}}, false, true);
  expect(unknown[0], Grade::unknown, {"the device's frames"});
  expect(unknown[2], Grade::lacking, {"--cap-add SYS_NICE", "cpu.rt_runtime_us"});
  expect(unknown[4], Grade::unknown, {"virtual machines"});
}

}  // namespace
}  // namespace forceshade::device
