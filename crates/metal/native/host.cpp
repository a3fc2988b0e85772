// The program around a shader: reads one job from its standard input, runs it, and writes what it left to its standard output.
//
// Invocations run one at a time on one thread. Where they have to meet, at a barrier or for a derivative, each is a coroutine, and
// they take turns: whoever has waited for all others once has met them.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#include "msl_interface.h"
#include "call.h"

namespace {
[[noreturn]] void fail(const char* why) {
  fprintf(stderr, "%s\n", why);
  exit(3);
}

// ---- coroutines
constexpr size_t STACK = 1 << 20;
struct coroutine {
  ucontext_t context;
  void* stack;
  bool done;
  msl_host_call call;
};
coroutine* all;
unsigned count, current;
bool met; // whether somebody waited in this round
ucontext_t home;
// What the lanes of a quad gave to each other, by turns in two places, so that a lane may be one exchange ahead.
constexpr unsigned LARGEST = 64;
char given[2][4][LARGEST];
unsigned turn[4], sizes[2][4];
bool discarded[4];

void run_current() {
  msl_host_invoke(&all[current].call);
  all[current].done = true;
  swapcontext(&all[current].context, &home);
}

void make_coroutines(unsigned n) {
  if (all) return;
  all = (coroutine*)calloc(n, sizeof(coroutine));
  for (unsigned i = 0; i < n; i++) {
    void* stack = mmap(nullptr, STACK, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (stack == MAP_FAILED) fail("no memory for the stacks of a workgroup");
    all[i].stack = stack;
  }
}

// Runs invocations until all have ended, each to its next meeting and then the next one.
void run_together(unsigned n, bool must_meet) {
  count = n;
  for (unsigned i = 0; i < n; i++) {
    all[i].done = false;
    getcontext(&all[i].context);
    all[i].context.uc_stack = {all[i].stack, 0, STACK};
    all[i].context.uc_link = &home;
    makecontext(&all[i].context, run_current, 0);
  }
  for (unsigned ended = 0; ended < n;) {
    unsigned before = ended, waited = 0;
    for (unsigned i = 0; i < n; i++) {
      if (all[i].done) continue;
      current = i;
      swapcontext(&home, &all[i].context);
      if (all[i].done) ended++; else waited++;
    }
    if (must_meet && waited && (ended != before || ended)) fail("a barrier was not met by all invocations of a workgroup");
  }
}

void wait() { swapcontext(&all[current].context, &home); }

// ---- input and output
char* input;
size_t length, at;
void read_all() {
  size_t room = 1 << 20;
  input = (char*)malloc(room);
  for (;;) {
    if (length == room) input = (char*)realloc(input, room *= 2);
    if (!input) fail("no memory for the job");
    ssize_t got = read(0, input + length, room - length);
    if (got < 0) fail("the job cannot be read");
    if (got == 0) return;
    length += got;
  }
}
const void* take(size_t bytes) {
  size_t whole = (bytes + 3) / 4 * 4;
  if (length - at < whole) fail("the job is cut short");
  const void* p = input + at;
  at += whole;
  return p;
}
unsigned word() {
  unsigned w;
  memcpy(&w, take(4), 4);
  return w;
}
void write_all(const void* from, size_t bytes) {
  const char* p = (const char*)from;
  while (bytes) {
    ssize_t put = write(1, p, bytes);
    if (put <= 0) exit(4);
    p += put;
    bytes -= put;
  }
}

constexpr unsigned SLOTS = 31;
void* buffers[SLOTS];
size_t buffer_bytes[SLOTS];
bool kept[SLOTS];
msl_texture textures[SLOTS];
msl_sampler samplers[SLOTS];

// Memory that is zero behind its end, where an index out of bounds would read.
void* room_for(size_t bytes) {
  void* p = aligned_alloc(256, (bytes + 511) / 256 * 256);
  if (!p) fail("no memory for a resource");
  memset(p, 0, (bytes + 511) / 256 * 256);
  return p;
}

unsigned slot() {
  unsigned s = word();
  if (s >= SLOTS) fail("a slot beyond the tables");
  return s;
}

void read_resources() {
  for (unsigned n = word(); n; n--) {
    unsigned s = slot();
    kept[s] = word();
    buffer_bytes[s] = word();
    buffers[s] = room_for(buffer_bytes[s]);
    memcpy(buffers[s], take(buffer_bytes[s]), buffer_bytes[s]);
  }
  for (unsigned n = word(); n; n--) {
    msl_texture& t = textures[slot()];
    t.width = word(); t.height = word(); t.depth = word(); t.layers = word(); t.levels = word();
    if (t.levels == 0 || t.levels > 16) fail("a texture of no or too many levels");
    for (unsigned l = 0; l < t.levels; l++) {
      size_t bytes = word();
      t.level[l] = (float*)room_for(bytes);
      memcpy(t.level[l], take(bytes), bytes);
    }
  }
  for (unsigned n = word(); n; n--) {
    msl_sampler& s = samplers[slot()];
    for (unsigned& a : s.address) a = word();
    s.mag = word(); s.min = word(); s.mip = word(); s.compare = word();
    memcpy(&s.lod_min, take(4), 4);
    memcpy(&s.lod_max, take(4), 4);
  }
}

msl_host_call a_call() {
  msl_host_call call = {};
  call.buffers = buffers;
  call.textures = textures;
  call.samplers = samplers;
  return call;
}

void dispatch() {
  const unsigned* size = msl_host_shader.workgroup;
  unsigned groups[3] = {word(), word(), word()}, n = size[0] * size[1] * size[2];
  bool waits = msl_host_shader.waits && n > 1;
  if (waits) make_coroutines(n);
  for (unsigned gz = 0; gz < groups[2]; gz++) for (unsigned gy = 0; gy < groups[1]; gy++) for (unsigned gx = 0; gx < groups[0]; gx++) {
    msl_host_begin_workgroup();
    for (unsigned i = 0; i < n; i++) {
      msl_host_call call = a_call();
      unsigned local[3] = {i % size[0], i / size[0] % size[1], i / size[0] / size[1]}, group[3] = {gx, gy, gz};
      for (int k = 0; k < 3; k++) {
        call.local[k] = local[k];
        call.group[k] = group[k];
        call.groups[k] = groups[k];
        call.grid[k] = group[k] * size[k] + local[k];
      }
      call.index = i;
      if (waits) all[i].call = call; else msl_host_invoke(&call);
    }
    if (waits) run_together(n, true);
  }
}

// Vertices, or fragments in quads: a row of words for each goes in, one comes out, with one word more for what is discarded.
void run_stage() {
  unsigned n = word(), in = msl_host_shader.words_in, out = msl_host_shader.words_out, row = out + 1;
  const unsigned* from = (const unsigned*)take(4ul * n * in);
  unsigned* to = (unsigned*)room_for(4ul * n * row);
  msl_host_call call = a_call();
  bool quads = msl_host_shader.stage == msl_host_fragment && msl_host_shader.waits;
  if (quads) make_coroutines(4);
  for (unsigned i = 0; i < n; i++) {
    call.in = from + (size_t)i * in;
    call.out = to + (size_t)i * row;
    unsigned lane = i % 4;
    current = lane;
    discarded[lane] = false;
    if (!quads) {
      msl_host_invoke(&call);
      call.out[out] = discarded[lane];
      continue;
    }
    all[lane].call = call;
    if (lane < 3) continue;
    memset(turn, 0, sizeof turn);
    run_together(4, false);
    for (unsigned l = 0; l < 4; l++) to[(size_t)(i - 3 + l) * row + out] = discarded[l];
  }
  write_all(to, 4ul * n * row);
}
} // namespace

void msl_barrier() {
  if (count > 1) wait();
}
void msl_quad(const void* own, unsigned bytes, void* values) {
  unsigned place = turn[current]++ % 2;
  if (bytes > LARGEST) fail("a value too large for a quad");
  memcpy(given[place][current], own, bytes);
  wait();
  for (unsigned l = 0; l < 4; l++) memcpy((char*)values + l * bytes, given[place][l], bytes);
}
int msl_lane() { return current; }
void msl_discard() { discarded[current] = true; }

int main() {
  read_all();
  if (word() != 0x314c534d) fail("this is no job");
  read_resources();
  const unsigned begin = 0x4f4b4159, end = 0x444f4e45;
  if (msl_host_shader.stage == msl_host_compute) {
    dispatch();
    write_all(&begin, 4);
  } else {
    write_all(&begin, 4);
    run_stage();
  }
  for (unsigned s = 0; s < SLOTS; s++)
    if (kept[s]) write_all(buffers[s], (buffer_bytes[s] + 3) / 4 * 4);
  write_all(&end, 4);
}
