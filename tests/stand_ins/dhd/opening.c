// SPDX-License-Identifier: BSD-3-Clause
// Counting, opening, describing and closing the device.

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "stand_in.h"

static const struct {
  const char *name, *full;
  int type;
  bool is_left, has_wrist, has_gripper;
} models[] = {
    {"omega.3", "omega.3", 33, false, false, false},   {"delta.3", "delta.3", 63, false, false, false},
    {"omega.6", "omega.6", 34, false, true, false},    {"omega.7", "omega.7", 35, false, true, true},
    {"omega.7-left", "omega.7", 37, true, true, true}, {"sigma.3", "sigma.3", 206, false, false, false},
    {"sigma.7", "sigma.7", 104, false, true, true},    {"lambda.3", "lambda.3", 203, false, false, false},
    {"lambda.7", "lambda.7", 108, false, true, true},  {"falcon", "Falcon", 60, false, false, false},
};

static int model(void) {
  for (int i = 0; i < (int)(sizeof models / sizeof *models); ++i)
    if (is_chosen(MODEL, models[i].name)) return i;
  return 0;
}

bool has_gripper(void) {
  return models[model()].has_gripper;
}

static int serial(void) {
  return is_chosen(MODEL, "falcon") ? 65535 : (int)number_chosen(SERIAL);
}

static bool is_locked(void) {
  const bool others = state->owner != 0 && state->owner != getpid() && kill(state->owner, 0) == 0;
  return others || is_chosen(AVAILABLE, "no");
}

static int opened(bool is_there) {
  if (state->owner == getpid()) {
    fault(FAULT_OPENED_TWICE, "%s", "");
    return call_ends(-1, ERROR_IN_USE);
  }
  if (!is_there) return call_ends(-1, ERROR_NO_DEVICE);
  if (is_locked()) return call_ends(-1, ERROR_NOT_AVAILABLE);
  ++state->session_count;
  memset(session(), 0, sizeof *session());
  session()->opened_ns = now_ns();
  state->owner = getpid();
  device_opened();
  note("opened");
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetDeviceCount(void) {
  lock();
  return call_ends(1, ERROR_NONE);
}

PUBLISHED int dhdGetAvailableCount(void) {
  lock();
  return call_ends(is_locked() ? 0 : 1, ERROR_NONE);
}

PUBLISHED int dhdOpen(void) {
  lock();
  return opened(true);
}

PUBLISHED int dhdOpenID(signed char index) {
  lock();
  if (index != 0) fault(FAULT_BAD_ID, "dhdOpenID: %d", index);
  return opened(index == 0);
}

PUBLISHED int dhdOpenSerial(int number) {
  lock();
  return opened(number == serial() && number != 65535);
}

PUBLISHED int dhdOpenType(int type) {
  lock();
  return opened(type == models[model()].type);
}

// Closes the device, but does not switch its forces off.
PUBLISHED int dhdClose(signed char id) {
  lock();
  ++session()->calls;
  if (state->owner != getpid() || (id != -1 && id != 0)) {
    fault(state->owner == getpid()   ? FAULT_BAD_ID
          : state->session_count > 0 ? FAULT_AFTER_CLOSE
                                     : FAULT_NOT_OPEN,
          "%s", "dhdClose");
    return call_ends(-1, ERROR_NO_DEVICE);
  }
  device_advance();
  if (state->forces_on && state->plugged) fault(FAULT_NO_STOP, "%s", "");
  if (length(state->arm.force) > small()) fault(FAULT_FORCE_AT_END, "%.3f N", length(state->arm.force));
  session()->closed_ns = now_ns();
  session()->force_at_end = length(state->arm.force);
  state->owner = 0;
  note("closed");
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdStop(signed char id) {
  if (!call_begins("dhdStop", id)) return -1;
  if (length(state->arm.force) > small()) fault(FAULT_FORCE_AT_END, "%.3f N", length(state->arm.force));
  state->forces_on = false;
  state->brakes_on = true;
  memset(state->commanded, 0, sizeof state->commanded);
  device_advance();
  note("stopped");
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetDeviceID(void) {
  if (!call_begins("dhdGetDeviceID", -1)) return -1;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdSetDevice(signed char id) {
  if (!call_begins("dhdSetDevice", id)) return -1;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetSerialNumber(unsigned short* number, signed char id) {
  if (!call_begins("dhdGetSerialNumber", id)) return -1;
  if (!number) {
    fault(FAULT_NULL, "%s", "dhdGetSerialNumber");
    return call_ends(-1, ERROR_NULL);
  }
  *number = (unsigned short)serial();
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetSystemType(signed char id) {
  if (!call_begins("dhdGetSystemType", id)) return -1;
  return call_ends(models[model()].type, ERROR_NONE);
}

PUBLISHED const char* dhdGetSystemName(signed char id) {
  if (!call_begins("dhdGetSystemName", id)) return NULL;
  const char* const name = models[model()].full;
  call_ends(0, ERROR_NONE);
  return name;
}

static bool says(const char* function, signed char id, bool what) {
  if (!call_begins(function, id)) return false;
  call_ends(0, ERROR_NONE);
  return what;
}

PUBLISHED bool dhdIsLeftHanded(signed char id) {
  return says("dhdIsLeftHanded", id, models[model()].is_left);
}

PUBLISHED bool dhdHasBase(signed char id) {
  return says("dhdHasBase", id, true);
}

PUBLISHED bool dhdHasWrist(signed char id) {
  return says("dhdHasWrist", id, models[model()].has_wrist);
}

PUBLISHED bool dhdHasActiveWrist(signed char id) {
  return says("dhdHasActiveWrist", id, models[model()].type >= 104 && models[model()].has_wrist);
}

PUBLISHED bool dhdHasGripper(signed char id) {
  return says("dhdHasGripper", id, has_gripper());
}

PUBLISHED bool dhdHasActiveGripper(signed char id) {
  return says("dhdHasActiveGripper", id, has_gripper());
}
