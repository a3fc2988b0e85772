// The shape of a texture: how many coordinates, whether there are layers, and what can be asked of it.
#pragma once

#include "msl_detail.h"
#include "msl_filtering.h"
#include "msl_fragments.h"
#include "msl_samplers.h"

namespace msl {
// What a texture gives, as its scalar type; integers are kept as bits.
template <class T> inline vector<T, 4> colour(const texel4& t) { vector<T, 4> r; for (int i = 0; i < 4; i++) r[i] = (T)(float)t.at[i]; return r; }
template <class T> inline vector<T, 4> stored(const float* p) {
  vector<T, 4> r;
  for (int i = 0; i < 4; i++) { if constexpr (__is_same(T, int) || __is_same(T, uint)) { T word; __builtin_memcpy(&word, p + i, 4); r[i] = word; } else r[i] = (T)p[i]; }
  return r;
}

template <class T, int D, bool CUBE, bool ARRAY> struct image {
  static constexpr int COORDS = CUBE ? 3 : D;
  typedef vector<float, COORDS> coords;
  typedef vector<uint, CUBE ? 2 : D> texel_coords;
  typedef vector<int, CUBE ? 3 : D> offset;
  typedef vector<T, 4> result;
  const msl_texture* own;
  uint get_width(uint level = 0) const { return at_level(own->width, level); }
  uint get_height(uint level = 0) const { return at_level(own->height, level); }
  uint get_depth(uint level = 0) const { return at_level(own->depth, level); }
  uint get_num_mip_levels() const { return own->levels; }
  uint get_array_size() const { return own->layers; }
  reading read_from(const metal::sampler& s, const coords& at, uint layer, const offset& o, float* u) const {
    uint last = own->layers - 1; layer = layer < last ? layer : last;
    reading r = {own, s.own, layer, CUBE, D == 3 && !CUBE, false, 0.0f, {0, 0, 0}};
    u[0] = u[1] = u[2] = 0;
    if constexpr (CUBE) { on_face f = face_of(at[0], at[1], at[2]); r.slice = 6 * layer + f.face; u[0] = (float)f.s; u[1] = (float)f.t; }
    else for (int i = 0; i < D; i++) { u[i] = element(at, i); r.offset[i] = element(o, i); }
    return r;
  }
  texel4 look(const metal::sampler& s, const coords& at, uint layer, float lod, const offset& o) const { float u[3]; reading r = read_from(s, at, layer, o, u); return sampled(r, u, lod); }
  texel4 look_compare(const metal::sampler& s, const coords& at, uint layer, float reference, float lod, const offset& o) const {
    float u[3]; reading r = read_from(s, at, layer, o, u); r.compared = true; r.reference = reference; return sampled(r, u, lod);
  }
  float gradient_lod(const coords& at, const coords& dx, const coords& dy) const { if constexpr (CUBE) return cube_lod(own, at, dx, dy); else return lod_of(own, dx, dy); }
  float own_lod(const coords& at) const { return gradient_lod(at, metal::dfdx(at), metal::dfdy(at)); }
  // The four texels that linear filtering mixes, counter-clockwise from the lower left.
  void gathered(const metal::sampler& s, const coords& at, uint layer, const offset& o, bool compared, float reference, texel4* four) const {
    float u[3]; reading r = read_from(s, at, layer, o, u); r.compared = compared; r.reference = reference;
    axis x = along(u[0], own->width, r.offset[0], true), y = along(u[1], own->height, r.offset[1], true);
    int dx[4] = {0, 1, 1, 0}, dy[4] = {1, 1, 0, 0};
    for (int k = 0; k < 4; k++) {
      long i = x.cell + dx[k], j = y.cell + dy[k];
      four[k] = CUBE ? cube_texel(r, 0, r.slice, (int)i, (int)j, own->width) : r.texel(0, r.slice, wrap(i, own->width, s.own->address[0]), wrap(j, own->height, s.own->address[1]));
    }
  }
  float* texel_at(const texel_coords& at, uint slice, uint level) const {
    unsigned long x = element(at, 0), y = 0, z = slice;
    if constexpr (CUBE || D > 1) y = element(at, 1);
    if constexpr (!CUBE && D == 3) z = element(at, 2);
    return own->level[level] + 4 * ((z * get_height(level) + y) * get_width(level) + x);
  }
};
} // namespace msl
