// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of the vendor's HDAPI (OpenHaptics 3.x, 64-bit) that forceshade calls, declared in our own words: a C interface is
// fixed by its names, types and numbers, and the vendor's headers may not be passed on. Nothing links to these functions;
// hdapi_library.h looks them up at run time.
//
// Source: the names and numbers that the vendor's programmer's guide and reference document. Those marked (r) were not
// checked against a second source. Frame: x right, y up, z to the user.

namespace forceshade::device::hdapi {

using HHD = unsigned;
using HDenum = unsigned;
using HDerror = unsigned;
using HDboolean = unsigned char;
using HDlong = long;
using HDulong = unsigned long;
using HDushort = unsigned short;
using HDSchedulerHandle = unsigned long;
using HDCallback = unsigned (*)(void*);

struct HDErrorInfo {
  HDerror code;
  int internal;  // the driver's own number
  HHD device;
};

inline constexpr HHD kInvalidDevice = 0xFFFFFFFF;
inline constexpr HDSchedulerHandle kInvalidSchedulerHandle = 0xFFFFFFFF;  // (r)
inline constexpr unsigned kCallbackContinue = 1;
inline constexpr HDushort kDefaultPriority = 32767;  // of 0 to 65535

// The parameters of hdGet and hdSet; doubles where no other type is given.
inline constexpr HDenum kButtons = 0x2000;            // int, one bit each
inline constexpr HDenum kSafetySwitch = 0x2001;       // boolean
inline constexpr HDenum kInkwellSwitch = 0x2002;      // boolean
inline constexpr HDenum kEncoders = 0x2010;           // 6 longs: the arm's three, the gimbal's
inline constexpr HDenum kPosition = 0x2050;           // 3, mm
inline constexpr HDenum kJointAngles = 0x2100;        // 3, rad
inline constexpr HDenum kGimbalAngles = 0x2150;       // 3, rad
inline constexpr HDenum kVersion = 0x2500;            // string: the library's; those below are the device's
inline constexpr HDenum kModel = 0x2501;              // string
inline constexpr HDenum kDriverVersion = 0x2502;      // string
inline constexpr HDenum kVendor = 0x2503;             // string
inline constexpr HDenum kSerialNumber = 0x2504;       // string
inline constexpr HDenum kFirmware = 0x2505;           // string (r)
inline constexpr HDenum kUsableWorkspace = 0x2551;    // 6, mm: lowest x, y, z, highest x, y, z
inline constexpr HDenum kInputDegrees = 0x2553;       // int: 6 with a gimbal that is measured
inline constexpr HDenum kOutputDegrees = 0x2554;      // int: the number of motors, 3 or 6
inline constexpr HDenum kCalibrationStyles = 0x2555;  // int, bits below
inline constexpr HDenum kUpdateRate = 0x2600;         // int, Hz
inline constexpr HDenum kInstantaneousRate = 0x2601;  // int, Hz: 0 when the device does not answer
inline constexpr HDenum kMaxForce = 0x2603;           // 1, N
inline constexpr HDenum kContinuousForce = 0x2604;    // 1, N
inline constexpr HDenum kMotorTemperature = 0x2605;   // as many as there are motors: predicted, 0 to 1
inline constexpr HDenum kVelocityLimit = 0x2606;      // 1, mm/s: the driver ends a run beyond it
inline constexpr HDenum kImpulseLimit = 0x2607;       // 1, N/ms: the driver ends a run beyond it
inline constexpr HDenum kForce = 0x2700;              // 3, N

inline constexpr HDenum kForceOutput = 0x4000;  // for hdEnable, hdDisable, hdIsEnabled

inline constexpr HDenum kCalibrated = 0x5000, kCalibrationNeedsUpdate = 0x5001, kCalibrationNeedsHand = 0x5002;
inline constexpr HDenum kCalibratesAtResetPose = 1, kCalibratesItself = 2, kCalibratesInInkwell = 4;  // styles (r)

inline constexpr HDerror kSuccess = 0;
inline constexpr HDerror kInvalidEnum = 0x100, kInvalidValue = 0x101, kInvalidOperation = 0x102, kInvalidInputType = 0x103,
                         kBadHandle = 0x104;
inline constexpr HDerror kWarmMotors = 0x200, kExceededForce = 0x201, kExceededImpulse = 0x202, kExceededVelocity = 0x203,
                         kForceError = 0x204;
inline constexpr HDerror kDeviceFault = 0x300, kAlreadyInitiated = 0x301, kCommunication = 0x302,
                         kCommunicationConfiguration = 0x303, kTimer = 0x304;
inline constexpr HDerror kIllegalBegin = 0x400, kIllegalEnd = 0x401, kFrame = 0x402;
inline constexpr HDerror kInvalidPriority = 0x500, kSchedulerFull = 0x501;
inline constexpr HDerror kNoLicence = 0x600;

extern "C" {
// A frame is a snapshot: begin makes the device current and zeroes its force, end sends what was set; one a device and tick.
// While the scheduler runs, all of these but those that schedule belong in its callbacks. Errors wait on one stack, last in
// first out.
HHD hdInitDevice(const char* name);  // null: the default device
void hdDisableDevice(HHD);
void hdBeginFrame(HHD);
void hdEndFrame(HHD);
HDErrorInfo hdGetError();
const char* hdGetErrorString(HDerror);
void hdEnable(HDenum);
void hdDisable(HDenum);
HDboolean hdIsEnabled(HDenum);
void hdGetBooleanv(HDenum, HDboolean*);
void hdGetIntegerv(HDenum, int*);
void hdGetLongv(HDenum, HDlong*);
void hdGetDoublev(HDenum, double*);
void hdSetDoublev(HDenum, const double*);
const char* hdGetString(HDenum);
HDenum hdCheckCalibration();
void hdUpdateCalibration(HDenum style);
void hdStartScheduler();
void hdStopScheduler();
void hdSetSchedulerRate(HDulong hz);
HDSchedulerHandle hdScheduleAsynchronous(HDCallback, void* data, HDushort priority);
void hdUnschedule(HDSchedulerHandle);
}

#define FORCESHADE_HDAPI_FUNCTIONS(X) \
  X(hdInitDevice)                     \
  X(hdDisableDevice)                  \
  X(hdBeginFrame)                     \
  X(hdEndFrame)                       \
  X(hdGetError)                       \
  X(hdGetErrorString)                 \
  X(hdEnable)                         \
  X(hdDisable)                        \
  X(hdIsEnabled)                      \
  X(hdGetBooleanv)                    \
  X(hdGetIntegerv)                    \
  X(hdGetLongv)                       \
  X(hdGetDoublev)                     \
  X(hdSetDoublev)                     \
  X(hdGetString)                      \
  X(hdCheckCalibration)               \
  X(hdUpdateCalibration)              \
  X(hdStartScheduler)                 \
  X(hdStopScheduler)                  \
  X(hdSetSchedulerRate)               \
  X(hdScheduleAsynchronous)           \
  X(hdUnschedule)

}  // namespace forceshade::device::hdapi
