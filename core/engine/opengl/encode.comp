// SPDX-License-Identifier: MIT
// Linear light to drive levels, as DriveEncoder does it.
layout(std430, binding = 0) readonly buffer Light { vec4 light[]; };
layout(std430, binding = 1) readonly buffer FirstLevels { uint firstLevel[]; };
layout(std430, binding = 2) readonly buffer Lights { float lightOf[]; };
layout(std430, binding = 3) readonly buffer Middles { float middle[]; };
layout(std430, binding = 4) readonly buffer Thresholds { float threshold[]; };
layout(std430, binding = 5) writeonly buffer Words { uint word[]; };

layout(location = 0) uniform uint firstPixel;
layout(location = 1) uniform uvec2 size;
layout(location = 2) uniform uint bits;
layout(location = 3) uniform bool dithered;

layout(location = 4) uniform uint steps;
layout(location = 5) uniform float knee;
layout(location = 6) uniform uint shift;
layout(location = 7) uniform uint mostPerStep;

const uint side = 64u;
const uvec2 offsets[3] = uvec2[3](uvec2(0u, 0u), uvec2(21u, 43u), uvec2(43u, 21u));

void main() {
  uint i = invocation();
  if (i >= size.x * size.y) return;
  uvec2 place = uvec2(i % size.x, i / size.x);
  uint last = (1u << bits) - 1u;
  vec3 values = clampLight(light[firstPixel + i].xyz);

  uint result = bits == 8u ? 0xff000000u : 0xc0000000u;
  for (uint c = 0u; c < 3u; ++c) {
    float value = values[c];
    uint lights = c * (last + 2u);
    uint k = firstLevel[c * steps + ((floatBitsToUint(value + knee) - floatBitsToUint(knee)) >> shift)];
    for (uint i = 0u; i < mostPerStep; ++i) k += uint(lightOf[lights + k + 1u] <= value);
    float next;
    if (dithered) {
      uvec2 at = (place + offsets[c]) % side;
      float below = lightOf[lights + k];
      next = below + threshold[at.y * side + at.x] * (lightOf[lights + k + 1u] - below);
    } else {
      next = middle[c * (last + 1u) + k];
    }
    if (value >= next && k < last) ++k;
    result |= k << (bits * c);
  }
  word[firstPixel + i] = result;
}
