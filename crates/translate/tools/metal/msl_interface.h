// What the library and the program around a shader share.
#pragma once

// Texels are four words each, levels from the finest, in a level slice by slice (layer, face of a layer, or depth).
struct msl_texture {
  unsigned width, height, depth, layers, levels;
  float* level[16];
};

// Address: 0 clamp, 1 repeat, 2 mirror. Filter: 0 nearest, 1 linear. Compare: 0 never, 1 less, 2 equal, 3 less or equal, 4 greater,
// 5 not equal, 6 greater or equal, 7 always.
struct msl_sampler {
  unsigned address[3], mag, min, mip, compare;
  float lod_min, lod_max;
};

extern "C" {
void msl_barrier();                                        // waits for the workgroup
void msl_quad(const void* own, unsigned bytes, void* all); // the quad's four values, lane x + 2 y
int msl_lane();                                            // this invocation's place in its quad
void msl_discard();
}
