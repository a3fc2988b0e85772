// What the program around a shader and the caller of its entry point share.
#pragma once

// One invocation. A stage's values are words: floats as their bits, truth as 0 or 1.
struct msl_host_call {
  void* const* buffers;
  const msl_texture* textures;
  const msl_sampler* samplers;
  unsigned grid[3], local[3], group[3], groups[3], index;
  const unsigned* in;
  unsigned* out;
};

enum msl_host_stage { msl_host_compute, msl_host_vertex, msl_host_fragment };

// What a caller says of its entry point.
struct msl_host_entry {
  unsigned stage, words_in, words_out, workgroup[3];
  bool waits; // whether invocations of a workgroup wait for each other
};

extern "C" {
extern const msl_host_entry msl_host_shader;
void msl_host_begin_workgroup();
void msl_host_invoke(const msl_host_call* call);
}
