// Samplers, and what a texture is asked with.
#pragma once

#include "msl_interface.h"
#include "msl_names.h"

namespace metal {
enum class access { sample, read, write, read_write };
enum class component { x, y, z, w };
struct level { float value; explicit level(float v) : value(v) {} };
struct bias { float value; explicit bias(float v) : value(v) {} };
struct gradient2d { float2 dx, dy; gradient2d(float2 x, float2 y) : dx(x), dy(y) {} };
struct gradient3d { float3 dx, dy; gradient3d(float3 x, float3 y) : dx(x), dy(y) {} };
struct gradientcube { float3 dx, dy; gradientcube(float3 x, float3 y) : dx(x), dy(y) {} };
struct sampler { const msl_sampler* own; };
} // namespace metal
