// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of Force Dimension's DHD 3.x that forceshade calls, declared in our own words: a C interface is fixed by its names,
// types and numbers, and the vendor's headers may not be passed on. Nothing links to these functions; dhd_library.h looks them
// up at run time.
//
// Results: 0 or more is success, for some with a meaning; -1 is a failure, whose number dhdErrorGetLast() gives on the thread
// of the call. Units: m, N, kg, s. Axes: x towards the operator, y to the operator's right, z up.

namespace forceshade::device::dhd {

// The vendor declares a plain char, in which -1 is the default device. It is signed where the vendor's library is built.
using Id = signed char;
inline constexpr Id kDefault = -1;

// Positive results, which are no errors.
inline constexpr int kTimeGuard = 1;  // the position is the last one again: it was read too soon
inline constexpr int kSaturated = 2;  // the motors cannot give the force: it was shortened, with its direction kept

// Places in what dhdGetStatus writes. Its length is 17, and 16 before; room for more does no harm.
inline constexpr int kStatusRoom = 32;
inline constexpr int kPower = 0, kConnected = 1, kReset = 3, kForce = 5, kError = 9, kForceOffCause = 14;

inline constexpr int kNotEnabled = 19;               // an error: forces are off
inline constexpr unsigned kFalconsSerial = 65535;    // every Falcon says it has this one
inline constexpr double kWatchdogUnit = 0.125;       // ms
inline constexpr unsigned char kMostWatchdog = 255;  // units: 31.875 ms

extern "C" {
int dhdGetDeviceCount();
int dhdGetAvailableCount();  // without those that other programs have locked
int dhdOpenID(Id index);     // from 0; these two give the device's ID
int dhdOpenSerial(int);
int dhdClose(Id);
int dhdStop(Id);  // forces off, electromagnetic brakes on
int dhdGetSerialNumber(unsigned short*, Id);
int dhdGetSystemType(Id);
const char* dhdGetSystemName(Id);
bool dhdIsLeftHanded(Id);
bool dhdHasGripper(Id);
int dhdGetGripperGap(double* metres, Id);
int dhdGetStatus(int*, Id);
int dhdEnableForce(unsigned char on, Id);
int dhdSetBrakes(int on, Id);
int dhdSetGravityCompensation(int on, Id);
int dhdSetMaxForce(double newtons, Id);  // negative: none
int dhdGetPosition(double* x, double* y, double* z, Id);
int dhdSetForce(double x, double y, double z, Id);
unsigned dhdGetButtonMask(Id);
int dhdEnableExpertMode();
int dhdSetWatchdog(unsigned char units, Id);  // in expert mode; 0 is off
int dhdErrorGetLast();
const char* dhdErrorGetLastStr();
}

#define FORCESHADE_DHD_FUNCTIONS(X) \
  X(dhdGetDeviceCount)              \
  X(dhdGetAvailableCount)           \
  X(dhdOpenID)                      \
  X(dhdOpenSerial)                  \
  X(dhdClose)                       \
  X(dhdStop)                        \
  X(dhdGetSerialNumber)             \
  X(dhdGetSystemType)               \
  X(dhdGetSystemName)               \
  X(dhdIsLeftHanded)                \
  X(dhdHasGripper)                  \
  X(dhdGetGripperGap)               \
  X(dhdGetStatus)                   \
  X(dhdEnableForce)                 \
  X(dhdSetBrakes)                   \
  X(dhdSetGravityCompensation)      \
  X(dhdSetMaxForce)                 \
  X(dhdGetPosition)                 \
  X(dhdSetForce)                    \
  X(dhdGetButtonMask)               \
  X(dhdEnableExpertMode)            \
  X(dhdSetWatchdog)                 \
  X(dhdErrorGetLast)                \
  X(dhdErrorGetLastStr)

}  // namespace forceshade::device::dhd
