// SPDX-License-Identifier: BSD-3-Clause
// Published functions that this device has nothing behind: the motors' own commands, and what computes with the inside of a
// real device. They are here so that a client that looks up every name finds it. Each is judged as a call of the open device,
// and answers -1 and NOT_IMPLEMENTED, an error of the documents.

#include "stand_in.h"

// Whatever is passed is not looked at; the caller takes it back from the stack.
#define LACKING(NAME)                                                                 \
  PUBLISHED int NAME(void) {                                                          \
    return expert_call_begins(#NAME, -1) ? call_ends(-1, ERROR_NOT_IMPLEMENTED) : -1; \
  }

LACKING(dhdControllerSetDevice)
LACKING(dhdDeltaForceToMotor)
LACKING(dhdDeltaGravityJointTorques)
LACKING(dhdDeltaJointTorquesExtrema)
LACKING(dhdDeltaMotorToForce)
LACKING(dhdGripperAngleRadToEncoder)
LACKING(dhdGripperEncoderToAngleRad)
LACKING(dhdGripperEncoderToGap)
LACKING(dhdGripperForceToMotor)
LACKING(dhdGripperGapToEncoder)
LACKING(dhdGripperMotorToForce)
LACKING(dhdJointAnglesToGravityJointTorques)
LACKING(dhdPreloadMot)
LACKING(dhdPreset)
LACKING(dhdReadConfigFromFile)
LACKING(dhdSetBrk)
LACKING(dhdSetDeltaJointTorques)
LACKING(dhdSetDeltaMotor)
LACKING(dhdSetForceAndWristJointTorques)
LACKING(dhdSetForceAndWristJointTorquesAndGripperForce)
LACKING(dhdSetGripperMotor)
LACKING(dhdSetJointTorques)
LACKING(dhdSetMot)
LACKING(dhdSetMotor)
LACKING(dhdSetWristJointTorques)
LACKING(dhdSetWristMotor)
LACKING(dhdWristEncoderToOrientation)
LACKING(dhdWristEncodersToJointAngles)
LACKING(dhdWristGravityJointTorques)
LACKING(dhdWristJointAnglesToEncoders)
LACKING(dhdWristJointAnglesToJacobian)
LACKING(dhdWristJointTorquesExtrema)
LACKING(dhdWristMotorToTorque)
LACKING(dhdWristOrientationToEncoder)
LACKING(dhdWristTorqueToMotor)

// A simulator of the vendor's, which has no device here.
PUBLISHED void dhdEnableSimulator(bool on) {
  (void)on;
  lock();
  unlock();
}

// The vendor's regulation, DRD, which a client may find in the same library: it says so of each function, and that nothing is
// supported, runs or moves. No call of it is judged.
static int no_regulation(void) {
  lock();
  return call_ends(-1, ERROR_NOT_IMPLEMENTED);
}

#define REGULATION(TYPE, NAME, ANSWER) \
  PUBLISHED TYPE NAME(void) {          \
    no_regulation();                   \
    return ANSWER;                     \
  }

REGULATION(int, drdAutoInit, -1)
REGULATION(int, drdCheckInit, -1)
REGULATION(int, drdClose, -1)
REGULATION(int, drdEnableFilter, -1)
REGULATION(int, drdGetDeviceID, -1)
REGULATION(int, drdGetEncMoveParam, -1)
REGULATION(int, drdGetEncTrackParam, -1)
REGULATION(int, drdGetGripMoveParam, -1)
REGULATION(int, drdGetGripTrackParam, -1)
REGULATION(int, drdGetPosMoveParam, -1)
REGULATION(int, drdGetPosTrackParam, -1)
REGULATION(int, drdGetPositionAndOrientation, -1)
REGULATION(int, drdGetPriorities, -1)
REGULATION(int, drdGetRotMoveParam, -1)
REGULATION(int, drdGetRotTrackParam, -1)
REGULATION(int, drdGetVelocity, -1)
REGULATION(int, drdHold, -1)
REGULATION(int, drdLock, -1)
REGULATION(int, drdMoveTo, -1)
REGULATION(int, drdMoveToAllEnc, -1)
REGULATION(int, drdMoveToEnc, -1)
REGULATION(int, drdMoveToGrip, -1)
REGULATION(int, drdMoveToPos, -1)
REGULATION(int, drdMoveToRot, -1)
REGULATION(int, drdOpen, -1)
REGULATION(int, drdOpenID, -1)
REGULATION(int, drdPrecisionInit, -1)
REGULATION(int, drdRegulateGrip, -1)
REGULATION(int, drdRegulatePos, -1)
REGULATION(int, drdRegulateRot, -1)
REGULATION(int, drdSetDevice, -1)
REGULATION(int, drdSetEncDGain, -1)
REGULATION(int, drdSetEncIGain, -1)
REGULATION(int, drdSetEncMoveParam, -1)
REGULATION(int, drdSetEncPGain, -1)
REGULATION(int, drdSetEncTrackParam, -1)
REGULATION(int, drdSetForceAndTorqueAndGripperForce, -1)
REGULATION(int, drdSetForceAndWristJointTorquesAndGripperForce, -1)
REGULATION(int, drdSetGripMoveParam, -1)
REGULATION(int, drdSetGripTrackParam, -1)
REGULATION(int, drdSetMotRatioMax, -1)
REGULATION(int, drdSetPosMoveParam, -1)
REGULATION(int, drdSetPosTrackParam, -1)
REGULATION(int, drdSetPriorities, -1)
REGULATION(int, drdSetRotMoveParam, -1)
REGULATION(int, drdSetRotTrackParam, -1)
REGULATION(int, drdStart, -1)
REGULATION(int, drdStop, -1)
REGULATION(int, drdTrack, -1)
REGULATION(int, drdTrackAllEnc, -1)
REGULATION(int, drdTrackEnc, -1)
REGULATION(int, drdTrackGrip, -1)
REGULATION(int, drdTrackPos, -1)
REGULATION(int, drdTrackRot, -1)
REGULATION(double, drdGetCtrlFreq, -1)
REGULATION(double, drdGetEncDGain, -1)
REGULATION(double, drdGetEncIGain, -1)
REGULATION(double, drdGetEncPGain, -1)
REGULATION(double, drdGetMotRatioMax, -1)
REGULATION(bool, drdIsFiltering, false)
REGULATION(bool, drdIsInitialized, false)
REGULATION(bool, drdIsMoving, false)
REGULATION(bool, drdIsRunning, false)
REGULATION(bool, drdIsSupported, false)
PUBLISHED void drdWaitForTick(void) {
  no_regulation();
}
