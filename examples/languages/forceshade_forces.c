/* SPDX-License-Identifier: BSD-3-Clause */
/* forces = forceshade_forces(subject_file, positions): positions in mm as a single matrix of n rows, x, y and z; forces in N in the
 * same form. For Octave: mkoctfile --mex forceshade_forces.c -lforceshade; for MATLAB: mex forceshade_forces.c -lforceshade */
#include <forceshade.h>
#include <mex.h>

static void checked(forceshade_result result) {
  if (result != FORCESHADE_OK) mexErrMsgIdAndTxt("forceshade:error", "%s", forceshade_message());
}

void mexFunction(int outputs, mxArray** output, int inputs, const mxArray** input) {
  if (inputs != 2 || outputs > 1 || !mxIsChar(input[0]) || !mxIsSingle(input[1]) || mxIsComplex(input[1]) || mxGetN(input[1]) != 3)
    mexErrMsgIdAndTxt("forceshade:usage", "expected forceshade_forces(subject_file, positions), positions a single matrix of 3 columns");
  size_t rows = mxGetM(input[1]), invalid = 0;
  char* file = mxArrayToString(input[0]);
  forceshade_subject subject;
  forceshade_result read = forceshade_subject_read(file, &subject);
  mxFree(file);
  checked(read);
  output[0] = mxCreateNumericMatrix(rows, 3, mxSINGLE_CLASS, mxREAL);
  /* A matrix lies column by column: a position to the next one is 4 bytes, x to y is a whole column. */
  forceshade_batch batch = {sizeof batch, rows, mxGetData(input[1]), 4, 4 * (ptrdiff_t)rows, mxGetData(output[0]), 4,
                            4 * (ptrdiff_t)rows, NULL, 1};
  forceshade_result result = forceshade_forces(subject, &batch, &invalid);
  forceshade_subject_free(subject);
  checked(result);
  if (invalid > 0) mexWarnMsgIdAndTxt("forceshade:invalid", "%d positions are NaN or beyond 10^4 mm", (int)invalid);
}
