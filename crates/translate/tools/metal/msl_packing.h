// Numbers of eight and sixteen bits in a word.
#pragma once

#include "msl_math.h"

namespace metal {
inline float msl_code(float x, float low, float scale) { x = __builtin_isnan(x) ? 0.0f : x < low ? low : x > 1.0f ? 1.0f : x; return __builtin_rintf(x * scale); }
inline uint pack_float_to_unorm4x8(float4 v) { uint r = 0; for (int i = 0; i < 4; i++) r |= (uint)msl_code(v[i], 0.0f, 255.0f) << (8 * i); return r; }
inline uint pack_float_to_snorm4x8(float4 v) { uint r = 0; for (int i = 0; i < 4; i++) r |= ((uint)(int)msl_code(v[i], -1.0f, 127.0f) & 255u) << (8 * i); return r; }
inline uint pack_float_to_unorm2x16(float2 v) { uint r = 0; for (int i = 0; i < 2; i++) r |= (uint)msl_code(v[i], 0.0f, 65535.0f) << (16 * i); return r; }
inline uint pack_float_to_snorm2x16(float2 v) { uint r = 0; for (int i = 0; i < 2; i++) r |= ((uint)(int)msl_code(v[i], -1.0f, 32767.0f) & 65535u) << (16 * i); return r; }
inline float4 unpack_unorm4x8_to_float(uint v) { float4 r; for (int i = 0; i < 4; i++) r[i] = (float)(v >> (8 * i) & 255u) / 255.0f; return r; }
inline float4 unpack_snorm4x8_to_float(uint v) { float4 r; for (int i = 0; i < 4; i++) r[i] = max((float)(signed char)(v >> (8 * i)) / 127.0f, -1.0f); return r; }
inline float2 unpack_unorm2x16_to_float(uint v) { float2 r; for (int i = 0; i < 2; i++) r[i] = (float)(v >> (16 * i) & 65535u) / 65535.0f; return r; }
inline float2 unpack_snorm2x16_to_float(uint v) { float2 r; for (int i = 0; i < 2; i++) r[i] = max((float)(short)(v >> (16 * i)) / 32767.0f, -1.0f); return r; }
} // namespace metal
