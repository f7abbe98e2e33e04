// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/usb.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

namespace forceshade::device::dhd {
namespace {

namespace fs = std::filesystem;

std::string word_in(const fs::path& file) {
  std::string word;
  std::ifstream(file) >> word;
  return word;
}

// A number of the USB as the names of nodes have it: with three digits.
std::string with_zeros(const std::string& number) {
  return std::string(3 - std::min<std::size_t>(3, number.size()), '0') + number;
}

}  // namespace

std::vector<UsbDevice> usb_devices(const fs::path& root) {
  std::vector<UsbDevice> found;
  std::error_code error;
  for (fs::directory_iterator entry(root / "sys/bus/usb/devices", error), end; !error && entry != end; entry.increment(error)) {
    const std::string vendor = word_in(entry->path() / "idVendor"), product = word_in(entry->path() / "idProduct");
    if (vendor != "1451" && !(vendor == "0403" && product == "cb48")) continue;
    const std::string node =
        "dev/bus/usb/" + with_zeros(word_in(entry->path() / "busnum")) + '/' + with_zeros(word_in(entry->path() / "devnum"));
    const bool accessible = ::faccessat(AT_FDCWD, (root / node).c_str(), R_OK | W_OK, AT_EACCESS) == 0;
    found.push_back({vendor + ':' + product, '/' + node, accessible});
  }
  std::ranges::sort(found, {}, &UsbDevice::node);
  return found;
}

}  // namespace forceshade::device::dhd
