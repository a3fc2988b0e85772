// The language's words, as macros: after everything that must not see them.
#pragma once

#define kernel static
#define vertex static
#define fragment static
#define device
#define thread
#define threadgroup
#define constant const
#define static_cast msl::cast
#define float2(...) msl_make_float2(__VA_ARGS__)
#define float3(...) msl_make_float3(__VA_ARGS__)
#define float4(...) msl_make_float4(__VA_ARGS__)
#define uint2(...) msl_make_uint2(__VA_ARGS__)
#define uint3(...) msl_make_uint3(__VA_ARGS__)
#define uint4(...) msl_make_uint4(__VA_ARGS__)
#define int2(...) msl_make_int2(__VA_ARGS__)
#define int3(...) msl_make_int3(__VA_ARGS__)
#define int4(...) msl_make_int4(__VA_ARGS__)
#define bool2(...) msl_make_bool2(__VA_ARGS__)
#define bool3(...) msl_make_bool3(__VA_ARGS__)
#define bool4(...) msl_make_bool4(__VA_ARGS__)
#define half2(...) msl_make_half2(__VA_ARGS__)
#define half3(...) msl_make_half3(__VA_ARGS__)
#define half4(...) msl_make_half4(__VA_ARGS__)
#define short2(...) msl_make_short2(__VA_ARGS__)
#define short3(...) msl_make_short3(__VA_ARGS__)
#define short4(...) msl_make_short4(__VA_ARGS__)
#define ushort2(...) msl_make_ushort2(__VA_ARGS__)
#define ushort3(...) msl_make_ushort3(__VA_ARGS__)
#define ushort4(...) msl_make_ushort4(__VA_ARGS__)
#define char2(...) msl_make_char2(__VA_ARGS__)
#define char3(...) msl_make_char3(__VA_ARGS__)
#define char4(...) msl_make_char4(__VA_ARGS__)
#define uchar2(...) msl_make_uchar2(__VA_ARGS__)
#define uchar3(...) msl_make_uchar3(__VA_ARGS__)
#define uchar4(...) msl_make_uchar4(__VA_ARGS__)
#define long2(...) msl_make_long2(__VA_ARGS__)
#define long3(...) msl_make_long3(__VA_ARGS__)
#define long4(...) msl_make_long4(__VA_ARGS__)
#define ulong2(...) msl_make_ulong2(__VA_ARGS__)
#define ulong3(...) msl_make_ulong3(__VA_ARGS__)
#define ulong4(...) msl_make_ulong4(__VA_ARGS__)
