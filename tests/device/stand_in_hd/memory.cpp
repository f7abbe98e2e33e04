// SPDX-License-Identifier: BSD-3-Clause
#include "tests/device/stand_in_hd/memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <new>
#include <system_error>
#include <thread>

namespace forceshade::stand_in_hd {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void* mapped(int file) {
  const int flags = file < 0 ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED;
  void* address = mmap(nullptr, sizeof(Memory), PROT_READ | PROT_WRITE, flags, file, 0);
  if (address == MAP_FAILED) fail("mapping the stand-in's memory");
  return address;
}

}  // namespace

Memory& made(int* file) {
  if (file) {
    *file = memfd_create("stand_in_hd", MFD_CLOEXEC);
    if (*file < 0 || ftruncate(*file, sizeof(Memory)) != 0) fail("making the stand-in's memory");
  }
  auto& memory = *new (mapped(file ? *file : -1)) Memory;
  pthread_mutexattr_t shared_and_robust;
  pthread_mutexattr_init(&shared_and_robust);
  pthread_mutexattr_setpshared(&shared_and_robust, PTHREAD_PROCESS_SHARED);
  pthread_mutexattr_setrobust(&shared_and_robust, PTHREAD_MUTEX_ROBUST);
  pthread_mutex_init(&memory.mutex, &shared_and_robust);
  pthread_mutexattr_destroy(&shared_and_robust);
  memory.orders = first_orders();
  return memory;
}

Memory& opened(const std::string& path) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) fail(path);
  auto& memory = *static_cast<Memory*>(mapped(file));
  close(file);
  return memory;
}

Lock::Lock(Memory& memory) : memory_(memory) {
  // Tried again and again: of the calls that lock, it is the one of which the thread sanitizer follows that the owner has died.
  int result = pthread_mutex_trylock(&memory.mutex);
  for (const auto latest = Clock::now() + std::chrono::seconds(2); result == EBUSY && Clock::now() < latest;
       result = pthread_mutex_trylock(&memory.mutex))
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  if (result == EOWNERDEAD) pthread_mutex_consistent(&memory.mutex);
  held_ = result == 0 || result == EOWNERDEAD;
}

Lock::~Lock() {
  if (held_) pthread_mutex_unlock(&memory_.mutex);
}

bool lives(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text, '\0');                // empty where the process ended after the file was opened
  const std::size_t name_end = text.rfind(')');  // the state follows the name, which may have any character
  if (name_end == std::string::npos || name_end + 2 >= text.size()) return false;
  const char state = text[name_end + 2];
  return state != 'Z' && state != 'X';
}

Orders first_orders() {
  Orders orders;
  if (const char* code = std::getenv("STAND_IN_HD_INIT"))
    orders.init = static_cast<hdapi::HDerror>(std::strtoul(code, nullptr, 0));
  return orders;
}

}  // namespace forceshade::stand_in_hd
