// SPDX-License-Identifier: MIT
// The brightness that brings flood * content nearest to what is wanted, in two dispatches: sums of 64 groups,
// and with LAST in one group what they make together.
layout(std430, binding = 0) buffer Parts { vec2 parts[]; };  // 64, and the brightness in the last
#ifndef LAST
layout(std430, binding = 1) readonly buffer Camera { vec4 camera[]; };
layout(std430, binding = 2) readonly buffer Wanted { vec4 wanted[]; };
layout(std430, binding = 3) readonly buffer Placed { vec4 placed[]; };
layout(location = 0) uniform uint pixels;      // of those that `camera` knows, from
layout(location = 1) uniform uint firstPixel;  // on; the sums of those before are there
#endif

shared vec2 part[64];

void main() {
  uint lane = gl_LocalInvocationID.x;
#ifdef LAST
  part[lane] = parts[lane];
#else
  vec2 sum = vec2(0.0);
  for (uint i = invocation(); i < pixels; i += 64u * 64u) {
    vec4 flood = camera[cameraStride * i + cameraFlood];
    float weight = weightOf(camera[cameraStride * i + cameraBlack].w, flood.w);
    if (weight == 0.0) continue;
    vec3 light = flood.xyz * placed[firstPixel + i].xyz;
    sum += weight * vec2(dot(light, wanted[firstPixel + i].xyz), dot(light, light));
  }
  part[lane] = sum;
#endif
  for (uint width = 32u; width > 0u; width /= 2u) {
    barrier();
    if (lane < width) part[lane] += part[lane + width];
  }
  barrier();
  if (lane > 0u) return;
#ifdef LAST
  parts[64] = vec2(part[0].y > 0.0 ? clamp(part[0].x / part[0].y, 0.0, 1.0) : 1.0, 0.0);
#else
  parts[gl_WorkGroupID.x] = firstPixel == 0u ? part[0] : parts[gl_WorkGroupID.x] + part[0];
#endif
}
