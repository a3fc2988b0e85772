// The types of textures.
#pragma once

#include "msl_images.h"

namespace metal {
#define MSL_NONE typename I::offset o = typename I::offset(0)
#define MSL_I(D, CUBE, ARRAY) typedef msl::image<T, D, CUBE, ARRAY> I; typedef typename I::coords P; typedef typename I::result R;
// Textures of colours; LAYER is empty or the parameter of a layer, AT what is handed on of it.
#define MSL_COLOUR(name, D, CUBE, ARRAY, LAYER, AT, GRADIENT) \
template <class T, access A = access::sample> struct name : msl::image<T, D, CUBE, ARRAY> { \
  MSL_I(D, CUBE, ARRAY) \
  R sample(sampler s, P p LAYER, MSL_NONE) const { return msl::colour<T>(I::look(s, p, AT, I::own_lod(p), o)); } \
  R sample(sampler s, P p LAYER, bias b, MSL_NONE) const { return msl::colour<T>(I::look(s, p, AT, I::own_lod(p) + b.value, o)); } \
  R sample(sampler s, P p LAYER, level l, MSL_NONE) const { return msl::colour<T>(I::look(s, p, AT, l.value, o)); } \
  R sample(sampler s, P p LAYER, GRADIENT g, MSL_NONE) const { return msl::colour<T>(I::look(s, p, AT, I::gradient_lod(p, g.dx, g.dy), o)); } \
  R gather(sampler s, P p LAYER, MSL_NONE, component c = component::x) const { msl::texel4 four[4]; I::gathered(s, p, AT, o, false, 0.0f, four); R r; for (int k = 0; k < 4; k++) r[k] = (T)(float)four[k].at[(int)c]; return r; } \
  R gather(sampler s, P p LAYER, component c) const { return gather(s, p MSL_PASS_##ARRAY, typename I::offset(0), c); } \
  R read(typename I::texel_coords p MSL_SLICE_##CUBE LAYER, uint l = 0) const { return msl::stored<T>(I::texel_at(p, MSL_SLICE_AT_##CUBE(AT), l)); } \
  void write(R v, typename I::texel_coords p MSL_SLICE_##CUBE LAYER, uint l = 0) const { __builtin_memcpy(I::texel_at(p, MSL_SLICE_AT_##CUBE(AT), l), &v, 16); } \
};
#define MSL_PASS_false
#define MSL_PASS_true , layer
#define MSL_SLICE_false
#define MSL_SLICE_true , uint face
#define MSL_SLICE_AT_false(at) at
#define MSL_SLICE_AT_true(at) 6 * (at) + face
#define MSL_LAYER , uint layer
#define MSL_DEPTH(name, D, CUBE, ARRAY, LAYER, AT, GRADIENT) \
template <class T, access A = access::sample> struct name : msl::image<T, D, CUBE, ARRAY> { \
  MSL_I(D, CUBE, ARRAY) \
  T sample(sampler s, P p LAYER, MSL_NONE) const { return (T)(float)I::look(s, p, AT, I::own_lod(p), o).at[0]; } \
  T sample(sampler s, P p LAYER, bias b, MSL_NONE) const { return (T)(float)I::look(s, p, AT, I::own_lod(p) + b.value, o).at[0]; } \
  T sample(sampler s, P p LAYER, level l, MSL_NONE) const { return (T)(float)I::look(s, p, AT, l.value, o).at[0]; } \
  T sample(sampler s, P p LAYER, GRADIENT g, MSL_NONE) const { return (T)(float)I::look(s, p, AT, I::gradient_lod(p, g.dx, g.dy), o).at[0]; } \
  T sample_compare(sampler s, P p LAYER, float reference, MSL_NONE) const { return (T)(float)I::look_compare(s, p, AT, reference, I::own_lod(p), o).at[0]; } \
  T sample_compare(sampler s, P p LAYER, float reference, level l, MSL_NONE) const { return (T)(float)I::look_compare(s, p, AT, reference, l.value, o).at[0]; } \
  R gather(sampler s, P p LAYER, MSL_NONE) const { return four(s, p, AT, o, false, 0.0f); } \
  R gather_compare(sampler s, P p LAYER, float reference, MSL_NONE) const { return four(s, p, AT, o, true, reference); } \
  T read(typename I::texel_coords p MSL_SLICE_##CUBE LAYER, uint l = 0) const { return (T)*I::texel_at(p, MSL_SLICE_AT_##CUBE(AT), l); } \
 private: \
  R four(const sampler& s, const P& p, uint at, const typename I::offset& o, bool compared, float reference) const { msl::texel4 t[4]; I::gathered(s, p, at, o, compared, reference, t); R r; for (int k = 0; k < 4; k++) r[k] = (T)(float)t[k].at[0]; return r; } \
};
MSL_COLOUR(texture2d, 2, false, false, , 0, gradient2d)
MSL_COLOUR(texture2d_array, 2, false, true, MSL_LAYER, layer, gradient2d)
MSL_COLOUR(texture3d, 3, false, false, , 0, gradient3d)
MSL_COLOUR(texturecube, 2, true, false, , 0, gradientcube)
MSL_COLOUR(texturecube_array, 2, true, true, MSL_LAYER, layer, gradientcube)
MSL_DEPTH(depth2d, 2, false, false, , 0, gradient2d)
MSL_DEPTH(depth2d_array, 2, false, true, MSL_LAYER, layer, gradient2d)
MSL_DEPTH(depthcube, 2, true, false, , 0, gradientcube)
MSL_DEPTH(depthcube_array, 2, true, true, MSL_LAYER, layer, gradientcube)
// One row has one level and no derivatives.
template <class T, access A = access::sample> struct texture1d : msl::image<T, 1, false, false> {
  MSL_I(1, false, false)
  R sample(sampler s, P p) const { return msl::colour<T>(I::look(s, p, 0, 0.0f, 0)); }
  R read(uint p, uint l = 0) const { return msl::stored<T>(I::texel_at(p, 0, l)); }
  void write(R v, uint p, uint l = 0) const { __builtin_memcpy(I::texel_at(p, 0, l), &v, 16); }
};
} // namespace metal
