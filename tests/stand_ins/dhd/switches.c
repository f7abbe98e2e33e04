// SPDX-License-Identifier: BSD-3-Clause
// The choices of FORCESHADE_STANDIN_DHD.

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stand_in.h"

const struct choice_entry kChoices[kSwitches] = {
    {"set-force-off", "error|ok", "a force while forces are off: -1 and NOT_ENABLED, or 0"},
    {"not-finite", "refuse|accept", "a force that is NaN or infinite: -1 and INVALID, or 0; neither gives a force"},
    {"watchdog", "0|NUMBER", "the watchdog of a device that was just opened, in units of 125 us; 0 is off"},
    {"watchdog-works", "yes|no", "dhdSetWatchdog: 0, or -1 and NOT_IMPLEMENTED"},
    {"time-guard", "0|NUMBER", "us: a position that is read sooner after the last one is that one, and the result is 1"},
    {"unplugged", "error|block|stale",
     "calls of a device that was unplugged: -1 and COM, no return, or 0 and the last position"},
    {"last-error", "thread|process", "the owner of the error that dhdErrorGetLast returns"},
    {"error-kept", "yes|no", "the last error outlives a call that succeeds"},
    {"expert", "process|thread", "the extent of expert mode"},
    {"status-length", "17|16", "the count of numbers that dhdGetStatus writes"},
    {"brakes", "on|off", "the brakes of a device that was just opened"},
    {"forces", "off|on", "the forces of a device that was just opened"},
    {"enable-uncalibrated", "error|ok", "dhdEnableForce before the calibration: -1 and DEVICE_NOT_READY, or 0"},
    {"max-force", "scale|ignore", "a force beyond dhdSetMaxForce: shortened, and the result is 2; or as it is"},
    {"call-time", "0|NUMBER", "us that a reading and a force each take"},
    {"model", "omega.3|delta.3|omega.6|omega.7|omega.7-left|sigma.3|sigma.7|lambda.3|lambda.7|falcon", "the device"},
    {"serial", "1234|NUMBER", "its serial number; that of a Falcon is 65535"},
    {"calibrated", "yes|no", "it is calibrated when it is opened"},
    {"available", "yes|no", "no: another program has locked it"},
    {"pressed", "no|yes", "its button is down"},
    {"clock", "real|NUMBER",
     "the hand moves by the time, or at each reading by the period of so many Hz, for runs faster than real time"},
    {"longest-gap", "20|NUMBER", "ms without a force while forces are on; more is a fault"},
    {"most-force", "100|NUMBER", "N, beyond which a force is absurd"},
};

const struct event_entry kEventTable[kEvents] = {
    {"unplug", "the device is gone"},
    {"late", "the reading takes 100 ms"},
    {"nan", "a position that is not a number"},
    {"garbage", "a position of 1e30 m"},
    {"wrong-unit", "a position in mm"},
    {"jump", "a position that is 50 mm off, once"},
    {"force-button", "the user switches the forces off by the force button"},
    {"overspeed", "the device switches the forces off: it was too fast"},
    {"usb", "the device switches the forces off: communication was bad"},
    {"deadman", "the device switches the forces off: the dead-man switch was released"},
    {"saturate", "the motors are saturated: the next force is shortened, and the result is 2"},
    {"time-guard", "the reading is the last one, and the result is 1"},
    {"read-error", "the reading fails with COM"},
    {"force-error", "the next force fails with COM"},
    {"uncalibrated", "the device waits for its calibration, as from then on"},
    {"calibrated", "it was calibrated"},
    {"press", "its button goes down, or up again"},
    {"power-off", "its power is off: forces are off, too"},
    {"error", "its status has an error"},
};

enum { kValueLength = 24 };
static char values[kSwitches][kValueLength];
static struct {
  enum event event;
  uint64_t reading;
} orders[kMostOrders];
static size_t order_count = 0;
static char complaint[400];

const char* chosen(enum choice choice) {
  return values[choice];
}

bool is_chosen(enum choice choice, const char* value) {
  return strcmp(values[choice], value) == 0;
}

double number_chosen(enum choice choice) {
  return strtod(values[choice], NULL);
}

static bool may_be(const char* allowed, const char* value) {
  const size_t size = strlen(value);
  for (const char* at = allowed; *at;) {
    const size_t length = strcspn(at, "|");
    if (length == size && strncmp(at, value, size) == 0 && strcmp(value, "NUMBER") != 0) return true;
    at += length + (at[length] == '|');
  }
  char* end = NULL;
  return strstr(allowed, "NUMBER") && size > 0 && strtod(value, &end) >= 0 && *end == '\0';
}

static const char* choose(const char* name, const char* value) {
  for (int i = 0; i < kSwitches; ++i) {
    if (strcmp(kChoices[i].name, name) != 0) continue;
    if (strlen(value) < kValueLength && may_be(kChoices[i].values, value)) {
      strcpy(values[i], value);
      return NULL;
    }
    snprintf(complaint, sizeof complaint, "%s: expected %s, got \"%.40s\"", name, kChoices[i].values, value);
    return complaint;
  }
  snprintf(complaint, sizeof complaint, "\"%.40s\" is no assumption: --help lists them", name);
  return complaint;
}

static const char* order(const char* name, const char* reading) {
  char* end = NULL;
  const unsigned long long number = strtoull(reading, &end, 10);
  const bool at_contact = strcmp(reading, "contact") == 0;
  for (int i = 0; i < kEvents; ++i) {
    if (strcmp(kEventTable[i].name, name) != 0) continue;
    if (order_count == kMostOrders || (!at_contact && (number < 1 || *end != '\0'))) {
      snprintf(complaint, sizeof complaint, "%s: expected contact or the number of a reading from 1, got \"%.40s\"", name,
               reading);
      return complaint;
    }
    orders[order_count].event = (enum event)i;
    orders[order_count++].reading = at_contact ? 0 : number;
    return NULL;
  }
  snprintf(complaint, sizeof complaint, "\"%.40s\" is no event: --help lists them", name);
  return complaint;
}

const char* read_settings(const char* text) {
  for (int i = 0; i < kSwitches; ++i) {
    const size_t length = strcspn(kChoices[i].values, "|");
    memcpy(values[i], kChoices[i].values, length);
    values[i][length] = '\0';
  }
  order_count = 0;
  char all[1024];
  snprintf(all, sizeof all, "%s", text);
  char* rest = NULL;
  for (char* word = strtok_r(all, ", ", &rest); word; word = strtok_r(NULL, ", ", &rest)) {
    char* const mark = strpbrk(word, "=@");
    const bool is_event = mark && *mark == '@';
    if (mark) *mark = '\0';
    const char* wrong = is_event ? order(word, mark + 1) : choose(word, mark ? mark + 1 : "");
    if (wrong) return wrong;
  }
  return NULL;
}

void events_at(uint64_t reading, void (*happen)(enum event)) {
  for (size_t i = 0; i < order_count; ++i)
    if (orders[i].reading == reading) happen(orders[i].event);
}
