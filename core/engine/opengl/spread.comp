// SPDX-License-Identifier: MIT
// What all nodes over a projector pixel got back, spread evenly over their pixels. With CORRECTION that is
// kept, for C and the update need the largest of all first; otherwise the pixel takes its step:
// p = clamp(p + length C adjoint).
layout(std430, binding = 0) buffer Sums { vec4 sums[]; };
layout(std430, binding = 1) buffer Light { vec4 light[]; };
layout(std430, binding = 2) buffer Counters { uint cutAll; uint largestBound; };
#ifndef CORRECTION
layout(std430, binding = 3) writeonly buffer NodeLight { uvec2 nodeLight[]; };
layout(location = 0) uniform float stepLength;
#endif

layout(location = 1) uniform uint firstPixel;
layout(location = 2) uniform uvec2 size;
layout(location = 3) uniform uint levels;
layout(location = 4) uniform uvec2 level[32];  // of each level: the first node, nodes in a row

shared uint here;

vec3 gathered(uint j, uvec2 place, uint kind) {
  vec3 sum = sums[2u * j + kind].xyz;
  for (uint l = 1u; l < levels; ++l) {
    uvec2 begin = (place >> l) << l;
    uvec2 extent = min(begin + (1u << l), size) - begin;
    uint node = level[l].x + (place.y >> l) * level[l].y + (place.x >> l);
    sum += sums[2u * node + kind].xyz / float(extent.x * extent.y);
  }
  return sum;
}

void main() {
  uint i = invocation();
  uint found = 0u;
  if (i < size.x * size.y) {
    uvec2 place = uvec2(i % size.x, i / size.x);
    uint j = firstPixel + i;
    vec3 back = gathered(j, place, 0u);
#ifdef CORRECTION
    vec3 bound = gathered(j, place, 1u);
    sums[2u * j] = vec4(back, 0.0);
    sums[2u * j + 1u] = vec4(bound, 0.0);
    vec3 counted = max(light[j].w * bound, vec3(0.0));
    found = floatBitsToUint(max(counted.x, max(counted.y, counted.z)));
#else
    vec4 before = light[j];
    vec3 value = before.xyz + stepLength * sums[2u * j + 1u].xyz * back;
    found = visiblyCut(value);
    value = clampLight(value);
    light[j] = vec4(value, before.w);
    nodeLight[j] = packLight(value);
#endif
  }
  if (gl_LocalInvocationID.x == 0u) here = 0u;
  barrier();
#ifdef CORRECTION
  atomicMax(here, found);  // bits of positive floats are in the floats' order
  barrier();
  if (gl_LocalInvocationID.x == 0u) atomicMax(largestBound, here);
#else
  if (found > 0u) atomicAdd(here, found);
  barrier();
  if (gl_LocalInvocationID.x == 0u && here > 0u) atomicAdd(cutAll, here);
#endif
}
