// The types in Metal's namespace, where emitted code has them.
#pragma once

#include "msl_packed.h"
#include "msl_matrices.h"

namespace metal {
#define MSL_USE(T) using ::T##2; using ::T##3; using ::T##4;
MSL_USE(float) MSL_USE(uint) MSL_USE(int) MSL_USE(bool) MSL_USE(half) MSL_USE(short) MSL_USE(ushort) MSL_USE(char) MSL_USE(uchar) MSL_USE(long) MSL_USE(ulong)
MSL_USE(packed_float) MSL_USE(packed_int) MSL_USE(packed_uint) MSL_USE(packed_half)
MSL_USE(msl_make_float) MSL_USE(msl_make_uint) MSL_USE(msl_make_int) MSL_USE(msl_make_bool) MSL_USE(msl_make_half) MSL_USE(msl_make_short) MSL_USE(msl_make_ushort) MSL_USE(msl_make_char) MSL_USE(msl_make_uchar) MSL_USE(msl_make_long) MSL_USE(msl_make_ulong)
#define MSL_USE_MATRIX(T, C, R) using ::T##C##x##R;
MSL_SIZES(MSL_USE_MATRIX, float) MSL_SIZES(MSL_USE_MATRIX, half)
MSL_SIZES(MSL_TRANSPOSE, float) MSL_SIZES(MSL_TRANSPOSE, half)
using ::uint; using ::ushort; using ::uchar; using ::ulong; using ::half; using ::as_type;
} // namespace metal
