// SPDX-License-Identifier: MIT
// The sums of every node from those of its segments, in their order. LONG: for nodes with many segments, a
// whole group for each of them; otherwise one invocation for each of all the others.
layout(std430, binding = 0) readonly buffer Starts { uint start[]; };
layout(std430, binding = 1) readonly buffer Segments { uint segment[]; };
layout(std430, binding = 2) readonly buffer SegmentSums { vec4 segmentSum[]; };
layout(std430, binding = 3) writeonly buffer Sums { vec4 sums[]; };  // see windows.comp

layout(location = 0) uniform uint nodes;
layout(location = 1) uniform uint longNode;  // from so many segments on

vec4 sumOf(uint begin, uint end, uint stride) {
  vec4 sum = vec4(0.0);
  for (uint i = begin; i < end; i += stride) sum += segmentSum[segment[i]];
  return sum;
}

#ifdef LONG
layout(std430, binding = 4) readonly buffer LongNodes { uint longNodes[]; };
shared vec4 part[64];

void main() {
  uint index = invocation() / 64u;
  uint lane = gl_LocalInvocationID.x;
  uint node = index < nodes ? longNodes[index] : 0u;
  part[lane] = index < nodes ? sumOf(start[node] + lane, start[node + 1u], 64u) : vec4(0.0);
  for (uint width = 32u; width > 0u; width /= 2u) {
    barrier();
    if (lane < width) part[lane] += part[lane + width];
  }
  barrier();
  if (lane == 0u && index < nodes) sums[node] = part[0];
}
#else
void main() {
  uint node = invocation();
  if (node >= nodes) return;
  uint begin = start[node], end = start[node + 1u];
  if (end - begin >= longNode) return;
  sums[node] = sumOf(begin, end, 1u);
}
#endif
