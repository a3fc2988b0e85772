// What the program around a shader and the caller of its entry point share.
#pragma once

// One invocation. A stage's values are words: floats as their bits, truth as 0 or 1.
struct bossage_call {
  void* const* buffers;
  const msl_texture* textures;
  const msl_sampler* samplers;
  unsigned grid[3], local[3], group[3], groups[3], index;
  const unsigned* in;
  unsigned* out;
};

enum bossage_stage { bossage_compute, bossage_vertex, bossage_fragment };

// What a caller says of its entry point.
struct bossage_entry {
  unsigned stage, words_in, words_out, workgroup[3];
  bool waits; // whether invocations of a workgroup wait for each other
};

extern "C" {
extern const bossage_entry bossage_shader;
void bossage_begin_workgroup();
void bossage_invoke(const bossage_call* call);
}
