// SPDX-License-Identifier: MIT
// What all nodes over a projector pixel got back, spread evenly over their pixels. With CORRECTION that is
// kept for the windows; otherwise the pixel takes its step: p = clamp(p + length C adjoint).
layout(std430, binding = 0) buffer Sums { vec4 sums[]; };  // see windows.comp
#ifndef CORRECTION
layout(std430, binding = 1) buffer Light { vec4 light[]; };
layout(std430, binding = 2) buffer Counters { uint cutAll; };
layout(std430, binding = 3) writeonly buffer NodeLight { uvec2 nodeLight[]; };
layout(location = 0) uniform float stepLength;
layout(location = 36) uniform uint firstStep;
shared uint here;
#endif

layout(location = 1) uniform uint firstPixel;
layout(location = 2) uniform uvec2 size;
layout(location = 3) uniform uint levels;
layout(location = 4) uniform uvec2 level[32];  // of each level: the first node, nodes in a row

vec4 gathered(uint j, uvec2 place) {
  vec4 sum = sums[j];
  for (uint l = 1u; l < levels; ++l) {
    uvec2 begin = (place >> l) << l;
    uvec2 extent = min(begin + (1u << l), size) - begin;
    uint node = level[l].x + (place.y >> l) * level[l].y + (place.x >> l);
    sum += sums[node] / float(extent.x * extent.y);
  }
  return sum;
}

void main() {
  uint i = invocation();
  uint cut = 0u;
  if (i < size.x * size.y) {
    uint j = firstPixel + i;
    vec4 back = gathered(j, uvec2(i % size.x, i / size.x));
#ifdef CORRECTION
    sums[j] = back;
#else
    vec4 before = light[j];
    vec3 value = before.xyz + stepLength * before.w * preconditioner(sums[firstStep + j]) * back.xyz;
    cut = visiblyCut(value);
    value = min(clampLight(value), vec3(before.w));
    light[j] = vec4(value, before.w);
    nodeLight[j] = packLight(value);
#endif
  }
#ifndef CORRECTION
  if (gl_LocalInvocationID.x == 0u) here = 0u;
  barrier();
  if (cut > 0u) atomicAdd(here, cut);
  barrier();
  if (gl_LocalInvocationID.x == 0u && here > 0u) atomicAdd(cutAll, here);
#endif
}
