// SPDX-License-Identifier: MIT
// The content in its place and nothing corrected: every projector pixel shows what its brightest camera pixel
// was to see, under the best brightness.
layout(std430, binding = 0) readonly buffer Brightest { int brightest[]; };
layout(std430, binding = 1) readonly buffer Placed { vec4 placed[]; };
layout(std430, binding = 2) readonly buffer Parts { vec2 parts[]; };
layout(std430, binding = 3) buffer Light { vec4 light[]; };
layout(std430, binding = 4) readonly buffer Kept { float kept[]; };  // what masks leave

layout(location = 0) uniform uint pixels;

void main() {
  uint j = invocation();
  if (j >= pixels) return;
  float free = light[j].w;
  bool shown = brightest[j] >= 0 && free > 0.0;
  vec3 value = shown ? kept[j] * clampLight(parts[64].x * placed[max(brightest[j], 0)].xyz) : vec3(0.0);
  light[j] = vec4(value, free);
}
